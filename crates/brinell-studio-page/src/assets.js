// Finds the engine's WebAssembly and the Worker's script: within the page where it was packed into one file, else beside it.

/** @typedef {{module: WebAssembly.Module, worker: string | URL}} Assets */

/** The browser has no WebAssembly, or not the vector instructions that the engine is made of. */
export class NoWasm extends Error {}

// A module whose one function does an i8x16.splat.
const SIMD = new Uint8Array([
  0, 97, 115, 109, 1, 0, 0, 0, 1, 5, 1, 96, 0, 1, 123, 3, 2, 1, 0, 10, 10, 1, 8, 0, 65, 0, 253, 15, 253, 98, 11,
]);

/** Bytes that are gzip in base64. @param {string} text */
export async function inflated(text) {
  const bytes = Uint8Array.from(atob(text.trim()), (c) => c.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Response(stream, { headers: { "Content-Type": "application/wasm" } });
}

/** @param {Response | Promise<Response>} response */
async function compiled(response) {
  const got = await response;
  if (!got.ok)
    throw new Error(
      `this page has no engine beside it (${got.url}: ${got.status}). An address of \`brinell studio\` needs its token: take it whole, as the command prints it`,
    );
  if (got.headers.get("Content-Type")?.startsWith("application/wasm")) return WebAssembly.compileStreaming(got);
  return WebAssembly.compile(await got.arrayBuffer());
}

/** @returns {Promise<Assets>} */
export async function assets() {
  if (typeof WebAssembly !== "object" || !WebAssembly.validate(SIMD))
    throw new NoWasm("this browser cannot run the engine: it lacks WebAssembly with vector instructions (simd128)");
  const wasm = document.getElementById("studio-wasm"),
    worker = document.getElementById("studio-worker");
  if (wasm && worker) {
    const script = URL.createObjectURL(new Blob([worker.textContent ?? ""], { type: "text/javascript" }));
    return { module: await compiled(inflated(wasm.textContent ?? "")), worker: script };
  }
  return {
    module: await compiled(fetch(new URL("../studio.wasm", import.meta.url))),
    worker: new URL("worker.js", import.meta.url),
  };
}
