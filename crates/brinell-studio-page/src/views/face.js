// Draws one row of the bearing from its face: rings, cage, rollers, contact forces, damage. Angles are counter-clockwise from +x.
import { breadth, font, path } from "./pen.js";

/** @typedef {import("./pen.js").Pen} Pen */
/** @typedef {import("./theme.js").Colours} Colours */
/**
 * @typedef {{ inner_mm: number, outer_mm: number, pitch_mm: number, element_mm: number, length_mm: number, rows: number, elements: number, element: "roller" |
 * "ball" }} Geometry
 */
/** @typedef {{ columns: number, rows: number, ds_mm: number, dz_mm: number, s0_mm: number, z0_mm: number, depth_um: Float32Array }} Grid */
/**
 * @typedef {{ defect: number, on: string, row: number, center_deg: number, roller?: number, polygons_mm?: Float32Array[], grid?: Grid | null, length_mm?: number }}
 * Damage
 */
/** @typedef {{ on: "outer" | "inner" | "roller", roller: number, from: number, to: number }} Arc damage along the surface, rad */
/** @typedef {{ x: number, y: number, scale: number, colours: Colours, perNewton: number }} Stage centre, px a mm, px a N */

/** Thickness of a ring as a share of the outer raceway's radius. The bars of the forces are in it. */
export const RING = 0.17;
/** Shallower than this share of the deepest is round-off. */
const LEAST = 1e-3;
const RADIAN = Math.PI / 180;

/** Where along the surface the damage is, as arcs. @param {Damage} damage @param {Geometry} geometry @returns {Arc[]} */
export function arcs(damage, geometry) {
  const on = damage.on.startsWith("outer") ? "outer" : damage.on.startsWith("inner") ? "inner" : "roller";
  const radius = on === "outer" ? geometry.outer_mm : on === "inner" ? geometry.inner_mm : geometry.element_mm,
    centre = damage.center_deg * RADIAN;
  /** @type {[number, number][]} */
  const spans = [];
  const grid = damage.grid;
  if (grid) {
    const deepest = grid.depth_um.reduce((most, d) => Math.max(most, d), 0);
    let from = -1;
    for (let c = 0; c <= grid.columns; c++) {
      let deep = false;
      for (let r = 0; c < grid.columns && r < grid.rows && !deep; r++) deep = grid.depth_um[r * grid.columns + c] > LEAST * deepest;
      if (deep && from < 0) from = c;
      if (!deep && from >= 0) {
        spans.push([grid.s0_mm + (from - 0.5) * grid.ds_mm, grid.s0_mm + (c - 0.5) * grid.ds_mm]);
        from = -1;
      }
    }
  }
  for (const polygon of grid ? [] : (damage.polygons_mm ?? [])) {
    let [low, high] = [Infinity, -Infinity];
    for (let i = 0; i + 1 < polygon.length; i += 2) {
      low = Math.min(low, polygon[i]);
      high = Math.max(high, polygon[i]);
    }
    if (high >= low) spans.push([low, high]);
  }
  if (!spans.length && damage.length_mm) spans.push([-damage.length_mm / 2, damage.length_mm / 2]);
  return spans.map(([low, high]) => ({
    on,
    roller: (damage.roller ?? 1) - 1,
    from: centre + low / radius,
    to: centre + high / radius,
  }));
}

/** @param {Pen} pen @param {number} x @param {number} y @param {number} r @param {string} fill @param {string} stroke @param {number} [width] */
function disc(pen, x, y, r, fill, stroke, width = 1) {
  pen.beginPath();
  pen.arc(x, y, r, 0, 2 * Math.PI);
  pen.fillStyle = fill;
  pen.fill();
  pen.strokeStyle = stroke;
  pen.lineWidth = width;
  pen.stroke();
}

/** @param {Pen} pen @param {Stage} stage @param {Geometry} geometry @param {import("./motion.js").RowState} row @param {number} ring @param {Arc[]} damage */
export function paintRow(pen, stage, geometry, row, ring, damage) {
  const { x, y, scale, colours } = stage,
    { outer_mm: outer, inner_mm: inner } = geometry,
    thick = RING * outer,
    bore = Math.max(inner - thick, 0.2 * inner);
  pen.setLineDash([]);
  pen.lineCap = "butt";
  disc(pen, x, y, scale * (outer + thick), colours.steel, colours.frame);
  disc(pen, x, y, scale * outer, colours.ground, colours.frame);
  disc(pen, x, y, scale * inner, colours.steel, colours.frame);
  disc(pen, x, y, scale * bore, colours.ground, colours.frame);
  paintForces(pen, stage, geometry, row);
  // The mark that shows how the inner ring turns.
  segment(pen, stage, bore, inner, ring, colours.ink, 2.5);
  paintCage(pen, stage, geometry, row);
  paintElements(pen, stage, geometry, row);
  paintDamage(pen, stage, geometry, row, ring, damage);
}

