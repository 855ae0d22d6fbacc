// <brinell-curve kind="waveform|spectrum|envelope">: a curve with the healthy bearing behind it, zoom, cursor, marks and a table.
import { around, decibel, largestOf, minus, pointed, short, ticks, within } from "../chart.js";
import { fill, h, spelled } from "../dom.js";
import { fit, seldom } from "./view.js";
import { sheet } from "./theme.js";
import { breadth, font, path } from "./pen.js";
import { paintAxes, PlotView } from "./plot.js";
import { Limit } from "./scale.js";
import { labelRoom, orders, paintBand, paintLines, part, STRIP, trace, tracePath } from "./trace.js";

/** @typedef {import("./trace.js").Curve} Curve */
/** @typedef {import("./trace.js").Line} Line */
/**
 * @typedef {Curve & { unit: string, lines?: Line[], band_hz?: [number, number] | null, behind?: Curve | null, second?: Curve | null, names?: string[], settled?: number, stored?: boolean }} CurveData
 * x in s or Hz; `stored`: of no bearing that runs; `settled` where a waveform's first view begins; `behind` the healthy bearing, `second` the bearing B
 */

const TITLES = { waveform: "Waveform", spectrum: "Spectrum", envelope: "Envelope spectrum" };
const SHORT = { ...TITLES, envelope: "Envelope" };
const HELP =
  "Arrow keys move the cursor, Shift moves it further, Page up and Page down go along the marked lines, plus and minus zoom, 0 shows everything again";
/** The logarithmic axis shows this much, dB. */
const DEPTH = 80;
/** The pointer finds the highest value of a spectrum within this, px. */
const SNAP = 4;
/** The envelope opens on so many multiples of the highest nominal frequency. */
const ENVELOPE_ORDERS = 5.6;

/** Room around the frame, px. */
const ROOM = { top: 8, right: 22, bottom: 20, left: 46 };

const own = sheet(`
.plot { flex: 1 0 var(--plot-height, 180px); }
.over { position: absolute; inset: ${ROOM.top}px ${ROOM.right}px ${ROOM.bottom}px ${ROOM.left}px; cursor: crosshair; touch-action: pan-y; user-select: none; }
.select { position: absolute; top: 0; bottom: 0; pointer-events: none; background: color-mix(in srgb, var(--_blue) 16%, transparent); }
.cursor { position: absolute; width: 0; border-left: 1px solid var(--_ink); pointer-events: none; opacity: 0.6; }
.dot { position: absolute; width: 7px; height: 7px; margin: -3.5px; border-radius: 50%; background: var(--_ink); pointer-events: none; }
.end { margin-left: auto; }
.key { font-size: 12px; color: var(--_faint); white-space: nowrap; }
.key::before { content: ""; display: inline-block; width: 14px; height: 0; margin-right: 5px; vertical-align: middle; border-top: 2px solid var(--mark); }
`);

export class BrinellCurve extends PlotView {
  static observedAttributes = ["kind"];

  constructor() {
    super(own, "waiting for samples", HELP);
    /** @type {CurveData | null} */
    this.held = null;
    /** Ends of the zoom counted from the curve's start; null shows the home view. @type {[number, number] | null} */
    this.zoomed = null;
    /** All of a record is shown. */
    this.all = false;
    /** Where the cursor is, counted from the curve's start. @type {number | null} */
    this.place = null;
    this.log = false;
    this.limit = new Limit();
    /** @type {[number, number]} */
    this.view = [0, 1];
    /** @type {[number, number]} */
    this.range = [0, 1];
    /** Where the curves end below. */
    this.least = 0;
    this.redraws = { count: 0, ms: 0 };
    this.entitled = "";
    this.name = h("span", { class: "title" });
    this.keys = h("span", { class: "tools" });
    this.scaleButton = h("button", { type: "button", "aria-pressed": "false", title: "Logarithmic axis, dB (key L)" }, "dB");
    this.allButton = h("button", { type: "button", title: "Everything that there is" }, "All");
    this.resetButton = h("button", { type: "button", title: "Back to the first view (key 0, double click)", hidden: true }, "Reset");
    /** Shades what is drawn over, to be zoomed to. */
    this.shaded = h("div", { class: "select", hidden: true });
    this.over = h("div", { class: "over" }, this.shaded);
    this.line = h("div", { class: "cursor", hidden: true });
    this.dot = h("div", { class: "dot", hidden: true });
    const tools = h("span", { class: "tools end" }, this.resetButton, this.scaleButton, this.allButton);
    this.empty.before(this.over, this.line, this.dot);
    this.root.prepend(h("div", { class: "head" }, this.name, this.keys, tools));
    this.scaleButton.addEventListener("click", () => this.setLog(!this.log));
    this.allButton.addEventListener("click", () => this.zoom(this.full()));
    this.resetButton.addEventListener("click", () => this.zoom(null));
    this.listen();
    this.tellSoon = seldom(1000, () => this.describe());
    this.tableSoon = seldom(400, () => this.tabulate());
  }

