// Builds the template of the results page: one HTML file with script, style and licences inside.
// The program puts the title and the data where the two __PLYDRAPE_…__ marks stand. Same sources, same bytes.

import { mkdir, readFile, writeFile } from "node:fs/promises";
import { dirname, join } from "node:path";
import { build } from "esbuild";

const here = import.meta.dirname;
const target = join(here, "..", "crates", "plydrape-io", "src", "page", "report.html");
const options = {
  absWorkingDir: here,
  bundle: true,
  minify: true,
  write: false,
  charset: "utf8",
  legalComments: "none",
  target: ["chrome103", "firefox113", "safari16.4"],
  logLevel: "warning",
};

const [script, style, ...licences] = await Promise.all([
  build({ ...options, entryPoints: ["src/main.ts"], format: "iife" }).then(text),
  build({ ...options, entryPoints: ["src/page.css"] }).then(text),
  ...["three", "uplot"].map(licence),
]);

/** The one file of a build. */
function text(result) {
  return result.outputFiles[0].text.trim();
}

/** Name, version and licence text of a bundled library: its licence asks for it. */
async function licence(name) {
  const folder = join(here, "node_modules", name);
  const { version } = JSON.parse(await readFile(join(folder, "package.json"), "utf8"));
  return `${name} ${version}\n\n${(await readFile(join(folder, "LICENSE"), "utf8")).trim()}`;
}

const notice = `This page contains these libraries.\n\n${licences.join("\n\n")}`;
if (notice.includes("--")) throw new Error("a licence text cannot stand in an HTML comment");
const parts = {
  "<!--LICENCES-->": `<!--\n${notice}\n-->`,
  "/*STYLE*/": style.replaceAll("</style", "<\\/style"),
  "/*SCRIPT*/": script.replaceAll("</script", "<\\/script").replaceAll("<!--", "<\\!--"),
};

let page = await readFile(join(here, "template.html"), "utf8");
for (const [mark, part] of Object.entries(parts)) {
  if (page.split(mark).length !== 2) throw new Error(`template.html must hold ${mark} once`);
  page = page.replace(mark, () => part);
}
for (const mark of ["__PLYDRAPE_TITLE__", "__PLYDRAPE_DATA__"]) {
  if (page.split(mark).length !== 2) throw new Error(`the page must hold ${mark} once`);
}

await mkdir(dirname(target), { recursive: true });
// a file that stays as it is keeps its time, and what is built from it stays built
const before = await readFile(target, "utf8").catch(() => "");
if (page !== before) await writeFile(target, page);
const kilobytes = (size) => `${(size / 1000).toFixed(0)} kB`;
console.log(
  `report.html: ${kilobytes(Buffer.byteLength(page))}, script ${kilobytes(script.length)}, style ${kilobytes(style.length)}`,
);
