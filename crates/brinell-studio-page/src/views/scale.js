// Ranges. Drawing arithmetic only: every figure comes from the engine.

const ROUND = [1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 8, 10];
/** The next round number that is not smaller. @param {number} v */
export function roundUp(v) {
  if (!(v > 0) || !Number.isFinite(v)) return 1;
  const magnitude = 10 ** Math.floor(Math.log10(v));
  return magnitude * (ROUND.find((m) => m * magnitude >= v * (1 - 1e-9)) ?? 10);
}

/** A limit that grows at once and shrinks late, so that a live picture does not pump. */
export class Limit {
  constructor() {
    this.top = 0;
  }
  /** @param {number} needed @returns {number} */
  hold(needed) {
    const want = Number.isFinite(needed) ? Math.abs(needed) : 0;
    if (want > this.top || want < 0.45 * this.top) this.top = roundUp(1.06 * want);
    return this.top || 1;
  }
}
