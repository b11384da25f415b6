// One headless Chromium, drawing in software, without a network. The path can be set with CHROMIUM.

import { existsSync } from "node:fs";
import { pathToFileURL } from "node:url";
import { chromium } from "playwright-core";

export const CHROMIUM =
  process.env.CHROMIUM ??
  ["/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"].find(existsSync) ??
  "";

/** Starts the browser; `webgl: false` starts one that cannot draw in 3D. */
export async function startBrowser({ webgl = true } = {}) {
  const drawing = webgl
    ? ["--use-angle=swiftshader", "--enable-unsafe-swiftshader"]
    : ["--disable-gpu", "--disable-3d-apis"];
  return chromium.launch({
    executablePath: CHROMIUM,
    args: [
      "--no-sandbox",
      ...drawing,
      "--disable-background-networking",
      "--disable-component-update",
      "--disable-dev-shm-usage",
      "--hide-scrollbars",
    ],
  });
}

/** Opens a page from disk, offline, and waits until it is drawn. Everything it complains of or asks for is kept. */
export async function openReport(
  browser,
  file,
  { width = 1280, height = 720, dark = false, wait = true, touch = false, hash = "", pixels = 1 } = {},
) {
  const context = await browser.newContext({
    viewport: { width, height },
    deviceScaleFactor: pixels,
    colorScheme: dark ? "dark" : "light",
    hasTouch: touch,
    isMobile: touch,
    reducedMotion: "reduce",
    offline: true,
  });
  const page = await context.newPage();
  const diagnostics = [];
  const requests = [];
  page.on("console", (message) => {
    // Said by the software renderer about reading pixels back, not by the page.
    if (/GPU stall due to ReadPixels/.test(message.text())) return;
    if (["error", "warning"].includes(message.type()))
      diagnostics.push(`${message.type()}: ${message.text()}`);
  });
  page.on("pageerror", (error) => diagnostics.push(`error: ${error.message}`));
  page.on("request", (request) => requests.push(request.url()));
  await page.goto(pathToFileURL(file).href + hash);
  if (wait) await page.evaluate(() => window.plydrape.ready);
  return { page, context, diagnostics, requests };
}
