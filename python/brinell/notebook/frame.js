// Runs in the frame before the studio's page: the engine is asked through the page around the frame, which hands over a port.
"use strict";
(() => {
  const waiting = new Map();
  let next = 1;

  /** @param {MessagePort} port */
  async function engine(port) {
    // Modules of the page, by the names of its import map.
    const [{ decode, encode }, { Lost, accepted }] = await Promise.all([import("src/message.js"), import("src/answers.js")]);
    const refuse = (why) => {
      for (const { failed } of waiting.values()) failed(new Lost(why));
      waiting.clear();
    };
    port.onmessage = ({ data }) => {
      // The notebook has another scenario.
      if (data.load !== undefined) return globalThis.brinellStudio?.load(data.load, false);
      if (data.lost !== undefined) return refuse(data.lost);
      const asked = waiting.get(data.id);
      if (!asked) return;
      waiting.delete(data.id);
      try {
        asked.done(accepted(decode(data.bytes)));
      } catch (error) {
        asked.failed(error);
      }
    };
    const ask = (request) => new Promise((done, failed) => {
      const bytes = encode(request), id = next++;
      waiting.set(id, { done, failed });
      port.postMessage({ id, bytes }, [bytes.buffer]);
    });
    // The kernel serves all bearings and stays; it answers one request after the other.
    return { slots: true, ask, aside: ask, close() {}, kill: () => refuse("the request was given up") };
  }

  const started = new Promise((done) => {
    addEventListener("message", function hear({ source, data, ports }) {
      if (source !== parent || !data?.brinell || !ports[0]) return;
      removeEventListener("message", hear);
      globalThis.brinellScenario = data.scenario;
      done(engine(ports[0]));
    });
  });
  globalThis.brinellEngine = () => started;
  document.documentElement.dataset.engine = "kernel";
})();
