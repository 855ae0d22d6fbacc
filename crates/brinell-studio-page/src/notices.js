// Notices in one line below the raceway: the newest, and a button that opens the rest.
import { byId, h } from "./dom.js";

/**
 * One of a kind at a time; null takes it away.
 * @param {string} kind
 * @param {string | Node | null} words
 * @param {{bad?: boolean, actions?: [string, () => void][], stays?: boolean}} [more]
 */
export function notice(kind, words, { bad = false, actions = [], stays = false } = {}) {
  const root = shown(),
    old = root.querySelector(`[data-kind="${kind}"]`);
  if (words === null) return void old?.remove();
  if (old && typeof words === "string" && old.querySelector("p")?.textContent === words) return;
  const node = h(
    "div",
    { className: bad ? "notice bad" : "notice", "data-kind": kind, role: bad ? "alert" : "status" },
    typeof words === "string" ? h("p", {}, words) : words,
    ...actions.map(([text, act]) =>
      h(
        "button",
        {
          type: "button",
          onclick: () => {
            node.remove();
            act();
          },
        },
        text,
      ),
    ),
    stays ? null : h("button", { type: "button", "aria-label": "Close this notice", onclick: () => node.remove() }, "×"),
  );
  old?.remove();
  root.prepend(node);
}

/** @type {HTMLElement | null} */
let root = null;

/** Where they are, with the button behind them, which follows what comes, goes and does not fit. */
function shown() {
  if (root) return root;
  const made = /** @type {HTMLElement} */ (byId("notices")),
    all = h("button", { type: "button", className: "all", hidden: true, onclick: () => count(!open) });
  let open = false,
    cut = false;
  const count = (wanted = open) => {
    const list = made.querySelectorAll(".notice"),
      words = list[0]?.querySelector("p");
    // Only of a closed line can be seen whether its words fit.
    if (!open) cut = !!words && (words.scrollWidth > words.clientWidth || words.scrollHeight > words.clientHeight + 2);
    all.hidden = list.length < 2 && !cut;
    open = wanted && !all.hidden;
    made.classList.toggle("open", open);
    const text = open ? "less" : list.length > 1 ? `${list.length - 1} more` : "more";
    if (all.textContent !== text) all.textContent = text;
    all.classList.toggle("bad", !!made.querySelector(".notice ~ .bad"));
    all.setAttribute("aria-expanded", String(open));
  };
  made.append(all);
  new MutationObserver(() => count()).observe(made, { childList: true, subtree: true });
  new ResizeObserver(() => count()).observe(made);
  return (root = made);
}

/** Notices of what the scenario, and the result of its whole run, warn of. The same is not shown again after it was closed. */
export class Warnings {
  /** @type {Record<string, string>} */
  #shown = {};

  /** @param {import("./side.js").Side} side */
  show({ opened, indicators, live }) {
    const result = live.state === "done" ? indicators?.warnings : null;
    for (const [kind, list] of /** @type {[string, string[] | undefined][]} */ ([
      ["warnings", opened?.warnings],
      ["result", result],
    ])) {
      const words = list?.join("\n") ?? "";
      if (words === (this.#shown[kind] ?? "")) continue;
      this.#shown[kind] = words;
      notice(kind, words || null);
    }
  }
}
