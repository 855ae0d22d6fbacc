// The book's pictures of the studio, made by a hand on the page: node tests/pictures.mjs [FOLDER]. Look at them before they are committed.
import { mkdir, stat } from "node:fs/promises";
import { join, resolve } from "node:path";
import { launch, open, running, serve } from "./browser.js";
import { drag, settled, start, until } from "./page.js";

const FOLDER = resolve(process.argv[2] ?? join(import.meta.dirname, "../../../docs/src/pictures"));
const PICTURES = [
    { name: "studio.png", options: { width: 1400, height: 900, colorScheme: "light" }, from: 0.56, to: 0.6 },
    {
        name: "studio-phone.png",
        options: { width: 390, height: 844, colorScheme: "dark", hasTouch: true },
        from: 0.68,
        to: 0.74,
    },
];

await mkdir(FOLDER, { recursive: true });
const browser = await launch(),
    server = await serve();
try {
    for (const { name, options, from, to } of PICTURES) {
        const page = await open(browser, server.url, options),
            file = join(FOLDER, name);
        await running(page);
        await start(page, "rectangle");
        // A scratch beside the rectangle, in the load zone.
        await page.locator("brinell-raceway canvas").scrollIntoViewIfNeeded();
        await page.click('[data-tool="pen"]');
        await page.fill(".narrow-number", "0.6");
        await drag(page, [from, 0.25], [to, 0.7], 10);
        await settled(page);
        await until(page, () => globalThis.brinellStudio.side.opened.scenario.defects.length === 2);
        // By the scenario's own tables: half a second of it, a verdict, and the healthy bearing behind.
        await until(page, () => {
            const { side, healthy } = globalThis.brinellStudio;
            return (
                !side.opened.quick &&
                side.moments.samples > 34000 &&
                side.verdict?.table &&
                side.indicators &&
                side.spectra.lines?.some((l) => l.found) &&
                healthy.curves
            );
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
        await page.screenshot({ path: file });
        console.log(`${file}: ${Math.round((await stat(file)).size / 1000)} kB`);
        await page.context().close();
    }
} finally {
    await browser.close();
    server.close();
}
