// Words and numbers below the views: indicators with their intervals, the verdict, and how the run is going.
import { short } from "./chart.js";
import { byId, digitsOf, h, spelled } from "./dom.js";

/** @typedef {import("./side.js").Side} Side */

const QUIET_MS = 3500;

/** @param {string} name @param {string} value */
const pair = (name, value) => h("div", {}, h("dt", {}, name), h("dd", {}, value));

// Of a finished run, which has all channels: those of the sensor's axis, by the ends of their names. Its peaks are means over revolutions, a live one's the record's.
const RUN = [
    ["rms", "RMS"],
    ["peak", "mean peak of a revolution"],
    ["crest_factor", "mean peak over RMS"],
    ["kurtosis", "kurtosis"],
  ],
  MOST = 7;

/** Quantities and what they are called here. @param {any[]} list @param {string} axis @returns {[any, string][]} */
function named(list, axis) {
  const run = RUN.map(([end, words]) => [list.find((q) => q.name === `${axis}.${end}`), words]).filter(([q]) => q);
  if (!run.length) return list.slice(0, MOST).map((q) => [q, q.name]);
  const hz = list
    .filter((q) => /^defect\d+\.frequency$/.test(q.name) && q.value !== null)
    .map((q) => [q, `frequency of damage ${/\d+/.exec(q.name)}`]);
  return /** @type {[any, string][]} */ ([...run, ...hz].slice(0, MOST));
}

/** A number without a unit has the unit 1, which is not written. @param {string} unit */
const written = (unit) => (unit && unit !== "1" ? ` ${spelled(unit)}` : "");

/** @param {Side} side */
function figures(side) {
  const list = side.indicators?.quantities,
    unit = spelled(side.opened?.unit ?? "");
  if (list?.length) {
    return named(list, side.opened?.axis).map(([q, words]) => {
      const known = (/** @type {any} */ v) => v !== null && v !== undefined,
        bounded = known(q.low) && known(q.high) && q.low !== q.high;
      const digits = bounded ? digitsOf(q.low, q.high) : 3,
        interval = bounded ? ` (${short(q.low, digits)} to ${short(q.high, digits)})` : "";
      return pair(words, `${short(q.value, digits)}${written(q.unit)}${interval}`);
    });
  }
  const m = side.moments;
  if (!m) return [];
  const enough = m.samples >= side.needed,
    shown = (/** @type {number} */ v, unit = "") => (enough ? `${short(v)}${unit}` : "–");
  return [
    pair("RMS", shown(m.rms, ` ${unit}`)),
    pair("peak", shown(m.peak, ` ${unit}`)),
    pair("crest factor", shown(m.crest)),
    pair("kurtosis", shown(m.kurtosis)),
  ];
}

/** The state of a bearing's run, in words. @param {Side} side */
function state(side) {
  const { live, opened, moments } = side;
  if (live.state === "loading") return opened ? "stored run" : "";
  if (live.state === "lost") return "engine lost";
  const long = `run from t = 0, ${short(opened?.samples / opened?.rate_hz)} s`;
  if (live.state === "done") return long;
  const now = live.whole ? `${long}, ${side.percent} %` : opened?.quick ? `${live.state}, quick tables` : live.state,
    paused = live.whole && live.state === "paused" ? ", paused" : "";
  // Samples count from where the bearing has settled.
  const n = moments?.samples,
    counted = n ? `, ${n}${n < side.needed ? ` of a turn's ${side.needed}` : ""} samples` : moments ? ", settling" : "";
  return `${opened ? now + paused : ""}${counted}`;
}

/** Words of the engine, which are those of a terminal, with a true minus. @param {string} words */
const proper = (words) => words.replace(/(?<![\w)])-(?=\d)/g, "−").replace(/[−+](0\.0+ %)/g, "$1");

/** @param {HTMLElement} root @param {Side[]} sides the one that is shown first @param {string} difference of two, in words */
export function readout(root, sides, difference) {
  const several = sides.length > 1;
  root.classList.toggle("several", several);
  const differ = several
    ? h("span", { className: "headline differ" }, difference || "How B differs is said when both have a verdict")
    : null;
  root.replaceChildren(
    ...(differ ? [differ] : []),
    ...sides.map((side) =>
      h(
        "div",
        { className: "one" },
        ...(several ? [h("span", { className: "name" }, side.name), h("dl", {}, ...figures(side))] : []),
        h(
          "span",
          { className: "headline" },
          proper(side.verdict?.headline ?? "") || (side.opened ? "Not enough signal for a verdict yet" : ""),
        ),
        h(
          "span",
          { className: "note" },
          several
            ? state(side)
            : [
                state(side),
                side.pace && side.live.state !== "paused" ? `${short(side.pace, 2)} × real time` : "",
                side.took ? `edit in ${Math.round(side.took)} ms` : "",
              ]
                .filter(Boolean)
                .join(" · "),
        ),
        several ? null : h("dl", {}, ...figures(side)),
      ),
    ),
  );
}

let spoken = "",
  last = -Infinity,
  timer = 0;

/** Says it to a screen reader, politely: not again and again, and only the newest. @param {string} words */
export function speak(words) {
  if (words === spoken) return;
  spoken = words;
  clearTimeout(timer);
  timer = setTimeout(
    () => {
      last = performance.now();
      byId("live").textContent = words;
    },
    Math.max(150, QUIET_MS - (performance.now() - last)),
  );
}

/** What the engine does with a bearing, on the page; whether its motion is stopped. @param {import("./side.js").Side} side */
export function showState(side) {
  const { state } = side.live,
    bad = side.problems.length > 0,
    node = byId("state");
  const made = side.live.computing,
    table = made === null ? "" : `table is being computed${made ? `, ${made} s` : ""}`,
    live = bad ? "live, last good one" : table || (side.opened.quick ? "live, quick tables" : state),
    words = /** @type {Record<string, string>} */ ({ lost: "engine lost", live, running: `running ${side.percent} %` });
  node.textContent = side.live.working && state !== "lost" ? (state === "running" && table) || "working" : (words[state] ?? state);
  node.title = side.opened.quick ? "Damage acts by quick tables until the scenario's own are made" : "";
  node.dataset.state = state;
  node.toggleAttribute("data-bad", bad);
  byId("run").textContent = side.live.whole ? "Cancel" : `Run ${short(side.live.opened.samples / side.live.opened.rate_hz)} s`;
  byId("pause").textContent = state === "live" || state === "running" ? "Pause" : state === "lost" ? "Start again" : "Live";
  return state === "paused" || state === "done" || state === "lost";
}
