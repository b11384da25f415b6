// The results page in a real browser, opened from disk without a network: what it shows is what the result says.
//
// PLYDRAPE_REPORTS names the folder of pages (scripts/test makes one from every example). Without it or without
// a browser the tests are skipped, loudly; where CI is set that is an error.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, statSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { deflateSync } from "node:zlib";
import { after, before, describe, test } from "node:test";
import { CHROMIUM, openReport, startBrowser } from "../browser.mjs";
import { fitsScreen } from "./phone.mjs";
import { distance, findReports, readColumns, readResult } from "./reports.mjs";

const MICROMETER = 1e-6;
const reports = findReports();
const missing =
  CHROMIUM === ""
    ? "there is no Chromium (install it or set CHROMIUM)"
    : reports.length === 0
      ? "PLYDRAPE_REPORTS names no folder with report.html in its folders"
      : null;

if (missing !== null) {
  if (process.env.CI) throw new Error(`the page cannot be tested: ${missing}`);
  console.error(`\n*** THE PAGE IS NOT TESTED: ${missing} ***\n`);
}

let browser;
let scratch;

describe("results page", { skip: missing ?? false }, () => {
  before(async () => {
    browser = await startBrowser();
    scratch = mkdtempSync(join(tmpdir(), "plydrape-page-"));
  });
  after(async () => {
    await browser?.close();
    rmSync(scratch, { recursive: true, force: true });
  });

  // Two pages at a time, each with its tests in order; of a kind the first, or every one for scripts/soak.
  const every = process.env.PLYDRAPE_EVERY_REPORT !== undefined;
  describe("of the examples", { concurrency: 2 }, () => {
    const seen = new Set();
    for (const report of reports) {
      const key = missing === null ? kind(report) : "";
      const first = !seen.has(key);
      seen.add(key);
      if (first || every) describe(report.name, { concurrency: 1 }, () => shows(report, first));
    }
  });

  test("plays from the first step to the last", () => playsThrough(reports[0]));
  test("light and dark differ, by the system and by the button", () => themesDiffer(reports[0]));
  test("views look from elsewhere, and the list of keys opens", () => viewsDiffer(reports[0]));
  test("a scene that is not draped yet is shown without verdict, limits and courses", () => sceneIsShown());
  test("damaged data gives one sentence", () => damagedDataIsSaid(reports[0]));
  test("a drape with fewer steps than planned says why", () => fewerStepsAreSaid(reports[0]));
  const sheet = reports.find((report) => hasSheet(report));
  const both = reports.find((report) => missing === null && JSON.parse(parts(report)[1]).also !== null);
  test(
    "the other model is behind a switch, is named so, and judges nothing",
    { skip: both ? false : "no page of two models" },
    () => otherJudgesNothing(both),
  );
  test(
    "a sample shows how many cells keep the limits, how high they are, and where",
    { skip: sheet ? false : "no page of a sheet" },
    () => sampleIsShown(sheet),
  );
  test(
    "the drape of another program is shown beside the sheet, and leads to where they differ most",
    { skip: sheet ? false : "no page of a sheet" },
    () => peerIsShown(sheet),
  );
  test("paths of the grippers tell what they have passed from what comes", () => pathsShow(surfaced()));
  test("an address names step and colors", () => addressLeads(surfaced()));
  test("heights have a scale of orders or an even one, of all steps or of one", () =>
    scalesChange(surfaced()));
  test("between catenaries the pointer reads the surface", () => surfaceIsRead(surfaced()));
  test("a second page is shown beside this one, with what differs", () =>
    pagesCompare(surfaced(), another()));
  test("a result.json is compared by its numbers", () => numbersCompare(surfaced()));
  test("a picture and a video are saved", () => saves(sheet ?? surfaced()));
  test("a browser that cannot record says so", () => saysNoRecorder(surfaced()));
  test("on a phone nothing is wider than the screen, and a tap reads values", () =>
    fitsPhone(sheet ?? surfaced()));
  test("without WebGL everything else works", () => worksWithoutWebgl(reports[0]));
});

/** What the grippers carry and what stands there can be hidden; the timeline marks when pads press and let go. */
async function cellShows(report, page) {
  const { cell } = JSON.parse(parts(report)[1]);
  const { scene, summary } = JSON.parse(readFileSync(join(report.folder, "result.json"), "utf8"));
  const { bodies, obstacles } = scene.bodies ?? { bodies: [], obstacles: [] };
  const names = (list) => list.map(({ name }) => name);
  assert.equal(cell !== null, bodies.length + obstacles.length > 0 || scene.tool !== undefined);
  const check = page.locator("#show-cell");
  assert.equal(await check.isVisible(), cell !== null);
  const marked = (summary.events ?? []).filter(({ kind }) => kind !== "grip");
  assert.equal(await page.locator(".mark-vacuum").count(), marked.length);
  if (cell === null) return;
  assert.deepEqual(names(cell.bodies), names(bodies));
  assert.deepEqual(names(cell.obstacles), names(obstacles));
  const shown = await page.locator("#view").screenshot();
  await check.uncheck();
  await page.waitForTimeout(200);
  assert.ok(!shown.equals(await page.locator("#view").screenshot()), "the picture is without them");
  await check.check();
  // keys are for the page again
  await check.blur();
}

/** The catenaries of a page, whether they decide or not; null where there are none. */
function catenariesOf({ drape, also }) {
  return drape.catenaries ?? also?.catenaries ?? null;
}

/** Whether there is a surface between the catenaries of a page. */
function hasSurface(data) {
  return catenariesOf(data)?.grid.every((count) => count > 1) ?? false;
}

/** The first page with a surface between catenaries and more than one step. */
function surfaced() {
  return reports.find((report) => {
    const data = JSON.parse(parts(report)[1]);
    return hasSurface(data) && data.steps.length > 2;
  });
}

/** A page of a sheet other than the first with a surface, or else the last page. */
function another() {
  const others = reports.filter((report) => report !== surfaced());
  return others.findLast((report) => hasSheet(report)) ?? others.at(-1) ?? surfaced();
}

/** Whether the sheet decides on a page. */
function hasSheet(report) {
  return missing === null && JSON.parse(parts(report)[1]).drape.sheet !== null;
}

/** What a page has to show. Pages of a kind play and print alike; their numbers differ. */
function kind(report) {
  const { drape, also, steps, input, limits, accepted } = JSON.parse(parts(report)[1]);
  const names = [drape.fields, drape.measures, limits, also?.fields ?? []].map((list) =>
    list.map(({ key }) => key).sort(),
  );
  return JSON.stringify([drape.model, names, steps.length > 1, input !== null, accepted]);
}

/** What holds for every page, tried on one that stays open; for the first of its kind also what needs no numbers. */
function shows(report, first) {
  let opened;
  before(async () => {
    opened = await openReport(browser, report.file);
  });
  after(() => opened?.context.close());
  test("opens at the worst limit of the end, with its place marked", () => opensAtWorst(opened.page));
  test("opens without a diagnostic and asks for nothing", () => opens(report, opened));
  test("shows nothing of a sample that the result does not have", () => saysNoSample(opened.page));
  test("bodies, obstacles and what the vacuum does are those of the result", () =>
    cellShows(report, opened.page));
  if (hasSheet(report)) {
    test("the sheet has the nodes, heights and forces of its states", () => sheetShows(report, opened.page));
  }
  test("the grippers are those of the model that decides in every step", () =>
    grippersMove(report, opened.page));
  test("the slider moves the ply to the result's positions", () => sliderMoves(report, opened.page));
  if (first) test("plays, stops, and steps by keyboard", () => playsAndSteps(opened.page));
  test("every color mode has its own legend", () => colorsHaveLegends(opened.page));
  test("a limit leads to its step and place", () => limitsLead(report, opened.page));
  test("slack is shown as an angle", () => saysSlackAsAngle(opened.page));
  test("a limit and the chart of its measure have one unit", () => unitsAgree(opened.page));
  test("a section shows ply and mold along a line of the fabric", () => sectionShows(report, opened.page));
  test("charts hold the numbers of steps.csv, and a click goes to a step", () =>
    chartsHold(report, opened.page));
  if (first) test("prints without controls, in light", () => prints(opened.page));
  test("has reported nothing in all this", () => assert.deepEqual(opened.diagnostics, []));
}

/** Waits until this many frames were drawn. */
async function frames(page, count) {
  await page.evaluate(async (n) => {
    for (let k = 0; k < n; k++) await new Promise(requestAnimationFrame);
  }, count);
}

/** Checks until it holds, for two seconds at most. */
async function eventually(check) {
  for (const end = performance.now() + 2000; ; await new Promise((again) => setTimeout(again, 10))) {
    try {
      return await check();
    } catch (error) {
      if (performance.now() > end) throw error;
    }
  }
}

