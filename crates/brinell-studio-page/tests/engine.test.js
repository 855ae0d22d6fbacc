// The engine's module without a page: no imports, the same bits in every engine of JavaScript and however a run is cut, and its cost.
import assert from "node:assert/strict";
import { createHash } from "node:crypto";
import { readFileSync, writeFileSync } from "node:fs";
import { resolve } from "node:path";
import { before, describe, it } from "node:test";
import { hosted } from "../host.js";
import { WASM } from "./browser.js";

const FILE = resolve(import.meta.dirname, "golden.json");
/** Steps, evaluations and the beginning of the SHA-256 of the sensor's acceleration (single precision) of 0.1 s. simd128 rounds alike everywhere, so these change with the engine's arithmetic alone;
 * then GOLDEN=write records them anew. */
const GOLDEN = JSON.parse(readFileSync(FILE, "utf8"));

/** An example as the recorded bits have it: with the paper's laws, but where these know no damage, under balls and where rollers tilt. */
const recorded = (/** @type {string} */ toml) =>
  /preset = "6|model = "tilting"/.test(toml) ? toml : toml.replace("[simulation]\n", '[simulation]\nlaws = "li2023"\n');

describe("the engine as WebAssembly", () => {
  /** @type {WebAssembly.Module} */
  let module;
  before(async () => {
    module = await WebAssembly.compile(readFileSync(WASM));
  });

  /** Opens an example for 0.1 s and runs it in slices. */
  function run(/** @type {any} */ ask, /** @type {string} */ toml, /** @type {number} */ rows) {
    const { scenario } = ask({ do: "normal", toml });
    scenario.simulation = { ...scenario.simulation, duration_s: 0.1 };
    ask({ do: "open", slot: 0, scenario });
    const hash = createHash("sha256");
    for (let done = false; !done;) {
      const answer = ask({ do: "advance", slot: 0, rows });
      hash.update(new Uint8Array(answer.x.buffer, answer.x.byteOffset, answer.x.byteLength));
      done = answer.done;
    }
    const { steps, evaluations } = ask({ do: "indicators", slot: 0 });
    return { steps, evaluations, sha256: hash.digest("hex").slice(0, 16) };
  }

  it("has no imports", () => assert.deepEqual(WebAssembly.Module.imports(module), []));

  it("computes the recorded bits, in whatever slices", async (t) => {
    const { ask } = await hosted(module),
      found = {};
    for (const name of Object.keys(GOLDEN)) {
      const { toml } = ask({ do: "example", name }),
        before = process.cpuUsage();
      found[name] = run(ask, recorded(toml), 256);
      t.diagnostic(`${name}: ${(process.cpuUsage(before).user / 1e5).toFixed(2)} s of processor time for a simulated second`);
    }
    if (process.env.GOLDEN === "write") return writeFileSync(FILE, `${JSON.stringify(found, null, 1)}\n`);
    assert.deepEqual(found, GOLDEN);
    const rectangle = recorded(ask({ do: "example", name: "rectangle" }).toml);
    for (const rows of [1, 100, 10000]) assert.deepEqual(run((await hosted(module)).ask, rectangle, rows), GOLDEN.rectangle);
  });

  it("keeps its memory over a thousand messages and a hundred edits", async (t) => {
    const { ask, size } = await hosted(module),
      toml = recorded(ask({ do: "example", name: "rectangle" }).toml);
    ask({ do: "open", slot: 0, toml });
    // Until what is kept of the signal is full.
    for (let k = 0; k < 20; k++) {
      ask({ do: "open", slot: 0, toml, carry: true });
      for (let n = 0; n < 10; n++) ask({ do: "advance", slot: 0, rows: 16, frames: true });
      if (k === 0) (ask({ do: "advance", slot: 0, rows: 1024 }), ask({ do: "spectra", slot: 0, longest: 1024 }));
    }
    const before = size();
    for (let k = 0; k < 100; k++) {
      ask({ do: "open", slot: 0, toml, carry: true });
      for (let n = 0; n < 10; n++) ask({ do: "advance", slot: 0, rows: 2, frames: true });
    }
    t.diagnostic(`${before / 1e6} MB before, ${size() / 1e6} MB after 100 edits and 1000 slices`);
    assert.ok(size() - before < 3e5);
  });
});
