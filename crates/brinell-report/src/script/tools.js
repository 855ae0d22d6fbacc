// The controls over each picture: zoom, scale, unit, cursor; values and pictures to files and the clipboard.

const button = (label, title, act) => {
  const node = document.createElement("button");
  node.type = "button";
  node.textContent = label;
  node.title = title;
  node.setAttribute("aria-label", title);
  node.addEventListener("click", act);
  return node;
};

// A list to choose from; nothing where there is no choice.
function choice(title, options, chosen, act) {
  if (options.length < 2) return [];
  const node = document.createElement("select");
  node.setAttribute("aria-label", title);
  node.title = title;
  options.forEach(([value, label]) => node.append(new Option(label, value, false, value === chosen)));
  node.addEventListener("change", () => act(node.value));
  return [node];
}

function file(svg) {
  const copy = svg.cloneNode(true), { width, height } = svg.viewBox.baseVal;
  copy.querySelectorAll(".cursor").forEach((node) => node.remove());
  for (const name of ["class", "tabindex", "aria-description"]) copy.removeAttribute(name);
  copy.setAttribute("width", width);
  copy.setAttribute("height", height);
  copy.setAttribute("style", "background:#fff");
  copy.setAttribute("font-family", "Inter, 'Helvetica Neue', Arial, sans-serif");
  return new XMLSerializer().serializeToString(copy);
}
function save(name, blob) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}
function savePng(svg) {
  const { width, height } = svg.viewBox.baseVal, image = new Image();
  image.onload = () => {
    const canvas = document.createElement("canvas");
    canvas.width = 2 * width;
    canvas.height = 2 * height;
    const pen = canvas.getContext("2d");
    pen.fillStyle = "#fff";
    pen.fillRect(0, 0, canvas.width, canvas.height);
    pen.drawImage(image, 0, 0, canvas.width, canvas.height);
    canvas.toBlob((blob) => save(svg.dataset.name + ".png", blob));
  };
  image.src = "data:image/svg+xml;charset=utf-8," + encodeURIComponent(file(svg));
}

// The values in view as text, a column for each curve; curves with places of their own bring them along.
function columns(plot, comma) {
  const { chart, view } = plot, ascii = (text) => text.replace("²", "^2").replace("³", "^3");
  const quoted = (text) => (comma === "," ? `"${text.replaceAll('"', '""')}"` : text), head = (label, unit) => quoted(ascii(unit ? `${label} (${unit})` : label));
  const first = chart.curves[0], shared = chart.curves.every((c) => !c.places && c.x0 === first.x0 && c.dx === first.dx && c.values.length === first.values.length);
  const number = (v, digits) => (Number.isFinite(v) ? String(Number(v.toPrecision(digits))) : "");
  const blocks = (shared ? [chart.curves] : chart.curves.map((curve) => [curve])).map((curves) => {
    const rows = [[head(chart.xLabel, chart.xUnit), ...curves.map((c) => head(chart.curves.length > 1 ? c.name : chart.yLabel, scaleOf(chart)))]], one = curves[0];
    for (let i = 0; i < one.values.length; i++) {
      const x = placeOf(one, i);
      if (x >= view[0] && x <= view[1]) rows.push([number(chart.xLog ? 10 ** x : x, 9), ...curves.map((c) => number(level(chart, c.values[i], x), 6))]);
    }
    return rows;
  });
  const longest = Math.max(...blocks.map((rows) => rows.length));
  return Array.from({ length: longest }, (_, k) => blocks.flatMap((rows) => rows[k] || rows[0].map(() => "")).join(comma)).join("\n") + "\n";
}

// Text to the clipboard; the second way is for pages that were opened as files.
async function copy(text) {
  try {
    await navigator.clipboard.writeText(text);
  } catch {
    const area = document.createElement("textarea");
    area.value = text;
    document.body.append(area);
    area.select();
    document.execCommand("copy");
    area.remove();
  }
}

