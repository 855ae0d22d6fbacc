// The panel over the raceway: surface and row, tools, the damage that is selected. Turns what is drawn into edits of the scenario.
import { Field } from "./controls.js";
import { DEEPER, HINTS, TOOLS, degrees, icon, numberBox } from "./damage-tools.js";
import { short } from "./chart.js";
import { h } from "./dom.js";
import { defectSpecs } from "./schema.js";
import { Raceway } from "./raceway.js";
import { notice } from "./notices.js";

/** @typedef {import("./tools.js").Tool} Tool */
/** @typedef {import("./tools.js").Request} Request */
/** @typedef {import("./controls.js").Changed} Changed */
/**
 * @typedef {object} Owner
 * @property {() => import("./state.js").Store} store
 * @property {() => void} undo
 * @property {(request: Record<string, unknown>) => Promise<any>} ask
 * @property {() => any} schema
 * @property {Changed} changed
 * @property {() => void} rebuilt  fields are new: the words of the engine are to be laid beside them again
 * @property {(words: string) => void} speak
 * @property {(error: unknown) => void} failed
 */

export class DamagePanel {
  raceway = new Raceway();
  surface = "outer-raceway";
  row = 1;
  roller = 1;
  /** Defects count from 1; 0 is none. */
  selected = 0;
  /** @type {Field[]} */
  fields = [];
  #depth = 20;
  #shown = "";
  /** @type {any[]} */
  #damage = [];
  /** @typedef {{id: string, index: number | null, base: any, scenario: any, left: boolean, ended: boolean}} Gesture  scenario: as it left it; left: it was taken back */
  /** @type {Gesture | null} */
  #gesture = null;
  /** The gesture that drew last. @type {Gesture | null} */
  #latest = null;
  /** What the engine refused last, and why. @type {{scenario: any, words: string} | null} */
  #refusal = null;
  #gestures = 0;
  /** @type {{request: Extract<Request, {type: "stroke"}>, gesture: any} | null} */
  #stroke = null;
  #asking = false;

