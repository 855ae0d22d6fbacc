// How many steps of the solver a slice asks for, so that its answer comes within about SLICE_MS whatever a step takes.

const SLICE_MS = 100,
  FIRST = 512,
  LEAST = 32;

export class Pace {
  steps = FIRST;

  /** A slice was answered. @param {number} ms after it was asked for @param {boolean} cut whether it ended for its steps */
  took(ms, cut) {
    const factor = SLICE_MS / Math.max(ms, 1);
    // Requests of the other bearing may have been answered between: what was slow once is tried again.
    if (cut || factor < 1) this.steps = Math.max(LEAST, Math.round(this.steps * Math.min(2, Math.max(0.25, factor))));
  }
}
