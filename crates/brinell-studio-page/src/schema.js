// Fields from the JSON Schema of the scenario: which control a key gets, in which range, and what it says.
import { spelled } from "./dom.js";
import { get, set } from "./state.js";

/** @typedef {import("./state.js").Path} Path */
/**
 * @typedef {object} Spec
 * @property {Path} path
 * @property {string} label
 * @property {string} unit
 * @property {string} note
 * @property {"number" | "choice" | "flag" | "text"} kind
 * @property {boolean} [united]  also takes a text of a number and its unit
 * @property {Record<string, number>} [units]  of a number that the page makes a key of: what one of each is in the field's unit
 * @property {boolean} [words]  a text that is never JSON
 * @property {boolean} [integer]
 * @property {number} [min]      allowed by the schema
 * @property {number} [max]
 * @property {(value?: number) => string} [refuse]  why the page itself does not take it, undefined where the field is empty
 * @property {[number, number]} [span]  of the range input
 * @property {boolean} [log]
 * @property {[string, string][]} [options]
 * @property {boolean} [required]
 * @property {(tree: any) => any} [other]  words for what the field does not hold
 * @property {any} [fallback]  the schema's default
 * @property {(tree: any) => any} read
 * @property {(tree: any, value: any, all?: any) => void} write  all: every key as the engine read it
 */

/** @param {any} schema @param {Path} path @returns {any} */
export function schemaAt(schema, path) {
  return path.reduce((node, key) => (typeof key === "number" ? node?.items : node?.properties?.[key]), schema);
}

/** The key's name without its unit. @param {string} key */
function named(key) {
  const words = key
    .replace(
      /_(mm2|mm|um|deg|kg|hz|rpm|n|s|gpa|db|m_per_s2?|n_per_m|ns_per_m|nm_per_rad|nms_per_rad|pa_s|kg_per_m3|rms_m_per_s2|mv_per_m_per_s2|mv|px)$/,
      "",
    )
    .replaceAll("_", " ");
  if (words.startsWith("mm per")) return `Millimetres ${words.slice(3)}`;
  return words.charAt(0).toUpperCase() + words.slice(1);
}

/** What is allowed, in words. @param {any} s */
function allowed(s) {
  const low = s.exclusiveMinimum !== undefined ? `> ${s.exclusiveMinimum}` : s.minimum !== undefined ? `≥ ${s.minimum}` : "";
  const high = s.exclusiveMaximum !== undefined ? `< ${s.exclusiveMaximum}` : s.maximum !== undefined ? `≤ ${s.maximum}` : "";
  const range = [low, high].filter(Boolean).join(" and ");
  const start = s.default !== undefined && typeof s.default !== "object" ? `default ${s.default}` : "";
  const parts = [range && `allowed ${range}`, start].filter(Boolean);
  return parts.length ? ` (${parts.join(", ")})` : "";
}

/**
 * The field of a key.
 * @param {any} schema of the whole scenario
 * @param {Path} path
 * @param {Partial<Spec>} [own]
 * @returns {Spec}
 */
export function spec(schema, path, own = {}) {
  const s = schemaAt(schema, path) ?? {},
    key = String(path.at(-1)),
    options = s.oneOf?.filter((/** @type {any} */ o) => o.const !== undefined);
  // A quantity may also be a text with its unit ("0.3 kN"): its field is that of the number.
  const types = [s.type ?? s.oneOf?.map((/** @type {any} */ o) => o.type)].flat(2),
    plain = types.includes("number") || types.includes("integer");
  const kind = plain ? "number" : options?.length && options.length === s.oneOf.length ? "choice" : s.type === "boolean" ? "flag" : "text";
  /** @type {Spec} */
  const made = {
    path,
    kind,
    label: named(key),
    unit: spelled(s["x-unit"] ?? ""),
    note: spelled((s.description ?? "").replace(/ \([^()]*\)(?=;|$)/, "")) + allowed(s),
    integer: s.type === "integer",
    united: plain && types.includes("string"),
    words: s.type === "string",
    fallback: s.default,
    min: s.minimum ?? s.exclusiveMinimum,
    max: s.maximum ?? s.exclusiveMaximum,
    log: s.exclusiveMinimum === 0,
    options: options?.map((/** @type {any} */ o) => [o.const, `${o.const}: ${o.description}`]),
    required: schemaAt(schema, path.slice(0, -1))?.required?.includes(key),
    read: (tree) => get(tree, path),
    write: (tree, value) => set(tree, path, value),
  };
  return { ...made, ...own };
}

