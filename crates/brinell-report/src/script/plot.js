// Drawing of the plots at the reader's view, scale and unit. The page is complete without it.
"use strict";
const charts = {};

// 64 values share a scale: its ends as 32-bit floats, then 16 bits a value; spectra in the logarithm.
function decode(text, count, log) {
  const bytes = atob(text), view = new DataView(new ArrayBuffer(bytes.length)), values = new Float32Array(count);
  for (let i = 0; i < bytes.length; i++) view.setUint8(i, bytes.charCodeAt(i));
  for (let at = 0, k = 0; k < count; at += 8 + 2 * 64) {
    const lo = view.getFloat32(at, true), hi = view.getFloat32(at + 4, true);
    for (let i = 0; i < 64 && k < count; i++, k++) {
      const code = view.getUint16(at + 8 + 2 * i, true), v = lo + (hi - lo) * code / 65533;
      values[k] = code === 65535 ? undefined : code === 65534 ? 0 : log ? Math.exp(v) : v;
    }
  }
  return values;
}

const raised = (power) => String(power).replace(/./g, (c) => (c === "-" ? "⁻" : "⁰¹²³⁴⁵⁶⁷⁸⁹"[c]));

// Powers of ten; where there are few, 2 and 5 between them.
function decades(lo, hi) {
  const list = [], few = Math.log10(hi / lo) < 2.5;
  for (let p = Math.floor(Math.log10(lo)); p <= Math.ceil(Math.log10(hi)); p++) {
    for (const m of few ? [1, 2, 5] : [1]) {
      const v = m * 10 ** p;
      if (v >= lo * (1 - 1e-9) && v <= hi * (1 + 1e-9)) list.push([v, Math.abs(p) > 3 ? (m > 1 ? `${m}·` : "") + "10" + raised(p) : short(v, 2)]);
    }
  }
  return list;
}

// Where the values of a curve are, and which is nearest to a place.
const placeOf = (curve, i) => (curve.places ? curve.places[i] : curve.x0 + i * curve.dx);
const endOf = (curve) => placeOf(curve, curve.values.length - 1);
function indexOf(curve, x) {
  const last = curve.values.length - 1;
  if (!curve.places) return Math.min(Math.max(Math.round((x - curve.x0) / curve.dx), 0), last);
  return nearestOf(curve.places, x);
}

// A velocity has no lines below this frequency: dividing by it would show the window, not the bearing.
const SLOWEST_HZ = 10;
// A value in the unit chosen; of an acceleration at x Hz the velocity, where that is requested.
function inUnit(chart, v, x) {
  const [, factor, velocity] = chart.units[chart.unit];
  return velocity ? (x >= SLOWEST_HZ ? v * factor / (2 * Math.PI * x) : undefined) : v * factor;
}
const unitOf = (chart) => chart.units[chart.unit][0];
const scaleOf = (chart) => (chart.scale === "dB" ? `dB re 1 ${unitOf(chart)}` : unitOf(chart));
// The same as it is drawn and read.
function level(chart, v, x) {
  const value = inUnit(chart, v, x);
  return chart.scale === "dB" ? (value > 0 ? decibel(value) : undefined) : value;
}
const asMade = (chart) => chart.scale === chart.made && chart.unit === 0;

function path(chart, curve, view, frame, y) {
  // As on paper: a pixel is a column.
  const [l, , r] = frame, ends = [Math.max(0, indexOf(curve, view[0]) - 2), Math.min(curve.values.length - 1, indexOf(curve, view[1]) + 2)];
  const across = (i) => l + (r - l) * (placeOf(curve, i) - view[0]) / (view[1] - view[0]), value = (i) => level(chart, curve.values[i], placeOf(curve, i));
  const lines = thinned(ends, value, (i) => Math.floor(across(i)), chart.peak);
  return lines.map((line) => "M" + line.map((i) => `${across(i).toFixed(1)} ${y(value(i)).toFixed(1)}`).join("L")).join("");
}

