// <brinell-raceway>: damage drawn with pointer or keys on the unrolled raceway.
import { TOP, copies, xOf, yOf } from "./raceway-draw.js";
import { RacewaySurface } from "./raceway-surface.js";
import { TOOL_KEYS, hits, resized, shapeBetween } from "./tools.js";

/** @typedef {import("./tools.js").Request} Request */
/** @typedef {[number, number]} Place */

const HANDLE_PX = 11,
  SLIP_PX = 5;
// Clicks that follow each other so soon at one place are one.
const DOUBLE_MS = 450,
  SAME_PX = 3;

export class Raceway extends RacewaySurface {
  connectedCallback() {
    const canvas = this.canvas;
    canvas.tabIndex = 0;
    canvas.setAttribute("role", "application");
    canvas.setAttribute("aria-roledescription", "unrolled raceway");
    this.append(canvas);
    this.describe();
    canvas.addEventListener("pointerdown", (e) => this._down(e));
    canvas.addEventListener("pointermove", (e) => this._move(e));
    canvas.addEventListener("pointerup", (e) => this._up(e));
    canvas.addEventListener("pointercancel", (e) => this._cancel(e));
    canvas.addEventListener("dblclick", () => this._close());
    canvas.addEventListener("pointerleave", () => {
      this._corners.next = null;
    });
    canvas.addEventListener("keydown", (e) => this._key(e));
    canvas.addEventListener("blur", () => {
      this._cursor = null;
    });
    canvas.addEventListener("wheel", (e) => this._wheel(e), { passive: false });
    new ResizeObserver(() => this._size()).observe(canvas);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => {
      this._colours = null;
    });
    const frame = (/** @type {number} */ now) => {
      if (!this.isConnected) return;
      this._paint(now);
      requestAnimationFrame(frame);
    };
    requestAnimationFrame(frame);
  }

  // Pointer.

  /** @param {PointerEvent} e */
  _down(e) {
    if (!this._geometry || e.button > 1) return;
    const pixel = this._pixel(e);
    this.canvas.setPointerCapture(e.pointerId);
    this._fingers.set(e.pointerId, pixel);
    this._cursor = null;
    if (this._fingers.size === 2) return this._pinch();
    if (this._fingers.size > 2) return;
    const at = this._mm(pixel),
      drag = { from: at, pixel, moved: false, base: null, kind: "" };
    if (pixel[1] < TOP) {
      this._drag = { ...drag, kind: "overview" };
      this._slide(pixel);
    } else if (e.button === 1) this._drag = { ...drag, kind: "pan", view: this._view };
    else if (this._tool === "select") this._drag = this._grasp(drag);
    else if (this._tool === "points") this._drag = { ...drag, kind: "corner" };
    else this._drag = { ...drag, kind: this._tool === "pen" || this._tool === "brush" ? "stroke" : "shape", begun: false };
  }

  /** What the select tool takes hold of. @param {any} drag */
  _grasp(drag) {
    const scene = this._scene([]),
      [x, y] = drag.pixel;
    const chosen = this._damage.find((one) => one.defect === this.selected);
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
    for (const one of this._damage.toReversed()) {
      for (const s of copies(scene, one.s, 20)) {
        if (!hits(one, drag.from[0] - s, drag.from[1] - one.z, HANDLE_PX / this._view.scale)) continue;
        this._send({ type: "select", defect: one.defect });
        return { ...drag, kind: "move", s: one.s, z: this.defect?.axial_offset_mm ?? 0 };
      }
    }
    return { ...drag, kind: "pan", view: this._view };
  }

  /** @param {PointerEvent} e */
  _move(e) {
    const pixel = this._pixel(e),
      drag = this._drag;
    if (this._corners.list.length) this._corners.next = this._mm(pixel);
    if (!this._fingers.has(e.pointerId)) return;
    this._fingers.set(e.pointerId, pixel);
    if (!drag) return;
    if (drag.kind === "pinch") return this._spread();
    // A finger that rests has not drawn yet: a second one may come.
    if (
      !drag.moved &&
      Math.hypot(pixel[0] - drag.pixel[0], pixel[1] - drag.pixel[1]) < (e.pointerType === "touch" ? 2 * SLIP_PX : SLIP_PX / 2)
    )
      return;
    drag.moved = true;
    const at = this._mm(pixel);
    if (drag.kind === "overview") this._slide(pixel);
    else if (drag.kind === "pan") this._view = { ...drag.view, s: drag.view.s - (pixel[0] - drag.pixel[0]) / drag.view.scale };
    else this._pull(drag, at, e);
  }

  /** @param {any} drag @param {Place} at @param {PointerEvent} e */
  _pull(drag, at, e) {
    const begin = () => {
      if (!drag.begun) this._send({ type: "begin" });
      drag.begun = true;
    };
    begin();
    if (drag.kind === "stroke") {
      this._stroke ??= [drag.from];
      for (const one of e.getCoalescedEvents?.() ?? []) this._along(this._mm(this._pixel(one)));
      this._along(at);
      this._send({ type: "stroke", tool: /** @type {any} */ (this._tool), points: this._stroke, fresh: false });
    } else if (drag.kind === "shape") this._send({ type: "shape", ...shapeBetween(this._tool, drag.from, at, this._geometry.length_mm) });
    else if (drag.kind === "move") this._send({ type: "move", s: drag.s + at[0] - drag.from[0], z: drag.z + at[1] - drag.from[1] });
    else if (drag.kind === "resize") {
      const { shape, ds, dz } = resized(drag.shape, drag.which, [at[0] - drag.s, at[1] - drag.z]);
      this._send({ type: "resize", shape });
      if (ds || dz) this._send({ type: "move", s: drag.center + ds, z: drag.z + dz });
    }
  }

  /** A point of the stroke, unless it is where the last one was. @param {Place} at */
  _along(at) {
    const last = this._stroke?.at(-1);
    if (last && Math.hypot(at[0] - last[0], at[1] - last[1]) * this._view.scale > 1.5) this._stroke?.push(at);
  }

  /** @param {PointerEvent} e */
  _up(e) {
    if (!this._fingers.delete(e.pointerId)) return;
    const drag = this._drag;
    if (this._fingers.size || !drag) return;
    this._drag = null;
    if (drag.kind === "corner") return this._corner(drag.moved ? this._mm(this._pixel(e)) : drag.from);
    if (drag.kind === "pan" && !drag.moved && this._tool === "select") this._send({ type: "select", defect: 0 });
    if (drag.kind === "stroke" || drag.kind === "shape") {
      if (!drag.moved) this._tap(drag);
      this._send({ type: "end" });
    } else if (drag.begun) this._send({ type: "end" });
    this._stroke = null;
  }

  /** A click places the usual shape, or one dot of the pen. @param {any} drag */
  _tap(drag) {
    const [before, now] = [this._tapped, performance.now()];
    this._tapped = { at: now, pixel: drag.pixel };
    if (now - before.at < DOUBLE_MS && Math.hypot(drag.pixel[0] - before.pixel[0], drag.pixel[1] - before.pixel[1]) < 2 * SLIP_PX) return;
    this._send({ type: "begin" });
    if (drag.kind === "shape") this._send({ type: "shape", ...shapeBetween(this._tool, drag.from, drag.from, this._geometry.length_mm) });
    else
      this._send({
        type: "stroke",
        tool: /** @type {any} */ (this._tool),
        points: [drag.from, [drag.from[0] + 0.01, drag.from[1]]],
        fresh: true,
      });
  }

  /** @param {PointerEvent} e */
  _cancel(e) {
    this._fingers.delete(e.pointerId);
    if (this._drag?.begun) this._send({ type: "cancel" });
    this._drag = this._stroke = null;
  }

  /** @param {Place} at */
  _corner(at) {
    if (this._corners.closes(at, HANDLE_PX / this._view.scale)) return this._close();
    this._corners.list.push(at);
  }

  /** Closes the outline of the points tool. */
  _close() {
    const outline = this._corners.closed(SAME_PX / this._view.scale);
    if (!outline) return;
    this._send({ type: "begin" });
    this._send({ type: "shape", ...outline });
    this._send({ type: "end" });
  }

  _pinch() {
    if (this._drag?.begun) this._send({ type: "cancel" });
    this._stroke = null;
    const [a, b] = [...this._fingers.values()];
    this._drag = {
      kind: "pinch",
      view: this._view,
      apart: Math.max(20, Math.hypot(a[0] - b[0], a[1] - b[1])),
      x: (a[0] + b[0]) / 2,
    };
  }

  _spread() {
    if (this._fingers.size < 2) return;
    const [a, b] = [...this._fingers.values()],
      { view, apart, x } = this._drag,
      now = (a[0] + b[0]) / 2;
    this._view = { ...view, s: view.s - (now - x) / view.scale };
    this.zoom(Math.hypot(a[0] - b[0], a[1] - b[1]) / apart, now);
  }

  /** @param {[number, number]} pixel */
  _slide(pixel) {
    this._view = { ...this._view, s: (pixel[0] / this._width - 0.5) * this.turn };
  }

  /** @param {WheelEvent} e */
  _wheel(e) {
    if (Math.abs(e.deltaX) > Math.abs(e.deltaY)) this._view = { ...this._view, s: this._view.s + e.deltaX / this._view.scale };
    else if (e.ctrlKey || document.activeElement === this.canvas) this.zoom(Math.exp(-e.deltaY / 400), this._pixel(e)[0]);
    else return;
    e.preventDefault();
  }

  // Keys.

  /** @param {KeyboardEvent} e */
  _key(e) {
    const arrows = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
    const arrow = arrows[/** @type {keyof typeof arrows} */ (e.key)],
      tool = TOOL_KEYS[e.key.toLowerCase()],
      command = e.ctrlKey || e.metaKey;
    if (!this._geometry) return;
    if (command && e.key.toLowerCase() === "z") this._send({ type: e.shiftKey ? "redo" : "undo" });
    else if (command && e.key.toLowerCase() === "y") this._send({ type: "redo" });
    else if (command || e.altKey) return;
    else if (arrow) this._step(arrow, e.shiftKey ? 10 : 1);
    else if (e.key === "[" || e.key === "]") this._send({ type: "deeper", factor: e.key === "]" ? 1 : -1 });
    else if (this._corners.list.length && (e.key === "Delete" || e.key === "Backspace")) this._corners.list.pop();
    else if (e.key === "Delete" || e.key === "Backspace") this._send({ type: "delete" });
    else if (e.key === "Enter") this._enter();
    else if (e.key === "Escape") this._escape();
    else if (e.key === "PageDown" || e.key === "PageUp") this._next(e.key === "PageDown" ? 1 : -1);
    else if (e.key === "+" || e.key === "-") this.zoom(e.key === "+" ? 1.25 : 0.8);
    else if (e.key === "0") this.fit();
    else if (tool) this.dispatchEvent(new CustomEvent("tool", { detail: tool }));
    else return;
    e.preventDefault();
    e.stopPropagation();
  }

  /** Arrows move the selected damage by 1 degree or 0.1 mm; without one, the place where the tool draws. @param {number[]} arrow @param {number} times */
  _step([ds, dz], times) {
    const degree = this.turn / 360,
      chosen = this._damage.find((one) => one.defect === this.selected);
    if (chosen && this.defect && !this._cursor) {
      this._send({ type: "shift", degrees: ds * times, z: dz * 0.1 * times });
      return;
    }
    const at = this._cursor ?? [this._view.s, 0];
    this._cursor = [at[0] + ds * degree * times, at[1] + dz * 0.1 * times];
    if (this._stroke) {
      this._stroke.push(this._cursor);
      this._send({ type: "stroke", tool: /** @type {any} */ (this._tool), points: this._stroke, fresh: false });
    }
    const shown = xOf(this._scene([]), this._cursor[0]);
    if (shown < 20 || shown > this._width - 20) this._view = { ...this._view, s: this._cursor[0] };
  }

  /** Enter puts the tool down where the keyboard's place is; pen and brush are lifted by it again. */
  _enter() {
    if (this._tool === "select") return this._next(1);
    // Corners that the pointer set are closed by Enter; the keys set them where their own place is.
    if (!this._cursor && this._corners.list.length) return this._close();
    if (!this._cursor) {
      this.selected = 0;
      this._send({ type: "select", defect: 0 });
      this._cursor = [this._view.s, 0];
    }
    const at = this._cursor;
    if (this._stroke) {
      this._stroke = this._cursor = null;
      this._send({ type: "end" });
    } else if (this._tool === "points") {
      const { list } = this._corners;
      if (list.length > 2 && [list[0], list.at(-1)].some((p) => p && Math.hypot(p[0] - at[0], p[1] - at[1]) < 1e-6)) {
        this._cursor = null;
        this._close();
      } else list.push(at);
    } else if (this._tool === "pen" || this._tool === "brush") {
      this._stroke = [at];
      this._send({ type: "begin" });
      this._send({ type: "stroke", tool: this._tool, points: [at, [at[0] + 0.01, at[1]]], fresh: true });
    } else {
      this._cursor = null;
      this._send({ type: "begin" });
      this._send({ type: "shape", ...shapeBetween(this._tool, at, at, this._geometry.length_mm) });
      this._send({ type: "end" });
    }
  }

  /** Takes back what is being drawn; else what is selected is let go. */
  _escape() {
    if (this._drag?.begun || this._stroke) this._send({ type: "cancel" });
    else if (!this._corners.list.length && !this._cursor) this._send({ type: "select", defect: 0 });
    this._corners.clear();
    this._drag = this._stroke = this._cursor = null;
  }

  /** @param {number} way */
  _next(way) {
    const list = this._damage.map((one) => one.defect),
      at = list.indexOf(this.selected);
    this._cursor = null;
    if (list.length) this._send({ type: "select", defect: list[(at + way + list.length) % list.length] });
  }
}

customElements.define("brinell-raceway", Raceway);
