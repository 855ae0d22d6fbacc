// Zoom, cursor and saving for the plots. The page is complete without it.
"use strict";
(() => {
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
  const shown = (svg) => svg.getBoundingClientRect().width > 0;
  const short = (v, digits) => {
    if (!Number.isFinite(v)) return "no value";
    const size = Math.abs(v);
    const text = v !== 0 && (size >= 1e6 || size < 1e-3) ? v.toExponential(digits - 1) : String(Number(v.toPrecision(digits)));
    return text.replace("-", "−");
  };

  function ticks(lo, hi, target) {
    const raw = (hi - lo) / target, magnitude = 10 ** Math.floor(Math.log10(raw));
    const step = magnitude * [1, 2, 5, 10].find((m) => m * magnitude >= raw * (1 - 1e-9));
    const decimals = Math.max(0, -Math.floor(Math.log10(step * (1 + 1e-9))));
    const list = [];
    for (let i = Math.ceil(lo / step - 1e-9); i <= Math.floor(hi / step + 1e-9); i++) list.push(i * step);
    return list.map((v) => [v, (Math.abs(v) < step / 2 ? "0" : v.toFixed(Math.min(decimals, 9))).replace("-", "−")]);
  }

  function path(chart, view, frame, y) {
    // As on paper: smallest and largest value of each pixel column, or the largest alone.
    const { x0, dx, values, peak } = chart, [l, , r] = frame;
    const first = Math.max(0, Math.floor((view[0] - x0) / dx) - 1);
    const last = Math.min(values.length, Math.ceil((view[1] - x0) / dx) + 2);
    let d = "", pen = false, column = null, kept = [];
    const flush = () => {
      for (const i of [...new Set(kept)].sort((a, b) => a - b)) {
        const x = l + (r - l) * (x0 + i * dx - view[0]) / (view[1] - view[0]);
        d += (pen ? "L" : "M") + x.toFixed(1) + " " + y(values[i]).toFixed(1);
        pen = true;
      }
    };
    for (let i = first; i < last; i++) {
      if (!Number.isFinite(values[i])) { flush(); kept = []; column = null; pen = false; continue; }
      const at = Math.floor((r - l) * (x0 + i * dx - view[0]) / (view[1] - view[0]));
      if (at !== column) { flush(); column = at; kept = peak ? [i] : [i, i, i, i]; continue; }
      if (peak) { if (values[i] > values[kept[0]]) kept[0] = i; continue; }
      if (values[i] < values[kept[1]]) kept[1] = i;
      if (values[i] > values[kept[2]]) kept[2] = i;
      kept[3] = i;
    }
    flush();
    return d;
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
  }

  function redraw(plot, view) {
    const { svg, chart, frame: [l, t, r, b], home } = plot;
    plot.view = view;
    svg.innerHTML = plot.original;
    if (view[0] === home[0] && view[1] === home[1]) return;
    const X = (v) => l + (r - l) * (v - view[0]) / (view[1] - view[0]);
    const font = plot.font;

    const tx = svg.querySelector(".ticks-x"), text = tx.querySelector("text"), grid = tx.querySelector("path");
    if (text && grid) {
      tx.replaceChildren();
      let target = Math.max(3, Math.min(10, Math.floor((r - l) / 60))), list = ticks(view[0], view[1], target);
      while (target > 1 && list.reduce((n, k) => Math.max(n, k[1].length), 0) * font * 0.66 * list.length > r - l) list = ticks(view[0], view[1], --target);
      for (const [v, label] of list) {
        clone(grid, tx, { d: `M${X(v).toFixed(1)} ${t}L${X(v).toFixed(1)} ${b}` });
        clone(text, tx, { x: X(v).toFixed(1) }, label);
      }
    }

    let Y = plot.y;
    if (!chart.log) {
      let lo = Infinity, hi = -Infinity;
      for (const curve of [chart, ...chart.beside]) {
        const first = Math.max(0, Math.ceil((view[0] - curve.x0) / curve.dx)), last = Math.min(curve.values.length - 1, Math.floor((view[1] - curve.x0) / curve.dx));
        for (let i = first; i <= last; i++) {
          const v = curve.values[i];
          if (v < lo) lo = v;
          if (v > hi) hi = v;
        }
      }
      if (hi > lo) {
        const room = 0.06 * (hi - lo);
        const range = [chart.peak ? Math.min(0, lo) : lo - room, hi + room];
        const ty = svg.querySelector(".ticks-y"), label = ty.querySelector("text"), line = ty.querySelector("path");
        if (label && line) {
          Y = (v) => b + (t - b) * (v - range[0]) / (range[1] - range[0]);
          ty.replaceChildren();
          const scale = plot.yScale;
          for (const [v, name] of ticks(range[0] / scale, range[1] / scale, Math.max(2, Math.min(8, Math.floor((b - t) / 2.1 / font))))) {
            const at = Y(v * scale);
            clone(line, ty, { d: `M${l} ${at.toFixed(1)}L${r} ${at.toFixed(1)}` });
            clone(label, ty, { y: (at + 0.36 * font).toFixed(1) }, name);
          }
        }
      }
    }
    const drawn = svg.querySelectorAll(".series");
    [chart, ...chart.beside].forEach((curve, index) => drawn[chart.drawn[index]]?.querySelector("path")?.setAttribute("d", path(curve, view, plot.frame, Y)));
    if (chart.band) {
      const [x1, x2] = chart.band.map((v) => Math.min(Math.max(X(v), l), r));
      svg.querySelector(".window path")?.setAttribute("d", x2 > x1 ? `M${x1} ${t}H${x2}V${b}H${x1}Z` : "");
    }
    svg.querySelectorAll(".series circle").forEach((dot) => dot.remove());

    svg.querySelectorAll(".lane").forEach((lane, index) => {
      const marks = (chart.lanes[index] || []).filter((m) => m[0] >= view[0] && m[0] <= view[1]);
      const base = plot.top + 5 + plot.lane * (index + 1), ruler = base - plot.lane / 2;
      const [tick, line] = lane.querySelectorAll("path");
      const span = (y1, y2) => marks.map((m) => `M${X(m[0]).toFixed(1)} ${y1}L${X(m[0]).toFixed(1)} ${y2}`).join("");
      tick.setAttribute("d", span(ruler - 5.5, ruler + 5.5));
      if (line) line.setAttribute("d", marks.length * 3 < r - l ? span(t, b) : "");
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
    const lo = chart.x0, hi = chart.x0 + chart.dx * (chart.values.length - 1);
    const width = Math.min(Math.max(view[1] - view[0], 8 * chart.dx), hi - lo);
    const middle = Math.min(Math.max((view[0] + view[1]) / 2, lo + width / 2), hi - width / 2);
    return [middle - width / 2, middle + width / 2];
  }

  // The overview shades what the waveform shows.
  function follow() {
    const wave = charts.waveform;
    document.querySelectorAll('svg[data-plot="overview"]').forEach((svg) => {
      const [l, t, r, b] = svg.dataset.frame.split(" ").map(Number), [lo, hi] = svg.dataset.view.split(" ").map(Number);
      const X = (v) => Math.min(Math.max(l + (r - l) * (v / wave.overviewScale - lo) / (hi - lo), l), r), [x1, x2] = wave.plots[0].view.map(X);
      svg.querySelector(".window path")?.setAttribute("d", `M${x1 - 1} ${t}H${x2 + 1}V${b}H${x1 - 1}Z`);
    });
  }

  function zoom(name, view) {
    charts[name].plots.forEach((plot) => draw(plot, view ? clamp(charts[name], view) : plot.home));
    if (name === "waveform") follow();
  }

  function watch(plot, tools) {
    const { svg, chart, name } = plot;
    const at = (event) => {
      const box = svg.getBoundingClientRect(), [l, , r] = plot.frame;
      const x = (event.clientX - box.left) * svg.viewBox.baseVal.width / box.width;
      return [x, plot.view[0] + (plot.view[1] - plot.view[0]) * (Math.min(Math.max(x, l), r) - l) / (r - l)];
    };
    let from = null;
    const overlay = (x1, x2, wash) => {
      svg.querySelector(".cursor")?.remove();
      const line = svg.querySelector("path");
      if (!line) return;
      const [, t, , b] = plot.frame, node = line.cloneNode(false);
      for (const key of [...node.getAttributeNames()]) node.removeAttribute(key);
      node.setAttribute("class", "cursor");
      node.setAttribute("d", `M${x1} ${t}H${x2}V${b}H${x1}Z`);
      node.setAttribute("stroke", "#1b1f24");
      node.setAttribute("fill", wash ? "#0072B2" : "none");
      node.setAttribute("fill-opacity", "0.15");
      node.setAttribute("stroke-width", "0.7");
      node.setAttribute("pointer-events", "none");
      svg.append(node);
    };
    let cursor;
    const at_x = (curve, x) => {
      const nearest = Math.round((x - curve.x0) / curve.dx);
      let index = Math.min(Math.max(nearest, 0), curve.values.length - 1);
      if (curve.peak) {
        // The highest line near the pointer is the one meant.
        const reach = Math.ceil(3 * (plot.view[1] - plot.view[0]) / (plot.frame[2] - plot.frame[0]) / curve.dx);
        for (let i = Math.max(0, nearest - reach); i <= Math.min(curve.values.length - 1, nearest + reach); i++) if (curve.values[i] > curve.values[index]) index = i;
      }
      return index;
    };
    const read = (x) => {
      const index = at_x(chart, x);
      const place = chart.x0 + index * chart.dx, limit = 5 * (plot.view[1] - plot.view[0]) / (plot.frame[2] - plot.frame[0]);
      const named = chart.toggles.flatMap(([label, f], k) => { const n = Math.round(place / f); return chart.picked.has(k) && !(chart.lanes.length && n <= chart.lanes[k].length) && n > 0 && Math.abs(n * f - place) <= limit ? [n === 1 ? label : `${n} × ${label}`] : []; });
      const near = [...chart.lanes.flat().filter((m) => Math.abs(m[0] - place) <= limit).map((m) => m[1]), ...named].slice(0, 2);
      const beside = chart.beside.map((curve) => ` · the other ${short(curve.values[at_x(curve, place)], 4)} ${chart.yUnit}`).join("");
      tools.readout.textContent = `${short(place, 6)} ${chart.xUnit} · ${short(chart.values[index], 4)} ${chart.yUnit}${beside}${near.length ? " · near " + near.join(", ") : ""}`;
      const [l, , r] = plot.frame, cx = l + (r - l) * (place - plot.view[0]) / (plot.view[1] - plot.view[0]);
      if (cx >= l && cx <= r) overlay(cx, cx, false);
    };
    const fingers = new Map();
    let pinch = null;
    const span = () => [...fingers.values()].sort((a, b) => a - b);
    const around = (x, factor) => zoom(name, [x - (x - plot.view[0]) * factor, x + (plot.view[1] - x) * factor]);
    svg.addEventListener("pointerdown", (event) => {
      if (event.button !== 0) return;
      const [px, x] = at(event);
      fingers.set(event.pointerId, px);
      // Two fingers keep what is under them.
      if (fingers.size === 2) { const value = (p) => plot.view[0] + (plot.view[1] - plot.view[0]) * (p - plot.frame[0]) / (plot.frame[2] - plot.frame[0]); pinch = span().map(value); from = null; svg.querySelector(".cursor")?.remove(); }
      else from = [px, x];
      try { svg.setPointerCapture(event.pointerId); } catch { /* gone already */ }
    });
    svg.addEventListener("pointermove", (event) => {
      const [px, x] = at(event), [l, , r] = plot.frame;
      if (fingers.has(event.pointerId)) fingers.set(event.pointerId, px);
      if (pinch && fingers.size === 2) {
        const [p1, p2] = span();
        if (p2 - p1 < 12) return;
        const per = (pinch[1] - pinch[0]) / (p2 - p1), lo = pinch[0] - (p1 - l) * per;
        zoom(name, [lo, lo + (r - l) * per]);
        return;
      }
      if (from) overlay(Math.min(Math.max(from[0], l), r), Math.min(Math.max(px, l), r), true);
      else if (px >= l && px <= r) read(x);
    });
    svg.addEventListener("pointerup", (event) => {
      fingers.delete(event.pointerId);
      if (pinch) { if (!fingers.size) pinch = null; return; }
      if (!from) return;
      const [px, x] = at(event), start = from;
      from = null;
      if (Math.abs(px - start[0]) > 6) zoom(name, [Math.min(x, start[1]), Math.max(x, start[1])]);
      else read(x);
    });
    svg.addEventListener("pointercancel", (event) => { fingers.delete(event.pointerId); pinch = null; from = null; svg.querySelector(".cursor")?.remove(); });
    svg.addEventListener("pointerleave", () => { if (!from) { svg.querySelector(".cursor")?.remove(); tools.readout.textContent = tools.hint; } });
    svg.addEventListener("dblclick", () => zoom(name, null));
    // A trackpad's pinch arrives as a wheel with Ctrl; the wheel alone scrolls the page.
    svg.addEventListener("wheel", (event) => {
      if (!event.ctrlKey && !event.metaKey) return;
      event.preventDefault();
      around(at(event)[1], Math.exp(Math.max(-1, Math.min(1, event.deltaY * (event.deltaMode ? 0.05 : 0.004)))));
    }, { passive: false });
    svg.tabIndex = 0;
    svg.setAttribute("aria-description", "Arrow keys move the view, plus and minus zoom, Escape goes back, Shift with an arrow key moves the cursor");
    svg.addEventListener("blur", () => { svg.querySelector(".cursor")?.remove(); cursor = undefined; tools.readout.textContent = tools.hint; });
    svg.addEventListener("keydown", (event) => {
      const [a, c] = plot.view, step = (c - a) / 5;
      const act = { ArrowLeft: () => zoom(name, [a - step, c - step]), ArrowRight: () => zoom(name, [a + step, c + step]), "+": () => around((a + c) / 2, 0.5), "=": () => around((a + c) / 2, 0.5), "-": () => around((a + c) / 2, 2), Escape: () => zoom(name, null), 0: () => zoom(name, null) }[event.key];
      if (event.shiftKey && (event.key === "ArrowLeft" || event.key === "ArrowRight") && !event.ctrlKey && !event.metaKey && !event.altKey) {
        // The cursor, a hundredth of the view or a value at a time.
        event.preventDefault();
        const stride = Math.max((c - a) / 100, chart.dx) * (event.key === "ArrowLeft" ? -1 : 1);
        cursor = Math.min(Math.max(cursor >= a && cursor <= c ? cursor + stride : (a + c) / 2, a), c);
        read(cursor);
        return;
      }
      if (!act || event.ctrlKey || event.metaKey || event.altKey) return;
      event.preventDefault();
      act();
    });
    svg.classList.add("zoomable");
  }

  const button = (label, title, act) => {
    const node = document.createElement("button");
    node.type = "button";
    node.textContent = label;
    node.title = title;
    node.setAttribute("aria-label", title);
    node.addEventListener("click", act);
    return node;
  };

  function file(svg) {
    const copy = svg.cloneNode(true), { width, height } = svg.viewBox.baseVal;
    copy.querySelector(".cursor")?.remove();
    copy.removeAttribute("class");
    copy.removeAttribute("tabindex");
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

  document.querySelectorAll("script[data-chart]").forEach((script) => {
    const chart = JSON.parse(script.textContent);
    chart.values = decode(chart.values, chart.count, chart.peak);
    chart.beside = chart.beside.map((curve) => ({ ...curve, peak: chart.peak, values: decode(curve.values, curve.count, chart.peak) }));
    chart.plots = [];
    chart.picked = new Set(chart.toggles.flatMap((toggle, index) => toggle[3] && chart.lanes.length ? [index] : []));
    charts[script.dataset.chart] = chart;
  });

  document.querySelectorAll("figure").forEach((figure) => {
    const drawings = [...figure.querySelectorAll("svg")];
    if (!drawings.length) return;
    const current = () => drawings.find(shown) || drawings[0];
    const title = drawings[0].getAttribute("aria-label") || drawings[0].dataset.name;
    const bar = document.createElement("div"), readout = document.createElement("div");
    bar.className = "tools";
    readout.className = "readout";
    readout.setAttribute("role", "status");
    const chart = charts[drawings[0].dataset.plot];
    const tools = { readout, hint: chart && chart.values.length > 8 ? "Drag, pinch or Ctrl + wheel to zoom, double click to go back" : "" };
    readout.textContent = tools.hint;
    bar.append(readout);
    if (tools.hint) {
      const name = drawings[0].dataset.plot;
      bar.append(
        button("+", `Zoom in: ${title}`, () => { const [a, b] = chart.plots[0].view, w = b - a; zoom(name, [a + w / 4, b - w / 4]); }),
        button("−", `Zoom out: ${title}`, () => { const [a, b] = chart.plots[0].view, w = b - a; zoom(name, [a - w / 2, b + w / 2]); }),
        button("All", `Show everything that is kept: ${title}`, () => zoom(name, [-Infinity, Infinity].map((v) => Math.min(Math.max(v, chart.x0), chart.x0 + chart.dx * (chart.values.length - 1))))),
        button("Reset", `Back to the first view: ${title}`, () => zoom(name, null)),
      );
    }
    bar.append(
      button("SVG", `Save as SVG: ${title}`, () => save(current().dataset.name + ".svg", new Blob([file(current())], { type: "image/svg+xml" }))),
      button("PNG", `Save as PNG: ${title}`, () => savePng(current())),
    );
    figure.prepend(bar);
    if (!tools.hint) return;
    if (chart.toggles.length) {
      const picks = document.createElement("div");
      picks.className = "tools picks";
      picks.append("Harmonics of");
      chart.toggles.forEach(([label, frequency, color], index) => {
        const node = button(label, `Mark the harmonics of ${label}, ${short(frequency, 6)} ${chart.xUnit}: ${title}`, () => {
          chart.picked[chart.picked.has(index) ? "delete" : "add"](index);
          node.setAttribute("aria-pressed", chart.picked.has(index));
          chart.plots.forEach((plot) => draw(plot, plot.view));
        });
        node.setAttribute("aria-pressed", chart.picked.has(index));
        node.style.setProperty("--mark", color);
        picks.append(node);
      });
      bar.after(picks);
    }
    for (const svg of drawings) {
      const frame = svg.dataset.frame.split(" ").map(Number), view = svg.dataset.view.split(" ").map(Number);
      const [lo, hi] = chart.y, [, t, , b] = frame, L = Math.log10;
      const y = chart.log
        ? (v) => b + (t - b) * Math.max(-1, (L(Math.max(v, lo * 1e-3)) - L(lo)) / (L(hi) - L(lo)))
        : (v) => b + (t - b) * (v - lo) / (hi - lo);
      const plot = { svg, chart, name: svg.dataset.plot, frame, view, home: view, original: svg.innerHTML, y, font: Number(svg.dataset.font), lane: chart.laneHeight, top: Number(svg.dataset.top), yScale: chart.yScale, laneText: svg.querySelector(".lane text")?.cloneNode(false) };
      chart.plots.push(plot);
      watch(plot, tools);
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
      hint.textContent = " Click to move it.";
      svg.closest("figure").querySelector("figcaption")?.append(hint);
    }
    svg.addEventListener("click", (event) => {
      const box = svg.getBoundingClientRect(), [l, , r] = svg.dataset.frame.split(" ").map(Number), [lo, hi] = svg.dataset.view.split(" ").map(Number);
      const x = (event.clientX - box.left) * svg.viewBox.baseVal.width / box.width;
      const time = (lo + (hi - lo) * (x - l) / (r - l)) * wave.overviewScale, [a, c] = wave.plots[0].view;
      zoom("waveform", [time - (c - a) / 2, time + (c - a) / 2]);
    });
  });
})();
