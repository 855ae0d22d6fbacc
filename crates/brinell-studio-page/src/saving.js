// What leaves the page: scenario, signals, sound, pictures, a link. Only what the fields say, once the engine has opened it.
import { byId } from "./dom.js";
import { download, saveMenu, savePictures, share } from "./files.js";
import { notice } from "./notices.js";

/**
 * @typedef {object} Owner
 * @property {() => import("./side.js").Side} side
 * @property {() => import("./controls.js").Field[]} fields
 * @property {() => any[]} views
 * @property {() => any} sound
 * @property {() => void} undo
 * @property {(error: unknown) => void} failed
 */

export class Saving {
  /** @param {Owner} owner */
  constructor(owner) {
    this.owner = owner;
  }

  /** Binds the Save menu and the Share button. */
  bind() {
    const signals = (/** @type {"csv" | "wav" | "npz"} */ format) => () => this.#signals(format),
      pictures = (/** @type {"svg" | "png"} */ format) => () => this.#pictures(format);
    saveMenu(
      [
        ["Scenario, TOML", () => this.#scenario()],
        ["Signals, CSV", signals("csv")],
        ["Signals, WAV", signals("wav")],
        ["Signals, NPZ", signals("npz")],
        ["Sound, WAV", () => this.#sound()],
        ["Pictures, SVG", pictures("svg")],
        ["Pictures, PNG", pictures("png")],
      ],
      "Signals are those of a run from t = 0, which is done first; the sound is what Hear plays.",
    );
    byId("share").addEventListener("click", () => this.#share());
  }

  /** What is refused is not run, saved or shared: the fields would say one thing and the run another. */
  isRefused() {
    const field = this.owner.fields().find((f) => f.unread);
    if (!field && !this.owner.side().problems.length) return false;
    notice(
      "unsaved",
      field
        ? `${field.spec.label}: ${field.unread}. Correct it first.`
        : "The present scenario is refused, so the last good one runs. Correct it or undo first.",
      { bad: true, actions: field ? [] : [["Undo", this.owner.undo]] },
    );
    return true;
  }

  /** The bearing on the page once the engine has opened the last edit, that in a field with the focus too; null, and why, where it has not. */
  async #present() {
    const at = document.activeElement;
    // A finger's tap on a button may leave the focus where it is.
    if (at instanceof HTMLInputElement) at.blur();
    const side = this.owner.side(),
      answered = await side.live.settled();
    if (side !== this.owner.side() || this.isRefused() || !side.opened) return null;
    if (answered) return side;
    notice("unsaved", "The engine was lost before it opened what the fields say, so that is neither saved nor shared.", {
      bad: true,
      actions: [["Save the last good scenario", () => this.#toml(side)]],
    });
    return null;
  }

  /** @param {import("./side.js").Side} side */
  #name(side) {
    return side.opened?.scenario.name ?? "scenario";
  }

  /** @param {import("./side.js").Side} side */
  #toml(side) {
    download(new Blob([side.opened.toml], { type: "application/toml" }), `${this.#name(side)}.toml`);
  }

  async #scenario() {
    const side = await this.#present();
    if (side) this.#toml(side);
  }

  /** What is saved is a run from t = 0. @param {"csv" | "wav" | "npz"} format */
  async #signals(format) {
    const side = await this.#present();
    if (!side) return;
    try {
      if (!(await side.finished())) return notice("failed", "The run was left before its end, so nothing was saved.", { bad: true });
      const { name, type, bytes } = await side.live.ask({ do: "save", format });
      download(new Blob([bytes], { type }), name);
    } catch (error) {
      this.owner.failed(error);
    }
  }

  async #sound() {
    const side = await this.#present();
    if (!side) return;
    const loop = await side.heard(),
      sound = this.owner.sound();
    if (loop && side === this.owner.side()) sound.loop = loop;
    const wav = loop && side === this.owner.side() ? sound.wav?.() : null;
    if (wav) download(wav, `${this.#name(side)}-sound.wav`);
    else notice("failed", "There are no whole turns of the shaft to hear yet.", { bad: true });
  }

  /** @param {"svg" | "png"} format */
  #pictures(format) {
    savePictures(this.owner.views(), this.#name(this.owner.side()), format);
  }

  async #share() {
    const side = await this.#present();
    if (side) share(side.opened.toml, () => this.#toml(side));
  }
}
