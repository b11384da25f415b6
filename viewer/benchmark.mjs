// How fast a page moves, beside a peer in the same run: npm run benchmark -- REPORT.html
//
// The peer is three.js alone with one lit surface of as many points as the ply on the page, moved and drawn anew each frame on
// a canvas of the same size. Chromium draws both in software, so most of a frame is drawing.

import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { availableParallelism, loadavg, tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { build } from "esbuild";
import { openReport, startBrowser } from "./browser.mjs";

const FRAMES = 60;
const PEER = `
  import * as three from "three";
  const canvas = document.querySelector("canvas");
  const renderer = new three.WebGLRenderer({ canvas, antialias: false });
  renderer.setSize(SIZE[0], SIZE[1], false);
  const surface = new three.PlaneGeometry(1, 1, POINTS - 1, POINTS - 1);
  const scene = new three.Scene();
  scene.add(new three.Mesh(surface, new three.MeshLambertMaterial({ side: three.DoubleSide })));
  scene.add(new three.HemisphereLight());
  const eye = new three.PerspectiveCamera(50, SIZE[0] / SIZE[1], 0.1, 10);
  eye.position.set(0, -0.8, 0.8);
  eye.lookAt(0, 0, 0);
  const places = surface.attributes.position;
  window.draw = (k) => {
    for (let n = 0; n < places.count; n++) places.setZ(n, 0.05 * Math.sin(10 * places.getX(n) + k));
    places.needsUpdate = true;
    surface.computeVertexNormals();
    renderer.render(scene, eye);
  };
`;

const [report] = process.argv.slice(2).map((file) => resolve(file));
if (report === undefined) {
  console.error("usage: npm run benchmark -- REPORT.html");
  process.exit(2);
}
const scratch = mkdtempSync(join(tmpdir(), "plydrape-benchmark-"));
const browser = await startBrowser();
try {
  const data = JSON.parse(
    readFileSync(report, "utf8").match(
      /<script type="application\/json" id="plydrape-data">(.*?)<\/script>/s,
    )[1],
  );
  const { page } = await openReport(browser, report);
  await page.waitForTimeout(500);
  const size = await page.evaluate(() => {
    const canvas = document.querySelector("#picture");
    return [canvas.width, canvas.height];
  });
  const { catenaries } = data.drape;
  if (catenaries === null) throw new Error("the page is none of catenaries, as large/report.html is");
  const points = Math.max(...catenaries.grid.map((count) => (count - 1) * catenaries.divisions + 1));

  const { outputFiles } = await build({
    stdin: { contents: PEER, resolveDir: import.meta.dirname },
    define: { SIZE: JSON.stringify(size), POINTS: String(points) },
    bundle: true,
    write: false,
    format: "iife",
  });
  const file = join(scratch, "peer.html");
  writeFileSync(file, `<!doctype html><canvas></canvas><script>${outputFiles[0].text}</script>`);
  const { page: peer } = await openReport(browser, file, { wait: false });

  const moves = {
    "the page, a step a frame": [
      page,
      ({ steps, goto }, k) => goto(steps[k % steps.length]),
      () => window.plydrape,
    ],
    "three.js alone": [peer, (draw, k) => draw(0.1 * k), () => window.draw],
  };
  const load = () => (loadavg()[0] / availableParallelism()).toFixed(2);
  console.log(`canvas ${size.join(" × ")}, ${points} × ${points} points, load ${load()} a core`);
  // alternating, the best of three each: other programs only slow a run
  const best = {};
  for (let run = 0; run < 4; run++) {
    for (const [name, [shown, move, with_]] of Object.entries(moves)) {
      const rate = await shown.evaluate(
        async ([frames, move, with_]) => {
          const [step, subject] = [eval(move), eval(with_)()];
          const start = performance.now();
          for (let k = 0; k < frames; k++) {
            step(subject, k);
            await new Promise(requestAnimationFrame);
          }
          return (1000 * frames) / (performance.now() - start);
        },
        [FRAMES, String(move), String(with_)],
      );
      if (run > 0) best[name] = Math.max(best[name] ?? 0, rate);
    }
  }
  for (const [name, rate] of Object.entries(best)) console.log(`${name}: ${rate.toFixed(1)} frames a second`);
} finally {
  await browser.close();
  rmSync(scratch, { recursive: true, force: true });
}
