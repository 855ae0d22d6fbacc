// What a file is opened as.
import { byId } from "./dom.js";
import { bytesOf, chosenKind, kindsOf, shapeOf } from "./files.js";
import { judged, showMeasured } from "./measured.js";
import { notice } from "./notices.js";

/**
 * Opens what was dropped or chosen: a scenario, damage, or a measured signal.
 * @param {File} file
 * @param {import("./studio.js").Studio} studio
 */
export async function openFile(file, studio) {
  notice("failed", null);
  const kind = await chosenKind(file.name, kindsOf(file.name)),
    ask = (/** @type {any} */ request) => studio.side.live.ask(request);
  if (!kind) return;
  const bytes = await bytesOf(file);
  if (kind === "toml") return studio.load(new TextDecoder().decode(bytes), false, file.name);
  if (kind !== "signal") {
    const there = studio.side.store.scenario.defects?.length ?? 0,
      got = await shapeOf(ask, studio.about.schema, /** @type {any} */ (kind), file.name, bytes, there);
    if (got) studio.panel.place(got.shape, got.alone);
    return;
  }
  const { scenario, toml } = studio.side.opened,
    own = { name: scenario.bearing?.preset ?? "", toml };
  /** @type {any} */
  let found = null;
  const beside = (/** @type {boolean} */ on) => {
    studio.measured = on ? found : null;
    studio.dirty.add("curves");
  };
  // A verdict on another file is not left beside what went wrong with this one.
  const close = () => {
    beside(false);
    byId("measured").hidden = true;
  };
  try {
    found = await judged(ask, file.name, bytes, studio.about.known, own, close);
  } catch (error) {
    close();
    throw error;
  }
  if (found) showMeasured(found, file.name, { beside, close, simulated: studio.side.opened.unit });
}
