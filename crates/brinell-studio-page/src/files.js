// Files in and out: scenarios, pictures and scans of damage, measured signals; saving and sharing.
import { Refused } from "./answers.js";
import { Field } from "./controls.js";
import { short } from "./chart.js";
import { byId, h, places } from "./dom.js";
import { hasToken } from "./engine.js";
import { asked, line } from "./measured.js";
import { notice } from "./notices.js";
import { Photo } from "./photo.js";
import { fileSpecs } from "./schema.js";
import { LINK_LIMIT, pathOf, toLink } from "./state.js";

const LARGEST = 1 << 28;
const ADD = "Add to the damage",
  ALONE = "Replace the damage";
const KINDS = /** @type {const} */ ({ photo: "image", svg: "svg", depth: "depth_map" });
const SHOWN = new Set([
  "mm_per_pixel",
  "mm_per_unit",
  "ds_mm",
  "dz_mm",
  "unit",
  "threshold",
  "threshold_um",
  "rolling_direction",
  "invert",
  "remove_form",
  "fill",
]);

/** @param {Blob} blob @param {string} name */
export function download(blob, name) {
  const link = h("a", { href: URL.createObjectURL(blob), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

/** What a file may be, by its name. @param {string} name @returns {("toml" | "photo" | "svg" | "depth" | "signal")[]} */
export function kindsOf(name) {
  const end = name.toLowerCase().split(".").at(-1) ?? "";
  if (end === "toml") return ["toml"];
  if (end === "svg") return ["svg"];
  if (end === "png") return ["photo", "depth"];
  if (["jpg", "jpeg"].includes(end)) return ["photo"];
  if (["csv", "npy", "txt"].includes(end)) return ["depth", "signal"];
  return ["signal"];
}

/** @param {string} name @param {string[]} kinds */
export async function chosenKind(name, kinds) {
  if (kinds.length === 1) return kinds[0];
  const words = /** @type {Record<string, string>} */ ({
    photo: "a photo of damage",
    depth: "a depth map of damage",
    signal: "a measured signal",
  });
  const select = h("select", {}, ...kinds.map((k) => h("option", { value: k }, words[k])));
  return (await asked(name, [line("This file is", select, "", "")], "Open")) ? select.value : null;
}

/** @param {File} file */
export async function bytesOf(file) {
  if (file.size > LARGEST) throw new Error(`${file.name}: ${short(file.size / (1 << 20))} MiB is more than the page can hold`);
  return new Uint8Array(await file.arrayBuffer());
}

/** The outline as a picture, in its own millimetres. @param {any} shape */
function preview(shape) {
  const polygons = shape?.outline?.polygons_mm ?? (shape?.outline?.points_mm ? [shape.outline.points_mm] : []);
  if (!polygons.length) return null;
  const points = polygons.flat(),
    s = points.map((/** @type {number[]} */ p) => p[0]),
    z = points.map((/** @type {number[]} */ p) => -p[1]);
  const low = (/** @type {number[]} */ list) => list.reduce((a, b) => Math.min(a, b)),
    high = (/** @type {number[]} */ list) => list.reduce((a, b) => Math.max(a, b));
  const [l, t, w, v] = [low(s), low(z), high(s) - low(s), high(z) - low(z)];
  const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg"),
    path = document.createElementNS("http://www.w3.org/2000/svg", "path");
  svg.setAttribute("viewBox", `${l - 0.1 * w} ${t - 0.1 * v} ${1.2 * w} ${1.2 * v}`);
  svg.setAttribute("class", "preview");
  svg.setAttribute("role", "img");
  svg.setAttribute("aria-label", "The outline that was found");
  path.setAttribute("d", polygons.map((/** @type {number[][]} */ p) => `M${p.map(([a, b]) => `${a} ${-b}`).join("L")}Z`).join(""));
  svg.append(path);
  return svg;
}

/**
 * A photo, drawing or scan to a shape: asks for its scale and direction, shows what the engine makes of it.
 * @param {(request: Record<string, unknown>) => Promise<any>} ask
 * @param {any} schema
 * @param {"photo" | "svg" | "depth"} kind
 * @param {string} name
 * @param {Uint8Array<ArrayBuffer>} bytes
 * @param {number} there  damaged places that the bearing has already
 * @returns {Promise<{shape: any, alone: boolean} | null>}  alone: in the place of what is there
 */
export async function shapeOf(ask, schema, kind, name, bytes, there) {
  /** @type {Record<string, any>} */
  const options = {};
  const photo = kind === "photo" ? new Photo(bytes) : null;
  let got = /** @type {any} */ (null),
    turn = 0,
    agreed = "";
  /** Keys that were filled in: only of these, or once all is agreed to, a problem is an error; before, it is what is still needed. */
  const filled = new Set();
  const told = h("div", { role: "status" }),
    trouble = h("p", { className: "trouble", role: "alert" });
  const look = async () => {
    const mine = ++turn;
    try {
      const answer = await ask({ do: "outline", kind, bytes, name, options });
      if (mine !== turn) return;
      got = answer;
      trouble.textContent = "";
      photo?.outline(answer.rings_px);
      told.replaceChildren(
        ...[
          photo ? null : preview(answer.shape),
          h("p", {}, `${short(answer.length_mm, 4)} mm long, ${short(answer.width_mm, 4)} mm wide, ${short(answer.area_mm2, 4)} mm²`),
          ...(answer.notes ?? []).map((/** @type {string} */ n) => h("p", { className: "note" }, n)),
        ].filter((n) => n !== null),
      );
    } catch (error) {
      if (mine !== turn) return;
      got = null;
      photo?.outline([]);
      // The engine reads it as the first damage of a scenario of its own.
      const problems =
        error instanceof Refused
          ? error.problems.map((p) => ({
              ...p,
              message: p.message.replace(/^defects\.0\.shape\.\w+\.(\w+)(.*?) \(defect 1\)/, "$1$2"),
            }))
          : [{ key: null, message: String(error) }];
      const open = (/** @type {{key: string | null}} */ p) => !agreed && p.key !== null && !filled.has(String(pathOf(p.key).at(-1)));
      told.replaceChildren(...problems.filter(open).map((p) => h("p", { className: "note" }, `Still needed: ${p.message}`)));
      trouble.textContent = problems
        .filter((p) => !open(p))
        .map((p) => p.message)
        .join(" ");
    }
  };
  const taken = (/** @type {import("./schema.js").Spec} */ spec, /** @type {any} */ value) => {
    const key = String(spec.path.at(-1));
    spec.write(options, value);
    // One scale at a time: the one that was given last.
    if (photo && key === "mm_per_pixel") {
      delete options.scale_bar;
      photo.clear();
    }
    filled.add(key);
    look();
  };
  // Two clicks on the photo are its scale bar.
  const specs = fileSpecs(schema, KINDS[kind]).filter((s) => s.path.at(-1) !== "scale_bar");
  const fields = specs.map((s) => new Field(s, taken, { range: false }));
  const first = fields.filter((f) => SHOWN.has(String(f.spec.path.at(-1)))),
    rest = fields.filter((f) => !first.includes(f));
  for (const field of fields) field.update(options, {});
  look();
  if (photo)
    photo.marked = (bar) => {
      const { mm_per_pixel: _, ...others } = options;
      for (const key of Object.keys(options)) delete options[key];
      Object.assign(options, others, { scale_bar: bar });
      filled.add("scale_bar").add("mm_per_pixel").add("px").add("mm");
      for (const field of fields) field.update(options, { mm_per_pixel: Number((bar.mm / bar.px).toPrecision(4)) });
      look();
    };
  const more = h("details", {}, h("summary", {}, "More"), ...rest.map((f) => f.element)),
    already = there ? h("p", {}, `The bearing is damaged already: ${places(there)}.`) : null,
    keys = [told, trouble, photo?.scale ?? null, ...first.map((f) => f.element), more].filter((n) => n !== null),
    body = photo ? [h("div", { className: "beside" }, photo.element, h("div", {}, ...keys)), already] : [...keys, already],
    answers = there ? [ADD, ALONE] : ["Place on the raceway"];
  try {
    for (;;) {
      agreed = await asked(`${name}: damage`, body, ...answers);
      if (!agreed) return null;
      // What was typed last is looked at too; what is refused is shown again with the reason.
      await look();
      if (got) return { shape: got.shape, alone: agreed === ALONE };
    }
  } finally {
    turn++;
    photo?.close();
  }
}

/** Files dropped anywhere on the page. @param {(files: File[]) => void} take */
export function droppable(take) {
  const body = document.body;
  const files = (/** @type {DragEvent} */ e) => e.dataTransfer?.types.includes("Files");
  body.addEventListener("dragover", (e) => {
    if (!files(e)) return;
    e.preventDefault();
    body.classList.add("drop");
  });
  body.addEventListener("dragleave", (e) => {
    if (!e.relatedTarget) body.classList.remove("drop");
  });
  body.addEventListener("drop", (e) => {
    body.classList.remove("drop");
    if (!files(e)) return;
    e.preventDefault();
    take([...(e.dataTransfer?.files ?? [])]);
  });
}

/** Pictures of the views. @param {any[]} views @param {string} name @param {"svg" | "png"} format */
export async function savePictures(views, name, format) {
  for (const view of views) {
    if (!view?.toSVG) continue;
    try {
      const file = `${name}-${view.kind ?? view.localName.replace("brinell-", "")}.${format}`;
      download(format === "svg" ? new Blob([await view.toSVG()], { type: "image/svg+xml" }) : await view.toPNG(), file);
    } catch {
      // A view without data has no picture.
    }
  }
}

/** The Save menu. @param {[string, () => void][]} items @param {string} note */
export function saveMenu(items, note) {
  const button = byId("save"),
    list = byId("save-list");
  const close = () => {
    list.hidden = true;
    button.setAttribute("aria-expanded", "false");
  };
  list.replaceChildren(
    ...items.map(([text, act]) =>
      h(
        "button",
        {
          type: "button",
          onclick: () => {
            close();
            act();
          },
        },
        text,
      ),
    ),
    h("p", { className: "note" }, note),
  );
  button.onclick = () => {
    list.hidden = !list.hidden;
    button.setAttribute("aria-expanded", String(!list.hidden));
    if (!list.hidden) list.querySelector("button")?.focus();
  };
  list.addEventListener("keydown", (/** @type {KeyboardEvent} */ e) => {
    const all = [...list.querySelectorAll("button")],
      at = all.indexOf(/** @type {HTMLButtonElement} */ (document.activeElement));
    if (e.key === "Escape") {
      close();
      button.focus();
    } else if (e.key === "ArrowDown") all[(at + 1) % all.length].focus();
    else if (e.key === "ArrowUp") all[(at + all.length - 1) % all.length].focus();
  });
  document.addEventListener("pointerdown", (e) => {
    if (!list.contains(/** @type {Node} */ (e.target)) && e.target !== button) close();
  });
}

/** A link that carries a scenario, into the address and the clipboard. @param {string} toml @param {() => void} save  where it is too long for a link */
export async function share(toml, save) {
  const link = await toLink(toml);
  if (link.length > LINK_LIMIT)
    return notice("link", `The link would have ${link.length} characters, which many programs cut. Share the file instead.`, {
      actions: [["Save the scenario", save]],
    });
  history.replaceState(null, "", link);
  const address = location.href,
    field = h("input", { type: "text", readOnly: true, value: address, "aria-label": "Link to this bearing" });
  const whose = hasToken()
    ? " It opens on this machine while this server runs. In another studio it opens with the part from # on behind that studio's address."
    : "";
  let words = `A link to this bearing.${whose}`;
  try {
    await navigator.clipboard.writeText(address);
    words = `The link to this bearing is copied.${whose}`;
  } catch {
    // The browser does not let the page write there: the link can be taken from the field.
  }
  notice("link", h("p", {}, words));
  document.querySelector('[data-kind="link"] p')?.after(field);
  field.select();
}