const RAD = Math.PI / 180;

/** The load, where both parts are numbers; a text with its unit is known only as the engine read it. @param {any} tree @returns {[number, number] | undefined} */
function load(tree) {
  const stated = tree?.operation?.load_n ?? [0, 0];
  return stated.every((/** @type {any} */ v) => typeof v === "number") ? stated : undefined;
}
/** Where a load acts that is 0: its two parts do not tell. Radians. */
let idle = 0;
/** Another bearing has its own load. */
export const forgetAngle = () => {
  idle = 0;
};
/** @param {[number, number]} f */
const angle = (f) => (f[0] || f[1] ? Math.atan2(f[1], f[0]) : idle);
/** @param {number} v */
const tidy = (v) => Number(v.toPrecision(7));
/** @param {[number, number]} f */
const size = (f) => tidy(Math.hypot(...f));

/** Another load or direction; what is null stays. @param {any} tree @param {any} all @param {number | null} force @param {number | null} turn */
export function putLoad(tree, all, force, turn) {
  const before = load(tree) ?? load(all) ?? [0, 0],
    f = force ?? size(before),
    a = turn ?? angle(before);
  idle = a;
  set(
    tree,
    ["operation", "load_n"],
    [f * Math.cos(a), f * Math.sin(a)].map((v) => (Math.abs(v) < 1e-9 * f ? 0 : tidy(v))),
  );
}

/** The controls that are always shown. @param {any} schema @returns {Spec[]} */
export function mainSpecs(schema) {
  const read = (/** @type {any} */ tree, /** @type {(f: [number, number]) => number} */ part) => {
    const known = load(tree);
    return known && part(known);
  };
  const only = (/** @type {any} */ v) => (typeof v === "object" ? undefined : v);
  /** @type {Path} */
  const speed = ["operation", "speed_rpm"],
    loads = /** @type {Path} */ (["operation", "load_n"]);
  return [
    spec(schema, speed, {
      label: "Speed",
      span: [60, 6000],
      log: false,
      read: (t) => only(get(t, speed)),
      other: (t) => only(get(t, speed)) ?? `varies: ${get(t, speed)?.length} points`,
    }),
    spec(schema, loads, {
      label: "Load",
      kind: "number",
      units: { N: 1, kN: 1000, lbf: 4.4482216152605 },
      span: [1, 5000],
      log: true,
      min: 0,
      read: (t) => read(t, size),
      write: (t, v, all) => putLoad(t, all, v, null),
      refuse: (v) => (v === undefined ? "a load is missing" : v < 0 ? "a load is 0 or more; Load at angle turns it" : ""),
    }),
    spec(schema, loads, {
      label: "Load at angle",
      kind: "number",
      unit: "°",
      units: { "°": 1, deg: 1, rad: 1 / RAD },
      span: [-180, 180],
      note: "direction from the bearing's centre to the middle of the load zone, counter-clockwise from +x",
      read: (t) => read(t, (f) => Number((angle(f) / RAD).toFixed(2))),
      write: (t, v, all) => putLoad(t, all, null, v * RAD),
      refuse: (v) => (v === undefined ? "an angle is missing" : ""),
    }),
    spec(schema, ["bearing", "radial_clearance_um"], { label: "Clearance", span: [-5, 50], log: false }),
    spec(schema, ["contact", "damping_time_us"], { label: "Contact damping", span: [0.25, 25], log: true }),
    spec(schema, ["sensor", "noise_rms_m_per_s2"], { label: "Noise, RMS", span: [0, 50], log: false, fallback: 0 }),
    spec(schema, ["simulation", "accuracy"], { label: "Accuracy" }),
  ];
}

