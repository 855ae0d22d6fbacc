// <brinell-sound>: the last whole turns of the shaft as a loop, at the pace of the machine. Never by itself: only after a click.
import { short } from "../chart.js";
import { h } from "../dom.js";
import { View } from "./view.js";
import { sheet } from "./theme.js";

/** @typedef {{ rate_hz: number, x: Float32Array, turns?: number }} Loop what `sound` answers; at most +-1 */

/** Time in which one loop gives way to the next, s. */
const FADE = 0.08;
/** Rates that every browser plays, Hz. */
const RATES = [8000, 96000];
/** A file holds whole loops of so long or longer, s. */
const SAVED_S = 5;
const own = sheet(`
:host { display: flex; flex-wrap: wrap; align-items: center; gap: 4px 10px; }
#hear::before { content: ""; display: inline-block; margin-right: 6px; border-style: solid; border-width: 5px 0 5px 8px; border-color: transparent currentColor; }
#hear[aria-pressed="true"]::before { border-width: 0; width: 8px; height: 9px; background: currentColor; }
.told { color: var(--_faint); font-size: 12px; }
label input { width: 110px; }
`);

/** A source that repeats the loop; rates that a browser may refuse are played through the pace of the source. @param {BaseAudioContext} context @param {Loop} loop */
function source(context, loop) {
  const rate = Math.min(Math.max(loop.rate_hz, RATES[0]), RATES[1]),
    buffer = context.createBuffer(1, loop.x.length, rate),
    node = context.createBufferSource();
  buffer.getChannelData(0).set(loop.x);
  node.buffer = buffer;
  node.loop = true;
  node.playbackRate.value = loop.rate_hz / rate;
  return node;
}

