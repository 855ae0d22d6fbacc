// The same bearing without damage, run once in the background, to lie behind the curves.
import { Pace } from "./pace.js";

/** @typedef {import("./answers.js").Engine} Engine */

const WAIT_MS = 900,
  ROWS = 512,
  SAMPLES = 10240,
  WINDOW = 8192;

export class Healthy {
  /** @type {{x: Float32Array, rate_hz: number, spectrum: any, envelope: any} | null} */
  curves = null;
  #start;
  #slot;
  #key = "";
  #timer = 0;
  #turn = 0;

  /** @param {() => Promise<Engine>} start @param {number} slot @param {() => boolean} free whether the slot is @param {() => void} ready */
  constructor(start, slot, free, ready) {
    this.free = free;
    this.#start = start;
    this.#slot = slot;
    this.ready = ready;
  }

  /** Some time after the last edit of anything but damage. @param {any} scenario */
  want(scenario) {
    if (!scenario.defects?.length || !this.free()) return;
    const bare = { ...scenario, defects: [] },
      key = JSON.stringify(bare);
    if (key === this.#key) return;
    this.#key = key;
    this.curves = null;
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => this.#run(bare), WAIT_MS);
  }

  /** @param {any} scenario */
  async #run(scenario) {
    const turn = ++this.#turn;
    /** @type {Engine | null} */
    let engine = null;
    // Whether the slot is free is asked with each request: what is asked then comes before bearing B's own `open`.
    const ask = (/** @type {Record<string, unknown>} */ request) => {
      if (turn !== this.#turn || !this.free()) throw new Error("the slot is another's");
      return /** @type {Engine} */ (engine).ask({ slot: this.#slot, ...request });
    };
    try {
      engine = await this.#start();
      const opened = await ask({ do: "open", scenario, carry: false }),
        x = new Float32Array(SAMPLES),
        pace = new Pace();
      for (let end = 0; end < SAMPLES;) {
        const from = performance.now(),
          got = await ask({ do: "advance", rows: ROWS, steps: pace.steps, frames: false });
        pace.took(performance.now() - from, got.x.length < ROWS && !got.done);
        x.set(got.x.subarray(0, SAMPLES - got.first), got.first);
        end = got.first + got.x.length;
        if (got.done) break;
      }
      const { spectrum, envelope } = await ask({ do: "spectra", longest: WINDOW });
      this.curves = { x, rate_hz: opened.rate_hz, spectrum, envelope };
      this.ready();
    } catch {
      // It is only a comparison: without it the curves are complete.
    } finally {
      if (engine && !engine.slots) engine.close();
    }
  }
}
