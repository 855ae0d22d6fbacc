// The raceway unrolled, with rollers running over it in slow motion and damage on it: what is shown, and where. Fields and methods that begin with _ are of this element alone.
import { still } from "./dom.js";
import { Felt, Player } from "./player.js";
import { colours, copies, draw, middle, xOf } from "./raceway-draw.js";
import { Corners, box, handles } from "./tools.js";

/** @typedef {import("./tools.js").Tool} Tool */
/** @typedef {import("./tools.js").Request} Request */
/** @typedef {[number, number]} Place */

const NEAREST = 400;

export class RacewaySurface extends HTMLElement {
  /** @type {"outer-raceway" | "inner-raceway" | "roller"} */
  _surface = "outer-raceway";
  _row = 1;
  _rollerOf = 1;
  /** @type {any} */
  _geometry = null;
  _player = new Player();
  /** @type {any[]} */
  _damage = [];
  _felt = new Felt();
  /** @type {any} */
  _drag = null;
  /** @type {Map<number, Place>} */
  _fingers = new Map();
  _corners = new Corners();
  /** The last click of a tool that places something. */
  _tapped = { at: -Infinity, pixel: [0, 0] };
  /** @type {Place[] | null} */
  _stroke = null;
  /** @type {Place | null} */
  _cursor = null;
  _view = { s: 0, scale: 0 };
  _last = 0;
  _width = 0;
  _height = 0;
  /** @type {import("./raceway-draw.js").Colours | null} */
  _colours = null;
  /** @type {Tool} */
  _tool = "pen";
  selected = 0;
  /** @type {any} the selected defect of the scenario */
  defect = null;
  penWidth = 0.5;
  /** @type {number | null} */
  loadDeg = null;
  /** Whether time is stopped. */
  frozen = false;
  canvas = document.createElement("canvas");
  /** What is shown of the motion. @type {import("./player.js").Now | null} */
  instant = null;

  get tool() {
    return this._tool;
  }
  /** @param {Tool} tool */
  set tool(tool) {
    this._tool = tool;
    this._corners.clear();
    this._stroke = null;
    this.canvas.style.cursor = tool === "select" ? "default" : "crosshair";
  }

  get surface() {
    return this._surface;
  }

  /** Which surface is unrolled. @param {typeof this.surface} surface @param {number} row @param {number} roller */
  show(surface, row, roller) {
    const other = surface !== this._surface;
    [this._surface, this._row, this._rollerOf] = [surface, row, roller];
    this._felt.clear();
    if (other) {
      this._corners.clear();
      this.fit();
    }
    this.describe();
  }

  get geometry() {
    return this._geometry;
  }
  /** @param {any} geometry */
  set geometry(geometry) {
    const first = !this._geometry || JSON.stringify(geometry) !== JSON.stringify(this._geometry);
    this._geometry = geometry;
    if (!first) return;
    this._player.reset(geometry.elements);
    this._felt.clear();
    this.fit();
  }

  /** @param {any[]} damage on this surface */
  set damage(damage) {
    this._damage = damage.map((one) => ({
      ...one,
      s: (one.center_deg / 360) * this.turn,
      z: one.axial_offset_mm ?? 0,
    }));
    this._player.edited();
    this.describe();
  }

  /** @param {any} frames */
  set frames(frames) {
    this._player.push(frames);
    if (this._surface !== "roller" && frames?.rows) this._felt.take(frames, this._surface, this._row, this._geometry?.elements ?? 0);
  }

  /** Real seconds for a simulated one. @param {number} slowness */
  set slowness(slowness) {
    this._player.slowness = slowness;
  }

  /** Length of the whole turn, mm. */
  get turn() {
    const g = this._geometry,
      radius = !g ? 1 : this._surface === "outer-raceway" ? g.outer_mm : this._surface === "inner-raceway" ? g.inner_mm : g.element_mm;
    return 2 * Math.PI * radius;
  }

  /** @param {Request} request */
  _send(request) {
    this.dispatchEvent(new CustomEvent("draw", { detail: request }));
  }

  describe(words = "") {
    const names = {
      "outer-raceway": "Outer raceway",
      "inner-raceway": "Inner raceway",
      roller: `Roller ${this._rollerOf}`,
    };
    const there = this._damage.length ? `${this._damage.length} damaged ${this._damage.length === 1 ? "place" : "places"}` : "no damage";
    this.canvas.setAttribute(
      "aria-label",
      `${names[this._surface]}, row ${this._row}, unrolled: ${there}. ${words} Enter draws with the tool, arrows move.`,
    );
  }

  _size() {
    const { clientWidth, clientHeight } = this.canvas,
      ratio = devicePixelRatio || 1;
    [this._width, this._height] = [clientWidth, clientHeight];
    this.canvas.width = Math.round(clientWidth * ratio);
    this.canvas.height = Math.round(clientHeight * ratio);
    if (!this._view.scale) this.fit();
  }

