// The page of a run, in a browser. REPORT names the page; README.md beside this says how to get one.
import assert from "node:assert/strict";
import { mkdtemp, readFile, rm, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { after, before, describe, it } from "node:test";
import { pathToFileURL } from "node:url";
import { drawn, launch, open, pngSize, quietly } from "./browser.js";

const url = pathToFileURL(resolve(process.env.REPORT || "../../out/rectangle/report.html")).href;
let browser;

before(async () => { browser = await launch(); });
after(async () => { await browser?.close(); });

const on = (options, look) => quietly(browser, url, options, look);

const plot = (page, name) => page.locator(`svg.wide[data-name="${name}"]`);
const figure = (page, name) => page.locator("figure", { has: plot(page, name) });
const readout = (page, name) => figure(page, name).locator(".readout");
// First and last number on the x axis.
const ends = (page, name) => plot(page, name).locator(".ticks-x text").evaluateAll((all) => {
  const numbers = all.map((node) => Number(node.textContent.replace("−", "-").replace(/[\s\u2009\u202f]/g, "")));
  return [numbers[0], numbers[numbers.length - 1]];
});
// A place within a plot's frame, from its left and top end (0) to the other (1), on the screen.
async function place(page, name, across, down = 0.5) {
  await plot(page, name).scrollIntoViewIfNeeded();
  const svg = plot(page, name), box = await svg.boundingBox();
  const [l, t, r, b] = (await svg.getAttribute("data-frame")).split(" ").map(Number), scale = box.width / Number((await svg.getAttribute("viewBox")).split(" ")[2]);
  return [box.x + scale * (l + across * (r - l)), box.y + scale * (t + down * (b - t))];
}

describe("the page", () => {
  for (const width of [1280, 390]) {
    it(`opens at ${width} px with every picture in it and no bar to scroll aside`, async (t) => on({ width }, async (page) => {
      const timing = await page.evaluate(() => {
        const { domContentLoadedEventEnd, loadEventEnd } = performance.getEntriesByType("navigation")[0];
        return [domContentLoadedEventEnd, loadEventEnd].map(Math.round);
      });
      t.diagnostic(`read after ${timing[0]} ms, loaded after ${timing[1]} ms`);
      const seen = await page.evaluate(() => {
        const figures = [...document.querySelectorAll("figure")].map((f) => [...f.querySelectorAll("svg")].filter((s) => s.getBoundingClientRect().height > 40).length);
        return { figures, scroll: document.documentElement.scrollWidth, client: document.documentElement.clientWidth };
      });
      assert.ok(seen.figures.length >= 12, `${seen.figures.length} figures`);
      assert.ok(seen.figures.every((n) => n === 1), `one drawing a figure: ${seen.figures}`);
      assert.ok(seen.scroll <= seen.client, `${seen.scroll} px wide in ${seen.client}`);
    }));

    it(`keeps words within the pictures and apart from each other at ${width} px`, async () => on({ width }, async (page) => {
      await page.evaluate(() => document.fonts.ready);
      const faults = await page.evaluate(() => {
        const faults = [];
        for (const svg of document.querySelectorAll("figure svg")) {
          const box = svg.getBoundingClientRect();
          if (box.width === 0) continue;
          const name = svg.dataset.name, words = [...svg.querySelectorAll("text")].map((node) => [node.textContent, node.getBoundingClientRect()]);
          for (const [text, w] of words) if (w.left < box.left - 1.5 || w.right > box.right + 1.5 || w.top < box.top - 3 || w.bottom > box.bottom + 3) faults.push(`${name}: "${text}" leaves the picture`);
          words.forEach(([one, a], i) => words.slice(i + 1).forEach(([other, b]) => {
            const across = Math.min(a.right, b.right) - Math.max(a.left, b.left), down = Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top);
            // Line boxes are taller than letters.
            if (across > 1 && down > 0.45 * Math.min(a.height, b.height)) faults.push(`${name}: "${one}" lies on "${other}"`);
          }));
        }
        return faults;
      });
      assert.deepEqual(faults, []);
    }));
  }

  it("is complete without its script", async () => on({ javaScriptEnabled: false }, async (page) => {
    for (const width of [1280, 390]) {
      await page.setViewportSize({ width, height: 900 });
      for (const f of await page.locator("figure").all()) {
        const boxes = await Promise.all((await f.locator("svg").all()).map((svg) => svg.boundingBox()));
        assert.equal(boxes.filter((box) => box && box.height > 40).length, 1);
      }
    }
    assert.equal(await page.locator("button").count(), 0);
    assert.ok(await page.getByText("Assumptions").first().isVisible());
  }));

  it("prints: no controls, the wide pictures, tables whole", async () => on({ width: 390 }, async (page) => {
    await page.emulateMedia({ media: "print" });
    for (const hidden of ["nav", ".tools"]) assert.ok(!(await page.locator(hidden).first().isVisible()), hidden);
    const shown = await page.locator("figure svg").evaluateAll((all) => all.map((s) => s.classList.contains("wide") === s.getBoundingClientRect().height > 40));
    assert.ok(shown.every(Boolean));
    const pdf = await page.pdf({ format: "A4" });
    assert.equal(pdf.subarray(0, 5).toString(), "%PDF-");
  }));

  it("names its controls, each by a name of its own", async () => on({}, async (page) => {
    const names = await page.evaluate(() => [...document.querySelectorAll("button, input, select")].filter((n) => n.getBoundingClientRect().width > 0).map((n) => n.getAttribute("aria-label") || n.textContent.trim()));
    assert.ok(names.length > 30 && names.every((n) => n.length > 0), `${names}`);
    const twice = names.filter((n, k) => names.indexOf(n) !== k);
    assert.deepEqual(twice, []);
    for (const svg of await page.locator("figure svg").all()) assert.ok((await svg.getAttribute("aria-label")).length > 3);
    assert.equal(await page.getAttribute("html", "lang"), "en");
    assert.ok(await page.title());
  }));
});

