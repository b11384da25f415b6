// The live page in a real browser, opened from disk without a network: its solver says what the program on this machine says.
//
// PLYDRAPE names the program, target/checked/plydrape unless set (scripts/test builds it). Without it or without a browser
// the tests are skipped, loudly; where CI is set that is an error.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { after, before, describe, test } from "node:test";
import { CHROMIUM, openReport, startBrowser } from "../browser.mjs";
import { fitsScreen } from "./phone.mjs";

const ROOT = resolve(import.meta.dirname, "../..");
const PAGE = join(ROOT, "docs", "live.html");
const PROGRAM = process.env.PLYDRAPE ?? join(ROOT, "target", "checked", "plydrape");
const missing =
  CHROMIUM === ""
    ? "there is no Chromium (install it or set CHROMIUM)"
    : existsSync(PROGRAM)
      ? null
      : `${PROGRAM} is not there`;
if (missing !== null) {
  if (process.env.CI) throw new Error(`the live page cannot be tested: ${missing}`);
  console.error(`\n*** THE LIVE PAGE IS NOT TESTED: ${missing} ***\n`);
}

/**
 * Relative difference of a force in the page from the same force by the program. Functions such as exp and atan are not the same
 * ones in WebAssembly; 2e-11 is the largest that was met.
 */
const FORCES = 1e-9;

let browser;
let scratch;

describe("live page", { skip: missing ?? false, concurrency: 1 }, () => {
  before(async () => {
    browser = await startBrowser();
    scratch = mkdtempSync(join(tmpdir(), "plydrape-live-"));
  });
  after(async () => {
    await browser?.close();
    rmSync(scratch, { recursive: true, force: true });
  });
  test("it opens with the start of the paper's example", opensAtTheStart);
  test("a dragged gripper has the forces that the program finds", draggedForcesAreNative);
  test("on every mold, with every rule, a ply that touches has them too", touchingForcesAreNative);
  test("a changed material is in the saved scene", materialIsSaved);
  test("where no ply can follow the gripper stays, and a sentence says why", overstretchIsSaid);
  test("an address brings back what was set, and a broken one the start", addressesLead);
  test("an answer is drawn in the frame in which it was asked for", drawnInTheSameFrame);
  test(
    "a slow picture is coarser while it moves, hits the gripper all the same, and is fine again at rest",
    finerAtRest,
  );
  test(
    "numbers beside the picture are those of the last answer, and a drag moves nothing but the ply",
    numbersFollow,
  );
  test("on a phone the picture stays in view while the mold is bent", pictureStays);
  test("on a phone nothing is wider than the screen, and a finger drags", fingerDrags);
});

async function open({ hash = "", ...options } = {}) {
  const size = { width: 1000, height: 700 };
  const opened = await openReport(browser, PAGE, { ...size, ...options, hash: `#${hash}`, wait: false });
  await opened.page.evaluate(() => window.live.ready);
  return opened;
}

/** Where a gripper is on the screen. */
async function gripperAt(page, gripper) {
  const view = await page.locator("#view").boundingBox();
  const [x, y] = await page.evaluate((k) => window.live.onScreen(window.live.setup().grippers[k]), gripper);
  return [view.x + x, view.y + y];
}

/** Drags a gripper by this many pixels, in some moves. */
async function drag(page, gripper, [dx, dy], moves = 8) {
  const [x, y] = await gripperAt(page, gripper);
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + dx, y + dy, { steps: moves });
  await page.mouse.up();
  await settled(page);
}

/** Waits until all that was asked for is drawn. */
async function settled(page) {
  await page.evaluate(async () => {
    await window.live.idle();
    await new Promise(requestAnimationFrame);
    await window.live.idle();
  });
}