function clone(node, parent, attributes, text) {
  const copy = node.cloneNode(false);
  for (const key in attributes) copy.setAttribute(key, attributes[key]);
  if (text !== undefined) copy.textContent = text;
  parent.append(copy);
  return copy;
}

// Harmonics of the frequencies that the reader picked, as far as the view goes.
function harmonics(plot) {
  const { svg, chart, frame: [l, t, r, b], view, font } = plot;
  const X = (v) => l + (r - l) * (v - view[0]) / (view[1] - view[0]);
  chart.toggles.forEach(([name, frequency, color, through], index) => {
    const on = chart.picked.has(index);
    if (through && chart.lanes.length) {
      // Drawn on paper already.
      const line = svg.querySelectorAll(".lane")[index]?.querySelectorAll("path")[1];
      if (line) line.style.display = on ? "" : "none";
      return;
    }
    const sample = svg.querySelector(".ticks-x path"), word = svg.querySelector("text");
    if (!on || !sample) return;
    const group = clone(svg.querySelector(".ticks-x"), svg, { class: "harmonics" }), lines = clone(sample, group, { stroke: color, "stroke-width": 1.2, "stroke-dasharray": ["6 3", "2 2", "8 2 2 2", "4 4", "1 3"][index % 5] });
    const first = Math.max(1, Math.ceil(view[0] / frequency)), last = Math.floor(view[1] / frequency);
    if ((last - first) * 3 > r - l) { lines.setAttribute("d", ""); return; }
    let d = "", free = -Infinity;
    for (let n = first; n <= last; n++) {
      const x = X(n * frequency), label = n === 1 ? name : `${n}×`;
      d += `M${x.toFixed(1)} ${t}L${x.toFixed(1)} ${b}`;
      if (word && x > free && x + 3 + label.length * font * 0.6 < r) {
        const text = clone(word, group, { x: (x + 3).toFixed(1), y: (t + (1.1 + 1.15 * (index % 5)) * font).toFixed(1), "text-anchor": "start", "font-size": font - 1, fill: color, "font-weight": 600, stroke: "#fff", "stroke-width": 3, "paint-order": "stroke" }, label);
        text.removeAttribute("transform");
        free = x + 10 + label.length * font * 0.6;
      }
    }
    lines.setAttribute("d", d);
  });
}

function draw(plot, view) {
  redraw(plot, view);
  harmonics(plot);
  mark(plot);
}

// Smallest and largest of what the view shows; with `floor` the level that all but a twentieth of it exceed.
function extent(chart, view) {
  let lo = Infinity, hi = -Infinity;
  const sample = [];
  for (const curve of chart.curves) {
    const first = Math.max(0, indexOf(curve, view[0])), last = Math.min(curve.values.length - 1, indexOf(curve, view[1]));
    const step = Math.max(1, Math.floor((last - first) / 2000));
    for (let i = first; i <= last; i++) {
      const x = placeOf(curve, i), v = level(chart, curve.values[i], x);
      // The line at 0 Hz is a mean, and no line.
      if (!Number.isFinite(v) || x < view[0] || x > view[1] || (chart.xUnit === "Hz" && x === 0)) continue;
      if (v < lo) lo = v;
      if (v > hi) hi = v;
      if ((i - first) % step === 0) sample.push(v);
    }
  }
  sample.sort((a, b) => a - b);
  return { lo, hi, floor: sample[Math.floor(sample.length / 20)] ?? lo };
}

