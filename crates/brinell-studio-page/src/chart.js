// What every chart has in common, of the studio and of the pages of runs (brinell-report puts this file into their script): numbers,
// ticks, the value that a cursor means, and how mouse, fingers and wheel choose what is shown. Drawing arithmetic only.

/** With a true minus. @param {string} text */
export const minus = (text) => text.replaceAll("-", "−");

/** A number for reading: so many digits. @param {number | null | undefined} value */
export function short(value, digits = 3) {
  if (value === null || value === undefined || !Number.isFinite(value)) return "–";
  const size = Math.abs(value),
    far = value !== 0 && (size >= 1e6 || size < 1e-3);
  return minus(far ? value.toExponential(digits - 1) : String(Number(value.toPrecision(digits))));
}

/** Round places between two ends, with their labels. @param {number} lo @param {number} hi @param {number} target @returns {[number, string][]} */
export function ticks(lo, hi, target) {
  if (!(hi > lo)) return [];
  const raw = (hi - lo) / Math.max(target, 1),
    magnitude = 10 ** Math.floor(Math.log10(raw)),
    step = magnitude * ([1, 2, 5, 10].find((m) => m * magnitude >= raw * (1 - 1e-9)) ?? 10),
    decimals = Math.min(9, Math.max(0, -Math.floor(Math.log10(step * (1 + 1e-9))))),
    first = Math.ceil(lo / step - 1e-9),
    count = Math.floor(hi / step + 1e-9) - first + 1;
  return Array.from({ length: Math.max(count, 0) }, (_, k) => {
    const v = (first + k) * step,
      far = v !== 0 && (Math.abs(v) >= 1e6 || step < 1e-6);
    return [v, v === 0 ? "0" : minus(far ? v.toExponential(2) : v.toFixed(decimals))];
  });
}

/** dB of a value against one unit; what is not above 0 has very few. @param {number} v */
export const decibel = (v) => 20 * Math.log10(Math.max(v, 1e-30));

/** Which of places in ascending order is nearest. @param {ArrayLike<number>} places @param {number} x */
export function nearestOf(places, x) {
  let [low, high] = [0, places.length - 1];
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (places[middle] <= x) low = middle;
    else high = middle;
  }
  return x - places[low] <= places[high] - x ? low : high;
}

/** The index of the largest value from first to last, the given one where none is larger. @param {ArrayLike<number>} values @param {number} index @param {number} first @param {number} last */
export function largestOf(values, index, first, last) {
  const end = Math.min(last, values.length - 1);
  for (let i = Math.max(first, 0); i <= end; i++) if (values[i] > values[index]) index = i;
  return index;
}

/**
 * Lines through values, as indices, with what a picture needs of them: of each column the first, the smallest, the largest and the last, or with `peaks` the
 * largest alone. What is no number breaks a line.
 * @param {[number, number]} ends  the first index and the last @param {(i: number) => number | undefined} value @param {(i: number) => number} column @param {boolean} peaks
 */
export function thinned([first, last], value, column, peaks) {
  /** @type {number[][]} */
  const lines = [];
  let [start, low, high, least, most, here] = [-1, 0, 0, 0, 0, 0],
    broken = true;
  const flush = (/** @type {number} */ end) => {
    if (start < 0) return;
    if (broken) lines.push([]);
    const kept = peaks ? [high] : [start, Math.min(low, high), Math.max(low, high), end];
    lines[lines.length - 1].push(...kept.filter((i, k) => i !== kept[k - 1]));
    [start, broken] = [-1, false];
  };
  for (let i = first; i <= last; i++) {
    const v = value(i);
    if (v === undefined || !Number.isFinite(v)) {
      flush(i - 1);
      broken = true;
      continue;
    }
    const at = column(i);
    if (start < 0 || at !== here) {
      flush(i - 1);
      [start, low, high, least, most, here] = [i, i, i, v, v, at];
    } else if (v < least) [low, least] = [i, v];
    else if (v > most) [high, most] = [i, v];
  }
  flush(last);
  return lines;
}

/** A view within all that there is, and not narrower than the least. @param {[number, number]} view @param {[number, number]} all @param {number} least @returns {[number, number]} */
export function within([from, to], [lo, hi], least) {
  const half = Math.min(Math.max(to - from, least), hi - lo) / 2,
    middle = Math.min(Math.max((from + to) / 2, lo + half), hi - half);
  return [middle - half, middle + half];
}

