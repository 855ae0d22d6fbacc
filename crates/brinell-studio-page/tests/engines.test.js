// Who has which engine: pages of one server, bearing B and the healthy one, and what happens while nobody answers.
import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { Healthy } from "../src/healthy.js";
import { decode, encode } from "../src/message.js";
import { Pace } from "../src/pace.js";
import { ServerEngine } from "../src/server-engine.js";

const pause = (ms) => new Promise((done) => setTimeout(done, ms));

describe("the healthy bearing behind the curves", () => {
  const x = new Float32Array(512);
  /** Its requests, where bearing B takes the slot before the first of them (0), or while the nth is answered. */
  async function asked(nth) {
    const said = [];
    let free = true;
    const engine = {
      slots: true,
      ask: async (request) => {
        said.push(free ? request.do : `${request.do} of bearing B`);
        await pause(1);
        free &&= said.length !== nth;
        return { x, first: 0, rate_hz: 25600 };
      },
    };
    const healthy = new Healthy(
      async () => engine,
      1,
      () => free,
      () => {},
    );
    healthy.want({ defects: [{}] });
    free = nth !== 0;
    await pause(1300);
    return said;
  }

  it("leaves the slot to bearing B, whenever that comes", async () => {
    assert.deepEqual(await Promise.all([0, 1, 3].map(asked)), [[], ["open"], ["open", "advance", "advance"]]);
  });
});

describe("the pace of slices", () => {
  it("comes to a tenth of a second, whatever a step takes, and back", () => {
    const pace = new Pace(),
      slice = (step_ms, needed) => {
        const steps = Math.min(needed, pace.steps),
          ms = step_ms * steps;
        pace.took(ms, steps < needed);
        return ms;
      };
    for (let k = 0; k < 20; k++) slice(0.01, 1e9);
    assert.ok(Math.abs(slice(0.01, 1e9) - 100) < 1, `${pace.steps} steps`);
    // An edit makes a step a hundred times as long: a few slices later it is bounded again.
    for (let k = 0; k < 6; k++) slice(1, 1e9);
    assert.ok(slice(1, 1e9) < 110);
    for (let k = 0; k < 20; k++) slice(0.001, 2000);
    assert.equal(slice(0.001, 2000), 2, "as many as its rows need");
  });
});

describe("an engine behind a server", () => {
  /** @type {Record<string, () => void>} */
  const heard = {};
  const beacons = [];
  Object.assign(globalThis, {
    location: { search: "?token=secret" },
    addEventListener: (kind, act) => {
      heard[kind] = act;
    },
  });
  Object.defineProperty(globalThis, "navigator", {
    value: { sendBeacon: (address) => beacons.push(address) },
    configurable: true,
  });
  /** Requests of a page whose server answers with these, one after the other: a status, or null where it cannot be reached. */
  function before(answers) {
    const asked = [];
    globalThis.fetch = async (address, { body }) => {
      const status = answers.shift();
      asked.push([new URL(address, "http://localhost").searchParams, decode(body).do]);
      if (status === null) throw new TypeError("Failed to fetch");
      return { ok: status === 200, status, arrayBuffer: async () => encode({ ok: true }).buffer };
    };
    return { asked, engine: new ServerEngine() };
  }

  it("says which page asks, when it begins and when it is closed", async () => {
    const { asked, engine } = before([200, 200, 200, 200]);
    for (const request of ["about", "open", "advance"]) await engine.ask({ do: request });
    const page = asked[0][0].get("new");
    assert.match(page, /^[0-9a-f]{16}$/);
    assert.deepEqual(
      asked.map(([query]) => `${query}`),
      [`token=secret&new=${page}`, `token=secret&new=${page}`, `token=secret&page=${page}`],
    );
    heard.pagehide({ persisted: false });
    assert.deepEqual(beacons, [`ask?token=secret&closed=${page}`]);
    await new ServerEngine().ask({ do: "about" });
    assert.notEqual(asked[3][0].get("new"), page, "another page has another name");
  });

  it("asks again where the server cannot be reached for a moment", async () => {
    const { asked, engine } = before([null, null, 200]),
      from = performance.now();
    assert.deepEqual(await engine.ask({ do: "advance" }), { ok: true });
    assert.equal(asked.length, 3);
    assert.ok(performance.now() - from > 400);
  });

  it("says plainly that other pages have its engine", async () => {
    const { asked, engine } = before([410]);
    await assert.rejects(engine.ask({ do: "advance" }), (error) => error.gone && /four pages at a time.*Start again/.test(error.message));
    assert.equal(asked.length, 1, "it does not take the engine back by itself");
  });
});
