// What a view draws with: the part of a canvas' context that SVG can hold as well, so that one function draws both.

/**
 * @typedef {Pick<CanvasRenderingContext2D, "fillStyle" | "strokeStyle" | "lineWidth" | "globalAlpha" | "font" | "textAlign" | "textBaseline" | "lineCap" | "lineJoin"
 *   | "beginPath" | "moveTo" | "lineTo" | "closePath" | "arc" | "rect" | "stroke" | "fill" | "clip" | "fillText" | "setLineDash" | "save" | "restore">} Pen
 */

export const FAMILY = 'Inter, system-ui, "Helvetica Neue", Arial, sans-serif';
/** @param {number} size px @param {number} [weight] */
export const font = (size, weight = 400) => `${weight} ${size}px ${FAMILY}`;
/** A path along points. @param {Pen} pen @param {number[][]} points @param {boolean} [closed] */
export function path(pen, points, closed = false) {
  pen.beginPath();
  points.forEach(([x, y], k) => (k ? pen.lineTo(x, y) : pen.moveTo(x, y)));
  if (closed) pen.closePath();
}
/** @type {CanvasRenderingContext2D | null} */
let ruler = null;
/** Width of a text, px. @param {string} text @param {number} size @param {number} [weight] */
export function breadth(text, size, weight = 400) {
  ruler ??= document.createElement("canvas").getContext("2d");
  if (!ruler) return 0.57 * size * text.length;
  ruler.font = font(size, weight);
  return ruler.measureText(text).width;
}

