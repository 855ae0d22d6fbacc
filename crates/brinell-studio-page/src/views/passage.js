// <brinell-passage>: one roller's passage over the damage: contact length and force over the roller's place.
import { nearestOf, short, ticks } from "../chart.js";
import { fill, h } from "../dom.js";
import { fit } from "./view.js";
import { sheet } from "./theme.js";
import { font, path } from "./pen.js";
import { paintAxes, PlotView } from "./plot.js";
import { roundUp } from "./scale.js";

/** @typedef {{ s_mm: Float32Array, length_mm: Float32Array, force_n: Float32Array, healthy_n: number, width_mm: number }} Passage */
/** @typedef {import("./pen.js").Pen} Pen */
/** @typedef {import("./theme.js").Colours} Colours */
/**
 * @typedef {{ left: number, top: number, width: number, height: number, name: string, unit: string, values: Float32Array, full: number, fullName: string, most:
 * number, colour: string }} Panel
 */

const ROOM = { left: 46, right: 22, bottom: 22, head: 18, gap: 8 };
const own = sheet(`
.plot { flex: 1 0 var(--plot-height, 230px); cursor: crosshair; touch-action: pan-y; }
`);

export class BrinellPassage extends PlotView {
  constructor() {
    super(own, "no damage chosen", "Arrow keys move the cursor, Shift moves it further");
    /** @type {Passage | null} */
    this.held = null;
    /** @type {number | null} Index of the cursor. */
    this.index = null;
    this.root.prepend(h("div", { class: "head" }, h("span", { class: "title" }, "One roller's passage")));
    this.box.addEventListener("pointermove", (event) => this.point(this.indexAt(event.clientX - this.box.getBoundingClientRect().left)));
    this.box.addEventListener("pointerdown", (event) => this.point(this.indexAt(event.clientX - this.box.getBoundingClientRect().left)));
    this.box.addEventListener("pointerleave", () => {
      if (this.root.activeElement !== this.box) this.point(null);
    });
  }
  connectedCallback() {
    super.connectedCallback();
    this.describe();
  }
  /** @returns {Passage | null} */
  get data() {
    return this.held;
  }
  set data(data) {
    this.held = data && data.s_mm?.length > 1 ? data : null;
    if (this.index !== null && this.held) this.index = Math.min(this.index, this.held.s_mm.length - 1);
    this.describe();
    this.tabulate();
    this.requestDraw();
  }

  /** @param {number} px */
  indexAt(px) {
    const data = this.held;
    if (!data) return null;
    const share = (px - ROOM.left) / (this.box.clientWidth - ROOM.left - ROOM.right),
      last = data.s_mm.length - 1,
      s = data.s_mm[0] + share * (data.s_mm[last] - data.s_mm[0]);
    return nearestOf(data.s_mm, s);
  }
  /** @param {number | null} index */
  point(index) {
    this.index = index;
    this.readout.textContent = index === null ? "" : this.words(index);
    this.requestDraw();
  }
  /** @param {number} i */
  words(i) {
    const d = this.held;
    return d
      ? `${short(d.s_mm[i], 3)} mm · contact ${short(d.length_mm[i], 3)} of ${short(d.width_mm, 3)} mm · ${short(d.force_n[i], 3)} N`
      : "";
  }
  /** @param {KeyboardEvent} event */
  key(event) {
    const data = this.held;
    if (!data) return undefined;
    const last = data.s_mm.length - 1,
      at = this.index ?? Math.round(last / 2),
      stride = Math.max(1, Math.round(last / 200)) * (event.shiftKey ? 10 : 1);
    const to = { ArrowLeft: at - stride, ArrowRight: at + stride, Home: 0, End: last }[event.key];
    return to === undefined
      ? undefined
      : () => {
          this.point(Math.min(Math.max(to, 0), last));
          this.speakSoon();
        };
  }