describe("a plot", () => {
  it("zooms by a drag and goes back by a double click", async () => on({}, async (page) => {
    const original = await plot(page, "waveform").innerHTML();
    const [lo, hi] = (await plot(page, "waveform").getAttribute("data-view")).split(" ").map(Number);
    const [x1, y] = await place(page, "waveform", 0.25), [x2] = await place(page, "waveform", 0.75);
    await page.mouse.move(x1, y);
    await page.mouse.down();
    await page.mouse.move((x1 + x2) / 2, y);
    await page.mouse.move(x2, y);
    await page.mouse.up();
    const [from, to] = await ends(page, "waveform");
    assert.ok(from >= lo + 0.24 * (hi - lo) && to <= lo + 0.76 * (hi - lo) && to > from, `${from} to ${to} of ${lo} to ${hi}`);
    await page.mouse.dblclick(x1, y);
    await page.mouse.move(0, 0);
    assert.equal(await plot(page, "waveform").innerHTML(), original);
  }));

  it("zooms by a wheel with Ctrl, and scrolls the page by the wheel alone", async () => on({}, async (page) => {
    const before = await ends(page, "spectrum"), [x, y] = await place(page, "spectrum", 0.5);
    const ticks = plot(page, "spectrum").locator(".ticks-x"), whole = await ticks.textContent();
    await page.mouse.move(x, y);
    await page.keyboard.down("Control");
    await page.mouse.wheel(0, -300);
    await page.waitForFunction((whole) => document.querySelector('svg.wide[data-name="spectrum"] .ticks-x').textContent !== whole, whole);
    await page.keyboard.up("Control");
    const near = await ends(page, "spectrum");
    assert.ok(near[1] - near[0] < 0.8 * (before[1] - before[0]), `${near} of ${before}`);
    const zoomed = await ticks.textContent(), top = await page.evaluate(() => scrollY);
    await page.mouse.wheel(0, 200);
    await page.waitForFunction((y) => scrollY > y, top);
    assert.equal(await ticks.textContent(), zoomed);
  }));

  it("zooms by its buttons and by keys", async () => on({}, async (page) => {
    const span = async () => { const [a, b] = await ends(page, "spectrum"); return b - a; };
    const press = (name) => figure(page, "spectrum").getByRole("button", { name }).click();
    const whole = await span();
    await press(/^Zoom in/);
    const half = await span();
    assert.ok(half < 0.7 * whole, `${half} of ${whole}`);
    await press(/^Zoom out/);
    assert.ok(await span() > 1.5 * half);
    await press(/^Zoom in/);
    await press(/^Reset/);
    assert.equal(await span(), whole);
    await press(/^Zoom in/);
    await press(/^All that/);
    assert.ok(await span() >= 0.9 * whole);
    await press(/^Reset/);
    await plot(page, "spectrum").focus();
    await page.keyboard.press("+");
    assert.ok(await span() < 0.7 * whole);
    const [first] = await ends(page, "spectrum");
    await page.keyboard.press("ArrowRight");
    assert.ok((await ends(page, "spectrum"))[0] > first);
    await page.keyboard.press("Escape");
    assert.equal(await span(), whole);
  }));

  it("says how plots are zoomed above the first of them alone", async () => on({}, async (page) => {
    const said = (await page.locator(".readout").allTextContents()).filter((text) => text.startsWith("Drag, pinch"));
    assert.equal(said.length, 1);
    assert.match(await readout(page, "waveform").textContent(), /^Drag, pinch or Ctrl \+ wheel to zoom/);
  }));

  it("reads out what is under the cursor, by pointer and by keys", async () => on({}, async (page) => {
    const [lo, hi] = (await plot(page, "waveform").getAttribute("data-view")).split(" ").map(Number);
    const [x, y] = await place(page, "waveform", 0.4);
    await page.mouse.move(x, y);
    const words = await readout(page, "waveform").textContent();
    const [, time, value] = words.match(/^([\d.]+) ms · damaged (−?[\d.]+(?:e[-−]?\d+)?) m\/s² · healthy −?[\d.]/) || assert.fail(words);
    assert.ok(Math.abs(Number(time) - (lo + 0.4 * (hi - lo))) < 0.003 * (hi - lo), words);
    assert.ok(Number.isFinite(Number(value.replaceAll("−", "-"))));
    await page.mouse.move(0, 0);
    await plot(page, "waveform").focus();
    await page.keyboard.press("Shift+ArrowRight");
    const first = await readout(page, "waveform").textContent();
    await page.keyboard.press("Shift+ArrowRight");
    const second = await readout(page, "waveform").textContent();
    assert.ok(parseFloat(second) > parseFloat(first), `${first}; ${second}`);
  }));

  // A click sets the cursor, and it stays when the pointer goes.
  const click = async (page, name, across) => { const [x, y] = await place(page, name, across); await page.mouse.click(x, y); };
  const choose = (page, name, what, value) => figure(page, name).getByLabel(new RegExp(`^${what}: `)).selectOption(value);
  const number = (text) => Number(text.replaceAll("−", "-"));

  it("reads the distance of two places and its inverse", async () => on({}, async (page) => {
    await choose(page, "waveform", "Cursor", "delta");
    await click(page, "waveform", 0.2);
    await click(page, "waveform", 0.7);
    await page.mouse.move(0, 0);
    const words = await readout(page, "waveform").textContent();
    const [, distance, rate, from, to] = words.match(/^Δ ([\d.]+) ms = 1 \/ ([\d.]+) Hz · .* · ([\d.]+) ms to ([\d.]+) ms$/) || assert.fail(words);
    assert.ok(Math.abs(to - from - distance) < 2e-3 * distance, words);
    assert.ok(Math.abs(1e3 / distance - rate) < 1e-3 * rate, words);
  }));

  it("draws and reads harmonics of the cursor, and sidebands of a carrier", async () => on({}, async (page) => {
    const lines = async () => {
      const d = await plot(page, "envelope-spectrum").locator(".cursor").evaluateAll((all) => all.map((p) => p.getAttribute("d")));
      return d.flatMap((one) => [...one.matchAll(/M([\d.]+)/g)].map((m) => Number(m[1]))).sort((a, b) => a - b);
    };
    const [l, , r] = (await plot(page, "envelope-spectrum").getAttribute("data-frame")).split(" ").map(Number);
    await choose(page, "envelope-spectrum", "Cursor", "harmonics");
    await click(page, "envelope-spectrum", 0.2);
    await page.mouse.move(0, 0);
    assert.match(await readout(page, "envelope-spectrum").textContent(), /^Harmonics of [\d.]+ Hz · 1×: .* · 2×: .* m\/s²$/);
    const comb = await lines(), first = comb[0] - l;
    assert.ok(comb.length >= 4, `${comb}`);
    comb.forEach((x, k) => assert.ok(Math.abs(x - l - (k + 1) * first) < 0.2 * (k + 1), `${comb}`));
    await choose(page, "envelope-spectrum", "Cursor", "sidebands");
    await click(page, "envelope-spectrum", 0.5);
    await click(page, "envelope-spectrum", 0.6);
    await page.mouse.move(0, 0);
    assert.match(await readout(page, "envelope-spectrum").textContent(), /spacing [\d.]+ Hz · ±1: .* · ±2: .* · ±3: .* m\/s²$/);
    const sides = await lines(), middle = 0.5 * (sides[0] + sides.at(-1));
    assert.ok(sides.length >= 5 && Math.abs(middle - 0.5 * (l + r)) < 0.11 * (r - l), `${sides}`);
    await plot(page, "envelope-spectrum").focus();
    await page.keyboard.press("Escape");
    assert.deepEqual(await lines(), []);
  }));

  it("reads the same line in m/s², g, mm/s and dB", async () => on({}, async (page) => {
    await click(page, "spectrum", 0.3);
    await page.mouse.move(0, 0);
    const value = async () => { const [, x, v] = (await readout(page, "spectrum").textContent()).match(/^([\d.]+) Hz · damaged (\S+)/); return [Number(x), number(v)]; };
    const [hz, metres] = await value();
    const near = (a, b) => assert.ok(Math.abs(a / b - 1) < 2e-3, `${a} is not ${b}`);
    await choose(page, "spectrum", "Unit", { label: "g" });
    near((await value())[1], metres / 9.80665);
    await choose(page, "spectrum", "Unit", { label: "mm/s" });
    near((await value())[1], 1e3 * metres / (2 * Math.PI * hz));
    assert.match(await plot(page, "spectrum").locator(".label-y").textContent(), /mm\/s/);
    await choose(page, "spectrum", "Unit", { label: "m/s²" });
    await choose(page, "spectrum", "Scale", "dB");
    assert.ok(Math.abs((await value())[1] - 20 * Math.log10(metres)) < 0.02);
    assert.match(await plot(page, "spectrum").locator(".label-y").textContent(), /dB re 1 m\/s²/);
  }));

  it("saves and copies the values in view", async () => on({ permissions: ["clipboard-read", "clipboard-write"] }, async (page) => {
    await figure(page, "envelope-spectrum").getByRole("button", { name: /^Zoom in/ }).click();
    const [download] = await Promise.all([page.waitForEvent("download"), figure(page, "envelope-spectrum").getByRole("button", { name: /as CSV/ }).click()]);
    assert.equal(download.suggestedFilename(), "envelope-spectrum.csv");
    const rows = (await readFile(await download.path(), "utf8")).trim().split("\n");
    assert.equal(rows[0], '"Frequency (Hz)","damaged (m/s^2)","healthy (m/s^2)"');
    const [from, to] = await ends(page, "envelope-spectrum"), places = rows.slice(1).map((row) => row.split(",").map(Number));
    assert.ok(places.length > 4 && places.every(([x, v]) => Number.isFinite(x) && v >= 0));
    assert.ok(places[0][0] <= from && places.at(-1)[0] >= to, `${places[0][0]} to ${places.at(-1)[0]} of ${from} to ${to}`);
    await figure(page, "envelope-spectrum").getByRole("button", { name: /^Copy/ }).click();
    await page.waitForFunction(() => [...document.querySelectorAll(".readout")].some((node) => node.textContent.startsWith("Copied")));
    assert.equal((await page.evaluate(() => navigator.clipboard.readText())).trim().split("\n").length, rows.length);
  }));

  it("shows the instant of the run that is clicked in the overview", async () => on({}, async (page) => {
    const [x, y] = await place(page, "overview", 0.5);
    await page.mouse.click(x, y);
    const [lo, hi] = (await plot(page, "overview").getAttribute("data-view")).split(" ").map(Number);
    const [from, to] = await ends(page, "waveform");
    // The waveform shows milliseconds where the overview shows seconds.
    const middle = 0.5 * (from + to), asked = 0.5 * (lo + hi);
    assert.ok([1, 1e3].some((scale) => Math.abs(middle / scale - asked) < 0.02 * (hi - lo)), `${middle} ${asked}`);
  }));

  it("marks the harmonics that are picked", async () => on({}, async (page) => {
    const bar = figure(page, "envelope-spectrum"), pick = (name) => bar.getByRole("button", { name: new RegExp(`^Mark the harmonics of ${name},`) });
    const lines = async () => {
      const d = await plot(page, "envelope-spectrum").locator(".harmonics path").evaluateAll((all) => all.map((p) => p.getAttribute("d")));
      return d.flatMap((one) => [...one.matchAll(/M([\d.]+)/g)].map((m) => Number(m[1])));
    };
    const damaged = bar.locator('.picks button[aria-pressed="true"]');
    assert.equal(await damaged.count(), 1);
    assert.deepEqual(await lines(), []);
    await pick("BPFI").click();
    assert.equal(await pick("BPFI").getAttribute("aria-pressed"), "true");
    const [l, , r] = (await plot(page, "envelope-spectrum").getAttribute("data-frame")).split(" ").map(Number);
    const [lo, hi] = (await plot(page, "envelope-spectrum").getAttribute("data-view")).split(" ").map(Number);
    const frequency = parseFloat((await pick("BPFI").getAttribute("aria-label")).split(", ")[1]);
    const expected = Array.from({ length: Math.floor(hi / frequency) }, (_, n) => l + (r - l) * ((n + 1) * frequency - lo) / (hi - lo));
    const found = await lines();
    assert.equal(found.length, expected.length);
    found.forEach((x, k) => assert.ok(Math.abs(x - expected[k]) < 0.2));
    await pick("BPFI").focus();
    await page.keyboard.press("Enter");
    assert.equal(await pick("BPFI").getAttribute("aria-pressed"), "false");
    assert.deepEqual(await lines(), []);
  }));
});

