// What a curve's view shows: range, axes, and the curves themselves.
import { decibel, short, ticks } from "../chart.js";
import { path } from "./pen.js";
import { PlotView } from "./plot.js";
import { Limit } from "./scale.js";
import { labelRoom, paintBand, paintLines, part, STRIP, trace, tracePath } from "./trace.js";

/** @typedef {import("./trace.js").Curve} Curve */
/** @typedef {import("./trace.js").Line} Line */
/**
 * @typedef {Curve & { unit: string, lines?: Line[], band_hz?: [number, number] | null, behind?: Curve | null, second?: Curve | null, names?: string[], settled?: number, stored?: boolean }} CurveData
 * x in s or Hz; `stored`: of no bearing that runs; `settled` where a waveform's first view begins; `behind` the healthy bearing, `second` the bearing B
 */

/** The logarithmic axis shows this much, dB. */
const DEPTH = 80;
/** The envelope opens on so many multiples of the highest nominal frequency. */
const ENVELOPE_ORDERS = 5.6;
/** Room around the frame, px. */
export const ROOM = { top: 8, right: 22, bottom: 20, left: 46 };

export class CurveDrawing extends PlotView {
  /** @param {CSSStyleSheet} style @param {string} waiting @param {string} help */
  constructor(style, waiting, help) {
    super(style, waiting, help);
    /** @type {CurveData | null} */
    this.held = null;
    /** Ends of the zoom counted from the curve's start; null shows the home view. @type {[number, number] | null} */
    this.zoomed = null;
    this.log = false;
    this.limit = new Limit();
    /** @type {[number, number]} */
    this.view = [0, 1];
    /** @type {[number, number]} */
    this.range = [0, 1];
    /** Where the curves end below. */
    this.least = 0;
  }

  /** @returns {"waveform" | "spectrum" | "envelope"} */
  get kind() {
    const kind = this.getAttribute("kind");
    return kind === "spectrum" || kind === "envelope" ? kind : "waveform";
  }
  set kind(kind) {
    this.setAttribute("kind", kind);
  }
  /** All of it, counted from its start. @returns {[number, number]} */
  full() {
    return this.held ? [0, this.held.dx * (this.held.values.length - 1)] : [0, 1];
  }
  /** @returns {[number, number]} */
  home() {
    const full = this.full(),
      settled = (this.held?.settled ?? 0) - (this.held?.x0 ?? 0);
    if (this.kind === "waveform" && settled > 0 && settled < 0.9 * full[1]) return [settled, full[1]];
    if (this.kind !== "envelope" || !this.held?.lines?.length) return full;
    const reach = ENVELOPE_ORDERS * Math.max(...this.held.lines.map((line) => line.nominal_hz).filter(Number.isFinite));
    return reach > 0 ? [0, Math.min(full[1], reach)] : full;
  }
  /** What is shown, counted from the curve's start. @returns {[number, number]} */
  shown() {
    return this.zoomed ?? this.home();
  }

