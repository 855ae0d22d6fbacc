// What the packer stored in the page when it was built: what the engine says of itself, and one run to show until the engine is there.
import { inflated } from "./assets.js";
import { decode } from "./message.js";
import { Trace } from "./trace.js";

/**
 * In place of a bearing that runs, for the curves alone.
 * @typedef {{opened: any, live: {state: string}, trace: Trace, spectra: any, damage: any[], stored: true}} Still
 */

/** @returns {Promise<{about: any, toml: string, opened: any, damage: any[], moments: any, headline: string, still: Still} | null>} null: the page has none */
export async function storedRun() {
  const node = document.getElementById("studio-stored");
  if (!node) return null;
  const held = decode(new Uint8Array(await (await inflated(node.textContent ?? "")).arrayBuffer())),
    trace = new Trace();
  trace.push(held.first, held.x);
  const { opened, damage, spectra } = held;
  return { ...held, still: { opened, live: { state: "stored" }, trace, spectra, damage, stored: true } };
}
