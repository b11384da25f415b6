// Panels for the pictures of the examples, see examples/pictures.py: node pictures.mjs < orders.json
//
// An order has a report, the model and the color mode, the size of a panel (CSS pixels), how many pixels one of CSS has, the
// steps, and the folder for what is made: NUMBER.png, the 3D picture of a step without loads, and legend.png, the scale of colors.

import { mkdir } from "node:fs/promises";
import { text } from "node:stream/consumers";
import { join } from "node:path";
import { openReport, startBrowser } from "./browser.mjs";

/** The page keeps this much room free at the right for its legend (CSS pixels), which is a picture of its own here. */
const FREE = 96;
/** What the legend's ticks reach beyond it (CSS pixels). */
const BEYOND = 8;
/** A scale as high as a panel. */
const LOW = "#legend-bar .scale { height: 190px; }";
/** The 3D picture alone fills the window. */
const ALONE = `
  #view { position: fixed; inset: 0; z-index: 10; background: white; }
  .picture-note { display: none; }
`;

const orders = JSON.parse(await text(process.stdin));
const browser = await startBrowser();
for (const { report, model, color, size, pixels, steps, folder } of orders) {
  await mkdir(folder, { recursive: true });
  const [width, height] = size;
  const hash = `#model=${model}&color=${color}&step=${String(steps[0])}`;
  const { page, context } = await openReport(browser, report, { width: 1280, height: 720, hash, pixels });
  await page.locator("#show-forces").uncheck();
  await page.addStyleTag({ content: LOW });
  const legend = await page.locator("#legend-bar").boundingBox();
  const clip = { ...legend, y: legend.y - BEYOND, height: legend.height + 2 * BEYOND };
  await page.screenshot({ path: join(folder, "legend.png"), clip });
  await page.addStyleTag({ content: ALONE });
  await page.setViewportSize({ width: width + FREE, height });
  for (const step of steps) {
    await page.evaluate((step) => window.plydrape.goto(step), step);
    // two frames: the first may still have the size or the step of before
    await page.evaluate(
      () => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))),
    );
    await page.screenshot({ path: join(folder, `${step}.png`), clip: { x: 0, y: 0, width, height } });
  }
  await context.close();
}
await browser.close();
