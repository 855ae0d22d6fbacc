// Messages between page and engine: a length, JSON, and the arrays that the JSON points at. crates/brinell-studio/messages.md is the contract.

/** @typedef {Float32Array | Float64Array | Uint8Array} Numbers */

const ALIGN = 8;
const KINDS = { f32: Float32Array, f64: Float64Array, u8: Uint8Array };

/** @param {number} n */
const padded = (n) => Math.ceil(n / ALIGN) * ALIGN;

/** @param {unknown} value @returns {keyof typeof KINDS | null} */
function kindOf(value) {
  if (value instanceof Float32Array) return "f32";
  if (value instanceof Float64Array) return "f64";
  return value instanceof Uint8Array ? "u8" : null;
}

/**
 * The bytes of a message. Typed arrays in it follow the JSON.
 * @param {object} message
 * @returns {Uint8Array<ArrayBuffer>}
 */
export function encode(message) {
  /** @type {[number, Numbers][]} */
  const arrays = [];
  let size = 0;
  const json = JSON.stringify(message, (_key, value) => {
    const kind = kindOf(value);
    if (!kind) return value;
    const at = size;
    arrays.push([at, value]);
    size = padded(size + value.byteLength);
    return { $: [kind, at, value.length] };
  });
  const text = new TextEncoder().encode(json);
  const start = padded(4 + text.length),
    bytes = new Uint8Array(start + size);
  new DataView(bytes.buffer).setUint32(0, text.length, true);
  bytes.set(text, 4);
  for (const [at, values] of arrays) bytes.set(new Uint8Array(values.buffer, values.byteOffset, values.byteLength), start + at);
  return bytes;
}

/**
 * The message in the bytes. Its arrays are views of the bytes, which therefore belong to the message from now on.
 * @param {Uint8Array<ArrayBuffer>} bytes
 * @returns {any}
 */
export function decode(bytes) {
  const whole = bytes.byteOffset % ALIGN === 0 ? bytes : bytes.slice();
  const length = new DataView(whole.buffer, whole.byteOffset).getUint32(0, true),
    start = padded(4 + length);
  return JSON.parse(new TextDecoder().decode(whole.subarray(4, 4 + length)), (_key, value) => {
    const place = value?.$;
    if (!Array.isArray(place)) return value;
    const [kind, at, count] = place,
      Kind = KINDS[/** @type {keyof typeof KINDS} */ (kind)];
    return new Kind(whole.buffer, whole.byteOffset + start + at, count);
  });
}
