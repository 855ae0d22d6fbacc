// Draws the unrolled raceway: the whole turn above, and the part in view below, in millimetres of the surface.
import { box } from "./tools.js";
import { path } from "./views/pen.js";

/** @typedef {{s: number, scale: number}} View  middle of the view along the surface (mm), pixels per mm */
/** @typedef {{s: number, force: number}} Contact  a roller's contact line on the surface */
/**
 * @typedef {object} Scene
 * @property {number} width
 * @property {number} height
 * @property {number} turn    length of the whole turn, mm
 * @property {number} across  width of the surface, mm
 * @property {View} view
 * @property {any[]} damage   damage on this surface, as the engine shows it, with `s` and `z` its centre in mm
 * @property {number} selected
 * @property {Contact[]} contacts
 * @property {number} half    half the width of a rolling element, mm
 * @property {boolean} ball
 * @property {number} heaviest
 * @property {number | null} load  direction of the load on this surface, mm
 * @property {Float32Array} forces largest force seen at each place of the turn
 * @property {{points: [number, number][], width: number, closed: boolean, words?: string} | null} stroke
 * @property {[number, number] | null} cursor
 * @property {[number, number][]} handles
 */

export const TOP = 34,
  BOTTOM = 20;

/** @param {Element} element */
export function colours(element) {
  const style = getComputedStyle(element),
    one = (/** @type {string} */ name) => style.getPropertyValue(name).trim();
  return {
    ink: one("--ink"),
    faint: one("--faint"),
    line: one("--line"),
    steel: one("--steel"),
    wash: one("--wash"),
    blue: one("--blue"),
    pit: one("--damage"),
    warn: one("--warn"),
    panel: one("--ground"),
    font: style.fontFamily,
  };
}
/** @typedef {ReturnType<typeof colours>} Colours */

/** @param {Scene} scene */
export const middle = ({ height }) => TOP + (height - TOP - BOTTOM) / 2;
/** @param {Scene} scene @param {number} s */
export const xOf = ({ width, view }, s) => width / 2 + (s - view.s) * view.scale;
/** @param {Scene} scene @param {number} z */
export const yOf = (scene, z) => middle(scene) - z * scene.view.scale;

/** Copies of a place that lie in view, as the turn closes. @param {Scene} scene @param {number} s @param {number} reach */
export function copies({ width, view, turn }, s, reach) {
  const half = width / 2 / view.scale + reach,
    list = [];
  // Where there is room for more than one turn, each place is shown once.
  if (width / view.scale > turn) return [s - turn * Math.round(s / turn)];
  for (let k = Math.ceil((view.s - half - s) / turn); k <= Math.floor((view.s + half - s) / turn); k++) list.push(s + k * turn);
  return list;
}

/** @param {CanvasRenderingContext2D} g @param {Scene} scene @param {Colours} c */
export function draw(g, scene, c) {
  g.clearRect(0, 0, scene.width, scene.height);
  overview(g, scene, c);
  g.save();
  g.beginPath();
  g.rect(0, TOP, scene.width, scene.height - TOP);
  g.clip();
  surface(g, scene, c);
  for (const one of scene.damage) for (const s of copies(scene, one.s, 20)) pit(g, scene, c, one, s);
  for (const contact of scene.contacts) for (const s of copies(scene, contact.s, scene.half)) roller(g, scene, c, contact, s);
  for (const one of scene.damage) if (one.defect === scene.selected) for (const s of copies(scene, one.s, 20)) chosen(g, scene, c, one, s);
  marks(g, scene, c);
  g.restore();
}

