// What the curves and the passage share: a plot in its box with words, a table of values and a cursor by keys; axes on any pen.
import { h } from "../dom.js";
import { font, path } from "./pen.js";
import { sheet } from "./theme.js";
import { seldom, View } from "./view.js";

/** @typedef {import("./pen.js").Pen} Pen */
/** @typedef {import("./theme.js").Colours} Colours */
/** @typedef {{ left: number, top: number, width: number, height: number }} Frame place of the plot's inside in its box, px */
/** @typedef {[number, string][]} Ticks */
/** @typedef {{ x: [number, number], y: [number, number], xTicks: Ticks, yTicks: Ticks }} Axes */

const plotted = sheet(`
:host { display: flex; flex-direction: column; }
.plot { position: relative; border-radius: 4px; }
.plot:focus-visible { outline-offset: -1px; }
`);

export class PlotView extends View {
  /** @param {CSSStyleSheet} own @param {string} none what is said without data @param {string} help what keys do */
  constructor(own, none, help) {
    super(own);
    this.root.adoptedStyleSheets.push(plotted);
    this.canvas = h("canvas", { "aria-hidden": "true" });
    this.readout = h("span", { class: "readout" });
    this.empty = h("div", { class: "empty" }, none);
    this.box = h(
      "div",
      { class: "plot", tabindex: "0", role: "application", "aria-roledescription": "plot", "aria-description": help },
      this.canvas,
      this.empty,
    );
    this.said = h("div", { class: "hidden", role: "status" });
    this.table = h("table");
    this.details = h(
      "details",
      {},
      h("summary", {}, "Values"),
      h("div", { class: "scroll", tabindex: "0", role: "group", "aria-label": "Values" }, this.table),
    );
    this.root.append(this.box, h("div", { class: "foot" }, this.details, this.readout), this.said);
    this.speakSoon = seldom(300, () => {
      this.said.textContent = this.readout.textContent;
    });
    this.details.addEventListener("toggle", () => this.tabulate());
    this.box.addEventListener("blur", () => this.point(null));
    this.box.addEventListener("keydown", (event) => {
      const act = event.ctrlKey || event.metaKey || event.altKey ? undefined : this.key(event);
      if (!act) return;
      event.preventDefault();
      event.stopPropagation();
      act();
    });
  }
  connectedCallback() {
    super.connectedCallback();
    this.sizes.observe(this.box);
  }
  /** Where the cursor is; null takes it away. @param {number | null} _place */
  point(_place) {}
  /** What a key does. @param {KeyboardEvent} _event @returns {(() => void) | undefined} */
  key(_event) {
    return undefined;
  }
  tabulate() {}
}

/** @param {Pen} pen @param {Frame} frame @param {Axes} axes @param {Colours} colours @param {(px: number) => number} [sharp] where a line of the grid is drawn */
export function paintAxes(pen, frame, axes, colours, sharp = (px) => px) {
  const { left, top, width, height } = frame,
    right = left + width,
    bottom = top + height;
  pen.strokeStyle = colours.grid;
  pen.lineWidth = 1;
  pen.fillStyle = colours.faint;
  pen.font = font(11);
  for (const [v, label] of axes.xTicks) {
    const x = left + (width * (v - axes.x[0])) / (axes.x[1] - axes.x[0]);
    path(pen, [
      [sharp(x), top],
      [sharp(x), bottom],
    ]);
    pen.stroke();
    pen.textAlign = "center";
    if (label) pen.fillText(label, x, bottom + 15);
  }
  for (const [v, label] of axes.yTicks) {
    const y = bottom - (height * (v - axes.y[0])) / (axes.y[1] - axes.y[0]);
    path(pen, [
      [left, sharp(y)],
      [right, sharp(y)],
    ]);
    pen.stroke();
    pen.textAlign = "right";
    pen.fillText(label, left - 5, y + 4);
  }
  pen.textAlign = "start";
}
