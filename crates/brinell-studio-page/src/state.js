// The scenario as the page holds it: the stated keys as JSON, what was before, and where it is kept.

/** @typedef {Record<string, any>} Scenario */
/** @typedef {(string | number)[]} Path */

const STEPS = 200,
  TOGETHER_MS = 900,
  KEY = "brinell-studio",
  EDIT = `${KEY}-edit`;
// A link that is longer is cut by some mail programs and chats.
export const LINK_LIMIT = 8192;
const INFLATED_LIMIT = 1 << 24;

/** @param {any} tree @param {Path} path @returns {any} */
export const get = (tree, path) => path.reduce((node, key) => node?.[key], tree);

/**
 * Sets a key of the tree, making the tables on its way; `undefined` takes it out, and tables that it leaves empty.
 * @param {any} tree @param {Path} path @param {unknown} value
 */
export function set(tree, path, value) {
  const [key, ...rest] = path;
  if (!rest.length) {
    if (value === undefined) delete tree[key];
    else tree[key] = value;
    return;
  }
  if (tree[key] === undefined) {
    if (value === undefined) return;
    tree[key] = typeof rest[0] === "number" ? [] : {};
  }
  set(tree[key], rest, value);
  if (value === undefined && !Array.isArray(tree[key]) && typeof tree[key] === "object" && !Object.keys(tree[key]).length) delete tree[key];
}

/**
 * Where the engine's name of a key points: `defects[1].depth_um` counts from 1, `defects.0.depth_um` from 0.
 * @param {string | null} key
 * @returns {Path}
 */
export function pathOf(key) {
  if (!key) return [];
  return key.split(".").flatMap((part) => {
    const [, name, index] = /^([^[]*)(?:\[(\d+)\])?$/.exec(part) ?? [null, part];
    if (index !== undefined) return [name, Number(index) - 1];
    return [/^\d+$/.test(name) ? Number(name) : name];
  });
}

export class Store {
  /** @type {Scenario} */
  scenario = {};
  /** @type {Scenario[]} */
  #past = [];
  /** @type {Scenario[]} */
  #future = [];
  #group = "";
  #at = -Infinity;
  #changed;

  /** @param {(scenario: Scenario) => void} changed */
  constructor(changed) {
    this.#changed = changed;
  }

  /**
   * Edits a copy of the scenario. Edits of one group that follow each other soon are one step of undo; those of a gesture (its group begins
   * with "!") however long it lasts.
   * @param {(scenario: Scenario) => void} edit
   */
  change(edit, group = "") {
    const now = performance.now(),
      joined = group !== "" && group === this.#group && (group.startsWith("!") || now - this.#at < TOGETHER_MS);
    const next = structuredClone(this.scenario);
    edit(next);
    if (!joined) this.#keep();
    [this.#group, this.#at] = [group, now];
    this.#future = [];
    this.scenario = next;
    this.#changed(next);
  }

  /** The edits so far are a step of their own, whatever comes next. */
  seal() {
    this.#group = "";
  }

  #keep() {
    this.#past.push(this.scenario);
    if (this.#past.length > STEPS) this.#past.shift();
  }

  /** A scenario from outside; undo leads back from it. @param {Scenario} scenario */
  replace(scenario) {
    if (Object.keys(this.scenario).length) this.#keep();
    this.#future = [];
    this.seal();
    this.scenario = structuredClone(scenario);
  }

  get canUndo() {
    return this.#past.length > 0;
  }
  get canRedo() {
    return this.#future.length > 0;
  }

  undo() {
    this.#step(this.#past, this.#future);
  }
  redo() {
    this.#step(this.#future, this.#past);
  }

  /** Undoes the last edit for good: no redo leads to it. */
  takeBack() {
    const after = this.#future.length;
    this.undo();
    this.#future.length = after;
  }

  /** @param {Scenario[]} from @param {Scenario[]} to */
  #step(from, to) {
    const scenario = from.pop();
    if (!scenario) return;
    to.push(this.scenario);
    this.seal();
    this.scenario = scenario;
    this.#changed(scenario);
  }
}

/** What was on this page last time, else on any; `edit` as JSON where the engine had not answered it. Storage may be forbidden. @returns {{toml: string | null, edit: string | null}} */
export function remembered() {
  try {
    const store = sessionStorage.getItem(KEY) === null ? localStorage : sessionStorage;
    const edit = store.getItem(EDIT);
    // An edit that ends its engine is tried once, not at each reload.
    for (const kept of [sessionStorage, localStorage]) if (kept.getItem(EDIT) === edit) kept.removeItem(EDIT);
    return { toml: store.getItem(KEY), edit };
  } catch {
    return { toml: null, edit: null };
  }
}

/** @param {string} toml the bearing that runs @param {Scenario | undefined} edit what the engine has not answered yet */
export function remember(toml, edit) {
  try {
    for (const store of [sessionStorage, localStorage]) {
      store.setItem(KEY, toml);
      if (edit) store.setItem(EDIT, JSON.stringify(edit));
      else store.removeItem(EDIT);
    }
  } catch {
    // Then nothing is kept.
  }
}

/** @param {Uint8Array<ArrayBuffer>} bytes @param {CompressionStream | DecompressionStream} stream @param {number} limit */
async function through(bytes, stream, limit) {
  const reader = new Blob([bytes])
    .stream()
    .pipeThrough(/** @type {any} */ (stream))
    .getReader();
  /** @type {Uint8Array<ArrayBuffer>[]} */
  const parts = [];
  for (let size = 0; ;) {
    const { done, value } = await reader.read();
    if (done) break;
    size += value.length;
    if (size > limit) throw new Error("the link holds more than a scenario");
    parts.push(value);
  }
  return new Blob(parts).arrayBuffer();
}

/** @param {string} toml */
export async function toLink(toml) {
  const bytes = new Uint8Array(await through(new TextEncoder().encode(toml), new CompressionStream("deflate-raw"), INFLATED_LIMIT));
  let text = "";
  for (const byte of bytes) text += String.fromCharCode(byte);
  return `#s=${btoa(text).replaceAll("+", "-").replaceAll("/", "_").replace(/=+$/, "")}`;
}

/** The TOML in a link's fragment, or null where it has none. @param {string} hash */
export async function fromLink(hash) {
  const text = /^#s=([\w-]+)$/.exec(hash)?.[1];
  if (!text) return null;
  const bytes = Uint8Array.from(atob(text.replaceAll("-", "+").replaceAll("_", "/")), (c) => c.charCodeAt(0));
  return new TextDecoder("utf-8", { fatal: true }).decode(await through(bytes, new DecompressionStream("deflate-raw"), INFLATED_LIMIT));
}
