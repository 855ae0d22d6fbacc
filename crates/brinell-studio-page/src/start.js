// The list of examples and bearings to begin with. Load takes what is chosen: arrow keys go along the list and change nothing.
import { byId, h } from "./dom.js";
import { notice } from "./readout.js";

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
    else if (kind === "bearing") put(side().store, name);
    else select.focus();
  });
}

/** What the preset fills is not stated any more; operation and damage stay, which is said. @param {import("./state.js").Store} store @param {string} name */
function put(store, name) {
  store.change((s) => {
    for (const key of ["cage", "contact", "friction"]) delete s[key];
    s.bearing = { preset: name };
  });
  store.seal();
  const count = store.scenario.defects?.length ?? 0;
  if (!count) return notice("kept", null);
  notice(
    "kept",
    `${name} has the damage that was drawn before: ${count} ${count === 1 ? "place" : "places"}, at the same angles and of the same size.`,
    {
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
    },
  );
}
