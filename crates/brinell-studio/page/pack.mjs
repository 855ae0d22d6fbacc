// Packs the page into one HTML file that works from disk, and lays out a folder to serve.
//
//     node pack.mjs [--wasm studio.wasm] [--views folder] [-o out]
//
// Modules become data: URLs of an import map, as a page from disk may not import files; they and the engine are gzip in base64, the Worker a Blob.
import { copyFileSync, existsSync, mkdirSync, readFileSync, renameSync, writeFileSync } from "node:fs";
import { dirname, join, posix, relative, resolve } from "node:path";
import { parseArgs } from "node:util";
import { gzipSync } from "node:zlib";

const HERE = import.meta.dirname, WORKER = "src/worker.js";
const IMPORT = /((?:^|\n|;)\s*(?:import|export)\b[^"';]*?["'])(\.{1,2}\/[^"']+)(["'])/g;

const { values: options } = parseArgs({ options: { wasm: { type: "string", default: "../../../target/studio/studio.wasm" }, views: { type: "string" },
  out: { type: "string", short: "o", default: "../../../target/studio" } } });
const wasm = resolve(options.wasm), out = resolve(options.out);

/** Where a file of the page lies. @param {string} name */
function place(name) {
  const all = [HERE, ...(options.views ? [resolve(options.views)] : [])].map((folder) => join(folder, name)), found = all.find(existsSync);
  if (!found) throw new Error(`${all.join(", ")}: no such file`);
  return found;
}

/** The modules that these need, themselves included, with their imports by name. @param {string[]} names */
function modules(names) {
  const found = new Map();
  for (const waiting = [...names]; waiting.length;) {
    const name = waiting.pop();
    if (found.has(name)) continue;
    const text = readFileSync(place(name), "utf8").replace(IMPORT, (_, before, path, after) => {
      const target = posix.join(posix.dirname(name), path);
      waiting.push(target);
      return `${before}${target}${after}`;
    });
    found.set(name, text);
  }
  return found;
}

/** Text within a script element must not end it. @param {string} text */
const within = (text) => text.replaceAll("</script", "<\\/script").replaceAll("<!--", "<\\!--");

/** A file appears whole or not at all. @param {string} path @param {string} text */
function write(path, text) {
  writeFileSync(`${path}.partial`, text);
  renameSync(`${path}.partial`, path);
}

const html = readFileSync(join(HERE, "index.html"), "utf8");
const entries = [...html.matchAll(/<script type="module" src="([^"]+)"><\/script>\n/g)].map((m) => m[1]);
const all = modules(entries);
mkdirSync(out, { recursive: true });
/** Compressed, as text. @param {string | Buffer} data */
const packed = (data) => gzipSync(data, { level: 9 }).toString("base64");

// Runs before any module: inflates them and says where they are. An address drops tabs and line ends, and ends at #.
const start = `
const text = document.getElementById("studio-modules").textContent;
const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
const modules = await new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"))).json();
const address = (text) => "data:text/javascript;charset=utf-8," + text.replace(/[%#\\r\\n\\t]/g, encodeURIComponent);
const imports = Object.fromEntries(Object.entries(modules).map(([name, text]) => [name, address(text)]));
document.head.append(Object.assign(document.createElement("script"), { type: "importmap", textContent: JSON.stringify({ imports }) }));
for (const name of ${JSON.stringify(entries)}) await import(name);
`;
const head = [
  `<style>\n${readFileSync(join(HERE, "studio.css"), "utf8")}</style>`,
  `<script type="text/plain" id="studio-modules">${packed(JSON.stringify(Object.fromEntries(all)))}</script>`,
  `<script type="text/plain" id="studio-worker">${within(readFileSync(join(HERE, WORKER), "utf8"))}</script>`,
  ...(existsSync(wasm) ? [`<script type="text/plain" id="studio-wasm">${packed(readFileSync(wasm))}</script>`] : []),
].join("\n");
const page = html.replace(/<link rel="stylesheet"[^>]*>\n/, () => `${head}\n`)
  .replace(/<script type="module" src="[^"]+"><\/script>\n/g, "")
  .replace("</body>", () => `<script>(async () => {${start}})();</script>\n</body>`);
write(join(out, "brinell-studio.html"), page);

const site = join(out, "site");
for (const name of ["index.html", "studio.css", WORKER, ...all.keys()]) {
  mkdirSync(dirname(join(site, name)), { recursive: true });
  copyFileSync(place(name), join(site, name));
}
if (existsSync(wasm)) copyFileSync(wasm, join(site, "studio.wasm"));
console.log(`${relative("", join(out, "brinell-studio.html"))}: ${(page.length / 1e6).toFixed(2)} MB, ${all.size} modules, ${existsSync(wasm) ? "with" : "WITHOUT"} the engine; ${relative("", site)}/: the same to serve`);
