// Data for the views that no engine has computed: the shapes are like a bearing's, the numbers mean nothing.

const TAU = 2 * Math.PI;

// Numbers from 0 to 1, the same each time.
export function random(seed) {
  let state = seed >>> 0;
  return () => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return state / 4294967296;
  };
}

export const BPFO = 249.5,
  NOMINAL = 250.1;
export const lines = (found = true) => [
  {
    name: "BPFO",
    hz: found ? BPFO : NOMINAL,
    nominal_hz: NOMINAL,
    found,
    harmonics: found ? 5 : 0,
    over_noise_db: found ? 20.1 : 1.2,
    defect: 1,
  },
  { name: "BPFI", hz: 319.9, nominal_hz: 319.9, found: false, harmonics: 0, over_noise_db: 0.8, defect: null },
  { name: "BSF", hz: 121.3, nominal_hz: 121.3, found: false, harmonics: 0, over_noise_db: -0.4, defect: null },
  { name: "FTF", hz: 13.2, nominal_hz: 13.2, found: false, harmonics: 0, over_noise_db: 1.9, defect: null },
];

// Impacts that ring, in noise; `shift` moves them in time.
export function waveform({ n = 8192, rate = 25600, size = 90, shift = 0, seed = 1 } = {}) {
  const values = new Float32Array(n),
    noise = random(seed),
    period = 1 / BPFO;
  for (let i = 0; i < n; i++) {
    const t = i / rate + shift,
      since = t % period,
      strength = 0.6 + 0.4 * Math.sin(TAU * 30 * t);
    values[i] =
      size * strength * Math.exp(-since * 900) * Math.sin(TAU * 4200 * since) + 8 * (noise() + noise() - 1) + 3 * Math.sin(TAU * 30 * t);
  }
  return { x0: shift, dx: 1 / rate, values };
}

export function spectrum({ n = 4097, df = 12800 / 4096, size = 1, seed = 2 } = {}) {
  const noise = random(seed),
    values = new Float32Array(n);
  for (let i = 0; i < n; i++) {
    const f = i * df,
      hump = 1.4 * Math.exp(-(((f - 4200) / 500) ** 2)) + 0.3 * Math.exp(-(((f - 8900) / 700) ** 2));
    values[i] =
      (0.02 + size * hump * (0.25 + Math.abs(Math.cos((TAU * f) / BPFO / 2)) ** 40)) * (0.4 + noise()) + (Math.abs(f - 30) < df ? 0.5 : 0);
  }
  return { x0: 0, dx: df, values };
}

export function envelope({ n = 4097, df = 12800 / 8192, size = 1, seed = 3 } = {}) {
  const noise = random(seed),
    values = new Float32Array(n);
  for (let i = 0; i < n; i++) {
    const f = i * df;
    let v = 0.16 * (0.3 + noise()) * (1 + 1 / (1 + f / 200));
    for (let k = 1; k <= 5; k++) v += size * (4.2 / k ** 0.8) * Math.exp(-(((f - k * BPFO) / (1.2 * df)) ** 2));
    values[i] = v;
  }
  return { x0: 0, dx: df, values };
}

export const unit = "m/s^2";
export const curves = () => ({
  waveform: { ...waveform({ n: 2048 }), unit, behind: waveform({ n: 2048, size: 2, seed: 7 }) },
  spectrum: { ...spectrum(), unit, band_hz: [3200, 5200], behind: spectrum({ size: 0.03, seed: 8 }) },
  envelope: { ...envelope(), unit, lines: lines(), behind: envelope({ size: 0, seed: 9 }) },
});

export const geometry = {
  inner_mm: 20.5,
  outer_mm: 26.5,
  pitch_mm: 23.5,
  element_mm: 3,
  length_mm: 6,
  rows: 2,
  elements: 19,
  element: "roller",
};

