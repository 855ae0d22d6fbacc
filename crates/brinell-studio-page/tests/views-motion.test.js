// Bearing, passage and sound with made-up data, and what all views do alike, in Chromium.
import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { BLUE, DAMAGE, GREEN, axe, curve, drawn, inked, on, saved, view } from "./views-page.js";

describe("the bearing", () => {
  const state = (page) =>
    page.locator("brinell-bearing").evaluate((node) => ({
      playing: node.playing,
      ring: node.motion.state.ring,
      at: node.motion.at,
      told: node.shadowRoot.querySelector(".readout").textContent,
    }));
  const wait = (page, frames) =>
    page.evaluate(async (n) => {
      for (let k = 0; k < n; k++) await new Promise(requestAnimationFrame);
    }, frames);

  it("is at rest where less motion is preferred, until it is asked", async () =>
    on({}, async (page) => {
      const first = await state(page);
      await wait(page, 12);
      assert.deepEqual(await state(page), first);
      await page.getByRole("button", { name: "1 turn" }).click();
      const jumped = await state(page);
      assert.equal(jumped.playing, false);
      await page.getByRole("button", { name: "Play" }).click();
      await wait(page, 12);
      const moved = await state(page);
      assert.equal(moved.playing, true);
      assert.notEqual(moved.ring, jumped.ring);
      await page.getByRole("button", { name: "Pause" }).click();
      const held = await state(page);
      await wait(page, 6);
      assert.equal((await state(page)).ring, held.ring);
    }));

  it("turns by itself where motion is welcome, as slowly as asked, and one turn on demand", async () =>
    on({ reducedMotion: "no-preference" }, async (page) => {
      const first = await state(page);
      await wait(page, 10);
      assert.notEqual((await state(page)).ring, first.ring);
      // A second at 1:100 is 0.01 s of 30 turns a second: three tenths of a turn.
      const turned = await page.locator("brinell-bearing").evaluate((node) => {
        node.set(false);
        node.slower = 100;
        node.motion.at = 0;
        node.motion.show(0);
        const from = node.motion.state.ring;
        for (let k = 0; k < 20; k++) node.advance(0.05);
        return (node.motion.state.ring - from) / (2 * Math.PI);
      });
      assert.ok(Math.abs(turned - 0.3) < 0.01, `${turned}`);
      await page.locator("brinell-bearing input").fill("20");
      await page.getByRole("button", { name: "1 turn" }).click();
      await page.locator('brinell-bearing[data-playing="false"]').waitFor();
    }));

  it("goes over into newer turns without a jump of ring and cage", async () =>
    on({}, async (page) => {
      const worst = await page.locator("brinell-bearing").evaluate((node) => {
        const motion = node.motion,
          wrap = (a, by) => Math.abs(a - by * Math.round(a / by)),
          turn = 2 * Math.PI;
        let worst = 0,
          t = 0.4,
          clips = 0,
          clip = motion.clip;
        for (let k = 0; k < 400; k++) {
          if (k % 4 === 0) {
            motion.push(window.made.frames(t, 40));
            t += 0.012;
          }
          const before = [motion.state.ring, motion.state.rows[0].cage];
          motion.go(2e-4);
          worst = Math.max(worst, wrap(motion.state.ring - before[0], turn), wrap(motion.state.rows[0].cage - before[1], turn / 19));
          if (motion.clip !== clip) {
            clips++;
            clip = motion.clip;
          }
        }
        return { worst, clips };
      });
      assert.ok(worst.clips >= 1, "a newer clip was taken");
      // A step is 0.04 rad of the ring.
      assert.ok(worst.worst < 0.13, `${worst.worst} rad`);
    }));

  it("shows the edited bearing while it is stopped, and takes no frames of another", async () =>
    on({}, async (page) => {
      const seen = await page.locator("brinell-bearing").evaluate((node) => {
        const made = window.made,
          most = () => node.motion.state.largest,
          ring = () => node.motion.state.ring;
        const heavy = (t) => {
          const f = made.frames(t, 40);
          for (const row of f.rows)
            row.outer_n.forEach((v, i) => {
              row.outer_n[i] = 3 * v;
            });
          return f;
        };
        const first = { most: most(), ring: ring() };
        // Without an edit, newer turns wait until the bearing moves.
        for (let k = 0; k < 12; k++) node.frames = made.frames(0.2 + 0.012 * k, 40);
        const same = most();
        node.damage = { defects: [] };
        node.frames = heavy(0.4);
        const early = most();
        // A stopped picture waits until what the edit upset has settled: four turns.
        for (let k = 1; k < 8; k++) node.frames = heavy(0.4 + 0.012 * k);
        const upset = most();
        for (let k = 8; k < 14; k++) node.frames = heavy(0.4 + 0.012 * k);
        const length = node.motion.length;
        node.frames = made.frames(0, 40, 3e-4, { ...made.geometry, elements: 13 });
        return { first, same, early, upset, late: most(), ring: ring(), ignored: node.motion.length === length };
      });
      assert.equal(seen.same, seen.first.most);
      assert.equal(seen.early, seen.first.most);
      assert.equal(seen.upset, seen.first.most);
      assert.ok(seen.late > 2 * seen.first.most, `${seen.late} N after ${seen.first.most} N`);
      assert.ok(Math.abs(Math.sin((seen.ring - seen.first.ring) / 2)) < 0.1, "the ring has hardly moved");
      assert.ok(seen.ignored);
    }));

  it("shows damage, forces and rows, and saves them", async () =>
    on({}, async (page) => {
      const canvas = page.locator("brinell-bearing canvas");
      const [damaged, outer, inner] = [await inked(canvas, DAMAGE), await inked(canvas, BLUE), await inked(canvas, GREEN)];
      assert.ok(damaged > 60 && outer > 300 && inner > 200, `${damaged} ${outer} ${inner}`);
      assert.match(
        await canvas.getAttribute("aria-label"),
        /2 rows of 19 rollers, load towards 0 degrees.*outer raceway, row 1, at 0 degrees; inner raceway, row 2/,
      );
      const { error, wrong, inks, words, png } = await saved(page, "brinell-bearing");
      assert.equal(error, null);
      assert.deepEqual(wrong, []);
      assert.ok(inks.includes("#d04a00") && inks.includes("#0072b2"));
      assert.ok(words.includes("row 1") && words.includes("row 2") && words.includes("load"), words.join("|"));
      assert.ok(png[0] >= 640);
      await page.getByRole("combobox", { name: "Row shown" }).selectOption({ label: "Row 2" });
      assert.ok(!(await saved(page, "brinell-bearing")).words.includes("row 1"));
      await page.locator("brinell-bearing").evaluate((node) => {
        node.damage = { defects: [] };
      });
      await drawn(page);
      assert.equal(await inked(canvas, DAMAGE), 0);
    }));

  it("takes balls in one row, and another number of them, while frames arrive", async () =>
    on({}, async (page) => {
      await page.locator("brinell-bearing").evaluate((node) => {
        const shape = {
          ...window.made.geometry,
          rows: 1,
          elements: 9,
          element: "ball",
          element_mm: 4.76,
          inner_mm: 18.5,
          outer_mm: 28,
          pitch_mm: 23.25,
        };
        node.geometry = shape;
        node.frames = window.made.frames(0, 40, 3e-4, shape);
      });
      await drawn(page);
      assert.match(await page.locator("brinell-bearing canvas").getAttribute("aria-label"), /1 row of 9 balls/);
      assert.equal(await page.getByRole("combobox", { name: "Row shown" }).count(), 0);
      assert.ok((await inked(page.locator("brinell-bearing canvas"), BLUE)) > 100);
    }));
});

