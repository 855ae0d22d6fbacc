// A photo of damage in the dialog: two clicks on it and the length between them are its scale, and the outline that was found lies over it.
import { h, numberInput, numberOf } from "./dom.js";
import { line } from "./measured.js";

/** @typedef {{px: number, mm: number}} Bar */

export class Photo {
  /** What is told of the scale once two clicks and a length make one. @type {(bar: Bar) => void} */
  marked = () => {};
  /** Pixels from the upper left corner. @type {[number, number][]} */
  #ends = [];
  /** @type {[number, number]} */
  #size = [1, 1];
  #found = drawn("path", "found");
  #bar = drawn("path", "bar");
  #over = drawn("svg");
  #image;
  #mm = numberInput({}, 1, 0);

  /** @param {Uint8Array<ArrayBuffer>} bytes of a PNG or JPEG */
  constructor(bytes) {
    this.#image = h("img", { alt: "The photo, with the outline that was found", src: URL.createObjectURL(new Blob([bytes])) });
    this.#image.addEventListener("load", () => {
      this.#size = [this.#image.naturalWidth, this.#image.naturalHeight];
      this.element.style.setProperty("--aspect", String(this.#size[0] / this.#size[1]));
      this.#over.setAttribute("viewBox", `0 0 ${this.#size.join(" ")}`);
    });
    this.#over.setAttribute("preserveAspectRatio", "none");
    this.#over.append(this.#found, this.#bar);
    this.#over.addEventListener("click", (e) => this.#click(/** @type {MouseEvent} */ (e)));
    this.#mm.addEventListener("input", () => this.#tell());
    this.#mm.addEventListener("change", () => this.#tell());
    this.element = h("div", { className: "photo" }, this.#image, this.#over);
    this.scale = line(
      "Length between two clicks",
      this.#mm,
      "mm",
      "click on both ends of a length that you know, such as a scale bar; or state the scale below",
    );
  }

  /** @param {MouseEvent} e */
  #click(e) {
    const box = this.#over.getBoundingClientRect(),
      at = /** @type {[number, number]} */ ([
        ((e.clientX - box.left) / box.width) * this.#size[0],
        ((e.clientY - box.top) / box.height) * this.#size[1],
      ]);
    // A third click begins anew.
    this.#ends = this.#ends.length === 1 ? [...this.#ends, at] : [at];
    this.#draw();
    if (this.#ends.length === 2 && !this.#mm.value) this.#mm.focus();
    this.#tell();
  }

  #tell() {
    const [a, b] = this.#ends,
      mm = numberOf(this.#mm.value),
      px = b ? Number(Math.hypot(a[0] - b[0], a[1] - b[1]).toFixed(2)) : 0;
    if (px > 0 && typeof mm === "number" && mm > 0) this.marked({ px, mm });
  }

  /** A line between the clicks, with a cross at either. */
  #draw() {
    const arm = 0.015 * Math.max(...this.#size),
      cross = this.#ends.map(([x, y]) => `M${x - arm} ${y}h${2 * arm}M${x} ${y - arm}v${2 * arm}`).join("");
    this.#bar.setAttribute("d", `${cross}${this.#ends.length === 2 ? `M${this.#ends.map((p) => p.join(" ")).join("L")}` : ""}`);
  }

  /** The outlines, pixels from the upper left corner. @param {Float32Array[]} rings */
  outline(rings) {
    const ring = (/** @type {Float32Array} */ xy) => `M${xy.join(" ")}Z`;
    this.#found.setAttribute("d", rings.map(ring).join(""));
  }

  /** Another scale was given. */
  clear() {
    this.#ends = [];
    this.#mm.value = "";
    this.#draw();
  }

  close() {
    URL.revokeObjectURL(this.#image.src);
  }
}

/** @param {"svg" | "path"} tag @param {string} [name] */
function drawn(tag, name) {
  const node = document.createElementNS("http://www.w3.org/2000/svg", tag);
  if (name) node.setAttribute("class", name);
  return node;
}