  connectedCallback() {
    super.connectedCallback();
    this.entitle();
  }
  attributeChangedCallback() {
    this.entitle();
    this.limit = new Limit();
    this.requestDraw();
  }

  /** @returns {"waveform" | "spectrum" | "envelope"} */
  get kind() {
    const kind = this.getAttribute("kind");
    return kind === "spectrum" || kind === "envelope" ? kind : "waveform";
  }
  set kind(kind) {
    this.setAttribute("kind", kind);
  }
  /** @returns {CurveData | null} */
  get data() {
    return this.held;
  }
  set data(data) {
    const usable = data && data.values?.length > 1 && data.dx > 0 ? data : null;
    this.held = usable;
    // Another spacing is another axis: what was zoomed stays only where it still fits. All of a record is no part of the live window after it.
    if (usable && this.zoomed && (this.zoomed[0] >= this.full()[1] || (this.all && usable.settled === undefined))) this.zoomed = null;
    this.requestDraw();
  }

  entitle() {
    this.scaleButton.hidden = this.kind === "waveform";
    this.allButton.hidden = this.kind !== "envelope" && this.held?.settled === undefined;
    if (this.kind === "waveform") this.log = false;
    this.name.replaceChildren(SHORT[this.kind], " ", h("span", { class: "unit" }, this.unit()));
    this.tellSoon?.();
  }
  /** What the two curves are called. @param {CurveData} data @param {0 | 1} which */
  named(data, which) {
    return data.names?.[which] ?? (which ? "B" : "A");
  }
  unit() {
    return this.held ? (this.log ? `dB re 1 ${spelled(this.held.unit)}` : spelled(this.held.unit)) : "";
  }
  /** @param {boolean} on */
  setLog(on) {
    if (this.kind === "waveform") return;
    this.log = on;
    this.scaleButton.setAttribute("aria-pressed", String(on));
    this.limit = new Limit();
    this.requestDraw();
  }

