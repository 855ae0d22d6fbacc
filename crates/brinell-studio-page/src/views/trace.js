// Draws a curve, and the marks of the bearing's frequencies over it.
import { thinned } from "../chart.js";
import { breadth, font, path } from "./pen.js";

/** @typedef {import("./pen.js").Pen} Pen */
/** @typedef {import("./theme.js").Colours} Colours */
/** @typedef {import("./plot.js").Frame} Frame */
/** @typedef {{ x0: number, dx: number, values: Float32Array }} Curve values at x0, x0 + dx, ... */
/** @typedef {{ name: string, hz: number, nominal_hz: number, found: boolean, harmonics: number, over_noise_db: number }} Line */
/** @typedef {{ X: (v: number) => number, Y: (v: number) => number, frame: Frame, view: [number, number] }} Space from values to px */

/** First and last index of a curve that a view needs, with one beyond each end. @param {Curve} curve @param {[number, number]} view @returns {[number, number]} */
export function part(curve, view) {
  const last = curve.values.length - 1;
  return [Math.max(0, Math.floor((view[0] - curve.x0) / curve.dx)), Math.min(last, Math.ceil((view[1] - curve.x0) / curve.dx))];
}

/**
 * The curve as a path: of each pixel column the smallest and the largest value, or with `peaks` the largest alone.
 * @param {Pen} pen @param {Curve} curve @param {Space} space @param {boolean} peaks
 */
export function tracePath(pen, curve, space, peaks) {
  const { values, x0, dx } = curve,
    ends = part(curve, space.view),
    // Columns start at fixed samples, so that a curve that is only moved keeps its shape.
    group = Math.ceil((ends[1] - ends[0] + 1) / (peaks ? 2 : 1) / space.frame.width);
  pen.beginPath();
  for (const line of thinned(
    ends,
    (i) => values[i],
    (i) => Math.floor(i / group),
    peaks,
  ))
    line.forEach((i, k) =>
      k ? pen.lineTo(space.X(x0 + i * dx), space.Y(values[i])) : pen.moveTo(space.X(x0 + i * dx), space.Y(values[i])),
    );
}

/** @param {Pen} pen @param {Curve} curve @param {Space} space @param {boolean} peaks @param {string} colour @param {number} width @param {number} [alpha] */
export function trace(pen, curve, space, peaks, colour, width, alpha = 1) {
  tracePath(pen, curve, space, peaks);
  pen.globalAlpha = alpha;
  pen.strokeStyle = colour;
  pen.lineWidth = width;
  // Other joins, and strokes wider than a pixel, make a dense curve several times dearer without a graphics card.
  pen.lineJoin = "bevel";
  pen.setLineDash([]);
  pen.stroke();
  pen.globalAlpha = 1;
}

/** Colour of a family of frequencies. @param {string} name @param {Colours} colours */
export function familyColour(name, colours) {
  const key = name.toLowerCase();
  return key.startsWith("bpfo")
    ? colours.bpfo
    : key.startsWith("bpfi")
      ? colours.bpfi
      : key.endsWith("bsf")
        ? colours.bsf
        : key.startsWith("ftf")
          ? colours.ftf
          : colours.text;
}

const DASHES = [
  [5, 3],
  [2, 2],
  [8, 2, 2, 2],
  [1, 3],
];
const LANE = 13;

/** Which harmonics of a line are marked. @param {Line} line */
export const orders = (line) => Array.from({ length: line.found ? Math.max(1, line.harmonics) : 0 }, (_, k) => k + 1);

/** Height that the labels of found families need above the curves, px. @param {Line[]} lines */
export const labelRoom = (lines) => LANE * Math.min(4, lines.filter((line) => line.found).length);

/** The band that was demodulated. @param {Pen} pen @param {[number, number]} band @param {Space} space @param {Colours} colours */
export function paintBand(pen, band, space, colours) {
  const [from, to] = band.map(space.X),
    { top, height } = space.frame;
  if (!(to > from)) return;
  pen.globalAlpha = 0.1;
  pen.fillStyle = colours.blue;
  pen.beginPath();
  pen.rect(from, top, to - from, height);
  pen.fill();
  pen.globalAlpha = 1;
  pen.fillStyle = colours.faint;
  pen.font = font(11);
  const word = to - from > 150 ? "band of the envelope" : "band";
  if (to - from > breadth(word, 11)) {
    pen.textAlign = "center";
    pen.fillText(word, (from + to) / 2, top + 12);
    pen.textAlign = "start";
  }
}