async function opens(report, { page, diagnostics, requests }) {
  const title = await page.locator("#title").textContent();
  const long = "A title that does not fit beside the verdict in a line, as real parts have them".repeat(2);
  for (const [width, height, other] of [
    [1920, 1080],
    [1280, 720],
    [1400, 900, long],
  ]) {
    await page.setViewportSize({ width, height });
    if (other) await page.evaluate((text) => (document.querySelector("#title").textContent = text), other);
    await frames(page, 2);
    // Title, verdict and picture are in view, and nothing is wider than the window.
    for (const selector of ["#title", "#verdict", "#picture", "#slider"]) {
      const box = await page.locator(selector).boundingBox();
      assert.ok(
        box.y >= 0 && box.y + box.height <= height && box.x + box.width <= width,
        `${selector} is in view`,
      );
    }
    const overflow = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
    assert.ok(overflow <= 0, `wider than the window by ${overflow}`);
  }
  await page.evaluate((text) => (document.querySelector("#title").textContent = text), title);
  assert.deepEqual(diagnostics, []);
  assert.deepEqual(
    requests.filter((url) => !url.startsWith("data:")).map((url) => decodeURI(url)),
    [`file://${report.file}`],
  );
  assert.ok(await page.evaluate(() => window.plydrape.webgl), "there is a 3D picture");
  const nameless = await page.evaluate(() =>
    [...document.querySelectorAll("button, input, select")]
      .filter(
        (e) =>
          !(
            e.getAttribute("aria-label") ||
            e.textContent.trim() ||
            e.closest("label")?.textContent.trim() ||
            e.ariaHidden
          ),
      )
      .map((e) => e.outerHTML),
  );
  assert.deepEqual(nameless, [], "every control has a name");
  assert.ok(statSync(report.file).size <= 20e6, "at most 20 MB");
}

/** Numbers of the first, the middle and the last step of a page. */
function someSteps({ steps }) {
  return [...new Set([0, Math.floor(steps.length / 2), steps.length - 1].map((k) => steps[k]))];
}

/** The result behind a page, with the steps that the tests look at. */
function resultOf(report, given) {
  // A long drape is shown in a part of its steps: then a limit leads to one beside its own.
  const judged = given.limits
    .filter(({ step }) => step !== null)
    .flatMap(({ step }) => {
      const away = given.steps.map((number) => Math.abs(number - step));
      return given.steps.filter((_, k) => away[k] === Math.min(...away));
    });
  return readResult(report, [...new Set([...someSteps(given), ...judged])]);
}

/** Grippers stand where the result has them, whether the ply is drawn in that step or not; if not, the page says which ply it shows. */
async function grippersMove(report, page) {
  const given = await pageData(page);
  const { grippers } = resultOf(report, given);
  for (const [number, positions] of Object.entries(grippers)) {
    await page.evaluate((step) => window.plydrape.goto(Number(step)), number);
    const shown = await page.evaluate(
      (count) => Array.from({ length: count }, (_, k) => window.plydrape.gripper(k)),
      positions.length,
    );
    positions.forEach((position, k) => {
      const off = Math.hypot(...position.map((x, c) => x - shown[k][c]));
      assert.ok(off <= MICROMETER, `step ${number}: gripper ${k} is off by ${off} m`);
    });
    const index = given.steps.indexOf(Number(number));
    const drawn = given.drape.drawn[given.drape.pictures[index]];
    const note = page.locator(".picture-note").first();
    if (drawn === Number(number)) assert.ok(!(await note.isVisible()));
    else assert.match(await note.innerText(), new RegExp(`as in step ${drawn}`));
  }
}

async function sliderMoves(report, page) {
  const given = await pageData(page);
  const result = resultOf(report, given);
  // cups that are no whole array span no surface
  const catenaries = catenariesOf(given);
  if (catenaries === null || catenaries.grid.includes(0)) return;
  await page.evaluate(() => (window.plydrape.model = "catenaries"));
  const n = catenaries.divisions;
  const columns = (catenaries.grid[0] - 1) * n + 1;
  const at = (i, j) => i * n + j * n * columns;
  const shown = new Map(
    (await page.evaluate(() => window.plydrape.steps)).map((number, index) => [number, index]),
  );
  let moved = null;
  for (const number of someSteps(given)) {
    const { positions, lines, edges } = result.steps[number];
    await setSlider(page, shown.get(number));
    const wanted = positions.map((_, k) => at(k % catenaries.grid[0], Math.floor(k / catenaries.grid[0])));
    const between = edges.map(([from, to]) => {
      const [a, b] = [at(...from), at(...to)];
      return Array.from({ length: n - 1 }, (_, k) => a + ((b - a) / n) * (k + 1));
    });
    const vertices = await page.evaluate(
      (list) => list.map((k) => window.plydrape.vertex(k)),
      [...wanted, ...between.flat()],
    );
    positions.forEach((position, k) => {
      const off = Math.hypot(...vertices[k].map((x, c) => x - position[c]));
      assert.ok(off <= MICROMETER, `step ${number}: gripper ${k} is off by ${off} m`);
    });
    let k = wanted.length;
    for (const [edge, [from, to]] of edges.entries()) {
      for (let piece = 1; piece < n; piece++, k++) {
        const off = distance(vertices[k], lines[edge]);
        assert.ok(
          off <= 2 * MICROMETER,
          `step ${number}: edge ${from}–${to} is off by ${off} m at ${piece}/${n}`,
        );
      }
    }
    const now = JSON.stringify(vertices);
    assert.notEqual(now, moved, "the ply moved");
    moved = now;
    assert.equal(await page.evaluate(() => window.plydrape.step), number);
  }
  await page.evaluate((model) => (window.plydrape.model = model), given.drape.model);
}

/** Nodes, hover and arrows of the sheet are those of sheet.npz, as Python reads it. */
async function sheetShows(report, page) {
  const data = await pageData(page);
  const { sheet } = resultOf(report, data);
  assert.equal(await page.evaluate(() => window.plydrape.model), "sheet", "the model that decides is shown");
  assert.deepEqual(data.drape.sheet.landing, sheet.landing);
  for (const [step, { nodes, heights, forces, turns, grippers }] of Object.entries(sheet.states)) {
    await page.evaluate((number) => window.plydrape.goto(Number(number)), step);
    const shown = await page.evaluate((count) => {
      return Array.from({ length: count }, (_, k) => window.plydrape.node(k));
    }, nodes.length);
    nodes.forEach((node, k) => {
      const off = Math.hypot(...shown[k].map((x, c) => x - node[c]));
      assert.ok(off <= MICROMETER, `step ${step}: node ${k} is off by ${off} m`);
    });
    const most = Math.max(...forces.map((force) => Math.hypot(...force)));
    // the arrows are the loads along and across the ply
    const parts = forces.flatMap((force, k) => {
      const [x, y, z, w] = turns[k];
      const normal = [2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)];
      const up = force.reduce((sum, f, c) => sum + f * normal[c], 0);
      return [Math.hypot(...force.map((f, c) => f - up * normal[c])), Math.abs(up)];
    });
    const longest = Math.max(...parts);
    const scale = page.locator("#force-scale");
    // pads that have let go have no loads
    assert.equal(await scale.isVisible(), longest > 0);
    if (longest > 0) {
      const note = await scale.innerText();
      const said = parseFloat(note.split("arrow")[1]);
      // what is less than a millinewton is said to be so
      const isSmall = longest < 1e-3 && /<\s*0\.001\s*N/.test(note);
      const agrees = isSmall || Math.abs(said / longest - 1) < 1e-3;
      assert.ok(agrees, `${note} is not ${longest} N`);
    }

    if (Number(step) !== data.steps.at(-1)) continue;
    // from above the node that is highest over the mold, and the gripper with the largest force
    await page.keyboard.press("t");
    await frames(page, 2);
    const node = heights.indexOf(Math.max(...heights));
    const number = (text) => parseFloat(text.replaceAll("−", "-"));
    const found = await hoverOver(page, nodes[node]);
    const isGripper = found.startsWith("gripper");
    if (!isGripper) {
      const rows = await plateRows(page);
      assert.ok(Math.abs(number(rows["height over the mold"] ?? "NaN") - 1e3 * heights[node]) < 2e-2, found);
      const said = rows["x, y, z"].split(",").map(number);
      said.forEach((c, n) => assert.ok(Math.abs(c - 1e3 * nodes[node][n]) < 6e-2, `${c} in ${found}`));
    }
    const pad = forces.findIndex((force) => Math.hypot(...force) === most);
    const text = await hoverOver(page, grippers[pad]);
    assert.ok(text.startsWith(`gripper g${data.ids[pad].join("_")}`), text);
    const rows = await plateRows(page);
    const released = data.events.some(({ kind }) => kind === "release");
    assert.match(rows.vacuum, released ? /^off since/ : /^on, holds/);
    // what has let go has no loads
    if (released) continue;
    assert.ok(Math.abs(number(rows["gripper force"]) / most - 1) < 1e-3, text);
    // without a tool the stems are upright
    const [x, y] = turns[pad];
    const tilt = (Math.acos(1 - 2 * (x * x + y * y)) * 180) / Math.PI;
    if (data.cell === null)
      assert.ok(Math.abs(number(rows.tilt) - tilt) < 2e-2, `${rows.tilt} is not ${tilt}`);
    assert.match(rows.tilt, /allowed/);
  }
  await page.keyboard.press("i");
}

