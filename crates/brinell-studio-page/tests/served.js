// A browser, and the page's folder served, for all tests of the file that imports this.
import { after, before } from "node:test";
import { launch, serve } from "./browser.js";

export let browser, server;

before(async () => {
  browser = await launch();
  server = await serve();
});
after(async () => {
  await browser?.close();
  server?.close();
});
