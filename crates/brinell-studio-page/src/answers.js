// Answers of an engine, and how they fail.

/** @typedef {{key: string | null, line: number | null, message: string}} Trouble */
// `aside` asks what belongs to no bearing, while those that run are asked; who has `left` waits for no answer.
/** @typedef {{ask: (request: Record<string, unknown>) => Promise<any>, aside: (request: Record<string, unknown>, left: AbortSignal) => Promise<any>, close: () => void, kill: () => void, slots: boolean}} Engine */

/** The engine refused a request, in its own words. */
export class Refused extends Error {
  /** @param {Trouble[]} problems */
  constructor(problems) {
    super(problems.map((p) => p.message).join("; "));
    this.problems = problems;
  }
}

/** The engine is gone; another must be started. */
export class Lost extends Error {
  /** @param {string} why @param {boolean} [gone] none comes by itself: the reader is told what to do */
  constructor(why, gone = false) {
    super(why);
    this.gone = gone;
  }
}

/**
 * The answer, or an error with the engine's words.
 * @param {any} answer
 */
export function accepted(answer) {
  if (!answer.ok) throw new Refused(answer.problems ?? [{ key: null, line: null, message: "the engine gave no reason" }]);
  return answer;
}
