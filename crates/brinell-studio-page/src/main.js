// One page that simulates a damaged bearing live: starts the engine and the studio.
import { NoWasm } from "./assets.js";
import { byId } from "./dom.js";
import { engines } from "./engine.js";
import { notice } from "./notices.js";
import { Studio } from "./studio.js";

async function main() {
  const studio = new Studio();
  // For tests and for the console.
  Object.assign(globalThis, { brinellStudio: studio });
  try {
    await studio.begin(engines());
  } catch (error) {
    const state = byId("state");
    state.textContent = error instanceof NoWasm ? "no WebAssembly" : "no engine";
    state.dataset.state = "lost";
    notice(
      "engine",
      `${String(error instanceof Error ? error.message : error).replace(/\.$/, "")}. The command \`brinell studio\` runs the same page with its own engine.`,
      { bad: true, stays: true },
    );
  }
}

main();