/** @param {CanvasRenderingContext2D} g @param {Scene} scene @param {Colours} c */
function overview(g, scene, c) {
  const { width, turn, view, damage, contacts, forces, heaviest, load } = scene,
    top = 16,
    high = 14;
  const x = (/** @type {number} */ s) => ((((s / turn + 0.5) % 1) + 1) % 1) * width;
  g.fillStyle = c.steel;
  g.fillRect(0, top, width, high);
  g.fillStyle = c.blue;
  g.globalAlpha = 0.25;
  const bins = forces.length;
  for (let k = 0; k < bins; k++) {
    const tall = heaviest > 0 ? high * Math.min(1, forces[k] / heaviest) : 0;
    g.fillRect((k / bins) * width, top + high - tall, width / bins + 0.5, tall);
  }
  g.globalAlpha = 1;
  for (const { s } of contacts) {
    g.fillStyle = c.faint;
    g.fillRect(x(s) - 0.5, top, 1, high);
  }
  for (const one of damage) {
    g.fillStyle = one.defect === scene.selected ? c.blue : c.pit;
    g.fillRect(
      x(one.s) - Math.max(2, ((one.length_mm / turn) * width) / 2),
      top + 2,
      Math.max(4, (one.length_mm / turn) * width),
      high - 4,
    );
  }
  const wide = Math.min(width, (width / view.scale / turn) * width);
  g.strokeStyle = c.ink;
  g.lineWidth = 1.5;
  for (const at of [x(view.s) - width, x(view.s), x(view.s) + width])
    g.strokeRect(at - wide / 2 + 0.75, top - 1.25, wide - 1.5, high + 2.5);
  g.fillStyle = c.faint;
  g.font = `11px ${c.font}`;
  g.textBaseline = "alphabetic";
  for (let deg = -180; deg <= 180; deg += width < 600 ? 90 : 45) {
    g.textAlign = deg === -180 ? "left" : deg === 180 ? "right" : "center";
    g.fillText(`${String(deg).replace("-", "−")}°`, (deg / 360 + 0.5) * width, 11);
  }
  if (load === null) return;
  const at = x(load);
  g.fillStyle = c.warn;
  path(g, [
    [at - 5, top - 3],
    [at + 5, top - 3],
    [at, top + 5],
  ]);
  g.fill();
}

/** @param {CanvasRenderingContext2D} g @param {Scene} scene @param {Colours} c */
function surface(g, scene, c) {
  const { width, height, across, view, turn } = scene,
    up = yOf(scene, across / 2),
    down = yOf(scene, -across / 2);
  g.fillStyle = c.wash;
  g.fillRect(0, TOP, width, height - TOP - BOTTOM);
  const whole = width / view.scale > turn,
    left = whole ? xOf(scene, -turn / 2) : 0,
    right = whole ? xOf(scene, turn / 2) : width;
  const shine = g.createLinearGradient(0, up, 0, down);
  shine.addColorStop(0, c.line);
  shine.addColorStop(0.2, c.steel);
  shine.addColorStop(0.8, c.steel);
  shine.addColorStop(1, c.line);
  g.fillStyle = shine;
  g.fillRect(left, up, right - left, down - up);
  // Places on the turn, in degrees; steps that leave room for the words.
  const step = [1, 2, 5, 10, 15, 30, 45, 90].find((d) => (d / 360) * turn * view.scale > 56) ?? 180;
  const from = whole ? -turn / 2 : view.s - width / 2 / view.scale,
    to = whole ? turn / 2 : view.s + width / 2 / view.scale;
  g.strokeStyle = c.faint;
  g.fillStyle = c.faint;
  g.lineWidth = 1;
  g.font = `11px ${c.font}`;
  g.textAlign = "center";
  for (let k = Math.ceil(((from / turn) * 360) / step); ((k * step) / 360) * turn <= to; k++) {
    const x = Math.round(xOf(scene, ((k * step) / 360) * turn)) + 0.5,
      deg = ((((k * step + 180) % 360) + 360) % 360) - 180;
    g.globalAlpha = 0.25;
    path(g, [
      [x, TOP],
      [x, height - BOTTOM],
    ]);
    g.stroke();
    g.globalAlpha = 1;
    g.fillText(`${String(deg).replace("-", "−")}°`, x, height - 6);
  }
}

/** @param {CanvasRenderingContext2D} g @param {Scene} scene @param {any} one @param {number} s */
function outline(g, scene, one, s) {
  g.beginPath();
  for (const points of one.polygons_mm) {
    for (let i = 0; i < points.length; i += 2) g[i ? "lineTo" : "moveTo"](xOf(scene, s + points[i]), yOf(scene, one.z + points[i + 1]));
    g.closePath();
  }
}

