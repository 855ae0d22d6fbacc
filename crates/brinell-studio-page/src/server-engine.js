// The engine behind `brinell studio`: the same bytes by POST. The address of the page carries the token; each page that is loaded has an engine of its own, by a name that it makes up.
import { Lost, accepted } from "./answers.js";
import { decode, encode } from "./message.js";

// A server that is busy refuses connections for a moment: how long is waited before each further try.
const PAUSES_MS = [200, 400, 800, 1600, 3000];
// With these a page begins, or begins anew when its engine is gone.
const BEGINS = new Set(["about", "open"]);

export class ServerEngine {
  slots = true;
  /** @type {Promise<unknown>} */
  #turn = Promise.resolve();
  #gone = false;
  #page = [...crypto.getRandomValues(new Uint8Array(8))].map((b) => b.toString(16).padStart(2, "0")).join("");

  constructor() {
    addEventListener("pagehide", (event) => {
      if (!event.persisted) navigator.sendBeacon(this.#address("closed"));
    });
  }

  /** @param {Record<string, unknown>} request @returns {Promise<any>} */
  ask(request) {
    const answer = this.#turn.then(() => this.#send(request));
    this.#turn = answer.catch(() => {});
    return answer;
  }

  /** The server answers it beside others. @param {Record<string, unknown>} request @returns {Promise<any>} */
  aside(request) {
    return this.#send(request);
  }

  /** @param {"new" | "page" | "closed"} how */
  #address(how) {
    const query = new URLSearchParams(location.search);
    query.set(how, this.#page);
    return `ask?${query}`;
  }

  /** @param {Record<string, unknown>} request */
  async #send(request) {
    if (this.#gone) {
      this.#gone = false;
      throw new Lost("the request was given up");
    }
    const response = await this.#fetched(this.#address(BEGINS.has(String(request.do)) ? "new" : "page"), encode(request));
    if (response.status === 403)
      throw new Lost(
        "The server refuses this address: its token is new whenever the server starts. Open the address that it printed.",
        true,
      );
    if (response.status === 410)
      throw new Lost(
        "`brinell studio` serves four pages at a time, and others have asked since this one did. Start again runs this bearing anew, in place of the page that has rested longest.",
        true,
      );
    if (!response.ok) throw new Lost(`the server answers ${response.status}`);
    return accepted(decode(response.bytes));
  }

  /** @param {string} address @param {Uint8Array<ArrayBuffer>} body */
  async #fetched(address, body) {
    for (const pause of [...PAUSES_MS, 0]) {
      try {
        const response = await fetch(address, {
          method: "POST",
          body,
          headers: { "Content-Type": "application/octet-stream" },
        });
        return { ok: response.ok, status: response.status, bytes: new Uint8Array(await response.arrayBuffer()) };
      } catch {
        await new Promise((done) => setTimeout(done, pause));
      }
    }
    throw new Lost(
      "The server does not answer. Start again tries once more; if `brinell studio` has ended, start it and open its new address.",
      true,
    );
  }

  /** The server stays. */
  close() {}

  /** For tests: the next request finds nobody. */
  kill() {
    this.#gone = true;
  }
}
