// The page as it is packed, and as it is served, in Chromium, for its tests. STUDIO_WASM names the engine's module.
import { execFileSync } from "node:child_process";
import { mkdtemp, rm } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { after, before } from "node:test";
import { pathToFileURL } from "node:url";
import { WASM, quietly } from "./browser.js";
import { browser, server } from "./served.js";

export const ROOT = resolve(import.meta.dirname, "..");
export let folder, file;
export { browser, server };

before(async () => {
  folder = await mkdtemp(join(tmpdir(), "brinell-studio-"));
  execFileSync(process.execPath, [join(ROOT, "pack.mjs"), "--wasm", WASM, "-o", folder]);
  file = pathToFileURL(join(folder, "brinell-studio.html")).href;
});
after(async () => {
  if (folder) await rm(folder, { recursive: true });
});

export const on = (options, look) => quietly(browser, server.url, options, look);