// The y axis at this view: its ends, its ticks, and the power of ten that is left to its label.
function axis(plot, view) {
  const { chart, frame: [, t, , b], font } = plot, { lo, hi, floor } = extent(chart, view);
  const target = Math.max(2, Math.min(8, Math.floor((b - t) / 2.1 / font)));
  if (!(hi >= lo)) return null;
  if (chart.scale === "log") {
    if (!(hi > 0)) return null;
    const decade = 10 ** Math.floor(Math.log10(hi)), top = [2, 5, 10, 20].map((m) => m * decade).find((v) => v > 1.1 * hi);
    const under = floor > 0 ? 10 ** Math.floor(Math.log10(floor)) : 0, bottom = Math.min(Math.max(under, decade / 1e5), decade / 10);
    return { lo: bottom, hi: top, log: true, list: decades(bottom, top), power: 0 };
  }
  if (chart.scale === "dB") {
    const top = 10 * Math.ceil(hi / 10 + 0.1), bottom = Math.max(Math.min(10 * Math.floor(floor / 10), top - 20), top - 100);
    return { lo: bottom, hi: top, list: ticks(bottom, top, target), power: 0 };
  }
  if (!(hi > lo) && lo === 0) return null;
  const room = 0.06 * (hi - lo) || 0.1 * Math.abs(hi), ends = [chart.peak ? Math.min(0, lo) : lo - room, hi + room];
  // What is drawn as on paper keeps the axis' label.
  const largest = Math.max(Math.abs(ends[0]), Math.abs(ends[1])), power = asMade(chart) ? Math.round(Math.log10(plot.yScale)) : largest >= 1e4 || largest < 0.05 ? 3 * Math.floor(Math.log10(largest) / 3) : 0, unit = 10 ** power;
  return { lo: ends[0], hi: ends[1], list: ticks(ends[0] / unit, ends[1] / unit, target).map(([v, name]) => [v * unit, name]), power };
}

// Draws the y axis anew where it differs from the one on paper; what turns a level into a height.
function vertical(plot, view) {
  const { svg, chart, frame: [l, t, r, b], font } = plot;
  if (chart.log && asMade(chart)) return plot.y;
  const found = axis(plot, view), ty = svg.querySelector(".ticks-y"), label = ty.querySelector("text"), line = ty.querySelector("path");
  if (!found || !label || !line) return plot.y;
  const L = (v) => (found.log ? Math.log10(Math.max(v, found.lo * 1e-3)) : v);
  const Y = (v) => b + (t - b) * Math.max(-1, (L(v) - L(found.lo)) / (L(found.hi) - L(found.lo)));
  ty.replaceChildren();
  for (const [v, name] of found.list) {
    clone(line, ty, { d: `M${l} ${Y(v).toFixed(1)}L${r} ${Y(v).toFixed(1)}` });
    clone(label, ty, { y: (Y(v) + 0.36 * font).toFixed(1) }, name);
  }
  const words = [...svg.querySelectorAll(".label-y text")];
  if (!asMade(chart) && words.length) {
    const unit = (found.power ? `10${raised(found.power)} ` : "") + scaleOf(chart), named = chart.units[chart.unit][2] ? "Velocity amplitude" : chart.yLabel;
    const lines = words.length > 1 ? [named, `(${unit})`] : [unit ? `${named} (${unit})` : named];
    words.forEach((node, k) => { node.textContent = lines[k]; });
    // Longer than the axis: without the name, which the heading gives.
    if (words.length === 1 && words[0].getComputedTextLength() > b - t + 8) words[0].textContent = `(${unit})`;
  }
  return Y;
}

function horizontal(plot, view) {
  const { svg, frame: [l, t, r, b], font } = plot, X = (v) => l + (r - l) * (v - view[0]) / (view[1] - view[0]);
  const tx = svg.querySelector(".ticks-x"), text = tx.querySelector("text"), grid = tx.querySelector("path");
  if (!text || !grid) return;
  tx.replaceChildren();
  let target = Math.max(3, Math.min(10, Math.floor((r - l) / 60))), list = ticks(view[0], view[1], target);
  while (target > 1 && list.reduce((n, k) => Math.max(n, k[1].length), 0) * font * 0.66 * list.length > r - l) list = ticks(view[0], view[1], --target);
  for (const [v, label] of list) {
    clone(grid, tx, { d: `M${X(v).toFixed(1)} ${t}L${X(v).toFixed(1)} ${b}` });
    clone(text, tx, { x: X(v).toFixed(1) }, label);
  }
}

