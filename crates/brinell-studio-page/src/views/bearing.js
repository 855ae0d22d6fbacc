// <brinell-bearing>: the bearing from its face in slow motion, from the latest turns of the run.
import { short } from "../chart.js";
import { h } from "../dom.js";
import { fit, View } from "./view.js";
import { sheet } from "./theme.js";
import { font } from "./pen.js";
import { Limit } from "./scale.js";
import { Motion } from "./motion.js";
import { arcs, paintLegend, paintLoad, paintRow, RING } from "./face.js";

/** @typedef {import("./face.js").Geometry} Geometry */
/** @typedef {import("./face.js").Damage} Damage */

/** Turns after a change: in which the bearing comes to its new state, and of which a stopped picture is taken then. */
const SETTLES = 2,
  STOPPED = 2;

const own = sheet(`
:host { display: flex; flex-direction: column; }
.stage { position: relative; flex: 1 0 var(--bearing-height, 260px); border-radius: 4px; }
.bar { padding-top: 4px; }
.bar label { flex: 1 1 90px; min-width: 0; }
.bar input { flex: 1; width: 40px; min-width: 40px; }
#play { min-width: 58px; }
`);

export class BrinellBearing extends View {
  constructor() {
    super(own);
    /** @type {Geometry | null} */
    this.shape = null;
    /** @type {import("./motion.js").Motion | null} */
    this.motion = null;
    /** @type {Damage[]} */
    this.marks = [];
    /** @type {import("./face.js").Arc[][]} Of each row. */
    this.arcs = [];
    /** @type {import("./motion.js").Frames | null} */
    this.given = null;
    /** The clip shown is older than the damage. */
    this.stale = false;
    this.towards = 0;
    this.limit = new Limit();
    this.slower = 60;
    this.playing = false;
    /** What the reader asked for; null leaves it to how much motion they prefer. @type {boolean | null} */
    this.wanted = null;
    /** Simulated time still to go of a single turn, in turns. */
    this.toGo = Infinity;
    this.last = 0;
    this.ticking = 0;
    this.visible = true;
    /** "both" or the row's index. @type {string} */
    this.which = "both";
    this.calm = matchMedia("(prefers-reduced-motion: reduce)");
    this.seen = new IntersectionObserver((entries) => {
      this.visible = entries[entries.length - 1].isIntersecting;
      this.run();
    });
    this.title_ = h("span", { class: "title" }, "Bearing");
    this.told = h("span", { class: "readout" });
    this.canvas = h("canvas", { role: "img", "aria-label": "Bearing" });
    this.empty = h("div", { class: "empty" }, "waiting for the bearing");
    this.stage = h("div", { class: "stage" }, this.canvas, this.empty);
    this.playButton = h("button", { type: "button", id: "play" }, "Play");
    this.turnButton = h("button", { type: "button", title: "One turn of the shaft, then stop" }, "1 turn");
    this.pace = /** @type {HTMLInputElement} */ (
      h("input", {
        type: "range",
        min: "20",
        max: "200",
        step: "5",
        value: "60",
        "aria-label": "Slow motion, times slower than real",
      })
    );
    this.paceTold = h("output");
    this.rowsPick = h("select", { "aria-label": "Row shown" });
    const bar = h("div", { class: "tools bar" }, this.playButton, this.turnButton, h("label", {}, this.pace, this.paceTold), this.rowsPick);
    this.root.append(h("div", { class: "head" }, this.title_, this.told), this.stage, bar);
    this.playButton.addEventListener("click", () => {
      this.wanted = !this.playing;
      this.toGo = Infinity;
      this.set(this.wanted);
    });
    this.turnButton.addEventListener("click", () => this.step());
    this.pace.addEventListener("input", () => {
      this.slower = Number(this.pace.value);
      this.tell();
    });
    this.rowsPick.addEventListener("change", () => {
      this.which = this.rowsPick.value;
      this.requestDraw();
    });
  }

  connectedCallback() {
    super.connectedCallback();
    this.sizes.observe(this.stage);
    this.seen.observe(this);
    this.calm.addEventListener("change", () => this.decide(), { signal: this.ends.signal });
    this.decide();
    this.tell();
  }
  disconnectedCallback() {
    super.disconnectedCallback();
    this.seen.disconnect();
    this.halt();
  }

