// The engine in a Worker. A Worker that traps, or is silent for too long, counts as lost.
import { Lost, accepted } from "./answers.js";
import { decode, encode } from "./message.js";

const TICK_MS = 100;
// A slice is asked to take a tenth of a second, and may take several times that after an edit; what else a bearing is asked hardly more, but tables that are made beside it take a core; reading a file or judging a signal may take long.
const SLICE_TICKS = 20,
  SHORT_TICKS = 60,
  LONG_TICKS = 600,
  SLACK = 4;
const SHORT = new Set(["advance", "open", "spectra", "indicators", "sound", "damage", "passage", "scratch", "brush", "normal"]);

/** @typedef {{id: number, done: (answer: any) => void, failed: (error: Error) => void, slice: boolean, short: boolean, asked: number}} Waiting */
/** @typedef {import("./assets.js").Assets} Assets */

export class WorkerEngine {
  slots = false;
  #parts;
  #worker;
  /** @type {Waiting[]} */
  #waiting = [];
  #next = 1;
  #ticks = 0;
  #slowest = 0;
  #slices = 0;
  #timer;
  /** @type {Lost | null} */
  #lost = null;

  /** @param {Assets} parts */
  constructor(parts) {
    const { module, worker } = (this.#parts = parts);
    this.#worker = new Worker(worker);
    this.#worker.onmessage = ({ data }) => this.#hear(data);
    this.#worker.onerror = (event) => {
      event.preventDefault();
      this.#lose(event.message || "the Worker stopped");
    };
    this.#worker.postMessage({ module });
    // Counted in ticks of a page that is awake: a machine that slept has lost no Worker.
    this.#timer = setInterval(() => this.#watch(), TICK_MS);
  }

  /** @param {Record<string, unknown>} request @returns {Promise<any>} */
  ask(request) {
    if (this.#lost) return Promise.reject(this.#lost);
    const bytes = encode(request),
      id = this.#next++;
    return new Promise((done, failed) => {
      this.#waiting.push({
        id,
        done,
        failed,
        slice: request.do === "advance",
        short: SHORT.has(String(request.do)),
        asked: performance.now(),
      });
      if (this.#waiting.length === 1) this.#ticks = 0;
      this.#worker.postMessage({ id, bytes }, [bytes.buffer]);
    });
  }

  /** In a Worker of its own. @param {Record<string, unknown>} request @param {AbortSignal} left @returns {Promise<any>} */
  async aside(request, left) {
    const other = new WorkerEngine(this.#parts),
      lose = () => other.#lose("nobody waits for it");
    left.addEventListener("abort", lose);
    try {
      // Its memory is not this one's.
      return await other.ask({ ...request, bytes: true });
    } finally {
      left.removeEventListener("abort", lose);
      other.close();
    }
  }

  /** @param {{id: number, bytes?: Uint8Array<ArrayBuffer>, trap?: string}} data */
  #hear({ id, bytes, trap }) {
    if (trap !== undefined || !bytes) return this.#lose(trap ?? "the Worker answered nothing");
    const first = this.#waiting.shift();
    if (first?.id !== id) return this.#lose("the Worker answered out of turn");
    this.#ticks = 0;
    if (first.slice) {
      this.#slices += 1;
      this.#slowest = Math.max(this.#slowest * 0.98, performance.now() - first.asked);
    }
    try {
      first.done(accepted(decode(bytes)));
    } catch (error) {
      first.failed(/** @type {Error} */ (error));
    }
  }

  #watch() {
    const first = this.#waiting[0];
    if (!first) return;
    this.#ticks += 1;
    // The first slices are slow, as the browser still compiles.
    const warm = this.#slices > 3,
      limit = warm && first.slice ? SLICE_TICKS + (SLACK * this.#slowest) / TICK_MS : warm && first.short ? SHORT_TICKS : LONG_TICKS;
    if (this.#ticks > limit) this.#lose("the Worker is silent");
  }

  /** @param {string} why */
  #lose(why) {
    this.#lost ??= new Lost(why);
    const waiting = this.#waiting;
    this.close();
    for (const one of waiting) one.failed(this.#lost);
  }

  close() {
    clearInterval(this.#timer);
    this.#worker.terminate();
    this.#lost ??= new Lost("closed");
    this.#waiting = [];
  }

  /** For tests: the Worker ends without a word, as when the browser takes its memory. */
  kill() {
    this.#worker.terminate();
  }
}
