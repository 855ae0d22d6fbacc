// What the pointer and the keys do on the raceway, as requests to draw: the panel turns them into edits of the scenario.

/** @typedef {"select" | "pen" | "points" | "brush" | "rectangle" | "circle" | "paper"} Tool */
/**
 * @typedef {{type: "shape", shape: Record<string, any>, s: number, z: number}
 *   | {type: "stroke", tool: "pen" | "brush", points: [number, number][], fresh: boolean}
 *   | {type: "move", s: number, z: number} | {type: "shift", degrees: number, z: number} | {type: "resize", shape: Record<string, any>}
 *   | {type: "begin"} | {type: "end"} | {type: "cancel"} | {type: "select", defect: number}
 *   | {type: "delete"} | {type: "deeper", factor: number} | {type: "undo"} | {type: "redo"}} Request
 */

// As in the examples: what a tool places without a drag.
const USUAL = { length_mm: 3, width_mm: 4 };
const SMALLEST_MM = 0.1;

/** @type {Record<string, Tool>} */
export const TOOL_KEYS = { v: "select", p: "pen", o: "points", b: "brush", r: "rectangle", c: "circle", i: "paper" };

/** @param {number} v */
const tidy = (v) => Number(v.toFixed(3));

/**
 * The shape between two corners, or the usual one where they are the same.
 * @param {Tool} tool
 * @param {[number, number]} a
 * @param {[number, number]} b
 * @param {number} across
 */
export function shapeBetween(tool, a, b, across) {
  const length = Math.abs(b[0] - a[0]),
    width = Math.abs(b[1] - a[1]),
    tiny = length === 0 && width === 0;
  const at = tiny ? a : [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2];
  if (tool === "rectangle") {
    const shape = tiny
      ? { length_mm: USUAL.length_mm, width_mm: Math.min(USUAL.width_mm, tidy(0.7 * across)) }
      : { length_mm: tidy(Math.max(length, SMALLEST_MM)), width_mm: tidy(Math.max(width, SMALLEST_MM)) };
    return { shape: { rectangle: shape }, s: at[0], z: at[1] };
  }
  if (tool === "circle") {
    const diameter = tiny ? Math.min(USUAL.length_mm, tidy(0.6 * across)) : tidy(Math.max(SMALLEST_MM, 2 * Math.hypot(length, width)));
    return { shape: { circle: { diameter_mm: diameter } }, s: a[0], z: a[1] };
  }
  const widest = tiny ? Math.min(USUAL.width_mm, tidy(0.7 * across)) : tidy(Math.max(SMALLEST_MM, width));
  return { shape: { li2023_irregular: { max_width_mm: widest } }, s: at[0], z: at[1] };
}

/** The corners of an outline that is being set, in mm. */
export class Corners {
  /** @type {[number, number][]} */
  list = [];
  /** Where the pointer is, after the last corner. @type {[number, number] | null} */
  next = null;

  get shown() {
    return this.next && this.list.length ? [...this.list, this.next] : this.list;
  }
  get words() {
    const n = this.list.length;
    return n < 3
      ? `${n} of at least 3 corners · Esc drops them`
      : `${n} corners · Enter, double-click or the first corner closes · Backspace takes one back · Esc drops them`;
  }

  /** Whether a place closes the outline. @param {[number, number]} at @param {number} reach mm */
  closes(at, reach) {
    const first = this.list[0];
    return this.list.length > 2 && Math.hypot(at[0] - first[0], at[1] - first[1]) < reach;
  }

  clear() {
    this.list = [];
    this.next = null;
  }

  /** The outline, and none is being set any more; null and everything as it was with fewer than three corners apart. @param {number} reach mm */
  closed(reach) {
    // The second click of a double one set the same corner again.
    const apart = this.list.filter((p, k, all) => !k || Math.hypot(p[0] - all[k - 1][0], p[1] - all[k - 1][1]) > reach);
    if (apart.length < 3) {
      this.list = apart;
      return null;
    }
    this.clear();
    return polygon(apart);
  }
}