  draw() {
    this.empty.hidden = !!this.held;
    const room = fit(this.canvas, this.box);
    if (room) this.paint(room.pen, room.width, room.height, this.colours, this.index);
  }
  /** @param {Pen} pen @param {number} width @param {number} height @param {Colours} colours @param {number | null} index */
  paint(pen, width, height, colours, index) {
    const data = this.held;
    if (!data) return;
    const each = (height - ROOM.bottom - ROOM.gap - 2 * ROOM.head) / 2,
      across = { left: ROOM.left, width: width - ROOM.left - ROOM.right, height: each };
    if (each < 20 || across.width < 40) return;
    const most = (/** @type {Float32Array} */ values, /** @type {number} */ full) =>
      roundUp(1.08 * values.reduce((a, v) => Math.max(a, v), Math.max(full, 1e-9)));
    this.panel(
      pen,
      {
        ...across,
        top: ROOM.head,
        name: "Contact length",
        unit: "mm",
        values: data.length_mm,
        full: data.width_mm,
        fullName: "full width",
        most: most(data.length_mm, data.width_mm),
        colour: colours.blue,
      },
      colours,
      index,
      false,
    );
    this.panel(
      pen,
      {
        ...across,
        top: 2 * ROOM.head + each + ROOM.gap,
        name: "Contact force",
        unit: "N",
        values: data.force_n,
        full: data.healthy_n,
        fullName: "healthy",
        most: most(data.force_n, data.healthy_n),
        colour: colours.inner,
      },
      colours,
      index,
      true,
    );
  }
  /** @param {Pen} pen @param {Panel} panel @param {Colours} colours @param {number | null} index @param {boolean} labels */
  panel(pen, panel, colours, index, labels) {
    const data = /** @type {Passage} */ (this.held),
      { left, top, width, height, values } = panel,
      bottom = top + height,
      [from, to] = [data.s_mm[0], data.s_mm[data.s_mm.length - 1]];
    const X = (/** @type {number} */ s) => left + (width * (s - from)) / (to - from),
      Y = (/** @type {number} */ v) => bottom - (height * v) / panel.most;
    const stroke = (/** @type {[number, number][]} */ points, /** @type {string} */ colour, wide = 1) => {
      pen.strokeStyle = colour;
      pen.lineWidth = wide;
      path(pen, points);
      pen.stroke();
    };
    pen.setLineDash([]);
    const xTicks = ticks(from, to, Math.min(9, width / 60)),
      last = xTicks.length - 1;
    paintAxes(
      pen,
      panel,
      {
        x: [from, to],
        y: [0, panel.most],
        yTicks: ticks(0, panel.most, Math.max(2, height / 20)),
        xTicks: xTicks.map(([v, label], k) => [v, !labels ? "" : k === last ? `${label} mm` : label]),
      },
      colours,
    );
    pen.fillStyle = colours.text;
    pen.font = font(11, 600);
    pen.fillText(`${panel.name}, ${panel.unit}`, left, top - 5);
    pen.setLineDash([4, 3]);
    stroke(
      [
        [left, Y(panel.full)],
        [left + width, Y(panel.full)],
      ],
      colours.frame,
    );
    pen.setLineDash([]);
    pen.font = font(11);
    pen.fillStyle = colours.faint;
    pen.textAlign = "right";
    pen.fillText(`– – ${panel.fullName}, ${short(panel.full, 3)} ${panel.unit}`, left + width, top - 5);
    pen.textAlign = "start";
    pen.lineJoin = "round";
    pen.beginPath();
    pen.moveTo(left, bottom);
    for (let i = 0; i < values.length; i++) pen.lineTo(X(data.s_mm[i]), Y(values[i]));
    pen.lineTo(left + width, bottom);
    pen.globalAlpha = 0.09;
    pen.fillStyle = panel.colour;
    pen.fill();
    pen.globalAlpha = 1;
    stroke(
      Array.from(values, (v, i) => [X(data.s_mm[i]), Y(v)]),
      panel.colour,
      1.5,
    );
    stroke(
      [
        [left, bottom],
        [left + width, bottom],
      ],
      colours.frame,
    );
    if (index === null) return;
    const x = X(data.s_mm[index]);
    pen.globalAlpha = 0.6;
    stroke(
      [
        [x, top],
        [x, bottom],
      ],
      colours.ink,
    );
    pen.globalAlpha = 1;
    pen.fillStyle = colours.ink;
    pen.beginPath();
    pen.arc(x, Y(values[index]), 3.5, 0, 2 * Math.PI);
    pen.fill();
  }

  sentence() {
    const d = this.held;
    if (!d) return "One roller's passage: no damage chosen";
    return `One roller's passage over the damage: contact length in mm and force in N over the roller's place, ${short(d.s_mm[0], 3)} to ${short(d.s_mm[d.s_mm.length - 1], 3)} mm from the centre. Full width ${short(d.width_mm, 3)} mm, force of the healthy contact ${short(d.healthy_n, 3)} N.`;
  }
  describe() {
    this.box.setAttribute("aria-label", this.sentence());
  }
  tabulate() {
    const d = this.held;
    if (!d || !this.details.open) return;
    const last = d.s_mm.length - 1,
      rows = [...new Set(Array.from({ length: 25 }, (_, k) => Math.round((last * k) / 24)))];
    fill(
      this.table,
      ["s, mm", "contact length, mm", "force, N"],
      rows.map((i) => [short(d.s_mm[i], 4), short(d.length_mm[i], 4), short(d.force_n[i], 4)]),
    );
  }
  picture() {
    const width = Math.max(420, this.box.clientWidth),
      height = Math.max(240, this.box.clientHeight);
    return {
      width,
      height,
      title: this.sentence(),
      paint: (/** @type {Pen} */ pen, /** @type {Colours} */ colours) => this.paint(pen, width, height, colours, null),
    };
  }
}
customElements.define("brinell-passage", BrinellPassage);
