// The pages that the tests open: folders <name>/ with report.html, result.json and steps.csv, made by the program.

import { existsSync, readFileSync, readdirSync } from "node:fs";
import { join, resolve } from "node:path";

/** Folders with a page under PLYDRAPE_REPORTS, in order of their names. */
export function findReports() {
  const root = process.env.PLYDRAPE_REPORTS;
  if (root === undefined || !existsSync(root)) return [];
  return readdirSync(root)
    .sort()
    .map((name) => ({ name, folder: resolve(root, name), file: resolve(root, name, "report.html") }))
    .filter(({ file }) => existsSync(file));
}

/** The result that a page was made from, or null (a made-up page has none). */
export function readResult({ folder }) {
  const file = join(folder, "result.json");
  return existsSync(file) ? JSON.parse(readFileSync(file, "utf8")) : null;
}

/** Columns of steps.csv by their heads, as text; or null. */
export function readColumns({ folder }) {
  const file = join(folder, "steps.csv");
  if (!existsSync(file)) return null;
  const [head, ...rows] = readFileSync(file, "utf8").trim().split(/\r?\n/).map(splitLine);
  return Object.fromEntries(head.map((name, k) => [name, rows.map((row) => row[k])]));
}

/** The fields of one line of CSV, where quotes may hold commas. */
function splitLine(line) {
  return [...line.matchAll(/(?:^|,)(?:"((?:[^"]|"")*)"|([^,]*))/g)].map(
    (m) => m[1]?.replaceAll('""', '"') ?? m[2],
  );
}

/** Every point known of a catenary, in order: its ends, its spans, its rest on the mold. */
export function polyline(catenary, positions) {
  const points = [positions[catenary.from.join()]];
  let contact = catenary.contact;
  for (const span of catenary.spans) {
    if (contact && span.arc[0] >= contact.arc[1] - 1e-12) {
      points.push(...contact.points);
      contact = null;
    }
    points.push(...span.points);
  }
  if (contact) points.push(...contact.points);
  points.push(positions[catenary.to.join()]);
  return points;
}

/** Distance of a point from a polyline (m). */
export function distance(point, line) {
  let least = Infinity;
  for (let k = 0; k + 1 < line.length; k++) {
    const along = line[k + 1].map((x, c) => x - line[k][c]);
    const from = point.map((x, c) => x - line[k][c]);
    const square = along.reduce((sum, x) => sum + x * x, 0);
    const share =
      square > 0 ? Math.min(Math.max(along.reduce((sum, x, c) => sum + x * from[c], 0) / square, 0), 1) : 0;
    least = Math.min(least, Math.hypot(...from.map((x, c) => x - share * along[c])));
  }
  return least;
}