/**
 * Found families with their harmonics above, nominal frequencies as hollow triangles below.
 * @param {Pen} pen
 * @param {Line[]} lines
 * @param {Space} space
 * @param {number} base where the curves end, px
 * @param {Colours} colours
 */
export function paintLines(pen, lines, space, base, colours) {
  const { frame, X } = space,
    right = frame.left + frame.width;
  lines
    .filter((line) => line.found)
    .slice(0, 4)
    .forEach((line, lane) => {
      const colour = familyColour(line.name, colours),
        y = frame.top + LANE * lane + 11;
      let free = frame.left,
        named = false;
      pen.lineWidth = 1.1;
      for (const k of orders(line)) {
        const x = X(k * line.hz);
        if (x < frame.left || x > right) continue;
        pen.strokeStyle = colour;
        pen.globalAlpha = 0.75;
        pen.setLineDash(DASHES[lane]);
        path(pen, [
          [x, y - 9],
          [x, base],
        ]);
        pen.stroke();
        pen.setLineDash([]);
        pen.globalAlpha = 1;
        // The first label in view names the family.
        const label = k === 1 ? line.name : named ? `×${k}` : `${line.name} ×${k}`,
          wide = breadth(label, 11, named ? 500 : 700);
        if (x + 3 < free || x + 3 + wide > right) continue;
        pen.fillStyle = colour;
        pen.font = font(11, named ? 500 : 700);
        pen.fillText(label, x + 3, y);
        free = x + 6 + wide;
        named = true;
      }
    });
  paintNominal(pen, lines, space, base, colours);
}

/** Height below the curves in which the nominal frequencies are marked, px. */
export const STRIP = 14;

/** Marks this close share a label that names them from left to right, px. */
const TOGETHER = 12;

/**
 * Triangles at the nominal frequencies. Each has its name, unless it is alone and the line that was found there has it above.
 * @param {Pen} pen
 * @param {Line[]} lines
 * @param {Space} space
 * @param {number} base where the curves end, px
 * @param {Colours} colours
 */
function paintNominal(pen, lines, space, base, colours) {
  const { frame, X } = space,
    right = frame.left + frame.width;
  const marks = lines
    .map((line) => ({ line, x: X(line.nominal_hz), colour: familyColour(line.name, colours) }))
    .filter(({ x }) => x >= frame.left && x <= right)
    .sort((a, b) => a.x - b.x);
  /** @type {(typeof marks)[]} */
  const groups = [];
  for (const mark of marks) {
    const last = groups.at(-1)?.at(-1);
    if (last && mark.x - last.x < TOGETHER) groups.at(-1)?.push(mark);
    else groups.push([mark]);
  }
  let free = frame.left;
  groups.forEach((group, k) => {
    for (const { x, colour } of group) triangle(pen, x, base, colour);
    const alone = group.length === 1 && group[0].line.found,
      [first, last] = [group[0].x, group[group.length - 1].x];
    const words = alone
      ? [{ word: `nominal ${group[0].line.name}`, colour: group[0].colour }]
      : group.map(({ line, colour }, i) => ({ word: `${i ? " · " : ""}${line.name}`, colour }));
    const wide = words.reduce((sum, { word }) => sum + breadth(word, 10), 0),
      next = k + 1 < groups.length ? groups[k + 1][0].x - 6 : right;
    let at = last + 7 + wide <= next ? last + 7 : first - 7 - wide >= free ? first - 7 - wide : null;
    free = last + 6;
    if (at === null || (alone && Math.abs(X(group[0].line.hz) - first) <= 10)) return;
    pen.font = font(10);
    for (const { word, colour } of words) {
      pen.fillStyle = colour;
      pen.fillText(word, at, base + 10);
      at += breadth(word, 10);
    }
    free = Math.max(free, at + 4);
  });
}

/** @param {Pen} pen @param {number} x @param {number} base @param {string} colour */
function triangle(pen, x, base, colour) {
  path(
    pen,
    [
      [x, base + 1.5],
      [x - 4, base + 8.5],
      [x + 4, base + 8.5],
    ],
    true,
  );
  pen.strokeStyle = colour;
  pen.lineWidth = 1.2;
  pen.setLineDash([]);
  pen.stroke();
}
