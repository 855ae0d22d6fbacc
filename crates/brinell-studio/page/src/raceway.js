// <brinell-raceway>: the raceway unrolled, rollers running over it in slow motion, damage drawn on it with pointer or keys.
import { still } from "./dom.js";
import { Felt, Player } from "./player.js";
import { TOP, colours, copies, draw, middle, xOf, yOf } from "./raceway-draw.js";
import { Corners, TOOL_KEYS, box, handles, hits, resized, shapeBetween } from "./tools.js";

/** @typedef {import("./tools.js").Tool} Tool */
/** @typedef {import("./tools.js").Request} Request */
/** @typedef {[number, number]} Place */

const HANDLE_PX = 11,
  SLIP_PX = 5;
// Clicks that follow each other so soon at one place are one.
const DOUBLE_MS = 450,
  SAME_PX = 3;
const NEAREST = 400;

export class Raceway extends HTMLElement {
  /** @type {"outer-raceway" | "inner-raceway" | "roller"} */
  #surface = "outer-raceway";
  #row = 1;
  #rollerOf = 1;
  /** @type {any} */
  #geometry = null;
  #player = new Player();
  /** @type {any[]} */
  #damage = [];
  #felt = new Felt();
  /** @type {any} */
  #drag = null;
  /** @type {Map<number, Place>} */
  #fingers = new Map();
  #corners = new Corners();
  /** The last click of a tool that places something. */
  #tapped = { at: -Infinity, pixel: [0, 0] };
  /** @type {Place[] | null} */
  #stroke = null;
  /** @type {Place | null} */
  #cursor = null;
  #view = { s: 0, scale: 0 };
  #last = 0;
  #width = 0;
  #height = 0;
  /** @type {import("./raceway-draw.js").Colours | null} */
  #colours = null;
  /** @type {Tool} */
  #tool = "pen";
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

