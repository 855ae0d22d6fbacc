// The studio: joins bearings, controls and views, once its engine is there.
import { Refused } from "./answers.js";
import { Controls, lay } from "./controls.js";
import { CurveViews } from "./curves.js";
import { DamagePanel } from "./damage-panel.js";
import { byId } from "./dom.js";
import { droppable } from "./files.js";
import { openFile } from "./opening.js";
import { Healthy } from "./healthy.js";
import { showKeys } from "./help.js";
import { readout, showState, speak } from "./readout.js";
import { Warnings, notice } from "./notices.js";
import { Saving } from "./saving.js";
import { forgetAngle } from "./schema.js";
import { Side, equalSpectra } from "./side.js";
import { actOf } from "./shortcuts.js";
import { fromLink, pathOf, remember, remembered } from "./state.js";
import { startList } from "./start.js";
import { storedRun } from "./stored.js";

/** @typedef {import("./side.js").Show} Show */

const START = "rectangle",
  KEPT_MS = 400,
  SLOW_READOUT_MS = 200,
  PASSAGE_MS = 120;

export class Studio {
  /** @type {any} */
  about = null;
  /** @type {Side[]} */
  sides = [];
  active = 0;
  beside = false;
  /** @type {Controls | null} */
  controls = null;
  /** @type {any} */
  measured = null;
  /** What tells B from A. */
  difference = "";
  /** The stored run, while it is shown. @type {import("./stored.js").Still | null} */
  still = null;
  dirty = new Set();
  #read = -Infinity;
  #keep = 0;
  #pass = 0;
  #warnings = new Warnings();

  constructor() {
    this.panel = new DamagePanel(byId("damage"), {
      undo: () => this.#undo(),
      store: () => this.side?.store ?? /** @type {any} */ ({ scenario: {} }),
      ask: (request) => this.side.live.urgent(request),
      schema: () => this.about?.schema,
      changed: (spec, value, live) => this.#change(spec, value, live),
      rebuilt: () => this.dirty.add("fields"),
      speak,
      failed: (error) => this.#failed(error),
    });
    this.curves = new CurveViews();
    this.bearing = /** @type {any} */ (document.querySelector("brinell-bearing"));
    this.passage = /** @type {any} */ (document.querySelector("brinell-passage"));
    this.sound = /** @type {any} */ (document.querySelector("brinell-sound"));
    this.saving = new Saving({
      side: () => this.side,
      fields: () => this.#fields,
      views: () => [...document.querySelectorAll("#curves brinell-curve"), this.bearing, this.passage],
      sound: () => this.sound,
      undo: () => this.#undoRefused(),
      failed: (error) => this.#failed(error),
    });
  }

  get side() {
    return this.sides[this.active];
  }
  get other() {
    return this.beside ? this.sides[1 - this.active] : undefined;
  }