describe("the passage", () => {
  it("draws length and force, reads them by keyboard, lists and saves them", async () =>
    on({}, async (page) => {
      const canvas = page.locator("brinell-passage canvas");
      assert.ok((await inked(canvas, BLUE)) > 300 && (await inked(canvas, GREEN)) > 300);
      await page.locator("brinell-passage .plot").focus();
      await page.keyboard.press("Home");
      assert.equal(await page.locator("brinell-passage .readout").textContent(), "−3 mm · contact 6 of 6 mm · 118 N");
      await page.keyboard.press("Shift+ArrowRight");
      assert.match(await page.locator("brinell-passage .readout").textContent(), /^−2.75 mm/);
      await page.locator("brinell-passage summary").click();
      await page.locator("brinell-passage tbody tr").first().waitFor();
      assert.equal(await page.locator("brinell-passage tbody tr").count(), 25);
      const { error, wrong, words, png } = await saved(page, "brinell-passage");
      assert.equal(error, null);
      assert.deepEqual(wrong, []);
      assert.ok(words.includes("Contact length, mm") && words.includes("Contact force, N"));
      assert.ok(png[0] >= 840);
    }));
});

describe("the sound", () => {
  const audio = (page) =>
    page.locator("brinell-sound").evaluate((node) => ({ context: node.context?.state ?? null, state: node.dataset.state }));

  it("is never heard before the click, then runs, takes newer loops over and ends", async () =>
    on({}, async (page) => {
      assert.deepEqual(await audio(page), { context: null, state: "silent" });
      await page.locator("brinell-sound").evaluate((node) => {
        node.loop = window.made.loop({ ticks: 90 });
      });
      assert.deepEqual(await audio(page), { context: null, state: "silent" });
      await page.getByRole("button", { name: "Hear" }).click();
      await page.locator('brinell-sound[data-state="sounding"]').waitFor();
      assert.equal((await audio(page)).context, "running");
      // Three loops at once: the last one sounds in the end, none is left over.
      await page.locator("brinell-sound").evaluate((node) => {
        for (const ticks of [80, 70, 60]) node.loop = window.made.loop({ ticks });
      });
      await page.waitForFunction(() => {
        const node = document.querySelector("brinell-sound");
        return node.voice?.loop === node.loop;
      });
      await page.getByRole("button", { name: "Hear" }).click();
      await page.waitForFunction(() => document.querySelector("brinell-sound").context.state === "suspended");
      assert.equal((await audio(page)).state, "silent");
    }));

  it("waits for a loop that is not there yet", async () =>
    on({}, async (page) => {
      await page.locator("brinell-sound").evaluate((node) => {
        node.loop = null;
      });
      await page.getByRole("button", { name: "Hear" }).click();
      await page.locator('brinell-sound[data-state="waiting"]').waitFor();
      await page.locator("brinell-sound").evaluate((node) => {
        node.loop = window.made.loop();
      });
      await page.locator('brinell-sound[data-state="sounding"]').waitFor();
    }));

  for (const rate of [25600, 4000]) {
    it(`gives back the ticks of a loop at ${rate} Hz at their own pace, beyond the loop's end`, async () =>
      on({}, async (page) => {
        const { rate_hz, x } = await page.evaluate(async (rate) => {
          const hz = 40,
            loop = window.made.loop({ rate_hz: rate, ticks: 16, hz });
          // A ringing that both rates hold.
          for (let i = 0; i < loop.x.length; i++) {
            const since = (((i * 16) / loop.x.length) % 1) / hz;
            loop.x[i] = 0.8 * Math.exp(-since * 400) * Math.sin(2 * Math.PI * 700 * since);
          }
          const sound = await customElements.get("brinell-sound").render(loop, 1.6);
          return { rate_hz: sound.sampleRate, x: Array.from(sound.getChannelData(0)) };
        }, rate);
        assert.ok(Math.abs(x.length / rate_hz - 1.6) < 1e-3);
        // The line of the envelope at a frequency, of what is rendered after the loop's first end (0.4 s).
        const part = x.slice(Math.round(0.5 * rate_hz), Math.round(1.5 * rate_hz));
        const line = (hz) =>
          Math.hypot(
            ...[Math.cos, Math.sin].map((f) => part.reduce((sum, v, i) => sum + Math.abs(v) * f((2 * Math.PI * hz * i) / rate_hz), 0)),
          );
        const at = line(40);
        for (const hz of [31, 35, 37, 43, 45, 50]) assert.ok(at > 10 * line(hz), `${at} at 40 Hz, ${line(hz)} at ${hz} Hz`);
        assert.ok(Math.max(...part.map(Math.abs)) <= 1);
      }));
  }
});