function redraw(plot, view) {
  if (plot.chart.still) return;
  const { svg, chart, frame: [l, t, r, b], home, font } = plot;
  plot.view = view;
  svg.innerHTML = plot.original;
  const still = view[0] === home[0] && view[1] === home[1];
  if (still && asMade(chart)) return;
  const X = (v) => l + (r - l) * (v - view[0]) / (view[1] - view[0]);
  if (!still) horizontal(plot, view);
  const Y = vertical(plot, view), drawn = svg.querySelectorAll(".series");
  chart.curves.forEach((curve, index) => drawn[chart.drawn[index]]?.querySelector("path")?.setAttribute("d", path(chart, curve, view, plot.frame, Y)));
  if (chart.band) {
    const [x1, x2] = chart.band.map((v) => Math.min(Math.max(X(v), l), r));
    svg.querySelector(".window path")?.setAttribute("d", x2 > x1 ? `M${x1} ${t}H${x2}V${b}H${x1}Z` : "");
  }
  svg.querySelectorAll(".series circle").forEach((dot) => dot.remove());
  if (still) return;

  svg.querySelectorAll(".lane").forEach((lane, index) => {
    const seen = (chart.lanes[index] || []).filter((m) => m[0] >= view[0] && m[0] <= view[1]);
    const marks = seen.filter((m) => !m[3]);
    const base = plot.top + 5 + plot.lane * (index + 1), ruler = base - plot.lane / 2;
    const [tick, line, minor] = lane.querySelectorAll("path");
    const span = (y1, y2, marks) => marks.map((m) => `M${X(m[0]).toFixed(1)} ${y1}L${X(m[0]).toFixed(1)} ${y2}`).join("");
    tick.setAttribute("d", span(ruler - 5.5, ruler + 5.5, marks));
    if (line) line.setAttribute("d", marks.length * 3 < r - l ? span(t, b, marks) : "");
    // Only lanes that run through the plot have such marks.
    if (minor) minor.setAttribute("d", span(ruler, ruler + 5.5, seen.filter((m) => m[3])));
    lane.querySelectorAll("text").forEach((node) => node.remove());
    const sample = plot.laneText;
    if (!sample) return;
    marks.forEach((m, i) => {
      const x = X(m[0]) + 4, next = i + 1 < marks.length ? X(marks[i + 1][0]) : r;
      if (m[2] && x + m[2].length * font * 0.62 < next) clone(sample, lane, { x: x.toFixed(1), y: (base - 0.5 * (plot.lane - 0.72 * font) - 0.4).toFixed(1) }, m[2]);
    });
  });
}

function clamp(chart, view) {
  const lo = Math.min(...chart.curves.map((c) => placeOf(c, 0))), hi = Math.max(...chart.curves.map(endOf)), finest = Math.min(...chart.curves.map((c) => c.dx || (hi - lo) / c.values.length));
  return within(view, [lo, hi], 8 * finest);
}

// The overview shades what the waveform shows, and says its middle.
const middleOf = (wave) => (wave.plots[0].view[0] + wave.plots[0].view[1]) / 2 / wave.overviewScale;
function follow() {
  const wave = charts.waveform;
  document.querySelectorAll('svg[data-plot="overview"]').forEach((svg) => {
    const [l, t, r, b] = svg.dataset.frame.split(" ").map(Number), [lo, hi] = svg.dataset.view.split(" ").map(Number);
    const X = (v) => Math.min(Math.max(l + (r - l) * (v / wave.overviewScale - lo) / (hi - lo), l), r), [x1, x2] = wave.plots[0].view.map(X);
    svg.querySelector(".window path")?.setAttribute("d", `M${x1 - 1} ${t}H${x2 + 1}V${b}H${x1 - 1}Z`);
    svg.setAttribute("aria-valuenow", middleOf(wave));
  });
}

function zoom(id, view) {
  const chart = charts[id];
  if (chart.still) return;
  chart.plots.forEach((plot) => draw(plot, view ? clamp(chart, view) : plot.home));
  if (id === "waveform") follow();
}
