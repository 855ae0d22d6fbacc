// What holds for every page that brinell writes, in a browser. PAGES names the folder that they lie below; README.md beside this says how to get them.
import assert from "node:assert/strict";
import { existsSync, readdirSync, readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join, relative, resolve } from "node:path";
import { after, before, describe, it } from "node:test";
import { pathToFileURL } from "node:url";
import { launch, quietly } from "./browser.js";

const folder = resolve(process.env.PAGES || "../../out");
const pages = existsSync(folder) ? readdirSync(folder, { recursive: true }).filter((name) => name.endsWith(".html")).map((name) => join(folder, name)).sort() : [];
const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
const RULES = ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "wcag22aa"];
let browser;

before(async () => { browser = await launch(); });
after(async () => { await browser?.close(); });

describe("every page", { skip: pages.length ? false : `no page below ${folder}` }, () => {
  for (const path of pages) {
    const name = relative(folder, path), url = pathToFileURL(path).href;

    // Colours do not depend on the width, nor places on the colours.
    for (const [width, colorScheme] of [[1280, "light"], [390, "dark"]]) {
      it(`${name}, ${width} px, ${colorScheme}`, async (t) => quietly(browser, url, { width, colorScheme }, async (page) => {
        await t.test("nothing that axe-core finds fault with", async () => {
          await page.evaluate(axe);
          const found = await page.evaluate((values) => window.axe.run(document, { runOnly: { type: "tag", values } }), RULES);
          assert.deepEqual(found.violations.map((one) => `${one.id}: ${one.nodes.slice(0, 3).map((node) => node.html.slice(0, 160)).join(" | ")}`), []);
        });

        await t.test("nothing to scroll aside but wide boxes, which the keyboard reaches", async () => {
          const { aside, out } = await page.evaluate(() => ({
            aside: document.documentElement.scrollWidth - document.documentElement.clientWidth,
            out: [...document.querySelectorAll(".scroll, pre")].filter((box) => box.scrollWidth > box.clientWidth && box.tabIndex !== 0).length,
          }));
          assert.equal(aside, 0);
          assert.equal(out, 0);
        });

        if (width === 390) await t.test("no table is wider than a phone", async () => {
          const wide = await page.evaluate(() => [...document.querySelectorAll(".scroll")].filter((box) => box.scrollWidth > box.clientWidth).map((box) => box.innerText.slice(0, 80)));
          assert.deepEqual(wide, []);
        });

        await t.test("each control has a name of its own", async () => {
          const names = await page.evaluate(() => [...document.querySelectorAll("button, input, select")].map((node) => node.getAttribute("aria-label") || node.textContent.trim()));
          assert.deepEqual(names.filter((one, k) => !one || names.indexOf(one) !== k), []);
        });

        await t.test("folds nothing on paper", async () => {
          const folded = () => page.locator("details:not([open])").count();
          const before = await folded();
          await page.evaluate(() => dispatchEvent(new Event("beforeprint")));
          assert.equal(await folded(), 0);
          await page.evaluate(() => dispatchEvent(new Event("afterprint")));
          assert.equal(await folded(), before);
        });

        if (colorScheme === "dark") await t.test("light or dark as the reader's system, and as the reader chooses", async () => {
          const back = () => page.evaluate(() => getComputedStyle(document.body).backgroundColor);
          const dark = await back();
          await page.getByRole("button", { name: "Light page" }).click();
          const light = await back();
          assert.equal(light, "rgb(255, 255, 255)");
          assert.notEqual(dark, light);
          await page.getByRole("button", { name: "Dark page" }).click();
          assert.equal(await back(), dark);
          await page.emulateMedia({ media: "print" });
          assert.equal(await back(), light);
        });
      }));
    }
  }
});
