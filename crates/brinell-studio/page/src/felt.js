// Which forces a surface has felt, for the picture of its whole turn.

const BINS = 360, FADE = 0.995;

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
        const bin = Math.floor(((angle / (2 * Math.PI) + 0.5) % 1 + 1) % 1 * BINS) % BINS;
        this.forces[bin] = Math.max(this.forces[bin], force);
        this.heaviest = Math.max(this.heaviest, force);
      }
    }
  }
}
