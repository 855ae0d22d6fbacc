// The studio's page, driven in Chromium. STUDIO_WASM names the engine's module; times are printed, not judged.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtemp, readFile, rm } from "node:fs/promises";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { after, before, describe, it } from "node:test";
import { pathToFileURL } from "node:url";
import { WASM, launch, open, quietly, running, serve } from "./browser.js";
import { drag, drop, moments, opened, place, saved, says, scenario, settled, start, type, until } from "./page.js";

const ROOT = resolve(import.meta.dirname, ".."),
  AXE = createRequire(import.meta.url).resolve("axe-core/axe.min.js");
let browser, server, folder, file;

before(async () => {
  browser = await launch();
  server = await serve();
  folder = await mkdtemp(join(tmpdir(), "brinell-studio-"));
  execFileSync(process.execPath, [join(ROOT, "pack.mjs"), "--wasm", WASM, "-o", folder]);
  file = pathToFileURL(join(folder, "brinell-studio.html")).href;
});
after(async () => {
  await browser?.close();
  server?.close();
  if (folder) await rm(folder, { recursive: true });
});

const on = (options, look) => quietly(browser, server.url, options, look);

describe("the page", () => {
  it("shows a stored run before its engine is there", async (t) => {
    // Nothing is compiled until the test lets it.
    const before = () => {
      const { compile, compileStreaming } = WebAssembly,
        waiting = new Promise((done) => {
          globalThis.letGo = done;
        });
      WebAssembly.compile = async (...given) => (await waiting, compile(...given));
      WebAssembly.compileStreaming = async (...given) => (await waiting, compileStreaming(...given));
    };
    const page = await open(browser, file, { before });
    await until(
      page,
      () => document.querySelector('brinell-curve[kind="envelope"]')?.data?.stored && document.querySelector("#controls input"),
    );
    t.diagnostic(`usable, with the stored curves, ${Math.round(await page.evaluate(() => performance.now()))} ms after the window opened`);
    await says(page, /stored run/);
    assert.match(await page.textContent("footer"), /^Stored run, shown while the engine loads/);
    // What is edited before is in the bearing that runs then.
    await page.click('[data-tool="circle"]');
    await drag(page, [0.7, 0.5], [0.71, 0.5]);
    await page.evaluate(() => globalThis.letGo());
    await until(
      page,
      () => globalThis.brinellStudio.side.live.opened?.scenario.defects?.length === 2 && globalThis.brinellStudio.side.spectra,
    );
    assert.ok(!(await page.evaluate(() => document.querySelector('brinell-curve[kind="envelope"]').data?.stored)));
    assert.deepEqual(page.said, []);
    await page.context().close();
  });

  it("opens from disk without network", async (t) => {
    const from = performance.now();
    await quietly(browser, file, { offline: true }, async (page) => {
      t.diagnostic(`first spectrum ${Math.round(performance.now() - from)} ms after the window opened`);
      await says(page, /^live$/);
      // It still runs.
      const end = await page.evaluate(() => globalThis.brinellStudio.side.trace.end);
      await until(page, (n) => globalThis.brinellStudio.side.trace.end !== n, end);
    });
  });

  it("scratches the raceway while the bearing runs", async (t) =>
    on({}, async (page) => {
      await start(page, "healthy");
      await until(page, () => globalThis.brinellStudio.side.live.opened.carried);
      const healthy = await moments(page, 2000);
      await page.click('[data-tool="pen"]');
      await page.fill(".narrow-number", "1.5");
      await page.mouse.move(...(await place(page, 0.47, 0.5)));
      await page.mouse.down();
      const times = [];
      for (let k = 1; k <= 8; k++) {
        // From the pointer's move to the bearing that has the stroke.
        await page.evaluate(() => {
          const { side } = globalThis.brinellStudio,
            { toml } = side.opened,
            canvas = document.querySelector("brinell-raceway canvas");
          globalThis.drawn = new Promise((done) =>
            canvas.addEventListener(
              "pointermove",
              () => {
                const from = performance.now(),
                  look = () => (side.opened.toml === toml ? setTimeout(look, 1) : done(performance.now() - from));
                look();
              },
              { once: true },
            ),
          );
        });
        // To and fro, as the engine leaves out points that lie close.
        await page.mouse.move(...(await place(page, 0.47 + 0.005 * k, k % 2 ? 0.38 : 0.62)));
        times.push(await page.evaluate(() => globalThis.drawn));
      }
      await page.mouse.up();
      t.diagnostic(`a stroke is in the running bearing after ${Math.round(times.sort((a, b) => a - b)[4])} ms (median of 8)`);
      const from = performance.now();
      await until(page, () => globalThis.brinellStudio.side.opened.scenario.defects?.length === 1);
      const [defect] = (await scenario(page)).defects;
      assert.equal(defect.on, "outer-raceway");
      assert.ok(defect.shape.outline, "a scratch is an outline");
      await until(
        page,
        () =>
          globalThis.brinellStudio.side.moments.samples > 4500 &&
          globalThis.brinellStudio.side.spectra.lines?.some((l) => l.name === "BPFO" && l.found),
      );
      t.diagnostic(`BPFO is found ${Math.round(performance.now() - from)} ms later`);
      // A line's place in the first moments is no better than their length, and it may be lost again when the spectrum becomes twice as fine.
      const { damaged, line } = await (
        await until(page, () => {
          const { moments, spectra } = globalThis.brinellStudio.side,
            line = spectra.lines?.find((l) => l.name === "BPFO" && l.found);
          return moments.samples > 9000 && line && { damaged: moments, line };
        })
      ).jsonValue();
      // Up to 2 % below pure rolling: the cage slips while it starts, and the first half second has no other revolutions.
      assert.ok(line.hz / line.nominal_hz > 0.98 && line.hz / line.nominal_hz < 1.005, `${line.hz} Hz beside ${line.nominal_hz}`);
      t.diagnostic(`kurtosis ${healthy.kurtosis.toFixed(1)} without damage, ${damaged.kurtosis.toFixed(1)} with`);
      // How impulsive it is follows from where the scratch lies and from what swings: no evidence here.
      assert.ok(damaged.rms > 2 * healthy.rms, `${JSON.stringify(healthy)} to ${JSON.stringify(damaged)}`);
      // One stroke is one step back.
      await page.click('button:has-text("Undo")');
      await until(page, () => !globalThis.brinellStudio.side.opened.scenario.defects?.length);
      await page.click('button:has-text("Redo")');
      await until(page, () => globalThis.brinellStudio.side.opened.scenario.defects?.length === 1);
    }));

  it("draws with every tool, moves and sizes what is drawn", async () =>
    on({}, async (page) => {
      await start(page, "healthy");
      const count = (n) => until(page, (k) => globalThis.brinellStudio.side.opened.scenario.defects?.length === k, n);
      for (const [k, tool] of ["rectangle", "circle", "paper", "brush", "pen"].entries()) {
        await page.click(`[data-tool="${tool}"]`);
        await drag(page, [0.1 + 0.15 * k, 0.4], [0.13 + 0.15 * k, 0.6], 4);
        await count(k + 1);
      }
      await page.click('[data-tool="points"]');
      for (const [x, y] of [
        [0.9, 0.4],
        [0.93, 0.4],
        [0.93, 0.6],
      ])
        await page.mouse.click(...(await place(page, x, y)));
      await page.mouse.dblclick(...(await place(page, 0.9, 0.6)));
      await count(6);
      const kinds = (await scenario(page)).defects.map((d) => Object.keys(d.shape)[0]);
      assert.deepEqual(kinds, ["rectangle", "circle", "li2023_irregular", "depth_map", "outline", "outline"]);
      // By its middle it is moved, by its handle sized; the other end stays.
      await page.click('[data-tool="select"]');
      const before = (await scenario(page)).defects[0];
      await drag(page, [0.115, 0.5], [0.165, 0.5], 4);
      await settled(page);
      const moved = (await scenario(page)).defects[0];
      assert.ok(moved.center_deg > before.center_deg + 2, `${before.center_deg} to ${moved.center_deg}`);
      assert.equal(moved.shape.rectangle.length_mm, before.shape.rectangle.length_mm);
      await drag(page, [0.18, 0.5], [0.2, 0.5], 4);
      await settled(page);
      const wider = (await scenario(page)).defects[0];
      assert.ok(wider.shape.rectangle.length_mm > 1.3 * moved.shape.rectangle.length_mm, JSON.stringify(wider));
    }));

  it("ends and takes back what its tools draw", async () =>
    on({}, async (page) => {
      await start(page, "healthy");
      const count = (n) => until(page, (k) => (globalThis.brinellStudio.side.opened.scenario.defects?.length ?? 0) === k, n);
      // A double click is one circle of 3 mm.
      await page.click('[data-tool="circle"]');
      await page.mouse.dblclick(...(await place(page, 0.2, 0.5)));
      await count(1);
      await settled(page);
      assert.deepEqual(
        (await scenario(page)).defects.map((d) => d.shape),
        [{ circle: { diameter_mm: 3 } }],
      );
      // Escape takes back a drag that has begun.
      await page.mouse.move(...(await place(page, 0.4, 0.5)));
      await page.mouse.down();
      await page.mouse.move(...(await place(page, 0.43, 0.5)), { steps: 4 });
      await until(page, () => globalThis.brinellStudio.side.store.scenario.defects.length === 2);
      await page.keyboard.press("Escape");
      await page.mouse.up();
      await settled(page);
      await count(1);
      // Corners: Backspace takes one back, two are no outline, Enter closes three.
      await page.click('[data-tool="points"]');
      for (const [x, y] of [
        [0.6, 0.4],
        [0.63, 0.4],
        [0.7, 0.5],
      ])
        await page.mouse.click(...(await place(page, x, y)));
      await page.keyboard.press("Backspace");
      await page.keyboard.press("Enter");
      assert.equal((await scenario(page)).defects.length, 1);
      await page.mouse.click(...(await place(page, 0.63, 0.6)));
      await page.keyboard.press("Enter");
      await count(2);
      assert.equal(
        (await scenario(page)).defects[1].shape.outline.points_mm?.length ??
          (await scenario(page)).defects[1].shape.outline.polygons_mm[0].length,
        3,
      );
      // The brush says what it adds and how deep the map has become.
      await page.click('[data-tool="brush"]');
      await page.fill('[aria-label="Depth that the brush adds, µm"]', "7");
      await page.locator("brinell-raceway canvas").focus();
      await page.keyboard.press("Escape");
      await drag(page, [0.8, 0.4], [0.82, 0.6], 4);
      await count(3);
      await until(page, () => /^deepest [67]/.test(document.querySelector(".chosen output")?.textContent ?? ""));
    }));

  it("takes photos and drawings of damage, and says why it does not take junk", async () =>
    on({}, async (page) => {
      await start(page, "healthy");
      await drop(page, "spall.jpg", Buffer.from("not a picture").toString("base64"));
      await page.waitForSelector("dialog[open]");
      await page.locator("dialog .field", { hasText: "Millimetres per pixel" }).locator("input[inputmode]").fill("0,02");
      await page.keyboard.press("Tab");
      await until(page, () => document.querySelector("dialog .trouble")?.textContent);
      await page.click('dialog button:has-text("Cancel")');
      await drop(page, "photo-spall.png", (await readFile(resolve(ROOT, "../examples/photo-spall.png"))).toString("base64"));
      await page.click('dialog button:has-text("Open")');
      // What was not requested yet is no error.
      await until(page, () => /Still needed/.test(document.querySelector("dialog")?.textContent ?? ""));
      assert.equal(await page.textContent("dialog .trouble"), "");
      const scale = page.locator("dialog .field", { hasText: "Millimetres per pixel" }).locator("input[inputmode]");
      await type(scale, "0,02");
      // The light evened out, as the reader does since it takes photographs under uneven light: 8.937 mm2; with one threshold it was 8.92.
      await until(page, () => /8\.9[34]\d* mm²/.test(document.querySelector("dialog")?.textContent ?? ""));
      await scale.press("Enter");
      await until(page, () => globalThis.brinellStudio.side.opened.scenario.defects?.length === 1);
      assert.ok((await scenario(page)).defects[0].shape.outline);
    }));

  it("carries a scenario in a link, a file and its memory", async () =>
    on({}, async (page) => {
      await start(page, "rectangle");
      await page.click('[data-tool="circle"]');
      await drag(page, [0.7, 0.5], [0.71, 0.5]);
      await until(page, () => globalThis.brinellStudio.side.opened.scenario.defects.length === 2);
      await settled(page);
      const { toml } = await opened(page),
        file = await saved(page, "Scenario");
      assert.equal(file.text, toml);
      await page.click("#share");
      await page.waitForSelector('[data-kind="link"] input');
      const link = await page.inputValue('[data-kind="link"] input');
      assert.doesNotMatch(await page.textContent('[data-kind="link"]'), /server/);
      assert.match(link, /#s=[\w-]+$/);
      // The link in a browser that knows nothing; the plain address in this one, which remembers.
      const other = await open(browser, link);
      await running(other);
      assert.equal((await opened(other)).toml, toml);
      await other.context().close();
      await page.goto(server.url);
      await running(page);
      assert.equal((await opened(page)).toml, toml);
      await start(page, "healthy");
      await drop(page, "mine.toml", Buffer.from(toml).toString("base64"));
      await until(page, (text) => globalThis.brinellStudio.side.opened.toml === text, toml);
    }));

  it("saves the signal of a run from t = 0", async (t) =>
    on({}, async (page) => {
      await start(page, "rectangle");
      const from = performance.now(),
        { text } = await saved(page, "Signals, CSV"),
        { samples } = await opened(page);
      t.diagnostic(`run and saved in ${Math.round(performance.now() - from)} ms`);
      const lines = text.trim().split("\n");
      assert.match(lines[0], /^t,/);
      assert.ok(Math.abs(lines.length - 1 - samples) <= 1, `${lines.length} lines for ${samples} samples`);
      await says(page, /^done$/);
      await page.click("#pause");
      await says(page, /^live$/);
    }));

  it("compares A with B in two Workers", async () =>
    on({}, async (page) => {
      await start(page, "healthy");
      const before = (await opened(page)).scenario;
      await page.click("#side-b");
      await until(page, () => globalThis.brinellStudio.sides[1]?.opened && globalThis.brinellStudio.side.name === "B");
      assert.ok(
        await page.evaluate(
          async () => (await globalThis.brinellStudio.sides[0].live.engine) !== (await globalThis.brinellStudio.sides[1].live.engine),
        ),
      );
      await page.click('[data-tool="rectangle"]');
      await drag(page, [0.45, 0.3], [0.5, 0.7]);
      await until(
        page,
        () => globalThis.brinellStudio.sides[1].opened.scenario.defects?.length === 1 && globalThis.brinellStudio.sides[1].spectra,
      );
      await page.click("#both");
      await until(page, () => document.querySelectorAll("footer .name").length === 2);
      await until(page, () =>
        /^B against A: damage at BPFO in B alone; .*RMS × /.test(document.querySelector("footer .differ").textContent),
      );
      // By its keys: at the end of its run A was opened anew from them, and JSON has no 300.0, which the text of the file has.
      assert.deepEqual(await page.evaluate(() => globalThis.brinellStudio.sides[0].opened.scenario), before);
      // Curve and marks are of the bearing that is edited.
      const shown = (name) =>
        until(
          page,
          (name) => {
            const { data } = document.querySelector('brinell-curve[kind="envelope"]') ?? {},
              side = globalThis.brinellStudio.sides.find((one) => one.name === name);
            return (
              data?.second &&
              data.values === side.spectra.envelope.values &&
              data.lines === side.spectra.lines &&
              data.names[0].startsWith(name)
            );
          },
          name,
        );
      await shown("B");
      await page.click("#side-a");
      assert.deepEqual((await scenario(page)).defects ?? [], []);
      await shown("A");
    }));

  it("judges a measured signal by what is given and by nothing of the page", async () =>
    on({}, async (page) => {
      // Bursts of a rolling 6205's inner race, one of them far above the others.
      const turn = 12000 / (1730 / 60),
        burst = (k) => Math.sin(k * 1.5) * Math.exp(-(k % Math.round(turn / 5.415)) / 12);
      const rows = Array.from({ length: 24000 }, (_, k) => (k === 12000 ? 300 : burst(k) + 0.1 * Math.sin(k * k))).join("\n");
      const dropped = (name) => drop(page, name, Buffer.from(`x\n${rows}\n`).toString("base64"));
      const judge = () => page.click('dialog button:has-text("Judge")');
      await dropped("measured.csv");
      await page.selectOption("dialog select", "signal");
      await page.click('dialog button:has-text("Open")');
      await page.waitForSelector("#ask-bearing");
      for (const id of ["sampling-rate", "unit", "bearing", "speed-of-the-shaft"])
        assert.equal(await page.inputValue(`#ask-${id}`), "", id);
      assert.doesNotMatch(await page.textContent("dialog"), /null/);
      assert.match(await page.textContent("#ask-bearing"), /6205-2RS.*this page's bearing: NN3007/);
      await judge();
      assert.ok(await page.isVisible("dialog"), "nothing is judged without rate, bearing and speed");
      await page.fill("#ask-sampling-rate", "12000");
      await page.fill("#ask-speed-of-the-shaft", "1730");
      await page.selectOption("#ask-bearing", "6205-2RS");
      await page.fill("#ask-unit", "furlong");
      await judge();
      await page.waitForSelector('dialog [role="alert"]:has-text("no unit is called `furlong`")');
      assert.match(await page.textContent("dialog h2"), /measured\.csv/);
      await page.fill("#ask-unit", "g");
      await page.press("#ask-unit", "Enter");
      await page.waitForSelector("#measured:not([hidden]) table");
      await until(page, () => document.querySelector('brinell-curve[kind="spectrum"]').data?.second);
      assert.match(
        await page.textContent("#measured .used"),
        /^bearing: .*6205-2RS.*; shaft speed 1730 r\/min, as given.*; sample rate 12000 Hz, as given; unit g, as given; channel x: /,
      );
      assert.match(await page.textContent("#measured .trouble"), /^Warning: .*of the signal's energy lie in one revolution/);
      assert.match(await page.textContent("#measured .levels"), /^rms .* g, peak .* g/);
      assert.match(await page.textContent("#measured"), /; curves in m\/s²/);
      // What is no acceleration has its own axes alone.
      await dropped("measured.csv");
      await page.selectOption("dialog select", "signal");
      await page.click('dialog button:has-text("Open")');
      for (const [id, value] of [
        ["sampling-rate", "12000"],
        ["unit", "V"],
        ["speed-of-the-shaft", "1730,0"],
      ])
        await page.fill(`#ask-${id}`, value);
      await page.selectOption("#ask-bearing", "6205-2RS");
      await judge();
      await page.waitForSelector('#measured:has-text("in V: it cannot be laid beside")');
      await until(page, () => !document.querySelector('brinell-curve[kind="spectrum"]').data?.second);
      assert.equal(await page.evaluate(() => document.querySelector('#measured brinell-curve[kind="spectrum"]').data.unit), "V");
      // What goes wrong with another file takes that verdict away and names the file; what goes well takes the complaint away.
      await drop(page, "broken.wav", Buffer.from("no sound").toString("base64"));
      await page.waitForSelector('[data-kind="failed"]:has-text("broken.wav")');
      assert.ok(await page.isHidden("#measured"));
      await dropped("measured.csv");
      await page.waitForSelector("dialog[open]");
      assert.equal(await page.locator('[data-kind="failed"]').count(), 0);
    }));

  it("leaves what was typed of a measured signal when another channel is chosen", async () =>
    on({}, async (page) => {
      const rows = Array.from({ length: 4000 }, (_, k) => `${Math.sin(k)},${Math.cos(k)}`).join("\n");
      await drop(page, "two.csv", Buffer.from(`x,y\n${rows}\n`).toString("base64"));
      await page.selectOption("dialog select", "signal");
      await page.click('dialog button:has-text("Open")');
      await page.waitForSelector("#ask-channel");
      await page.fill("#ask-sampling-rate", "12000");
      await page.fill("#ask-unit", "g");
      await page.fill("#ask-speed-of-the-shaft", "12 00");
      await page.fill("#ask-speed-of-the-shaft", "");
      await page.selectOption("#ask-channel", { index: 1 });
      assert.deepEqual(
        await page.evaluate(() => ["sampling-rate", "unit", "speed-of-the-shaft"].map((id) => document.getElementById(`ask-${id}`).value)),
        ["12000", "g", ""],
      );
      assert.match(await page.textContent("dialog"), /as typed/);
      // A time is not below 0.
      await page.fill("#ask-counts-from", "0.1");
      await page.press("#ask-counts-from", "ArrowDown");
      assert.equal(await page.inputValue("#ask-counts-from"), "0.09");
      await page.fill("#ask-counts-from", "0");
      await page.press("#ask-counts-from", "ArrowDown");
      assert.equal(await page.inputValue("#ask-counts-from"), "0");
    }));

  it("is usable with the keyboard alone", async () =>
    on({}, async (page) => {
      await start(page, "healthy");
      await page.evaluate(() => document.activeElement.blur());
      const at = () => page.evaluate(() => document.activeElement?.closest("brinell-raceway") !== null);
      for (let k = 0; k < 60 && !(await at()); k++) await page.keyboard.press("Tab");
      assert.ok(await at(), "the raceway is reached");
      await page.keyboard.press("r");
      await page.keyboard.press("Enter");
      await until(page, () => globalThis.brinellStudio.side.opened.scenario.defects?.length === 1);
      const drawn = (await scenario(page)).defects[0];
      // Arrows move what the raceway shows.
      await page.locator('brinell-raceway canvas[aria-label*="1 damaged place"]').waitFor();
      await page.keyboard.press("ArrowRight");
      await page.keyboard.press("Shift+ArrowRight");
      await page.keyboard.press("ArrowUp");
      await page.keyboard.press("]");
      await settled(page);
      const moved = (await scenario(page)).defects[0];
      assert.ok(Math.abs(moved.center_deg - drawn.center_deg - 11) < 0.01, `${drawn.center_deg} to ${moved.center_deg}`);
      assert.equal(moved.axial_offset_mm, 0.1);
      assert.ok(moved.depth_um > drawn.depth_um);
      await settled(page);
      await page.keyboard.press("Delete");
      await until(page, () => !globalThis.brinellStudio.side.opened.scenario.defects?.length);
      await page.keyboard.press("Control+z");
      await until(page, () => globalThis.brinellStudio.side.opened.scenario.defects?.length === 1);
      // A scratch: pen down, along, pen up.
      await settled(page);
      await page.locator('brinell-raceway canvas[aria-label*="1 damaged place"]').waitFor();
      for (const key of ["p", "Enter", "ArrowRight", "ArrowRight"]) await page.keyboard.press(key);
      // A stroke that ends before the engine has seen it leaves nothing.
      const two = () => until(page, () => globalThis.brinellStudio.side.opened.scenario.defects?.length === 2);
      await two();
      await page.keyboard.press("Enter");
      await settled(page);
      await two();
      const waiting = page.waitForEvent("download");
      await page.focus("#save");
      await page.keyboard.press("Enter");
      await page.keyboard.press("Enter");
      assert.match((await waiting).suggestedFilename(), /\.toml$/);
      await page.evaluate(() => document.activeElement.blur());
      await page.keyboard.press("?");
      await page.waitForSelector('dialog[open]:has-text("Keys and gestures")');
    }));

  for (const [name, options] of [
    ["light", {}],
    ["dark", { colorScheme: "dark" }],
    ["390 px", { width: 390, height: 844 }],
  ]) {
    it(`has no serious finding of axe, ${name}`, async (t) =>
      on(options, async (page) => {
        await page.evaluate(() => document.querySelector("#controls > details").toggleAttribute("open"));
        await page.addScriptTag({ path: AXE });
        const found = await page.evaluate(async () =>
          (await globalThis.axe.run()).violations.map(
            (v) =>
              `${v.impact} ${v.id}: ${v.nodes
                .slice(0, 4)
                .map((n) => n.target.join(" "))
                .join(", ")}`,
          ),
        );
        for (const one of found) t.diagnostic(one);
        assert.deepEqual(
          found.filter((f) => /^(serious|critical)/.test(f)),
          [],
        );
      }));
  }

  it("is at rest where little motion is preferred", async () => {
    for (const reducedMotion of ["reduce", "no-preference"]) {
      await on({ reducedMotion }, async (page) => {
        const look = () => page.evaluate(() => globalThis.brinellStudio.panel.raceway.instant?.rows[0].orbit[0]);
        const first = await look(),
          from = await page.evaluate(() => globalThis.brinellStudio.side.trace.end);
        await until(page, (n) => Math.abs(globalThis.brinellStudio.side.trace.end - n) > 2000, from);
        assert.equal((await look()) === first, reducedMotion === "reduce", reducedMotion);
      });
    }
  });

  it("needs no scrolling aside at 390 px, and a finger draws", async () =>
    on({ width: 390, height: 844, hasTouch: true }, async (page) => {
      const [scroll, client] = await page.evaluate(() => [document.documentElement.scrollWidth, document.documentElement.clientWidth]);
      assert.ok(scroll <= client, `${scroll} px wide in ${client}`);
      await start(page, "healthy");
      await page.locator("brinell-raceway canvas").scrollIntoViewIfNeeded();
      const cdp = await page.context().newCDPSession(page);
      const touch = async (type, ...points) =>
        cdp.send("Input.dispatchTouchEvent", {
          type,
          touchPoints: await Promise.all(
            points.map(async (p, id) => {
              const [x, y] = await place(page, ...p);
              return { x, y, id };
            }),
          ),
        });
      await touch("touchStart", [0.4, 0.5]);
      for (let k = 1; k < 10; k++) await touch("touchMove", [0.4 + 0.02 * k, 0.5]);
      await touch("touchEnd");
      await until(page, () => globalThis.brinellStudio.side.opened.scenario.defects?.length === 1);
      // Two fingers move the view and draw nothing.
      await touch("touchStart", [0.3, 0.5]);
      await touch("touchStart", [0.3, 0.5], [0.7, 0.5]);
      for (let k = 1; k < 10; k++) await touch("touchMove", [0.3 - 0.02 * k, 0.5], [0.7 + 0.02 * k, 0.5]);
      await touch("touchEnd");
      await settled(page);
      assert.equal((await scenario(page)).defects.length, 1);
    }));

  it("goes on with the same bearing when its Worker is killed", async (t) =>
    on({}, async (page) => {
      await start(page, "rectangle");
      await until(page, () => globalThis.brinellStudio.side.trace.end > 3000);
      const toml = (await opened(page)).toml,
        took = await page.evaluate(async () => {
          const { side } = globalThis.brinellStudio,
            from = performance.now(),
            engine = await side.live.engine;
          await side.live.kill();
          while ((await side.live.engine) === engine || side.live.state !== "live" || side.trace.end < 1)
            await new Promise((done) => setTimeout(done, 10));
          return performance.now() - from;
        });
      t.diagnostic(`runs again ${Math.round(took)} ms after the kill`);
      assert.equal((await opened(page)).toml, toml);
      await page.waitForSelector('[data-kind="lost"]');
    }));

  it("says so where the browser cannot run the engine", async () => {
    const page = await open(browser, server.url, {
      before: () => {
        delete globalThis.WebAssembly;
      },
    });
    await page.waitForSelector('[data-kind="engine"]');
    assert.match(await page.textContent('[data-kind="engine"]'), /WebAssembly/);
    await says(page, /^no WebAssembly$/);
    await page.context().close();
  });

  it("is the same page before a server's engine", async () =>
    quietly(browser, `${server.url}?token=secret`, {}, async (page) => {
      await says(page, /^live$/);
      assert.equal(page.workers().length, 0);
      await page.click('[data-tool="circle"]');
      await drag(page, [0.7, 0.5], [0.71, 0.5]);
      await until(page, () => globalThis.brinellStudio.side.opened.scenario.defects.length === 2);
      await page.click("#side-b");
      await until(page, () => globalThis.brinellStudio.sides[1]?.opened && globalThis.brinellStudio.sides[1].trace.end > 500);
      assert.notEqual(
        await page.evaluate(() => globalThis.brinellStudio.sides[0].live.slot),
        await page.evaluate(() => globalThis.brinellStudio.sides[1].live.slot),
      );
      // Its link opens where the server is: with the token.
      await page.click("#share");
      assert.match(await page.inputValue('[data-kind="link"] input'), /\?token=secret#s=/);
    }));
});