describe("every view", () => {
  // Colours do not depend on the width, nor places on the colours.
  for (const [width, colorScheme] of [
    [1280, "light"],
    [390, "dark"],
  ]) {
    it(`is without findings of axe, ${colorScheme}, ${width} px`, async () =>
      on({ width, colorScheme }, async (page) => {
        for (const node of await page.locator("details").all())
          await node.evaluate((d) => {
            d.open = true;
          });
        await page.waitForFunction(() =>
          [...document.querySelectorAll("brinell-curve")].every((c) => c.shadowRoot.querySelector("tbody tr")),
        );
        await page.evaluate(axe);
        const found = await page.evaluate(async () =>
          (await window.axe.run()).violations.map((v) => `${v.impact} ${v.id}: ${v.nodes.map((n) => n.target.join(" ")).slice(0, 3)}`),
        );
        assert.deepEqual(found, []);
        const sideways = await page.evaluate(() => document.documentElement.scrollWidth - document.documentElement.clientWidth);
        assert.ok(sideways <= 0, `${sideways} px aside`);
      }));
  }

  it("takes the page's scheme and colours", async () =>
    on({}, async (page) => {
      const own = () => page.locator("brinell-bearing").evaluate((node) => [node.getAttribute("scheme"), node.colours.blue]);
      assert.deepEqual(await own(), ["light", "#0072b2"]);
      await page.evaluate(() => {
        document.documentElement.style.colorScheme = "dark";
      });
      await page.locator('brinell-bearing[scheme="dark"]').waitFor();
      assert.deepEqual(await own(), ["dark", "#5db4ec"]);
      await page.evaluate(() => {
        document.documentElement.style.setProperty("--blue", "#123456");
      });
      await drawn(page);
      assert.deepEqual(await own(), ["dark", "#123456"]);
    }));

  it("fits its canvas to box and pixels", async () =>
    on({ width: 390, deviceScaleFactor: 3 }, async (page) => {
      for (const name of ["brinell-bearing", "brinell-passage", 'brinell-curve[kind="waveform"]']) {
        const sizes = () => page.locator(`${name} canvas`).evaluate((c) => [c.width, Math.round(c.getBoundingClientRect().width * 3)]);
        const [fine, shown] = await sizes();
        assert.ok(Math.abs(fine - shown) <= 3, `${name}: ${fine} for ${shown}`);
        await page.setViewportSize({ width: 360, height: 900 });
        await drawn(page);
        await drawn(page);
        const [narrow] = await sizes();
        assert.equal(fine - narrow, 90, name);
        await page.setViewportSize({ width: 390, height: 900 });
        await drawn(page);
      }
    }));

  it("draws on while data arrive for all of them", async (t) =>
    on({ reducedMotion: "no-preference" }, async (page) => {
      const { frames, seconds, drawings, ring } = await page.evaluate(async () => {
        const made = window.made,
          of = (s) => document.querySelector(s),
          sets = Array.from({ length: 3 }, (_, k) => ({
            waveform: made.waveform({ seed: k + 1 }),
            spectrum: made.spectrum({ seed: k + 1 }),
            envelope: made.envelope({ seed: k + 1 }),
          }));
        const parts = Array.from({ length: 20 }, (_, k) => made.frames(0.3 + 0.012 * k, 40)),
          curves = ["waveform", "spectrum", "envelope"].map((kind) => [kind, of(`[kind=${kind}]`)]);
        const ring = of("brinell-bearing").motion.state.ring,
          begun = performance.now();
        for (const [, node] of curves) node.redraws = { count: 0, ms: 0 };
        const frames = 60;
        for (let k = 0; k < frames; k++) {
          for (const [kind, node] of curves) node.data = { ...node.data, ...sets[k % 3][kind] };
          of("brinell-bearing").frames = parts[k % 20];
          await new Promise(requestAnimationFrame);
        }
        return {
          frames,
          seconds: (performance.now() - begun) / 1000,
          drawings: curves.map(([, node]) => node.redraws.count),
          ring: of("brinell-bearing").motion.state.ring !== ring,
        };
      });
      t.diagnostic(`${(frames / seconds).toFixed(0)} frames a second with three curves of 4097 to 8192 values and the bearing`);
      assert.ok(
        drawings.every((n) => n >= frames - 2),
        `${drawings}`,
      );
      assert.ok(ring);
    }));

  it("may leave the page and come back", async () =>
    on({}, async (page) => {
      await page.evaluate(() => {
        const column = document.querySelector(".column"),
          all = [...document.querySelectorAll("brinell-curve, brinell-bearing, brinell-passage, brinell-sound")];
        all.forEach((node) => node.remove());
        all.forEach((node) => column.append(node));
      });
      await drawn(page);
      assert.ok((await inked(curve(page, "waveform").locator("canvas"), BLUE)) > 500);
      assert.equal(await curve(page, "waveform").locator("canvas").count(), 1);
    }));
});