/** @param {CanvasRenderingContext2D} g @param {Scene} scene @param {Colours} c @param {any} one @param {number} s */
function pit(g, scene, c, one, s) {
  if (one.grid) {
    const picture = shaded(one.grid, c.pit),
      { ds_mm: ds, dz_mm: dz, s0_mm: s0, z0_mm: z0, columns, rows } = one.grid;
    const x = xOf(scene, s + s0 - ds / 2),
      y = yOf(scene, one.z + z0 + (rows - 0.5) * dz);
    g.imageSmoothingEnabled = true;
    g.drawImage(picture, x, y, columns * ds * scene.view.scale, rows * dz * scene.view.scale);
    return;
  }
  outline(g, scene, one, s);
  g.fillStyle = c.pit;
  // Deeper is darker; 5 um is to be seen, 50 um is full.
  g.globalAlpha = Math.min(0.92, 0.45 + 0.11 * Math.log2(1 + (one.deepest_um ?? 0) / 5));
  g.fill("evenodd");
  g.globalAlpha = 0.9;
  g.strokeStyle = c.pit;
  g.lineWidth = 1;
  g.stroke();
  g.globalAlpha = 1;
}

/** @type {WeakMap<Float32Array, HTMLCanvasElement>} */
const pictures = new WeakMap();

/** Depth as darkness, with a light from the upper left. @param {any} grid @param {string} ink */
function shaded(grid, ink) {
  const known = pictures.get(grid.depth_um);
  if (known) return known;
  const { columns, rows, depth_um: depth } = grid,
    canvas = document.createElement("canvas");
  canvas.width = columns;
  canvas.height = rows;
  const g = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d"));
  g.fillStyle = ink;
  g.fillRect(0, 0, 1, 1);
  const [red, green, blue] = g.getImageData(0, 0, 1, 1).data,
    image = g.createImageData(columns, rows);
  let deepest = 1e-9;
  for (const d of depth) deepest = Math.max(deepest, Math.abs(d));
  for (let r = 0; r < rows; r++) {
    for (let k = 0; k < columns; k++) {
      const at = r * columns + k,
        to = 4 * ((rows - 1 - r) * columns + k),
        d = depth[at];
      const slope = (depth[Math.min(k + 1, columns - 1) + r * columns] - (depth[Math.min(r + 1, rows - 1) * columns + k] ?? d)) / deepest;
      const light = Math.max(-70, Math.min(70, 160 * slope));
      image.data.set([red + light, green + light, blue + light, d === 0 ? 0 : 90 + 150 * Math.min(1, Math.abs(d) / deepest)], to);
    }
  }
  g.putImageData(image, 0, 0);
  pictures.set(depth, canvas);
  return canvas;
}

/** @param {CanvasRenderingContext2D} g @param {Scene} scene @param {Colours} c @param {Contact} contact @param {number} s */
function roller(g, scene, c, { force }, s) {
  const { view, across, half, ball, heaviest } = scene,
    x = xOf(scene, s),
    y = yOf(scene, 0),
    wide = half * view.scale,
    tall = (across / 2) * view.scale;
  const share = heaviest > 0 ? Math.sqrt(Math.max(0, force) / heaviest) : 0;
  const body = g.createLinearGradient(x - wide, 0, x + wide, 0);
  body.addColorStop(0, c.ink);
  body.addColorStop(0.5, c.panel);
  body.addColorStop(1, c.ink);
  g.globalAlpha = 0.13;
  g.fillStyle = body;
  g.beginPath();
  if (ball) g.arc(x, y, wide, 0, 2 * Math.PI);
  else g.roundRect(x - wide, y - tall, 2 * wide, 2 * tall, 3);
  g.fill();
  g.globalAlpha = 0.3;
  g.strokeStyle = c.ink;
  g.lineWidth = 1;
  g.stroke();
  // The contact: the darker, the more force.
  g.globalAlpha = 0.12 + 0.88 * Math.min(1, share);
  g.fillStyle = c.blue;
  g.beginPath();
  if (ball) g.ellipse(x, y, 3 + 4 * share, Math.max(6, 0.35 * tall), 0, 0, 2 * Math.PI);
  else g.roundRect(x - 1 - 2.5 * share, y - tall, 2 + 5 * share, 2 * tall, 2);
  g.fill();
  g.globalAlpha = 1;
}

