// The latest frames of the bearing in a ring buffer, and the playing of a few turns of them in slow motion.
// A clip is taken out of the buffer and shown; at its end the next one starts in the frame of the latest turns that looks most alike.

/** @typedef {{ cage: Float32Array, orbit: Float32Array, spin: Float32Array, inner_n: Float32Array, outer_n: Float32Array }} RowFrames */
/** @typedef {{ count: number, dt: number, ring: Float32Array, rows: RowFrames[] }} Frames what `advance` gives; angles in rad */
/** @typedef {{ cage: number, orbit: Float32Array, spin: Float32Array, inner: Float32Array, outer: Float32Array }} RowState */
/** @typedef {{ ring: number, rows: RowState[], largest: number }} State one instant */

const CAPACITY = 4096;
/** Turns of the shaft that are looked through for the next clip. */
const TURNS = 4;
const TAU = 2 * Math.PI;

/** An angle from -pi to pi. @param {number} a */
const wrap = (a) => a - TAU * Math.round(a / TAU);

export class Motion {
  /** @param {number} rows @param {number} elements */
  constructor(rows, elements) {
    this.rows = rows;
    this.elements = elements;
    // ring, gap before it, then of each row: cage, orbits, spins, inner forces, outer forces
    this.stride = 2 + rows * (1 + 4 * elements);
    this.buffer = new Float32Array(CAPACITY * this.stride);
    this.length = 0;
    this.next = 0;
    this.dt = 0;
    /** @type {Float32Array | null} */
    this.clip = null;
    this.frames = 0;
    /** Frames into the clip. */
    this.at = 0;
    /** Frames since the latest edit. */
    this.fresh = 0;
    this.largest = 0;
    /** @type {State} */
    this.state = {
      ring: 0,
      largest: 0,
      // Until there is a clip: at rest, evenly spaced.
      rows: Array.from({ length: rows }, () => ({
        cage: 0,
        orbit: Float32Array.from({ length: elements }, (_, e) => (TAU * (e + 0.5)) / elements),
        spin: new Float32Array(elements),
        inner: new Float32Array(elements),
        outer: new Float32Array(elements),
      })),
    };
  }

