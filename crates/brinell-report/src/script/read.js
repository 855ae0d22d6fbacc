// Cursors: what a plot says about the place that the reader points at, and how one points: mouse, fingers, keys.

// Modes of the cursor, with the hint that the reader gets.
const MODES = {
  single: ["Single cursor", "Click or Enter sets the cursor"],
  delta: ["Difference", "Click or Enter sets the first end, again the second"],
  harmonics: ["Harmonic cursor", "Click or Enter sets the first line"],
  sidebands: ["Sideband cursor", "Click or Enter sets the carrier, again its first sideband"],
};
// Orders that harmonic and sideband cursors read out.
const ORDERS = 5;

const pixel = (plot) => (plot.view[1] - plot.view[0]) / (plot.frame[2] - plot.frame[0]);

// The value nearest to a place; of a spectrum the highest line near the pointer is the one meant.
function nearest(plot, curve, x) {
  const index = indexOf(curve, x), reach = 3 * pixel(plot);
  return plot.chart.peak ? largestOf(curve.values, index, indexOf(curve, x - reach), indexOf(curve, x + reach)) : index;
}
// Whether all curves have their values at the same places: a run and the healthy bearing.
const alike = ({ curves: [first, ...rest] }) => rest.every((curve) => curve.values.length === first.values.length && placeOf(curve, 0) === placeOf(first, 0) && endOf(curve) === endOf(first));
// The cursor's position for a place: at a value of the first curve, where its places are all there are.
const snap = (plot, x) => { const { chart } = plot, first = chart.curves[0]; return chart.still || alike(chart) ? placeOf(first, nearest(plot, first, x)) : x; };
const readAt = (plot, curve, x) => { const { chart } = plot, i = nearest(plot, alike(chart) ? chart.curves[0] : curve, x), at = placeOf(curve, i); return level(chart, curve.values[i], at); };

// A unit behind a number.
const spaced = (unit) => (unit ? ` ${unit}` : "");
// The values of all curves at a place, each with the name of its curve where there are several.
function values(plot, x) {
  const { chart } = plot, all = chart.curves.filter((curve) => x >= placeOf(curve, 0) - pixel(plot) && x <= endOf(curve) + pixel(plot));
  return all.map((curve) => `${chart.curves.length > 1 ? curve.name + " " : ""}${short(readAt(plot, curve, x), 4)}${spaced(scaleOf(chart))}`).join(" · ");
}

// What a distance along the axis is the inverse of.
function inverse(chart, distance) {
  const seconds = { s: 1, ms: 1e-3 }[chart.xUnit];
  if (!(distance > 0)) return "";
  if (seconds) return ` = 1 / ${short(1 / (distance * seconds), 5)} Hz`;
  return chart.xUnit === "Hz" ? ` = 1 / ${short(1e3 / distance, 5)} ms` : "";
}

function near(plot, place) {
  const { chart } = plot, limit = Math.min(5 * pixel(plot), 0.02 * place); // pixels, and what a bearing's slip would explain
  const named = chart.toggles.flatMap(([label, f], k) => {
    const n = Math.round(place / f);
    return chart.picked.has(k) && !(chart.lanes.length && n <= chart.lanes[k].filter((m) => !m[3]).length) && n > 0 && Math.abs(n * f - place) <= limit ? [n === 1 ? label : `${n} × ${label}`] : [];
  });
  const all = [...chart.lanes.flat().filter((m) => Math.abs(m[0] - place) <= limit).map((m) => m[1]), ...named].slice(0, 2);
  return all.length ? ` · near ${all.join(", ")}` : "";
}

const place = (chart, v) => chart.xNames[Math.round(v)] ?? `${short(chart.xLog ? 10 ** v : v, 6)}${spaced(chart.xUnit)}`;
const single = (plot, x) => `${place(plot.chart, snap(plot, x))} · ${values(plot, x)}${near(plot, snap(plot, x))}`;

// What the cursor at `x` says.
function words(plot, x) {
  const { chart } = plot, at = (v) => place(chart, v), first = chart.curves[0];
  if (chart.mode === "harmonics") {
    const orders = Array.from({ length: ORDERS }, (_, k) => (k + 1) * x).filter((v) => v <= endOf(first));
    return `Harmonics of ${at(x)} · ${orders.map((v, k) => `${k + 1}×: ${short(readAt(plot, first, v), 3)}`).join(" · ")}${spaced(scaleOf(chart))}`;
  }
  if (chart.reference === null || chart.mode === "single") return single(plot, x);
  const distance = Math.abs(x - chart.reference), [one, other] = [chart.reference, x].map((v) => readAt(plot, first, v));
  if (chart.mode === "delta") {
    const rise = short(other - one, 4) + (chart.scale === "dB" ? " dB" : spaced(scaleOf(chart)));
    const ratio = chart.peak && chart.scale !== "dB" && one > 0 && other > 0 ? ` · ratio ${short(other / one, 3)} (${short(decibel(other / one), 3)} dB)` : "";
    return `Δ ${at(distance)}${inverse(chart, distance)} · Δ ${rise}${ratio} · ${at(chart.reference)} to ${at(x)}`;
  }
  const pairs = Array.from({ length: ORDERS - 2 }, (_, k) => [chart.reference - (k + 1) * distance, chart.reference + (k + 1) * distance]);
  const sides = pairs.map((pair, k) => `±${k + 1}: ${pair.map((v) => (v >= 0 && v <= endOf(first) ? short(readAt(plot, first, v), 3) : "–")).join(", ")}`);
  return `${at(chart.reference)}: ${short(one, 3)} · spacing ${at(distance)} · ${sides.join(" · ")}${spaced(scaleOf(chart))}`;
}

