// A measured signal: opened, judged by the engine, shown in the page and laid beside the simulation.
import { Refused } from "./answers.js";
import { short } from "./chart.js";
import { byId, fill, h, numberInput, numberOf, spelled } from "./dom.js";

/** @typedef {(request: Record<string, unknown>) => Promise<any>} Ask */

/**
 * The dialog's answer: what was agreed to, else "". Where that is one of several, it is chosen with its button: Enter presses none.
 * @param {string} title @param {(Node | null)[]} body @param {...string} go
 */
export function asked(title, body, ...go) {
  const dialog = /** @type {HTMLDialogElement} */ (byId("dialog"));
  const form = h(
    "form",
    { method: "dialog" },
    h("h2", { id: "dialog-title" }, title),
    ...body.filter((node) => node !== null),
    // Enter in a field presses the first button that submits, unless that is disabled.
    h(
      "div",
      { className: "actions" },
      go.length > 1 ? h("button", { type: "submit", hidden: true, disabled: true }) : null,
      h("button", { type: "button", onclick: () => dialog.close() }, "Cancel"),
      ...go.map((text) => h("button", { type: "submit", value: text }, text)),
    ),
  );
  dialog.replaceChildren(form);
  dialog.returnValue = "";
  dialog.showModal();
  return new Promise((/** @type {(answer: string) => void} */ done) =>
    dialog.addEventListener("close", () => done(dialog.returnValue), { once: true }),
  );
}

/** @param {string} label @param {HTMLElement} input @param {string} unit @param {string} note */
export function line(label, input, unit, note) {
  input.id ||= `ask-${label.toLowerCase().replaceAll(/\W+/g, "-")}`;
  return h(
    "div",
    { className: "field plain" },
    h("span", { className: "name" }, h("label", { htmlFor: input.id }, label)),
    input,
    h("span", { className: "unit" }, unit),
    note ? h("p", { className: "note" }, note) : null,
  );
}

/** @param {string} text */
const number = (text) => (text.trim() === "" ? null : numberOf(text));

/** What a field says, null where it is what the file states: the engine then takes it from there, and says so. @param {HTMLInputElement} input @param {unknown} stated */
const given = (input, stated) => (input.value.trim() === "" || input.value === String(stated ?? "") ? null : input.value.trim());

/** A channel in a list. @param {any} c */
const listed = (c) =>
  [c.name, c.samples ? `${c.samples} samples` : "", c.rate_hz ? `${short(c.rate_hz, 6)} Hz` : "", c.unit ? spelled(c.unit) : ""]
    .filter(Boolean)
    .join(", ");

/** Bearings by name, and how the page's own or that of the run that made the file is chosen. @param {string[]} known @param {any} run @param {string} own */
function bearings(known, run, own) {
  const of = run?.bearing ? `, ${run.bearing}` : "",
    option = (/** @type {string} */ value, /** @type {string} */ words) => h("option", { value }, words);
  return h(
    "select",
    { required: !run },
    option("", run ? `as the file states: that of the run${of}` : "choose"),
    ...known.map((name) => option(name, name)),
    option("unknown", "unknown: lines as of any damaged race"),
    option(OWN, `this page's bearing${own ? `: ${own}` : ""}`),
  );
}

const OWN = "\u0000own";

/**
 * Asks for what the file does not say, and has the signal judged. What is refused is asked for again, with the reason.
 * @param {Ask} ask
 * @param {string} name
 * @param {Uint8Array<ArrayBuffer>} bytes
 * @param {string[]} known  names of bearings
 * @param {{name: string, toml: string}} own  bearing on the page, which is taken where it is chosen
 * @param {() => void} refused
 */
