// The engine's module in node, for the packer and the tests, as src/worker.js holds it in a browser.
import { decode, encode } from "./src/message.js";

/** A fresh engine. @param {WebAssembly.Module} module */
export async function hosted(module) {
  const wasm = /** @type {any} */ ((await WebAssembly.instantiate(module, {})).exports);

  /** The bytes of a request to those of its answer. @param {Uint8Array} bytes */
  function answer(bytes) {
    const at = wasm.give(bytes.length) >>> 0;
    new Uint8Array(wasm.memory.buffer, at, bytes.length).set(bytes);
    const out = wasm.ask() >>> 0,
      length = new DataView(wasm.memory.buffer).getUint32(out, true);
    const answer = new Uint8Array(wasm.memory.buffer).slice(out + 4, out + 4 + length);
    wasm.release();
    return answer;
  }

  /** @param {Record<string, unknown>} request @returns {any} */
  function ask(request) {
    const { ok, ...got } = decode(answer(encode(request)));
    if (!ok) throw new Error(`the engine refused ${request.do}: ${JSON.stringify(got.problems)}`);
    return got;
  }
  return { answer, ask, size: () => wasm.memory.buffer.byteLength };
}
