// Slow motion from the frames that `advance` gives: a clip is played until a newer one continues it at the same place of the rollers.

/** @typedef {{cage: number, orbit: number[], spin: number[], inner: number[], outer: number[]}} RowNow */
/** @typedef {{ring: number, rows: RowNow[]}} Now */

const KEPT = 96;

export class Player {
  /** Real seconds for a simulated one. */
  slowness = 100;
  #elements = 1;
  /** @type {Now[]} */
  #clip = [];
  /** @type {Now[]} */
  #newer = [];
  #dt = 1e-3;
  #at = 0;
  #swap = false;

  /** @param {number} elements */
  reset(elements) {
    this.#elements = elements;
    this.#clip = [];
    this.#newer = [];
  }

  /** The next clip is of another bearing: change over as soon as one is there. */
  edited() {
    this.#newer = [];
    this.#swap = true;
  }

  /** @param {any} frames */
  push(frames) {
    if (!frames?.count) return;
    this.#dt = frames.dt;
    const n = this.#elements;
    for (let k = 0; k < frames.count; k++) {
      const part = (/** @type {Float32Array} */ all) => Array.from(all.subarray(k * n, (k + 1) * n));
      this.#newer.push({
        ring: frames.ring[k],
        rows: frames.rows.map((/** @type {any} */ r) => ({
          cage: r.cage[k],
          orbit: part(r.orbit),
          spin: part(r.spin),
          inner: part(r.inner_n),
          outer: part(r.outer_n),
        })),
      });
    }
    if (this.#newer.length > KEPT) this.#newer.splice(0, this.#newer.length - KEPT);
    if (!this.#clip.length || (this.#swap && this.#newer.length >= 8)) this.#change();
  }

  #change() {
    const now = this.#clip.length ? this.#clip[Math.min(Math.floor(this.#at), this.#clip.length - 1)] : null;
    this.#clip = this.#newer.slice();
    this.#at = 0;
    this.#swap = false;
    const pitch = (2 * Math.PI) / this.#elements,
      first = now?.rows[0];
    if (!first) return;
    // The rollers of the new clip go on where those of the old one were.
    let best = Infinity;
    for (let k = 0; k < Math.min(this.#clip.length - 1, 24); k++) {
      const off = Math.abs(Math.sin((Math.PI * (this.#clip[k].rows[0].orbit[0] - first.orbit[0])) / pitch));
      if (off < best) [best, this.#at] = [off, k];
    }
  }

  /** The instant to show, `dt` real seconds after the last one. @param {number} dt @returns {Now | null} */
  step(dt) {
    const clip = this.#clip;
    if (!clip.length) return null;
    this.#at += dt / this.slowness / this.#dt;
    if (this.#at >= clip.length - 1) {
      if (this.#newer.length > 8) this.#change();
      else this.#at = clip.length - 1;
    }
    const k = Math.min(Math.floor(this.#at), this.#clip.length - 1),
      next = Math.min(k + 1, this.#clip.length - 1);
    return between(this.#clip[k], this.#clip[next], this.#at - k);
  }
}

/** @param {Now} a @param {Now} b @param {number} w @returns {Now} */
function between(a, b, w) {
  const mix = (/** @type {number} */ x, /** @type {number} */ y) => x + w * (y - x);
  // Angles may be given within a turn.
  const turn = (/** @type {number} */ x, /** @type {number} */ y) => x + w * Math.atan2(Math.sin(y - x), Math.cos(y - x));
  const each = (/** @type {number[]} */ x, /** @type {number[]} */ y, /** @type {typeof mix} */ f) => x.map((v, i) => f(v, y[i]));
  return {
    ring: turn(a.ring, b.ring),
    rows: a.rows.map((r, i) => {
      const s = b.rows[i];
      return {
        cage: turn(r.cage, s.cage),
        orbit: each(r.orbit, s.orbit, turn),
        spin: each(r.spin, s.spin, turn),
        inner: each(r.inner, s.inner, mix),
        outer: each(r.outer, s.outer, mix),
      };
    }),
  };
}

const BINS = 360,
  FADE = 0.995;

/** The largest force at each place of a surface; what was long ago fades. */
export class Felt {
  forces = new Float32Array(BINS);
  heaviest = 0;

  clear() {
    this.forces.fill(0);
    this.heaviest = 0;
  }

  /** @param {any} frames @param {"outer-raceway" | "inner-raceway"} surface @param {number} number of the row @param {number} elements */
  take(frames, surface, number, elements) {
    const row = frames.rows[number - 1];
    if (!elements || !row) return;
    const forces = surface === "outer-raceway" ? row.outer_n : row.inner_n;
    for (let k = 0; k < BINS; k++) this.forces[k] *= FADE;
    this.heaviest *= FADE;
    for (let f = 0; f < frames.count; f++) {
      for (let i = 0; i < elements; i++) {
        const force = forces[f * elements + i];
        /** @type {number} */
        const angle = row.orbit[f * elements + i] - (surface === "inner-raceway" ? frames.ring[f] : 0);
        const bin = Math.floor(((((angle / (2 * Math.PI) + 0.5) % 1) + 1) % 1) * BINS) % BINS;
        this.forces[bin] = Math.max(this.forces[bin], force);
        this.heaviest = Math.max(this.heaviest, force);
      }
    }
  }
}