/** Saves the scene of the page as its reader would, and drapes it with the program. */
async function drapedByProgram(page, name) {
  const [download] = await Promise.all([page.waitForEvent("download"), page.locator("#save-scene").click()]);
  assert.equal(download.suggestedFilename(), "live.toml");
  const scene = join(scratch, `${name}.toml`);
  await download.saveAs(scene);
  execFileSync(PROGRAM, ["check", scene], { stdio: "pipe" });
  const folder = join(scratch, name);
  try {
    execFileSync(PROGRAM, ["simulate", scene, "-o", folder, "--quiet"], { stdio: "pipe" });
  } catch (error) {
    // a limit is exceeded
    assert.equal(error.status, 1, String(error.stderr));
  }
  const { steps } = JSON.parse(readFileSync(join(folder, "result.json"), "utf8"));
  return { scene: readFileSync(scene, "utf8"), step: steps[0] };
}

/** Compares what the page shows with the program; returns the largest relative difference of a force. */
async function agrees(page, name) {
  const { step, scene } = await drapedByProgram(page, name);
  const { catenaries, status, page: data } = await page.evaluate(() => window.live.hanging());
  assert.deepEqual(status, [step.solver.status, step.solver.contact]);
  const forces = catenaries.flatMap(({ forces }, n) => forces.map((force) => [n, force]));
  const native = step.spans.catenary.map((n, k) => [n, step.spans.H_N[k]]);
  assert.deepEqual(
    forces.map(([n, force]) => [n, force === null]),
    native.map(([n, force]) => [n, force === null]),
    name,
  );
  let most = 0;
  forces.forEach(([n, force], k) => {
    if (force === null) return;
    const away = Math.abs(force - native[k][1]) / Math.abs(native[k][1]);
    assert.ok(away <= FORCES, `${name}, catenary ${n}: ${force} N, the program ${native[k][1]} N`);
    most = Math.max(most, away);
  });
  for (const { key, values } of data.drape.measures) {
    const expected = step.measures[key]?.value;
    if (expected == null || values[0] === null || key === "contact_share") continue;
    const scale = Math.abs(expected) > 0 ? values[0] / expected : 1;
    // units of the page are those of the record, or hundredths of it
    const off = Math.min(Math.abs(scale - 1), Math.abs(scale / 100 - 1));
    assert.ok(
      off <= 1e-6 || Math.abs(expected) < 1e-6,
      `${name}, ${key}: ${values[0]}, the program ${expected}`,
    );
  }
  return { most, scene, touching: step.contact !== undefined && catenaries.some(({ touches }) => touches) };
}

async function opensAtTheStart() {
  const { page, context, diagnostics, requests } = await open();
  const start = readFileSync(join(ROOT, "crates/plydrape-live/tests/start.toml"), "utf8");
  assert.equal(await page.evaluate(() => window.live.scene()), start);
  assert.match(await page.locator("#verdict").textContent(), /All \d+ limits kept by the catenaries/);
  assert.ok(await page.locator("#live-said").isHidden());
  assert.deepEqual(diagnostics, []);
  assert.ok(
    requests.every((url) => /^(file|data|blob):/.test(url)),
    requests.join(),
  );
  await context.close();
}

async function draggedForcesAreNative() {
  const { page, context, diagnostics } = await open();
  const before = await page.evaluate(() => window.live.setup().grippers);
  const picture = await page.locator("#view").screenshot();
  await drag(page, 2, [-12, -40]);
  const now = await page.evaluate(() => window.live.setup().grippers);
  assert.ok(
    now[2].some((c, n) => Math.abs(c - before[2][n]) > 0.005),
    "the gripper has moved",
  );
  assert.deepEqual(
    now.filter((_, k) => k !== 2),
    before.filter((_, k) => k !== 2),
  );
  assert.ok(!picture.equals(await page.locator("#view").screenshot()), "the ply has followed");
  const { most } = await agrees(page, "dragged");
  const solves = await page.evaluate(() => [...window.live.solves].sort((a, b) => a - b));
  const median = solves[Math.floor(solves.length / 2)];
  console.log(`forces differ by ${most.toExponential(1)} at most; an answer takes ${median.toFixed(1)} ms`);
  // thirty answers a second leave 33 ms for one
  assert.ok(median < 33, `${median} ms`);

  // level with Shift, up and down by the choice below the picture
  await page.keyboard.down("Shift");
  await drag(page, 5, [-6, 3]);
  await page.keyboard.up("Shift");
  const level = await page.evaluate(() => window.live.setup().grippers[5]);
  assert.equal(level[2], before[5][2]);
  assert.notDeepEqual(level, before[5]);
  await page.locator('#way label:has([value="upright"])').click();
  await drag(page, 0, [4, 12]);
  const upright = await page.evaluate(() => window.live.setup().grippers[0]);
  assert.deepEqual(upright.slice(0, 2), before[0].slice(0, 2));
  assert.ok(upright[2] < before[0][2]);
  await agrees(page, "level");
  // beside the grippers the view is turned, and nothing else
  const scene = await page.evaluate(() => window.live.scene());
  const view = await page.locator("#view").boundingBox();
  await page.mouse.move(view.x + 30, view.y + 30);
  await page.mouse.down();
  await page.mouse.move(view.x + 90, view.y + 60, { steps: 3 });
  await page.mouse.up();
  assert.equal(await page.evaluate(() => window.live.scene()), scene);
  assert.deepEqual(diagnostics, []);
  await context.close();
}