  /** Takes frames in. @param {Frames} frames */
  push(frames) {
    // An answer about another bearing may still arrive.
    if (frames.count < 1 || frames.rows.length !== this.rows || frames.rows[0].orbit.length !== frames.count * this.elements) return;
    if (this.dt && Math.abs(frames.dt - this.dt) > 1e-6 * this.dt) this.length = this.fresh = 0;
    this.dt = frames.dt;
    const n = this.elements,
      { buffer, stride } = this;
    for (let k = 0; k < frames.count; k++) {
      const base = this.next * stride;
      buffer[base] = frames.ring[k];
      let at = base + 2;
      for (let r = 0; r < this.rows; r++) {
        const row = frames.rows[r];
        buffer[at] = row.cage[k];
        for (const list of [row.orbit, row.spin, row.inner_n, row.outer_n]) {
          buffer.set(list.subarray(k * n, (k + 1) * n), at + 1);
          at += n;
        }
        at++;
      }
      // Frames of two answers that do not join are not blended.
      buffer[base + 1] = k === 0 && this.length > 0 && this.apart(frames) ? 1 : 0;
      this.next = (this.next + 1) % CAPACITY;
      this.length = Math.min(this.length + 1, CAPACITY);
      this.fresh++;
    }
  }
  /** @param {Frames} frames */
  apart(frames) {
    if (frames.count < 2) return false;
    const last = ((this.next - 1 + CAPACITY) % CAPACITY) * this.stride,
      step = wrap(frames.ring[1] - frames.ring[0]);
    return Math.abs(wrap(frames.ring[0] - this.buffer[last]) - step) > 0.5 * Math.abs(step) + 1e-4;
  }
  /** Start of the frame that is this many before the newest. @param {number} back */
  base(back) {
    return ((this.next - 1 - back + 2 * CAPACITY) % CAPACITY) * this.stride;
  }
  /** Frames in one turn of the shaft, of the newest ones. */
  perTurn() {
    if (this.length < 2) return Infinity;
    for (let back = 0; back + 1 < Math.min(this.length, 64); back++) {
      if (this.buffer[this.base(back) + 1]) continue;
      const step = Math.abs(wrap(this.buffer[this.base(back)] - this.buffer[this.base(back + 1)]));
      return step > 1e-6 ? TAU / step : Infinity;
    }
    return Infinity;
  }
  /** Takes the latest turns as the clip to show, from the frame that looks most like the one shown. @param {number} [turns] that are looked through */
  take(turns = TURNS) {
    if (!this.length) return false;
    // Not beyond the latest edit, once there is enough after it.
    const turn = Math.min(Math.ceil(this.perTurn()), this.length),
      renewed = this.fresh >= 1.5 * turn,
      far = Math.min(this.length, turns * turn, renewed ? this.fresh : Infinity) - 1;
    const near = far >= 2 * turn ? turn : Math.floor(far / 3);
    let start = far;
    if (this.clip) {
      let best = Infinity;
      for (let back = far; back >= near; back--) {
        const cost = this.unlike(this.base(back));
        if (cost < best) {
          best = cost;
          start = back;
        }
      }
    }
    this.frames = start + 1;
    this.clip = new Float32Array(this.frames * this.stride);
    this.largest = 0;
    for (let k = 0; k < this.frames; k++) {
      const base = this.base(start - k);
      this.clip.set(this.buffer.subarray(base, base + this.stride), k * this.stride);
    }
    for (let k = 0; k < this.frames; k++) this.largest = Math.max(this.largest, this.forces(k));
    this.at = 0;
    return true;
  }
  /** The largest force in a frame of the clip. @param {number} k */
  forces(k) {
    const clip = /** @type {Float32Array} */ (this.clip),
      n = this.elements;
    let most = 0;
    for (let r = 0; r < this.rows; r++) {
      const from = k * this.stride + 2 + r * (1 + 4 * n) + 1 + 2 * n;
      for (let i = from; i < from + 2 * n; i++) if (clip[i] > most) most = clip[i];
    }
    return most;
  }
  /** How far a frame in the buffer is from what is shown: the ring's angle, and the cage's within a pocket. @param {number} base */
  unlike(base) {
    const pocket = TAU / this.elements,
      row = this.state.rows[0];
    const cage = this.buffer[base + 2] - row.cage;
    return Math.abs(wrap(this.buffer[base] - this.state.ring)) + 2 * Math.abs(cage - pocket * Math.round(cage / pocket));
  }
  /** Goes on by this much simulated time, s. @param {number} time */
  go(time) {
    if (!this.clip && !this.take()) return;
    if (!this.dt) return;
    this.at += time / this.dt;
    if (this.at > this.frames - 1) {
      // The state shown is the end of the clip; the next one starts where it looks like that.
      this.show(this.frames - 1);
      this.take();
    }
    this.at = Math.min(Math.max(this.at, 0), this.frames - 1);
    this.show(this.at);
  }
  /** Puts the instant at this frame of the clip into `state`. @param {number} at */
  show(at) {
    const clip = this.clip;
    if (!clip) return;
    const n = this.elements,
      k = Math.min(Math.floor(at), this.frames - 1),
      a = k * this.stride,
      next = k + 1 < this.frames && !clip[(k + 1) * this.stride + 1];
    const b = next ? a + this.stride : a,
      f = next ? at - k : 0,
      state = this.state;
    const turn = (/** @type {number} */ i, /** @type {number} */ j) => clip[i] + f * wrap(clip[j] - clip[i]);
    state.ring = turn(a, b);
    state.largest = 0;
    for (let r = 0; r < this.rows; r++) {
      const row = state.rows[r],
        i = a + 2 + r * (1 + 4 * n),
        j = i + b - a;
      row.cage = turn(i, j);
      for (let e = 0; e < n; e++) {
        row.orbit[e] = turn(i + 1 + e, j + 1 + e);
        row.spin[e] = turn(i + 1 + n + e, j + 1 + n + e);
        const [p, q] = [i + 1 + 2 * n + e, i + 1 + 3 * n + e],
          d = j - i;
        row.inner[e] = Math.max(0, clip[p] + f * (clip[p + d] - clip[p]));
        row.outer[e] = Math.max(0, clip[q] + f * (clip[q + d] - clip[q]));
        state.largest = Math.max(state.largest, row.inner[e], row.outer[e]);
      }
    }
  }
}