/** A view so many times as wide that keeps a place where it is. @param {[number, number]} view @param {number} at @param {number} factor @returns {[number, number]} */
export const around = ([from, to], at, factor) => [at - (at - from) * factor, at + (to - at) * factor];

/**
 * A plot that is pointed at. Values count along its axis, px from the left of its element.
 * @typedef {object} Pointed
 * @property {(event: PointerEvent | WheelEvent) => number} px  where the event is
 * @property {() => [number, number]} ends  of the axis, px
 * @property {() => [number, number]} view  the values there
 * @property {(view: [number, number]) => void} zoom
 * @property {() => void} home  the first view again
 * @property {(value: number) => void} point  where the cursor is
 * @property {() => void} leave  the pointer is gone
 * @property {(span: [number, number] | null) => void} shade  what is drawn over, px, to be zoomed to
 * @property {(value: number) => void} [set]  a click
 * @property {() => boolean} still  whether it has this one view
 * @property {() => boolean} slides  whether a wheel that turns sideways moves the view
 */

/** A drag is longer than this, px; fingers nearer to each other than that do not zoom. */
const DRAG = 6,
  APART = 12;

/** Zoom by a drag, two fingers, a wheel with Ctrl (which a trackpad's pinch is) and a double click; the cursor follows the pointer. @param {Element} node @param {Pointed} plot */
export function pointed(node, plot) {
  /** @type {Map<number, number>} */
  const fingers = new Map();
  const spread = () => [...fingers.values()].sort((a, b) => a - b);
  const held = (/** @type {number} */ px) => Math.min(Math.max(px, plot.ends()[0]), plot.ends()[1]);
  const at = (/** @type {number} */ px) => {
    const [left, right] = plot.ends(),
      [from, to] = plot.view();
    return from + ((to - from) * (held(px) - left)) / (right - left || 1);
  };
  /** Where a drag began, px. @type {number | null} */
  let start = null;
  /** The values under two fingers, which stay there. @type {number[] | null} */
  let pinch = null;
  const heed = (/** @type {string} */ type, /** @type {(event: any) => void} */ act) =>
    node.addEventListener(type, act, { passive: false });
  heed("pointerdown", (event) => {
    if (event.button !== 0) return;
    fingers.set(event.pointerId, plot.px(event));
    try {
      node.setPointerCapture(event.pointerId);
    } catch {
      /* gone already */
    }
    start = fingers.size > 1 ? null : plot.px(event);
    if (start !== null) return;
    pinch ??= spread().map(at);
    plot.shade(null);
  });
  heed("pointermove", (event) => {
    const px = plot.px(event);
    if (fingers.has(event.pointerId)) fingers.set(event.pointerId, px);
    if (pinch) {
      const [a, b] = spread(),
        [left, right] = plot.ends();
      if (!(b - a > APART)) return;
      const per = (pinch[1] - pinch[0]) / (b - a),
        from = pinch[0] - (a - left) * per;
      return plot.zoom([from, from + (right - left) * per]);
    }
    if (start !== null || held(px) === px) plot.point(at(px));
    if (start !== null && Math.abs(px - start) > DRAG && !plot.still()) plot.shade([held(start), held(px)]);
  });
  const lift = (/** @type {PointerEvent} */ event) => {
    fingers.delete(event.pointerId);
    plot.shade(null);
    const [begun, px] = [start, plot.px(event)];
    start = null;
    if (pinch && !fingers.size) pinch = null;
    if (begun === null || event.type !== "pointerup") return;
    if (Math.abs(px - begun) > DRAG && !plot.still()) plot.zoom([at(Math.min(begun, px)), at(Math.max(begun, px))]);
    else plot.set?.(at(px));
  };
  heed("pointerup", lift);
  heed("pointercancel", lift);
  heed("pointerleave", () => {
    if (start === null) plot.leave();
  });
  heed("dblclick", () => plot.home());
  heed("wheel", (event) => {
    const [from, to] = plot.view(),
      [left, right] = plot.ends();
    if (event.ctrlKey || event.metaKey) {
      const by = event.deltaY * (event.deltaMode ? 0.05 : 0.004);
      plot.zoom(around([from, to], at(plot.px(event)), Math.exp(Math.max(-1, Math.min(1, by)))));
    } else if (plot.slides() && Math.abs(event.deltaX) > Math.abs(event.deltaY)) {
      const by = ((to - from) * event.deltaX) / (right - left || 1);
      plot.zoom([from + by, to + by]);
    } else return;
    event.preventDefault();
  });
}