  /** @param {HTMLElement} root @param {Owner} owner */
  constructor(root, owner) {
    this.owner = owner;
    const button = (/** @type {string} */ text, /** @type {() => void} */ onclick, /** @type {Record<string, unknown>} */ more = {}) =>
      h("button", { type: "button", onclick, ...more }, text);
    const surfaces = /** @type {const} */ ([
      ["outer-raceway", "Outer"],
      ["inner-raceway", "Inner"],
      ["roller", "Roller"],
    ]);
    this.surfaces = surfaces.map(([name, text]) => button(text, () => this.look(name), { "data-surface": name }));
    this.rows = h("select", { onchange: () => this.look(this.surface, Number(this.rows.value)) });
    this.rollers = h("select", { onchange: () => this.look("roller", this.row, Number(this.rollers.value)) });
    this.tools = TOOLS.map(([tool, name, key, path]) =>
      h(
        "button",
        {
          type: "button",
          className: "icon",
          title: `${name} (${key})`,
          "aria-label": name,
          "data-tool": tool,
          onclick: () => this.take(tool),
        },
        icon(path),
        h("span", {}, name),
      ),
    );
    this.width = numberBox(
      "Width of pen and brush, mm",
      0.05,
      () => this.raceway.geometry?.length_mm ?? Infinity,
      () => this.raceway.penWidth,
      (value) => {
        this.raceway.penWidth = value;
      },
    );
    this.depth = numberBox(
      "Depth that the brush adds, µm",
      1,
      () => 1000,
      () => this.#depth,
      (value) => {
        this.#depth = value;
      },
    );
    this.deepest = h("output", { className: "note" });
    this.raise = h("input", { type: "checkbox" });
    this.undo = button("Undo", () => this.step(owner.undo), { title: "Ctrl-Z" });
    this.redo = button("Redo", () => this.step(), { title: "Ctrl-Shift-Z" });
    this.rollerLabel = h("label", {}, "roller", this.rollers);
    this.widthLabel = h("label", {}, "width", this.width, "mm");
    this.depthLabel = h(
      "label",
      { className: "brush", title: "What a stroke of the brush adds along its middle" },
      "adds",
      this.depth,
      "µm",
    );
    this.raiseLabel = h("label", { className: "brush", title: "The brush takes depth off" }, this.raise, "raise");
    const group = (/** @type {string} */ label, /** @type {HTMLElement[]} */ buttons) =>
      h("span", { className: "group", role: "group", "aria-label": label }, ...buttons);
    this.chosen = h("div", { className: "chosen" });
    root.append(
      h(
        "div",
        { className: "tools" },
        h("h2", {}, "Damage"),
        group("Surface", this.surfaces),
        h("label", {}, "row", this.rows),
        this.rollerLabel,
        group("Tool", this.tools),
        this.widthLabel,
        h("span", { className: "spacer" }),
        group("History", [this.undo, this.redo]),
        group("View", [
          button("−", () => this.raceway.zoom(0.8), { "aria-label": "Zoom out" }),
          button("+", () => this.raceway.zoom(1.25), { "aria-label": "Zoom in" }),
          button("Fit", () => this.raceway.fit()),
        ]),
      ),
      this.raceway,
      this.chosen,
    );
    this.raceway.addEventListener("draw", (e) => this.#heed(/** @type {CustomEvent} */ (e).detail));
    this.raceway.addEventListener("tool", (e) => this.take(/** @type {CustomEvent} */ (e).detail));
    this.take("pen");
  }

  get #turn() {
    return this.raceway.turn;
  }
  get #defects() {
    return this.owner.store().scenario.defects ?? [];
  }

  /** @param {Tool} tool */
  take(tool) {
    this.raceway.tool = tool;
    for (const button of this.tools) button.setAttribute("aria-pressed", String(button.dataset.tool === tool));
    this.widthLabel.hidden = tool !== "pen" && tool !== "brush";
    this.#shown = "";
    this.update();
  }

  /** Which surface is shown. @param {string} surface */
  look(surface, row = this.row, roller = this.roller) {
    [this.surface, this.row, this.roller] = [surface, row, roller];
    const chosen = this.#defects[this.selected - 1];
    if (chosen && (chosen.on !== surface || (chosen.row ?? 1) !== row)) this.selected = 0;
    this.raceway.show(/** @type {any} */ (surface), row, roller);
    this.#lay();
    this.update();
  }

  /** The bearing that runs now. @param {any} opened */
  opened(opened) {
    const { rows, elements } = opened.geometry,
      fill = (/** @type {HTMLSelectElement} */ select, /** @type {number} */ n, /** @type {number} */ at) => {
        if (select.options.length !== n)
          select.replaceChildren(...Array.from({ length: n }, (_, k) => h("option", { value: String(k + 1) }, String(k + 1))));
        select.value = String(at);
      };
    this.row = Math.min(this.row, rows);
    this.roller = Math.min(this.roller, elements);
    fill(this.rows, rows, this.row);
    fill(this.rollers, elements, this.roller);
    this.rows.disabled = rows < 2;
    this.raceway.loadDeg = opened.load_deg;
    this.raceway.geometry = opened.geometry;
    this.raceway.show(/** @type {any} */ (this.surface), this.row, this.roller);
    this.update();
  }

  /** @param {any[]} damage */
  set damage(damage) {
    this.#damage = damage;
    this.#lay();
    this.#deep();
  }

  /** How deep the depth map that is painted on has become. */
  #deep() {
    const grid = this.#damage.find((one) => one.defect === this.selected && one.grid);
    this.deepest.textContent = grid ? `deepest ${short(grid.deepest_um)} µm` : "";
    this.deepest.hidden = !grid;
  }

  #lay() {
    const here = this.#damage.filter(
      (one) => one.on === this.surface && one.row === this.row && (one.on !== "roller" || (one.roller ?? 1) === this.roller),
    );
    this.raceway.damage = here;
  }

  /** @param {number} defect */
  select(defect) {
    this.selected = defect;
    const one = this.#defects[defect - 1];
    if (one && (one.on !== this.surface || (one.row ?? 1) !== this.row || (one.on === "roller" && one.roller !== this.roller)))
      this.look(one.on, one.row ?? 1, one.roller ?? this.roller);
    this.selected = defect;
    this.update();
    this.raceway.reveal(defect);
  }

  /** The damage that is drawn next is about as deep as the last one. */
  update(opened = /** @type {any} */ (null)) {
    const store = this.owner.store(),
      defect = this.#defects[this.selected - 1];
    if (!defect) this.selected = 0;
    if (this.depth !== document.activeElement) this.depth.value = String(this.#depth);
    this.#deep();
    this.raceway.selected = this.selected;
    this.raceway.defect = defect ?? null;
    this.undo.disabled = !store.canUndo;
    this.redo.disabled = !store.canRedo;
    for (const button of this.surfaces) button.setAttribute("aria-pressed", String(button.dataset.surface === this.surface));
    this.rollerLabel.hidden = this.surface !== "roller";
    const key = JSON.stringify([
      this.selected,
      defect?.on,
      Object.keys(defect?.shape ?? {}),
      this.raceway.tool,
      this.#defects.map((/** @type {any} */ d) => [d.on, d.row, d.center_deg, Object.keys(d.shape ?? {})]),
    ]);
    if (key !== this.#shown) this.#rebuild(defect, key);
    for (const field of this.fields) field.update(store.scenario, opened?.all, opened?.scenario);
    if (defect)
      this.raceway.describe(
        `Selected: damage ${this.selected}, at ${short(defect.center_deg ?? 0, 4)} degrees, ${short(defect.depth_um ?? 0)} µm deep.`,
      );
  }

  /** A step back or forth is seen: damage of another surface that it changes is looked at. @param {() => void} [act] */
  step(act = () => this.owner.store().redo()) {
    const before = this.#defects;
    act();
    const after = this.#defects,
      changed = (/** @type {any[]} */ a, /** @type {any[]} */ b) =>
        a.filter((d) => !b.some((o) => JSON.stringify(o) === JSON.stringify(d)));
    const all = [...changed(after, before), ...changed(before, after)];
    if (all.length && !all.some((d) => d.on === this.surface)) this.look(all[0].on, all[0].row ?? 1, all[0].roller ?? this.roller);
  }

  /** @param {any} defect @param {string} key */
  #rebuild(defect, key) {
    const before = this.#shown && JSON.parse(this.#shown),
      now = JSON.parse(key),
      schema = this.owner.schema();
    this.#shown = key;
    if (!schema) return;
    // The fields stay while only places change: a hand may be on one of them.
    const same = before && JSON.stringify(before.slice(0, 4)) === JSON.stringify(now.slice(0, 4));
    const chips = h(
      "div",
      { className: "chips", role: "group", "aria-label": "Damaged places" },
      ...this.#defects.map((/** @type {any} */ d, /** @type {number} */ k) => this.#chip(d, k + 1)),
    );
    if (same) return void this.chosen.querySelector(".chips")?.replaceWith(chips);
    this.fields = defect
      ? defectSpecs(schema, defect, this.selected - 1).map((s) => new Field(s, this.owner.changed, { note: false, range: false }))
      : [];
    const hint = h("p", { className: "hint" }, HINTS[this.raceway.tool]);
    this.chosen.replaceChildren(
      chips,
      ...(this.raceway.tool === "brush" ? [this.depthLabel, this.raiseLabel] : []),
      this.deepest,
      ...this.fields.map((f) => f.element),
      defect ? h("button", { type: "button", onclick: () => this.#heed({ type: "delete" }) }, "Delete") : hint,
    );
    this.owner.rebuilt();
  }

  /** @param {any} defect @param {number} number */
  #chip(defect, number) {
    const names = /** @type {Record<string, string>} */ ({ li2023_irregular: "irregular", depth_map: "depth map" }),
      kind = Object.keys(defect.shape ?? {})[0] ?? "damage";
    const place = `${String(defect.on).replace("-raceway", "")}${(this.rows.options.length > 1 && ` ${defect.row ?? 1}`) || ""}`;
    return h(
      "button",
      { type: "button", "aria-pressed": String(number === this.selected), onclick: () => this.select(number) },
      `${number} ${names[kind] ?? kind}, ${place}, ${typeof defect.center_deg === "string" ? defect.center_deg : `${short(defect.center_deg ?? 0, 3)}°`}`,
    );
  }

  /** @param {Request} request */
  #heed(request) {
    const { type } = request;
    if (type === "undo") this.step(this.owner.undo);
    else if (type === "redo") this.step();
    else if (type === "select") this.select(request.defect);
    else if (type === "begin") this.#begin();
    else if (type === "end") this.#end();
    else if (type === "cancel") this.#cancel();
    else if (type === "shape") this.#put({ shape: request.shape }, request.s, request.z, this.#gesture ?? this.#begin());
    else if (type === "stroke") this.#scratch(request, this.#gesture ?? this.#begin());
    else this.#alter(request);
  }

  #begin() {
    const chosen = this.#defects[this.selected - 1],
      grid = this.raceway.tool === "brush" && chosen?.shape?.depth_map?.columns ? chosen : null;
    notice("taken", null);
    this.#latest = this.#gesture = {
      id: `!${++this.#gestures}`,
      index: grid ? this.selected - 1 : null,
      base: structuredClone(grid),
      scenario: null,
      left: false,
      ended: false,
    };
    return this.#gesture;
  }

  #end() {
    if (this.#gesture) this.#gesture.ended = true;
    this.#gesture = null;
    this.#mend();
  }

  /** The engine refused a scenario: whether that was what the last gesture drew, which is then taken back. @param {any} scenario @param {string} words */
  refused(scenario, words) {
    this.#refusal = { scenario, words };
    return this.#mend();
  }

  /** A drag that ends on what is refused leaves nothing, not what was on its way there. */
  #mend() {
    const one = this.#latest,
      why = this.#refusal;
    if (!one?.ended || !one.scenario || one.scenario !== why?.scenario || one.scenario !== this.owner.store().scenario) return false;
    this.#latest = this.#refusal = null;
    this.owner.store().takeBack();
    notice("taken", `Taken back: ${why?.words}`, { bad: true });
    return true;
  }

  #cancel() {
    // What the engine still works on is not put there any more.
    if (this.#gesture) this.#gesture.left = true;
    if (this.#gesture?.scenario) this.owner.store().takeBack();
    this.#stroke = this.#gesture = null;
  }

  /** Changes of the selected damage. @param {Request} request */
  #alter(request) {
    const at = this.selected - 1,
      store = this.owner.store();
    if (!this.#defects[at]) return;
    if (request.type === "delete") {
      this.selected = 0;
      store.change((s) => {
        s.defects.splice(at, 1);
      });
      this.owner.speak("Damage deleted");
      return;
    }
    store.change((scenario) => {
      const defect = scenario.defects[at];
      if (request.type === "resize") defect.shape = request.shape;
      if (request.type === "deeper") defect.depth_um = Number(((defect.depth_um ?? this.#depth) * DEEPER ** request.factor).toPrecision(3));
      if (request.type === "shift")
        this.#lie(defect, ((defect.center_deg + request.degrees) / 360) * this.#turn, (defect.axial_offset_mm ?? 0) + request.z);
      if (request.type === "move") this.#lie(defect, request.s, request.z);
    }, this.#gesture?.id ?? request.type);
    if (this.#gesture) this.#gesture.scenario = store.scenario;
    const depth = this.#defects[at].depth_um;
    if (depth > 0) this.#depth = depth;
    this.raceway.reveal(this.selected);
  }

  /** @param {any} defect @param {number} s @param {number} z */
  #lie(defect, s, z) {
    defect.center_deg = degrees(s, this.#turn);
    const offset = Number(z.toFixed(3));
    if (offset || defect.axial_offset_mm !== undefined) defect.axial_offset_mm = offset;
  }

  /**
   * New damage, or that of the gesture so far with another shape.
   * @param {any} what
   * @param {number} s
   * @param {number} z
   * @param {Gesture} gesture
   */
  #put(what, s, z, gesture) {
    if (gesture.left) return;
    const store = this.owner.store();
    store.change((scenario) => {
      scenario.defects ??= [];
      if (gesture.index === null || !scenario.defects[gesture.index]) {
        const on = this.surface === "roller" ? { on: "roller", roller: this.roller } : { on: this.surface };
        gesture.index = scenario.defects.push({ ...on, row: this.row, center_deg: 0, depth_um: this.#depth }) - 1;
        this.selected = scenario.defects.length;
      }
      const defect = scenario.defects[gesture.index];
      Object.assign(defect, what);
      this.#lie(defect, s, z);
    }, gesture.id);
    gesture.scenario = store.scenario;
  }

  /**
   * Pen and brush: the engine says which area they cover. Only the newest stroke is asked for.
   * @param {Extract<Request, {type: "stroke"}>} request
   * @param {any} gesture
   */
  async #scratch(request, gesture) {
    this.#stroke = { request, gesture };
    if (this.#asking) return;
    this.#asking = true;
    while (this.#stroke) {
      const {
          request: { tool, points },
          gesture: own,
        } = this.#stroke,
        base = own.base;
      this.#stroke = null;
      const origin = base ? [((base.center_deg ?? 0) / 360) * this.#turn, base.axial_offset_mm ?? 0] : [0, 0];
      const points_mm = Float64Array.from(points.flatMap(([s, z]) => [s - origin[0], z - origin[1]])),
        width_mm = this.raceway.penWidth;
      try {
        const got = await this.owner.ask(
          tool === "pen"
            ? { do: "scratch", points_mm, width_mm }
            : {
                do: "brush",
                grid: base?.shape ?? null,
                points_mm,
                width_mm,
                depth_um: this.#depth,
                raise: this.raise.checked,
              },
        );
        const [s, z] = got.center_mm ?? [0, 0];
        this.#put({ shape: got.shape }, origin[0] + s, origin[1] + z, own);
      } catch (error) {
        this.owner.failed(error);
      }
    }
    this.#asking = false;
  }

  /** Damage from a file, in the middle of what is shown. @param {any} shape @param {boolean} alone  in the place of what is there */
  place(shape, alone) {
    const load = this.surface === "outer-raceway" ? ((this.raceway.loadDeg ?? 0) / 360) * this.#turn : 0,
      gesture = this.#begin();
    gesture.index = null;
    if (alone)
      this.owner.store().change((s) => {
        s.defects = [];
      }, gesture.id);
    this.#put({ shape }, load, 0, gesture);
    this.#gesture = null;
    this.update();
    this.raceway.reveal(this.selected);
  }
}