const number = (/** @type {number} */ v) => String(Math.round(100 * v) / 100);
const escape = (/** @type {string} */ text) =>
  text.replace(/[&<>"]/g, (c) => ({ "&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;" })[c] ?? c);

const START = {
  fillStyle: "#000",
  strokeStyle: "#000",
  lineWidth: 1,
  globalAlpha: 1,
  font: font(12),
  textAlign: "start",
  textBaseline: "alphabetic",
  lineCap: "butt",
  lineJoin: "miter",
};
const ANCHOR = /** @type {Record<string, string>} */ ({ center: "middle", right: "end", end: "end" });
const BASELINE = /** @type {Record<string, number>} */ ({ middle: 0.36, top: 0.8, hanging: 0.8 });
const KEPT = /** @type {(keyof typeof START)[]} */ (Object.keys(START));

/** Writes what is drawn as SVG. Clips hold until `restore`. @implements {Pen} */
export class SvgPen {
  /** @param {number} width px @param {number} height px @param {string} title @param {string} ground */
  constructor(width, height, title, ground) {
    /** @type {string | CanvasGradient | CanvasPattern} */
    this.fillStyle = START.fillStyle;
    /** @type {string | CanvasGradient | CanvasPattern} */
    this.strokeStyle = START.strokeStyle;
    this.lineWidth = START.lineWidth;
    this.globalAlpha = START.globalAlpha;
    this.font = START.font;
    /** @type {CanvasTextAlign} */
    this.textAlign = "start";
    /** @type {CanvasTextBaseline} */
    this.textBaseline = "alphabetic";
    /** @type {CanvasLineCap} */
    this.lineCap = "butt";
    /** @type {CanvasLineJoin} */
    this.lineJoin = "miter";
    /** @type {number[]} */
    this.dash = [];
    /** @type {{ state: any, dash: number[], groups: number }[]} */
    this.stack = [];
    this.groups = 0;
    this.clips = 0;
    this.path = "";
    /** @type {string[]} */
    this.parts = [
      `<svg xmlns="http://www.w3.org/2000/svg" width="${number(width)}" height="${number(height)}" viewBox="0 0 ${number(width)} ${number(height)}" role="img">`,
      `<title>${escape(title)}</title>`,
      `<rect width="100%" height="100%" fill="${ground}"/>`,
    ];
  }
  beginPath() {
    this.path = "";
  }
  /** @param {number} x @param {number} y */
  moveTo(x, y) {
    this.path += `M${number(x)} ${number(y)}`;
  }
  /** @param {number} x @param {number} y */
  lineTo(x, y) {
    this.path += `${this.path ? "L" : "M"}${number(x)} ${number(y)}`;
  }
  closePath() {
    this.path += "Z";
  }
  /** @param {number} x @param {number} y @param {number} w @param {number} h */
  rect(x, y, w, h) {
    this.path += `M${number(x)} ${number(y)}h${number(w)}v${number(h)}h${number(-w)}Z`;
  }
  /** @param {number} x @param {number} y @param {number} r @param {number} from @param {number} to @param {boolean} [back] */
  arc(x, y, r, from, to, back = false) {
    const full = Math.abs(to - from) >= 2 * Math.PI - 1e-9;
    const at = (/** @type {number} */ a) => [x + r * Math.cos(a), y + r * Math.sin(a)];
    const sweep = back ? 0 : 1,
      middle = at(full ? from + Math.PI : to),
      end = at(from);
    const curve = (/** @type {number[]} */ p, /** @type {number} */ large) =>
      `A${number(r)} ${number(r)} 0 ${large} ${sweep} ${number(p[0])} ${number(p[1])}`;
    this.lineTo(end[0], end[1]);
    this.path += full ? curve(middle, 0) + curve(end, 0) : curve(middle, Math.abs(to - from) > Math.PI ? 1 : 0);
  }
  /** @param {number[]} dash */
  setLineDash(dash) {
    this.dash = dash;
  }
  stroke() {
    if (!this.path) return;
    const dash = this.dash.length ? ` stroke-dasharray="${this.dash.map(number).join(" ")}"` : "";
    const ends =
      (this.lineCap === "butt" ? "" : ` stroke-linecap="${this.lineCap}"`) +
      (this.lineJoin === "miter" ? "" : ` stroke-linejoin="${this.lineJoin}"`);
    this.parts.push(
      `<path d="${this.path}" fill="none" stroke="${this.strokeStyle}" stroke-width="${number(this.lineWidth)}"${dash}${ends}${this.alpha()}/>`,
    );
  }
  /** @param {any} [rule] */
  fill(rule) {
    if (this.path)
      this.parts.push(
        `<path d="${this.path}" fill="${this.fillStyle}"${rule === "evenodd" ? ' fill-rule="evenodd"' : ""}${this.alpha()}/>`,
      );
  }
  clip() {
    const id = `clip${++this.clips}`;
    this.parts.push(`<clipPath id="${id}"><path d="${this.path}"/></clipPath><g clip-path="url(#${id})">`);
    this.groups++;
  }
  /** @param {string} text @param {number} x @param {number} y */
  fillText(text, x, y) {
    const [, weight, size] = /(\d+) ([\d.]+)px/.exec(this.font) ?? ["", "400", "12"];
    const anchor = ANCHOR[this.textAlign],
      down = (BASELINE[this.textBaseline] ?? 0) * Number(size);
    const more = (anchor ? ` text-anchor="${anchor}"` : "") + (weight === "400" ? "" : ` font-weight="${weight}"`);
    this.parts.push(
      `<text x="${number(x)}" y="${number(y + down)}" font-family="${escape(FAMILY)}" font-size="${size}" fill="${this.fillStyle}"${more}${this.alpha()}>${escape(text)}</text>`,
    );
  }
  save() {
    const own = /** @type {any} */ (this);
    this.stack.push({
      state: Object.fromEntries(KEPT.map((key) => [key, own[key]])),
      dash: this.dash,
      groups: this.groups,
    });
  }
  restore() {
    const back = this.stack.pop();
    if (!back) return;
    for (; this.groups > back.groups; this.groups--) this.parts.push("</g>");
    Object.assign(this, back.state);
    this.dash = back.dash;
  }
  alpha() {
    return this.globalAlpha === 1 ? "" : ` opacity="${number(this.globalAlpha)}"`;
  }
  text() {
    return [...this.parts, "</g>".repeat(this.groups), "</svg>"].join("\n");
  }
}

/**
 * A picture as PNG, twice as fine as on the screen.
 * @param {number} width
 * @param {number} height
 * @param {string} ground
 * @param {(pen: Pen) => void} paint
 * @returns {Promise<Blob>}
 */
export function png(width, height, ground, paint) {
  const canvas = document.createElement("canvas"),
    pen = canvas.getContext("2d");
  canvas.width = Math.round(2 * width);
  canvas.height = Math.round(2 * height);
  if (!pen) return Promise.reject(new Error("this browser gives no canvas to draw on"));
  pen.scale(2, 2);
  pen.fillStyle = ground;
  pen.fillRect(0, 0, width, height);
  paint(pen);
  return new Promise((done, fail) =>
    canvas.toBlob((blob) => (blob ? done(blob) : fail(new Error("the picture could not be written as PNG"))), "image/png"),
  );
}