export async function judged(ask, name, bytes, known, own, refused) {
  const { channels, run } = await ask({ do: "listen", name, bytes });
  if (!channels?.length) throw new Error(`${name} holds no signal`);
  const channel = h("select", {}, ...channels.map((/** @type {any} */ c) => h("option", { value: c.name }, listed(c))));
  const text = (/** @type {string} */ placeholder) => h("input", { type: "text", placeholder });
  const rate = numberInput({ required: true }, 1, 0),
    rpm = numberInput({ required: true }),
    from = numberInput({ value: String(run?.from_s ?? 0) }, 1, 0);
  const unit = text("m/s^2, g, mm/s, V, counts"),
    scale = text("10g, 5V"),
    sensitivity = text("100mV/g"),
    bearing = bearings(known, run, own.name);
  const rows = {
    rate: line("Sampling rate", rate, "Hz", " "),
    unit: line("Unit", unit, "", " "),
    scale: line("Full scale", scale, "", "of a WAV, in place of the unit: what its largest number means"),
    rpm: line("Speed of the shaft", rpm, "r/min", " "),
  };
  const says = (/** @type {HTMLElement} */ row, /** @type {string} */ words) => {
    /** @type {HTMLElement} */ (row.querySelector(".note")).textContent = words;
  };
  const now = () => channels.find((/** @type {any} */ one) => one.name === channel.value) ?? channels[0];
  /** Fields with what was typed: another channel leaves them. */
  const typed = new Set();
  for (const input of [rate, unit, rpm])
    for (const event of ["input", "change"])
      input.addEventListener(event, () => (input.value.trim() ? typed.add(input) : typed.delete(input)));
  const fill = () => {
    const c = now(),
      none = "the file does not state it";
    for (const [input, row, value, from] of /** @type {[HTMLInputElement, HTMLElement, unknown, string][]} */ ([
      [rate, rows.rate, c.rate_hz, c.rate_from ? `from ${c.rate_from}` : (c.rate_missing ?? none)],
      [unit, rows.unit, c.unit, c.unit ? "from the file" : none],
      [rpm, rows.rpm, c.rpm, c.rpm_from ? `from ${c.rpm_from}` : none],
    ])) {
      says(row, typed.has(input) ? `as typed${value ? `; the file states ${value}` : ""}` : from);
      if (typed.has(input)) continue;
      input.value = String(value ?? "");
      input.setCustomValidity("");
    }
    rows.scale.hidden = !c.is_wav || !!c.unit;
  };
  rate.addEventListener("change", () => {
    const [, size, kilo] = /^(.*\d[.,]?)\s*(k?)hz$/i.exec(rate.value.trim()) ?? [],
      said = numberOf(size ?? "");
    if (typeof said !== "number") return;
    rate.value = String(Number((kilo ? 1000 * said : said).toPrecision(12)));
    rate.setCustomValidity("");
  });
  channel.addEventListener("change", fill);
  fill();
  const trouble = h("p", { className: "trouble", role: "alert" });
  for (;;) {
    const agreed = await asked(
      `Measured signal: ${name}`,
      [
        trouble,
        line("Channel", channel, "", ""),
        rows.rate,
        rows.unit,
        rows.scale,
        line("Sensitivity", sensitivity, "", "of a signal in V or mA: the sensor's"),
        line("Bearing", bearing, "", "its defect frequencies are looked for"),
        rows.rpm,
        line(
          "Counts from",
          from,
          "s",
          run ? "after the load's ramp and a turn of the shaft of the run that made the file" : "what comes before is left out",
        ),
      ],
      "Judge",
    );
    if (!agreed) return null;
    const c = now(),
      whose = bearing.value === OWN ? { of: own.toml } : { bearing: bearing.value || null };
    try {
      return await ask({
        do: "judge",
        name,
        bytes,
        channel: channel.value,
        rate_hz: number(given(rate, c.rate_hz) ?? ""),
        unit: given(unit, c.unit),
        sensitivity: given(sensitivity, null),
        full_scale: rows.scale.hidden ? null : given(scale, null),
        rpm: number(given(rpm, c.rpm) ?? ""),
        from_s: number(from.value),
        ...whose,
      });
    } catch (error) {
      if (!(error instanceof Refused)) throw error;
      refused();
      trouble.textContent = error.problems.map((p) => p.message).join("; ");
    }
  }
}

/**
 * Shows what the engine found in a measured signal.
 * @param {any} found
 * @param {string} name
 * @param {{beside: (on: boolean) => void, close: () => void, simulated: string}} act  simulated: unit of the simulation's spectra
 */
export function showMeasured(found, name, { beside, close, simulated }) {
  const root = byId("measured"),
    lay = h("input", { type: "checkbox", checked: true, onchange: () => beside(lay.checked) });
  const curve = (/** @type {string} */ kind, /** @type {any} */ data) => Object.assign(document.createElement("brinell-curve"), { data }),
    unit = found.unit ?? "",
    alike = unit === simulated;
  const none = { unit, lines: [], behind: null, second: null },
    of = (/** @type {any} */ one) => ({ ...none, x0: 0, dx: one?.df, values: one?.values });
  const curves = [
    ["waveform", { ...none, x0: found.from_s ?? 0, dx: 1 / found.rate_hz, values: found.x }],
    ["spectrum", { ...of(found.spectrum), band_hz: found.envelope?.band_hz }],
    ["envelope", { ...of(found.envelope), lines: found.lines ?? [] }],
  ]
    .filter(([, data]) => /** @type {any} */ (data).values)
    .map(([kind, data]) => {
      const node = curve(String(kind), data);
      node.setAttribute("kind", String(kind));
      return node;
    });
  root.replaceChildren(
    h(
      "div",
      { className: "tools" },
      h("h2", {}, `Measured: ${name}`),
      alike
        ? h("label", {}, lay, "beside the simulation's spectra")
        : h(
            "span",
            { className: "note" },
            `in ${spelled(unit)}: it cannot be laid beside the simulation's spectra, in ${spelled(simulated)}`,
          ),
      h("span", { className: "spacer" }),
      h("button", { type: "button", onclick: close }, "Close"),
    ),
    h("p", { className: "used" }, (found.used ?? []).map(spelled).join("; ")),
    ...(found.warnings ?? []).map((/** @type {string} */ words) => h("p", { className: "trouble" }, `Warning: ${words}`)),
    h("p", {}, h("strong", {}, found.headline)),
    h(
      "p",
      { className: "note" },
      h("span", { className: "levels" }, (found.levels ?? []).map((/** @type {string} */ l) => spelled(l)).join(", ")),
      `; curves in ${spelled(unit)}`,
    ),
    h("div", { className: "side-by-side" }, ...curves),
    h(
      "div",
      { className: "scroll", tabIndex: 0, role: "group", "aria-label": "What was found" },
      found.table && fill(h("table"), found.table.columns, found.table.rows),
    ),
  );
  root.hidden = false;
  beside(alike);
  root.scrollIntoView({ block: "nearest" });
}
