// One of the bearings that are compared: its scenario, its run, and what came last of it.
import { Live } from "./live.js";
import { Store } from "./state.js";
import { Trace } from "./trace.js";

/** @typedef {import("./answers.js").Trouble} Trouble */
/** @typedef {(side: Side, kind: string, data?: any) => void} Show */

export class Side {
  trace = new Trace();
  /** @type {any} the opened bearing */
  opened = null;
  /** @type {any} */
  moments = null;
  /** @type {any} */
  spectra = null;
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
  /** Simulated seconds for a real one, lately. */
  pace = 0;
  /** Milliseconds from the last edit to its bearing. */
  took = 0;
  #paced = { t: 0, at: 0 };

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
    else if (kind === "indicators") this.indicators = data;
    else if (kind === "verdict") this.verdict = data;
    this.show(this, kind, data);
  }

  /** @param {{opened: any, edit: any, took: number}} data */
  #open({ opened, edit, took }) {
    this.opened = opened;
    this.trace.clear();
    this.indicators = null;
    if (edit.again) return;
    // What was said of the bearing before is not said of this one.
    this.verdict = null;
    if (this.spectra) this.spectra = { ...this.spectra, lines: [] };
    this.took = took;
    this.problems = [];
    if (edit.toml !== undefined) this.store.replace(opened.scenario);
  }

  /** @param {any} data */
  #slice(data) {
    this.trace.push(data.first, data.x);
    this.moments = data.moments;
    const now = performance.now(), { t, at } = this.#paced;
    if (data.t < t || now - at > 3000) this.#paced = { t: data.t, at: now };
    else if (now - at > 800) {
      this.pace = (data.t - t) / (now - at) * 1000;
      this.#paced = { t: data.t, at: now };
    }
  }

  /** A run from t = 0 to its end. Resolves when it is done; false where it was left for something else. */
  finished() {
    if (this.live.state === "done") return Promise.resolve(true);
    this.live.run();
    return new Promise((done) => {
      const before = this.show;
      this.show = (side, kind, data) => {
        before(side, kind, data);
        const left = kind === "problems" || kind === "lost" || kind === "scenario" || (kind === "state" && data.state === "live");
        if (!left && !(kind === "state" && data.state === "done")) return;
        this.show = before;
        done(!left);
      };
    });
  }
}
