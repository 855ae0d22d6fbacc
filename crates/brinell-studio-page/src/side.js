// One of the bearings that are compared: its scenario, its run, and what came last of it.
import { Live } from "./live.js";
import { Store } from "./state.js";
import { Trace } from "./trace.js";

/** @typedef {import("./answers.js").Trouble} Trouble */
/** @typedef {(side: Side, kind: string, data?: any) => void} Show */

const MOST_EQUAL = 32768,
  // As the engine, which lets a turn of the shaft pass before it counts, waits for a slow one.
  LONGEST_TURN_S = 0.1;

/**
 * Puts spectra of equally many samples that count into bearings that are compared: a longer record has narrower lines, and one that begins has the
 * load's ramp in it.
 * @param {Side[]} sides
 * @returns {Promise<boolean>} whether there are any
 */
export async function equalSpectra(sides) {
  const least = Math.min(MOST_EQUAL, ...sides.map((s) => s.moments?.samples ?? 0)),
    longest = 2 ** Math.floor(Math.log2(least));
  try {
    const got = await Promise.all(sides.map((s) => s.live.ask({ do: "spectra", longest })));
    if (got.length < 2 || got.some((one) => one.samples !== longest || !one.spectrum)) return false;
    sides.forEach((s, k) => (s.equal = got[k]));
    return true;
  } catch {
    // The next spectra ask for them again.
    return false;
  }
}

export class Side {
  trace = new Trace();
  /** @type {any} the opened bearing */
  opened = null;
  /** @type {any} */
  moments = null;
  /** Whether a sample has counted since it began at t = 0: before that, forces and motion are those of the start. */
  settled = false;
  /** @type {any} */
  spectra = null;
  /** Beside another bearing: spectra of as many samples as its. @type {any} */
  equal = null;
  /** @type {any} */
  indicators = null;
  /** @type {any} */
  verdict = null;
  /** @type {any[]} */
  damage = [];
  /** @type {Trouble[]} */
  problems = [];
  /** Part of a run that is done. */
  part = 0;
  get percent() {
    return Math.min(99, Math.floor(100 * this.part));
  }
  /** Samples of a turn of the shaft: numbers of fewer say nothing of the bearing. */
  get needed() {
    const { rate_hz, rpm } = this.opened;
    return Math.ceil(rate_hz * Math.min(60 / rpm, LONGEST_TURN_S));
  }
  /** Simulated seconds for a real one, lately. */
  pace = 0;
  /** Milliseconds from the last edit to its bearing. */
  took = 0;
  /** What Hear plays of this scenario, once there is some. @type {any} */
  loop = null;
  #paced = { t: 0, at: 0 };
  /** @type {Set<(kind: string, data: any) => void>} */
  #waiting = new Set();

  /**
   * @param {string} name
   * @param {() => Promise<import("./answers.js").Engine>} start
   * @param {number} slot
   * @param {Show} show
   */
  constructor(name, start, slot, show) {
    this.name = name;
    /** @type {Show} */
    this.show = show;
    this.store = new Store((scenario) => {
      this.live.edit({ scenario });
      show(this, "scenario");
    });
    this.live = new Live(start, slot, (kind, data) => this.#hear(kind, data));
  }

  /** @param {string} kind @param {any} data */
  #hear(kind, data) {
    if (kind === "opened") this.#open(data);
    else if (kind === "slice") this.#slice(data);
    // Of a text that is refused nothing is in the fields.
    else if (kind === "problems") this.problems = data.edit?.toml === undefined ? data.problems : this.problems;
    else if (kind === "damage") this.damage = data;
    else if (kind === "state") this.part = data.part ?? 0;
    else if (kind === "spectra" && data.spectrum) this.spectra = data;
    else if (kind === "sound") this.loop = data;
    else if (kind === "indicators") this.indicators = data;
    else if (kind === "verdict") this.verdict = data;
    this.show(this, kind, data);
    for (const waiting of [...this.#waiting]) waiting(kind, data);
  }

  /** @param {{opened: any, edit: any, took: number}} data */
  #open({ opened, edit, took }) {
    this.opened = opened;
    this.trace.clear();
    this.indicators = null;
    this.moments = { samples: 0 };
    if (!opened.carried) this.settled = false;
    if (edit.again) return;
    // What was said of the bearing before is not said of this one.
    this.verdict = this.loop = null;
    if (this.equal) this.equal = { ...this.equal, lines: [] };
    if (this.spectra) this.spectra = { ...this.spectra, lines: [] };
    this.took = took;
    this.problems = [];
    if (edit.toml !== undefined) this.store.replace(opened.scenario);
  }

  /** @param {any} data */
  #slice(data) {
    this.trace.push(data.first, data.x);
    this.moments = data.moments;
    this.settled ||= data.moments.samples > 0;
    const now = performance.now(),
      { t, at } = this.#paced;
    if (data.t < t || now - at > 3000) this.#paced = { t: data.t, at: now };
    else if (now - at > 800) {
      this.pace = ((data.t - t) / (now - at)) * 1000;
      this.#paced = { t: data.t, at: now };
    }
  }

  /** A run from t = 0 to its end, after the last edit. Resolves when it is done; false where it was left for something else. */
  async finished() {
    if (!(await this.live.settled())) return false;
    if (this.live.state === "done") return true;
    this.live.run();
    return this.#when((kind, data) =>
      kind === "problems" || kind === "lost" || kind === "left" || (kind === "state" && data.state === "live")
        ? false
        : (kind === "state" && data.state === "done") || undefined,
    );
  }

  /** Whole turns of the shaft in the present scenario, to hear. Resolves with them; null where the bearing rests before there are some. */
  async heard() {
    if (this.loop || !["live", "running"].includes(this.live.state)) return this.loop;
    return this.#when((kind, data) =>
      kind === "sound"
        ? data
        : kind === "problems" ||
            kind === "lost" ||
            (kind === "opened" && !data.edit.again) ||
            (kind === "state" && (data.state === "paused" || data.state === "done"))
          ? null
          : undefined,
    );
  }

  /** What `told` says of a report, once it says something. @param {(kind: string, data: any) => any} told @returns {Promise<any>} */
  #when(told) {
    return new Promise((done) => {
      const waiting = (/** @type {string} */ kind, /** @type {any} */ data) => {
        const said = told(kind, data);
        if (said === undefined) return;
        this.#waiting.delete(waiting);
        done(said);
      };
      this.#waiting.add(waiting);
    });
  }
}