  /** The width of the surface fills the height; the load's place, or the selected damage, is in the middle. */
  fit() {
    if (!this._geometry || !this._height) return;
    const scale = (this._height - 80) / (1.15 * this._geometry.length_mm);
    const chosen = this._damage.find((one) => one.defect === this.selected) ?? this._damage[0];
    this._view = {
      scale,
      s:
        scale * this.turn < this._width
          ? 0
          : (chosen?.s ?? (this._surface === "outer-raceway" ? ((this.loadDeg ?? 0) / 360) * this.turn : 0)),
    };
  }

  /** @param {number} factor @param {number} [x] */
  zoom(factor, x = this._width / 2) {
    const view = this._view,
      s = view.s + (x - this._width / 2) / view.scale;
    const scale = Math.max((0.3 * this._width) / this.turn, Math.min(NEAREST, view.scale * factor));
    this._view = { scale, s: scale * this.turn < this._width ? 0 : s - (x - this._width / 2) / scale };
  }

  /** @param {import("./player.js").Now} now @param {number} index */
  _place(now, index) {
    const row = now.rows[this._row - 1];
    /** @type {number} */
    const angle = row.orbit[index] - (this._surface === "inner-raceway" ? now.ring : 0);
    const turned = Math.atan2(Math.sin(angle), Math.cos(angle));
    return (turned / (2 * Math.PI)) * this.turn;
  }

  /** Contact lines at an instant. @param {import("./player.js").Now | null} now @returns {import("./raceway-draw.js").Contact[]} */
  _contacts(now) {
    const row = now?.rows[this._row - 1];
    if (!now || !row) return [];
    if (this._surface !== "roller") {
      const forces = this._surface === "outer-raceway" ? row.outer : row.inner;
      return row.orbit.map((_, k) => ({ s: this._place(now, k), force: forces[k] }));
    }
    // A roller's surface passes under two lines of contact, one on each raceway.
    const k = Math.min(this._rollerOf, row.orbit.length) - 1,
      angle = Number(row.orbit[k] - row.spin[k]);
    const at = (/** @type {number} */ a) => (Math.atan2(Math.sin(a), Math.cos(a)) / (2 * Math.PI)) * this.turn;
    return [
      { s: at(angle), force: row.outer[k] },
      { s: at(angle + Math.PI), force: row.inner[k] },
    ];
  }

  /** @param {number} now */
  _paint(now) {
    const dt = Math.min(0.1, (now - this._last) / 1000);
    this._last = now;
    if (!this._geometry || !this._width || !this.checkVisibility()) return;
    const g = this.canvas.getContext("2d"),
      ratio = this.canvas.width / this._width;
    if (!g) return;
    this._colours ??= colours(this);
    // All of the turn in view is in the middle.
    if (this._view.scale * this.turn < this._width) this._view.s = 0;
    g.setTransform(ratio, 0, 0, ratio, 0, 0);
    this.instant = this._player.step(this.frozen || still() ? 0 : dt);
    draw(g, this._scene(this._contacts(this.instant)), this._colours);
  }

  /** @param {import("./raceway-draw.js").Contact[]} contacts @returns {import("./raceway-draw.js").Scene} */
  _scene(contacts) {
    const g = this._geometry,
      offset = this.defect?.axial_offset_mm ?? 0;
    const heaviest = this._surface === "roller" ? Math.max(1e-9, ...contacts.map((c) => c.force)) : this._felt.heaviest;
    return {
      width: this._width,
      height: this._height,
      turn: this.turn,
      across: g.length_mm,
      view: this._view,
      damage: this._damage,
      selected: this.selected,
      contacts,
      half: this._surface === "roller" ? 0 : g.element_mm,
      ball: g.element === "ball",
      heaviest,
      forces: this._felt.forces,
      load: this._surface === "outer-raceway" && this.loadDeg !== null ? (this.loadDeg / 360) * this.turn : null,
      stroke: this._corners.list.length
        ? { points: this._corners.shown, width: 0, closed: true, words: this._corners.words }
        : this._stroke && { points: this._stroke, width: this.penWidth, closed: false },
      cursor: this._cursor,
      handles: this._tool === "select" ? handles(this.defect?.shape).map(([s, z]) => [s, z + offset]) : [],
    };
  }

  /** @param {PointerEvent | MouseEvent} e @returns {[number, number]} */
  _pixel(e) {
    const box = this.canvas.getBoundingClientRect();
    return [e.clientX - box.left, e.clientY - box.top];
  }

  /** @param {[number, number]} pixel @returns {Place} */
  _mm([x, y]) {
    return [this._view.s + (x - this._width / 2) / this._view.scale, (middle(this._scene([])) - y) / this._view.scale];
  }

  /** Brings a place into view. @param {number} defect */
  reveal(defect) {
    const one = this._damage.find((d) => d.defect === defect);
    if (!one) return;
    const [l, , r] = box(one),
      scene = this._scene([]);
    if (!copies(scene, one.s, 0).some((s) => xOf(scene, s + l) > 0 && xOf(scene, s + r) < this._width))
      this._view = { ...this._view, s: one.s };
  }
}