/** Picture and charts become those of the other model, which is named; verdict and limits stay, and nothing of it has a limit. */
async function otherJudgesNothing(report) {
  const { page, context, diagnostics } = await openReport(browser, report.file);
  const data = await pageData(page);
  const result = resultOf(report, data);
  assert.deepEqual([data.drape.model, data.also.model], [result.model, result.also]);
  const judged = () =>
    page.evaluate(() => [
      document.querySelector("#verdict").textContent,
      document.querySelector("#limits").textContent,
    ]);
  const charts = () =>
    page.evaluate(() =>
      [...document.querySelectorAll(".charts:not([hidden]) .chart")].map(({ dataset }) => dataset.measure),
    );
  const keys = ({ measures }) => measures.map(({ key }) => key);
  const note = page.locator(".picture-note").first();
  const before = await judged();
  const picture = await pictureOf(page);
  assert.deepEqual(await charts(), keys(data.drape));
  assert.ok(!(await page.locator("#charts-model").isVisible()));
  await page.keyboard.press("c");
  assert.equal(await page.evaluate(() => window.plydrape.model), data.also.model);
  assert.notDeepEqual(await pictureOf(page), picture);
  assert.deepEqual(await judged(), before);
  assert.deepEqual(await charts(), keys(data.also));
  const named = new RegExp(`${data.also.model} \\(for comparison, judges nothing\\)`, "i");
  for (const label of [note, page.locator("#charts-model")]) assert.match(await label.innerText(), named);
  assert.equal(await page.evaluate(() => window.plydrape.pointer), null);
  for (const list of [data.also.measures, data.also.fields, data.also.grippers.readings])
    assert.ok(list.every(({ limit }) => limit === null));
  assert.equal(await page.locator(".charts:not([hidden]) .chart-limit:not(:empty)").count(), 0);
  await colorsHaveLegends(page);
  // a limit leads back to the model that it judges
  await page.locator("#limits tbody tr.linked button").first().click();
  assert.equal(await page.evaluate(() => window.plydrape.model), data.drape.model);
  assert.deepEqual(diagnostics, []);
  await context.close();
}

/** The picture as it is drawn now. */
async function pictureOf(page) {
  await frames(page, 2);
  return page.locator("#view").screenshot();
}

/** Labels and values on the plate. */
async function plateRows(page) {
  return page.evaluate(() => {
    const names = [...document.querySelectorAll("#view .hover dt")];
    return Object.fromEntries(names.map((dt) => [dt.textContent, dt.nextElementSibling.textContent]));
  });
}

/** What the plate says with the mouse over a place on the ply. */
async function hoverOver(page, place) {
  const [x, y] = await page.evaluate((at) => window.plydrape.onScreen(at), place);
  const box = await page.locator("#view").boundingBox();
  await page.mouse.move(box.x + 2, box.y + 2);
  await page.mouse.move(box.x + x, box.y + y);
  await frames(page, 2);
  return page.locator("#view .hover").innerText();
}

/** What the page was given. */
async function pageData(page) {
  return page.evaluate(() => JSON.parse(document.getElementById("plydrape-data").textContent));
}

/** Puts the slider on an index, as a hand does. */
async function setSlider(page, index) {
  await page.locator("#slider").evaluate((slider, value) => {
    slider.value = String(value);
    slider.dispatchEvent(new Event("input", { bubbles: true }));
  }, index);
}

async function playsAndSteps(page) {
  const steps = await page.evaluate(() => window.plydrape.steps);
  const now = () => page.evaluate(() => window.plydrape.step);
  const last = steps.length - 1;
  if (last === 0) {
    assert.ok(await page.locator("#play").isDisabled(), "one step cannot be played");
    return;
  }
  await page.keyboard.press("Home");
  assert.equal(await now(), steps[0]);
  await page.keyboard.press("ArrowRight");
  assert.equal(await now(), steps[1]);
  await page.keyboard.press("ArrowLeft");
  assert.equal(await now(), steps[0]);
  await page.keyboard.press("ArrowLeft");
  assert.equal(await now(), steps[0], "before the first step there is none");
  await page.keyboard.press("End");
  assert.equal(await now(), steps[last]);

  await page.keyboard.press("Home");
  await page.keyboard.press("Space");
  assert.ok(await page.evaluate(() => window.plydrape.playing));
  await page.waitForFunction((first) => window.plydrape.step > first, steps[0], { timeout: 10_000 });
  await page.keyboard.press("Space");
  assert.ok(!(await page.evaluate(() => window.plydrape.playing)));
  const stopped = await now();
  const played = () => page.evaluate(() => window.plydrape.frames.length);
  const before = await played();
  await frames(page, 5);
  assert.equal(await now(), stopped, "it stands still");
  assert.equal(await played(), before, "no frame is played any more");

  await setSlider(page, Math.max(last - 3, 0));
  await page.locator("#speed").selectOption("4");
  await page.locator("#play").click();
  await playsToTheEnd(page);
}

/** Playing ends by itself, at the last step. */
async function playsToTheEnd(page) {
  await page.waitForFunction(
    () => window.plydrape.step === window.plydrape.steps.at(-1) && !window.plydrape.playing,
    null,
    { timeout: 20_000 },
  );
}

async function playsThrough(report) {
  const { page, context } = await openReport(browser, report.file);
  await page.keyboard.press("Home");
  await page.locator("#speed").selectOption("4");
  await page.locator("#play").click();
  await playsToTheEnd(page);
  await context.close();
}

async function colorsHaveLegends(page) {
  const order = await page.evaluate(() => window.plydrape.colors);
  assert.equal(await page.locator("#legend").isVisible(), order.length > 0);
  const titles = new Set();
  for (const [k, color] of order.entries()) {
    await page.keyboard.press(String(k + 1));
    assert.equal(await page.evaluate(() => window.plydrape.color), color);
    const legend = await page.evaluate(() => window.plydrape.legend());
    const text = await page.locator("#legend").innerText();
    assert.ok(
      text.toLowerCase().includes(legend.title.toLowerCase()),
      `the legend “${text}” says ${legend.title}`,
    );
    assert.ok(text.includes(legend.unit));
    assert.ok(
      legend.ticks.length > 0 && legend.ticks.every((t) => t >= legend.low - 1e-9 && t <= legend.high + 1e-9),
    );
    titles.add(await page.locator(".legend-title").innerText());
    await rangesNarrow(page, legend);
  }
  assert.equal(titles.size, order.length, "no two legends are alike");
}

/** By R the legend spans the values of the step in view, which are among those of all steps. */
async function rangesNarrow(page, all) {
  await page.keyboard.press("r");
  const own = await page.evaluate(() => window.plydrape.legend());
  assert.ok(await page.locator("#step-range").isChecked());
  assert.ok(own.low < own.high || own.low === own.high, `${own.low} to ${own.high}`);
  // the ends of a scale of orders are no values
  if (all.scale === "even")
    assert.ok(own.low >= all.low - 1e-9 && own.high <= all.high + 1e-9, `${own.low} to ${own.high}`);
  if (all.key === "height" && (await page.evaluate(() => window.plydrape.model === "catenaries"))) {
    const heights = await page.evaluate(() => {
      const data = JSON.parse(document.getElementById("plydrape-data").textContent);
      const { grid, divisions } = data.drape.catenaries ?? data.also.catenaries;
      const count = grid.reduce((product, side) => product * ((side - 1) * divisions + 1), 1);
      return Array.from({ length: count }, (_, k) => window.plydrape.vertex(k)[2] * 1e3);
    });
    for (const [end, found] of [
      [own.low, Math.min(...heights)],
      [own.high, Math.max(...heights)],
    ]) {
      assert.ok(Math.abs(end - found) < 2e-3, `${end} mm is not ${found} mm`);
    }
  }
  await page.keyboard.press("r");
  assert.deepEqual(await page.evaluate(() => window.plydrape.legend()), all);
}

/** The angle is 2√ε of the slack ratio at the end, unless it has a row of its own. */
async function saysSlackAsAngle(page) {
  const data = await pageData(page);
  const ratio = data.limits.find(({ name }) => name === "slack ratio");
  const own = data.limits.some(({ name }) => name === "slack angle");
  const said = await page.locator(".limits .other-units").allTextContents();
  if (ratio !== undefined && ratio.value > 0 && !own) {
    const angle = (360 / Math.PI) * Math.sqrt(ratio.value / 100);
    const [, shown] = /a fiber angle of ([\d.]+)°/.exec(said[0]);
    assert.ok(Math.abs(Number(shown) / angle - 1) < 1e-3, `${shown} ${angle}`);
  }
}