/** @param {CanvasRenderingContext2D} g @param {Scene} scene @param {Colours} c @param {any} one @param {number} s */
function chosen(g, scene, c, one, s) {
  if (!one.grid) {
    outline(g, scene, one, s);
    g.strokeStyle = c.blue;
    g.lineWidth = 2;
    g.stroke();
  }
  // The box is of what is drawn, wherever its centre lies.
  const [l, d, r, u] = box(one),
    pad = 4;
  g.setLineDash([4, 3]);
  g.lineWidth = 1;
  g.strokeStyle = c.blue;
  g.strokeRect(
    xOf(scene, s + l) - pad,
    yOf(scene, one.z + u) - pad,
    (r - l) * scene.view.scale + 2 * pad,
    (u - d) * scene.view.scale + 2 * pad,
  );
  g.setLineDash([]);
  for (const [hs, hz] of scene.handles) {
    g.fillStyle = c.panel;
    g.strokeStyle = c.blue;
    g.lineWidth = 1.5;
    g.beginPath();
    g.arc(xOf(scene, s + hs), yOf(scene, hz), 5, 0, 2 * Math.PI);
    g.fill();
    g.stroke();
  }
}

/** What is being drawn, the keyboard's place, and a scale. @param {CanvasRenderingContext2D} g @param {Scene} scene @param {Colours} c */
function marks(g, scene, c) {
  const { stroke, cursor, view, width, height } = scene;
  if (stroke?.points.length) {
    path(
      g,
      stroke.points.map(([s, z]) => [xOf(scene, s), yOf(scene, z)]),
    );
    g.lineCap = g.lineJoin = "round";
    g.strokeStyle = c.blue;
    if (stroke.closed) g.setLineDash([5, 3]);
    g.globalAlpha = stroke.closed ? 1 : 0.35;
    g.lineWidth = stroke.closed ? 1.5 : Math.max(2, stroke.width * view.scale);
    if (stroke.points.length === 1) g.lineTo(xOf(scene, stroke.points[0][0]) + 0.1, yOf(scene, stroke.points[0][1]));
    g.stroke();
    g.setLineDash([]);
    g.globalAlpha = 1;
    if (stroke.closed) for (const [s, z] of stroke.points) g.fillRect(xOf(scene, s) - 2.5, yOf(scene, z) - 2.5, 5, 5);
    if (stroke.words) {
      g.fillStyle = c.ink;
      g.textAlign = "left";
      g.fillText(stroke.words, 8, TOP + 14, width - 16);
    }
  }
  if (cursor) {
    const [x, y] = [xOf(scene, cursor[0]), yOf(scene, cursor[1])];
    g.strokeStyle = c.warn;
    g.lineWidth = 1.5;
    g.beginPath();
    for (const [dx, dy] of [
      [-9, 0],
      [9, 0],
      [0, -9],
      [0, 9],
    ]) {
      g.moveTo(x + dx / 3, y + dy / 3);
      g.lineTo(x + dx, y + dy);
    }
    g.stroke();
  }
  const mm = [0.1, 0.2, 0.5, 1, 2, 5, 10, 20].find((m) => m * view.scale > 40) ?? 50,
    long = mm * view.scale;
  g.strokeStyle = g.fillStyle = c.ink;
  g.lineWidth = 2;
  path(g, [
    [width - 12 - long, height - BOTTOM - 8],
    [width - 12, height - BOTTOM - 8],
  ]);
  g.stroke();
  g.textAlign = "center";
  g.fillText(`${mm} mm`, width - 12 - long / 2, height - BOTTOM - 13);
}