export class BrinellSound extends View {
  constructor() {
    super(own);
    /** @type {Loop | null} */
    this.held = null;
    /** @type {AudioContext | null} */
    this.context = null;
    /** @type {GainNode | null} */
    this.volume = null;
    /** What sounds now. @type {{ node: AudioBufferSourceNode, gain: GainNode, loop: Loop, since: number } | null} */
    this.voice = null;
    this.hearing = false;
    this.fading = 0;
    this.button = h("button", { type: "button", id: "hear", "aria-pressed": "false" }, "Hear");
    this.slider = h("input", { type: "range", min: "0", max: "1", step: "0.01", value: "0.6" });
    this.told = h("span", { class: "told" });
    this.root.append(this.button, h("label", {}, "volume", this.slider), this.told);
    this.button.addEventListener("click", () => {
      void this.hear(!this.hearing);
    });
    this.slider.addEventListener("input", () => this.level());
    this.tell();
  }
  disconnectedCallback() {
    super.disconnectedCallback();
    void this.hear(false);
    void this.context?.close();
    this.context = this.volume = null;
  }
  /** @returns {Loop | null} */
  get loop() {
    return this.held;
  }
  set loop(loop) {
    this.held = loop && loop.x?.length > 1 && loop.rate_hz > 0 ? loop : null;
    if (this.hearing) this.exchange();
    this.tell();
  }
  /** Starts or ends the sound. To be called from a click or a key. @param {boolean} on */
  async hear(on) {
    this.hearing = on;
    if (!on) {
      this.silence();
      this.tell();
      return;
    }
    this.context ??= new AudioContext();
    if (!this.volume) {
      this.volume = this.context.createGain();
      this.volume.connect(this.context.destination);
    }
    this.level();
    this.tell();
    await this.context.resume();
    // Asked to be silent again meanwhile.
    if (this.hearing) this.exchange();
    this.tell();
  }
  level() {
    // A squared slider is nearer to what is heard as half as loud.
    if (this.volume && this.context) this.volume.gain.setTargetAtTime(Number(this.slider.value) ** 2, this.context.currentTime, 0.015);
    this.slider.setAttribute("aria-valuetext", `${Math.round(100 * Number(this.slider.value))} %`);
  }
  /** The newest loop takes over from the one that sounds; while one gives way, the next waits. */
  exchange() {
    const { context, volume, held, voice } = this;
    if (!context || !volume || !held || voice?.loop === held || this.fading) return;
    const now = context.currentTime,
      node = source(context, held),
      gain = context.createGain(),
      turn = held.x.length / held.rate_hz;
    node.connect(gain).connect(volume);
    gain.gain.setValueAtTime(0, now);
    gain.gain.linearRampToValueAtTime(1, now + FADE);
    node.start(now, node.buffer ? ((now - (voice?.since ?? now)) % turn) * node.playbackRate.value : 0);
    if (voice) this.fade(voice, now);
    this.voice = { node, gain, loop: held, since: voice?.since ?? now };
    this.fading = window.setTimeout(() => {
      this.fading = 0;
      if (this.hearing) this.exchange();
    }, 1000 * FADE);
  }
  /** @param {{ node: AudioBufferSourceNode, gain: GainNode }} voice @param {number} now */
  fade(voice, now) {
    voice.gain.gain.cancelScheduledValues(now);
    voice.gain.gain.setValueAtTime(voice.gain.gain.value, now);
    voice.gain.gain.linearRampToValueAtTime(0, now + FADE);
    voice.node.stop(now + FADE + 0.01);
    voice.node.onended = () => {
      voice.node.disconnect();
      voice.gain.disconnect();
    };
  }
  silence() {
    clearTimeout(this.fading);
    this.fading = 0;
    const { context, voice } = this;
    this.voice = null;
    if (!context) return;
    if (voice) this.fade(voice, context.currentTime);
    // The context rests once the fade is over.
    setTimeout(() => {
      if (!this.hearing && context.state === "running") void context.suspend();
    }, 2000 * FADE);
  }
  tell() {
    const loop = this.held,
      length = loop ? loop.x.length / loop.rate_hz : 0;
    this.button.setAttribute("aria-pressed", String(this.hearing));
    this.dataset.state = this.hearing ? (this.voice ? "sounding" : "waiting") : "silent";
    this.told.textContent = loop
      ? `${loop.turns ? `${loop.turns} turns, ` : ""}${short(length, 2)} s, looped at real pace`
      : this.hearing
        ? "waiting for whole turns"
        : "";
  }
  /** What is heard as a file: WAV, mono, 16 bits. @returns {Blob | null} */
  wav() {
    const loop = this.held;
    if (!loop) return null;
    const { x } = loop,
      rate = Math.round(loop.rate_hz),
      count = x.length * Math.ceil((SAVED_S * rate) / x.length),
      view = new DataView(new ArrayBuffer(44 + 2 * count));
    const words = (/** @type {number} */ at, /** @type {string} */ text) =>
      [...text].forEach((c, k) => view.setUint8(at + k, c.charCodeAt(0)));
    const [u16, u32] = [
      (/** @type {number} */ at, /** @type {number} */ v) => view.setUint16(at, v, true),
      (/** @type {number} */ at, /** @type {number} */ v) => view.setUint32(at, v, true),
    ];
    words(0, "RIFF");
    u32(4, 36 + 2 * count);
    words(8, "WAVEfmt ");
    // 16 bytes of format: PCM, one channel, rate, bytes a second, bytes a sample, bits.
    u32(16, 16);
    u16(20, 1);
    u16(22, 1);
    u32(24, rate);
    u32(28, 2 * rate);
    u16(32, 2);
    u16(34, 16);
    words(36, "data");
    u32(40, 2 * count);
    for (let k = 0; k < count; k++) view.setInt16(44 + 2 * k, Math.round(32767 * x[k % x.length]), true);
    return new Blob([view], { type: "audio/wav" });
  }
  /** What is heard of a loop, rendered without a loudspeaker. @param {Loop} loop @param {number} [seconds] @returns {Promise<AudioBuffer>} */
  static render(loop, seconds = 1) {
    const rate = Math.min(Math.max(loop.rate_hz, RATES[0]), RATES[1]),
      context = new OfflineAudioContext(1, Math.round(seconds * rate), rate),
      node = source(context, loop);
    node.connect(context.destination);
    node.start();
    return context.startRendering();
  }
}
customElements.define("brinell-sound", BrinellSound);