async function limitsLead(report, page) {
  const data = await pageData(page);
  const result = resultOf(report, data);
  const given = [...data.limits, ...(data.sample?.limits ?? [])];
  assert.equal(await page.locator(".limits tbody tr").count(), given.length);
  const numbers = (list) =>
    list.map(({ value, limit, ok, step, where }) =>
      JSON.stringify({ value, limit, ok, step: step ?? null, where }),
    );
  assert.deepEqual(numbers(data.limits).sort(), numbers(result.limits).sort());
  assert.equal(data.accepted, result.accepted);
  // the closest to its limit comes first
  data.limits.forEach(({ ratio }, k) => assert.ok(k === 0 || ratio <= data.limits[k - 1].ratio));
  const words = await page.locator(".limits tbody .word").allTextContents();
  given.forEach(({ ok }, k) => assert.match(words[k], ok ? /✓\s*pass/ : /✗\s*fail/));
  const verdict = await page.locator("#verdict").innerText();
  const failed = data.limits.filter(({ ok }) => !ok).length;
  const by = `by the ${result.model}`;
  const refused = new RegExp(`Not accepted ${by}: ${failed} of ${data.limits.length}`);
  assert.match(verdict, failed === 0 ? new RegExp(`ccepted ${by}${data.world}: `) : refused);

  const row = Math.max(
    0,
    given.findIndex(({ ok, place }) => !ok && place !== null),
  );
  const limit = given[row];
  if (limit?.step == null) {
    return;
  }
  await page.keyboard.press("Home");
  // those of a sample are folded up
  await page.evaluate(() => {
    for (const folded of document.querySelectorAll("details")) folded.open = true;
  });
  const button = page.locator(".limits tbody tr").nth(row).locator("button");
  await button.focus();
  await page.keyboard.press("Enter");
  const { step, pointer } = await page.evaluate(() => ({
    step: window.plydrape.step,
    pointer: window.plydrape.pointer,
  }));
  if (data.steps.includes(limit.step)) assert.equal(step, limit.step);
  if (limit.place !== null) {
    assert.deepEqual(pointer.place, limit.place);
    assert.ok(pointer.label.toLowerCase().startsWith(limit.name));
  }
  if (limit.place !== null && data.drape.catenaries !== null) {
    // The place lies on the ply of that step.
    const off = Math.min(...result.steps[step].lines.map((line) => distance(limit.place, line)));
    assert.ok(off < 0.02, `the place is ${off} m away from the ply`);
  }
  await page.keyboard.press("Escape");
  assert.equal(await page.evaluate(() => window.plydrape.pointer), null);
}

async function chartsHold(report, page) {
  const measures = await page.evaluate(() => window.plydrape.measures);
  const steps = await page.evaluate(() => window.plydrape.steps);
  const columns = readColumns(report);
  if (columns !== null) {
    assert.ok(measures.length > 0);
    for (const measure of measures) {
      // files have shares and degrees as deg, the page per cent and °
      const share = measure.unit === "%";
      const unit = share ? "1" : measure.unit.replace("°", "deg");
      const column = columns[`${measure.label} (${unit})`];
      assert.ok(column, `steps.csv has a column “${measure.label} (${unit})”`);
      const factor = share ? 100 : 1;
      const numbers = new Map(
        columns.step.map((step, k) => [Number(step), column[k] === "" ? null : factor * Number(column[k])]),
      );
      assert.deepEqual(
        measure.values,
        steps.map((step) => numbers.get(step)),
        measure.key,
      );
    }
  }
  const charted = measures.filter(({ values }) => values.some((value) => value !== null));
  const shown = ".charts:not([hidden]) .chart";
  assert.equal(await page.locator(shown).count(), charted.length);
  if (charted.length === 0) return;

  // The number in a chart's head is that of the step in view, in full in its title.
  for (const number of [steps[0], steps[steps.length - 1]]) {
    await page.evaluate((step) => window.plydrape.goto(step), number);
    const index = steps.indexOf(number);
    // markers follow within a tenth of a second
    await eventually(async () => {
      const titles = await page.evaluate(
        ([keys, chart]) =>
          keys.map((key) => document.querySelector(`${chart}[data-measure="${key}"] .chart-value`).title),
        [charted.map(({ key }) => key), shown],
      );
      charted.forEach(({ key, values }, k) => {
        if (values[index] === null) assert.match(titles[k], /no value/);
        else assert.equal(parseFloat(titles[k].replaceAll("−", "-")), values[index], key);
      });
    });
  }

  // A click in the middle of a chart goes to the step in the middle, and the marker follows.
  if (steps.length > 2) {
    const over = page.locator(`${shown} .u-over`).first();
    const box = await over.boundingBox();
    await over.click({ position: { x: box.width / 2, y: box.height / 2 } });
    const step = await page.evaluate(() => window.plydrape.step);
    const middle = (steps[0] + steps[steps.length - 1]) / 2;
    const apart = Math.max(...steps.slice(1).map((number, k) => number - steps[k]));
    assert.ok(Math.abs(step - middle) <= apart, `step ${step}, the middle is ${middle}`);
    assert.equal(await page.locator("#slider").inputValue(), String(steps.indexOf(step)));
    const expected = box.x + (box.width * (step - steps[0])) / (steps[steps.length - 1] - steps[0]);
    await eventually(async () => {
      const marker = await page.locator(`${shown} .chart-marker`).first().boundingBox();
      assert.ok(Math.abs(marker.x + marker.width / 2 - expected) <= 1.5, "the marker is on the step");
    });
  }
}

async function prints(page) {
  await page.emulateMedia({ colorScheme: "dark" });
  await page.waitForFunction(() => document.documentElement.dataset.theme === "dark");
  const paper = () =>
    page.evaluate(() => getComputedStyle(document.documentElement).getPropertyValue("--surface").trim());
  const dark = await paper();
  await page.emulateMedia({ media: "print", colorScheme: "dark" });
  await page.waitForFunction(() => document.getElementById("snapshot").src.startsWith("data:image/png"));
  for (const selector of ["#theme", "#help-open", ".toolbar", "#play", "#slider", "#speed", "#picture"]) {
    assert.ok(!(await page.locator(selector).isVisible()), `${selector} is not printed`);
  }
  for (const selector of ["#title", "#verdict", "#snapshot", "#step", "#limits", "#charts", "#program"]) {
    assert.ok(await page.locator(selector).isVisible(), `${selector} is printed`);
  }
  assert.notEqual(await paper(), dark, "print is light");
  const { input } = await pageData(page);
  if (input !== null) assert.ok(await page.locator("#input-text").isVisible(), "the input is printed");
  await page.emulateMedia({ media: "screen", colorScheme: "dark" });
  await page.waitForFunction(() => !document.documentElement.classList.contains("printing"));
  assert.ok(await page.locator("#play").isVisible(), "and afterwards the controls are back");
  assert.equal(await paper(), dark);
}

async function themesDiffer(report) {
  const look = async (dark) => {
    const { page, context } = await openReport(browser, report.file, { dark });
    const system = await ground(page);
    await page.locator("#theme").click();
    const other = await ground(page);
    await context.close();
    return [system, other];
  };
  const light = await look(false);
  const dark = await look(true);
  assert.ok(light[0] > 200 && dark[0] < 60, `light ${light[0]}, dark ${dark[0]}`);
  assert.deepEqual(light, dark.toReversed(), "the button changes one into the other");
}

/** Brightness of the corner of the 3D picture as it is on the screen. */
async function ground(page) {
  await page.waitForTimeout(200);
  const { x, y } = await page.locator("#picture").boundingBox();
  const shot = (await page.screenshot({ clip: { x: x + 2, y: y + 2, width: 1, height: 1 } })).toString(
    "base64",
  );
  return page.evaluate(async (data) => {
    const image = new Image();
    image.src = `data:image/png;base64,${data}`;
    await image.decode();
    const pen = new OffscreenCanvas(1, 1).getContext("2d");
    pen.drawImage(image, 0, 0);
    return pen.getImageData(0, 0, 1, 1).data[0];
  }, shot);
}

async function viewsDiffer(report) {
  const { page, context } = await openReport(browser, report.file);
  const pictures = new Set();
  for (const key of ["t", "f", "s", "i"]) {
    await page.keyboard.press(key);
    await page.waitForTimeout(150);
    pictures.add((await page.locator("#view").screenshot()).toString("base64"));
  }
  assert.equal(pictures.size, 4, "four views, four pictures");
  await page.keyboard.press("?");
  assert.ok(await page.locator("#help").isVisible());
  await page.keyboard.press("Escape");
  assert.ok(!(await page.locator("#help").isVisible()));
  await context.close();
}

/** A page in three parts: what comes before its data, the data, what comes after. */
function parts(report) {
  const text = readFileSync(report.file, "utf8");
  const mark = '<script type="application/json" id="plydrape-data">';
  const start = text.indexOf(mark) + mark.length;
  const end = text.indexOf("</script>", start);
  return [text.slice(0, start), text.slice(start, end), text.slice(end)];
}

