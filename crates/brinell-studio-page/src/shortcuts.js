// What keys do outside of fields and views.
import { showKeys } from "./help.js";

/**
 * @typedef {object} Acts
 * @property {() => void} redo
 * @property {() => void} undo
 * @property {(() => void) | undefined} cancel  of a run that is made whole
 * @property {() => void} pause
 * @property {() => void} live
 * @property {() => void} hear
 * @property {(index: number) => void} turn
 */

/** What a key does here, if anything; the browser then does nothing else with it. @param {KeyboardEvent} e @param {Acts} acts @returns {(() => void) | undefined} */
export function actOf(e, acts) {
  const target = /** @type {HTMLElement} */ (e.target),
    inView = target.tagName.startsWith("BRINELL-");
  if (e.key === "?" && !target.matches("input[type=text], select, textarea, dialog *")) return showKeys;
  if (e.ctrlKey || e.metaKey) {
    if (e.key.toLowerCase() !== "z" || target.matches("input[type=text]:not([inputmode]), textarea, dialog *")) return;
    e.preventDefault();
    return e.shiftKey ? acts.redo : acts.undo;
  }
  if (e.key === "Escape" && acts.cancel && !inView && !target.closest("input, select, textarea, dialog, .list, [role=application]"))
    return acts.cancel;
  if (e.altKey || inView || target.closest("input, select, textarea, button, summary, dialog, [role=application]")) return;
  const act = /** @type {Record<string, (() => void) | undefined>} */ ({
    " ": acts.pause,
    l: acts.live,
    h: acts.hear,
    a: () => acts.turn(0),
    b: () => acts.turn(1),
  })[e.key.toLowerCase()];
  if (act) e.preventDefault();
  return act;
}
