// Ticks and ranges. Drawing arithmetic only: every figure comes from the engine.

/** Round places between two ends, with their labels. @param {number} lo @param {number} hi @param {number} target @returns {[number, string][]} */
export function ticks(lo, hi, target) {
  if (!(hi > lo)) return [];
  const raw = (hi - lo) / Math.max(target, 1),
    magnitude = 10 ** Math.floor(Math.log10(raw));
  const step = magnitude * ([1, 2, 5, 10].find((m) => m * magnitude >= raw * (1 - 1e-9)) ?? 10);
  const decimals = Math.min(9, Math.max(0, -Math.floor(Math.log10(step * (1 + 1e-9)))));
  /** @type {[number, string][]} */
  const list = [];
  for (let i = Math.ceil(lo / step - 1e-9); i <= Math.floor(hi / step + 1e-9); i++) {
    const v = i * step;
    list.push([v, (i === 0 ? "0" : Math.abs(v) >= 1e6 || step < 1e-6 ? v.toExponential(2) : v.toFixed(decimals)).replace(/-/g, "−")]);
  }
  return list;
}

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