describe("the animation", () => {
  const frame = (page) => figure(page, "motion").getAttribute("data-frame").then(Number);

  it("plays in view and pauses at a click", async () => on({ reducedMotion: "no-preference" }, async (page) => {
    const figureOfMotion = figure(page, "motion"), pose = () => plot(page, "motion").locator(".m-spins path").first().getAttribute("d");
    const still = await frame(page), first = await pose();
    await figureOfMotion.scrollIntoViewIfNeeded();
    await page.waitForFunction((still) => {
      const figure = document.querySelector('svg[data-name="motion"]').closest("figure");
      return figure.dataset.frame !== String(still);
    }, still);
    assert.notEqual(await pose(), first);
    await figureOfMotion.getByRole("button", { name: "Pause", exact: true }).click();
    await figureOfMotion.getByRole("button", { name: "Play", exact: true }).waitFor();
    const stopped = await frame(page);
    for (let k = 0; k < 10; k++) await drawn(page);
    assert.equal(await frame(page), stopped);
    await figureOfMotion.getByRole("button", { name: "Play", exact: true }).click();
    await page.waitForFunction((at) => document.querySelector('svg[data-name="motion"]').closest("figure").dataset.frame !== String(at), stopped);
  }));

  it("is at rest for readers who ask for less motion, and obeys the slider's keys", async () => on({}, async (page) => {
    await figure(page, "motion").scrollIntoViewIfNeeded();
    const at = await frame(page);
    for (let k = 0; k < 10; k++) await drawn(page);
    assert.equal(await frame(page), at);
    await figure(page, "motion").getByRole("slider").focus();
    await page.keyboard.press("ArrowLeft");
    assert.equal(await frame(page), at - 1);
    await page.keyboard.press("Home");
    assert.equal(await frame(page), 0);
  }));
});