  /** Axes for what is shown. @param {CurveData} data @param {number} width px @param {number} height px @returns {import("./plot.js").Axes} */
  axes(data, width, height) {
    const [from, to] = this.shown();
    this.view = [data.x0 + from, data.x0 + to];
    const curves = [data, data.second].filter((c) => !!c?.values?.length),
      room = this.kind === "envelope" ? labelRoom(data.lines ?? []) : this.kind === "spectrum" && data.band_hz ? 14 : 0;
    let most = 0;
    for (const curve of /** @type {Curve[]} */ (curves)) {
      const [first, last] = part(curve, this.view);
      for (let i = first; i <= last; i++) {
        const v = Math.abs(curve.values[i]);
        if (v > most) most = v;
      }
    }
    // Labels are above the curves, nominal frequencies below.
    const strip = this.kind === "envelope" && data.lines?.length ? STRIP : this.kind === "waveform" ? 7 : 0,
      tall = Math.max(0.4 * height, height - room - strip);
    const top = this.log ? 10 * Math.ceil(decibel(most || 1) / 10) : this.limit.hold(most),
      least = this.log ? top - DEPTH : this.kind === "waveform" ? -top : 0,
      px = (top - least) / tall;
    this.least = least;
    this.range = [least - strip * px, top + room * px];
    const [unit, per] = this.xUnit(data),
      xTicks = ticks(this.view[0] * per, this.view[1] * per, Math.min(10, width / 68)).map(
        ([v, label]) => /** @type {[number, string]} */ ([v / per, label]),
      );
    if (xTicks.length) xTicks[xTicks.length - 1][1] += ` ${unit}`;
    let yTicks = ticks(least, top, Math.max(2, Math.min(6, tall / 28)));
    // Both ends of a symmetric axis are told.
    if (least === -top && !(yTicks[yTicks.length - 1]?.[0] > 0.6 * top)) yTicks = [-top, 0, top].map((v) => [v, short(v)]);
    return { x: this.view, y: this.range, xTicks, yTicks };
  }
  /** Unit of the x axis and how many of it are in one s or Hz. @param {CurveData} data @returns {[string, number]} */
  xUnit(data) {
    if (this.kind === "waveform") return this.view[1] - this.view[0] < 0.8 && data.x0 < 20 ? ["ms", 1000] : ["s", 1];
    return this.view[1] > 4000 ? ["kHz", 0.001] : ["Hz", 1];
  }
  /** Where the curves are in the box. @returns {import("./plot.js").Frame} */
  frame() {
    return {
      left: ROOM.left,
      top: ROOM.top,
      width: this.box.clientWidth - ROOM.left - ROOM.right,
      height: this.box.clientHeight - ROOM.top - ROOM.bottom,
    };
  }
  /** @param {import("./plot.js").Frame} frame @returns {import("./trace.js").Space} */
  space(frame) {
    const { view, range } = this,
      { left, top, width, height } = frame,
      kx = width / (view[1] - view[0]),
      ky = height / (range[1] - range[0]),
      bottom = top + height;
    const Y = this.log
      ? (/** @type {number} */ v) => bottom - (Math.max(decibel(v), this.least) - range[0]) * ky
      : (/** @type {number} */ v) => bottom - (v - range[0]) * ky;
    return { X: (v) => left + (v - view[0]) * kx, Y, frame, view };
  }
  /** @param {import("./pen.js").Pen} pen @param {import("./plot.js").Frame} frame @param {import("./theme.js").Colours} colours */
  paint(pen, frame, colours) {
    const data = this.held;
    if (!data) return;
    const space = this.space(frame),
      peaks = this.kind !== "waveform",
      { left, top, width, height } = frame;
    pen.save();
    pen.beginPath();
    pen.rect(left, top, width, height);
    pen.clip();
    if (this.kind === "spectrum" && data.band_hz) paintBand(pen, data.band_hz, space, colours);
    if (data.behind) trace(pen, data.behind, space, peaks, colours.healthy, 1);
    if (peaks && !this.log && !data.second) this.wash(pen, data, space, colours);
    trace(pen, data, space, peaks, colours.blue, 1);
    if (data.second) trace(pen, data.second, space, peaks, colours.second, 1, 0.9);
    pen.strokeStyle = colours.frame;
    pen.lineWidth = 1;
    const base = top + height * (1 - (this.least - this.range[0]) / (this.range[1] - this.range[0])),
      zero = this.kind === "waveform" ? space.Y(0) : base - 0.5;
    path(pen, [
      [left, zero],
      [left + width, zero],
    ]);
    pen.globalAlpha = this.kind === "waveform" ? 0.35 : 1;
    pen.stroke();
    pen.globalAlpha = 1;
    if (this.kind === "envelope") paintLines(pen, data.lines ?? [], space, base, colours);
    pen.restore();
  }
  /** @param {import("./pen.js").Pen} pen @param {Curve} curve @param {import("./trace.js").Space} space @param {import("./theme.js").Colours} colours */
  wash(pen, curve, space, colours) {
    tracePath(pen, curve, space, true);
    const [first, last] = part(curve, space.view),
      bottom = space.Y(0);
    pen.lineTo(space.X(curve.x0 + last * curve.dx), bottom);
    pen.lineTo(space.X(curve.x0 + first * curve.dx), bottom);
    pen.globalAlpha = 0.09;
    pen.fillStyle = colours.blue;
    pen.fill();
    pen.globalAlpha = 1;
  }
}
