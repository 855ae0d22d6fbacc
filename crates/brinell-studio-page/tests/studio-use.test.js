// The studio's page: two bearings, measured signals, keys, fingers and lost engines, in Chromium. Times are printed, not judged.
import assert from "node:assert/strict";
import { createRequire } from "node:module";
import { describe, it } from "node:test";
import { open, quietly } from "./browser.js";
import { browser, server, file, on } from "./packed.js";
import { drag, drop, opened, place, says, scenario, settled, start, type, until } from "./page.js";

const AXE = createRequire(import.meta.url).resolve("axe-core/axe.min.js");

describe("the page in use", () => {
  it("compares A with B in two Workers", async () =>
    on({ example: "healthy" }, async (page) => {
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
              data.values === side.equal?.envelope.values &&
              data.lines === side.equal.lines &&
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

  it("compares A with B by spectra of equally many samples, from B's first curve on", async () =>
    on({ example: "healthy" }, async (page) => {
      await until(page, () => globalThis.brinellStudio.side.moments?.samples > 9000);
      await page.click("#both");
      for (const kind of ["spectrum", "envelope"]) {
        const shown = await until(
          page,
          (kind) => {
            const data = document.querySelector(`brinell-curve[kind="${kind}"]`).data;
            return data?.second && [data.values.length, data.second.values.length, data.dx, data.second.dx];
          },
          kind,
        );
        const [own, theirs, dx, dx2] = await shown.jsonValue();
        assert.deepEqual([own, dx], [theirs, dx2], kind);
      }
    }));

  it("keeps notices in one line and the verdict in sight", async () =>
    on({}, async (page) => {
      // Each of these has something to say.
      await page.selectOption("#preset", "bearing:NU2205");
      await page.click("#load");
      await page.waitForSelector('[data-kind="kept"]');
      await page.click("#share");
      await page.waitForSelector('[data-kind="link"]');
      await drop(page, "broken.wav", Buffer.from("no sound").toString("base64"));
      await page.waitForSelector('[data-kind="failed"]');
      assert.equal(await page.locator("#notices > .notice:visible").count(), 1);
      assert.equal(await page.locator("#notices > .notice").count(), 3);
      const low = () => page.locator("footer .headline").evaluate((node) => node.getBoundingClientRect().bottom);
      assert.ok((await low()) <= 900, `the verdict ends at ${await low()} px of 900`);
      const all = page.locator("#notices > .all");
      assert.equal(await all.textContent(), "2 more");
      await all.click();
      assert.equal(await page.locator("#notices > .notice:visible").count(), 3);
      await all.click();
      assert.equal(await page.locator("#notices > .notice:visible").count(), 1);
      // The one that is closed makes room for the one before.
      await page.click('[data-kind="failed"] [aria-label="Close this notice"]');
      await page.waitForSelector('[data-kind="link"]');
      assert.equal(await all.textContent(), "1 more");
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
      assert.match(await page.textContent("#ask-bearing"), /6205-2RS.*unknown: lines as of any damaged race.*this page's bearing: NN3007/);
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
      // Where nobody knows the bearing.
      await page.selectOption("dialog select", "signal");
      await page.click('dialog button:has-text("Open")');
      for (const [id, value] of [
        ["sampling-rate", "12000"],
        ["unit", "g"],
        ["speed-of-the-shaft", "1730"],
      ])
        await page.fill(`#ask-${id}`, value);
      await page.selectOption("#ask-bearing", "unknown");
      await judge();
      await page.waitForSelector('#measured:not([hidden]):has-text("no bearing is given")');
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
    on({ example: "healthy" }, async (page) => {
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
        const look = () => page.evaluate(() => globalThis.brinellStudio.panel.raceway.instant.rows[0].orbit[0]);
        await until(page, () => globalThis.brinellStudio.panel.raceway.instant);
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
    on({ example: "rectangle" }, async (page) => {
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
