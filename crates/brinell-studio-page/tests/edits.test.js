// Edits of a scenario on the studio's page: what is taken, what is refused, and what runs meanwhile. Driven in Chromium, as studio.test.js is.
import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { short } from "../src/chart.js";
import { digitsOf, numberOf, stepped } from "../src/dom.js";
import { fromLink } from "../src/state.js";
import { quietly } from "./browser.js";
import { drag, drop, holds, opened, saved, says, scenario, start, type, until } from "./page.js";
import { browser, server } from "./served.js";

// The bearing has run on: an edit before would have reached it.
const ran = async (page) =>
  until(
    page,
    (n) => globalThis.brinellStudio.side.trace.end > n + 1000,
    await page.evaluate(() => globalThis.brinellStudio.side.trace.end),
  );
const on = (options, look) => quietly(browser, server.url, options, look);

describe("edits", () => {
  it("gives another bearing a load and a name that fit it, and says that damage stays", async () =>
    on({ example: "rectangle" }, async (page) => {
      await page.selectOption("#preset", "bearing:NU2205");
      await page.click("#load");
      // A tenth of C0 = 34 kN, to one digit, as `brinell init --bearing NU2205` has it, in the direction that was there; 300 N are the NN3007's.
      await until(page, () => globalThis.brinellStudio.side.opened.scenario.bearing.preset === "NU2205");
      const { name, operation } = (await opened(page)).scenario;
      assert.deepEqual([name, operation.load_n], ["NU2205", [3000, 0]]);
      // A name that somebody gave stays.
      await page.evaluate(() =>
        globalThis.brinellStudio.side.store.change((s) => {
          s.name = "pump";
        }),
      );
      await page.selectOption("#preset", "bearing:6205");
      await page.click("#load");
      await page.waitForSelector('[data-kind="kept"]:has-text("6205")');
      assert.equal((await scenario(page)).name, "pump");
      assert.match(
        await page.textContent('[data-kind="kept"]'),
        /^6205 under 800 N, .*It has the damage that was drawn before: 1 place, at the same angles and of the same size\./,
      );
      await page.click('[data-kind="kept"] button:has-text("Remove the damage")');
      await until(page, () => !globalThis.brinellStudio.side.opened.scenario.defects?.length);
    }));

  it("loads an example again, changes nothing on the way along the list, and keeps an edit that has no answer yet", async () =>
    on({ example: "rectangle" }, async (page) => {
      const speed = page.getByLabel("Speed", { exact: true }),
        runs = (rpm) => until(page, (rpm) => globalThis.brinellStudio.side.opened.scenario.operation.speed_rpm === rpm, rpm);
      await type(speed, "1500");
      await runs(1500);
      await start(page, "rectangle");
      await runs(1800);
      await page.selectOption("#preset", "example:circle");
      await ran(page);
      assert.equal((await opened(page)).scenario.name, "rectangle");
      // The engine does not answer any more.
      await page.evaluate(() => globalThis.brinellStudio.side.live.kill());
      await type(speed, "1450");
      await page.reload();
      await page.waitForFunction(() => globalThis.brinellStudio?.side?.opened);
      await runs(1450);
      // A link does not come back after an edit.
      await page.click("#share");
      await page.waitForSelector('[data-kind="link"] input');
      assert.match(page.url(), /#s=/);
      await type(speed, "1440");
      await runs(1440);
      assert.doesNotMatch(page.url(), /#/);
    }));

  it("cancels a run, and says at once that nothing was saved of it", async () =>
    on({ example: "run-up" }, async (page) => {
      assert.equal(await page.getByLabel("Speed", { exact: true }).getAttribute("placeholder"), "varies: 2 points");
      await page.click("#save");
      await page.click('#save-list button:has-text("CSV")');
      await says(page, /^running/);
      await page.click('#run:has-text("Cancel")');
      await page.waitForSelector('[data-kind="failed"]:has-text("nothing was saved")');
      await says(page, /^live$/);
      await page.click("#run");
      await says(page, /^running/);
      await page.keyboard.press("Escape");
      await says(page, /^live$/);
      assert.match(await page.textContent("#run"), /^Run 0.6 s$/);
    }));

  it("shows the surface on which undo and redo act", async () =>
    on({ example: "rectangle" }, async (page) => {
      await page.click('[data-surface="inner-raceway"]');
      await page.click('[data-tool="circle"]');
      await drag(page, [0.4, 0.5], [0.42, 0.5]);
      await page.click('[data-surface="outer-raceway"]');
      await page.click('#damage button:has-text("Undo")');
      assert.equal(await page.getAttribute('[data-surface="inner-raceway"]', "aria-pressed"), "true");
    }));

  it("takes 100 edits in 2 s, and the last one wins", async (t) =>
    on({ example: "rectangle" }, async (page) => {
      const { frames, asked } = await page.evaluate(async () => {
        let frames = 0,
          going = true;
        const count = () => {
          frames++;
          if (going) requestAnimationFrame(count);
        };
        requestAnimationFrame(count);
        const input = [...document.querySelectorAll(".chosen .field")]
          .find((f) => f.textContent.startsWith("Depth"))
          .querySelector("input[type=range]");
        for (let k = 1; k <= 100; k++) {
          input.value = String(100 + 2 * k);
          input.dispatchEvent(new Event("input", { bubbles: true }));
          await new Promise((done) => setTimeout(done, 20));
        }
        going = false;
        return { frames, asked: globalThis.brinellStudio.side.store.scenario.defects[0].depth_um };
      });
      assert.ok(asked > 30, `${asked} µm`);
      await until(page, (asked) => globalThis.brinellStudio.side.opened.scenario.defects[0].depth_um === asked, asked);
      assert.ok(frames > 10, `${frames} frames`);
      t.diagnostic(
        `${frames} frames while 100 edits were made; the last was open after ${await page.evaluate(() => Math.round(globalThis.brinellStudio.side.took))} ms`,
      );
      await page.evaluate(() => document.activeElement.blur());
      // One step back, or some on a machine so slow that the edits were no stroke.
      const depth = () => page.evaluate(() => globalThis.brinellStudio.side.store.scenario.defects[0].depth_um);
      for (let k = 0; k < 100 && (await depth()) !== 20; k++) await page.keyboard.press("Control+z");
      await until(page, () => globalThis.brinellStudio.side.opened.scenario.defects[0].depth_um === 20);
    }));

  it("says what is wrong beside the control, while the last good bearing runs on", async () =>
    on({ example: "rectangle" }, async (page) => {
      const field = page.locator(".chosen .field", { hasText: "Width" }),
        input = field.locator("input[inputmode]");
      await type(input, "99");
      await until(page, () => document.querySelector('.chosen [aria-invalid="true"]'));
      const alert = field.locator('[role="alert"]');
      assert.match(await alert.textContent(), /wider than the roller/);
      assert.equal((await opened(page)).scenario.defects[0].shape.rectangle.width_mm, 4);
      await ran(page);
      await says(page, /last good/);
      // Nor does Run take what was there before.
      await page.click("#run");
      await page.waitForSelector('[data-kind="unsaved"]');
      await says(page, /last good/);
      await type(input, "5");
      await until(
        page,
        () =>
          !document.querySelector('.chosen [aria-invalid="true"]') &&
          globalThis.brinellStudio.side.opened.scenario.defects[0].shape.rectangle.width_mm === 5,
      );
      assert.equal(await alert.textContent(), "");
      await says(page, /^live$/);
    }));

  it("takes a number when it is whole, and none that may be another", async () =>
    on({}, async (page) => {
      for (const [text, value] of [
        ["0,5", 0.5],
        ["1500,5", 1500.5],
        [" −3.25e2 ", -325],
        ["0,125", 0.125],
        ["1,", 1],
      ])
        assert.equal(numberOf(text), value);
      for (const text of ["1,234", "-12,345", "25 Hz", "1.2.3", "", "-"]) assert.equal(typeof numberOf(text), "string", text);
      await start(page, "rectangle");
      const speed = page.getByLabel("Speed", { exact: true }),
        stated = async () => (await scenario(page)).operation.speed_rpm;
      // No part of it runs.
      await speed.fill("30");
      await ran(page);
      assert.equal(await stated(), 1800);
      await type(speed, "1796,3");
      assert.equal(await stated(), 1796.3);
      await speed.press("ArrowUp");
      assert.equal(await stated(), 1797.3);
      await type(speed, "1,234");
      await page.waitForSelector('#controls [role="alert"]:has-text("may be 1.234 or 1234")');
      await page.click("#run");
      await page.waitForSelector('[data-kind="unsaved"]:has-text("Speed")');
      await says(page, /^live$/);
      assert.equal(await stated(), 1797.3);
      await type(speed, "1500");
      await until(page, () => globalThis.brinellStudio.side.opened.scenario.operation.speed_rpm === 1500);
      await type(speed, "25,5 Hz");
      await until(page, () => globalThis.brinellStudio.side.opened.all.operation.speed_rpm === 1530);
      const shown = () => until(page, () => [...document.querySelectorAll("#controls input")].some((one) => one.value === "1530"));
      await shown();
      // The same again is shown in the field's unit again.
      await type(speed, "25,5Hz");
      await shown();
      await type(speed, "1,250 Hz");
      await page.waitForSelector('#controls [role="alert"]:has-text("may be 1.250 or 1250 (Hz)")');
    }));

  it("shows as many digits as an interval needs", () => {
    for (const [ends, words] of [
      [
        [162.22, 162.33],
        ["162.22", "162.33"],
      ],
      [
        [107, 113],
        ["107", "113"],
      ],
      [
        [-1.25, 1.5],
        ["−1.25", "1.5"],
      ],
      [
        [0.012341, 0.012349],
        ["0.012341", "0.012349"],
      ],
    ])
      assert.deepEqual(
        ends.map((end) => short(end, digitsOf(...ends))),
        words,
      );
  });

  it("takes load and angle in other units, keeps what was typed until it is opened, and a name as it is", async () =>
    on({ example: "rectangle" }, async (page) => {
      const field = (label) => page.getByLabel(label, { exact: true }),
        load = (wanted) =>
          until(
            page,
            (wanted) => JSON.stringify(globalThis.brinellStudio.side.opened.scenario.operation.load_n) === wanted,
            JSON.stringify(wanted),
          );
      await type(field("Load"), "0,4 kN");
      await load([400, 0]);
      await holds(field("Load"), "400");
      for (const [text, wanted] of [
        ["45 deg", [282.8427, 282.8427]],
        ["90°", [0, 400]],
        ["0 rad", [400, 0]],
      ]) {
        await type(field("Load at angle"), text);
        await load(wanted);
      }
      await type(field("Load"), "3 stone");
      await page.waitForSelector('#controls [role="alert"]:has-text("allowed: N, kN, lbf")');
      await type(field("Load"), "300 N");
      await load([300, 0]);
      // While the speed is refused nothing is opened.
      await type(field("Speed"), "1800 stone");
      await page.waitForSelector('#controls [aria-invalid="true"]');
      await type(field("Noise, RMS"), "0.1 g");
      await ran(page);
      assert.equal(await field("Noise, RMS").inputValue(), "0.1 g");
      await type(field("Speed"), "1797");
      await until(page, () => globalThis.brinellStudio.side.opened.all.sensor?.noise_rms_m_per_s2 > 0.9);
      await until(page, () => [...document.querySelectorAll("#controls input")].some((one) => one.value === "0.980665"));
      await page.evaluate(() => {
        for (const one of document.querySelectorAll("#controls details")) one.open = true;
      });
      await type(field("Name"), "12");
      await until(page, () => globalThis.brinellStudio.side.opened.scenario.name === "12");
    }));

  it("shares and saves what was typed last, and nothing that is refused", async () =>
    on({ example: "rectangle" }, async (page) => {
      const speed = page.getByLabel("Speed", { exact: true }),
        tap = (id) => page.evaluate((id) => document.getElementById(id).click(), id);
      // As a finger does: the focus stays in the field.
      await speed.fill("1450");
      await tap("share");
      await page.waitForSelector('[data-kind="link"] input');
      assert.match(await fromLink(new URL(await page.inputValue('[data-kind="link"] input')).hash), /1450/);
      await speed.fill("1460");
      assert.match((await saved(page, "Scenario")).text, /1460/);
      await speed.fill("1470");
      const { text } = await saved(page, "Signals, CSV");
      assert.ok(text.length > 1000);
      assert.equal((await opened(page)).scenario.operation.speed_rpm, 1470);
      await page.click("#pause");
      await says(page, /^live$/);
      const width = page.locator(".chosen .field", { hasText: "Width" }).locator("input[inputmode]"),
        before = page.url();
      await width.fill("99");
      await tap("share");
      await page.waitForSelector('[data-kind="unsaved"]:has-text("refused")');
      assert.equal(page.url(), before);
      assert.match(await page.textContent('.chosen [role="alert"]:not(:empty)'), /wider than the roller/);
    }));

  it("says that a server does not answer, and saves nothing that it did not open", async () =>
    quietly(browser, `${server.url}?token=secret`, { example: "rectangle" }, async (page) => {
      await page.route("**/ask*", (route) => route.abort());
      await page.waitForSelector('[data-kind="lost"]:has-text("The server does not answer. Start again tries once more")');
      await type(page.getByLabel("Speed", { exact: true }), "1450");
      await page.click("#save");
      await page.click('#save-list button:has-text("Scenario")');
      await page.waitForSelector('[data-kind="unsaved"]:has-text("neither saved nor shared")');
      assert.doesNotMatch(await page.textContent("#notices"), /continues/);
      // It answers again: what was typed meanwhile is opened.
      await page.unroute("**/ask*");
      await page.click("#pause");
      await until(
        page,
        () =>
          globalThis.brinellStudio.side.opened.scenario.operation.speed_rpm === 1450 && globalThis.brinellStudio.side.live.state === "live",
      );
      assert.match((await saved(page, "Scenario")).text, /1450/);
      page.said = page.said.filter((words) => !/ERR_FAILED/.test(words));
    }));

  it("leaves a field empty that must be stated, and takes the number that was there again", async () =>
    on({ example: "rectangle" }, async (page) => {
      const speed = page.getByLabel("Speed", { exact: true }),
        good = () =>
          until(page, () => !globalThis.brinellStudio.side.problems.length && !document.querySelector('#controls [aria-invalid="true"]'));
      for (const again of ["Enter", "Tab"]) {
        await type(speed, "");
        await page.waitForSelector('#controls [aria-invalid="true"]');
        await ran(page);
        assert.equal(await speed.inputValue(), "");
        await speed.click();
        await page.keyboard.type("1800");
        await page.keyboard.press(again);
        await good();
        assert.equal((await scenario(page)).operation.speed_rpm, 1800);
        await page.evaluate(() => document.activeElement.blur());
      }
      // The load's parts tell no angle where it is 0, and none is turned by a sign.
      const load = page.getByLabel("Load", { exact: true }),
        angle = page.getByLabel("Load at angle", { exact: true });
      await type(angle, "45");
      await type(load, "-300");
      await page.waitForSelector('#controls [role="alert"]:has-text("a load is 0 or more")');
      await type(load, "0");
      await type(load, "300");
      await until(page, () => Math.abs(globalThis.brinellStudio.side.store.scenario.operation.load_n[1] - 212.132) < 0.01);
      await holds(angle, "45");
    }));

  it("takes typed text back before an edit, and leaves none to another bearing", async () =>
    on({ example: "rectangle" }, async (page) => {
      const speed = page.getByLabel("Speed", { exact: true }),
        load = page.getByLabel("Load", { exact: true });
      const stated = async () => [(await scenario(page)).operation.speed_rpm, (await scenario(page)).operation.load_n[0]];
      const shows = (field, value) =>
        until(
          page,
          ([name, value]) =>
            [...document.querySelectorAll("#controls .field")]
              .find((f) => f.querySelector("label")?.textContent === name)
              ?.querySelector("input[inputmode]").value === value,
          [field, value],
        );
      await type(speed, "1600");
      await load.fill("450");
      await page.keyboard.press("Control+z");
      await holds(load, "300");
      assert.deepEqual(await stated(), [1600, 300]);
      await type(load, "1,234");
      await page.waitForSelector('#controls [role="alert"]:has-text("may be")');
      await page.click('#damage button:has-text("Undo")');
      await holds(load, "300");
      assert.deepEqual(await stated(), [1600, 300]);
      await page.keyboard.press("Control+z");
      assert.deepEqual(await stated(), [1800, 300]);
      await type(load, "abc");
      await drop(page, "same.toml", Buffer.from((await opened(page)).toml).toString("base64"));
      await shows("Load", "300");
      await type(load, "xyz");
      await page.click("#side-b");
      await shows("Load", "300");
      assert.equal(await page.locator('#controls [aria-invalid="true"]').count(), 0);
    }));

  it("steps by a digit of the number, and not below what is allowed", async () => {
    for (const [from, way, to] of [
      [0.4, -1, 0.3],
      [0.4, 1, 0.5],
      [1, -1, 0.9],
      [0.9, 1, 1],
      [0.1, -1, 0.09],
      [1800, 1, 1801],
      [0, 1, 1],
      [-0.4, -1, -0.5],
      [-1, 1, -0.9],
    ])
      assert.equal(stepped(from, way, 1), to, `${from}, ${way}`);
    await on({ example: "rectangle" }, async (page) => {
      const width = page.locator(".chosen .field", { hasText: "Width" }).locator("input[inputmode]");
      await type(width, "0.2");
      for (let k = 0; k < 3; k++) await width.press("ArrowDown");
      assert.equal((await scenario(page)).defects[0].shape.rectangle.width_mm, 0.08);
    });
  });

  it("leaves nothing of a file that is refused, and says why", async () =>
    on({ example: "rectangle" }, async (page) => {
      await drop(page, "wrong.toml", Buffer.from("preset = ").toString("base64"));
      await page.waitForSelector('[data-kind="refused"]:has-text("wrong.toml is refused")');
      await says(page, /^live$/);
    }));
});