/** A made-up drape by another program, with states in every other step: its table, both lines, and the place that is farthest apart. */
async function peerIsShown(report) {
  const [head, data, tail] = parts(report);
  const page0 = JSON.parse(data);
  const { steps, drape } = page0;
  const node = Math.floor(drape.sheet.landing.length / 2);
  const kept = (value) => steps.map((step, k) => ((steps.length - 1 - k) % 2 === 0 ? value(step) : null));
  const course = (key, label, unit, name) => ({
    key,
    label,
    unit,
    first: kept((step) => 30 - 0.2 * step),
    name,
    second: kept((step) => 28 - 0.1 * step),
  });
  const last = steps.at(-1);
  const peer = {
    name: "NGSolve",
    ends: [
      ["largest height at the end (mm)", "0.35", "2.87"],
      ["first touch in step", "43.0", "38.2"],
    ],
    cost: "NGSolve took 82 s of processor time.",
    courses: [
      course("lowest", "lowest point", "mm", "NGSolve"),
      course("apart", "points apart, mean", "mm", "at most"),
    ],
    farthest: { step: last, node, uv_mm: [75, 50], apart_mm: 2.5 },
  };
  const file = join(scratch, "peer.html");
  writeFileSync(file, head + JSON.stringify({ ...page0, peer }).replaceAll("<", "\\u003c") + tail);
  const { page, context, diagnostics } = await openReport(browser, file);
  const section = page.locator("#peer");
  assert.equal(await section.locator("h2").innerText(), "Beside NGSolve");
  assert.deepEqual(await section.locator("td").allInnerTexts(), ["0.35", "2.87", "43.0", "38.2"]);
  await page.evaluate((step) => window.plydrape.goto(step), last);
  await page.waitForTimeout(200);
  const said = async (key) => {
    const chart = section.locator(`[data-measure="${key}"]`);
    return [await chart.locator(".chart-value").innerText(), await chart.locator(".chart-where").innerText()];
  };
  const at = (value) => `${String(Number(value.toPrecision(4)))}\u00a0mm`;
  const [first, second] = [at(30 - 0.2 * last), at(28 - 0.1 * last)];
  assert.deepEqual(await said("lowest"), [first, `NGSolve ${second}`]);
  assert.deepEqual(await said("apart"), [first, `at most ${second}`]);

  await page.evaluate((step) => window.plydrape.goto(step), steps[0]);
  await section.getByRole("button").click();
  const [pointer, place] = await page.evaluate(
    (n) => [window.plydrape.pointer, window.plydrape.node(n)],
    node,
  );
  assert.equal(pointer.step, last);
  assert.deepEqual(pointer.place, place);
  assert.equal(pointer.label, "Farthest apart: 2.5\u00a0mm");
  assert.deepEqual(diagnostics, []);
  await context.close();

  const alone = await openReport(browser, report.file);
  assert.equal(await alone.page.locator("#peer").isVisible(), false);
  await alone.context.close();
}

async function fewerStepsAreSaid(report) {
  const [head, data, tail] = parts(report);
  const reason = "edge g2_1–g3_1 is stretched by 12 % in step 3: no ply survives that";
  const cases = {
    stopped: [{ ended: `stopped: ${reason}` }, `. Stopped: ${reason}`],
    interrupted: [{ ended: "interrupted after step 2 of 30" }, ". Interrupted after step 2 of 30"],
    whole: [{ ended: null }, ""],
  };
  for (const [name, [change, said]] of Object.entries(cases)) {
    const changed = { ...JSON.parse(data), ...change };
    const file = join(scratch, `${name}.html`);
    writeFileSync(file, head + JSON.stringify(changed).replaceAll("<", "\\u003c") + tail);
    const { page, context, diagnostics } = await openReport(browser, file, { width: 390, height: 800 });
    const verdict = await page.locator("#verdict").innerText();
    assert.ok(verdict.endsWith(said), verdict);
    assert.equal(/Stopped|Interrupted/.test(verdict), said !== "", verdict);
    // On a phone the sentence breaks, and nothing is wider than the window.
    assert.ok((await page.evaluate(() => document.documentElement.scrollWidth - innerWidth)) <= 0);
    assert.deepEqual(diagnostics, []);
    await context.close();
  }
}

/** No empty boxes. */
async function saysNoSample(page) {
  const { sample, tolerance } = await pageData(page);
  assert.equal(await page.locator("#sample").isVisible(), sample !== null);
  assert.equal(await page.locator("#tolerance").isVisible(), tolerance.length > 0);
}

/** Integers of one step as the page gets them (block.ts goes back). */
function packed(values) {
  const folded = values.map((value, n) => {
    const change = value - (n > 0 ? values[n - 1] : 0);
    return ((change << 1) ^ (change >> 31)) >>> 0;
  });
  const planes = [0, 8, 16, 24].flatMap((shift) => folded.map((value) => (value >>> shift) & 255));
  const data = deflateSync(Buffer.from(planes)).toString("base64");
  return { steps: 1, count: values.length, components: 1, data };
}

/** A made-up sample of 63 cells, of which one has no end and one is too high, on the page of a sheet. */
async function sampleIsShown(report) {
  const [head, data, tail] = parts(report);
  const page0 = JSON.parse(data);
  const limit = 0.5;
  const cells = Array.from({ length: 63 }, (_, k) => ({
    accepted: k > 1,
    height_mm: k === 0 ? null : k === 1 ? 0.71 : 0.1 + 0.006 * k,
    ratio: k > 1 ? 0.9 : 1.4,
  }));
  const { sheet, fields } = page0.drape;
  const nodes = sheet.landing.length;
  const node = Math.floor(nodes / 3);
  const spread = Array.from({ length: nodes }, (_, k) => (k === node ? 460 : 20 + (k % 200)));
  const field = {
    ...fields[0],
    key: "spread",
    name: "Spread",
    measure: null,
    label: "height that 95 % of the cells keep at the end",
  };
  const named = {
    height_mm: 0.46,
    uv_mm: [50, 25],
    line: "gripper g0_0 to gripper g2_0",
    gripper: "gripper g1_0",
    node,
  };
  const limits = page0.limits.slice(0, 2);
  const sample = {
    accepted: 61,
    ok: true,
    words: "61 of 63 cells with errors keep every limit: 95 % of all cells do, with 61.6 % confidence",
    share: "95 %",
    cells,
    height_limit: limit,
    limits,
    highest: named,
  };
  const kept = (list) => list.map((one) => ({ ...one, ok: true }));
  const changed = {
    ...page0,
    accepted: true,
    limits: kept(page0.limits),
    sample,
    tolerance: ["tolerates errors of 0.28 mm", "tolerates a ply of 0.5 to 2 times its mass"],
    ended: null,
    drape: {
      ...page0.drape,
      fields: [fields[0], field, ...fields.slice(1)],
      sheet: { ...sheet, spread: packed(spread) },
    },
  };
  const file = join(scratch, "sample.html");
  writeFileSync(file, head + JSON.stringify(changed).replaceAll("<", "\\u003c") + tail);
  const { page, context, diagnostics } = await openReport(browser, file);
  assert.match(await page.locator("#verdict").innerText(), /all \d+ limits are kept, in 61 of 63 cells/);
  assert.match(
    await page.locator("#tolerance").innerText(),
    /^Tolerates errors of 0\.28 mm\. Tolerates a ply/,
  );
  const text = await page.locator("#sample").innerText();
  assert.match(
    text,
    /Accepted with errors: 61 of 63 cells .* 95 % of all cells do, with 61\.6 % confidence\./,
  );
  assert.match(text, /One cell has no end/);

  // every cell with a height is in one bar, and those beyond the limit are beyond its line
  const bars = await page.evaluate(() => {
    const number = (element, name) => Number(element.getAttribute(name));
    const line = number(document.querySelector("#sample line.limit"), "x1");
    const rects = [...document.querySelectorAll("#sample rect")];
    return rects.map((rect) => ({
      kept: rect.classList.contains("kept"),
      cells: number(rect, "data-cells"),
      beyond: number(rect, "x") >= line,
    }));
  });
  const sum = (kept, beyond) =>
    bars.filter((bar) => bar.kept === kept && bar.beyond === beyond).reduce((all, bar) => all + bar.cells, 0);
  assert.deepEqual([sum(true, false), sum(true, true), sum(false, false), sum(false, true)], [61, 0, 0, 1]);

  // its colors are about the end, where the highest place is marked and named
  await page.keyboard.press("Home");
  await page.keyboard.press("2");
  assert.equal(await page.evaluate(() => window.plydrape.color), "spread");
  const pointed = () => page.evaluate(() => ({ at: window.plydrape.pointer, step: window.plydrape.step }));
  await eventually(async () => assert.notEqual((await pointed()).at, null));
  const { at, step } = await pointed();
  assert.equal(step, page0.steps.at(-1));
  assert.deepEqual(at.place, await page.evaluate((k) => window.plydrape.node(k), node));
  for (const part of ["0.46", "95 %", named.line, named.gripper])
    assert.ok(at.label.includes(part), at.label);
  await page.keyboard.press("1");
  await eventually(async () => assert.equal((await pointed()).at, null));
  await page.locator("#sample button.link").click();
  assert.deepEqual((await pointed()).at.place, at.place);
  assert.deepEqual(diagnostics, []);
  await context.close();
}