describe("saving", () => {
  for (const width of [1280, 390]) {
    it(`gives every picture as SVG${width < 1280 ? "" : " and PNG"} at ${width} px`, async () => on({ width }, async (page) => {
      const names = new Set();
      for (const f of await page.locator("figure").all()) {
        const svg = f.locator("svg:visible").first(), [, , w, h] = (await svg.getAttribute("viewBox")).split(" ").map(Number), name = await svg.getAttribute("data-name");
        const file = async (kind) => {
          const [download] = await Promise.all([page.waitForEvent("download"), f.getByRole("button", { name: new RegExp(`^Save as ${kind}`) }).click()]);
          assert.equal(download.suggestedFilename(), `${name}.${kind.toLowerCase()}`);
          return readFile(await download.path());
        };
        const text = (await file("SVG")).toString();
        const parsed = await page.evaluate((text) => {
          const root = new DOMParser().parseFromString(text, "image/svg+xml").documentElement;
          return [root.localName, root.getAttribute("width"), root.getAttribute("height"), root.querySelectorAll("path, circle, text, image").length];
        }, text);
        assert.equal(parsed[0], "svg", name);
        assert.deepEqual([Number(parsed[1]), Number(parsed[2])].map(Math.round), [w, h].map(Math.round), name);
        // The letters of a picture within may spell anything.
        assert.ok(parsed[3] > 4 && !text.replace(/base64,[^"]*/g, "").includes("NaN"), name);
        names.add(name);
        // The PNG is made of the SVG, whatever the width. Without it Chromium would drop what goes beyond ten downloads a second.
        if (width < 1280) {
          await page.waitForTimeout(100);
          continue;
        }
        const png = await file("PNG");
        assert.deepEqual(pngSize(png), [Math.floor(2 * w), Math.floor(2 * h)], name);
        assert.ok(png.length > 2000, name);
      }
      assert.equal(names.size, await page.locator("figure").count());
    }));
  }
});

// Nothing in a page is to run but its own script, should anything ever slip through the escaping.
describe("the content security policy", () => {
  it("runs no other script and loads nothing", async () => {
    const folder = await mkdtemp(join(tmpdir(), "page-")), path = join(folder, "report.html");
    const foreign = '<script>window.ran = 1</script><img src="nowhere.png" onerror="window.ran = 2"><iframe src="nowhere.html"></iframe>';
    try {
      await writeFile(path, (await readFile(new URL(url), "utf8")).replace("</header>", `${foreign}</header>`));
      const page = await open(browser, pathToFileURL(path).href);
      assert.equal(await page.evaluate(() => window.ran), undefined);
      assert.ok(page.said.some((line) => line.includes("Content Security Policy")), page.said.join());
      assert.ok(await page.locator("svg[data-plot] .overlay, figure button").count() > 0, "its own script ran");
      await page.context().close();
    } finally {
      await rm(folder, { recursive: true });
    }
  });
});
