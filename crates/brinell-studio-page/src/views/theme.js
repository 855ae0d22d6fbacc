// Colours of the views, light and dark. The page may set any of them as a custom property of the same name (`--ink`, `--blue`, ...).

/** @typedef {Record<keyof typeof LIGHT, string>} Colours */

export const LIGHT = {
  ground: "#ffffff",
  wash: "#f5f7f9",
  ink: "#1b1f24",
  text: "#3a424c",
  faint: "#5f6973",
  line: "#dfe3e8",
  grid: "#e9ecf0",
  frame: "#9aa4ae",
  warn: "#b34700",
  blue: "#0072b2",
  second: "#c25400",
  healthy: "#a9b3bd",
  steel: "#e6eaee",
  cage: "#8b95a0",
  roller: "#ffffff",
  inner: "#00705a",
  damage: "#d04a00",
  bpfo: "#00705a",
  bpfi: "#7a3f9d",
  bsf: "#a3005c",
  ftf: "#6a5600",
};

/** @type {Colours} */
export const DARK = {
  ground: "#14181d",
  wash: "#1b2027",
  ink: "#eef1f4",
  text: "#c9d0d8",
  faint: "#98a2ad",
  line: "#333b44",
  grid: "#232a32",
  frame: "#66717c",
  warn: "#ff9a5c",
  blue: "#5db4ec",
  second: "#ffa05c",
  healthy: "#56616c",
  steel: "#2b333c",
  cage: "#7d8893",
  roller: "#161b21",
  inner: "#4fd0a8",
  damage: "#ff7a3d",
  bpfo: "#4fd0a8",
  bpfi: "#c9a0f0",
  bsf: "#ff8fb8",
  ftf: "#d8c46a",
};

const NAMES = /** @type {(keyof Colours)[]} */ (Object.keys(LIGHT));

/** Properties with an underscore are the ones used inside. */
const rules = (/** @type {Colours} */ colours) => NAMES.map((name) => `--_${name}: var(--${name}, ${colours[name]});`).join(" ");

const CSS = `
:host { ${rules(LIGHT)} display: block; position: relative; color: var(--_text); font: 13px/1.45 Inter, system-ui, "Helvetica Neue", Arial, sans-serif; }
:host([scheme="dark"]) { ${rules(DARK)} }
:host([hidden]) { display: none; }
* { box-sizing: border-box; }
[hidden] { display: none !important; }
.head { display: flex; flex-wrap: wrap; align-items: center; gap: 2px 10px; min-height: 26px; }
.title { color: var(--_ink); font-weight: 600; white-space: nowrap; }
.unit { color: var(--_faint); font-weight: 400; }
.foot { position: relative; }
.foot .readout { position: absolute; top: 3px; right: 0; max-width: calc(100% - 76px); }
.head .readout { flex: 1 1 0; min-width: 0; }
.readout { color: var(--_ink); font-size: 12px; font-variant-numeric: tabular-nums; text-align: right; white-space: nowrap; overflow: hidden; text-overflow: ellipsis; }
.tools { display: flex; flex-wrap: wrap; align-items: center; gap: 4px 8px; }
button, select { min-height: 24px; padding: 1px 9px; border: 1px solid var(--_line); border-radius: 4px; background: var(--_ground); color: var(--_text); font: inherit; font-size: 12px; line-height: 20px; cursor: pointer; }
select { padding: 1px 4px; }
button:hover, select:hover { border-color: var(--_blue); color: var(--_blue); }
button[aria-pressed="true"] { background: var(--_ink); border-color: var(--_ink); color: var(--_ground); }
button:disabled { color: var(--_faint); border-color: var(--_line); cursor: default; }
button:focus-visible, select:focus-visible, input:focus-visible, summary:focus-visible, [tabindex]:focus-visible { outline: 2px solid var(--_blue); outline-offset: 1px; }
input[type="range"] { accent-color: var(--_blue); min-width: 60px; height: 24px; margin: 0; }
label { display: inline-flex; align-items: center; gap: 6px; font-size: 12px; color: var(--_faint); }
output { color: var(--_ink); font-size: 12px; font-variant-numeric: tabular-nums; white-space: nowrap; }
canvas { display: block; position: absolute; inset: 0; }
.empty { position: absolute; inset: 0; display: grid; place-items: center; color: var(--_faint); pointer-events: none; text-align: center; }
.hidden { position: absolute; width: 1px; height: 1px; overflow: hidden; clip-path: inset(50%); white-space: nowrap; }
details { font-size: 12px; }
summary { display: inline-block; min-height: 24px; line-height: 24px; padding: 0 2px; color: var(--_faint); cursor: pointer; border-radius: 3px; }
summary::before { content: "\\25B8\\00A0"; }
details[open] summary::before { content: "\\25BE\\00A0"; }
summary:hover { color: var(--_blue); }
.scroll { max-height: 200px; overflow: auto; }
table { border-collapse: collapse; min-width: min(100%, 420px); }
th, td { padding: 2px 14px 2px 0; border-bottom: 1px solid var(--_line); text-align: right; white-space: nowrap; font-variant-numeric: tabular-nums; }
th:first-child { text-align: left; }
thead th { color: var(--_faint); font-weight: 600; }
tbody th { color: var(--_ink); font-weight: 400; }
@media (forced-colors: active) {
button[aria-pressed="true"] { forced-color-adjust: none; background: Highlight; border-color: Highlight; color: HighlightText; }
.key::before, #hear::before { forced-color-adjust: none; }
}
`;

/** A sheet that many shadow roots share. @param {string} css */
export function sheet(css) {
  const made = new CSSStyleSheet();
  made.replaceSync(css);
  return made;
}

export const base = sheet(CSS);

/** The scheme that the element's page shows: what `color-scheme` says, else what the reader prefers. @param {Element} element */
export function scheme(element) {
  const stated = getComputedStyle(element.parentElement ?? document.documentElement).colorScheme;
  if (/dark/.test(stated) !== /light/.test(stated)) return /dark/.test(stated) ? "dark" : "light";
  return matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light";
}

/** Colours that hold for this element. @param {Element} element @returns {Colours} */
export function colours(element) {
  const style = getComputedStyle(element);
  return /** @type {Colours} */ (
    Object.fromEntries(NAMES.map((name) => [name, style.getPropertyValue(`--_${name}`).trim() || LIGHT[name]]))
  );
}
