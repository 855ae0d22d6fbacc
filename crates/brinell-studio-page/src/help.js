// Keys and gestures, in a dialog.
import { byId, h } from "./dom.js";

const KEYS = [
  [
    "On the raceway",
    [
      ["V P O B R C I", "select, pen, points, depth brush, rectangle, circle, irregular spall"],
      ["Enter", "places the tool's shape; pen and brush down and up; a corner, twice on one closes; closes corners that were clicked"],
      ["Arrows", "move the selected damage 1° or 0.1 mm, Shift ten times as far; without one, the place to draw"],
      ["[ ]", "shallower, deeper"],
      ["Delete", "deletes the damage"],
      ["Page up, page down", "the damage before, the next one"],
      ["+ − 0", "zoom in, out, fit"],
      ["Escape", "takes back what is being drawn; else lets go"],
    ],
  ],
  [
    "Anywhere",
    [
      ["Ctrl-Z, Ctrl-Shift-Z", "undo, redo"],
      ["Space, L", "pause, live"],
      ["Escape", "cancels a run from t = 0"],
      ["H", "hear"],
      ["A, B", "the bearing that is edited"],
      ["?", "these keys"],
    ],
  ],
  [
    "By hand",
    [
      ["One finger", "draws"],
      ["Two fingers", "move and zoom the raceway"],
      ["Drop a file", "photo, SVG or depth map of damage, scenario, measured signal"],
    ],
  ],
];

export function showKeys() {
  const dialog = /** @type {HTMLDialogElement} */ (byId("dialog"));
  dialog.replaceChildren(
    h("h2", { id: "dialog-title" }, "Keys and gestures"),
    ...KEYS.flatMap(([title, rows]) => [
      h("h3", {}, String(title)),
      h("dl", { className: "keys" }, .../** @type {string[][]} */ (rows).flatMap(([key, words]) => [h("dt", {}, key), h("dd", {}, words)])),
    ]),
    h("form", { method: "dialog", className: "actions" }, h("button", { type: "submit" }, "Close")),
  );
  dialog.showModal();
}
