// The list of examples and bearings to begin with. Load takes what is chosen: arrow keys go along the list and change nothing.
import { short } from "./chart.js";
import { byId, h, places } from "./dom.js";
import { notice } from "./notices.js";
import { putLoad } from "./schema.js";

/**
 * @typedef {object} Owner
 * @property {() => import("./side.js").Side} side
 * @property {(toml: string) => void} load
 * @property {(error: unknown) => void} failed
 */

/** @param {any} about @param {Owner} owner */
export function startList(about, { side, load, failed }) {
  const select = byId("preset");
  const group = (/** @type {string} */ label, /** @type {any[]} */ list, /** @type {string} */ kind) =>
    h("optgroup", { label }, ...list.map((one) => h("option", { value: `${kind}:${one.name}`, title: one.words }, one.name)));
  const sorted = [...about.bearings].sort((a, b) => a.name.localeCompare(b.name, "en", { numeric: true })),
    bearings = (/** @type {string} */ label, /** @type {string} */ element) =>
      group(
        label,
        sorted.filter((b) => b.element === element),
        "bearing",
      );
  select.append(group("Examples", about.examples, "example"), bearings("Ball bearings", "ball"), bearings("Roller bearings", "roller"));
  byId("load").addEventListener("click", () => {
    const [kind, name] = select.value.split(/:(.*)/);
    // It names nothing that an edit or undo makes wrong, and the same may be chosen again.
    select.value = "";
    if (kind === "example")
      void side()
        .live.urgent({ do: "example", name })
        .then(({ toml }) => load(toml), failed);
    else if (kind === "bearing")
      put(
        side(),
        about,
        about.bearings.find((/** @type {any} */ b) => b.name === name),
      );
    else select.focus();
  });
}

/**
 * What the preset fills is not stated any more. The load becomes one that fits the bearing, in its direction, and the bearing's name takes the place
 * of an example's or of another bearing's; all else stays, damage too, which is said.
 * @param {import("./side.js").Side} side @param {any} about @param {any} bearing
 */
function put({ store, opened }, about, { name, load_n }) {
  store.change((s) => {
    for (const key of ["cage", "contact", "friction"]) delete s[key];
    s.bearing = { preset: name };
    putLoad(s, opened?.all, load_n, null);
    if (!s.name || [...about.examples, ...about.bearings].some((one) => one.name === s.name)) s.name = name;
  });
  store.seal();
  const count = store.scenario.defects?.length ?? 0,
    load = `${name} under ${short(load_n)} N, a tenth of its static load rating.`;
  if (!count) return notice("kept", load);
  notice("kept", `${load} It has the damage that was drawn before: ${places(count)}, at the same angles and of the same size.`, {
    actions: [
      [
        "Remove the damage",
        () => {
          store.change((s) => {
            s.defects = [];
          });
          store.seal();
        },
      ],
    ],
  });
}
