// Chromium as it is installed, the page served as static files, and a page that keeps account of what it asks for and complains of.
import assert from "node:assert/strict";
import { existsSync, readFileSync } from "node:fs";
import { createServer } from "node:http";
import { extname, join, resolve } from "node:path";
import { buffer } from "node:stream/consumers";
import { chromium } from "playwright-core";
import { hosted } from "../host.js";
import { until } from "./page.js";

const PLACES = [
  "/usr/bin/chromium",
  "/usr/bin/chromium-browser",
  "/usr/bin/google-chrome",
  "/Applications/Chromium.app/Contents/MacOS/Chromium",
];
const ROOT = resolve(import.meta.dirname, "..");
const TYPES = {
  ".html": "text/html",
  ".js": "text/javascript",
  ".mjs": "text/javascript",
  ".css": "text/css",
  ".wasm": "application/wasm",
};
/** The engine's module. */
export const WASM = process.env.STUDIO_WASM || resolve(ROOT, "../../target/studio/studio.wasm");
if (!existsSync(WASM)) throw new Error(`no ${WASM}; .ci/studio makes it`);

export async function launch() {
  const executablePath = process.env.CHROMIUM || PLACES.find(existsSync);
  if (!executablePath) throw new Error(`no Chromium at ${PLACES.join(", ")}; CHROMIUM names another`);
  return chromium.launch({
    executablePath,
    headless: true,
    chromiumSandbox: false,
    args: [
      "--disable-gpu",
      "--disable-quic",
      "--no-first-run",
      "--disable-background-networking",
      "--disable-component-update",
      "--disable-sync",
    ],
  });
}

// Serves the page with the engine's module beside index.html, and the engine itself as `brinell studio` would.
export async function serve() {
  let engine;
  const server = createServer(async (request, response) => {
    const { pathname, searchParams } = new URL(request.url, "http://localhost");
    if (request.method === "POST") {
      if (pathname !== "/ask" || searchParams.get("token") !== "secret") return response.writeHead(403).end();
      if (searchParams.has("closed")) return response.end();
      const bytes = await buffer(request);
      engine ??= WebAssembly.compile(readFileSync(WASM)).then(hosted);
      return response.end((await engine).answer(bytes));
    }
    const file = pathname === "/studio.wasm" ? WASM : join(ROOT, pathname === "/" ? "index.html" : pathname);
    if (!existsSync(file)) return response.writeHead(404).end();
    response.writeHead(200, { "Content-Type": TYPES[extname(file)] ?? "text/plain" }).end(readFileSync(file));
  });
  await new Promise((done) => server.listen(0, "127.0.0.1", done));
  return { url: `http://127.0.0.1:${server.address().port}/`, close: () => server.close() };
}

// Opens the page in a window of its own. `asked` and `said` fill as it lives.
export async function open(browser, url, { width = 1400, height = 900, before, ...options } = {}) {
  const context = await browser.newContext({ viewport: { width, height }, acceptDownloads: true, ...options });
  const page = await context.newPage();
  page.asked = [];
  page.said = [];
  page.on("request", (request) => page.asked.push(request.url()));
  page.on("console", (message) => page.said.push(`${message.type()}: ${message.text()}`));
  page.on("pageerror", (error) => page.said.push(`error: ${error.message}`));
  if (before) await page.addInitScript(before);
  await page.goto(url, { waitUntil: "load" });
  return page;
}

// The page runs a bearing and has shown some of it.
export async function running(page) {
  await page.waitForFunction(() => globalThis.brinellStudio?.side?.spectra, null, { timeout: 90000 });
}

/** A window whose page remembers an example. @param {string} url @param {string} name */
function remembering(url, name) {
  const value = readFileSync(resolve(ROOT, `../brinell-studio/examples/${name}.toml`), "utf8");
  return { cookies: [], origins: [{ origin: new URL(url).origin, localStorage: [{ name: "brinell-studio", value }] }] };
}

// Runs `look` on the page in a window of its own, and holds the page to silence and to itself. With an `example` the page begins with that and without the healthy bearing behind,
// which takes as long as half a run, and `look` begins as soon as it is open; else the page begins as for anybody, and has shown curves.
export async function quietly(browser, url, { example, ...options }, look) {
  const page = await open(browser, url, example ? { ...options, storageState: remembering(url, example) } : options);
  try {
    if (example) {
      await until(page, () => globalThis.brinellStudio?.side?.live.opened);
      await page.evaluate(() => {
        globalThis.brinellStudio.healthy.free = () => false;
      });
    } else await running(page);
    await look(page);
    assert.deepEqual(page.said, []);
    const home = new URL(url).origin;
    assert.deepEqual(
      page.asked.filter(
        (u) =>
          !(url.startsWith("http") && u.startsWith(home)) &&
          u.split("#")[0] !== url.split("#")[0] &&
          !u.startsWith("data:") &&
          !u.startsWith("blob:"),
      ),
      [],
    );
  } finally {
    await page.context().close();
  }
}
