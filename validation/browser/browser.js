// Chromium as it is installed, and a page that keeps account of what it asks for and complains of.
import assert from "node:assert/strict";
import { existsSync } from "node:fs";
import { chromium } from "playwright-core";

const PLACES = ["/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome", "/Applications/Chromium.app/Contents/MacOS/Chromium"];

export async function launch() {
  const executablePath = process.env.CHROMIUM || PLACES.find(existsSync);
  if (!executablePath) throw new Error(`no Chromium at ${PLACES.join(", ")}; CHROMIUM names another`);
  const quiet = ["--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync"];
  return chromium.launch({ executablePath, headless: true, chromiumSandbox: false, args: quiet });
}

// Opens the page in a window of its own, without network. `asked` and `said` fill as it lives.
export async function open(browser, url, { width = 1280, height = 900, ...options } = {}) {
  const context = await browser.newContext({ viewport: { width, height }, offline: true, acceptDownloads: true, reducedMotion: "reduce", ...options });
  const page = await context.newPage();
  page.asked = [];
  page.said = [];
  page.on("request", (request) => page.asked.push(request.url()));
  page.on("console", (message) => page.said.push(`${message.type()}: ${message.text()}`));
  page.on("pageerror", (error) => page.said.push(`error: ${error.message}`));
  await page.goto(url, { waitUntil: "load" });
  return page;
}

// Runs `look` on the page in a window of its own, and holds the page to silence and to itself.
export async function quietly(browser, url, options, look) {
  const page = await open(browser, url, options);
  try {
    await look(page);
    assert.deepEqual(page.said, []);
    assert.deepEqual(page.asked.filter((u) => u !== url && !u.startsWith("data:") && !u.startsWith("blob:")), []);
  } finally {
    await page.context().close();
  }
}

// The next frames of the page have been drawn.
export const drawn = (page) => page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));

// Width and height of a PNG.
export function pngSize(bytes) {
  if (bytes.subarray(1, 4).toString() !== "PNG") throw new Error("not a PNG");
  return [bytes.readUInt32BE(16), bytes.readUInt32BE(20)];
}