  // --- properties ------------------------------------------------------------------------------------------------------------------------
  /** @returns {Geometry | null} */
  get geometry() {
    return this.shape;
  }
  set geometry(geometry) {
    const same = geometry && this.shape && geometry.rows === this.shape.rows && geometry.elements === this.shape.elements;
    this.shape = geometry ?? null;
    if (!same) {
      this.motion = geometry ? new Motion(geometry.rows, geometry.elements) : null;
      this.limit = new Limit();
      const rows = geometry?.rows ?? 1;
      this.rowsPick.replaceChildren(
        ...[["both", rows > 2 ? "All rows" : "Both rows"], ...Array.from({ length: rows }, (_, k) => [String(k), `Row ${k + 1}`])].map(
          ([value, words]) => h("option", { value }, words),
        ),
      );
      this.rowsPick.hidden = rows < 2;
      this.which = this.rowsPick.value = "both";
    }
    this.sort();
    this.describe();
    this.requestDraw();
  }
  /** Frames of the latest answer; they are added to those that came before. @returns {import("./motion.js").Frames | null} */
  get frames() {
    return this.given;
  }
  set frames(frames) {
    this.given = frames;
    if (!frames || !this.motion) return;
    this.motion.push(frames);
    if (!this.motion.clip) {
      this.motion.go(0);
      this.requestDraw();
    }
    // A stopped picture shows the edited bearing too, at nearly the same angles.
    if (!this.playing && this.renew()) {
      this.motion.show(0);
      this.requestDraw();
    }
  }
  /** Answer of `damage`, or its list. @returns {any} */
  get damage() {
    return this.marks;
  }
  set damage(damage) {
    this.marks = Array.isArray(damage) ? damage : (damage?.defects ?? []);
    this.sort();
    // What is shown from now on is of the edited bearing as soon as it has made a turn.
    if (this.motion) {
      this.motion.fresh = 0;
      this.stale = true;
    }
    this.describe();
    this.requestDraw();
  }
  /** Direction of the load, degrees counter-clockwise from +x. */
  get loadDeg() {
    return this.towards;
  }
  set loadDeg(degrees) {
    this.towards = Number(degrees) || 0;
    this.describe();
    this.requestDraw();
  }

  sort() {
    const shape = this.shape;
    this.arcs = Array.from({ length: shape?.rows ?? 0 }, (_, k) =>
      shape ? this.marks.filter((d) => d.row === k + 1).flatMap((d) => arcs(d, shape)) : [],
    );
  }

  // --- motion ----------------------------------------------------------------------------------------------------------------------------
  decide() {
    this.set(this.wanted ?? !this.calm.matches);
  }
  /** @param {boolean} on */
  set(on) {
    this.playing = on;
    if (!on) this.toGo = Infinity;
    this.tell();
    this.run();
  }
  /** One turn of the shaft; without movement where the reader prefers less of it. */
  step() {
    this.wanted = false;
    if (this.calm.matches) {
      this.set(false);
      const motion = this.motion;
      if (motion?.dt && Number.isFinite(motion.perTurn())) motion.go(motion.perTurn() * motion.dt);
      this.requestDraw();
      return;
    }
    this.set(true);
    this.toGo = 1;
  }
  run() {
    const on = this.playing && this.visible && this.isConnected;
    if (!on) {
      this.halt();
      return;
    }
    if (this.ticking) return;
    this.last = performance.now();
    const tick = (/** @type {number} */ now) => {
      this.ticking = requestAnimationFrame(tick);
      this.advance(Math.min(Math.max(now - this.last, 0), 100) / 1000);
      this.last = now;
    };
    this.ticking = requestAnimationFrame(tick);
  }
  halt() {
    cancelAnimationFrame(this.ticking);
    this.ticking = 0;
  }
  /** @param {number} wall s */
  advance(wall) {
    const motion = this.motion;
    if (!motion?.dt) return;
    const turn = motion.perTurn() * motion.dt;
    this.renew();
    let time = wall / this.slower;
    if (Number.isFinite(this.toGo) && Number.isFinite(turn)) {
      time = Math.min(time, this.toGo * turn);
      this.toGo -= time / turn;
    }
    motion.go(time);
    this.requestDraw();
    if (this.toGo <= 1e-9) this.set(false);
  }
  /** Takes newer turns once the bearing has changed and a turn and a half have been made since; for a stopped picture, once it has settled. */
  renew() {
    const { motion, playing } = this;
    if (!this.stale || !motion || !(motion.fresh > (playing ? 1.5 : SETTLES + STOPPED) * motion.perTurn())) return false;
    motion.take(playing ? undefined : STOPPED);
    this.stale = false;
    return true;
  }
  tell() {
    this.playButton.textContent = this.playing ? "Pause" : "Play";
    this.paceTold.textContent = `1 : ${this.slower}`;
    this.pace.setAttribute("aria-valuetext", `${this.slower} times slower than real`);
    this.dataset.playing = String(this.playing);
  }

