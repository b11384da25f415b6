// Pictures of report pages to look at: npm run screenshots -- OUT_FOLDER REPORT.html …
// Light and dark, laptop and large screen, and the print as PDF (and as PNG where pdftoppm is installed).

import { execFileSync } from "node:child_process";
import { mkdir } from "node:fs/promises";
import { basename, dirname, join, resolve } from "node:path";
import { openReport, startBrowser } from "./browser.mjs";

const [out, ...reports] = process.argv.slice(2);
if (out === undefined || reports.length === 0) {
  console.error("usage: npm run screenshots -- OUT_FOLDER REPORT.html …");
  process.exit(2);
}
await mkdir(out, { recursive: true });
const browser = await startBrowser();
for (const report of reports.map((file) => resolve(file))) {
  const name = basename(dirname(report));
  for (const dark of [false, true]) {
    for (const [width, height] of [
      [1280, 720],
      [1920, 1080],
    ]) {
      const { page, context } = await openReport(browser, report, { width, height, dark });
      await page.waitForTimeout(300);
      const file = join(out, `${name}.${width}.${dark ? "dark" : "light"}`);
      await page.screenshot({ path: `${file}.png` });
      if (width === 1280) await page.screenshot({ path: `${file}.whole.png`, fullPage: true });
      if (width === 1280 && !dark) {
        await page.pdf({
          path: join(out, `${name}.print.pdf`),
          format: "A4",
          printBackground: false,
          preferCSSPageSize: true,
        });
      }
      await context.close();
    }
  }
  try {
    execFileSync("pdftoppm", [
      "-r",
      "70",
      "-png",
      join(out, `${name}.print.pdf`),
      join(out, `${name}.print`),
    ]);
  } catch {
    console.error("the print stays a PDF: pdftoppm is not installed");
  }
}
await browser.close();
