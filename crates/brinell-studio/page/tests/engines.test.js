// Who has which engine: pages of one server, bearing B and the healthy one, and what happens while nobody answers.
import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { Healthy } from "../src/healthy.js";

const pause = (ms) => new Promise((done) => setTimeout(done, ms));

describe("the healthy bearing behind the curves", () => {
  const x = new Float32Array(512);
  /** Its requests, where bearing B takes the slot before the first of them (0), or while the nth is answered. */
  async function asked(nth) {
    const said = [];
    let free = true;
    const engine = { slots: true, ask: async (request) => {
      said.push(free ? request.do : `${request.do} of bearing B`);
      await pause(1);
      free &&= said.length !== nth;
      return { x, first: 0, rate_hz: 25600 };
    } };
    const healthy = new Healthy(async () => engine, 1, () => free, () => {});
    healthy.want({ defects: [{}] });
    free = nth !== 0;
    await pause(1300);
    return said;
  }

  it("leaves the slot to bearing B, whenever that comes", async () => {
    assert.deepEqual(await asked(0), []);
    assert.deepEqual(await asked(1), ["open"]);
    assert.deepEqual(await asked(3), ["open", "advance", "advance"]);
  });
});
