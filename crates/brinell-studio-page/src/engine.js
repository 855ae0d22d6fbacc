// What answers the page: a Worker with WebAssembly, or the server of `brinell studio`.
import { assets } from "./assets.js";
import { ServerEngine } from "./server-engine.js";
import { WorkerEngine } from "./worker-engine.js";

/** @typedef {import("./answers.js").Engine} Engine */

/** The address has the token of a server, `brinell studio`. */
export const hasToken = () => new URLSearchParams(location.search).has("token");

/**
 * Starts engines. A server has one for all bearings, told apart by their slots; each Worker is an engine of its own.
 * @returns {Promise<() => Promise<Engine>>}
 */
export async function engines() {
  // A page around this one may bring its own: a notebook, its kernel.
  const given = /** @type {{brinellEngine?: () => Promise<Engine>}} */ (globalThis).brinellEngine;
  if (given) return given;
  if (document.documentElement.dataset.engine === "server" || hasToken()) {
    const server = new ServerEngine();
    return async () => server;
  }
  const parts = await assets();
  return async () => new WorkerEngine(parts);
}
