// <brinell-curve kind="waveform|spectrum|envelope">: a curve with the healthy bearing behind it, zoom, cursor, marks and a table.
import { around, decibel, largestOf, minus, pointed, short, within } from "../chart.js";
import { fill, h, spelled } from "../dom.js";
import { fit, seldom } from "./view.js";
import { sheet } from "./theme.js";
import { breadth, font } from "./pen.js";
import { CurveDrawing, ROOM } from "./curve-drawing.js";
import { paintAxes } from "./plot.js";
import { Limit } from "./scale.js";
import { orders } from "./trace.js";

/** @typedef {import("./curve-drawing.js").CurveData} CurveData */
/** @typedef {import("./trace.js").Curve} Curve */

const TITLES = { waveform: "Waveform", spectrum: "Spectrum", envelope: "Envelope spectrum" };
const SHORT = { ...TITLES, envelope: "Envelope" };
const HELP =
  "Arrow keys move the cursor, Shift moves it further, Page up and Page down go along the marked lines, plus and minus zoom, 0 shows everything again";
/** The pointer finds the highest value of a spectrum within this, px. */
const SNAP = 4;

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

export class BrinellCurve extends CurveDrawing {
  static observedAttributes = ["kind"];

  constructor() {
    super(own, "waiting for samples", HELP);
    /** All of a record is shown. */
    this.all = false;
    /** Where the cursor is, counted from the curve's start. @type {number | null} */
    this.place = null;
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
  /** Shades from one place across the frame to another, px; nothing with null. @param {[number, number] | null} span */
  shade(span) {
    const [from, to] = span ?? [0, 0];
    this.shaded.hidden = !span;
    this.shaded.style.cssText = `left:${Math.min(from, to)}px;width:${Math.abs(to - from)}px`;
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