  /** @param {Promise<() => Promise<import("./answers.js").Engine>>} starting */
  async begin(starting) {
    // The first engine says what the page is about, and then holds bearing A.
    const engine = starting.then((start) => start());
    engine.catch(() => {});
    const another = async () => (await starting)();
    this.start = another;
    let taken = false,
      slots = false;
    const a = this.#add("A", () => {
      const first = !taken;
      taken = true;
      return first ? engine : another();
    });
    // An engine of many slots has two of them: B outranks the healthy bearing.
    this.healthy = new Healthy(
      another,
      1,
      () => !(slots && this.sides.length > 1),
      () => this.dirty.add("curves"),
    );
    // A page that holds a stored run can be used, and shows it, before the engine is there.
    const stored = await storedRun();
    this.about = stored?.about ?? (await (await engine).ask({ do: "about" }));
    this.controls = new Controls(byId("controls"), this.about.schema, (spec, value, live) => this.#change(spec, value, live));
    this.#fill();
    this.#bind();
    const toml = await this.#first(a, stored?.toml ?? (await (await engine).ask({ do: "example", name: START })).toml);
    if (stored && stored.toml === toml) this.#still(a, stored);
    const frame = () => {
      this.#draw();
      requestAnimationFrame(frame);
    };
    requestAnimationFrame(frame);
    slots = (await engine).slots;
  }

  /** Shows the stored run until the engine has curves of its own. @param {Side} side @param {any} stored */
  #still(side, { still, opened, moments, headline, damage }) {
    if (side.opened) return;
    this.still = still;
    side.store.replace(opened.scenario);
    Object.assign(side, {
      opened,
      moments,
      damage,
      verdict: { headline: `Stored run, shown while the engine loads. ${headline}` },
    });
    this.#opened({ opened, edit: { toml: "" } });
    this.#damaged(damage);
    byId("state").textContent = "stored run, engine loading";
  }

  /** @param {string} name @param {() => Promise<import("./answers.js").Engine>} start */
  #add(name, start) {
    const side = new Side(name, start, this.sides.length, (s, kind, data) => this.#show(s, kind, data));
    this.sides.push(side);
    return side;
  }

  /** The scenario of the link, else that of a page around this one, else what was here last time, else an example. @param {Side} side @param {string} example its text */
  async #first(side, example) {
    const { toml: last, edit } = remembered(),
      now = edit && (await side.live.ask({ do: "normal", scenario: JSON.parse(edit) }).catch(() => null));
    const before = now?.toml ?? last;
    const given = /** @type {{brinellScenario?: string}} */ (globalThis).brinellScenario;
    let toml = given ?? before ?? example;
    try {
      const linked = await fromLink(location.hash);
      if (linked !== null) {
        toml = linked;
        if (before !== null && before !== linked)
          notice("before", "This is the bearing of the link.", {
            actions: [["Back to my last one", () => this.load(before)]],
          });
      }
    } catch (error) {
      notice("link", `The link holds no scenario: ${error instanceof Error ? error.message : error}`, { bad: true });
    }
    if (toml === example) byId("state").textContent = `loading ${START}`;
    side.live.edit({ toml }, false);
    // A scenario that is refused leaves the page without a bearing: the example comes instead.
    this.fallback = () => side.live.edit({ toml: example }, false);
    return toml;
  }

  #fill() {
    startList(this.about, {
      side: () => this.side,
      load: (toml) => this.load(toml),
      failed: (error) => this.#failed(error),
    });
    this.saving.bind();
  }

  #bind() {
    const on = (/** @type {string} */ id, /** @type {(e: MouseEvent) => void} */ act) => byId(id).addEventListener("click", act);
    on("open", () => byId("file").click());
    byId("file").addEventListener("change", () => {
      this.take([...byId("file").files]);
      byId("file").value = "";
    });
    on("pause", () => this.#pause());
    // The second half of a double click cancels nothing.
    on("run", (e) => e.detail > 1 || (this.side.live.whole ? this.side.live.live() : this.saving.isRefused() || this.side.live.run()));
    on("side-a", () => this.turn(0));
    on("side-b", () => this.turn(1));
    on("both", () => this.compare(!this.beside));
    on("help", showKeys);
    droppable((files) => this.take(files));
    document.addEventListener("keydown", (e) => this.#key(e));
    window.addEventListener("hashchange", async () => {
      const toml = await fromLink(location.hash).catch(() => null);
      if (toml !== null && toml !== this.side.opened?.toml) this.side.live.edit({ toml }, false);
    });
    // A page where nothing was edited does not write over what another one kept.
    window.addEventListener("pagehide", () => (this.#keep || this.sides[0].live.unanswered) && this.#remember());
  }

  /** A scenario from a file or an example. @param {string} toml */
  load(toml, carry = false, file = "") {
    this.#unlink(this.side);
    this.side.live.edit({ toml, file }, carry);
  }

  /** @param {import("./schema.js").Spec} spec @param {any} value @param {boolean} live */
  #change(spec, value, live) {
    const { store } = this.side,
      now = spec.read(store.scenario);
    if (JSON.stringify(now) !== JSON.stringify(value))
      store.change((s) => spec.write(s, value, this.side.opened?.all), `${spec.label} ${spec.path.join(".")}`);
    // What is typed may be the value that is there, in another unit.
    else this.dirty.add("fields");
    if (!live) store.seal();
  }

  /** @type {Show} */
  #show(side, kind, data) {
    // A stored run is not what was edited, and makes room for what is live.
    if ((kind === "spectra" && !data.settling) || kind === "scenario" || kind === "problems") this.still = null;
    if (kind === "absent" && side !== this.sides[0]) this.#failed(data.error);
    if (["state", "problems", "recovered", "working", "left"].includes(kind)) this.dirty.add("state");
    if (kind === "lost")
      notice("lost", data.gone ? data.why : `The engine was lost (${data.why}). A new one continues with the last good bearing.`, {
        bad: !!data.gone,
      });
    if (kind === "state" && data.state === "lost" && !document.querySelector('[data-kind="lost"].bad'))
      notice("lost", "The engine was lost again and again, so none runs. Start again tries another.");
    if (kind === "recovered") this.#recovered();
    if (kind === "problems") this.#refused(side, data);
    if (kind === "verdict" || kind === "opened") this.#differ();
    if (kind === "spectra") this.#equal();
    // What is kept for the next time waits for no answer.
    if (side === this.sides[0] && ["opened", "scenario", "problems"].includes(kind) && !data?.edit?.again) {
      clearTimeout(this.#keep);
      this.#keep = setTimeout(() => this.#remember(), KEPT_MS);
    }
    if (kind === "scenario") this.#unlink(side);
    if (side !== this.side) return void (side === this.other && this.dirty.add("curves").add("readout"));
    if (kind === "opened") this.#opened(data);
    else if (kind === "scenario") this.dirty.add("fields");
    else if (kind === "slice") {
      if (data.frames && side.settled) {
        this.panel.raceway.frames = data.frames;
        if (this.bearing) this.bearing.frames = data.frames;
      }
      this.dirty.add("curves").add("readout");
    } else if (kind === "damage") this.#damaged(data);
    else if (kind === "sound") this.sound.loop = { rate_hz: data.rate_hz, x: data.x, turns: data.turns };
    else if (kind === "verdict") {
      speak(data.headline ?? "");
      this.dirty.add("curves").add("readout");
    } else {
      if (kind === "state") this.#warnings.show(side);
      this.dirty.add("curves").add("readout");
    }
  }

  #remember() {
    this.#keep = 0;
    const { opened, live } = this.sides[0];
    if (opened) remember(opened.toml, live.unanswered?.scenario);
  }

  /** The address does not name another bearing than A, which it opens. @param {Side} side that is edited */
  #unlink(side) {
    if (side === this.sides[0] && location.hash.startsWith("#s=")) history.replaceState(null, "", location.pathname + location.search);
  }

  #recovered() {
    speak("The engine was lost and runs again");
    // A server that answers again is not said to be gone.
    if (document.querySelector('[data-kind="lost"].bad')) notice("lost", "The engine answers again: the bearing was started anew.");
  }

  /** What tells B from A, in the engine's words: of the latest verdicts of both. */
  async #differ() {
    const [a, b] = this.sides.map((s) => s.verdict),
      before = this.difference;
    this.difference = "";
    try {
      if (this.beside && a?.damage && b?.damage) this.difference = (await this.side.live.ask({ do: "differ", a, b })).headline;
    } catch {
      // An engine that is lost gives new verdicts when it runs again.
    }
    if (this.difference === before) return;
    if (this.difference) speak(this.difference);
    this.dirty.add("readout");
  }

  async #equal() {
    if (this.beside && (await equalSpectra(this.sides))) this.dirty.add("curves");
  }

  /** @param {any} data */
  #opened({ opened, edit }) {
    if (edit.toml !== undefined) {
      this.#forget();
      this.panel.selected = opened.scenario.defects?.length ? 1 : 0;
    }
    this.panel.opened(opened);
    if (edit.toml !== undefined && this.panel.selected) this.panel.select(1);
    if (this.bearing) Object.assign(this.bearing, { geometry: opened.geometry, loadDeg: opened.load_deg });
    this.#lay(this.side);
    if (!edit.again) notice("unsaved", null);
    this.#warnings.show(this.side);
    this.healthy?.want(opened.scenario);
    this.dirty.add("fields").add("curves").add("state").add("readout");
  }

  /** @param {any[]} damage */
  #damaged(damage) {
    this.panel.damage = damage;
    if (this.bearing) this.bearing.damage = damage;
    // While the pen is down there is always a newer one.
    clearTimeout(this.#pass);
    this.#pass = setTimeout(() => this.#passes(this.panel.selected || damage[0]?.defect), PASSAGE_MS);
  }

  /** One roller's passage over the selected damage. @param {number | undefined} defect */
  async #passes(defect) {
    const side = this.side;
    if (!this.passage) return;
    let data = null;
    try {
      if (defect) data = await side.live.ask({ do: "passage", defect });
    } catch {
      // Damage that is not there any more has no passage.
    }
    if (side === this.side) this.passage.data = data;
  }

  /** The engine's message is beside the control; the last good bearing runs on. @param {Side} side @param {any} data */
  #refused(side, { problems, edit }) {
    if (!side.opened && edit) {
      notice("before", problems.map((/** @type {any} */ p) => p.message).join(" "), { bad: true });
      this.fallback?.();
      this.fallback = undefined;
      return;
    }
    if (side !== this.side) return;
    const words = problems
      .map((/** @type {any} */ p) => `${p.line && edit?.toml !== undefined ? `line ${p.line}: ` : ""}${p.message}`)
      .join(" ");
    if (edit?.toml !== undefined || !edit)
      notice("refused", edit?.file ? `${edit.file} is refused, and the bearing before it runs on. ${words}` : words, {
        bad: true,
      });
    else if (!this.panel.refused(edit.scenario, words)) {
      this.dirty.add("fields");
      this.#lay(side);
    }
  }

  /** What was typed and is not taken is of the bearing before. */
  #forget() {
    this.#restored();
    forgetAngle();
  }

  /** Whether a field held what is not taken or not read. */
  #restored() {
    this.dirty.add("fields");
    return this.#fields.filter((f) => f.restore()).length > 0;
  }

  /** One step back; from what a field does not read, to what it held. */
  #undo() {
    if (!this.#restored()) this.side.store.undo();
  }

  #undoRefused() {
    this.#restored();
    this.side.store.undo();
  }

  get #fields() {
    return [...this.panel.fields, ...(this.controls?.fields ?? [])];
  }

  /** @param {Side} side */
  #lay(side) {
    const problems = side.problems.map((p) => ({ ...p, path: pathOf(p.key) })),
      about = problems.find((p) => p.path[0] === "defects" && typeof p.path[1] === "number");
    // The damage that is refused is the one to look at.
    if (about && this.panel.selected !== Number(about.path[1]) + 1 && side.store.scenario.defects?.[Number(about.path[1])])
      this.panel.select(Number(about.path[1]) + 1);
    const rest = lay(this.#fields, problems);
    notice("refused", rest.length ? rest.map((p) => p.message).join(" ") : null, {
      bad: true,
      actions: [["Undo", () => this.#undoRefused()]],
    });
  }

  /** @param {unknown} error @param {string} [file] what it is about */
  #failed(error, file = "") {
    const words =
      error instanceof Refused ? error.problems.map((p) => p.message).join(" ") : error instanceof Error ? error.message : String(error);
    notice("failed", words.includes(file) ? words : `${file}: ${words}`, { bad: true });
  }

  /** Draws what came last, once a frame. */
  #draw() {
    const side = this.side,
      dirty = this.dirty;
    if (!side?.opened || !dirty.size) return;
    const now = performance.now();
    if (dirty.delete("fields")) {
      this.controls?.update(side.store.scenario, side.opened);
      this.panel.update(side.opened);
      if (side.problems.length) this.#lay(side);
    }
    if (dirty.delete("state") && side.live.opened) this.panel.raceway.frozen = showState(side);
    const shown = /** @type {Side} */ (/** @type {unknown} */ (this.still ?? side));
    if (dirty.has("curves") && this.curves.draw(shown, this.other, this.healthy?.curves ?? null, this.measured, now))
      dirty.delete("curves");
    if (dirty.has("readout") && now - this.#read > SLOW_READOUT_MS) {
      dirty.delete("readout");
      this.#read = now;
      readout(byId("readout"), this.beside ? this.sides : [side], this.difference);
    }
  }

  #pause() {
    const { live } = this.side;
    if (live.state === "live" || live.state === "running") live.pause();
    else live.live();
    this.dirty.add("state");
  }

  /** @param {KeyboardEvent} e */
  #key(e) {
    const act = actOf(e, {
      redo: () => this.panel.step(),
      undo: () => this.panel.step(() => this.#undo()),
      cancel: this.side?.live.whole ? () => this.side.live.live() : undefined,
      pause: () => this.#pause(),
      live: () => this.side.live.live(),
      hear: () => this.sound?.hear?.(!this.sound.hearing),
      turn: (index) => this.turn(index),
    });
    act?.();
  }

  /** The bearing that is edited and shown. @param {number} index */
  turn(index) {
    // What is read of it is still the bearing's that was edited.
    if (document.activeElement instanceof HTMLInputElement) document.activeElement.blur();
    if (index === 1 && !this.sides[1]) this.#second();
    const other = index !== this.active;
    if (other) this.#forget();
    this.active = index;
    const side = this.side;
    if (other) this.panel.selected = side.store.scenario.defects?.length ? 1 : 0;
    byId("side-a").setAttribute("aria-pressed", String(index === 0));
    byId("side-b").setAttribute("aria-pressed", String(index === 1));
    if (side.opened) {
      this.#opened({ opened: side.opened, edit: {} });
      this.#damaged(side.damage);
      // Another bearing is seen where it is damaged.
      if (other && this.panel.selected) this.panel.select(1);
    }
    this.dirty.add("fields").add("curves").add("state").add("readout");
    this.#lay(side);
  }

  /** @param {boolean} on */
  compare(on) {
    if (on && !this.sides[1]) this.#second();
    this.beside = on;
    byId("both").setAttribute("aria-pressed", String(on));
    this.#differ();
    this.#equal();
    this.dirty.add("curves").add("readout");
  }

  /** B starts as a copy of A, in an engine of its own. */
  #second() {
    const a = this.sides[0],
      b = this.#add("B", /** @type {any} */ (this.start));
    b.live.edit({ toml: a.opened.toml }, false);
  }

  /** @param {File[]} files */
  async take(files) {
    for (const file of files) {
      try {
        await openFile(file, this);
      } catch (error) {
        this.#failed(error, file.name);
      }
    }
  }
}
