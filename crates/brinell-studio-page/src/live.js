// One bearing that runs. It never stops for an edit: the newest edit is opened after the slice in progress, and the bearing goes on in it.
import { Lost, Refused } from "./answers.js";
import { Pace } from "./pace.js";

/** @typedef {import("./answers.js").Engine} Engine */
/** @typedef {import("./state.js").Scenario} Scenario */
/** @typedef {{scenario?: Scenario, toml?: string, file?: string, carry: boolean, made: number, again?: boolean, own?: boolean}} Edit  file: that it is from; again: nothing was edited, the same bearing goes on; own: by tables that are made now */
/** @typedef {"loading" | "live" | "paused" | "running" | "done" | "lost"} State */
/** @typedef {(kind: string, data?: any) => void} Report */

const ROWS = 256,
  RUN_ROWS = 1024,
  FIRST_WINDOW = 1024,
  LAST_WINDOW = 32768;
// Samples between two sets of indicators. A verdict takes as long as many slices, so it is given anew each time their number has doubled.
const SENTENCE = 8192,
  LONGEST_SENTENCE = 65536;
// An answer that takes longer is waited for in sight.
const LATE_MS = 1000;
// After so long without an edit the scenario's own tables of damage are made.
const DRAWN_MS = 400;
// A bearing that loses its engine so often on one scenario is not tried again.
const TRIES = 2;

export class Live {
  /** @type {State} */
  state = "loading";
  /** @type {any} the opened bearing */
  opened = null;
  /** @type {Edit | null} */
  #edit = null;
  /** @type {Edit | null} */
  #good = null;
  #run = false;
  #urgent = 0;
  #paused = false;
  #wake = () => {};
  #window = FIRST_WINDOW;
  #spoken = 0;
  #judged = 0;
  #losses = 0;
  #closed = false;
  /** The last edit, until the engine has opened or refused it. @type {Edit | null} */
  #unanswered = null;
  #opening = false;
  #pace = new Pace();
  /** While the tables of the opened bearing are made. @type {AbortController | null} */
  #making = null;
  #begun = 0;
  /** Requests that are late. */
  #late = 0;
  /** @type {(() => void)[]} */
  #settling = [];

  /**
   * @param {() => Promise<Engine>} start
   * @param {number} slot
   * @param {Report} report
   */
  constructor(start, slot, report) {
    this.#start = start;
    this.slot = slot;
    this.report = report;
    /** @type {Promise<Engine>} */
    this.engine = start();
    this.#loop();
  }

  #start;

  /** @param {Record<string, unknown>} request */
  async ask(request) {
    let late = 0;
    const timer = setTimeout(() => this.#wait((late = 1)), LATE_MS);
    try {
      return await (await this.engine).ask({ slot: this.slot, ...request });
    } catch (error) {
      // An engine that begins anew, for the other bearing, does not hold this one.
      throw error instanceof Refused && error.problems[0]?.key === "slot" ? new Lost(error.message) : error;
    } finally {
      clearTimeout(timer);
      if (late) this.#wait(-late);
    }
  }

  /** @param {number} by */
  #wait(by) {
    this.#late += by;
    this.report("working");
  }

  /** Whether an answer is late, or a run waits for tables. */
  get working() {
    return this.#late > 0 || this.#waits;
  }
  /** Whether it is a run from t = 0 to its end. */
  get whole() {
    return this.#run;
  }
  /** The edit that the engine has neither opened nor refused yet. */
  get unanswered() {
    return this.#unanswered;
  }