/**
 * A stroke along a radius.
 * @param {Pen} pen
 * @param {Stage} stage
 * @param {number} from mm
 * @param {number} to mm
 * @param {number} angle
 * @param {string} colour
 * @param {number} width
 */
function segment(pen, { x, y, scale }, from, to, angle, colour, width) {
  const [c, s] = [Math.cos(angle), Math.sin(angle)];
  pen.strokeStyle = colour;
  pen.lineWidth = width;
  path(
    pen,
    [from, to].map((r) => [x + scale * r * c, y - scale * r * s]),
  );
  pen.stroke();
}

/**
 * Bars in the rings: force on the outer raceway outwards, on the inner one inwards.
 * @param {Pen} pen
 * @param {Stage} stage
 * @param {Geometry} geometry
 * @param {import("./motion.js").RowState} row
 */
function paintForces(pen, stage, geometry, row) {
  const { x, y, scale, colours, perNewton } = stage,
    wide = Math.max(2.5, Math.min(7, 0.5 * scale * geometry.element_mm));
  for (const [forces, from, way, colour] of /** @type {[Float32Array, number, number, string][]} */ ([
    [row.outer, geometry.outer_mm, 1, colours.blue],
    [row.inner, geometry.inner_mm, -1, colours.inner],
  ])) {
    pen.strokeStyle = colour;
    pen.lineWidth = wide;
    pen.beginPath();
    for (let e = 0; e < geometry.elements; e++) {
      if (!(forces[e] > 0)) continue;
      const [c, s] = [Math.cos(row.orbit[e]), Math.sin(row.orbit[e])],
        r = scale * from,
        to = r + way * Math.min(forces[e] * perNewton, scale * RING * geometry.outer_mm);
      pen.moveTo(x + r * c, y - r * s);
      pen.lineTo(x + to * c, y - to * s);
    }
    pen.stroke();
  }
}

/** Bars of the cage, between the pockets. @param {Pen} pen @param {Stage} stage @param {Geometry} geometry @param {import("./motion.js").RowState} row */
function paintCage(pen, { x, y, scale, colours }, geometry, row) {
  const n = geometry.elements,
    pitch = (2 * Math.PI) / n,
    half = pitch / 2 - 1.08 * Math.asin(Math.min(geometry.element_mm / geometry.pitch_mm, 1));
  // The pockets are evenly spaced on the cage; their offset is that of the rollers in them.
  let [c, s] = [0, 0];
  for (let e = 0; e < n; e++) {
    const a = n * (row.orbit[e] - row.cage);
    c += Math.cos(a);
    s += Math.sin(a);
  }
  const offset = Math.atan2(s, c) / n,
    r = scale * geometry.pitch_mm;
  pen.strokeStyle = colours.cage;
  pen.lineWidth = Math.max(2, 0.5 * scale * geometry.element_mm);
  pen.beginPath();
  for (let k = 0; k < n; k++) {
    const from = -(row.cage + offset + (k + 0.5) * pitch) - Math.max(half, 0.006);
    pen.moveTo(x + r * Math.cos(from), y + r * Math.sin(from));
    pen.arc(x, y, r, from, from + 2 * Math.max(half, 0.006));
  }
  pen.stroke();
}

/**
 * One path for all bodies, one for all spin marks: many small paths are dear.
 * @param {Pen} pen
 * @param {Stage} stage
 * @param {Geometry} geometry
 * @param {import("./motion.js").RowState} row
 */
function paintElements(pen, { x, y, scale, colours, perNewton }, geometry, row) {
  const radius = scale * geometry.element_mm,
    full = scale * RING * geometry.outer_mm,
    n = geometry.elements;
  const px = (/** @type {number} */ e) => x + scale * geometry.pitch_mm * Math.cos(row.orbit[e]),
    py = (/** @type {number} */ e) => y - scale * geometry.pitch_mm * Math.sin(row.orbit[e]);
  const round = (/** @type {number} */ e, /** @type {number} */ r) => {
    pen.moveTo(px(e) + r, py(e));
    pen.arc(px(e), py(e), r, 0, 2 * Math.PI);
  };
  pen.beginPath();
  for (let e = 0; e < n; e++) round(e, radius);
  pen.fillStyle = colours.roller;
  pen.fill();
  pen.fillStyle = colours.blue;
  for (let e = 0; e < n; e++) {
    const share = Math.min(1, (Math.max(row.inner[e], row.outer[e]) * perNewton) / full);
    if (!(share > 0.02)) continue;
    pen.globalAlpha = 0.6 * share;
    pen.beginPath();
    round(e, radius);
    pen.fill();
  }
  pen.globalAlpha = 1;
  pen.beginPath();
  for (let e = 0; e < n; e++) round(e, radius);
  pen.strokeStyle = colours.text;
  pen.lineWidth = 1;
  pen.stroke();
  pen.strokeStyle = colours.ink;
  pen.lineWidth = Math.max(1, 0.12 * radius);
  pen.beginPath();
  for (let e = 0; e < n; e++) {
    pen.moveTo(px(e), py(e));
    pen.lineTo(px(e) + 0.86 * radius * Math.cos(row.spin[e]), py(e) - 0.86 * radius * Math.sin(row.spin[e]));
  }
  pen.stroke();
}

