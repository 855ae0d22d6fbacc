// Holds the engine as WebAssembly and passes bytes: a request in, its answer out, in order.
"use strict";
(() => {
  /** @typedef {{memory: WebAssembly.Memory, give: (n: number) => number, ask: () => number, release: () => void}} Exports */
  /** @type {{postMessage: (message: unknown, transfer?: Transferable[]) => void, onmessage: ((event: MessageEvent) => void) | null}} */
  const port = /** @type {any} */ (self);
  /** @type {Promise<Exports> | null} */
  let engine = null;

  /** @param {Exports} wasm @param {Uint8Array} request */
  function answer(wasm, request) {
    const at = wasm.give(request.length) >>> 0;
    new Uint8Array(wasm.memory.buffer, at, request.length).set(request);
    const out = wasm.ask() >>> 0;
    // The memory may have grown, so it is looked at anew.
    const length = new DataView(wasm.memory.buffer).getUint32(out, true);
    const bytes = new Uint8Array(wasm.memory.buffer).slice(out + 4, out + 4 + length);
    wasm.release();
    return bytes;
  }

  port.onmessage = async ({ data }) => {
    if (data.module) {
      engine = WebAssembly.instantiate(/** @type {WebAssembly.Module} */ (data.module), {}).then(
        (instance) => /** @type {any} */ (instance.exports),
      );
      engine.catch(() => {});
      return;
    }
    try {
      if (!engine) throw new Error("asked before it had an engine");
      const bytes = answer(await engine, data.bytes);
      port.postMessage({ id: data.id, bytes }, [bytes.buffer]);
    } catch (error) {
      port.postMessage({ id: data.id, trap: String(error) });
    }
  };
})();