/** Setups whose ply touches its mold, as the ends of addresses. */
const TOUCHING = {
  plane: "height=67&tilt=1",
  cylinder: "kind=cylinder&height=69",
  dome: "kind=sphere&height=69&slopes=moment-balance",
  saddle: "kind=saddle&height=50&radius=500&slopes=moment-balance",
};

async function touchingForcesAreNative() {
  const { page, context, diagnostics } = await open();
  let largest = 0;
  for (const [name, hash] of Object.entries(TOUCHING)) {
    await page.evaluate((to) => (location.hash = to), hash);
    await page.waitForFunction((to) => location.hash === `#${to}`, hash);
    await settled(page);
    const said = page.locator("#live-said");
    assert.ok(await said.isHidden(), `${name}: ${await said.textContent()}`);
    const { most, touching } = await agrees(page, name);
    assert.ok(touching, `${name} touches`);
    largest = Math.max(largest, most);
  }
  console.log(`of plies that touch they differ by ${largest.toExponential(1)} at most`);
  assert.deepEqual(diagnostics, []);
  await context.close();
}

async function materialIsSaved() {
  const { page, context, diagnostics } = await open();
  await page.locator("#material").selectOption("cao2008_plain");
  await page.locator("#mass").fill("300");
  await page.locator("#rigidity").fill("100");
  await settled(page);
  const { scene } = await agrees(page, "material");
  assert.match(scene, /mass = "1486 g\/m\^2"/);
  assert.match(scene, /\[ply\.material\.shear_curve\]/);
  assert.deepEqual(diagnostics, []);
  await context.close();
}

async function overstretchIsSaid() {
  const { page, context, diagnostics } = await open();
  const [x, y] = await gripperAt(page, 3);
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + 150, y, { steps: 6 });
  await settled(page);
  const said = page.locator("#live-said");
  assert.match(await said.textContent(), /Gripper g3_0 goes no farther, because the ply to g2_0.* is taut/);
  const [from, to] = await page.evaluate(() => window.live.setup().grippers.slice(2, 4));
  const apart = Math.hypot(...from.map((c, n) => c - to[n]));
  assert.ok(apart > 0.0999 && apart <= 0.1, `the gripper goes as far as the ply does: ${apart} m`);
  await page.mouse.up();
  await settled(page);
  // raised through the ply the mold is refused too, and let go it comes back
  await page.locator("#height").fill("400");
  await settled(page);
  const text = await page.locator("body").innerText();
  assert.doesNotMatch(text, /NaN|Infinity|undefined|null/);
  await agrees(page, "stretched");
  assert.deepEqual(diagnostics, []);
  await context.close();
}

