// Controls of keys: a range and a number with its unit, its reason, and the engine's words where a value is refused.
import { short } from "./chart.js";
import { h, numberInput, numberOf } from "./dom.js";
import { mainSpecs, moreSpecs } from "./schema.js";
import { get } from "./state.js";

/** @typedef {import("./schema.js").Spec} Spec */
/** @typedef {(spec: Spec, value: any, live: boolean) => void} Changed  live: the hand is still on it */

const STEPS = 400;
let count = 0;

export class Field {
  /** @type {HTMLInputElement | HTMLSelectElement | null} */
  #input = null;
  /** @type {HTMLInputElement | null} */
  #range = null;
  #trouble;
  #clear;
  /** @type {[number, number]} */
  #span = [0, 1];
  /** Why what is typed is not read; then it is no part of the scenario. */
  unread = "";
  #said = "";
  /** What the number's field shows, unless the hand is on it. */
  #shown = "";
  /** Something was typed that is not taken yet. */
  #typing = false;
  /** What must be stated was taken out: no other value is shown in its place. */
  #emptied = false;
  /** @type {unknown} */
  #held;

  /** @param {Spec} spec @param {Changed} changed @param {{note?: boolean, range?: boolean}} [show] words below, and a range where none is stated */
  constructor(spec, changed, { note: noted = true, range = true } = {}) {
    this.spec = spec;
    this.changed = changed;
    this.id = `field-${++count}`;
    this.#span = spec.span ?? [0, 1];
    this.#trouble = h("p", { className: "trouble", role: "alert", id: `${this.id}-trouble` });
    this.#clear = h(
      "button",
      {
        type: "button",
        className: "clear",
        hidden: true,
        title: "Back to the default",
        "aria-label": `${spec.label}: back to the default`,
        onclick: () => changed(spec, undefined, false),
      },
      "default",
    );
    this.#make(range);
    const label = h("span", { className: "name" }, h("label", { htmlFor: this.id }, spec.label), this.#clear);
    const note = !noted || !spec.note ? null : h("p", { className: "note", id: `${this.id}-note` }, spec.note);
    this.#input?.setAttribute("aria-describedby", `${note ? `${note.id} ` : ""}${this.#trouble.id}`);
    this.element = h(
      "div",
      { className: this.#range ? "field" : "field plain", title: spec.note },
      label,
      this.#range,
      this.#input,
      h("span", { className: "unit" }, spec.unit),
      note,
      this.#trouble,
    );
  }

  /** @param {boolean} ranged */
  #make(ranged) {
    const { spec, id } = this,
      take = (/** @type {any} */ value, live = false) => this.changed(spec, value, live);
    if (spec.kind === "choice")
      this.#input = h(
        "select",
        { id, onchange: () => take(this.#input?.value || undefined) },
        ...(spec.options ?? []).map(([value, words]) => h("option", { value }, words)),
      );
    else if (spec.kind === "flag") {
      const box = h("input", { id, type: "checkbox", onchange: () => take(box.checked) });
      this.#input = box;
    } else if (spec.kind === "text") {
      const box = h("input", {
        id,
        type: "text",
        spellcheck: false,
        onchange: () => take(spec.words ? box.value.trim() || undefined : parsed(box.value)),
      });
      this.#input = box;
    } else {
      const box = numberInput({ id, onchange: () => this.#typed(box, take) }, 1, spec.min);
      // A browser tells no change where the text is again what the page had put there.
      const rest = () => {
        if (this.#typing) this.#typed(box, take);
      };
      box.addEventListener("input", () => {
        this.#typing = true;
      });
      box.addEventListener("blur", rest);
      box.addEventListener("keydown", (e) => {
        if (e.key === "Enter") rest();
      });
      this.#input = box;
      if (spec.span || ranged) this.#range = this.#slider(take);
    }
  }

  /** Takes what was typed once it is whole. @param {HTMLInputElement} box @param {(value: number | string | undefined) => void} take */
  #typed(box, take) {
    const { spec } = this,
      { units } = spec;
    // A quantity of the scenario may have its unit with it ("25 Hz"): the engine reads that; what the page makes a key of, the page.
    const [, size, named] = /^(.*?\d[.,]?)\s*([a-zµ°%].*)$/i.exec(spec.united || units ? box.value.trim() : "") ?? [],
      whole = numberOf(box.value);
    const unit = typeof whole === "string" ? named : undefined,
      empty = box.value.trim() === "",
      number = unit ? numberOf(size) : whole;
    const said = unit && units && typeof number === "number" ? inUnit(number, unit, units) : number,
      shown = unit || spec.unit;
    this.#typing = false;
    this.unread =
      !empty && typeof said === "string"
        ? `${said}${shown && said === number ? ` (${shown})` : ""}`
        : (spec.refuse?.(empty ? undefined : Number(said)) ?? "");
    box.setCustomValidity(this.unread);
    this.say(this.#said);
    if (this.unread) return;
    const value = empty ? undefined : unit && !units ? `${said} ${unit}` : said;
    this.#shown = box.value = String(value ?? "");
    this.#emptied = empty && !!spec.required;
    // The page draws it with the next frame: what is typed until then and not read stays.
    this.#held = value;
    take(value);
  }

  /** Puts back what was taken last, in place of what is typed and not taken or not read: whether there was something. */
  restore() {
    const box = this.#input;
    if (!(box instanceof HTMLInputElement) || this.spec.kind !== "number" || !(this.unread || (this.#typing && box.value !== this.#shown)))
      return false;
    this.#typing = false;
    this.unread = "";
    box.value = this.#shown;
    box.setCustomValidity("");
    this.say(this.#said);
    return true;
  }

  /** @param {(value: number, live: boolean) => void} take */
  #slider(take) {
    const range = h("input", {
      type: "range",
      min: "0",
      max: String(STEPS),
      "aria-label": `${this.spec.label}, range`,
    });
    const value = () => {
      const w = range.valueAsNumber / STEPS,
        [a, b] = this.#span;
      const v = this.spec.log && a > 0 ? a * (b / a) ** w : a + w * (b - a);
      // Round numbers: three digits, or a step of the span.
      const rounded =
        this.spec.log && a > 0
          ? Number(v.toPrecision(3))
          : Number((Math.round(v / nice((b - a) / STEPS)) * nice((b - a) / STEPS)).toPrecision(10));
      return this.spec.integer ? Math.round(rounded) : rounded;
    };
    range.addEventListener("input", () => take(value(), true));
    range.addEventListener("change", () => take(value(), false));
    return range;
  }

  /** Shows what is wanted, or what holds where nothing is stated. @param {any} wanted @param {any} all @param {any} [opened] what the engine read `all` from */
  update(wanted, all, opened) {
    const read = this.spec.read(wanted),
      input = this.#input;
    // A number that is stated as a text with its unit shows as the engine read it, once it has.
    const number = this.spec.kind === "number",
      stated = number && typeof read === "string" && !this.#said && read === this.spec.read(opened) ? undefined : read;
    if (read !== undefined) this.#emptied = false;
    // While a key is refused the last good bearing's value is not what is wanted.
    const known = this.spec.read(all) ?? this.spec.fallback,
      holds = stated ?? (number && (this.#emptied || this.#said) ? undefined : known);
    this.#clear.hidden =
      get(wanted, this.spec.path) === undefined ||
      !!this.spec.required ||
      !(typeof this.spec.path[0] === "string") ||
      this.spec.path[0] === "defects";
    if (!input) return;
    if (this.spec.other)
      /** @type {HTMLInputElement} */ (input).placeholder =
        this.spec.read(wanted) === undefined ? String(this.spec.other(wanted) ?? "") : "";
    if (input instanceof HTMLInputElement && input.type === "checkbox") input.checked = holds === true;
    else if (input !== document.activeElement || (number && input.value === this.#shown)) {
      // What is not read stays until the key has another value.
      if (this.unread && holds !== this.#held) this.say((this.unread = ""));
      const text =
        holds === undefined || holds === null
          ? ""
          : number && stated === undefined && typeof read === "string"
            ? String(Number(holds.toPrecision(7)))
            : this.spec.kind === "text" && typeof holds !== "string"
              ? JSON.stringify(holds)
              : String(holds);
      if (!this.unread && input.value !== text) input.value = text;
      this.#shown = text;
      this.#held = holds;
    }
    if (this.#range) this.#place(typeof holds === "number" ? holds : known);
  }

  /** @param {any} holds */
  #place(holds) {
    const range = /** @type {HTMLInputElement} */ (this.#range),
      known = typeof holds === "number";
    range.disabled = !known;
    if (!known) return;
    if (!this.spec.span && range !== document.activeElement) this.#span = spanOf(holds, this.spec);
    // A value beyond the range widens it, unless the hand is on it.
    if (this.spec.span && range !== document.activeElement)
      this.#span = [
        Math.min(this.spec.span[0], this.spec.log && holds <= 0 ? this.spec.span[0] : holds),
        Math.max(this.spec.span[1], holds),
      ];
    const [a, b] = this.#span,
      w = this.spec.log && a > 0 ? Math.log(Math.max(holds, a) / a) / Math.log(b / a) : (holds - a) / (b - a);
    const at = String(Math.round(STEPS * Math.min(1, Math.max(0, w))));
    if (range.value !== at && range !== document.activeElement) range.value = at;
    range.setAttribute("aria-valuetext", `${short(holds, 4)} ${this.spec.unit}`);
  }

  /** The engine's words about this key, or nothing. @param {string} words */
  say(words) {
    this.#said = words;
    const shown = this.unread || words;
    if (this.#trouble.textContent !== shown) this.#trouble.textContent = shown;
    if (shown) this.#input?.setAttribute("aria-invalid", "true");
    else this.#input?.removeAttribute("aria-invalid");
  }

  focus() {
    this.#input?.focus();
  }
}

/** A number of so many units; else, in words, which there are. @param {number} number @param {string} unit @param {Record<string, number>} units */
function inUnit(number, unit, units) {
  return unit in units
    ? Number((number * units[unit]).toPrecision(14))
    : `no unit here is called "${unit}"; allowed: ${Object.keys(units).join(", ")}`;
}

/** Lists and tables are typed as JSON; anything else is a word. @param {string} text */
function parsed(text) {
  if (text.trim() === "") return undefined;
  try {
    return JSON.parse(text);
  } catch {
    return text;
  }
}

/** A round step at most this wide. @param {number} width */
function nice(width) {
  const power = 10 ** Math.floor(Math.log10(width));
  return power * ([5, 2, 1].find((m) => m * power <= width * (1 + 1e-9)) ?? 1);
}

/** @param {number} value @param {Spec} spec @returns {[number, number]} */
function spanOf(value, spec) {
  if (spec.log && value > 0) return [value / 10, Math.min(value * 10, spec.max ?? Infinity)];
  const reach = Math.abs(value) || 1,
    low = spec.min ?? (value < 0 ? 4 * value : 0);
  return [low, Math.min(spec.max !== undefined && spec.max <= 1000 * reach ? spec.max : Infinity, value > 0 ? 4 * value : reach)];
}

export class Controls {
  /** @type {Field[]} */
  fields = [];

  /** @param {HTMLElement} root @param {any} schema @param {Changed} changed */
  constructor(root, schema, changed) {
    const make = (/** @type {Spec} */ s) => {
      const field = new Field(s, changed);
      this.fields.push(field);
      return field.element;
    };
    const name = h("div", { className: "fields" }, ...mainSpecs(schema).map(make));
    const sections = moreSpecs(schema).map((section) =>
      h(
        "details",
        { className: "section" },
        h("summary", {}, section.name.charAt(0).toUpperCase() + section.name.slice(1)),
        h("p", { className: "note" }, section.note),
        h("div", { className: "fields" }, ...section.specs.map(make)),
      ),
    );
    const why = h(
      "button",
      {
        type: "button",
        className: "why",
        "aria-pressed": "false",
        onclick: () => why.setAttribute("aria-pressed", String(root.classList.toggle("reasons"))),
      },
      "Explain",
    );
    root.replaceChildren(
      h("div", { className: "tools" }, h("h2", {}, "Run"), h("span", { className: "spacer" }), why),
      name,
      h("details", {}, h("summary", {}, "More: every key of the scenario"), ...sections),
    );
  }

  /** @param {any} wanted @param {{scenario: any, all: any}} opened */
  update(wanted, { scenario, all }) {
    for (const field of this.fields) field.update(wanted, all, scenario);
  }
}

/**
 * Lays the engine's problems beside the fields that they are about, and gives back those that have none.
 * @param {Field[]} fields
 * @param {{path: (string | number)[], message: string}[]} problems
 */
export function lay(fields, problems) {
  const rest = new Set(problems);
  for (const field of fields) {
    const path = field.spec.path;
    const mine = problems.filter(
      (p) =>
        p.path.length > 0 &&
        rest.has(p) &&
        path.every((key, k) => k >= p.path.length || p.path[k] === key) &&
        p.path.length >= Math.min(path.length, 2) &&
        path.length <= p.path.length + 1,
    );
    const own = mine.filter((p) => p.path.length >= path.length);
    for (const p of own) rest.delete(p);
    field.say(own.map((p) => p.message).join(" "));
    const closed = own.length ? field.element.closest("details:not([open])") : null;
    for (let node = closed; node; node = node.parentElement?.closest("details:not([open])") ?? null)
      /** @type {HTMLDetailsElement} */ (node).open = true;
  }
  return [...rest];
}
