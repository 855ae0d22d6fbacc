// Small helpers for elements and numbers on the page.
import { short } from "./chart.js";

/**
 * An element with properties (aria-* and data-* as attributes) and children.
 * @template {keyof HTMLElementTagNameMap} T
 * @param {T} tag
 * @param {Record<string, unknown>} [props]
 * @param {...(Node | string | null | undefined)} children
 * @returns {HTMLElementTagNameMap[T]}
 */
export function h(tag, props = {}, ...children) {
  const node = document.createElement(tag);
  for (const [key, value] of Object.entries(props)) {
    if (value === undefined || value === null) continue;
    if (key.startsWith("on") && typeof value === "function") node.addEventListener(key.slice(2), /** @type {EventListener} */ (value));
    else if (key in node && !key.includes("-")) /** @type {any} */ (node)[key] = value;
    else node.setAttribute(key, String(value));
  }
  for (const child of children) if (child !== null && child !== undefined) node.append(child);
  return node;
}

/**
 * The element with this id, which index.html has.
 * @param {string} id
 * @returns {any}
 */
export function byId(id) {
  const node = document.getElementById(id);
  if (!node) throw new Error(`no #${id} in the page`);
  return node;
}

/** As many digits as the width of an interval needs two of, three at least. @param {number} low @param {number} high */
export const digitsOf = (low, high) =>
  Math.min(12, Math.max(3, 2 + Math.floor(Math.log10(Math.max(Math.abs(low), Math.abs(high)))) - Math.floor(Math.log10(high - low))));

/** The number that a text says, with a point or a comma before its decimals; else, in words, why it says none. @param {string} text @returns {number | string} */
export function numberOf(text) {
  const plain = text.trim().replaceAll("−", "-");
  if (/^[-+]?[1-9]\d{0,2},\d{3}$/.test(plain)) return `"${plain}" may be ${plain.replace(",", ".")} or ${plain.replace(",", "")}`;
  return /^[-+]?(\d+([.,]\d*)?|[.,]\d+)(e[-+]?\d+)?$/i.test(plain) ? Number(plain.replace(",", ".")) : `"${plain}" is no number`;
}

/**
 * A field for a number: of text, as a browser's own drops what it cannot read. Arrow keys step, by a digit of the number where that is finer than
 * the step, and not below the least; no form goes on with what is no number.
 * @param {Record<string, unknown>} props
 */
export function numberInput(props, step = 1, least = -Infinity) {
  const box = h("input", { type: "text", inputMode: "decimal", autocomplete: "off", spellcheck: false, ...props });
  box.addEventListener("input", () => {
    const said = numberOf(box.value);
    box.setCustomValidity(box.value.trim() && typeof said === "string" ? said : "");
  });
  box.addEventListener("keydown", (e) => {
    const way = e.key === "ArrowUp" ? 1 : e.key === "ArrowDown" ? -1 : 0,
      said = numberOf(box.value || "0");
    if (!way || typeof said === "string") return;
    e.preventDefault();
    const next = stepped(said, way, step);
    if (next < said && next < least) return;
    box.value = String(next);
    box.dispatchEvent(new Event("change"));
  });
  return box;
}

/** A step from a number, up (1) or down (-1): from 0.4 by 0.1, from 0.1 down by 0.01. @param {number} from @param {number} way @param {number} step */
export function stepped(from, way, step) {
  // Towards 0 from a power of ten, its digit is the next finer one.
  const size = Math.abs(from) * (from * way < 0 ? 1 - 1e-9 : 1);
  return Number((from + way * (size ? Math.min(step, 10 ** Math.floor(Math.log10(size))) : step)).toPrecision(12));
}

/** Damaged places, in words. @param {number} count */
export const places = (count) => `${count} ${count === 1 ? "place" : "places"}`;

/** @param {string} unit */
export const spelled = (unit) =>
  unit
    .replaceAll("^2", "²")
    .replaceAll("^3", "³")
    .replaceAll("^n", "ⁿ")
    .replace(/\bdeg\b/g, "°")
    .replace(/\bum\b/g, "µm");

/** Whether the reader asked for little motion. */
export const still = () => matchMedia("(prefers-reduced-motion: reduce)").matches;

/** Head and body of a table anew. @param {HTMLTableElement} table @param {string[]} columns @param {unknown[][]} rows */
export function fill(table, columns, rows) {
  const cell = (/** @type {unknown} */ v) => (typeof v === "number" ? short(v, 4) : v === null || v === undefined ? "" : String(v));
  table.replaceChildren(
    h("thead", {}, h("tr", {}, ...columns.map((c) => h("th", { scope: "col" }, c)))),
    h(
      "tbody",
      {},
      ...rows.map((row) =>
        h(
          "tr",
          {},
          ...row.map((v, k) =>
            k === 0 ? h("th", { scope: "row" }, cell(v)) : h("td", { className: typeof v === "number" ? "number" : "" }, cell(v)),
          ),
        ),
      ),
    ),
  );
  return table;
}
