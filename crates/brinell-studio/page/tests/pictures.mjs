// The book's pictures of the studio, made by a hand on the page: node tests/pictures.mjs [FOLDER]. Look at them before they are committed.
import { mkdir, stat, writeFile } from "node:fs/promises";
import { join, resolve } from "node:path";
import { crc32, deflateSync, inflateSync } from "node:zlib";
import { launch, open, running, serve } from "./browser.js";
import { drag, settled, start, until } from "./page.js";

const FOLDER = resolve(process.argv[2] ?? join(import.meta.dirname, "../../../../docs/pictures"));
const PICTURES = [
  { name: "studio.png", options: { width: 1400, height: 900, colorScheme: "light" }, from: 0.56, to: 0.6 },
  { name: "studio-phone.png", options: { width: 390, height: 844, colorScheme: "dark", hasTouch: true }, from: 0.68, to: 0.74 },
];

/** What the fourth filter of PNG predicts. */
function paeth(left, up, corner) {
  const guess = left + up - corner, [a, b, c] = [left, up, corner].map((v) => Math.abs(guess - v));
  return a <= b && a <= c ? left : b <= c ? up : corner;
}

/** The same picture, smaller: the browser packs for speed, and its row filters, made for photographs, hinder deflate on plain areas. */
function packed(png) {
  const parts = [], width = png.readUInt32BE(16), height = png.readUInt32BE(20), n = png[25] === 6 ? 4 : 3, row = n * width;
  for (let at = 8; at < png.length; at += 12 + png.readUInt32BE(at)) {
    if (png.toString("latin1", at + 4, at + 8) === "IDAT") parts.push(png.subarray(at + 8, at + 8 + png.readUInt32BE(at)));
  }
  const given = inflateSync(Buffer.concat(parts)), plain = Buffer.alloc(given.length);
  for (let y = 0; y < height; y++) {
    const from = y * (row + 1) + 1, kind = given[from - 1];
    for (let x = 0; x < row; x++) {
      const left = x < n ? 0 : plain[from + x - n], up = y ? plain[from + x - row - 1] : 0, corner = y && x >= n ? plain[from + x - row - 1 - n] : 0;
      plain[from + x] = given[from + x] + [0, left, up, (left + up) >> 1, paeth(left, up, corner)][kind];
    }
  }
  const data = deflateSync(plain, { level: 9, memLevel: 9 });
  const chunk = (type, data) => {
    const body = Buffer.concat([Buffer.from(type, "latin1"), data]), whole = Buffer.alloc(body.length + 8);
    whole.writeUInt32BE(data.length);
    body.copy(whole, 4);
    whole.writeUInt32BE(crc32(body), body.length + 4);
    return whole;
  };
  return Buffer.concat([png.subarray(0, 8), chunk("IHDR", png.subarray(16, 29)), chunk("IDAT", data), chunk("IEND", Buffer.alloc(0))]);
}

await mkdir(FOLDER, { recursive: true });
const browser = await launch(), server = await serve();
try {
  for (const { name, options, from, to } of PICTURES) {
    const page = await open(browser, server.url, options), file = join(FOLDER, name);
    await running(page);
    await start(page, "rectangle");
    // A scratch beside the rectangle, in the load zone.
    await page.locator("brinell-raceway canvas").scrollIntoViewIfNeeded();
    await page.click('[data-tool="pen"]');
    await page.fill(".narrow-number", "0.6");
    await drag(page, [from, 0.25], [to, 0.7], 10);
    await settled(page);
    await until(page, () => globalThis.brinellStudio.side.opened.scenario.defects.length === 2);
    // Half a second of it, a verdict, and the healthy bearing behind.
    await until(page, () => {
      const { side, healthy } = globalThis.brinellStudio;
      return side.moments.samples > 34000 && side.verdict?.table && side.indicators && side.spectra.lines?.some((l) => l.found) && healthy.curves;
    });
    await page.evaluate(() => {
      // Its times are those of the machine that makes the pictures, among other work.
      const { side } = globalThis.brinellStudio;
      Object.defineProperties(side, { pace: { get: () => 0, set() {} }, took: { value: 0 } });
      document.activeElement.blur();
      scrollTo(0, 0);
    });
    await page.mouse.move(0, 0);
    await page.waitForTimeout(500);
    await writeFile(file, packed(await page.screenshot()));
    console.log(`${file}: ${Math.round((await stat(file)).size / 1000)} kB`);
    await page.context().close();
  }
} finally {
  await browser.close();
  server.close();
}