/** Index of the step nearest to a number. */
function indexOf(data, step) {
  const away = data.steps.map((number) => Math.abs(number - step));
  return away.indexOf(Math.min(...away));
}

async function opensAtWorst(page) {
  const data = await pageData(page);
  const { step, pointer } = await page.evaluate(() => ({
    step: window.plydrape.step,
    pointer: window.plydrape.pointer,
  }));
  const known = data.limits.filter((limit) => limit.step !== null);
  const atEnd = known.filter((limit) => data.steps[indexOf(data, limit.step)] === data.steps.at(-1));
  const failed = known.filter(({ ok }) => !ok);
  const failedAtEnd = atEnd.filter(({ ok }) => !ok);
  const kept = atEnd.filter(({ place, motion }) => place !== null && !motion);
  const from = [failedAtEnd, failed, kept].find((some) => some.length > 0);
  if (from === undefined) return;
  const most = Math.max(...from.map(({ ratio }) => ratio));
  const worst = from.find(({ ratio }) => ratio === most);
  assert.equal(step, data.steps[indexOf(data, worst.step)]);
  if (worst.place === null) return;
  assert.deepEqual(pointer.place, worst.place);
  assert.ok(pointer.label.toLowerCase().startsWith(worst.name), pointer.label);
  // the place is in the picture
  const [x, y] = await page.evaluate((at) => window.plydrape.onScreen(at), worst.place);
  const { width, height } = await page.locator("#view").boundingBox();
  assert.ok(x > 0 && y > 0 && x < width && y < height, `${x}, ${y} in ${width} × ${height}`);
  // there is a way to the start, and back
  if (data.steps.length === 1) return;
  await page.locator("#start").click();
  assert.equal(await page.evaluate(() => window.plydrape.step), data.steps[0]);
  await page.locator("#worst").click();
  assert.deepEqual(await page.evaluate(() => window.plydrape.pointer.place), worst.place);
  await page.locator("#worst").blur();
}

async function unitsAgree(page) {
  const { limits, drape, also } = await pageData(page);
  for (const limit of limits) {
    const measure = drape.measures.find(({ key }) => key === limit.key);
    if (measure !== undefined)
      assert.deepEqual([measure.unit, measure.limit], [limit.unit, limit.limit], limit.name);
  }
  const lists = [drape, also].flatMap((one) => [one?.measures ?? [], one?.grippers.readings ?? []]);
  const units = new Set([limits, ...lists].flat().map(({ unit }) => unit));
  for (const unit of units) assert.ok(!/deg|^m$|^µm$|^kN$|^ms$/.test(unit), `${unit} is no unit of the page`);
}

/** Along a line of nodes the section has their places and heights, and the mold where they touch it. */
async function sectionShows(report, page) {
  const data = await pageData(page);
  const sheet = data.drape.sheet === null ? null : resultOf(report, data).sheet;
  const last = data.drape.drawn.at(-1);
  const button = page.locator("#section-open");
  await page.keyboard.press("Escape");
  if (sheet === null && !hasSurface(data)) {
    assert.ok(!(await button.isVisible()), "there is no surface to cut");
    return;
  }
  await page.evaluate((step) => window.plydrape.goto(step), last);
  await page.evaluate((model) => (window.plydrape.model = model), data.drape.model);
  await button.click();
  const points = () => page.evaluate(() => window.plydrape.sectionPoints());
  const first = await points();
  assert.ok(first.length > 2);
  const line = () => page.evaluate(() => window.plydrape.section);
  const { along, at } = await line();
  assert.equal(along, "u");
  assert.ok(
    (await page.locator("#section-said").innerText()).includes(
      `v = ${Number(at.toPrecision(4))}`.replace("-", "−"),
    ),
  );
  assert.equal(await page.locator("#section .uplot").count(), 2);
  // a smooth mold as it is drawn is off by less than this where the ply touches it
  for (const { place, height, mold } of first) {
    if (mold === null || height === null || Math.abs(height) > 0.02) continue;
    assert.ok(Math.abs(1e3 * place[2] - mold) < 0.6, `${1e3 * place[2]} mm over a mold at ${mold} mm`);
  }
  if (sheet !== null) {
    const { nodes, heights } = sheet.states[last];
    // every point of a line through nodes is one of them
    const near = (place) => {
      const away = nodes.map((node) => Math.hypot(...node.map((c, n) => c - place[n])));
      const least = Math.min(...away);
      return [away.indexOf(least), least];
    };
    const number = Math.floor(nodes.length / 2);
    const [middle] = await page.evaluate((node) => window.plydrape.fabric(node), number);
    await page.locator("label:has(#section-v)").click();
    await page.evaluate((u) => (window.plydrape.section = { along: "v", at: u }), middle);
    const second = await points();
    const found = second
      .map(({ place, height }) => [...near(place), height])
      .filter(([, away]) => away < 2e-6);
    assert.ok(found.length > second.length / 2, `${found.length} of ${second.length} points are nodes`);
    for (const [node, , height] of found) {
      if (height !== null)
        assert.ok(Math.abs(height - 1e3 * heights[node]) < 2e-3, `node ${node}: ${height} mm`);
    }
  }
  // the slider moves the line, and so does a click on the ply
  await page.locator("#section-at").evaluate((slider) => {
    slider.value = String(0.25 * Number(slider.max));
    slider.dispatchEvent(new Event("input", { bubbles: true }));
  });
  const moved = await line();
  assert.notDeepEqual(moved, { along, at });
  const target = (await points())[2];
  await page.keyboard.press("t");
  await frames(page, 3);
  await page.locator("label:has(#section-u)").click();
  await page.evaluate(() => (window.plydrape.section = { along: "u", at: -1e6 }));
  assert.deepEqual(await points(), []);
  const [x, y] = await page.evaluate((place) => window.plydrape.onScreen(place), target.place);
  await page.locator("#picture").click({ position: { x, y } });
  assert.ok((await points()).length > 0, "the line is where the click was");
  await page.keyboard.press("i");
  await page.keyboard.press("x");
  assert.equal(await line(), null);
}

/** How many pixels of the picture have a color of the style sheet. */
async function pixelsOf(page, variable) {
  await frames(page, 2);
  const shot = (await page.locator("#view").screenshot()).toString("base64");
  return page.evaluate(
    async ([data, name]) => {
      const image = new Image();
      image.src = `data:image/png;base64,${data}`;
      await image.decode();
      const canvas = new OffscreenCanvas(image.width, image.height);
      const pen = canvas.getContext("2d");
      pen.drawImage(image, 0, 0);
      const { data: bytes } = pen.getImageData(0, 0, image.width, image.height);
      const hex = getComputedStyle(document.documentElement).getPropertyValue(name).trim();
      const wanted = [1, 3, 5].map((k) => parseInt(hex.slice(k, k + 2), 16));
      let count = 0;
      for (let k = 0; k < bytes.length; k += 4) {
        if (wanted.every((c, n) => Math.abs(c - bytes[k + n]) < 14)) count++;
      }
      return count;
    },
    [shot, variable],
  );
}

async function pathsShow(report) {
  const { page, context, diagnostics } = await openReport(browser, report.file);
  await page.keyboard.press("Escape");
  for (const id of ["#show-forces", "#show-diagonals", "#show-mold"]) {
    if (await page.locator(id).isVisible()) await page.locator(id).uncheck();
  }
  assert.equal(await pixelsOf(page, "--path"), 0);
  await page.keyboard.press("g");
  assert.ok(await page.locator("#show-paths").isChecked());
  await page.keyboard.press("End");
  await page.keyboard.press("i");
  const passed = await pixelsOf(page, "--path");
  assert.ok(passed > 100, `${passed} pixels of paths that are passed`);
  await page.keyboard.press("Home");
  const atStart = await pixelsOf(page, "--path");
  assert.ok(atStart < 0.1 * passed, `${atStart} of ${passed} pixels are passed at the start`);
  assert.deepEqual(diagnostics, []);
  await context.close();
}

async function addressLeads(report) {
  const { page, context } = await openReport(browser, report.file);
  const { steps } = await pageData(page);
  const step = steps[Math.floor(steps.length / 2)];
  const color = (await page.evaluate(() => window.plydrape.colors)).at(-1);
  const address = `${page.url()}#step=${step}&color=${color}`;
  await page.goto("about:blank");
  await page.goto(address);
  await page.evaluate(() => window.plydrape.ready);
  const now = () => page.evaluate(() => [window.plydrape.step, window.plydrape.color]);
  assert.deepEqual(await now(), [step, color]);
  await page.evaluate((first) => (location.hash = `step=${first}`), steps[0]);
  await eventually(async () => assert.deepEqual(await now(), [steps[0], color]));
  await context.close();
}