  /** The edit that is opened next: other tables do not take the picture of a paused bearing away. */
  get #due() {
    return this.#edit?.own && this.#paused ? null : this.#edit;
  }

  /** Seconds for which the scenario's own table of damage has been computed; null where none is. */
  get computing() {
    return this.#making && this.#begun ? Math.floor((performance.now() - this.#begun) / 1000) : null;
  }

  /** Whether a run from t = 0 waits for the scenario's own tables. */
  get #waits() {
    return this.state === "running" && this.#making !== null;
  }

  /** The run from t = 0 is not gone on with. */
  #leave() {
    if (!this.#run) return;
    this.#run = false;
    this.report("left");
  }

  /** An answer that makes an edit: no slice is begun until it is there. @param {Record<string, unknown>} request */
  async urgent(request) {
    this.#urgent += 1;
    try {
      return await this.ask(request);
    } finally {
      // Who asked goes on before the loop does.
      setTimeout(() => {
        this.#urgent -= 1;
        this.#wake();
      });
    }
  }

  /** The scenario from now on. Only the newest of those that wait is opened. @param {{scenario?: Scenario, toml?: string, file?: string}} what */
  edit(what, carry = true) {
    this.#leaveTables();
    // An edit that starts anew is not undone by a later one that would carry.
    this.#unanswered = this.#edit = { ...what, carry: carry && this.#edit?.carry !== false, made: performance.now() };
    this.#leave();
    this.#wake();
  }

  /** Resolves when no edit waits for the engine or is being made by it: whether the last one has been opened or refused, and is not one that lost the engine. */
  async settled() {
    if (!this.#closed && (this.#due || this.#opening || this.#urgent))
      await new Promise((done) => {
        this.#settling.push(() => done(null));
      });
    return !this.#unanswered;
  }

  /** A run from t = 0 to its end, as `brinell run` does it. */
  run() {
    if (!this.#good) return;
    this.#edit = { ...(this.#edit ?? { ...this.#good, again: true }), carry: false, made: performance.now() };
    this.#run = true;
    this.#paused = false;
    this.report("working");
    this.#wake();
  }

  pause() {
    this.#paused = true;
    if (this.state === "live" || this.state === "running") this.#say("paused");
  }

  live() {
    this.#paused = false;
    if (this.state === "done" || this.#run) {
      this.#leave();
      if (this.#good) this.#edit ??= { ...this.#good, again: true };
    }
    if (this.state === "lost" && this.#good) {
      this.#losses = 0;
      this.#edit ??= { ...(this.#unanswered ?? { ...this.#good, again: true }), carry: false };
    }
    this.#wake();
  }

  close() {
    this.#closed = true;
    this.#making?.abort();
    this.#wake();
    this.engine.then(
      (engine) => {
        if (!engine.slots) engine.close();
      },
      () => {},
    );
  }

  async kill() {
    (await this.engine).kill();
  }

  /** @param {State} state */
  #say(state, data = {}) {
    this.state = state;
    this.report("state", { state, ...data });
  }

  async #loop() {
    while (!this.#closed) {
      this.#opening = this.#due !== null;
      if (!this.#opening && !this.#urgent) this.#settle();
      try {
        if (this.#due) await this.#open(this.#due);
        else if (!this.opened || this.#paused || this.#urgent || this.state === "done" || this.#waits || this.state === "lost")
          await new Promise((done) => {
            this.#wake = () => done(null);
          });
        else await this.#slice();
      } catch (error) {
        if (this.#closed) return;
        // No engine came at all.
        if (!this.opened && !(error instanceof Lost || error instanceof Refused)) {
          this.#closed = true;
          this.#settle();
          return this.report("absent", { error });
        }
        if (error instanceof Lost) await this.#recover(error);
        else {
          this.#paused = true;
          this.report("problems", {
            problems: error instanceof Refused ? error.problems : [{ key: null, line: null, message: String(error) }],
            edit: null,
          });
          this.#say("paused");
        }
      }
    }
  }

  #settle() {
    for (const done of this.#settling.splice(0)) done();
  }

  /** @param {Edit} edit */
  #answered(edit) {
    if (!edit.again && edit.made >= (this.#unanswered?.made ?? Infinity)) this.#unanswered = null;
  }

  /** @param {Edit} edit */
  async #open(edit) {
    this.#edit = null;
    let opened;
    try {
      const { scenario, toml } = edit;
      opened = await this.ask({ do: "open", ...(toml === undefined ? { scenario } : { toml }), carry: edit.carry });
    } catch (error) {
      if (!(error instanceof Refused)) {
        // An edit that may have ended its engine is not tried on the next one; one that did not reach a server is.
        if (error instanceof Lost) this.#edit ??= this.#good && !error.gone ? { ...this.#good, again: true } : edit;
        throw error;
      }
      // The engine is as it was: the last good bearing runs on.
      this.#run = false;
      this.#answered(edit);
      this.report("problems", { problems: error.problems, edit });
      if (this.opened?.quick && !this.#making && !this.#edit) this.#makeTables(this.opened.scenario);
      return;
    }
    this.#answered(edit);
    if (this.state === "lost") this.report("recovered");
    this.#good = { scenario: opened.scenario, carry: true, made: edit.made };
    this.opened = opened;
    if (!opened.carried) this.#pace = new Pace();
    [this.#window, this.#spoken, this.#judged] = [FIRST_WINDOW, 0, 0];
    this.report("opened", { opened, edit, took: performance.now() - edit.made });
    this.#say(this.#paused ? "paused" : this.#run ? "running" : "live", { part: 0 });
    if (opened.quick && !edit.own && !this.#making && !this.#edit) this.#makeTables(opened.scenario);
    this.report("damage", (await this.ask({ do: "damage" })).defects);
  }

  /** Tables of another bearing than the one that is wanted now are of no use. */
  #leaveTables() {
    this.#making?.abort();
    this.#making = null;
  }

  /** Makes the tables of the opened bearing beside it; then it goes on by them. A run from t = 0 waits. @param {Scenario} scenario */
  async #makeTables(scenario) {
    this.#begun = 0;
    const making = (this.#making = new AbortController()),
      left = making.signal;
    if (!this.#run)
      await new Promise((done) => {
        setTimeout(done, DRAWN_MS);
      });
    if (left.aborted) return;
    let own = false;
    this.#begun = performance.now();
    this.report("working");
    const tick = setInterval(() => this.report("working"), LATE_MS);
    left.addEventListener("abort", () => clearInterval(tick));
    try {
      const { tables } = await (await this.engine).aside({ do: "tables", scenario }, left);
      if (left.aborted) return;
      await this.ask({ do: "take", tables });
      own = true;
    } catch {
      // Where they cannot be made, quick ones stay.
    } finally {
      clearInterval(tick);
    }
    if (left.aborted) return;
    this.#making = null;
    if (own && this.#good) this.#edit ??= { ...this.#good, again: true, own, carry: !this.#run };
    this.report("working");
    this.#wake();
  }

  async #slice() {
    const opened = this.opened,
      rows = this.#run ? RUN_ROWS : ROWS,
      { steps } = this.#pace,
      from = performance.now();
    const got = await this.ask({ do: "advance", rows, steps, frames: true });
    this.#pace.took(performance.now() - from, got.x.length < rows && !got.done);
    if (opened !== this.opened) return;
    this.#losses = 0;
    this.report("slice", got);
    const samples = got.first + got.x.length;
    if (this.#run) this.#say(this.#paused ? "paused" : "running", { part: samples / opened.samples });
    else if (this.state !== "live" && !this.#paused) this.#say("live");
    if (samples >= this.#window && !this.#edit) await this.#spectra(samples);
    if (this.#edit) return;
    if (got.done) await this.#finish(samples);
    else if (samples - this.#spoken >= SENTENCE && !this.#run) await this.#sentence(samples);
  }

  /** @param {number} samples */
  async #spectra(samples) {
    const longest = Math.min(LAST_WINDOW, 2 ** Math.floor(Math.log2(samples)));
    const spectra = await this.#perhaps({ do: "spectra", longest });
    if (spectra.ok) this.report("spectra", spectra);
    // Up to the longest window the picture sharpens; from then on it is renewed.
    this.#window = longest < LAST_WINDOW ? 2 * longest : samples + LAST_WINDOW / 4;
    if (this.#edit) return;
    const sound = await this.#perhaps({ do: "sound" });
    if (sound.ok) this.report("sound", sound);
  }

  /** An answer that may not be there yet: then the engine says why. @param {Record<string, unknown>} request */
  async #perhaps(request) {
    try {
      return await this.ask(request);
    } catch (error) {
      if (error instanceof Refused) return { ok: false, headline: error.message };
      throw error;
    }
  }

  /** @param {number} samples */
  async #sentence(samples) {
    this.#spoken = samples;
    const indicators = await this.#perhaps({ do: "indicators" });
    if (indicators.ok) this.report("indicators", indicators);
    if (this.#edit || samples < Math.min(2 * this.#judged, this.#judged + LONGEST_SENTENCE)) return;
    this.#judged = samples;
    this.report("verdict", await this.#perhaps({ do: "verdict" }));
  }

  /** @param {number} samples */
  async #finish(samples) {
    await this.#spectra(samples);
    this.#judged = 0;
    await this.#sentence(samples);
    if (this.#run) {
      this.#run = false;
      this.#say("done");
      return;
    }
    // A live bearing goes on from the end of its run.
    if (this.#good) this.#edit ??= { ...this.#good, again: true };
  }

  /** @param {Lost} error @returns {Promise<void>} */
  async #recover(error) {
    const from = performance.now();
    this.#losses += 1;
    this.report("lost", { why: error.message, gone: error.gone });
    this.#leave();
    (await this.engine.catch(() => null))?.close();
    this.engine = this.#start();
    this.engine.catch(() => {});
    if (error.gone || this.#losses > TRIES) {
      this.#edit = null;
      this.#say("lost");
      return;
    }
    const wanted = this.#edit ?? this.#good;
    if (!wanted) return;
    try {
      // What was being opened when the engine went may be what ended it, so the last good bearing goes first.
      const { scenario, toml } = this.#good ?? wanted;
      this.opened = await this.ask({ do: "open", ...(scenario ? { scenario } : { toml }), carry: false });
    } catch (again) {
      if (again instanceof Lost) return this.#recover(again);
      throw again;
    }
    this.#edit = wanted === this.#good ? { ...wanted, again: true } : wanted;
    this.report("recovered", { took: performance.now() - from });
  }
}
