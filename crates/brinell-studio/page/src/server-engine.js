// The engine behind `brinell studio`: the same bytes by POST. The address of the page carries the token.
import { Lost, accepted } from "./answers.js";
import { decode, encode } from "./message.js";

export class ServerEngine {
  slots = true;
  /** @type {Promise<unknown>} */
  #turn = Promise.resolve();
  #gone = false;

  /** @param {Record<string, unknown>} request @returns {Promise<any>} */
  ask(request) {
    const answer = this.#turn.then(() => this.#send(request));
    this.#turn = answer.catch(() => {});
    return answer;
  }

  /** @param {Record<string, unknown>} request */
  async #send(request) {
    if (this.#gone) {
      this.#gone = false;
      throw new Lost("the request was given up");
    }
    let bytes;
    try {
      const response = await fetch(`ask${location.search}`, { method: "POST", body: encode(request), headers: { "Content-Type": "application/octet-stream" } });
      if (response.status === 403) throw new Lost("The server refuses this address: its token is new whenever the server starts. Open the address that it printed.", true);
      if (!response.ok) throw new Lost(`the server answers ${response.status}`);
      bytes = new Uint8Array(await response.arrayBuffer());
    } catch (error) {
      throw error instanceof Lost ? error : new Lost("The server does not answer. Start `brinell studio` again and open its new address.", true);
    }
    return accepted(decode(bytes));
  }

  /** The server serves all bearings and stays. */
  close() {}

  /** For tests: the next request finds nobody. */
  kill() { this.#gone = true; }
}