  connectedCallback() {
    const canvas = this.canvas;
    canvas.tabIndex = 0;
    canvas.setAttribute("role", "application");
    canvas.setAttribute("aria-roledescription", "unrolled raceway");
    this.append(canvas);
    this.describe();
    canvas.addEventListener("pointerdown", (e) => this.#down(e));
    canvas.addEventListener("pointermove", (e) => this.#move(e));
    canvas.addEventListener("pointerup", (e) => this.#up(e));
    canvas.addEventListener("pointercancel", (e) => this.#cancel(e));
    canvas.addEventListener("dblclick", () => this.#close());
    canvas.addEventListener("pointerleave", () => {
      this.#corners.next = null;
    });
    canvas.addEventListener("keydown", (e) => this.#key(e));
    canvas.addEventListener("blur", () => {
      this.#cursor = null;
    });
    canvas.addEventListener("wheel", (e) => this.#wheel(e), { passive: false });
    new ResizeObserver(() => this.#size()).observe(canvas);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => {
      this.#colours = null;
    });
    const frame = (/** @type {number} */ now) => {
      if (!this.isConnected) return;
      this.#paint(now);
      requestAnimationFrame(frame);
    };
    requestAnimationFrame(frame);
  }

  get tool() {
    return this.#tool;
  }
  /** @param {Tool} tool */
  set tool(tool) {
    this.#tool = tool;
    this.#corners.clear();
    this.#stroke = null;
    this.canvas.style.cursor = tool === "select" ? "default" : "crosshair";
  }

  get surface() {
    return this.#surface;
  }

  /** Which surface is unrolled. @param {typeof this.surface} surface @param {number} row @param {number} roller */
  show(surface, row, roller) {
    const other = surface !== this.#surface;
    [this.#surface, this.#row, this.#rollerOf] = [surface, row, roller];
    this.#felt.clear();
    if (other) {
      this.#corners.clear();
      this.fit();
    }
    this.describe();
  }

  get geometry() {
    return this.#geometry;
  }
  /** @param {any} geometry */
  set geometry(geometry) {
    const first = !this.#geometry || JSON.stringify(geometry) !== JSON.stringify(this.#geometry);
    this.#geometry = geometry;
    if (!first) return;
    this.#player.reset(geometry.elements);
    this.#felt.clear();
    this.fit();
  }

  /** @param {any[]} damage on this surface */
  set damage(damage) {
    this.#damage = damage.map((one) => ({
      ...one,
      s: (one.center_deg / 360) * this.turn,
      z: one.axial_offset_mm ?? 0,
    }));
    this.#player.edited();
    this.describe();
  }

  /** @param {any} frames */
  set frames(frames) {
    this.#player.push(frames);
    if (this.#surface !== "roller" && frames?.rows) this.#felt.take(frames, this.#surface, this.#row, this.#geometry?.elements ?? 0);
  }

  /** Real seconds for a simulated one. @param {number} slowness */
  set slowness(slowness) {
    this.#player.slowness = slowness;
  }

  /** Length of the whole turn, mm. */
  get turn() {
    const g = this.#geometry,
      radius = !g ? 1 : this.#surface === "outer-raceway" ? g.outer_mm : this.#surface === "inner-raceway" ? g.inner_mm : g.element_mm;
    return 2 * Math.PI * radius;
  }

  /** @param {Request} request */
  #send(request) {
    this.dispatchEvent(new CustomEvent("draw", { detail: request }));
  }

  describe(words = "") {
    const names = {
      "outer-raceway": "Outer raceway",
      "inner-raceway": "Inner raceway",
      roller: `Roller ${this.#rollerOf}`,
    };
    const there = this.#damage.length ? `${this.#damage.length} damaged ${this.#damage.length === 1 ? "place" : "places"}` : "no damage";
    this.canvas.setAttribute(
      "aria-label",
      `${names[this.#surface]}, row ${this.#row}, unrolled: ${there}. ${words} Enter draws with the tool, arrows move.`,
    );
  }

  #size() {
    const { clientWidth, clientHeight } = this.canvas,
      ratio = devicePixelRatio || 1;
    [this.#width, this.#height] = [clientWidth, clientHeight];
    this.canvas.width = Math.round(clientWidth * ratio);
    this.canvas.height = Math.round(clientHeight * ratio);
    if (!this.#view.scale) this.fit();
  }

  /** The width of the surface fills the height; the load's place, or the selected damage, is in the middle. */
  fit() {
    if (!this.#geometry || !this.#height) return;
    const scale = (this.#height - 80) / (1.15 * this.#geometry.length_mm);
    const chosen = this.#damage.find((one) => one.defect === this.selected) ?? this.#damage[0];
    this.#view = {
      scale,
      s:
        scale * this.turn < this.#width
          ? 0
          : (chosen?.s ?? (this.#surface === "outer-raceway" ? ((this.loadDeg ?? 0) / 360) * this.turn : 0)),
    };
  }

  /** @param {number} factor @param {number} [x] */
  zoom(factor, x = this.#width / 2) {
    const view = this.#view,
      s = view.s + (x - this.#width / 2) / view.scale;
    const scale = Math.max((0.3 * this.#width) / this.turn, Math.min(NEAREST, view.scale * factor));
    this.#view = { scale, s: scale * this.turn < this.#width ? 0 : s - (x - this.#width / 2) / scale };
  }

  /** @param {import("./player.js").Now} now @param {number} index */
  #place(now, index) {
    const row = now.rows[this.#row - 1];
    /** @type {number} */
    const angle = row.orbit[index] - (this.#surface === "inner-raceway" ? now.ring : 0);
    const turned = Math.atan2(Math.sin(angle), Math.cos(angle));
    return (turned / (2 * Math.PI)) * this.turn;
  }

  /** Contact lines at an instant. @param {import("./player.js").Now | null} now @returns {import("./raceway-draw.js").Contact[]} */
  #contacts(now) {
    const row = now?.rows[this.#row - 1];
    if (!now || !row) return [];
    if (this.#surface !== "roller") {
      const forces = this.#surface === "outer-raceway" ? row.outer : row.inner;
      return row.orbit.map((_, k) => ({ s: this.#place(now, k), force: forces[k] }));
    }
    // A roller's surface passes under two lines of contact, one on each raceway.
    const k = Math.min(this.#rollerOf, row.orbit.length) - 1,
      angle = Number(row.orbit[k] - row.spin[k]);
    const at = (/** @type {number} */ a) => (Math.atan2(Math.sin(a), Math.cos(a)) / (2 * Math.PI)) * this.turn;
    return [
      { s: at(angle), force: row.outer[k] },
      { s: at(angle + Math.PI), force: row.inner[k] },
    ];
  }

  /** @param {number} now */
  #paint(now) {
    const dt = Math.min(0.1, (now - this.#last) / 1000);
    this.#last = now;
    if (!this.#geometry || !this.#width || !this.checkVisibility()) return;
    const g = this.canvas.getContext("2d"),
      ratio = this.canvas.width / this.#width;
    if (!g) return;
    this.#colours ??= colours(this);
    // All of the turn in view is in the middle.
    if (this.#view.scale * this.turn < this.#width) this.#view.s = 0;
    g.setTransform(ratio, 0, 0, ratio, 0, 0);
    this.instant = this.#player.step(this.frozen || still() ? 0 : dt);
    draw(g, this.#scene(this.#contacts(this.instant)), this.#colours);
  }

  /** @param {import("./raceway-draw.js").Contact[]} contacts @returns {import("./raceway-draw.js").Scene} */
  #scene(contacts) {
    const g = this.#geometry,
      offset = this.defect?.axial_offset_mm ?? 0;
    const heaviest = this.#surface === "roller" ? Math.max(1e-9, ...contacts.map((c) => c.force)) : this.#felt.heaviest;
    return {
      width: this.#width,
      height: this.#height,
      turn: this.turn,
      across: g.length_mm,
      view: this.#view,
      damage: this.#damage,
      selected: this.selected,
      contacts,
      half: this.#surface === "roller" ? 0 : g.element_mm,
      ball: g.element === "ball",
      heaviest,
      forces: this.#felt.forces,
      load: this.#surface === "outer-raceway" && this.loadDeg !== null ? (this.loadDeg / 360) * this.turn : null,
      stroke: this.#corners.list.length
        ? { points: this.#corners.shown, width: 0, closed: true, words: this.#corners.words }
        : this.#stroke && { points: this.#stroke, width: this.penWidth, closed: false },
      cursor: this.#cursor,
      handles: this.#tool === "select" ? handles(this.defect?.shape).map(([s, z]) => [s, z + offset]) : [],
    };
  }

  // Pointer.

  /** @param {PointerEvent | MouseEvent} e @returns {[number, number]} */
  #pixel(e) {
    const box = this.canvas.getBoundingClientRect();
    return [e.clientX - box.left, e.clientY - box.top];
  }

  /** @param {[number, number]} pixel @returns {Place} */
  #mm([x, y]) {
    return [this.#view.s + (x - this.#width / 2) / this.#view.scale, (middle(this.#scene([])) - y) / this.#view.scale];
  }

  /** @param {PointerEvent} e */
  #down(e) {
    if (!this.#geometry || e.button > 1) return;
    const pixel = this.#pixel(e);
    this.canvas.setPointerCapture(e.pointerId);
    this.#fingers.set(e.pointerId, pixel);
    this.#cursor = null;
    if (this.#fingers.size === 2) return this.#pinch();
    if (this.#fingers.size > 2) return;
    const at = this.#mm(pixel),
      drag = { from: at, pixel, moved: false, base: null, kind: "" };
    if (pixel[1] < TOP) {
      this.#drag = { ...drag, kind: "overview" };
      this.#slide(pixel);
    } else if (e.button === 1) this.#drag = { ...drag, kind: "pan", view: this.#view };
    else if (this.#tool === "select") this.#drag = this.#grasp(drag);
    else if (this.#tool === "points") this.#drag = { ...drag, kind: "corner" };
    else this.#drag = { ...drag, kind: this.#tool === "pen" || this.#tool === "brush" ? "stroke" : "shape", begun: false };
  }

  /** What the select tool takes hold of. @param {any} drag */
  #grasp(drag) {
    const scene = this.#scene([]),
      [x, y] = drag.pixel;
    const chosen = this.#damage.find((one) => one.defect === this.selected);
    if (chosen) {
      for (const s of copies(scene, chosen.s, 20)) {
        const which = scene.handles.findIndex(([hs, hz]) => Math.hypot(xOf(scene, s + hs) - x, yOf(scene, hz) - y) < HANDLE_PX);
        if (which >= 0)
          return {
            ...drag,
            kind: "resize",
            which,
            s,
            z: this.defect.axial_offset_mm ?? 0,
            shape: structuredClone(this.defect.shape),
            center: chosen.s,
          };
      }
    }
    for (const one of this.#damage.toReversed()) {
      for (const s of copies(scene, one.s, 20)) {
        if (!hits(one, drag.from[0] - s, drag.from[1] - one.z, HANDLE_PX / this.#view.scale)) continue;
        this.#send({ type: "select", defect: one.defect });
        return { ...drag, kind: "move", s: one.s, z: this.defect?.axial_offset_mm ?? 0 };
      }
    }
    return { ...drag, kind: "pan", view: this.#view };
  }

  /** @param {PointerEvent} e */
  #move(e) {
    const pixel = this.#pixel(e),
      drag = this.#drag;
    if (this.#corners.list.length) this.#corners.next = this.#mm(pixel);
    if (!this.#fingers.has(e.pointerId)) return;
    this.#fingers.set(e.pointerId, pixel);
    if (!drag) return;
    if (drag.kind === "pinch") return this.#spread();
    // A finger that rests has not drawn yet: a second one may come.
    if (
      !drag.moved &&
      Math.hypot(pixel[0] - drag.pixel[0], pixel[1] - drag.pixel[1]) < (e.pointerType === "touch" ? 2 * SLIP_PX : SLIP_PX / 2)
    )
      return;
    drag.moved = true;
    const at = this.#mm(pixel);
    if (drag.kind === "overview") this.#slide(pixel);
    else if (drag.kind === "pan") this.#view = { ...drag.view, s: drag.view.s - (pixel[0] - drag.pixel[0]) / drag.view.scale };
    else this.#pull(drag, at, e);
  }

  /** @param {any} drag @param {Place} at @param {PointerEvent} e */
  #pull(drag, at, e) {
    const begin = () => {
      if (!drag.begun) this.#send({ type: "begin" });
      drag.begun = true;
    };
    begin();
    if (drag.kind === "stroke") {
      this.#stroke ??= [drag.from];
      for (const one of e.getCoalescedEvents?.() ?? []) this.#along(this.#mm(this.#pixel(one)));
      this.#along(at);
      this.#send({ type: "stroke", tool: /** @type {any} */ (this.#tool), points: this.#stroke, fresh: false });
    } else if (drag.kind === "shape") this.#send({ type: "shape", ...shapeBetween(this.#tool, drag.from, at, this.#geometry.length_mm) });
    else if (drag.kind === "move") this.#send({ type: "move", s: drag.s + at[0] - drag.from[0], z: drag.z + at[1] - drag.from[1] });
    else if (drag.kind === "resize") {
      const { shape, ds, dz } = resized(drag.shape, drag.which, [at[0] - drag.s, at[1] - drag.z]);
      this.#send({ type: "resize", shape });
      if (ds || dz) this.#send({ type: "move", s: drag.center + ds, z: drag.z + dz });
    }
  }

  /** A point of the stroke, unless it is where the last one was. @param {Place} at */
  #along(at) {
    const last = this.#stroke?.at(-1);
    if (last && Math.hypot(at[0] - last[0], at[1] - last[1]) * this.#view.scale > 1.5) this.#stroke?.push(at);
  }

  /** @param {PointerEvent} e */
  #up(e) {
    if (!this.#fingers.delete(e.pointerId)) return;
    const drag = this.#drag;
    if (this.#fingers.size || !drag) return;
    this.#drag = null;
    if (drag.kind === "corner") return this.#corner(drag.moved ? this.#mm(this.#pixel(e)) : drag.from);
    if (drag.kind === "pan" && !drag.moved && this.#tool === "select") this.#send({ type: "select", defect: 0 });
    if (drag.kind === "stroke" || drag.kind === "shape") {
      if (!drag.moved) this.#tap(drag);
      this.#send({ type: "end" });
    } else if (drag.begun) this.#send({ type: "end" });
    this.#stroke = null;
  }

  /** A click places the usual shape, or one dot of the pen. @param {any} drag */
  #tap(drag) {
    const [before, now] = [this.#tapped, performance.now()];
    this.#tapped = { at: now, pixel: drag.pixel };
    if (now - before.at < DOUBLE_MS && Math.hypot(drag.pixel[0] - before.pixel[0], drag.pixel[1] - before.pixel[1]) < 2 * SLIP_PX) return;
    this.#send({ type: "begin" });
    if (drag.kind === "shape") this.#send({ type: "shape", ...shapeBetween(this.#tool, drag.from, drag.from, this.#geometry.length_mm) });
    else
      this.#send({
        type: "stroke",
        tool: /** @type {any} */ (this.#tool),
        points: [drag.from, [drag.from[0] + 0.01, drag.from[1]]],
        fresh: true,
      });
  }

  /** @param {PointerEvent} e */
  #cancel(e) {
    this.#fingers.delete(e.pointerId);
    if (this.#drag?.begun) this.#send({ type: "cancel" });
    this.#drag = this.#stroke = null;
  }

  /** @param {Place} at */
  #corner(at) {
    if (this.#corners.closes(at, HANDLE_PX / this.#view.scale)) return this.#close();
    this.#corners.list.push(at);
  }

  /** Closes the outline of the points tool. */
  #close() {
    const outline = this.#corners.closed(SAME_PX / this.#view.scale);
    if (!outline) return;
    this.#send({ type: "begin" });
    this.#send({ type: "shape", ...outline });
    this.#send({ type: "end" });
  }

  #pinch() {
    if (this.#drag?.begun) this.#send({ type: "cancel" });
    this.#stroke = null;
    const [a, b] = [...this.#fingers.values()];
    this.#drag = {
      kind: "pinch",
      view: this.#view,
      apart: Math.max(20, Math.hypot(a[0] - b[0], a[1] - b[1])),
      x: (a[0] + b[0]) / 2,
    };
  }

  #spread() {
    if (this.#fingers.size < 2) return;
    const [a, b] = [...this.#fingers.values()],
      { view, apart, x } = this.#drag,
      now = (a[0] + b[0]) / 2;
    this.#view = { ...view, s: view.s - (now - x) / view.scale };
    this.zoom(Math.hypot(a[0] - b[0], a[1] - b[1]) / apart, now);
  }

  /** @param {[number, number]} pixel */
  #slide(pixel) {
    this.#view = { ...this.#view, s: (pixel[0] / this.#width - 0.5) * this.turn };
  }

  /** @param {WheelEvent} e */
  #wheel(e) {
    if (Math.abs(e.deltaX) > Math.abs(e.deltaY)) this.#view = { ...this.#view, s: this.#view.s + e.deltaX / this.#view.scale };
    else if (e.ctrlKey || document.activeElement === this.canvas) this.zoom(Math.exp(-e.deltaY / 400), this.#pixel(e)[0]);
    else return;
    e.preventDefault();
  }

  // Keys.

  /** @param {KeyboardEvent} e */
  #key(e) {
    const arrows = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
    const arrow = arrows[/** @type {keyof typeof arrows} */ (e.key)],
      tool = TOOL_KEYS[e.key.toLowerCase()],
      command = e.ctrlKey || e.metaKey;
    if (!this.#geometry) return;
    if (command && e.key.toLowerCase() === "z") this.#send({ type: e.shiftKey ? "redo" : "undo" });
    else if (command && e.key.toLowerCase() === "y") this.#send({ type: "redo" });
    else if (command || e.altKey) return;
    else if (arrow) this.#step(arrow, e.shiftKey ? 10 : 1);
    else if (e.key === "[" || e.key === "]") this.#send({ type: "deeper", factor: e.key === "]" ? 1 : -1 });
    else if (this.#corners.list.length && (e.key === "Delete" || e.key === "Backspace")) this.#corners.list.pop();
    else if (e.key === "Delete" || e.key === "Backspace") this.#send({ type: "delete" });
    else if (e.key === "Enter") this.#enter();
    else if (e.key === "Escape") this.#escape();
    else if (e.key === "PageDown" || e.key === "PageUp") this.#next(e.key === "PageDown" ? 1 : -1);
    else if (e.key === "+" || e.key === "-") this.zoom(e.key === "+" ? 1.25 : 0.8);
    else if (e.key === "0") this.fit();
    else if (tool) this.dispatchEvent(new CustomEvent("tool", { detail: tool }));
    else return;
    e.preventDefault();
    e.stopPropagation();
  }

  /** Arrows move the selected damage by 1 degree or 0.1 mm; without one, the place where the tool draws. @param {number[]} arrow @param {number} times */
  #step([ds, dz], times) {
    const degree = this.turn / 360,
      chosen = this.#damage.find((one) => one.defect === this.selected);
    if (chosen && this.defect && !this.#cursor) {
      this.#send({ type: "shift", degrees: ds * times, z: dz * 0.1 * times });
      return;
    }
    const at = this.#cursor ?? [this.#view.s, 0];
    this.#cursor = [at[0] + ds * degree * times, at[1] + dz * 0.1 * times];
    if (this.#stroke) {
      this.#stroke.push(this.#cursor);
      this.#send({ type: "stroke", tool: /** @type {any} */ (this.#tool), points: this.#stroke, fresh: false });
    }
    const shown = xOf(this.#scene([]), this.#cursor[0]);
    if (shown < 20 || shown > this.#width - 20) this.#view = { ...this.#view, s: this.#cursor[0] };
  }

  /** Enter puts the tool down where the keyboard's place is; pen and brush are lifted by it again. */
  #enter() {
    if (this.#tool === "select") return this.#next(1);
    // Corners that the pointer set are closed by Enter; the keys set them where their own place is.
    if (!this.#cursor && this.#corners.list.length) return this.#close();
    if (!this.#cursor) {
      this.selected = 0;
      this.#send({ type: "select", defect: 0 });
      this.#cursor = [this.#view.s, 0];
    }
    const at = this.#cursor;
    if (this.#stroke) {
      this.#stroke = this.#cursor = null;
      this.#send({ type: "end" });
    } else if (this.#tool === "points") {
      const { list } = this.#corners;
      if (list.length > 2 && [list[0], list.at(-1)].some((p) => p && Math.hypot(p[0] - at[0], p[1] - at[1]) < 1e-6)) {
        this.#cursor = null;
        this.#close();
      } else list.push(at);
    } else if (this.#tool === "pen" || this.#tool === "brush") {
      this.#stroke = [at];
      this.#send({ type: "begin" });
      this.#send({ type: "stroke", tool: this.#tool, points: [at, [at[0] + 0.01, at[1]]], fresh: true });
    } else {
      this.#cursor = null;
      this.#send({ type: "begin" });
      this.#send({ type: "shape", ...shapeBetween(this.#tool, at, at, this.#geometry.length_mm) });
      this.#send({ type: "end" });
    }
  }

  /** Takes back what is being drawn; else what is selected is let go. */
  #escape() {
    if (this.#drag?.begun || this.#stroke) this.#send({ type: "cancel" });
    else if (!this.#corners.list.length && !this.#cursor) this.#send({ type: "select", defect: 0 });
    this.#corners.clear();
    this.#drag = this.#stroke = this.#cursor = null;
  }

  /** @param {number} way */
  #next(way) {
    const list = this.#damage.map((one) => one.defect),
      at = list.indexOf(this.selected);
    this.#cursor = null;
    if (list.length) this.#send({ type: "select", defect: list[(at + way + list.length) % list.length] });
  }

  /** Brings a place into view. @param {number} defect */
  reveal(defect) {
    const one = this.#damage.find((d) => d.defect === defect);
    if (!one) return;
    const [l, , r] = box(one),
      scene = this.#scene([]);
    if (!copies(scene, one.s, 0).some((s) => xOf(scene, s + l) > 0 && xOf(scene, s + r) < this.#width))
      this.#view = { ...this.#view, s: one.s };
  }
}

customElements.define("brinell-raceway", Raceway);
