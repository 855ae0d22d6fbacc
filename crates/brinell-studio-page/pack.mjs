// Packs the page into one HTML file that works from disk, and lays out a folder to serve.
//
//     node pack.mjs [--wasm studio.wasm | --without-engine] [-o out]
//
// Paths that are given count from the working directory; those that are not, are in the repository's target/studio.
// Modules become data: URLs of an import map, as a page from disk may not import files; they and the engine are gzip in base64, the Worker a Blob.
import { copyFileSync, existsSync, mkdirSync, readFileSync, renameSync, writeFileSync } from "node:fs";
import { dirname, join, posix, relative, resolve } from "node:path";
import { parseArgs } from "node:util";
import { gzipSync } from "node:zlib";
import { hosted } from "./host.js";
import { encode } from "./src/message.js";

const HERE = import.meta.dirname,
    WORKER = "src/worker.js";
const IMPORT = /((?:^|\n|;)\s*(?:import|export)\b[^"';]*?["'])(\.{1,2}\/[^"']+)(["'])/g;

const BUILT = join(HERE, "../../target/studio");
const { values: options } = parseArgs({
    options: {
        wasm: { type: "string", default: join(BUILT, "studio.wasm") },
        "without-engine": { type: "boolean", default: false },
        out: { type: "string", short: "o", default: BUILT },
    },
});
const wasm = resolve(options.wasm),
    out = resolve(options.out);
if (!options["without-engine"] && !existsSync(wasm)) {
    console.error(`pack.mjs: no engine ${wasm}: build it with .ci/studio, name it with --wasm, or pack the page --without-engine`);
    process.exit(1);
}

/** The modules that these need, themselves included, with their imports by name. @param {string[]} names */
function modules(names) {
    const found = new Map();
    for (const waiting = [...names]; waiting.length;) {
        const name = waiting.pop();
        if (found.has(name)) continue;
        const text = readFileSync(join(HERE, name), "utf8").replace(IMPORT, (_, before, path, after) => {
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

/** Code without its comments of whole lines and of JSDoc, and without indentation: half a browser's download of the page's own code. @param {string} text */
const bare = (text) =>
    text
        .replace(/\/\*\* [\s\S]*?\*\/|\/\*\*\n[\s\S]*?\*\//g, "")
        .replace(/^[ \t]*\/\/ .*\n/gm, "")
        .replace(/^[ \t]+/gm, "")
        .replace(/\n{2,}/g, "\n");

/** A style sheet without its comments and the spaces that say nothing. @param {string} text */
const tight = (text) =>
    text
        .replace(/\/\*[\s\S]*?\*\//g, "")
        .replace(/\s+/g, " ")
        .replace(/ ?([{};]) ?|([,:]) /g, "$1$2")
        .replaceAll(";}", "}")
        .trim();

/** Of the example that the page begins with: as many samples as the page shows of a live bearing, and a spectrum of so many. */
const EXAMPLE = "rectangle",
    SHOWN = 2560,
    WINDOW = 4096,
    SLICE = 1024;

/** Numbers for a picture: without the last twelve bits, which nobody sees, they compress. @param {unknown} value */
function drawn(value) {
    if (!(value instanceof Float32Array)) return value;
    const bits = new Uint32Array(Float32Array.from(value).buffer);
    return new Float32Array(bits.map((b) => (b + 0x800) & ~0xfff).buffer);
}

/** What the page shows before its engine is there: the engine's own answers, as one message. @param {Uint8Array<ArrayBuffer>} wasm */
async function stored(wasm) {
    const { ask } = await hosted(await WebAssembly.compile(wasm));
    const about = ask({ do: "about" }),
        { toml } = ask({ do: "example", name: EXAMPLE }),
        slot = 0;
    const opened = ask({ do: "open", slot, toml, carry: false });
    let got = /** @type {any} */ (null),
        x = new Float32Array(0);
    do {
        got = ask({ do: "advance", slot, rows: SLICE });
        x = Float32Array.from([...x, ...got.x]).slice(-SHOWN);
    } while (!got.done);
    const spectra = ask({ do: "spectra", slot, longest: WINDOW }),
        { headline } = ask({ do: "verdict", slot }),
        { defects: damage } = ask({ do: "damage", slot });
    for (const one of [spectra.spectrum, spectra.envelope]) one.values = drawn(one.values);
    return encode({
        about,
        toml,
        opened,
        damage,
        headline,
        moments: got.moments,
        first: got.first + got.x.length - x.length,
        x: drawn(x),
        spectra,
    });
}

const html = readFileSync(join(HERE, "index.html"), "utf8");
const entries = [...html.matchAll(/<script type="module" src="([^"]+)"><\/script>\n/g)].map((m) => m[1]);
const all = modules(entries);
const engine = options["without-engine"] ? null : readFileSync(wasm);
const before = engine ? await stored(new Uint8Array(engine)) : null;
mkdirSync(out, { recursive: true });
/** Compressed, as text: in blocks of zlib's level 7, of which the engine takes 6 kB less than of its default. @param {string | Buffer} data */
const packed = (data) => gzipSync(data, { level: 9, memLevel: 7 }).toString("base64");

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
    `<style>${tight(readFileSync(join(HERE, "studio.css"), "utf8"))}</style>`,
    `<script type="text/plain" id="studio-modules">${packed(JSON.stringify(Object.fromEntries([...all].map(([name, text]) => [name, bare(text)]))))}</script>`,
    `<script type="text/plain" id="studio-worker">${within(bare(readFileSync(join(HERE, WORKER), "utf8")))}</script>`,
    ...(engine ? [`<script type="text/plain" id="studio-wasm">${packed(engine)}</script>`] : []),
].join("\n");
const still = before ? `<script type="text/plain" id="studio-stored">${packed(Buffer.from(before))}</script>\n` : "";
const page = html
    .replace(/<link rel="stylesheet"[^>]*>\n/, () => `${head}\n${still}`)
    .replace(/<script type="module" src="[^"]+"><\/script>\n/g, "")
    .replace("</body>", () => `<script>(async () => {${start}})();</script>\n</body>`);
write(join(out, "brinell-studio.html"), page);

const site = join(out, "site");
for (const name of ["studio.css", WORKER, ...all.keys()]) {
    mkdirSync(dirname(join(site, name)), { recursive: true });
    copyFileSync(join(HERE, name), join(site, name));
}
write(
    join(site, "index.html"),
    html.replace("</head>", () => `${still}</head>`),
);
if (engine) copyFileSync(wasm, join(site, "studio.wasm"));
console.log(
    `${relative("", join(out, "brinell-studio.html"))}: ${(page.length / 1e6).toFixed(2)} MB, ${all.size} modules, ${engine ? "with" : "WITHOUT"} the engine; ${relative("", site)}/: the same to serve`,
);
