// The samples since a bearing was opened, the latest of them at least.

const KEPT = 1 << 17;

export class Trace {
  #values = new Float32Array(4096);
  #length = 0;
  /** Index of the first value that is kept. */
  first = 0;

  get end() {
    return this.first + this.#length;
  }

  /** @param {number} first index of x[0] @param {Float32Array} x */
  push(first, x) {
    if (first !== this.end) this.clear(first);
    if (this.#length + x.length > KEPT) this.#drop(this.#length + x.length - KEPT / 2);
    if (this.#length + x.length > this.#values.length) {
      const wider = new Float32Array(Math.max(2 * this.#values.length, this.#length + x.length));
      wider.set(this.#values.subarray(0, this.#length));
      this.#values = wider;
    }
    this.#values.set(x, this.#length);
    this.#length += x.length;
  }

  /** @param {number} count */
  #drop(count) {
    const gone = Math.min(count, this.#length);
    this.#values.copyWithin(0, gone, this.#length);
    this.#length -= gone;
    this.first += gone;
  }

  clear(first = 0) {
    this.#length = 0;
    this.first = first;
  }

  /** The last values, as many as there are. @param {number} count */
  last(count) {
    const from = Math.max(0, this.#length - count);
    return { first: this.first + from, values: this.#values.slice(from, this.#length) };
  }
}
