// The pages that the tests open: folders <name>/ with report.html, result.json and steps.csv, made by the program.

import { execFileSync } from "node:child_process";
import { existsSync, readFileSync, readdirSync } from "node:fs";
import { join, resolve } from "node:path";

/**
 * Folders with a page under PLYDRAPE_REPORTS, in order of their names. Those of the examples with the sheet (NAME.sheet) are
 * left out: the folder `sheet` has such a page, and theirs differ from it by numbers only. So is the page of a book, which has no
 * result of its own.
 */
export function findReports() {
  const root = process.env.PLYDRAPE_REPORTS;
  if (root === undefined || !existsSync(root)) return [];
  return readdirSync(root)
    .filter((name) => !name.endsWith(".sheet"))
    .sort()
    .map((name) => ({ name, folder: resolve(root, name), file: resolve(root, name, "report.html") }))
    .filter(({ folder, file }) => existsSync(file) && existsSync(join(folder, "result.json")));
}

const LINES = `
import json, sys, plydrape
result = plydrape.Result.read(sys.argv[1])
numbers = json.loads(sys.argv[2])
grippers = {number: result.positions[number - 1].tolist() for number in numbers}
drapes = [drape for drape in (result, result.also) if drape is not None]
nu, nv = result.grid
edges = [((i, j), (i + 1, j)) for j in range(nv) for i in range(nu - 1)]
edges += [((i, j), (i, j + 1)) for j in range(nv - 1) for i in range(nu)]
steps = None
for drape in drapes:
    if drape.model == "catenaries":
        steps = {
            number: {
                "positions": drape.positions[number - 1].tolist(),
                "lines": [line.tolist() for line in result.lines(number)],
                "edges": edges,
            }
            for number in numbers
        }
sheet = None
if result.model == "sheet":
    kept = result.sheet.steps.tolist()
    last = len(kept) - 1
    sheet = {
        "landing": result.sheet.landing_step.tolist(),
        "states": {
            kept[k]: {
                "nodes": result.sheet.positions[k].tolist(),
                "heights": result.sheet.heights[k].tolist(),
                "forces": result.sheet.pad_forces[k].tolist(),
                "turns": result.quaternions[kept[k] - 1].tolist(),
                "grippers": result.sheet.grippers[k].tolist(),
            }
            for k in {0, last // 2, last}
        },
    }
print(
    json.dumps(
        {
            "model": result.model,
            "also": None if result.also is None else result.also.model,
            "accepted": result.accepted,
            "limits": result.summary["limits"],
            "grippers": grippers,
            "steps": steps,
            "sheet": sheet,
        }
    )
)
`;
const results = new Map();

/**
 * What the Python package reads from the result that a page was made from: the model that decides, the one beside it, the verdict and
 * the limits, and of some steps the positions of the grippers; of catenaries the curves of all of them in these steps, and the ends of the
 * edges, which come first; of a sheet three states; or null (a made-up page has none).
 */
export function readResult({ folder }, steps) {
  const file = join(folder, "result.json");
  if (!existsSync(file)) return null;
  if (!results.has(folder)) {
    const python = process.env.PLYDRAPE_PYTHON ?? join(import.meta.dirname, "../../.venv/bin/python");
    const text = execFileSync(python, ["-c", LINES, file, JSON.stringify(steps)], { maxBuffer: 2 ** 30 });
    results.set(folder, JSON.parse(text));
  }
  return results.get(folder);
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
