// What charts of the studio and of the pages of runs have in common. No browser.
import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { around, largestOf, nearestOf, short, thinned, ticks, within } from "../src/chart.js";

describe("charts", () => {
  it("prop: thinned curves keep each column's first, smallest, largest and last value, and break where one is missing", () => {
    const values = Array.from({ length: 1000 }, (_, i) => Math.sin(0.37 * i) + (i === 503 ? 9 : 0) - (i === 507 ? 9 : 0));
    for (const gap of [300, 301, 302]) values[gap] = NaN;
    const drawn = (peaks) =>
      thinned(
        [0, 999],
        (i) => values[i],
        (i) => Math.floor(i / 10),
        peaks,
      );
    const [before, after] = drawn(false);
    assert.deepEqual([before[0], before.at(-1), after[0], after.at(-1)], [0, 299, 303, 999]);
    const all = [...before, ...after];
    assert.deepEqual(
      all,
      [...new Set(all)].sort((a, b) => a - b),
    );
    assert.ok(all.length <= 400 && [500, 503, 507, 509].every((i) => all.includes(i)));
    const peaks = drawn(true).flat();
    assert.ok(peaks.length === 100 && peaks.includes(503) && !peaks.includes(507));
    assert.deepEqual(
      thinned(
        [0, 2],
        () => undefined,
        (i) => i,
        false,
      ),
      [],
    );
  });

  it("regress: ticks are round, and numbers have a true minus", () => {
    assert.deepEqual(ticks(-1, 1, 4), [
      [-1, "−1.0"],
      [-0.5, "−0.5"],
      [0, "0"],
      [0.5, "0.5"],
      [1, "1.0"],
    ]);
    assert.deepEqual(ticks(1, 1, 4), []);
    assert.deepEqual(
      [-0.00012345, 1234567, 0, undefined].map((v) => short(v, 3)),
      ["−1.23e−4", "1.23e+6", "0", "–"],
    );
  });

  it("prop: a view stays within all that there is, and a zoom keeps its place", () => {
    assert.deepEqual(within([-5, 3], [0, 10], 1), [0, 8]);
    assert.deepEqual(within([4, 4.1], [0, 10], 1), [3.55, 4.55]);
    assert.deepEqual(around([0, 10], 5, 0.5), [2.5, 7.5]);
    assert.equal(nearestOf([0, 1, 4], 2.4), 1);
    assert.equal(largestOf([1, 5, 2], 2, 0, 9), 1);
  });
});