/** A polygon about its own middle. @param {[number, number][]} corners */
function polygon(corners) {
  const s = corners.map((p) => p[0]),
    z = corners.map((p) => p[1]);
  const [cs, cz] = [(Math.min(...s) + Math.max(...s)) / 2, (Math.min(...z) + Math.max(...z)) / 2];
  return { shape: { outline: { points_mm: corners.map((p) => [tidy(p[0] - cs), tidy(p[1] - cz)]) } }, s: cs, z: cz };
}

/** Places on a selected shape that can be dragged, about its centre. @param {Record<string, any> | undefined} shape @returns {[number, number][]} */
export function handles(shape) {
  if (shape?.rectangle) {
    const { length_mm: l, width_mm: w } = shape.rectangle;
    return [
      [-l / 2, 0],
      [l / 2, 0],
      [0, w / 2],
      [0, -w / 2],
    ];
  }
  if (shape?.circle)
    return [
      [shape.circle.diameter_mm / 2, 0],
      [-shape.circle.diameter_mm / 2, 0],
    ];
  return [];
}

/** The shape with one of its handles at another place; the far side stays. @param {Record<string, any>} shape @param {number} which @param {[number, number]} at */
export function resized(shape, which, at) {
  if (shape.circle)
    return {
      shape: { circle: { ...shape.circle, diameter_mm: tidy(Math.max(SMALLEST_MM, 2 * Math.abs(at[0]))) } },
      ds: 0,
      dz: 0,
    };
  const { length_mm: l, width_mm: w } = shape.rectangle;
  if (which < 2) {
    const sign = which ? 1 : -1,
      length = Math.max(SMALLEST_MM, sign * at[0] + l / 2);
    return {
      shape: { rectangle: { ...shape.rectangle, length_mm: tidy(length) } },
      ds: (sign * (length - l)) / 2,
      dz: 0,
    };
  }
  const sign = which === 2 ? 1 : -1,
    width = Math.max(SMALLEST_MM, sign * at[1] + w / 2);
  return { shape: { rectangle: { ...shape.rectangle, width_mm: tidy(width) } }, ds: 0, dz: (sign * (width - w)) / 2 };
}

/** Left, lower, right and upper end of damage about its centre, mm. @param {any} one @returns {[number, number, number, number]} */
export function box(one) {
  let l = Infinity,
    d = Infinity,
    r = -Infinity,
    u = -Infinity;
  for (const points of one.polygons_mm) {
    for (let i = 0; i < points.length; i += 2) {
      [l, r] = [Math.min(l, points[i]), Math.max(r, points[i])];
      [d, u] = [Math.min(d, points[i + 1]), Math.max(u, points[i + 1])];
    }
  }
  if (l <= r) return [l, d, r, u];
  const grid = one.grid;
  if (grid) return [grid.s0_mm, grid.z0_mm, grid.s0_mm + (grid.columns - 1) * grid.ds_mm, grid.z0_mm + (grid.rows - 1) * grid.dz_mm];
  return [-one.length_mm / 2, -one.width_mm / 2, one.length_mm / 2, one.width_mm / 2];
}

/** Whether a place lies in damage, or close to it. @param {any} one @param {number} s @param {number} z about the damage's centre @param {number} slack */
export function hits(one, s, z, slack) {
  let inside = false;
  for (const p of one.polygons_mm) {
    for (let i = 0, j = p.length - 2; i < p.length; j = i, i += 2) {
      if (p[i + 1] > z !== p[j + 1] > z && s < ((p[j] - p[i]) * (z - p[i + 1])) / (p[j + 1] - p[i + 1]) + p[i]) inside = !inside;
    }
  }
  // Small or thin damage is taken by its box.
  const [l, d, r, u] = box(one),
    near = s > l - slack && s < r + slack && z > d - slack && z < u + slack;
  return inside || (near && (Math.min(r - l, u - d) < 4 * slack || one.grid !== null));
}
