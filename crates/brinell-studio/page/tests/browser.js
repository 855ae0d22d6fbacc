// Chromium as it is installed, the page served as static files, and a page that keeps account of what it asks for and complains of.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync, readFileSync } from "node:fs";
import { createServer } from "node:http";
import { createContext, runInContext } from "node:vm";
import { extname, join, resolve } from "node:path";
import { chromium } from "playwright-core";

const PLACES = ["/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome", "/Applications/Chromium.app/Contents/MacOS/Chromium"];
const ROOT = resolve(import.meta.dirname, "..");
const TYPES = { ".html": "text/html", ".js": "text/javascript", ".mjs": "text/javascript", ".css": "text/css", ".wasm": "application/wasm" };
const WASM = process.env.STUDIO_WASM || resolve(ROOT, "../../../target/studio/studio.wasm");
const BRINELL = process.env.BRINELL || resolve(ROOT, "../../../target/release/brinell");

/** Without the engine's module a stand-in answers, of which only the page can be tested. */
export const real = existsSync(WASM);

export async function launch() {
  const executablePath = process.env.CHROMIUM || PLACES.find(existsSync);
  if (!executablePath) throw new Error(`no Chromium at ${PLACES.join(", ")}; CHROMIUM names another`);
  return chromium.launch({ executablePath, headless: true, chromiumSandbox: false,
    args: ["--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync"] });
}

// Serves studio/ with the engine's module beside index.html.
export async function serve() {
  const answers = asked();
  const server = createServer((request, response) => {
    if (request.method === "POST") return void answers(request, response);
    const path = new URL(request.url, "http://localhost").pathname, file = path === "/studio.wasm" ? WASM : places(path).find(existsSync);
    if (!file) return response.writeHead(404).end();
    response.writeHead(200, { "Content-Type": TYPES[extname(file)] ?? "text/plain" }).end(readFileSync(file));
  });
  await new Promise((done) => server.listen(0, "127.0.0.1", done));
  return { url: `http://127.0.0.1:${server.address().port}/`, close: () => server.close() };
}

// The stand-in behind a server, as `brinell studio` would be.
function asked() {
  let engine, waiting = Promise.resolve();
  return async (request, response) => {
    if (request.url !== "/ask?token=secret") return response.writeHead(403).end();
    const body = Buffer.concat(await all(request));
    if (!engine) {
      engine = createContext({ performance, TextEncoder, TextDecoder, structuredClone, self: {} });
      runInContext(fake(), engine);
    }
    waiting = waiting.then(() => {
      engine.self.postMessage = ({ bytes }) => response.writeHead(bytes ? 200 : 500).end(bytes && Buffer.from(bytes));
      engine.bytes = body;
      runInContext("self.onmessage({ data: { id: 0, bytes: Uint8Array.from(bytes) } })", engine);
    });
  };
}

async function all(request) {
  const parts = [];
  for await (const part of request) parts.push(part);
  return parts;
}

function places(path) {
  const name = path === "/" ? "/index.html" : path;
  return [join(ROOT, name), ...(process.env.STUDIO_VIEWS ? [join(process.env.STUDIO_VIEWS, name)] : [])];
}

const fake = () => readFileSync(join(import.meta.dirname, "fake-engine.js"), "utf8").replace("{/*schema*/}", execFileSync(BRINELL, ["schema"], { encoding: "utf8" }));

// Opens the page in a window of its own. `asked` and `said` fill as it lives.
export async function open(browser, url, { width = 1400, height = 900, engine = real ? "real" : "fake", before, ...options } = {}) {
  const context = await browser.newContext({ viewport: { width, height }, acceptDownloads: true, ...options });
  const page = await context.newPage();
  page.asked = [];
  page.said = [];
  page.on("request", (request) => page.asked.push(request.url()));
  page.on("console", (message) => page.said.push(`${message.type()}: ${message.text()}`));
  page.on("pageerror", (error) => page.said.push(`error: ${error.message}`));
  if (engine === "fake") await page.addInitScript((text) => { globalThis.brinellWorker = URL.createObjectURL(new Blob([text], { type: "text/javascript" })); }, fake());
  if (before) await page.addInitScript(before);
  await page.goto(url, { waitUntil: "load" });
  return page;
}

// The page runs a bearing and has shown some of it.
export async function running(page) {
  await page.waitForFunction(() => globalThis.brinellStudio?.side?.spectra, null, { timeout: 30000 });
}

// Runs `look` on the page in a window of its own, and holds the page to silence and to itself.
export async function quietly(browser, url, options, look) {
  const page = await open(browser, url, options);
  try {
    await running(page);
    await look(page);
    assert.deepEqual(page.said, []);
    const home = new URL(url).origin;
    assert.deepEqual(page.asked.filter((u) => !(url.startsWith("http") && u.startsWith(home)) && u.split("#")[0] !== url.split("#")[0] && !u.startsWith("data:")
      && !u.startsWith("blob:")), []);
  } finally {
    await page.context().close();
  }
}