  // --- what is shown -------------------------------------------------------------------------------------------------------------------
  /** From the curve's start. @returns {[number, number]} */
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
  /** Shows from one place to another, counted from the curve's start; null is the home view. @param {[number, number] | null} span */
  zoom(span) {
    if (!this.held) return;
    const full = this.full();
    if (span) {
      span = within(span, full, 8 * this.held.dx);
      const home = this.home();
      if (Math.abs(span[0] - home[0]) + Math.abs(span[1] - home[1]) < 1e-6 * full[1]) span = null;
    }
    this.zoomed = span;
    this.all = !!span && this.held.settled !== undefined && span[0] <= 0 && span[1] >= full[1] - this.held.dx;
    // What a zoom shows fills the height at once.
    this.limit = new Limit();
    this.requestDraw();
    this.dispatchEvent(new CustomEvent("zoom", { detail: span }));
  }
  /** @param {number} factor @param {number} at counted from the start */
  zoomAround(factor, at) {
    this.zoom(around(this.shown(), at, factor));
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

  draw() {
    const data = this.held;
    this.empty.hidden = !!data;
    this.entitleOnce();
    if (!data && this.place !== null) this.point(null);
    const begun = performance.now(),
      room = fit(this.canvas, this.box),
      frame = this.frame();
    if (!room) return;
    if (data) {
      paintAxes(room.pen, frame, this.axes(data, frame.width, frame.height), this.colours, (px) => Math.round(px - 0.5) + 0.5);
      this.paint(room.pen, frame, this.colours);
      this.redraws.count++;
      this.redraws.ms += performance.now() - begun;
    }
    this.resetButton.hidden = !this.zoomed;
    if (this.place !== null) this.read();
    this.tellSoon();
    if (this.details.open) this.tableSoon();
  }
  entitleOnce() {
    const legend = this.legend(),
      key = `${this.kind} ${this.unit()} ${this.held?.settled} ${legend}`;
    if (key === this.entitled) return;
    this.entitled = key;
    this.entitle();
    this.keys.replaceChildren(
      ...legend.map(([word, mark]) => {
        const key = h("span", { class: "key" }, word);
        key.style.setProperty("--mark", `var(--_${mark})`);
        return key;
      }),
    );
  }
  /** Names of the curves and their colours. */
  legend() {
    const data = this.held,
      keys = /** @type {[string, keyof import("./theme.js").Colours][]} */ ([]);
    if (data?.stored) keys.push(["stored run", "blue"]);
    if (data?.second) keys.push([this.named(data, 0), "blue"], [this.named(data, 1), "second"]);
    if (data?.behind) keys.push(["healthy", "healthy"]);
    return keys;
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
  /** Shades from one place across the frame to another, px; nothing with null. @param {[number, number] | null} span */
  shade(span) {
    const [from, to] = span ?? [0, 0];
    this.shaded.hidden = !span;
    this.shaded.style.cssText = `left:${Math.min(from, to)}px;width:${Math.abs(to - from)}px`;
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

  // --- cursor, pointer, keys -----------------------------------------------------------------------------------------------------------
  /** The sample at a place; of spectra the highest one within so many pixels. @param {Curve} curve @param {number} x @param {number} [snap] */
  sample(curve, x, snap = 0) {
    const last = curve.values.length - 1,
      nearest = Math.min(Math.max(Math.round((x - curve.x0) / curve.dx), 0), last);
    if (!snap || this.kind === "waveform") return nearest;
    const reach = Math.ceil((snap * (this.view[1] - this.view[0])) / this.frame().width / curve.dx);
    return largestOf(curve.values, nearest, nearest - reach, nearest + reach);
  }
  /** Puts the cursor at a place counted from the start, or takes it away. @param {number | null} place @param {number} [snap] px */
  point(place, snap = 0) {
    const data = this.held;
    if (place === null || !data) {
      this.place = null;
      this.line.hidden = this.dot.hidden = true;
      this.readout.textContent = "";
      return;
    }
    this.place = this.sample(data, data.x0 + place, snap) * data.dx;
    this.read();
  }
  read() {
    const data = this.held;
    if (!data || this.place === null) return;
    const frame = this.frame(),
      space = this.space(frame),
      index = this.sample(data, data.x0 + this.place),
      x = data.x0 + index * data.dx,
      px = space.X(x);
    const inside = px >= frame.left - 0.5 && px <= frame.left + frame.width + 0.5;
    this.line.hidden = this.dot.hidden = !inside;
    this.line.style.cssText = `left:${px}px;top:${frame.top}px;height:${frame.height}px`;
    this.dot.style.cssText = `left:${px}px;top:${Math.min(Math.max(space.Y(data.values[index]), frame.top), frame.top + frame.height)}px`;
    this.readout.textContent = this.words(data, x, index);
    this.readout.title = this.readout.textContent;
  }
  /** @param {CurveData} data @param {number} x @param {number} index */
  words(data, x, index) {
    const unit = spelled(data.unit),
      wave = this.kind === "waveform",
      value = (/** @type {number} */ v) => `${short(v, 4)} ${unit}${this.log ? ` (${minus(decibel(v).toFixed(1))} dB)` : ""}`;
    const other = (/** @type {Curve | null | undefined} */ curve, /** @type {string} */ name) =>
      curve?.values?.length ? ` · ${name} ${short(curve.values[this.sample(curve, x)], 3)}` : "";
    const near = wave ? "" : this.near(data, x);
    return `${wave ? `${(1000 * x).toFixed(2)} ms` : `${short(x, 5)} Hz`} · ${value(data.values[index])}${other(data.second, this.named(data, 1))}${other(data.behind, "healthy")}${near}`;
  }
  /** @param {CurveData} data @param {number} x */
  near(data, x) {
    const limit = Math.max(data.dx, (5 * (this.view[1] - this.view[0])) / Math.max(this.box.clientWidth, 100));
    const names = this.marked(data)
      .filter((m) => Math.abs(m.x - x) <= limit)
      .map((m) => m.name);
    return names.length ? ` · ${names.slice(0, 2).join(", ")}` : "";
  }
  /** Every marked line. @param {CurveData} data */
  marked(data) {
    return (data.lines ?? []).flatMap((line) =>
      line.found
        ? orders(line).map((k) => ({ name: k === 1 ? line.name : `${line.name} ×${k}`, x: k * line.hz, k, line }))
        : [{ name: line.name, x: line.nominal_hz, k: 1, line }],
    );
  }
  /** @param {KeyboardEvent} event */
  key(event) {
    const data = this.held;
    if (!data) return undefined;
    const [from, to] = this.shown(),
      stride = Math.max((to - from) / 200, data.dx) * (event.shiftKey ? 10 : 1),
      at = this.place ?? (from + to) / 2;
    /** @type {Record<string, () => void>} */
    const acts = {
      ArrowLeft: () => this.go(at - stride),
      ArrowRight: () => this.go(at + stride),
      Home: () => this.go(from),
      End: () => this.go(to),
      PageDown: () => this.leap(1),
      PageUp: () => this.leap(-1),
      "+": () => this.zoomAround(0.5, at),
      "=": () => this.zoomAround(0.5, at),
      "-": () => this.zoomAround(2, at),
      _: () => this.zoomAround(2, at),
      0: () => this.zoom(null),
      l: () => this.setLog(!this.log),
      L: () => this.setLog(!this.log),
    };
    if (event.key === "Escape" && (this.zoomed || this.place !== null)) {
      this.zoom(null);
      this.point(null);
    }
    return acts[event.key];
  }
  /** Moves the cursor, and the view with it. @param {number} place */
  go(place) {
    const [from, to] = this.shown(),
      [low, high] = this.full(),
      at = Math.min(Math.max(place, low), high);
    if (at < from) this.zoom([at, at + to - from]);
    else if (at > to) this.zoom([at - (to - from), at]);
    this.point(at);
    this.speakSoon();
  }
  /** To the next marked line. @param {1 | -1} way */
  leap(way) {
    const data = this.held;
    if (!data) return;
    const at = data.x0 + (this.place ?? -Infinity),
      list = this.marked(data)
        .map((m) => m.x - data.x0)
        .sort((a, b) => a - b),
      gap = 1.5 * data.dx;
    const next = way > 0 ? list.find((x) => x > at - data.x0 + gap) : list.findLast((x) => x < at - data.x0 - gap);
    if (next !== undefined) this.go(next);
  }
  listen() {
    pointed(this.over, {
      px: (event) => event.clientX - this.over.getBoundingClientRect().left,
      ends: () => [0, this.over.clientWidth || 1],
      view: () => this.shown(),
      zoom: (span) => this.zoom(span),
      home: () => this.zoom(null),
      point: (place) => this.point(place, SNAP),
      leave: () => {
        if (this.root.activeElement !== this.box) this.point(null);
      },
      shade: (span) => this.shade(span),
      still: () => false,
      slides: () => !!this.zoomed,
    });
  }

  // --- words, table, export ------------------------------------------------------------------------------------------------------------
  sentence() {
    const data = this.held,
      title = `${TITLES[this.kind]}${data ? `, ${this.unit()}` : ""}`;
    if (!data) return `${title}: waiting for samples`;
    const [unit, per] = this.xUnit(data),
      ends = this.view.map((v) => short(v * per, 4));
    const found =
      this.kind !== "envelope"
        ? []
        : (data.lines ?? [])
            .filter((line) => line.found)
            .map(
              (line) =>
                `${line.name} at ${short(line.hz, 4)} Hz, nominal ${short(line.nominal_hz, 4)} Hz, ${line.harmonics} harmonics, ${short(line.over_noise_db, 3)} dB above the noise`,
            );
    return `${title}. ${found.length ? `${found.join("; ")}. ` : this.kind === "envelope" && data.lines?.length ? "No frequency of the bearing is found. " : ""}Shown: ${ends[0]} to ${ends[1]} ${unit}.`;
  }
  describe() {
    const text = this.sentence();
    if (this.box.getAttribute("aria-label") !== text) this.box.setAttribute("aria-label", text);
  }
  tabulate() {
    const data = this.held;
    if (!data || !this.details.open) return;
    const unit = spelled(data.unit),
      read = (/** @type {Curve | null | undefined} */ curve, /** @type {number} */ x) =>
        curve?.values?.length ? short(curve.values[this.sample(curve, x)], 4) : "";
    const others = /** @type {[string, Curve][]} */ (
      [
        [this.named(data, 1), data.second],
        ["healthy", data.behind],
      ].filter(([, curve]) => curve)
    );
    const heads = others.map(([name]) => `${name}, ${unit}`);
    if (this.kind === "waveform" || !data.lines?.length) {
      const [from, to] = this.view,
        wave = this.kind === "waveform",
        xs = Array.from({ length: 21 }, (_, k) => from + ((to - from) * k) / 20);
      fill(
        this.table,
        [wave ? "t, ms" : "Hz", `value, ${unit}`, ...heads],
        xs.map((x) => [wave ? short(1000 * x, 6) : short(x, 5), read(data, x), ...others.map(([, curve]) => read(curve, x))]),
      );
      return;
    }
    const rows = this.marked(data).map(({ name, x, k, line }) => {
      const first = k === 1;
      return [
        name,
        short(x, 5),
        short(k * line.nominal_hz, 5),
        read(data, x),
        ...others.map(([, curve]) => read(curve, x)),
        first ? (line.found ? "found" : "not found") : "",
        first && line.found ? short(line.over_noise_db, 3) : "",
      ];
    });
    fill(this.table, ["line", "Hz", "nominal, Hz", `value, ${unit}`, ...heads, "state", "above noise, dB"], rows);
  }
  picture() {
    const width = Math.max(480, this.clientWidth),
      height = Math.max(240, this.box.clientHeight + 30),
      data = this.held;
    const paint = (/** @type {import("./pen.js").Pen} */ pen, /** @type {import("./theme.js").Colours} */ colours) => {
      const frame = {
        left: ROOM.left + 6,
        top: 32,
        width: width - ROOM.left - 6 - ROOM.right - 8,
        height: height - 32 - ROOM.bottom - 6,
      };
      pen.fillStyle = colours.ink;
      pen.font = font(13, 600);
      pen.fillText(`${TITLES[this.kind]}, ${this.unit()}`, 10, 18);
      pen.font = font(11);
      let x = width - 24;
      for (const [word, mark] of this.legend().reverse()) {
        x -= breadth(word, 11);
        pen.fillStyle = colours.faint;
        pen.fillText(word, x, 18);
        pen.beginPath();
        pen.rect(x - 18, 13, 13, 2);
        pen.fillStyle = colours[mark];
        pen.fill();
        x -= 30;
      }
      const view = this.view,
        range = this.range;
      if (data) {
        const axes = this.axes(data, frame.width, frame.height);
        paintAxes(pen, frame, axes, colours);
        this.paint(pen, frame, colours);
      }
      this.view = view;
      this.range = range;
    };
    return { width, height, title: this.sentence(), paint };
  }
}
customElements.define("brinell-curve", BrinellCurve);
