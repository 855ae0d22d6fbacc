// What the views share: shadow root, colours, size, one drawing a frame, export.
import { base, colours, LIGHT, scheme } from "./theme.js";
import { png, SvgPen } from "./pen.js";

/** @typedef {import("./theme.js").Colours} Colours */
/** @typedef {import("./pen.js").Pen} Pen */

export class View extends HTMLElement {
  /** @param {CSSStyleSheet} own */
  constructor(own) {
    super();
    this.root = this.attachShadow({ mode: "open" });
    this.root.adoptedStyleSheets = [base, own];
    this.asked = 0;
    /** @type {Colours | null} */
    this.paints = null;
    this.ends = new AbortController();
    this.sizes = new ResizeObserver(() => this.requestDraw());
    this.pages = new MutationObserver(() => this.recolour());
  }
  connectedCallback() {
    this.ends = new AbortController();
    const signal = this.ends.signal;
    for (const query of ["(prefers-color-scheme: dark)", `(resolution: ${devicePixelRatio}dppx)`])
      matchMedia(query).addEventListener("change", () => this.recolour(), { signal });
    this.pages.observe(document.documentElement, {
      attributes: true,
      attributeFilter: ["class", "style", "data-theme", "data-scheme"],
    });
    this.recolour();
  }
  disconnectedCallback() {
    this.ends.abort();
    this.pages.disconnect();
    this.sizes.disconnect();
    cancelAnimationFrame(this.asked);
    this.asked = 0;
  }
  /** Takes the colours of the page anew. */
  recolour() {
    const now = scheme(this);
    if (this.getAttribute("scheme") !== now) this.setAttribute("scheme", now);
    this.paints = null;
    this.requestDraw();
  }
  /** @returns {Colours} */
  get colours() {
    return (this.paints ??= colours(this));
  }
  /** Draws once before the next frame is shown, however often it is asked. */
  requestDraw() {
    if (this.asked || !this.isConnected) return;
    this.asked = requestAnimationFrame(() => {
      this.asked = 0;
      this.draw();
    });
  }
  draw() {}
  /** Pictures that are saved are light: they go into papers. @returns {{ width: number, height: number, title: string, paint: (pen: Pen, colours: Colours) => void }} */
  picture() {
    throw new Error("no picture");
  }
  /** The view as SVG. */
  async toSVG() {
    const { width, height, title, paint } = this.picture(),
      pen = new SvgPen(width, height, title, LIGHT.ground);
    paint(pen, LIGHT);
    return pen.text();
  }
  /** The view as PNG. @returns {Promise<Blob>} */
  async toPNG() {
    const { width, height, paint } = this.picture();
    return png(width, height, LIGHT.ground, (pen) => paint(pen, LIGHT));
  }
}

/** Fits a canvas to its box; gives a pen in CSS pixels and the size, or null where there is no room. @param {HTMLCanvasElement} canvas @param {HTMLElement} box */
export function fit(canvas, box) {
  const width = box.clientWidth,
    height = box.clientHeight,
    fine = devicePixelRatio || 1,
    pen = canvas.getContext("2d");
  if (!pen || width < 20 || height < 20) return null;
  const [w, h] = [Math.round(width * fine), Math.round(height * fine)];
  if (canvas.width !== w || canvas.height !== h) {
    canvas.width = w;
    canvas.height = h;
    canvas.style.width = `${width}px`;
    canvas.style.height = `${height}px`;
  }
  pen.setTransform(fine, 0, 0, fine, 0, 0);
  pen.clearRect(0, 0, width, height);
  return { pen, width, height };
}

/** Calls at most once in so many ms, the last time too. @param {number} ms @param {() => void} act */
export function seldom(ms, act) {
  let timer = 0,
    last = -Infinity;
  return () => {
    if (timer) return;
    timer = window.setTimeout(
      () => {
        timer = 0;
        last = performance.now();
        act();
      },
      Math.max(0, last + ms - performance.now()),
    );
  };
}