// Instants of the bearing from t0 on; rolling without slip, the load to +x.
export function frames(t0, count, dt = 3e-4, shape = geometry) {
  const n = shape.elements,
    ratio = shape.inner_mm / (2 * shape.pitch_mm),
    speed = TAU * 30;
  const made = {
    count,
    dt,
    ring: new Float32Array(count),
    rows: Array.from({ length: shape.rows }, () => ({
      cage: new Float32Array(count),
      orbit: new Float32Array(count * n),
      spin: new Float32Array(count * n),
      inner_n: new Float32Array(count * n),
      outer_n: new Float32Array(count * n),
    })),
  };
  for (let k = 0; k < count; k++) {
    const t = t0 + k * dt;
    made.ring[k] = (speed * t) % TAU;
    made.rows.forEach((row, r) => {
      const cage = speed * ratio * t;
      row.cage[k] = cage % TAU;
      for (let e = 0; e < n; e++) {
        const a = cage + (TAU * (e + 0.5 * r)) / n,
          load = Math.max(0, Math.cos(a)) ** 1.5 * 120,
          i = k * n + e;
        row.orbit[i] = a % TAU;
        row.spin[i] = (a - speed * t * (shape.inner_mm / (2 * shape.element_mm)) + cage) % TAU;
        row.outer_n[i] = load + 4;
        row.inner_n[i] = load;
      }
    });
  }
  return made;
}

export const damage = () => ({
  defects: [
    {
      defect: 1,
      on: "outer-raceway",
      row: 1,
      center_deg: 0,
      depth_um: 20,
      polygons_mm: [Float32Array.from([-1.5, -2, 1.5, -2, 1.5, 2, -1.5, 2])],
      grid: null,
      length_mm: 3,
      width_mm: 4,
      area_mm2: 12,
      deepest_um: 20,
    },
    {
      defect: 2,
      on: "inner-raceway",
      row: 2,
      center_deg: 90,
      depth_um: 8,
      polygons_mm: [],
      grid: {
        ds_mm: 0.1,
        dz_mm: 0.5,
        s0_mm: -0.6,
        z0_mm: -1,
        columns: 13,
        rows: 5,
        depth_um: Float32Array.from({ length: 65 }, (_, i) => (i % 13 > 2 && i % 13 < 10 ? 8 : 0)),
      },
      length_mm: 0.7,
      width_mm: 2,
      area_mm2: 1.4,
      deepest_um: 8,
    },
    {
      defect: 3,
      on: "roller",
      row: 1,
      center_deg: 30,
      depth_um: 5,
      polygons_mm: [Float32Array.from([-0.5, -1, 0.5, -1, 0.5, 1, -0.5, 1])],
      grid: null,
      length_mm: 1,
      width_mm: 2,
      area_mm2: 2,
      deepest_um: 5,
    },
  ],
});

export function passage() {
  const n = 241,
    s_mm = new Float32Array(n),
    length_mm = new Float32Array(n),
    force_n = new Float32Array(n);
  for (let i = 0; i < n; i++) {
    const s = -3 + (6 * i) / (n - 1),
      edge = 1 / (1 + Math.exp((Math.abs(s) - 1.5) / 0.05));
    s_mm[i] = s;
    length_mm[i] = 6 - 4 * edge;
    force_n[i] = 118 * (1 - 0.62 * edge);
  }
  return { s_mm, length_mm, force_n, healthy_n: 118, width_mm: 6 };
}

// Ticks of a ringing at BPFO, a whole number of them.
export function loop({ rate_hz = 25600, ticks = 100, size = 0.8, hz = BPFO } = {}) {
  const n = Math.round((ticks * rate_hz) / hz),
    x = new Float32Array(n);
  for (let i = 0; i < n; i++) {
    const since = (((i * ticks) / n) % 1) / hz;
    x[i] = size * Math.exp(-since * 900) * Math.sin(TAU * 4200 * since);
  }
  return { rate_hz, x, turns: 12 };
}