// How a spectrum may be drawn, in what units, and what the cursor does.
function choices(chart, title) {
  const again = () => { chart.plots.forEach((plot) => draw(plot, plot.view)); tell(chart.plots[0]); };
  const scales = chart.peak || chart.log ? [["linear", "Linear"], ["log", "Logarithmic"], ["dB", "dB"]] : [];
  const modes = Object.entries(MODES).filter(([mode]) => chart.peak || mode === "single" || mode === "delta").map(([mode, [label]]) => [mode, label]);
  return [
    ...choice(`Scale: ${title}`, scales, chart.scale, (scale) => { chart.scale = scale; again(); }),
    ...choice(`Unit: ${title}`, chart.units.map(([unit], k) => [String(k), unit]), "0", (k) => { chart.unit = Number(k); again(); }),
    ...choice(`Cursor: ${title}`, modes, "single", (mode) => { chart.mode = mode; chart.reference = null; chart.pin = null; chart.hint = MODES[mode][1]; again(); }),
  ];
}

function picks(chart, title) {
  const bar = document.createElement("div");
  bar.className = "tools picks";
  bar.append("Harmonics of");
  chart.toggles.forEach(([label, frequency, color], index) => {
    const node = button(label, `Mark the harmonics of ${label}, ${short(frequency, 6)} ${chart.xUnit}: ${title}`, () => {
      chart.picked[chart.picked.has(index) ? "delete" : "add"](index);
      node.setAttribute("aria-pressed", chart.picked.has(index));
      chart.plots.forEach((plot) => draw(plot, plot.view));
    });
    node.setAttribute("aria-pressed", chart.picked.has(index));
    node.style.setProperty("--mark", color);
    bar.append(node);
  });
  return bar;
}

document.querySelectorAll("script[data-chart]").forEach((script) => {
  const chart = JSON.parse(script.textContent);
  chart.curves.forEach((curve) => {
    curve.values = decode(curve.values, curve.count, chart.peak);
    if (curve.places) curve.places = decode(curve.places, curve.count, false);
  });
  chart.made = chart.log ? "log" : "linear";
  Object.assign(chart, { plots: [], scale: chart.made, unit: 0, mode: "single", reference: null, pin: null });
  chart.picked = new Set(chart.toggles.flatMap((toggle, index) => toggle[3] && chart.lanes.length ? [index] : []));
  charts[script.dataset.chart] = chart;
});

function plotOf(svg, chart) {
  const frame = svg.dataset.frame.split(" ").map(Number), view = svg.dataset.view.split(" ").map(Number);
  const [lo, hi] = chart.y, [, t, , b] = frame, L = Math.log10;
  const y = chart.log
    ? (v) => b + (t - b) * Math.max(-1, (L(Math.max(v, lo * 1e-3)) - L(lo)) / (L(hi) - L(lo)))
    : (v) => b + (t - b) * (v - lo) / (hi - lo);
  return { svg, chart, name: svg.dataset.plot, frame, view, home: view, original: svg.innerHTML, y, cursor: null, font: Number(svg.dataset.font), lane: chart.laneHeight, top: Number(svg.dataset.top), yScale: chart.yScale, laneText: svg.querySelector(".lane text")?.cloneNode(false) };
}

