// A stand-in for the engine in a Worker: answers every message of the contract plausibly, without any physics. Its "TOML" is JSON.
"use strict";
(() => {
  const SCHEMA = {/*schema*/};
  const RATE = 25600, ELEMENTS = 19, ROWS = 2, DT = 0.00125;
  const RECTANGLE = { on: "outer-raceway", row: 1, center_deg: 0, depth_um: 20, shape: { rectangle: { length_mm: 3, width_mm: 4 } } };
  const BASE = { name: "rectangle", bearing: { preset: "NN3007" }, operation: { speed_rpm: 1800, load_n: [300, 0] }, simulation: { duration_s: 0.5 } };
  const text = (s) => `# fake\n${JSON.stringify(s, null, 1)}\n`;
  const parse = (t) => JSON.parse(t.replace(/^#.*\n/, ""));
  const slots = [];

  function refuse(key, message, line = null) { throw { problems: [{ key, line, message }] }; }

  function scenarioOf(request) {
    if (request.toml === undefined) return structuredClone(request.scenario);
    try {
      return parse(request.toml);
    } catch (error) {
      return refuse(null, `not a scenario: ${error.message}`, 1);
    }
  }

  function check(s) {
    (s.defects ?? []).forEach((d, k) => {
      const key = `defects[${k + 1}].shape.rectangle.width_mm`;
      if (d.shape?.rectangle?.width_mm > 6) refuse(key, `${d.shape.rectangle.width_mm} mm is wider than the roller, whose length is 6 mm; allowed: <= 6 mm`, 26);
      if (!(d.depth_um > 0)) refuse(`defects[${k + 1}].depth_um`, "a depth is above 0 um");
    });
    if (s.operation?.speed_rpm === undefined) refuse("operation.speed_rpm", "missing");
    if (s.operation?.speed_rpm === 0) refuse("operation.speed_rpm", "the shaft does not turn: a number other than 0");
  }

  const noise = (n) => ((Math.sin(n * 12.9898) * 43758.5453) % 1 + 1) % 1 - 0.5;
  const bpfo = (s) => s.operation.speed_rpm / 60 * 8.336;

  function open({ slot, carry, ...what }) {
    const scenario = scenarioOf(what);
    check(scenario);
    const before = slots[slot], carried = !!(carry && before);
    const all = structuredClone({ ...scenario, bearing: { radial_clearance_um: 10, ...scenario.bearing }, contact: { damping_ns_per_m: 200, law: "ecl", ...scenario.contact }, simulation: { accuracy: "standard", sample_rate_hz: RATE, duration_s: 0.5, ...scenario.simulation } });
    slots[slot] = { scenario, all, n: 0, t: carried ? before.t : 0, live: carried, x: [] };
    const [x, y] = scenario.operation.load_n;
    return {
      carried, live: carried, toml: text(scenario), scenario, all, warnings: [], assumed: [], rate_hz: RATE, samples: Math.round(all.simulation.duration_s * RATE) + 1, settled_s: 0.083, axis: "sensor_ax", unit: "m/s^2",
      rpm: scenario.operation.speed_rpm, constant_speed: true, orders: { BPFO: 8.336, BPFI: 10.66, BSF: 4.02, FTF: 0.4388 },
      geometry: { inner_mm: 21.5, outer_mm: 27.5, pitch_mm: 24.5, element_mm: 3, length_mm: 6, rows: ROWS, elements: ELEMENTS, element: "roller" }, load_deg: Math.atan2(y, x) * 180 / Math.PI,
    };
  }

  function sample(s, t, n) {
    let x = 8 * noise(n);
    for (const d of s.defects ?? []) {
      const f = bpfo(s), since = (t * f % 1) / f;
      x += (20 + 4 * d.depth_um) * Math.exp(-since * 1200) * Math.sin(2 * Math.PI * 3200 * since);
    }
    return x;
  }

  function advance({ slot, rows, frames }) {
    const one = slots[slot], first = one.n, end = one.live ? Infinity : Math.round(one.all.simulation.duration_s * RATE) + 1, count = Math.min(rows, end - first), x = new Float32Array(count);
    for (let k = 0; k < count; k++, one.n++, one.t += 1 / RATE) x[k] = sample(one.scenario, one.t, one.n);
    one.x.push(...x);
    if (one.x.length > 65536) one.x.splice(0, 32768);
    // About as slow as the engine.
    for (const until = performance.now() + count / RATE * 900; performance.now() < until;);
    const answer = { t: one.t, first, done: one.n >= end, live: one.live, x, moments: moments(one.x) };
    return frames ? { ...answer, frames: framesOf(one, count) } : answer;
  }

  function framesOf(one, rows) {
    const count = Math.max(1, Math.floor(rows / RATE / DT)), turn = one.scenario.operation.speed_rpm / 60 * 2 * Math.PI, ring = new Float32Array(count), pitch = 2 * Math.PI / ELEMENTS;
    const load = Math.atan2(one.scenario.operation.load_n[1], one.scenario.operation.load_n[0]);
    const list = Array.from({ length: ROWS }, () => ({ cage: new Float32Array(count), orbit: new Float32Array(count * ELEMENTS), spin: new Float32Array(count * ELEMENTS), inner_n: new Float32Array(count * ELEMENTS), outer_n: new Float32Array(count * ELEMENTS) }));
    for (let f = 0; f < count; f++) {
      const t = one.t - (count - f) * DT;
      ring[f] = turn * t;
      list.forEach((row, r) => {
        row.cage[f] = 0.4388 * turn * t;
        for (let j = 0; j < ELEMENTS; j++) {
          const a = (row.cage[f] + (j + r / 2) * pitch) % (2 * Math.PI), k = f * ELEMENTS + j;
          row.orbit[k] = a;
          row.spin[k] = -4.02 * turn * t;
          const hit = (one.scenario.defects ?? []).some((d) => d.row === r + 1 && Math.abs(Math.sin((a - d.center_deg / 180 * Math.PI) / 2)) < 0.03);
          row.outer_n[k] = row.inner_n[k] = Math.max(0, Math.cos(a - load)) ** 1.5 * 60 * (hit ? 0.3 : 1);
        }
      });
    }
    return { count, dt: DT, ring, rows: list };
  }

  function moments(x) {
    const n = x.length || 1, rms = Math.sqrt(x.reduce((a, v) => a + v * v, 0) / n), peak = x.reduce((a, v) => Math.max(a, Math.abs(v)), 0);
    return { rms, peak, crest: peak / rms, kurtosis: x.reduce((a, v) => a + v ** 4, 0) / n / rms ** 4, samples: x.length };
  }

  function spectra({ slot, longest }) {
    const one = slots[slot], samples = 2 ** Math.floor(Math.log2(Math.min(longest, one.x.length)));
    if (!(samples >= 512)) return { samples: 0, settling: true };
    const df = RATE / samples, damaged = (one.scenario.defects ?? []).length > 0, f = bpfo(one.scenario);
    const spectrum = Float32Array.from({ length: samples / 2 }, (_, k) => 0.05 + 0.05 * Math.abs(noise(k)) + (damaged ? 2 * Math.exp(-(((k * df - 3200) / 900) ** 2)) * (Math.cos(2 * Math.PI * k * df / f) > 0.8 ? 1 : 0.1) : 0));
    const envelope = Float32Array.from({ length: samples / 16 }, (_, k) => 0.1 + 0.2 * Math.abs(noise(k)) + (damaged && Math.abs(k * df / f - Math.round(k * df / f)) < df / f && k * df > f / 2 ? 6 * f / (k * df) : 0));
    return { samples, settling: samples < 8192, spectrum: { df, values: spectrum }, envelope: { df, values: envelope, band_hz: [2000, 5000] }, lines: damaged ? [{ name: "BPFO", hz: f * 0.998, nominal_hz: f, found: true, harmonics: 5, over_noise_db: 20.1, defect: 1 }] : [] };
  }

  function damage({ slot }) {
    const ring = (d) => {
      const [kind, s] = Object.entries(d.shape)[0];
      if (kind === "rectangle") return [[-1, -1], [1, -1], [1, 1], [-1, 1]].flatMap(([a, b]) => [a * s.length_mm / 2, b * s.width_mm / 2]);
      if (kind === "circle") return Array.from({ length: 40 }, (_, k) => k * Math.PI / 20).flatMap((a) => [s.diameter_mm / 2 * Math.cos(a), s.diameter_mm / 2 * Math.sin(a)]);
      if (kind === "outline") return s.points_mm.flat();
      return [[-3.5, 0], [-1, 1], [1, s.max_width_mm / 2], [3.5, 0], [0, -2]].flat();
    };
    return { defects: (slots[slot].scenario.defects ?? []).map((d, k) => {
      const grid = d.shape.depth_map, p = grid ? [] : Float32Array.from(ring(d));
      const s = [...p].filter((_, i) => i % 2 === 0), z = [...p].filter((_, i) => i % 2), wide = (l) => Math.max(...l) - Math.min(...l);
      return { defect: k + 1, on: d.on, row: d.row ?? 1, center_deg: d.center_deg ?? 0, axial_offset_mm: d.axial_offset_mm ?? 0, roller: d.roller ?? null, depth_um: d.depth_um, polygons_mm: grid ? [] : [p], grid: grid ? { ...grid, depth_um: Float32Array.from(grid.depth_um) } : null,
        length_mm: grid ? grid.columns * grid.ds_mm : wide(s), width_mm: grid ? grid.rows * grid.dz_mm : wide(z), area_mm2: 12, deepest_um: d.depth_um };
    }) };
  }

  function scratch({ points_mm: p, width_mm: w }) {
    const s = [...p].filter((_, i) => i % 2 === 0), z = [...p].filter((_, i) => i % 2), mid = (l) => (Math.min(...l) + Math.max(...l)) / 2, c = [mid(s), mid(z)];
    const up = s.map((v, i) => [v - c[0], z[i] - c[1] + w / 2]), down = s.map((v, i) => [v - c[0], z[i] - c[1] - w / 2]).reverse();
    return { shape: { outline: { points_mm: [...up, ...down] } }, center_mm: c, length_mm: Math.max(...s) - Math.min(...s) + w, width_mm: w };
  }

  function brush({ grid, points_mm: p, width_mm: w, depth_um, raise }) {
    const map = grid ? structuredClone(grid.depth_map) : { ds_mm: 0.1, dz_mm: 0.1, columns: 60, rows: 40, s0_mm: -3, z0_mm: -2, depth_um: Array(2400).fill(0) }, c = grid ? [0, 0] : [p[0], p[1]];
    for (let i = 0; i < p.length; i += 2) {
      for (let k = 0; k < 2400; k++) {
        const s = map.s0_mm + (k % 60) * 0.1, z = map.z0_mm + Math.floor(k / 60) * 0.1;
        if (Math.hypot(s - p[i] + c[0], z - p[i + 1] + c[1]) < w / 2) map.depth_um[k] = raise ? 0 : depth_um;
      }
    }
    return { shape: { depth_map: map }, center_mm: c, length_mm: 6, width_mm: 4 };
  }

  const TABLE = { columns: ["found", "Hz", "dB"], rows: [["BPFO", 249.6, 20.1], ["FTF", 13.2, 3.1]] };
  const ANSWERS = {
    about: () => ({ version: "0.0.0-fake", engine: "webassembly", schema: SCHEMA, bearings: [{ name: "NN3007", words: "double row", element: "roller" }, { name: "6205", words: "deep groove", element: "ball" }], known: ["NN3007", "6205", "6205-2RS"],
      examples: [{ name: "healthy", words: "without damage", toml: text({ ...BASE, name: "healthy" }) }, { name: "rectangle", words: "a spall", toml: text({ ...BASE, defects: [RECTANGLE] }) }] }),
    open, advance, spectra, damage, scratch, brush,
    verdict: ({ slot }) => ({ headline: (slots[slot].scenario.defects ?? []).length ? "BPFO is detected at 249.6 Hz: outer raceway damage" : "No line of a defect is significant", table: TABLE, samples: slots[slot].n, damage: (slots[slot].scenario.defects ?? []).length ? [{ name: "BPFO", hz: 249.6 }] : [], indicators: [] }),
    differ: ({ a, b }) => ({ headline: `B against A: damage at BPFO in ${a.damage.length ? "A" : b.damage.length ? "B" : "neither"} alone; RMS × 2.00 (1.90 to 2.10).`, ratios: [] }),
    indicators: ({ slot }) => {
      const m = moments(slots[slot].x);
      return { settled: slots[slot].n > 8192, quantities: [["RMS", "m/s^2", m.rms], ["peak", "m/s^2", m.peak], ["crest factor", "", m.crest], ["kurtosis", "", m.kurtosis]].map(([name, unit, value]) => ({ name, unit, value, low: 0.97 * value, high: 1.03 * value, meaning: `${name} of the acceleration` })) };
    },
    sound: ({ slot }) => ({ rate_hz: RATE, x: Float32Array.from(slots[slot].x.slice(-10240), (v) => v / 200), turns: 12 }),
    passage: () => ({ s_mm: Float32Array.from({ length: 81 }, (_, k) => k / 10 - 4), length_mm: Float32Array.from({ length: 81 }, (_, k) => (Math.abs(k - 40) < 15 ? 2 : 6)), force_n: Float32Array.from({ length: 81 }, (_, k) => (Math.abs(k - 40) < 15 ? 20 : 60)), healthy_n: 60, width_mm: 6 }),
    outline: ({ kind, bytes, name, options }) => {
      if (bytes.length < 60) refuse(null, `${name} is no ${kind}: its first bytes are of no format that is read`);
      if (kind === "photo" && !(options.mm_per_pixel > 0)) refuse("mm_per_pixel", "mm_per_pixel is missing: the side of a pixel");
      return { shape: { outline: { points_mm: [[-1.5, -2], [1.5, -2], [1.2, 2], [-1.4, 1.8]] } }, notes: ["threshold 0.46"], length_mm: 3, width_mm: 4, area_mm2: 8.937 };
    },
    normal: (request) => {
      const s = scenarioOf(request);
      return { toml: text(s), scenario: s, stated: s };
    },
    save: ({ slot, format }) => {
      if (slots[slot].live || slots[slot].n < slots[slot].all.simulation.duration_s * RATE) refuse(null, "only a run from t = 0 that is done is saved");
      return { name: `signals.${format}`, type: "text/csv", bytes: new TextEncoder().encode(`t,sensor_ax\n${slots[slot].x.map((v, k) => `${k / RATE},${v}`).join("\n")}\n`) };
    },
    listen: ({ name, bytes }) => (bytes.length < 20 ? refuse(null, `${name} holds no signal`)
      : { channels: [{ name: "x", samples: null, rate_hz: null, rate_from: null, rate_missing: "no sample rate follows from `t`", unit: null, rpm: null, rpm_from: null, is_wav: false }], run: null }),
    judge: ({ rate_hz, from_s, unit, bearing, rpm }) => {
      if (!unit) refuse(null, "the file states no unit for `x`; give unit, such as unit g or unit m/s^2");
      if (unit === "furlong") refuse(null, "unit furlong: no unit is called `furlong`");
      return { from_s, headline: "BPFO is detected", table: TABLE, spectrum: { df: 10, values: new Float32Array(512).fill(0.4) }, envelope: { df: 10, values: new Float32Array(128).fill(0.3) }, lines: [],
        warnings: ["98 % of the signal's energy lie in one revolution"], levels: [`rms 1.000 ${unit}`, `peak 4.000 ${unit}`],
        used: [`bearing: ${bearing}`, `shaft speed ${rpm} r/min, as given`, `sample rate ${rate_hz} Hz, as given`, `unit ${unit}, as given`, "channel x: 0.160 s, 4096 samples"],
        x: Float32Array.from({ length: 4096 }, (_, k) => noise(k)), rate_hz, unit: unit === "g" ? "m/s^2" : unit };
    },
  };

  // As in src/message.js, which a Worker from a Blob cannot import.
  const padded = (n) => Math.ceil(n / 8) * 8, KINDS = { f32: Float32Array, f64: Float64Array, u8: Uint8Array };
  function decode(bytes) {
    const n = new DataView(bytes.buffer).getUint32(0, true), start = padded(4 + n);
    return JSON.parse(new TextDecoder().decode(bytes.subarray(4, 4 + n)), (_, v) => (Array.isArray(v?.$) ? new KINDS[v.$[0]](bytes.buffer, start + v.$[1], v.$[2]) : v));
  }
  function encode(message) {
    const arrays = [];
    let size = 0;
    const json = new TextEncoder().encode(JSON.stringify(message, (_, v) => {
      const kind = Object.keys(KINDS).find((k) => v instanceof KINDS[k]);
      if (!kind) return v;
      arrays.push([size, v]);
      size = padded(size + v.byteLength);
      return { $: [kind, arrays.at(-1)[0], v.length] };
    }));
    const start = padded(4 + json.length), bytes = new Uint8Array(start + size);
    new DataView(bytes.buffer).setUint32(0, json.length, true);
    bytes.set(json, 4);
    for (const [at, v] of arrays) bytes.set(new Uint8Array(v.buffer, v.byteOffset, v.byteLength), start + at);
    return bytes;
  }

  self.onmessage = ({ data }) => {
    if (!data.bytes) return;
    const request = decode(data.bytes);
    let answer;
    try {
      if (!ANSWERS[request.do]) refuse(null, `no request is named ${request.do}`);
      answer = { ok: true, ...ANSWERS[request.do](request) };
    } catch (error) {
      if (!error.problems) return self.postMessage({ id: data.id, trap: String(error.stack ?? error) });
      answer = { ok: false, problems: error.problems };
    }
    const bytes = encode(answer);
    self.postMessage({ id: data.id, bytes }, [bytes.buffer]);
  };
})();