/** All other keys, by section. @param {any} schema @returns {{name: string, note: string, specs: Spec[]}[]} */
export function moreSpecs(schema) {
  const shown = new Set(mainSpecs(schema).map((s) => s.path.join(".")));
  const all = Object.entries(schema.properties ?? {}),
    sections = all.filter(([name, s]) => s.type === "object" && name !== "provenance");
  const alone = all.filter(([, s]) => s.type === "string").map(([key]) => spec(schema, [key]));
  return [
    { name: "scenario", note: "", specs: alone },
    ...sections.map(([name, s]) => ({
      name,
      note: s.description ?? "",
      specs: Object.keys(s.properties ?? {})
        .filter((key) => !shown.has(`${name}.${key}`))
        .map((key) => spec(schema, [name, key])),
    })),
  ];
}

/** Fields of a defect of the scenario, as far as numbers say it. @param {any} schema @param {any} defect @param {number} index @returns {Spec[]} */
export function defectSpecs(schema, defect, index) {
  const at = (/** @type {Path} */ path) => /** @type {Path} */ (["defects", index, ...path]);
  const shape = Object.keys(defect?.shape ?? {})[0];
  // A depth map states its own depths.
  const list = shape === "depth_map" ? [] : [spec(schema, at(["depth_um"]), { label: "Depth", span: [0.5, 200], log: true })];
  if (shape === "rectangle")
    list.push(
      spec(schema, at(["shape", "rectangle", "length_mm"]), { label: "Length", span: [0.1, 12], log: true }),
      spec(schema, at(["shape", "rectangle", "width_mm"]), { label: "Width", span: [0.1, 12], log: true }),
    );
  if (shape === "circle")
    list.push(spec(schema, at(["shape", "circle", "diameter_mm"]), { label: "Diameter", span: [0.05, 12], log: true }));
  if (shape === "li2023_irregular")
    list.push(spec(schema, at(["shape", "li2023_irregular", "max_width_mm"]), { label: "Width", span: [0.1, 12], log: true }));
  list.push(
    spec(schema, at(["center_deg"]), {
      label: "At",
      span: [-180, 180],
      log: false,
      write: (t, v) =>
        set(t, at(["center_deg"]), typeof v === "number" ? tidy(Math.abs(v) > 180 ? v - 360 * Math.ceil((v - 180) / 360) : v) : v),
    }),
  );
  list.push(spec(schema, at(["axial_offset_mm"]), { label: "Axial", span: [-10, 10], log: false }));
  if (defect?.on === "roller") list.push(spec(schema, at(["roller"]), { label: "Roller" }));
  return list;
}

/** Options of a file that becomes a shape. @param {any} schema @param {"image" | "svg" | "depth_map"} shape @returns {Spec[]} */
export function fileSpecs(schema, shape) {
  const base = /** @type {Path} */ (["defects", 0, "shape", shape]),
    keys = Object.keys(schemaAt(schema, base)?.properties ?? {});
  const written = new Set(["file", "columns", "rows", "s0_mm", "z0_mm", "depth_um"]);
  const labels = /** @type {Record<string, string>} */ ({
    ds_mm: "Point spacing around",
    dz_mm: "Point spacing along the axis",
  });
  return keys
    .filter((key) => !written.has(key))
    .map((key) => {
      // The dialog always has a file.
      const made = spec(schema, [...base, key], {
        read: (t) => t?.[key],
        write: (t, v) => set(t, [key], v),
        required: true,
      });
      return {
        ...made,
        label: labels[key] ?? made.label,
        note: made.note.replace(/; (where|required where) there is (a|no) `file`, and only there/g, ""),
      };
    });
}
