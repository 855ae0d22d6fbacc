// What a hand does on the studio's page, and what is looked at there.
import { readFile } from "node:fs/promises";

export const scenario = (page) => page.evaluate(() => globalThis.brinellStudio.side.store.scenario);
export const opened = (page) => page.evaluate(() => globalThis.brinellStudio.side.opened);
export const until = (page, look, given) => page.waitForFunction(look, given, { timeout: 90000, polling: 20 });
// The bearing that runs is the one that is wanted; the engine may write its keys in another order.
export const settled = (page) =>
  until(page, () => {
    const { side } = globalThis.brinellStudio,
      sorted = (v) =>
        Array.isArray(v) || v === null || typeof v !== "object"
          ? v
          : Object.fromEntries(Object.entries(v).sort(([a], [b]) => (a < b ? -1 : 1)));
    const text = (scenario) =>
      JSON.stringify(
        scenario?.defects?.map(({ depth_um, on, row, center_deg, shape }) => [
          depth_um,
          on,
          row,
          center_deg,
          Object.keys(shape),
          shape.rectangle,
          shape.circle,
        ]) ?? [],
        (_, v) => sorted(v),
      );
    return text(side.opened?.scenario) === text(side.store.scenario);
  });
// The page draws with the next frame what it has heard: what a node says and what a field holds is waited for.
export const says = (page, words) =>
  until(page, ([source, flags]) => new RegExp(source, flags).test(document.getElementById("state").textContent), [
    words.source,
    words.flags,
  ]);
export const holds = async (input, value) =>
  until(input.page(), ([node, value]) => node.value === value, [await input.elementHandle(), value]);
// Statistics of more samples than these, all of them at one instant.
export const moments = async (page, least) =>
  (
    await page.waitForFunction((n) => {
      const m = globalThis.brinellStudio.side.moments;
      return m?.rms && m.kurtosis && m.samples > n && m;
    }, least)
  ).jsonValue();
// A value is taken when its field is left.
export const type = async (input, value) => {
  await input.fill(value);
  await input.blur();
};
export const start = async (page, example) => {
  await page.selectOption("#preset", `example:${example}`);
  await page.click("#load");
  // It may have been there already: what is typed while it is loaded anew is dropped.
  await page.evaluate(() => globalThis.brinellStudio.side.live.settled());
  await until(page, (name) => globalThis.brinellStudio.side.opened?.scenario.name === name, example);
};

// A place on the raceway: across its width from 0 to 1, and below its overview likewise.
export async function place(page, across, down) {
  const box = await page.locator("brinell-raceway canvas").boundingBox();
  return [box.x + across * box.width, box.y + 34 + down * (box.height - 54)];
}
export async function drag(page, from, to, steps = 12) {
  await page.mouse.move(...(await place(page, ...from)));
  await page.mouse.down();
  await page.mouse.move(...(await place(page, ...to)), { steps });
  await page.mouse.up();
}
export const drop = (page, name, base64) =>
  page.evaluate(
    ([name, text]) => {
      const transfer = new DataTransfer();
      transfer.items.add(new File([Uint8Array.from(atob(text), (c) => c.charCodeAt(0))], name));
      document.body.dispatchEvent(new DragEvent("drop", { dataTransfer: transfer, bubbles: true, cancelable: true }));
    },
    [name, base64],
  );
export async function saved(page, item) {
  const waiting = page.waitForEvent("download", { timeout: 60000 });
  await page.click("#save");
  await page.click(`#save-list button:has-text("${item}")`);
  const download = await waiting;
  return { name: download.suggestedFilename(), text: await readFile(await download.path(), "utf8") };
}