async function scalesChange(report) {
  const { page, context } = await openReport(browser, report.file);
  const legend = () => page.evaluate(() => window.plydrape.legend());
  const { drape } = await pageData(page);
  const { sheet } = drape;
  const color = sheet === null ? "gap" : "over_mold";
  if (!drape.fields.some(({ key }) => key === color)) return context.close();
  await page.evaluate((key) => (window.plydrape.color = key), color);
  assert.deepEqual(await legend().then(({ scale, low, high }) => [scale, low, high]), ["orders", 0.1, 10]);
  await page.keyboard.press("r");
  const own = await legend();
  assert.equal(own.scale, "orders");
  assert.ok(Math.abs(own.high / own.low / 100 - 1) < 1e-9 || own.low === 1e-3, "two orders of size");
  await page.keyboard.press("o");
  assert.ok(!(await page.locator("#orders").isChecked()));
  const even = await legend();
  assert.equal(even.scale, "even");
  // the largest height of the step is the upper end of both
  const data = await pageData(page);
  if (sheet !== null) {
    const last = drape.drawn.at(-1);
    await page.evaluate((step) => window.plydrape.goto(step), last);
    const { heights } = resultOf(report, data).sheet.states[last];
    const most = 1e3 * Math.max(...heights.map((height) => (Number.isFinite(height) ? height : -Infinity)));
    const ends = await legend();
    assert.ok(Math.abs(ends.high - most) < 2e-3, `${ends.high} mm is not ${most} mm`);
  }
  assert.ok(even.high <= own.high + 1e-9 && own.high <= Math.max(even.high, -even.low, 2e-3) + 1e-9);
  await page.keyboard.press("r");
  const all = await legend();
  assert.ok(all.scale === "even" && all.low <= even.low && all.high >= even.high && all.high > 1);
  await page.locator("#orders").check();
  assert.equal((await legend()).high, 10);
  await page.evaluate(() => (window.plydrape.color = "shear"));
  assert.ok(!(await page.locator("#orders").isVisible()), "angles have an even scale");
  await context.close();
}

async function surfaceIsRead(report) {
  const { page, context } = await openReport(browser, report.file);
  const { grid, divisions, pitch } = catenariesOf(await pageData(page));
  await page.evaluate(() => {
    window.plydrape.model = "catenaries";
    window.plydrape.color = "height";
  });
  await page.keyboard.press("Escape");
  await page.keyboard.press("t");
  await frames(page, 3);
  const columns = (grid[0] - 1) * divisions + 1;
  const middle = Math.floor(divisions / 2);
  const vertex = middle * columns + middle;
  const place = await page.evaluate((k) => window.plydrape.vertex(k), vertex);
  const text = await hoverOver(page, place);
  const uv = pitch.map((side) => Number(((side * middle) / divisions).toPrecision(4)));
  assert.ok(text.startsWith(`u ${uv[0]}, v ${uv[1]}`), text);
  const colored = await page.locator("#view .hover dd.colored").innerText();
  assert.ok(Math.abs(parseFloat(colored.replace("−", "-")) - 1e3 * place[2]) < 2e-2, colored);
  await context.close();
}

async function pagesCompare(first, second) {
  const { page, context, diagnostics } = await openReport(browser, first.file, { width: 1440, height: 900 });
  const a = await pageData(page);
  const b = JSON.parse(parts(second)[1]);
  const before = await pictureOf(page);
  await page.locator("#other-file").setInputFiles(second.file);
  await page.locator("#view-b").waitFor();
  assert.ok(await page.locator("#compare").isVisible());
  // the same share of both motions
  const shares = ({ times }) => times.map((t) => (t - times[0]) / (times.at(-1) - times[0]));
  const [own, others] = [shares(a), shares(b)];
  for (const k of [0, Math.floor(a.steps.length / 3), a.steps.length - 1]) {
    await page.evaluate((step) => window.plydrape.goto(step), a.steps[k]);
    const shown = await page.evaluate(() => window.plydrape.otherStep);
    const away = others.map((share) => Math.abs(share - own[k]));
    assert.equal(shown, b.steps[away.indexOf(Math.min(...away))]);
  }
  await page.locator("#compare-link").selectOption("step");
  const number = a.steps[Math.min(2, a.steps.length - 1)];
  await page.evaluate((step) => window.plydrape.goto(step), number);
  assert.equal(await page.evaluate(() => window.plydrape.otherStep), b.steps[indexOf(b, number)]);
  // every limit that both have is in the table with its difference
  const rows = await page
    .locator("#comparison tbody tr")
    .evaluateAll((all) => all.map((tr) => [...tr.children].map((cell) => cell.textContent)));
  const told = new Map(rows.map(([name, ...cells]) => [name, cells]));
  for (const limit of a.limits) {
    const same = b.limits.find(({ name, unit }) => name === limit.name && unit === limit.unit);
    assert.equal(told.has(limit.name), same !== undefined, limit.name);
    if (same === undefined) continue;
    const more = same.value - limit.value;
    const [, , difference] = told.get(limit.name);
    if (Math.abs(more) < 1e-3 * Math.max(Math.abs(limit.value), 1)) continue;
    assert.ok(
      Math.abs(parseFloat(difference.replace("−", "-").replace("+", "")) / more - 1) < 1e-3,
      difference,
    );
    assert.ok(difference.endsWith(more > 0 === limit.least ? "better" : "worse"), difference);
  }
  // each alone, by a key, and both from the same side
  const seen = async () => [
    await page.locator("#view").isVisible(),
    await page.locator("#view-b").isVisible(),
  ];
  assert.deepEqual(await seen(), [true, true]);
  await page.keyboard.press("a");
  assert.deepEqual(await seen(), [true, false]);
  await page.keyboard.press("a");
  assert.deepEqual(await seen(), [false, true]);
  await page.locator("#compare-shown label").first().click();
  const both = await page.locator("#view-b").screenshot();
  await page.keyboard.press("t");
  await frames(page, 3);
  assert.notDeepEqual(await page.locator("#view-b").screenshot(), both, "B is seen from above too");
  // charts have a second line
  const theirs = (b.also?.model === a.drape.model ? b.also : b.drape).measures;
  const measure = a.drape.measures.find(
    ({ key, unit, values }) =>
      values.some((v) => v !== null) && theirs.some((other) => other.key === key && other.unit === unit),
  );
  if (measure !== undefined) {
    const chart = page.locator(`.charts:not([hidden]) .chart[data-measure="${measure.key}"]`);
    assert.match(await chart.locator(".chart-where").innerText(), /^B /);
  }
  assert.ok((await page.evaluate(() => document.documentElement.scrollWidth - innerWidth)) <= 0);
  // what cannot be compared is said, and the end of it is as before
  await page
    .locator("#other-file")
    .setInputFiles({ name: "some.html", mimeType: "text/html", buffer: Buffer.from("<p>no") });
  await page.locator("#told").waitFor();
  assert.match(await page.locator("#told").innerText(), /some\.html cannot be compared: it is neither/);
  await page.locator("#compare-close").click();
  assert.ok(!(await page.locator("#comparison").isVisible()));
  assert.equal(await page.locator("#view-b").count(), 0);
  await page.reload();
  await page.evaluate(() => window.plydrape.ready);
  assert.deepEqual(await pictureOf(page), before);
  assert.deepEqual(diagnostics, []);
  await context.close();
}

async function numbersCompare(report) {
  const file = join(report.folder, "result.json");
  const { page, context, diagnostics } = await openReport(browser, report.file);
  const data = await pageData(page);
  await page.locator("#other-file").setInputFiles(file);
  await page.locator("#comparison").waitFor();
  assert.match(await page.locator("#told").innerText(), /open its report\.html/);
  assert.equal(await page.locator("#view-b").count(), 0);
  // a result does not differ from its own page
  const differences = await page.locator("#comparison tbody tr td:last-child").allTextContents();
  assert.equal(differences.length, data.limits.length + 2);
  for (const text of differences.slice(2)) assert.equal(text, "–");
  assert.deepEqual(diagnostics, []);
  await context.close();
}

