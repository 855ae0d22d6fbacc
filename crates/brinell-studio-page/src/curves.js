// Gives the curve views what came last: this bearing, and behind or beside it the healthy one, the other one or a measured signal.
import { still } from "./dom.js";

/** @typedef {import("./side.js").Side} Side */

// Shown of a live signal, s.
const WINDOW_S = 0.1;
const WAVE_MS = 50,
  STILL_MS = 1000;

/** The spectra that are shown: of two bearings those of equally many samples, until there are some the first one's. @param {Side} side @param {Side | undefined} other */
const paired = (side, other) =>
  other && side.equal && side.equal.samples === other.equal?.samples ? [side.equal, other.equal] : [side.spectra, undefined];

export class CurveViews {
  #wave = -Infinity;
  #views = /** @type {any[]} */ (
    ["waveform", "spectrum", "envelope"].map((kind) => document.querySelector(`#curves brinell-curve[kind="${kind}"]`))
  );
  #shown = /** @type {any[]} */ ([]);

  /**
   * Whether all was drawn; else it is to be asked again in the next frame.
   * @param {Side} side the one that is edited: the first curve and the marks are its
   * @param {Side | undefined} other
   * @param {any} healthy
   * @param {any} measured
   * @param {number} now
   */
  draw(side, other, healthy, measured, now) {
    const [waveform, spectrum, envelope] = this.#views,
      [own, beside] = paired(side, other),
      inputs = [side, other, own, beside, healthy, measured];
    if (inputs.some((v, k) => v !== this.#shown[k])) {
      this.#shown = inputs;
      spectrum.data = this.#spectrum(side, other, own, beside, healthy, measured, "spectrum");
      envelope.data = this.#spectrum(side, other, own, beside, healthy, measured, "envelope");
    }
    if (now - this.#wave < (still() ? STILL_MS : WAVE_MS)) return false;
    this.#wave = now;
    waveform.data = side.opened ? this.#waveform(side, other, healthy) : null;
    return true;
  }

  /** @param {Side} side @param {Side | undefined} other @param {any} healthy */
  #waveform(side, other, healthy) {
    const rate = side.opened.rate_hz,
      whole = side.live.state === "done",
      cut = (/** @type {Side} */ s) => s.trace.last(whole ? Infinity : Math.round(WINDOW_S * s.opened.rate_hz)).values;
    const { first } = side.trace.last(whole ? Infinity : Math.round(WINDOW_S * rate)),
      values = cut(side),
      x0 = first / rate;
    const behind =
      side.damage.length && healthy?.rate_hz === rate
        ? {
            x0,
            dx: 1 / rate,
            values: whole ? healthy.x.subarray(0, values.length) : healthy.x.subarray(Math.max(0, healthy.x.length - values.length)),
          }
        : null;
    const second = other?.opened ? { x0, dx: 1 / other.opened.rate_hz, values: cut(other) } : null;
    // Of a whole run the first view leaves out what does not count yet: the load as it comes up.
    const settled = whole ? side.opened.settled_s : undefined;
    return {
      x0,
      dx: 1 / rate,
      values,
      unit: side.opened.unit,
      lines: [],
      behind,
      second,
      names: [side.name, other?.name],
      settled,
      stored: "stored" in side,
    };
  }

  /** @param {Side} side @param {Side | undefined} other @param {any} own @param {any} theirs @param {any} healthy @param {any} measured @param {"spectrum" | "envelope"} kind */
  #spectrum(side, other, own, theirs, healthy, measured, kind) {
    const got = own?.[kind];
    if (!got) return null;
    const curve = (/** @type {any} */ one) => (one?.values?.length ? { x0: 0, dx: one.df, values: one.values } : null),
      { lines } = own;
    // On one axis only what has its unit; a measured signal then takes the other bearing's place.
    const beside = measured?.unit === side.opened.unit ? curve(measured[kind]) : null;
    const names = beside
      ? [other ? `${side.name}, simulated (${other.name} is not shown)` : "simulated", "measured"]
      : [kind === "envelope" && lines.length ? `${side.name}, with its lines` : side.name, other?.name];
    return {
      x0: 0,
      dx: got.df,
      values: got.values,
      unit: side.opened.unit,
      lines,
      band_hz: got.band_hz,
      behind: side.damage.length ? curve(healthy?.[kind]) : null,
      second: beside ?? curve(theirs?.[kind]),
      names,
      stored: "stored" in side,
    };
  }
}
