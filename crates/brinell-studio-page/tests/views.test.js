// The curves with made-up data, in Chromium.
import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { BLUE, curve, drawn, inked, on, plot, readout, view, saved } from "./views-page.js";

describe("curves", () => {
  for (const kind of ["waveform", "spectrum", "envelope"]) {
    it(`draws the ${kind}, and nothing when there is no data`, async () =>
      on({}, async (page) => {
        const canvas = curve(page, kind).locator("canvas");
        assert.ok((await inked(canvas, BLUE)) > 500);
        assert.equal(await curve(page, kind).locator(".empty").isVisible(), false);
        await curve(page, kind).evaluate((node) => {
          node.data = null;
        });
        await drawn(page);
        assert.equal(await inked(canvas, BLUE), 0);
        assert.equal(await curve(page, kind).locator(".empty").isVisible(), true);
      }));
  }

  it("leaves all of a record when the live window follows it, and keeps another zoom", async () =>
    on({}, async (page) => {
      const seen = await page.evaluate(() => {
        const node = document.querySelector("[kind=waveform]"),
          live = node.data,
          record = { ...live, ...window.made.waveform({ n: 8192 }), settled: 0.01 };
        const after = (/** @type {[number, number]} */ span) => {
          node.data = record;
          node.zoom(span);
          const zoomed = !!node.zoomed;
          node.data = null;
          node.data = live;
          return [zoomed, !!node.zoomed];
        };
        node.data = record;
        return { all: after(node.full()), part: after([0.01, 0.02]) };
      });
      assert.deepEqual(seen, { all: [true, false], part: [true, true] });
    }));

  it("draws once for each frame with new data, cheaply", async (t) =>
    on({}, async (page) => {
      for (const kind of ["waveform", "spectrum", "envelope"]) {
        const { frames, count, ms } = await page.evaluate(async (kind) => {
          const node = document.querySelector(`[kind=${kind}]`),
            made = window.made,
            sets = Array.from({ length: 4 }, (_, k) =>
              kind === "waveform"
                ? made.waveform({ n: 8192, seed: k + 1, shift: k / 100 })
                : made[kind]({ n: 8193, seed: k + 1, df: 12800 / 8192 }),
            );
          node.redraws = { count: 0, ms: 0 };
          const frames = 40;
          for (let k = 0; k < frames; k++) {
            // Twice in a frame is drawn once.
            for (let i = 0; i < 2; i++) node.data = { ...node.data, ...sets[(k + i) % 4] };
            await new Promise(requestAnimationFrame);
          }
          await new Promise(requestAnimationFrame);
          return { frames, ...node.redraws };
        }, kind);
        t.diagnostic(`${kind}: ${(ms / count).toFixed(2)} ms for a redraw of 8192 values`);
        assert.ok(count >= frames - 1 && count <= frames + 2, `${count} drawings in ${frames} frames`);
      }
    }));

  it("zooms by a drag, keeps the zoom when data arrive, goes back on a double click", async () =>
    on({}, async (page) => {
      const home = await view(page, "envelope"),
        over = curve(page, "envelope").locator(".over"),
        box = await over.boundingBox();
      await page.mouse.move(box.x + 0.25 * box.width, box.y + 40);
      await page.mouse.down();
      await page.mouse.move(box.x + 0.4 * box.width, box.y + 50, { steps: 4 });
      assert.ok((await curve(page, "envelope").locator(".select").boundingBox()).width > 0.1 * box.width);
      await page.mouse.up();
      await drawn(page);
      const zoomed = await view(page, "envelope"),
        wide = home[1] - home[0];
      assert.ok(
        Math.abs(zoomed[0] - home[0] - 0.25 * wide) < 0.01 * wide && Math.abs(zoomed[1] - home[0] - 0.4 * wide) < 0.01 * wide,
        `${zoomed} of ${home}`,
      );
      await page.evaluate(() => {
        const node = document.querySelector("[kind=envelope]");
        node.data = { ...node.data, ...window.made.envelope({ seed: 77 }) };
      });
      await drawn(page);
      assert.deepEqual(await view(page, "envelope"), zoomed);
      await page.mouse.dblclick(box.x + 100, box.y + 40);
      await drawn(page);
      assert.deepEqual(await view(page, "envelope"), home);
    }));

  it("reads values with units under the pointer, of B and of the healthy bearing too", async () =>
    on({}, async (page) => {
      await page.evaluate(() => {
        const node = document.querySelector("[kind=envelope]");
        node.data = { ...node.data, second: window.made.envelope({ size: 0.5, seed: 4 }) };
      });
      await drawn(page);
      const box = await curve(page, "envelope").locator(".over").boundingBox(),
        [from, to] = await view(page, "envelope");
      await page.mouse.move(box.x + (box.width * (249.5 - from)) / (to - from), box.y + 60);
      const text = await readout(page, "envelope");
      assert.match(text, /^2(49|50)[\d.]* Hz · [\d.]+ m\/s² · B [\d.]+ · healthy [\d.]+ · BPFO$/);
      // The curve's own value, from the data that were set.
      const [hz, value] = text.match(/[\d.]+/g).map(Number);
      const own = await page.evaluate((hz) => {
        const { values, dx } = document.querySelector("[kind=envelope]").data;
        return values[Math.round(hz / dx)];
      }, hz);
      assert.ok(Math.abs(value - own) < 1e-3 * own, `${value} for ${own}`);
      await page.mouse.move(5, 5);
      assert.equal(await readout(page, "envelope"), "");
    }));

  it("is worked by the keyboard", async () =>
    on({}, async (page) => {
      await plot(page, "envelope").focus();
      const home = await view(page, "envelope");
      await page.keyboard.press("PageDown");
      await page.keyboard.press("PageDown");
      await page.keyboard.press("PageDown");
      assert.match(await readout(page, "envelope"), /BPFO$/);
      const before = Number.parseFloat(await readout(page, "envelope"));
      await page.keyboard.press("Shift+ArrowRight");
      const after = Number.parseFloat(await readout(page, "envelope"));
      assert.ok(after > before + 20, `${before} to ${after}`);
      await page.keyboard.press("ArrowLeft");
      assert.ok(Number.parseFloat(await readout(page, "envelope")) < after);
      await page.keyboard.press("+");
      await drawn(page);
      const near = await view(page, "envelope");
      assert.ok(Math.abs((near[1] - near[0]) / (home[1] - home[0]) - 0.5) < 0.01);
      for (let k = 0; k < 40; k++) await page.keyboard.press("Shift+ArrowRight");
      await drawn(page);
      assert.ok((await view(page, "envelope"))[0] > near[0], "the view goes with the cursor");
      await page.keyboard.press("0");
      await drawn(page);
      assert.deepEqual(await view(page, "envelope"), home);
      await page.keyboard.press("l");
      await drawn(page);
      assert.equal(await curve(page, "envelope").getByRole("button", { name: "dB" }).getAttribute("aria-pressed"), "true");
    }));

  it("shows a spectrum in dB", async () =>
    on({}, async (page) => {
      await curve(page, "spectrum").getByRole("button", { name: "dB" }).click();
      await drawn(page);
      assert.match(await curve(page, "spectrum").locator(".title").textContent(), /dB re 1 m\/s²/);
      const { range, most } = await curve(page, "spectrum").evaluate((node) => ({
        range: node.range,
        most: Math.max(...node.data.values),
      }));
      const top = 20 * Math.log10(most);
      assert.ok(range[0] < top && range[1] > top && range[1] - top < 40, `${range} for ${top}`);
      assert.equal(await curve(page, "waveform").getByRole("button", { name: "dB" }).count(), 0);
    }));

  it("lists the marked lines, and says in words what is found", async () =>
    on({}, async (page) => {
      await curve(page, "envelope").locator("summary").click();
      const rows = curve(page, "envelope").locator("tbody tr");
      await rows.first().waitFor();
      const cells = await rows.evaluateAll((all) => all.map((row) => [...row.children].map((cell) => cell.textContent)));
      assert.deepEqual(
        cells.map((row) => row[0]),
        ["BPFO", "BPFO ×2", "BPFO ×3", "BPFO ×4", "BPFO ×5", "BPFI", "BSF", "FTF"],
      );
      assert.deepEqual(cells[1].slice(1, 3), ["499", "500.2"]);
      const value = await page.evaluate(() => {
        const { values, dx } = document.querySelector("[kind=envelope]").data;
        return values[Math.round(499 / dx)];
      });
      assert.ok(Math.abs(Number(cells[1][3]) - value) < 1e-3 * value);
      assert.equal(cells[5].at(-2), "not found");
      await page
        .locator('brinell-curve[kind="envelope"] [aria-label*="BPFO at 249.5 Hz, nominal 250.1 Hz, 5 harmonics, 20.1 dB"]')
        .waitFor({ state: "attached" });
    }));

  it("saves SVG that parses and a PNG, with curve, axes and labels", async () =>
    on({}, async (page) => {
      for (const kind of ["waveform", "spectrum", "envelope"]) {
        const { error, wrong, words, paths, png } = await saved(page, `[kind=${kind}]`);
        assert.equal(error, null);
        assert.deepEqual(wrong, []);
        assert.ok(
          paths.some((d) => d.length > 2000),
          "the curve",
        );
        assert.ok(words.some((w) => /m\/s²/.test(w)) && words.some((w) => /(ms|k?Hz)$/.test(w)), words.join("|"));
        if (kind === "envelope") for (const label of ["BPFO", "×2", "×5", "BPFI"]) assert.ok(words.includes(label), label);
        assert.ok(png[0] >= 960 && png[1] >= 400, `${png}`);
      }
    }));
});

describe("a zoomed envelope", () => {
  it("marks where the nominal frequency is beside the one found", async () =>
    on({}, async (page) => {
      assert.ok(!(await saved(page, "[kind=envelope]")).words.includes("nominal BPFO"), "too near to be told apart at first");
      await curve(page, "envelope").evaluate((node) => {
        node.zoom([240, 260]);
      });
      await drawn(page);
      const { words, title } = await saved(page, "[kind=envelope]");
      assert.ok(words.includes("BPFO") && words.includes("nominal BPFO"), words.join("|"));
      assert.match(title, /Shown: 240 to 260 Hz/);
      // A view without the first harmonic still names the family.
      await curve(page, "envelope").evaluate((node) => {
        node.zoom([450, 800]);
      });
      await drawn(page);
      const next = (await saved(page, "[kind=envelope]")).words;
      assert.ok(next.includes("BPFO ×2") && next.includes("×3"), next.join("|"));
    }));
});