async function addressesLead() {
  const { page, context } = await open();
  await drag(page, 6, [-5, -25]);
  await page.locator('#kind label:has([value="sphere"])').click();
  await settled(page);
  const scene = await page.evaluate(() => window.live.scene());
  const hash = new URL(page.url()).hash.slice(1);
  await context.close();
  const again = await open({ hash });
  assert.equal(await again.page.evaluate(() => window.live.scene()), scene);
  await again.page.locator("#again").click();
  await settled(again.page);
  const start = await again.page.evaluate(() => window.live.scene());
  assert.equal(new URL(again.page.url()).hash, "");
  await again.context.close();
  for (const broken of [
    "g=1_2_3&kind=moon&mass=NaN&height=1e99x",
    "g=" + Array(24).fill("nonsense").join("_"),
  ]) {
    const { page, context, diagnostics } = await open({ hash: broken });
    assert.equal(await page.evaluate(() => window.live.scene()), start);
    assert.deepEqual(diagnostics, []);
    await context.close();
  }
  // grippers that no ply joins: said, and the start is shown
  const far = await open({ hash: "g=" + Array.from({ length: 24 }, (_, k) => k * 100_000).join("_") });
  assert.equal(await far.page.evaluate(() => window.live.scene()), start);
  assert.match(
    await far.page.locator("#live-said").textContent(),
    /mm apart; the ply between them is 100\.00 mm/,
  );
  await far.context.close();
}

async function fingerDrags() {
  const size = { width: 390, height: 844 };
  const { page, context, diagnostics } = await open({ ...size, touch: true });
  await fitsScreen(page, size.width, "opened");
  const before = await page.evaluate(() => window.live.setup().grippers[6]);
  const [x, y] = await gripperAt(page, 6);
  const client = await context.newCDPSession(page);
  const touch = (type, points) => client.send("Input.dispatchTouchEvent", { type, touchPoints: points });
  await touch("touchStart", [{ x, y }]);
  for (let k = 1; k <= 6; k++) await touch("touchMove", [{ x: x - k, y: y + 4 * k }]);
  await touch("touchEnd", []);
  await settled(page);
  const now = await page.evaluate(() => window.live.setup().grippers[6]);
  assert.ok(now[2] < before[2] - 0.003, `${now} from ${before}`);
  assert.equal(await page.evaluate(() => window.scrollY), 0);
  await agrees(page, "finger");
  assert.deepEqual(diagnostics, []);
  await context.close();
}

/** A slider is moved twice; later in the frame that follows, the canvas holds the new picture, and not an empty one. */
async function drawnInTheSameFrame() {
  const { page, context } = await open();
  const [first, second, blank] = await page.evaluate(async () => {
    const canvas = document.querySelector("#picture");
    const slider = document.querySelector("#height");
    const pictures = [];
    for (const value of ["240", "300"]) {
      await window.live.idle();
      slider.value = value;
      slider.dispatchEvent(new Event("input", { bubbles: true }));
      // asked for after the page has asked for the frame, and so called after it
      await new Promise(requestAnimationFrame);
      pictures.push(canvas.toDataURL());
    }
    const empty = document.createElement("canvas");
    [empty.width, empty.height] = [canvas.width, canvas.height];
    return [...pictures, empty.toDataURL()];
  });
  assert.ok(first !== blank && second !== blank, "neither is empty");
  assert.ok(first !== second, "the second is another one");
  await context.close();
}