/** @param {Pen} pen @param {Stage} stage @param {Geometry} geometry @param {import("./motion.js").RowState} row @param {number} ring @param {Arc[]} damage */
function paintDamage(pen, { x, y, scale, colours }, geometry, row, ring, damage) {
  pen.strokeStyle = colours.damage;
  pen.lineCap = "round";
  for (const arc of damage) {
    let [cx, cy, radius, turned] = [x, y, geometry.outer_mm, 0];
    if (arc.on === "inner") [radius, turned] = [geometry.inner_mm, ring];
    if (arc.on === "roller") {
      if (!(arc.roller >= 0 && arc.roller < geometry.elements)) continue;
      const a = row.orbit[arc.roller];
      [cx, cy, radius, turned] = [
        x + scale * geometry.pitch_mm * Math.cos(a),
        y - scale * geometry.pitch_mm * Math.sin(a),
        geometry.element_mm,
        row.spin[arc.roller],
      ];
    }
    // Narrow damage stays visible.
    const least = 3 / (scale * radius),
      half = Math.max((arc.to - arc.from) / 2, least),
      middle = turned + (arc.from + arc.to) / 2;
    const wide = arc.on === "roller" ? 3.5 : 5,
      out = arc.on === "outer" ? wide / 2 - 0.5 : arc.on === "inner" ? 0.5 - wide / 2 : 0;
    pen.lineWidth = wide;
    pen.beginPath();
    pen.arc(cx, cy, scale * radius + out, -middle - half, -middle + half);
    pen.stroke();
  }
  pen.lineCap = "butt";
}

/** An arrow in the bore that points where the load does. @param {Pen} pen @param {Stage} stage @param {Geometry} geometry @param {number} degrees */
export function paintLoad(pen, { x, y, scale, colours }, geometry, degrees) {
  const bore = scale * Math.max(geometry.inner_mm - RING * geometry.outer_mm, 0.2 * geometry.inner_mm),
    a = degrees * RADIAN,
    [c, s] = [Math.cos(a), -Math.sin(a)];
  const tip = 0.86 * bore,
    head = Math.max(6, 0.16 * bore),
    at = (/** @type {number} */ along, /** @type {number} */ aside) =>
      /** @type {[number, number]} */ ([x + along * c - aside * s, y + along * s + aside * c]);
  pen.strokeStyle = pen.fillStyle = colours.text;
  pen.lineWidth = 2;
  path(pen, [at(0, 0), at(tip - head, 0)]);
  pen.stroke();
  path(pen, [at(tip, 0), at(tip - head, 0.5 * head), at(tip - head, -0.5 * head)], true);
  pen.fill();
  pen.beginPath();
  pen.arc(x, y, 2.5, 0, 2 * Math.PI);
  pen.fill();
  if (bore < 26) return;
  pen.font = font(11);
  pen.fillStyle = colours.faint;
  pen.textAlign = "center";
  const [lx, ly] = at(-0.36 * bore, 0);
  pen.fillText("load", lx, ly + 4);
  pen.textAlign = "start";
}

/**
 * What the colours mean; gives the height used, px.
 * @param {Pen | null} pen only measured with null
 * @param {number} left
 * @param {number} top
 * @param {number} width
 * @param {Colours} colours
 * @param {string} full the force of a full bar
 * @param {boolean} damaged
 */
export function paintLegend(pen, left, top, width, colours, full, damaged) {
  const items = /** @type {[string, string][]} */ ([
    [colours.blue, "outer contact force"],
    [colours.inner, "inner"],
    ...(damaged ? [[colours.damage, "damage"]] : []),
    ["", `full bar ${full}`],
  ]);
  let [x, y] = [left, top + 11];
  for (const [colour, words] of items) {
    const wide = (colour ? 14 : 0) + breadth(words, 11) + 14;
    if (x > left && x + wide - 14 > left + width) {
      x = left;
      y += 15;
    }
    if (pen) {
      if (colour) {
        pen.fillStyle = colour;
        pen.beginPath();
        pen.rect(x, y - 6, 10, 4);
        pen.fill();
      }
      pen.fillStyle = colours.faint;
      pen.font = font(11);
      pen.fillText(words, x + (colour ? 14 : 0), y);
    }
    x += wide;
  }
  return y - top + 6;
}
