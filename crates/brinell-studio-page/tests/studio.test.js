// The studio's page: how it starts, draws, reads and keeps, in Chromium. Times are printed, not judged.
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { join, resolve } from "node:path";
import { describe, it } from "node:test";
import { open, quietly, running } from "./browser.js";
import { decode } from "../src/message.js";
import { ROOT, browser, server, file, folder, on } from "./packed.js";
import { drag, drop, moments, opened, place, saved, says, scenario, settled, start, type, until } from "./page.js";

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

  for (const [name, options] of [
    ["a window", {}],
    ["a phone", { width: 390, height: 844, hasTouch: true }],
  ])
    it(`shows no number of few samples and no force of the start, in ${name}`, async () => {
      // The stored run is in the page, and the engine, behind a server, waits before each slice for as long as it is held.
      const page = await open(browser, "about:blank", options);
      await page.route(`${server.url}?token=secret`, (route) => route.fulfill({ path: join(folder, "site/index.html") }));
      let slices = 0,
        samples = 0,
        hold = () => true;
      const waiting = [];
      const letOn = (until) => {
        hold = until;
        for (const go of waiting.splice(0)) go();
      };
      await page.route("**/ask?*", async (route) => {
        // The healthy bearing has the other slot.
        const asked = decode(new Uint8Array(route.request().postDataBuffer())),
          slice = asked.do === "advance" && asked.slot === 0;
        if (asked.do === "open" && asked.slot === 0) samples = 0;
        if (slice && hold()) await new Promise((done) => waiting.push(done));
        const response = await route.fetch();
        if (slice) {
          slices += 1;
          samples = decode(new Uint8Array(await response.body())).moments?.samples;
        }
        await route.fulfill({ response });
      });
      await page.goto(`${server.url}?token=secret`);
      const footer = (words) => until(page, (words) => document.querySelector("footer").textContent.includes(words), words),
        figures = async () => new Set(await page.locator("footer dd").allTextContents());
      const face = () =>
        page.locator("brinell-bearing").evaluate((node) => [node.motion.largest, node.shadowRoot.querySelector(".readout").textContent]);
      // It is open: the stored run's numbers are not its own.
      await footer("settling");
      assert.deepEqual(await figures(), new Set(["–"]));
      assert.deepEqual(await face(), [0, "at rest until it has settled"]);
      letOn(() => samples > 0);
      await footer("of a turn's 854 samples");
      assert.ok(slices > 4 && samples < 854, `${samples} samples in ${slices} slices`);
      assert.deepEqual(await figures(), new Set(["–"]));
      letOn(() => false);
      await until(page, () => /\d/.test(document.querySelector("footer dd")?.textContent));
      assert.ok((await page.evaluate(() => globalThis.brinellStudio.side.moments.samples)) >= 854);
      assert.equal((await figures()).has("–"), false);
      // Under 300 N the heaviest roller carries 85 N; all are pressed by 270 N where they start.
      const [face_n, raceway_n] = await page.evaluate(() => [
        document.querySelector("brinell-bearing").motion.largest,
        document.querySelector("brinell-raceway")._felt.heaviest,
      ]);
      assert.ok(face_n > 20 && face_n < 200 && raceway_n > 20 && raceway_n < 200, `${face_n} N, ${raceway_n} N`);
      assert.deepEqual(page.said, []);
      // The engine still answers: what a closed page would have got is an error that no test has.
      await page.unrouteAll({ behavior: "wait" });
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
      // The healthy bearing comes behind its curves.
      await until(page, () => document.querySelector('brinell-curve[kind="envelope"]').data?.behind);
    });
  });

  it("scratches the raceway while the bearing runs", async (t) =>
    on({ example: "healthy" }, async (page) => {
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
    on({ example: "healthy" }, async (page) => {
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
    on({ example: "healthy" }, async (page) => {
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
    on({ example: "healthy" }, async (page) => {
      await drop(page, "spall.jpg", Buffer.from("not a picture").toString("base64"));
      await page.waitForSelector("dialog[open]");
      await page.locator("dialog .field", { hasText: "Millimetres per pixel" }).locator("input[inputmode]").fill("0,02");
      await page.keyboard.press("Tab");
      await until(page, () => document.querySelector("dialog .trouble")?.textContent);
      await page.click('dialog button:has-text("Cancel")');
      await drop(page, "photo-spall.png", (await readFile(resolve(ROOT, "../brinell-studio/examples/photo-spall.png"))).toString("base64"));
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

  it("shows a photo with its outline, takes its scale from two clicks, and asks whether to replace or add", async () =>
    on({ example: "rectangle" }, async (page) => {
      const photo = (await readFile(resolve(ROOT, "../brinell-studio/examples/photo-spall.png"))).toString("base64");
      const chosen = async () => {
        await drop(page, "photo-spall.png", photo);
        await page.click('dialog button:has-text("Open")');
        await until(page, () => document.querySelector("dialog .photo img")?.naturalWidth);
      };
      const found = () => page.locator("dialog .photo .found").getAttribute("d");
      await chosen();
      assert.match(await page.textContent("dialog"), /The bearing is damaged already: 1 place\./);
      // 5 mm between clicks half the photo's width apart.
      const over = page.locator("dialog .photo svg"),
        { width, height } = await over.boundingBox(),
        columns = await page.locator("dialog .photo img").evaluate((node) => node.naturalWidth);
      await over.click({ position: { x: 0.25 * width, y: 0.5 * height } });
      await over.click({ position: { x: 0.75 * width, y: 0.5 * height } });
      await page.fill("#ask-length-between-two-clicks", "5");
      const scale = page.locator("dialog .field", { hasText: "Millimetres per pixel" }).locator("input[inputmode]"),
        known = Number(await scale.inputValue());
      assert.ok(Math.abs(known / (5 / (columns / 2)) - 1) < 0.01, `${known} mm per pixel`);
      await until(page, () => document.querySelector("dialog .photo .found").getAttribute("d"));
      // The outline lies in the photo, and follows a key.
      const box = await page.locator("dialog .photo .found").evaluate((node) => {
        const { x, y, width, height } = node.getBBox();
        return [x, y, x + width, y + height];
      });
      assert.ok(box[0] >= 0 && box[1] >= 0 && box[2] <= columns && box[2] - box[0] > 0.1 * columns, String(box));
      const before = await found();
      await type(page.locator("dialog .field", { hasText: "Threshold" }).locator("input[inputmode]"), "0.3");
      await until(page, (d) => !["", d].includes(document.querySelector("dialog .photo .found").getAttribute("d")), before);
      // Another scale takes the place of the clicks'.
      await type(scale, "0.02");
      await until(page, () => !document.querySelector("dialog .photo .bar").getAttribute("d"));
      // Enter does not answer the question.
      await scale.press("Enter");
      assert.ok(await page.isVisible("dialog"));
      await until(page, () => / mm²/.test(document.querySelector("dialog").textContent));
      await page.click('dialog button:has-text("Add to the damage")');
      await until(page, () => globalThis.brinellStudio.side.opened.scenario.defects?.length === 2);
      assert.deepEqual(
        (await scenario(page)).defects.map((d) => Object.keys(d.shape)[0]),
        ["rectangle", "outline"],
      );
      await chosen();
      await type(scale, "0.02");
      await page.click('dialog button:has-text("Replace the damage")');
      await until(page, () => globalThis.brinellStudio.side.opened.scenario.defects?.length === 1);
      assert.ok((await scenario(page)).defects[0].shape.outline);
      // One step back.
      await page.click('button:has-text("Undo")');
      await until(page, () => globalThis.brinellStudio.side.opened.scenario.defects?.length === 2);
    }));

  it("says by which law damage acts, and that its table is being computed", async () =>
    on({ example: "healthy" }, async (page) => {
      // Tables that somebody waits for.
      await page.evaluate(async () => {
        const engine = await globalThis.brinellStudio.side.live.engine,
          { aside } = engine;
        const gate = new Promise((done) => {
          globalThis.letGo = done;
        });
        engine.aside = async (...asked) => (await gate, aside.apply(engine, asked));
      });
      await page.click('[data-tool="circle"]');
      await drag(page, [0.5, 0.5], [0.51, 0.5]);
      await says(page, /^table is being computed, [1-9]\d* s$/);
      assert.match(await page.textContent("footer .note"), /^live, quick tables/);
      await page.click("#run");
      await says(page, /^table is being computed/);
      await page.evaluate(() => globalThis.letGo());
      await says(page, /^done$/);
      assert.doesNotMatch(await page.textContent("footer .note"), /quick/);
    }));

  it("carries a scenario in a link, a file and its memory", async () =>
    on({ example: "rectangle" }, async (page) => {
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
    on({ example: "rectangle" }, async (page) => {
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
});
