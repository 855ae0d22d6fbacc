// The only file that knows uPlot: frame, axes, grid, scales and the shade of a selection. What is in the frame is painted by the caller.
import uPlot from "../../vendor/uplot.mjs";
import { font } from "./pen.js";
import { sheet } from "./theme.js";

/** @typedef {import("./pen.js").Pen} Pen */
/** @typedef {import("./theme.js").Colours} Colours */
/** @typedef {{ left: number, top: number, width: number, height: number }} Frame place of the plot's inside in its box, px */
/** @typedef {[number, string][]} Ticks */
/** @typedef {{ x: [number, number], y: [number, number], xTicks: Ticks, yTicks: Ticks }} Axes */

/** Room around the frame, px: above, right, below, left. */
export const ROOM = { top: 8, right: 22, bottom: 20, left: 46 };

/** The rules of uPlot's style sheet that are needed here. */
export const plotSheet = sheet(`
.uplot { position: absolute; inset: 0; }
.u-wrap { position: relative; user-select: none; }
.u-over, .u-under { position: absolute; }
.u-under { overflow: hidden; }
.u-axis { position: absolute; pointer-events: none; }
.uplot canvas { display: block; position: relative; width: 100%; height: 100%; }
.u-select { position: absolute; pointer-events: none; background: color-mix(in srgb, var(--_blue) 16%, transparent); }
.u-over { cursor: crosshair; touch-action: pan-y; }
`);

/**
 * @param {HTMLElement} box the plot fills it
 * @param {() => Colours} colours
 * @param {(pen: Pen, frame: Frame) => void} paint what is in the frame, in the pixels of the box
 */
export function makePlot(box, colours, paint) {
  /** @type {Axes} */
  let axes = { x: [0, 1], y: [0, 1], xTicks: [], yTicks: [] };
  const frameOf = (/** @type {any} */ u) => {
    const fine = u.ctx.canvas.width / u.width || 1, { left, top, width, height } = u.bbox;
    return { fine, left: left / fine, top: top / fine, width: width / fine, height: height / fine };
  };
  const axis = (/** @type {"xTicks" | "yTicks"} */ which, /** @type {number} */ size) => ({
    font: font(11), size, gap: 4, stroke: () => colours().faint, grid: { stroke: () => colours().grid, width: 1 }, ticks: { show: false },
    splits: () => axes[which].map((t) => t[0]), values: () => axes[which].map((t) => t[1]),
  });
  const { top, right, bottom, left } = ROOM;
  const plot = new uPlot(/** @type {any} */ ({
    width: Math.max(box.clientWidth, 60), height: Math.max(box.clientHeight, 60), legend: { show: false }, cursor: { show: false }, padding: [top, right, 0, 0],
    scales: { x: { time: false, auto: false, range: () => axes.x }, y: { auto: false, range: () => axes.y } },
    axes: [axis("xTicks", bottom), axis("yTicks", left)], series: [{}, { show: false }],
    hooks: {
      draw: [(/** @type {any} */ u) => {
        const frame = frameOf(u), pen = /** @type {CanvasRenderingContext2D} */ (u.ctx);
        pen.save();
        pen.setTransform(frame.fine, 0, 0, frame.fine, 0, 0);
        pen.textAlign = "start";
        pen.textBaseline = "alphabetic";
        paint(pen, frame);
        pen.restore();
      }],
    },
  }), [[0, 1], [0, 1]], box);
  plot.root.setAttribute("aria-hidden", "true");
  return {
    /** Where pointer events are received. */
    over: /** @type {HTMLElement} */ (plot.over),
    /** Draws anew with these axes. @param {Axes} next */
    draw(next) {
      axes = next;
      const width = Math.max(box.clientWidth, 60), height = Math.max(box.clientHeight, 60);
      if (width !== plot.width || height !== plot.height) plot.setSize({ width, height });
      plot.batch(() => {
        plot.setScale("x", { min: axes.x[0], max: axes.x[1] });
        plot.setScale("y", { min: axes.y[0], max: axes.y[1] });
      });
    },
    /** @returns {Frame} */
    frame: () => frameOf(plot),
    /** Shades from one place across the frame to another, px; nothing with null. @param {[number, number] | null} span */
    shade(span) {
      const [from, to] = span ?? [0, 0];
      plot.setSelect({ left: Math.min(from, to), width: Math.abs(to - from), top: 0, height: span ? frameOf(plot).height : 0 }, false);
    },
    destroy: () => plot.destroy(),
  };
}

/** The same axes on any pen, as for pictures that are saved. @param {Pen} pen @param {Frame} frame @param {Axes} axes @param {Colours} colours */
export function paintAxes(pen, frame, axes, colours) {
  const { left, top, width, height } = frame, right = left + width, bottom = top + height;
  pen.strokeStyle = colours.grid;
  pen.lineWidth = 1;
  pen.fillStyle = colours.faint;
  pen.font = font(11);
  for (const [v, label] of axes.xTicks) {
    const x = left + width * (v - axes.x[0]) / (axes.x[1] - axes.x[0]);
    pen.beginPath();
    pen.moveTo(x, top);
    pen.lineTo(x, bottom);
    pen.stroke();
    pen.textAlign = "center";
    if (label) pen.fillText(label, x, bottom + 15);
  }
  for (const [v, label] of axes.yTicks) {
    const y = bottom - height * (v - axes.y[0]) / (axes.y[1] - axes.y[0]);
    pen.beginPath();
    pen.moveTo(left, y);
    pen.lineTo(right, y);
    pen.stroke();
    pen.textAlign = "right";
    pen.fillText(label, left - 5, y + 4);
  }
  pen.textAlign = "start";
}