// Draws a shape over the plot; a neighbour's name space saves naming it here.
function over(plot, d, attributes) {
  const line = plot.svg.querySelector("path");
  if (!line) return;
  const node = line.cloneNode(false);
  for (const key of [...node.getAttributeNames()]) node.removeAttribute(key);
  for (const [key, value] of Object.entries({ class: "cursor", d, fill: "none", stroke: "#1b1f24", "stroke-width": "0.8", "pointer-events": "none", ...attributes })) node.setAttribute(key, value);
  plot.svg.append(node);
}
const wipe = (plot) => plot.svg.querySelectorAll(".cursor").forEach((node) => node.remove());
const wash = (plot, x1, x2) => { const [, t, , b] = plot.frame; over(plot, `M${x1} ${t}H${x2}V${b}H${x1}Z`, { fill: "#0072B2", "fill-opacity": "0.15" }); };

// The lines of the cursor where it is, or was set.
function mark(plot) {
  wipe(plot);
  const { chart, view, frame: [l, t, r, b] } = plot, x = plot.cursor ?? chart.pin;
  const across = (v) => l + (r - l) * (v - view[0]) / (view[1] - view[0]);
  const lines = (all) => all.filter((v) => v >= view[0] && v <= view[1]).map((v) => `M${across(v).toFixed(1)} ${t}V${b}`).join("");
  if (chart.reference !== null) over(plot, lines([chart.reference]), { stroke: "#D55E00", "stroke-width": "1.4" });
  if (x === null || x === undefined) return;
  let places = [x];
  if (chart.mode === "single" || chart.mode === "delta" || (chart.mode === "sidebands" && chart.reference === null)) places = [snap(plot, x)];
  const many = (count, place) => (count * 3 < r - l ? Array.from({ length: Math.max(0, Math.floor(count)) }, (_, k) => place(k)) : []);
  if (chart.mode === "harmonics" && x > 0) places = many(view[1] / x, (k) => (k + 1) * x);
  if (chart.mode === "sidebands" && chart.reference !== null) {
    const distance = Math.abs(x - chart.reference);
    if (distance > 0) places = many(2 * (view[1] - view[0]) / distance, (k) => chart.reference + (k % 2 ? -1 : 1) * (Math.floor(k / 2) + 1) * distance);
  }
  over(plot, lines(places), { "stroke-dasharray": places.length > 1 ? "3 2" : "none" });
}

// Says and draws the cursor of a chart; where it is nowhere, what the reader may do.
function tell(plot) {
  const { chart } = plot, x = plot.cursor ?? chart.pin;
  chart.plots.forEach(mark);
  if (x !== null && x !== undefined) chart.readout.textContent = words(plot, x);
  else chart.readout.textContent = [chart.reference === null ? "" : single(plot, chart.reference), chart.hint].filter(Boolean).join(" · ");
}

function set(plot, x) {
  const { chart } = plot, at = snap(plot, x), pairs = chart.mode === "delta" || chart.mode === "sidebands";
  if (pairs && (chart.reference === null || chart.pin !== null)) { chart.reference = at; chart.pin = null; } else chart.pin = at;
  tell(plot);
}

// Back to the first view, with nothing marked.
function home(id) {
  const chart = charts[id];
  chart.pin = null;
  chart.reference = null;
  chart.plots.forEach((plot) => { plot.cursor = null; });
  zoom(id, null);
  tell(chart.plots[0]);
}

function watch(plot) {
  const { svg, chart, name } = plot;
  const point = (x) => { plot.cursor = x; tell(plot); };
  const nearer = (factor) => zoom(name, around(plot.view, (plot.view[0] + plot.view[1]) / 2, factor));
  pointed(svg, {
    px: (event) => { const box = svg.getBoundingClientRect(); return (event.clientX - box.left) * svg.viewBox.baseVal.width / box.width; },
    ends: () => [plot.frame[0], plot.frame[2]],
    view: () => plot.view,
    zoom: (view) => zoom(name, view),
    home: () => home(name),
    point,
    leave: () => point(null),
    shade: (span) => { if (!span) plot.cursor = null; wipe(plot); if (span) wash(plot, Math.min(...span), Math.max(...span)); },
    set: (x) => set(plot, x),
    still: () => chart.still,
    // The wheel alone scrolls the page.
    slides: () => false,
  });
  svg.tabIndex = 0;
  svg.setAttribute("aria-description", "Arrow keys move the view, plus and minus zoom, Escape goes back, Shift with an arrow key moves the cursor, Enter sets it");
  svg.addEventListener("blur", () => point(null));
  svg.addEventListener("keydown", (event) => {
    const [a, c] = plot.view, step = (c - a) / 5;
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (event.shiftKey && (event.key === "ArrowLeft" || event.key === "ArrowRight")) {
      // The cursor, a hundredth of the view or a value at a time.
      event.preventDefault();
      const stride = Math.max((c - a) / 100, chart.curves[0].dx || 0) * (event.key === "ArrowLeft" ? -1 : 1), old = plot.cursor ?? chart.pin;
      point(Math.min(Math.max(old !== null && old >= a && old <= c ? old + stride : (a + c) / 2, a), c));
      return;
    }
    const act = { ArrowLeft: () => zoom(name, [a - step, c - step]), ArrowRight: () => zoom(name, [a + step, c + step]), "+": () => nearer(0.5), "=": () => nearer(0.5), "-": () => nearer(2), Escape: () => home(name), 0: () => home(name), Enter: () => set(plot, plot.cursor ?? (a + c) / 2) }[event.key];
    if (!act) return;
    event.preventDefault();
    act();
  });
  svg.classList.add("zoomable");
}
