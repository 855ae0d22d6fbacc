// A page of the views with made-up data, in Chromium, for their tests. CHROMIUM names another browser. Every test loads the page anew, in a window that those with the same options share, and fails where the page logs anything.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { open } from "./browser.js";
import { browser, server } from "./served.js";

export const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
const windows = new Map();

export async function on(options, look) {
  const url = `${server.url}tests/views.html`,
    key = JSON.stringify(options),
    old = windows.get(key);
  const page = old ?? (await open(browser, url, { width: 1280, reducedMotion: "reduce", ...options }));
  windows.set(key, page);
  if (old) {
    await page.mouse.move(0, 0);
    page.said.length = 0;
    await page.reload();
  }
  await page.locator("html[data-ready]").waitFor();
  await drawn(page);
  await look(page);
  assert.deepEqual(page.said, []);
}
export const drawn = (page) => page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
export const curve = (page, kind) => page.locator(`brinell-curve[kind="${kind}"]`);
export const plot = (page, kind) => curve(page, kind).locator(".plot");
export const view = (page, kind) => curve(page, kind).evaluate((node) => [...node.view]);
export const readout = (page, kind) => curve(page, kind).locator(".readout").textContent();
// How many pixels of a canvas are near this colour.
export const inked = (locator, colour) =>
  locator.evaluate((canvas, [r, g, b]) => {
    const copy = new OffscreenCanvas(canvas.width, canvas.height).getContext("2d", { willReadFrequently: true });
    copy.drawImage(canvas, 0, 0);
    const { data } = copy.getImageData(0, 0, canvas.width, canvas.height);
    let n = 0;
    for (let i = 0; i < data.length; i += 4)
      if (data[i + 3] > 200 && Math.abs(data[i] - r) + Math.abs(data[i + 1] - g) + Math.abs(data[i + 2] - b) < 60) n++;
    return n;
  }, colour);
export const BLUE = [0, 114, 178],
  DAMAGE = [208, 74, 0],
  GREEN = [0, 112, 90];

// The view's exports: what a parser of XML says of the SVG, and the size of the PNG.
export const saved = (page, selector) =>
  page.evaluate(async (selector) => {
    const node = document.querySelector(selector),
      xml = new DOMParser().parseFromString(await node.toSVG(), "image/svg+xml"),
      image = await createImageBitmap(await node.toPNG());
    const all = (tag) => [...xml.getElementsByTagName(tag)];
    return {
      error: xml.querySelector("parsererror")?.textContent ?? null,
      title: all("title")[0]?.textContent,
      words: all("text").map((t) => t.textContent),
      paths: all("path").map((p) => p.getAttribute("d")),
      inks: [...new Set(all("path").flatMap((p) => [p.getAttribute("stroke"), p.getAttribute("fill")]))],
      png: [image.width, image.height],
      wrong: [...xml.querySelectorAll("*")]
        .flatMap((n) => [...n.attributes])
        .filter((a) => /NaN|undefined|Infinity/.test(a.value))
        .map((a) => a.value.slice(0, 80)),
    };
  }, selector);