async function saves(report) {
  const { page, context, diagnostics } = await openReport(browser, report.file);
  const file = async (id) => {
    const waiting = page.waitForEvent("download", { timeout: 60_000 });
    await page.locator(id).click();
    const download = await waiting;
    return [download.suggestedFilename(), readFileSync(await download.path())];
  };
  const [picture, png] = await file("#save-png");
  assert.match(picture, /^[a-z0-9_]+_step_\d+\.png$/);
  assert.deepEqual([...png.subarray(1, 4)].map((byte) => String.fromCharCode(byte)).join(""), "PNG");
  const view = await page.locator("#view").boundingBox();
  const [width, height] = [png.readUInt32BE(16), png.readUInt32BE(20)];
  assert.ok(width >= 2 * Math.floor(view.width) && height > 2 * view.height, `${width} × ${height}`);
  // scale, title and verdict are in it: outside of the picture there is more than one color
  const colors = await page.evaluate(async (bytes) => {
    const image = await createImageBitmap(new Blob([Uint8Array.from(atob(bytes), (c) => c.charCodeAt(0))]));
    const pen = new OffscreenCanvas(image.width, image.height).getContext("2d", {
      willReadFrequently: true,
    });
    pen.drawImage(image, 0, 0);
    const of = (x, y, w, h) => {
      const data = new Uint32Array(pen.getImageData(x, y, w, h).data.buffer);
      return new Set(data).size;
    };
    return { title: of(0, 0, 900, 80), scale: of(image.width - 230, 100, 26, image.height - 200) };
  }, png.toString("base64"));
  assert.ok(colors.title > 4 && colors.scale > 40, JSON.stringify(colors));

  const before = await page.evaluate(() => window.plydrape.step);
  await page.locator("#speed").selectOption("4");
  const [name, video] = await file("#save-video");
  assert.match(name, /^[a-z0-9_]+\.webm$/);
  assert.deepEqual([...video.subarray(0, 4)], [0x1a, 0x45, 0xdf, 0xa3], "it begins as Matroska does");
  assert.ok(video.length > 5000, `${video.length} bytes`);
  assert.equal(await page.evaluate(() => window.plydrape.step), before, "and the page is where it was");
  assert.equal(await page.locator("#save-video").innerText(), "Video");
  // a browser can play it, and its frames are not all alike; the page itself allows no media
  const cinema = await context.newPage();
  const moves = await cinema.evaluate(async (bytes) => {
    const film = document.createElement("video");
    film.muted = true;
    const data = Uint8Array.from(atob(bytes), (c) => c.charCodeAt(0));
    film.src = URL.createObjectURL(new Blob([data], { type: "video/webm" }));
    const pen = new OffscreenCanvas(64, 48).getContext("2d", { willReadFrequently: true });
    film.playbackRate = 0.25;
    await film.play();
    let first = null;
    let most = 0;
    while (!film.ended) {
      pen.drawImage(film, 0, 0, 64, 48);
      const { data: now } = pen.getImageData(0, 0, 64, 48);
      first ??= now;
      most = Math.max(most, now.reduce((sum, c, k) => sum + Math.abs(c - first[k]), 0) / now.length);
      await new Promise((again) => setTimeout(again, 50));
    }
    return most;
  }, video.toString("base64"));
  assert.ok(moves > 2, `its pictures differ by ${moves} of 255`);
  assert.deepEqual(diagnostics, []);
  await context.close();
}

async function saysNoRecorder(report) {
  const { page, context, diagnostics } = await openReport(browser, report.file);
  await page.evaluate(() => delete window.MediaRecorder);
  await page.locator("#save-video").click();
  assert.match(await page.locator("#told").innerText(), /cannot record a video.*PNG/);
  await page.locator("#told-close").click();
  assert.ok(!(await page.locator("#told").isVisible()));
  assert.deepEqual(diagnostics, []);
  await context.close();
}

async function fitsPhone(report) {
  for (const [width, height] of [
    [360, 740],
    [390, 844],
  ]) {
    const { page, context, diagnostics } = await openReport(browser, report.file, {
      width,
      height,
      touch: true,
    });
    const narrow = (state) => fitsScreen(page, width, state);
    await narrow("opened");
    // fingers meet every control
    const small = await page.evaluate(() =>
      [...document.querySelectorAll(".stage button:not(.mark), .segments > *, .checks label, .track input")]
        .filter((e) => e.getBoundingClientRect().height > 0 && e.getBoundingClientRect().height < 32)
        .map((e) => e.outerHTML),
    );
    assert.deepEqual(small, []);
    for (const id of ["#slider", "#picture", "#legend", "#play"]) {
      const box = await page.locator(id).boundingBox();
      assert.ok(box.y + box.height <= height, `${id} is on the first screen`);
    }
    // a tap on a node reads it, and stays; the next one elsewhere takes it away
    const data = await pageData(page);
    await page.evaluate(() => window.plydrape.goto(window.plydrape.steps[0]));
    await page.evaluate((at) => window.plydrape.goto(at), data.steps.at(-1));
    await frames(page, 3);
    const place = await page.evaluate(() => window.plydrape.node(0) ?? window.plydrape.vertex(0));
    const [x, y] = await page.evaluate((at) => window.plydrape.onScreen(at), place);
    const view = await page.locator("#view").boundingBox();
    await page.touchscreen.tap(view.x + x, view.y + y);
    await frames(page, 3);
    assert.ok(await page.locator("#view .hover").isVisible());
    const plate = await page.locator("#view .hover").boundingBox();
    assert.ok(plate.x >= 0 && plate.x + plate.width <= width, "the plate is on the screen");
    await page.touchscreen.tap(view.x + 3, view.y + view.height - 3);
    await frames(page, 3);
    assert.ok(!(await page.locator("#view .hover").isVisible()));
    // the slider goes by touch
    const slider = await page.locator("#slider").boundingBox();
    await page.touchscreen.tap(slider.x + slider.width / 2, slider.y + slider.height / 2);
    assert.notEqual(await page.evaluate(() => window.plydrape.step), data.steps.at(-1));
    await page.locator("#section-open").tap();
    await narrow("section");
    await page.locator("#other-file").setInputFiles(report.file);
    await page.locator("#view-b").waitFor();
    await narrow("comparison");
    await page.locator("#compare-shown label").first().tap();
    await narrow("both");
    assert.deepEqual(diagnostics, []);
    await context.close();
  }
}

async function damagedDataIsSaid(report) {
  const [head, data, tail] = parts(report);
  const damaged = {
    cut: [data.slice(0, data.length / 2), /cut off or damaged/],
    newer: [data.replace(/"version"\s*:\s*\d+/, '"version":99'), /version 99/],
    short: [
      data.replace(/("positions"\s*:\s*\{[^}]*"data"\s*:\s*")[^"]{40}/, "$1"),
      /grippers of its geometry/,
    ],
    foreign: ["[]", /not that of a results page/],
  };
  for (const [name, [broken, reason]] of Object.entries(damaged)) {
    assert.notEqual(broken, data);
    const file = join(scratch, `${name}.html`);
    writeFileSync(file, head + broken + tail);
    const { page, context, diagnostics } = await openReport(browser, file, { wait: false });
    await page.locator("#failure").waitFor({ state: "visible", timeout: 10_000 });
    const sentence = await page.locator("#failure").innerText();
    assert.match(sentence, reason);
    assert.match(sentence, /plydrape report/);
    assert.ok(!(await page.locator("#page").isVisible()));
    assert.deepEqual(diagnostics, []);
    await context.close();
  }
}

/** The page of `plydrape check --html`: what the scene says, with the places of the cups, and nothing that judges. */
async function sceneIsShown() {
  const root = join(import.meta.dirname, "..", "..");
  const program = process.env.PLYDRAPE ?? join(root, "target", "checked", "plydrape");
  const scene = join(root, "examples", "17_robot", "scene.toml");
  const folder = join(scratch, "check");
  execFileSync(program, ["check", "--html", scene, "-o", folder], { stdio: "pipe" });
  const { page, context, diagnostics } = await openReport(browser, join(folder, "check.html"));
  assert.match(await page.locator("#verdict").innerText(), /^Not draped yet/);
  for (const id of ["limits", "courses", "timeline", "sample", "worst"])
    assert.ok(!(await page.locator(`#${id}`).isVisible()), id);
  assert.match(await page.locator("#facts").innerText(), /upright crosses: where the cups shall end/);
  const shown = await page.locator("#view").screenshot();
  await page.locator("#show-mold").uncheck();
  await page.waitForTimeout(200);
  assert.notDeepEqual(await page.locator("#view").screenshot(), shown);
  assert.deepEqual(diagnostics, []);
  await context.close();
}

async function worksWithoutWebgl(report) {
  const plain = await startBrowser({ webgl: false });
  const { page, diagnostics } = await openReport(plain, report.file);
  assert.equal(await page.evaluate(() => window.plydrape.webgl), false);
  assert.ok(await page.locator("#no-webgl").isVisible());
  assert.match(await page.locator("#no-webgl").innerText(), /cannot draw in 3D/);
  assert.ok(await page.locator("#limits").isVisible());
  assert.ok((await page.locator(".chart").count()) > 0);
  const steps = await page.evaluate(() => window.plydrape.steps);
  await page.keyboard.press("Home");
  assert.equal(await page.evaluate(() => window.plydrape.step), steps[0]);
  assert.deepEqual(diagnostics, []);
  await plain.close();
}