// Hints are said above the first plot that they hold for: the others are read in the same way.
const titles = new Set(), said = new Set();
document.querySelectorAll("figure").forEach((figure) => {
  const drawings = [...figure.querySelectorAll("svg")];
  if (!drawings.length) return;
  const current = () => drawings.find((svg) => svg.getBoundingClientRect().width > 0) || drawings[0];
  const called = drawings[0].getAttribute("aria-label") || drawings[0].dataset.name;
  let title = called;
  for (let n = 2; titles.has(title); n++) title = `${called}, ${n}`;
  titles.add(title);
  const bar = document.createElement("div"), id = drawings[0].dataset.plot, chart = charts[id];
  bar.className = "tools";
  const reads = chart && chart.curves.some((curve) => curve.values.length > (chart.still ? 1 : 8));
  if (reads) {
    const hint = chart.still ? "Point at the plot to read it; click to set the cursor" : "Drag, pinch or Ctrl + wheel to zoom, double click to go back; click to set the cursor";
    chart.hint = said.has(hint) ? "" : hint;
    said.add(hint);
    const plot = () => chart.plots[drawings.indexOf(current())], view = () => plot().view;
    if (!chart.still && !chart.small) bar.append(
      ...choices(chart, title),
      button("+", `Zoom in: ${title}`, () => { const [a, b] = view(), w = b - a; zoom(id, [a + w / 4, b - w / 4]); }),
      button("−", `Zoom out: ${title}`, () => { const [a, b] = view(), w = b - a; zoom(id, [a - w / 2, b + w / 2]); }),
      button("All", `All that is kept: ${title}`, () => zoom(id, [-1e300, 1e300])),
    );
    bar.append(
      button("Reset", `Reset to the first view: ${title}`, () => home(id)),
      button("CSV", `Save the values in view as CSV: ${title}`, () => save(current().dataset.name + ".csv", new Blob([columns(plot(), ",")], { type: "text/csv" }))),
      button("Copy", `Copy the values in view: ${title}`, async () => { await copy(columns(plot(), "\t")); chart.readout.textContent = "Copied: the values in view"; }),
    );
  }
  bar.append(
    button("SVG", `Save as SVG: ${title}`, () => save(current().dataset.name + ".svg", new Blob([file(current())], { type: "image/svg+xml" }))),
    button("PNG", `Save as PNG: ${title}`, () => savePng(current())),
  );
  figure.prepend(bar);
  if (!reads) return;
  chart.readout = document.createElement("div");
  chart.readout.className = "readout";
  chart.readout.setAttribute("role", "status");
  chart.readout.textContent = chart.hint;
  bar.after(chart.readout);
  if (chart.toggles.length) bar.after(picks(chart, title));
  for (const svg of drawings) {
    const plot = plotOf(svg, chart);
    chart.plots.push(plot);
    watch(plot);
  }
});

// A click on the overview shows that instant below it.
document.querySelectorAll('svg[data-plot="overview"]').forEach((svg) => {
  const wave = charts.waveform;
  if (!wave || !wave.plots.length) return;
  svg.style.cursor = "pointer";
  if (svg.classList.contains("wide")) {
    const hint = document.createElement("span");
    hint.className = "hint";
    hint.textContent = " Click or use the arrow keys to move it.";
    svg.closest("figure").querySelector("figcaption")?.append(hint);
  }
  const [l, , r] = svg.dataset.frame.split(" ").map(Number), [lo, hi] = svg.dataset.view.split(" ").map(Number);
  const show = (time) => {
    const [a, c] = wave.plots[0].view;
    zoom("waveform", [time - (c - a) / 2, time + (c - a) / 2]);
  };
  for (const [key, value] of [["role", "slider"], ["tabindex", "0"], ["aria-label", "Instant that the waveform shows"], ["aria-valuemin", lo], ["aria-valuemax", hi], ["aria-valuenow", middleOf(wave)]]) svg.setAttribute(key, value);
  svg.addEventListener("click", (event) => {
    const box = svg.getBoundingClientRect(), x = (event.clientX - box.left) * svg.viewBox.baseVal.width / box.width;
    show((lo + (hi - lo) * (x - l) / (r - l)) * wave.overviewScale);
  });
  svg.addEventListener("keydown", (event) => {
    const [a, c] = wave.plots[0].view, at = (a + c) / 2, to = { ArrowLeft: at - (c - a) / 2, ArrowRight: at + (c - a) / 2, Home: lo * wave.overviewScale, End: hi * wave.overviewScale }[event.key];
    if (to === undefined) return;
    event.preventDefault();
    show(to);
  });
});
