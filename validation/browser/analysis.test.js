// The page of a measured signal laid over another, in a browser. ANALYSIS names the page; README.md beside this says how to get one.
import assert from "node:assert/strict";
import { existsSync } from "node:fs";
import { readFile } from "node:fs/promises";
import { resolve } from "node:path";
import { after, before, describe, it } from "node:test";
import { pathToFileURL } from "node:url";
import { drawn, launch, pngSize, quietly } from "./browser.js";

const path = resolve(process.env.ANALYSIS || "../../out/analysis/report.html"), url = pathToFileURL(path).href;
let browser;

describe("the page of an analysis", { skip: existsSync(path) ? false : `no page at ${path}` }, () => {
  before(async () => { browser = await launch(); });
  after(async () => { await browser?.close(); });

  const on = (look) => quietly(browser, url, {}, look);
  const figure = (page, name) => page.locator("figure", { has: page.locator(`svg.wide[data-name="${name}"]`) });
  const curves = (page, name) => page.locator(`svg.wide[data-name="${name}"] .series path`).evaluateAll((all) => all.map((p) => p.getAttribute("d")));
  const zoomIn = (page, name) => figure(page, name).getByRole("button", { name: /^Zoom in/ }).click();

  it("on a phone wide tables are cards, and nothing reaches aside", () => quietly(browser, url, { width: 390 }, async (page) => {
    await drawn(page);
    const { aside, wide, cards } = await page.evaluate(() => ({
      aside: document.documentElement.scrollWidth - document.documentElement.clientWidth,
      wide: [...document.querySelectorAll(".scroll")].filter((e) => e.scrollWidth > e.clientWidth).length,
      cards: [...document.querySelectorAll("table")].filter((e) => e.rows[0].cells.length > 4).map((e) => getComputedStyle(e).display),
    }));
    assert.deepEqual([aside, wide], [0, 0]);
    assert.ok(cards.length && cards.every((display) => display === "block"), JSON.stringify(cards));
  }));

  for (const name of ["close-up", "spectrum", "envelope-spectrum"]) {
    it(`${name}: both curves follow the view, and come back`, () => on(async (page) => {
      const home = await curves(page, name);
      assert.equal(home.length, 2);
      await zoomIn(page, name);
      await drawn(page);
      const near = await curves(page, name);
      assert.ok(near.every((d, i) => d && d !== home[i]), "a curve stayed behind");
      await figure(page, name).getByRole("button", { name: /^Reset to the first view/ }).click();
      await drawn(page);
      assert.deepEqual(await curves(page, name), home);
    }));

    it(`${name}: the cursor reads both`, () => on(async (page) => {
      const svg = page.locator(`svg.wide[data-name="${name}"]`);
      await svg.scrollIntoViewIfNeeded();
      const box = await svg.boundingBox();
      await page.mouse.move(box.x + 0.5 * box.width, box.y + 0.6 * box.height);
      const text = await figure(page, name).locator(".readout").textContent();
      // Two values, each after the name of its signal.
      assert.equal(text.split(" · ").length >= 3, true, text);
    }));
  }

  it("the shaded band stays where it belongs", () => on(async (page) => {
    const band = () => page.locator('svg.wide[data-name="spectrum"] .window').evaluate((node) => node.getBoundingClientRect().width);
    const home = await band();
    await zoomIn(page, "spectrum");
    await drawn(page);
    assert.notEqual(Math.round(await band()), Math.round(home));
  }));

  it("lanes of marks stay above the frame when the view changes", () => on(async (page) => {
    await zoomIn(page, "envelope-spectrum");
    await drawn(page);
    const [frame, marks] = await page.locator('svg.wide[data-name="envelope-spectrum"]').evaluate((svg) => {
      const bottoms = [...svg.querySelectorAll(".lane")].map((lane) => lane.querySelector("path")).filter((p) => p.getAttribute("d")).map((p) => p.getBBox().y + p.getBBox().height);
      return [Number(svg.dataset.frame.split(" ")[1]), bottoms];
    });
    assert.ok(marks.length && marks.every((y) => y <= frame), `${marks} below ${frame}`);
  }));

  it("no list is torn apart on paper", () => on(async (page) => {
    await page.emulateMedia({ media: "print" });
    const lists = await page.locator("main ul").evaluateAll((all) => all.map((list) => getComputedStyle(list).breakInside));
    assert.ok(lists.length && lists.every((inside) => inside === "avoid"), `${lists}`);
  }));

  for (const kind of ["SVG", "PNG"]) {
    it(`every picture saves as ${kind}`, () => on(async (page) => {
      const buttons = page.getByRole("button", { name: new RegExp(`^Save as ${kind}`) }), count = await buttons.count();
      assert.ok(count >= 5, `${count} pictures`);
      for (let i = 0; i < count; i++) {
        const [download] = await Promise.all([page.waitForEvent("download"), buttons.nth(i).click()]);
        const bytes = await readFile(await download.path());
        if (kind === "PNG") assert.ok(pngSize(bytes)[0] > 500);
        else assert.match(bytes.toString(), /^<svg .*<\/svg>\s*$/s);
      }
    }));
  }
});
