// Builds the two pages, each one HTML file with script, style and licenses inside. Same sources, same bytes.
//
// The template of the results page: the program puts the title and the data where its two __PLYDRAPE_…__ marks are.
// The live page: it holds the solver as a WebAssembly module, packed. `node build.mjs MODULE.wasm` puts in a new one
// (scripts/live compiles it); without it the module stays that of the page as it is.

import { mkdir, readFile, writeFile } from "node:fs/promises";
import { dirname, join } from "node:path";
import { deflateSync } from "node:zlib";
import { build } from "esbuild";

const here = import.meta.dirname;
const options = {
  absWorkingDir: here,
  bundle: true,
  minify: true,
  write: false,
  charset: "utf8",
  legalComments: "none",
  target: ["chrome103", "firefox113", "safari16.4"],
  loader: { ".toml": "text" },
  logLevel: "warning",
};

/** The one file of a build. */
function text(result) {
  return result.outputFiles[0].text.trim();
}

/** Name, version and license text of a bundled library: its license asks for it. */
async function license(name) {
  const folder = join(here, "node_modules", name);
  const { version } = JSON.parse(await readFile(join(folder, "package.json"), "utf8"));
  return `${name} ${version}\n\n${(await readFile(join(folder, "LICENSE"), "utf8")).trim()}`;
}

/** Puts the parts where their marks are in a page, each once. */
function filled(page, name, parts) {
  for (const [mark, part] of Object.entries(parts)) {
    if (page.split(mark).length !== 2) throw new Error(`${name} must hold ${mark} once`);
    page = page.replace(mark, () => part);
  }
  return page;
}

/** Builds a page from its template, script and style. */
async function bundle({ template, script, style, libraries }) {
  const [code, look, ...licenses] = await Promise.all([
    build({ ...options, entryPoints: [script], format: "iife" }).then(text),
    build({ ...options, entryPoints: [style] }).then(text),
    ...libraries.map(license),
  ]);
  const notice = `This page contains these libraries.\n\n${licenses.join("\n\n")}`;
  if (notice.includes("--")) throw new Error("a license text cannot be in an HTML comment");
  return filled(await readFile(join(here, template), "utf8"), template, {
    "<!--LICENSES-->": `<!--\n${notice}\n-->`,
    "/*STYLE*/": look.replaceAll("</style", "<\\/style"),
    "/*SCRIPT*/": code.replaceAll("</script", "<\\/script").replaceAll("<!--", "<\\!--"),
  });
}

/** Writes a page; one that stays as it is keeps its time, and what is built from it stays built. */
async function write(target, page) {
  await mkdir(dirname(target), { recursive: true });
  if (page !== (await readFile(target, "utf8").catch(() => ""))) await writeFile(target, page);
  console.log(`${target}: ${(Buffer.byteLength(page) / 1000).toFixed(0)} kB`);
}

const root = join(here, "..");
const report = await bundle({
  template: "template.html",
  script: "src/main.ts",
  style: "src/page.css",
  libraries: ["three", "uplot"],
});
for (const mark of ["__PLYDRAPE_TITLE__", "__PLYDRAPE_DATA__"]) {
  if (report.split(mark).length !== 2) throw new Error(`the page must hold ${mark} once`);
}
await write(join(root, "crates", "plydrape-io", "src", "page", "report.html"), report);

const target = join(root, "docs", "live.html");
const module = process.argv[2];
const solver =
  module === undefined
    ? /id="plydrape-solver">\s*(\S+)\s*<\/script>/.exec(await readFile(target, "utf8"))?.[1]
    : deflateSync(await readFile(module), { level: 9 }).toString("base64");
if (solver === undefined)
  throw new Error("docs/live.html has lost its solver; scripts/live compiles it anew");
const live = await bundle({
  template: "live_template.html",
  script: "src/live/main.ts",
  style: "src/live.css",
  libraries: ["three"],
});
await write(target, filled(live, "live_template.html", { __PLYDRAPE_SOLVER__: solver }));
