// The buttons and boxes of the panel over the raceway: tools with their hints, numbers with their limits.
import { short } from "./chart.js";
import { numberInput, numberOf } from "./dom.js";
import { notice } from "./notices.js";

/** @typedef {import("./tools.js").Tool} Tool */

/** @type {[Tool, string, string, string][]} tool, name, key, icon */
export const TOOLS = [
  ["select", "Select", "V", "M3 2l9 5-4 1.2L6 12z"],
  ["pen", "Pen", "P", "M2 13l1-4 7-7 3 3-7 7z"],
  ["points", "Points", "O", "M3 11L5 3l8 2-2 8z"],
  ["brush", "Depth", "B", "M2 12c3 0 3-2 4-4l6-6 1 1-6 6c-1 3-3 4-5 3z"],
  ["rectangle", "Rectangle", "R", "M2 4h11v7H2z"],
  ["circle", "Circle", "C", "M7.5 2a5.5 5.5 0 1 1 0 11a5.5 5.5 0 1 1 0-11z"],
  ["paper", "Irregular", "I", "M2 8c1-4 2-2 4-4s4 0 7 3c-2 4-4 2-6 4S3 11 2 8z"],
];
export const HINTS = {
  select: "Drag damage to move it, its handles to size it. Arrows 1° / 0.1 mm, Shift ×10; [ ] depth; Del deletes.",
  pen: "Scratch the raceway: the bearing runs on while you draw. A click makes a dot; Esc takes back what is being drawn.",
  points:
    "Click at least three corners; Enter, a double click or the first corner closes the outline. Backspace takes a corner back, Esc drops them.",
  brush: "Paint depth; on a selected depth map it adds to it.",
  rectangle: "Drag from corner to corner, or click for 3 × 4 mm. Esc while dragging takes it back.",
  circle: "Drag from the centre to the rim, or click for 3 mm. Esc while dragging takes it back.",
  paper: "The irregular spall of Li et al. (2023): click, or drag its width. Esc while dragging takes it back.",
};
export const DEEPER = 1.1;

/** @param {string} path */
export function icon(path) {
  const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg"),
    line = document.createElementNS("http://www.w3.org/2000/svg", "path");
  svg.setAttribute("viewBox", "0 0 15 15");
  svg.setAttribute("aria-hidden", "true");
  line.setAttribute("d", path);
  svg.append(line);
  return svg;
}

/** @param {number} s @param {number} turn */
export const degrees = (s, turn) => {
  const deg = (s / turn) * 360;
  return Number((deg - 360 * Math.round(deg / 360)).toFixed(3));
};

/** A box for a number, which says what it does not take. */
export function numberBox(
  /** @type {string} */ label,
  /** @type {number} */ step,
  /** @type {() => number} */ most,
  /** @type {() => number} */ now,
  /** @type {(value: number) => void} */ take,
) {
  const why = () => {
    const said = numberOf(box.value);
    return typeof said === "string" ? said : said > 0 && said <= most() ? "" : `expected more than 0 and at most ${short(most())}`;
  };
  const box = numberInput(
    {
      className: "narrow-number",
      value: String(now()),
      "aria-label": label,
      oninput: () => box.setAttribute("aria-invalid", String(why() !== "")),
      onchange: () => {
        const wrong = why();
        if (!wrong) take(Number(numberOf(box.value)));
        notice("size", wrong ? `${label}: ${wrong}; ${now()} stays` : null, { bad: true });
        box.value = String(now());
        box.setAttribute("aria-invalid", "false");
      },
    },
    step,
  );
  return box;
}