  // --- drawing ---------------------------------------------------------------------------------------------------------------------------
  draw() {
    const ready = !!this.shape;
    this.empty.hidden = ready;
    const room = fit(this.canvas, this.stage);
    if (!room || !ready) return;
    this.paint(room.pen, room.width, room.height, this.colours);
    const largest = this.motion?.state.largest ?? 0;
    this.told.textContent = this.motion?.clip ? `largest contact force ${short(largest, 3)} N` : "at rest until it has settled";
  }
  /** @param {import("./pen.js").Pen} pen @param {number} width @param {number} height @param {import("./theme.js").Colours} colours */
  paint(pen, width, height, colours) {
    const shape = this.shape,
      motion = this.motion;
    if (!shape || !motion) return;
    const all = Array.from({ length: shape.rows }, (_, k) => k),
      shown = this.which === "both" ? all : [Number(this.which)];
    const full = this.limit.hold(motion.largest),
      words = motion.clip ? `${short(full, 3)} N` : "–",
      damaged = this.marks.length > 0;
    const foot = paintLegend(null, 8, 0, width - 16, colours, words, damaged),
      room = height - foot - 6;
    const head = shown.length > 1 ? 15 : 0,
      radius = (/** @type {number} */ n) => Math.min(width / n / 2 - 6, (room / Math.ceil(shown.length / n) - head) / 2 - 4);
    const across = shown.length > 1 && radius(shown.length) >= radius(1) ? shown.length : 1,
      [w, h] = [width / across, room / Math.ceil(shown.length / across)];
    const reach = radius(across),
      scale = reach / (shape.outer_mm * (1 + RING));
    if (!(reach > 12)) return;
    const perNewton = (scale * RING * shape.outer_mm) / full;
    shown.forEach((k, index) => {
      const x = w * ((index % across) + 0.5),
        y = h * Math.floor(index / across) + head + (h - head) / 2;
      const stage = { x, y, scale, colours, perNewton };
      paintRow(pen, stage, shape, motion.state.rows[k], motion.state.ring, this.arcs[k] ?? []);
      paintLoad(pen, stage, shape, this.towards);
      if (!head) return;
      pen.font = font(11, 600);
      pen.fillStyle = colours.faint;
      pen.textAlign = "center";
      pen.fillText(`row ${k + 1}`, x, y - reach - 6);
      pen.textAlign = "start";
    });
    paintLegend(pen, 8, height - foot, width - 16, colours, words, damaged);
  }
  sentence() {
    const shape = this.shape;
    if (!shape) return "Bearing: waiting for the run";
    const where = this.marks.map((d) => `${d.on.replace("-", " ")}, row ${d.row}, at ${short(d.center_deg, 4)} degrees`);
    return `Bearing from its face: ${shape.rows} ${shape.rows > 1 ? "rows" : "row"} of ${shape.elements} ${shape.element}s, load towards ${short(this.towards, 4)} degrees. ${where.length ? `Damage: ${where.join("; ")}.` : "No damage."}`;
  }
  describe() {
    this.canvas.setAttribute("aria-label", this.sentence());
  }
  picture() {
    const width = Math.max(320, this.stage.clientWidth),
      height = Math.max(240, this.stage.clientHeight);
    return {
      width,
      height,
      title: this.sentence(),
      paint: (/** @type {import("./pen.js").Pen} */ pen, /** @type {import("./theme.js").Colours} */ colours) =>
        this.paint(pen, width, height, colours),
    };
  }
}
customElements.define("brinell-bearing", BrinellBearing);
