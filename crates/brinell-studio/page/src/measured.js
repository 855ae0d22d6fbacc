// A measured signal: opened, judged by the engine, shown in the page and laid beside the simulation.
import { byId, h, short, spelled, tableOf } from "./dom.js";

/** @typedef {(request: Record<string, unknown>) => Promise<any>} Ask */

/** The dialog's answer: the form when it was agreed to, else null. @param {string} title @param {(Node | null)[]} body @param {string} go */
export function asked(title, body, go) {
  const dialog = /** @type {HTMLDialogElement} */ (byId("dialog"));
  const form = h("form", { method: "dialog" }, h("h2", { id: "dialog-title" }, title), ...body.filter((node) => node !== null),
    h("div", { className: "actions" }, h("button", { type: "submit", value: "", formNoValidate: true }, "Cancel"), h("button", { type: "submit", value: "go" }, go)));
  dialog.replaceChildren(form);
  dialog.returnValue = "";
  dialog.showModal();
  return new Promise((/** @type {(form: HTMLFormElement | null) => void} */ done) => dialog.addEventListener("close",
    () => done(dialog.returnValue === "go" ? form : null), { once: true }));
}

/** @param {string} label @param {HTMLElement} input @param {string} unit @param {string} note */
export function line(label, input, unit, note) {
  input.id ||= `ask-${label.toLowerCase().replaceAll(/\W+/g, "-")}`;
  return h("div", { className: "field plain" }, h("span", { className: "name" }, h("label", { htmlFor: input.id }, label)), input,
    h("span", { className: "unit" }, unit), note ? h("p", { className: "note" }, note) : null);
}

/** @param {string} text */
const number = (text) => (text.trim() === "" ? null : Number(text));

/**
 * Asks for what the file does not say, and has the signal judged.
 * @param {Ask} ask
 * @param {string} name
 * @param {Uint8Array<ArrayBuffer>} bytes
 * @param {{name: string, words: string}[]} bearings
 * @param {{bearing: string, rpm: number}} guess  of the bearing on the page
 */
export async function judged(ask, name, bytes, bearings, guess) {
  const { channels, run } = await ask({ do: "listen", name, bytes });
  if (!channels?.length) throw new Error(`${name} holds no signal`);
  const channel = h("select", {},
    ...channels.map((/** @type {any} */ c) => h("option", { value: c.name },
      `${c.name}, ${c.samples} samples${c.rate_hz ? ` at ${short(c.rate_hz, 6)} Hz` : ""}${c.unit ? `, ${c.unit}` : ""}`)));
  const rate = h("input", { type: "number", step: "any", min: "0" }), unit = h("input", { type: "text" }),
    rpm = h("input", { type: "number", step: "any", value: String(run?.rpm ?? (guess.rpm || "")) }),
    from = h("input", { type: "number", step: "any", min: "0", value: String(run?.from_s ?? 0) });
  const known = run ? run.bearing : guess.bearing;
  const bearing = h("select", {}, h("option", { value: "" }, run ? "that of the run" : "not known"),
    ...bearings.map((b) => h("option", { value: b.name, selected: b.name === known }, b.name)));
  const fill = () => {
    const c = channels.find((/** @type {any} */ one) => one.name === channel.value);
    rate.value = c?.rate_hz ? String(c.rate_hz) : "";
    rate.required = !c?.rate_hz;
    unit.value = c?.unit ?? "";
  };
  channel.addEventListener("change", fill);
  fill();
  const form = await asked(`Measured signal: ${name}`, [
    line("Channel", channel, "", ""), line("Sampling rate", rate, "Hz", ""), line("Unit", unit, "", "as m/s^2, g or mV; left empty: not known"),
    line("Bearing", bearing, "", "its defect frequencies are looked for"), line("Speed of the shaft", rpm, "r/min", ""),
    line("Counts from", from, "s", run ? "after the load's ramp and a turn of the shaft of the run that made the file" : "what comes before is left out"),
  ], "Judge");
  if (!form) return null;
  return ask({ do: "judge", name, bytes, channel: channel.value, rate_hz: number(rate.value), unit: unit.value || null, bearing: bearing.value || null,
    rpm: number(rpm.value), from_s: number(from.value) });
}

/**
 * Shows what the engine found in a measured signal.
 * @param {any} found
 * @param {string} name
 * @param {{beside: (on: boolean) => void, close: () => void}} act
 */
export function showMeasured(found, name, { beside, close }) {
  const root = byId("measured"), lay = h("input", { type: "checkbox", checked: true, onchange: () => beside(lay.checked) });
  const curve = (/** @type {string} */ kind, /** @type {any} */ data) => Object.assign(document.createElement("brinell-curve"), { data }), unit = found.unit ?? "";
  const curves = [["waveform", { x0: found.from_s ?? 0, dx: 1 / found.rate_hz, values: found.x, unit, lines: [], behind: null, second: null }],
    ["envelope", { x0: 0, dx: found.envelope?.df, values: found.envelope?.values, unit, lines: found.lines ?? [], behind: null, second: null }]]
    .filter(([, data]) => /** @type {any} */ (data).values)
    .map(([kind, data]) => {
      const node = curve(String(kind), data);
      node.setAttribute("kind", String(kind));
      return node;
    });
  root.replaceChildren(
    h("div", { className: "tools" }, h("h2", {}, `Measured: ${name}`), h("label", {}, lay, "beside the simulation's spectra"), h("span", { className: "spacer" }),
      h("button", { type: "button", onclick: close }, "Close")),
    h("p", {}, h("strong", {}, found.headline)),
    h("div", { className: "side-by-side" }, ...curves,
      h("div", { className: "scroll", tabIndex: 0, role: "group", "aria-label": "What was found" }, tableOf(found.table))),
    h("p", { className: "note" }, found.moments
      ? `RMS ${short(found.moments.rms)} ${spelled(unit)}, peak ${short(found.moments.peak)} ${spelled(unit)}, kurtosis ${short(found.moments.kurtosis)}` : ""));
  root.hidden = false;
  beside(true);
  root.scrollIntoView({ block: "nearest" });
}