async function finerAtRest() {
  const { page, context, diagnostics } = await open({ pixels: 2 });
  const ratio = () =>
    page.evaluate(() => {
      const canvas = document.querySelector("#picture");
      return canvas.width / canvas.clientWidth;
    });
  /** The picture after it was drawn `times` times, as text. */
  const drawn = (times) =>
    page.evaluate(async (times) => {
      for (let k = 0; k < times; k++) {
        // off and on again
        for (let n = 0; n < 2; n++) document.querySelector("#show-mold").click();
        await new Promise(requestAnimationFrame);
      }
      return document.querySelector("#picture").toDataURL();
    }, times);
  const fine = () =>
    page.waitForFunction(() => {
      const canvas = document.querySelector("#picture");
      return canvas.width === 2 * canvas.clientWidth;
    });
  assert.equal(await ratio(), 2);
  const first = await drawn(1);

  // a machine on which every frame takes long
  await page.evaluate(() => {
    const slow = () => {
      const from = performance.now();
      while (performance.now() - from < 60);
      window.slow = requestAnimationFrame(slow);
    };
    slow();
  });
  const coarse = await drawn(8);
  assert.equal(await ratio(), 1);
  assert.ok(coarse !== first);
  await fine();
  assert.ok((await drawn(1)) === first, "the picture at rest is the one before");

  const before = await page.evaluate(() => window.live.setup().grippers[6]);
  const [x, y] = await gripperAt(page, 6);
  const at = (k) => [x - 0.25 * k, y + 0.75 * k];
  await page.mouse.move(x, y);
  await page.mouse.down();
  for (let k = 1; k <= 12; k++) await page.mouse.move(...at(k));
  assert.equal(await ratio(), 1);
  await page.evaluate(() => window.live.idle());
  const there = await gripperAt(page, 6);
  assert.ok(
    Math.hypot(there[0] - at(12)[0], there[1] - at(12)[1]) < 1,
    `under the pointer: ${there}, ${at(12)}`,
  );
  // it is let go and taken hold of again where it is seen, while the picture is coarse
  await page.mouse.up();
  await page.mouse.down();
  for (let k = 11; k >= 0; k--) await page.mouse.move(...at(k));
  assert.equal(await ratio(), 1);
  await page.mouse.up();
  await settled(page);
  const after = await page.evaluate(() => window.live.setup().grippers[6]);
  assert.ok(Math.hypot(...after.map((c, n) => c - before[n])) < 0.001, `${after} from ${before}`);
  await page.evaluate(() => cancelAnimationFrame(window.slow));
  await fine();
  assert.deepEqual(diagnostics, []);
  await context.close();
}

async function numbersFollow() {
  const { page, context } = await open({ width: 1280, height: 760 });
  const view = await page.locator("#view").boundingBox();
  assert.ok(await page.locator("#hint").isVisible());
  const [x, y] = await gripperAt(page, 2);
  await page.mouse.move(x, y);
  await page.mouse.down();
  // a machine so fast that all answers come at once
  await page.evaluate(() => {
    const now = performance.now();
    performance.now = () => now;
  });
  await page.mouse.move(x - 4, y - 30, { steps: 25 });
  assert.ok(await page.locator("#hint").isHidden());
  // the pointer stands, and the button is held: nothing more is asked for
  await page.waitForFunction(() => {
    const { grippers } = window.live.setup();
    const z = Number(document.querySelector("#gripper-z").value);
    return Math.abs(z - 1000 * grippers[2][2]) < 0.006;
  });
  const tilt = await page.evaluate(() => {
    const { value } = window.live.hanging().page.limits.find(({ name }) => name === "tilt");
    const row = [...document.querySelectorAll("#limits-body tr")].find((tr) => /^tilt/i.test(tr.textContent));
    return [value, parseFloat(row.querySelector("td.number").textContent)];
  });
  assert.ok(Math.abs(tilt[0] - tilt[1]) < 0.006, tilt.join(", "));
  assert.deepEqual(await page.locator("#view").boundingBox(), view, "the picture keeps its place and size");
  await page.mouse.up();
  await settled(page);
  // a limit is exceeded: its name, its place and its bound
  assert.match(
    await page.locator("#verdict").textContent(),
    /Tilt \d+(\.\d+)?°, at most 40° allowed \(gripper g\d_\d\)|All \d+ limits kept/,
  );
  await context.close();
}

async function pictureStays() {
  const { page, context } = await open({ width: 390, height: 844, touch: true });
  await page.locator("#rigidity").scrollIntoViewIfNeeded();
  await page.evaluate(() => document.querySelector("#mold-name").scrollIntoView({ block: "center" }));
  assert.ok((await page.evaluate(() => window.scrollY)) > 100);
  const [view, slider] = [
    await page.locator("#view").boundingBox(),
    await page.locator("#height").boundingBox(),
  ];
  assert.ok(
    view.y >= -1 && view.y + view.height <= slider.y,
    `${view.y} + ${view.height}, the slider at ${slider.y}`,
  );
  await context.close();
}
