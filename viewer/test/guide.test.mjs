// The built user guide in a real browser: links, pictures, width on a phone, search.
//
// PLYDRAPE_GUIDE names its folder, build/guide unless set (scripts/guide makes it). Without a browser the tests are
// skipped, loudly; where CI is set that is an error.

import assert from "node:assert/strict";
import { existsSync, readdirSync, readFileSync, statSync } from "node:fs";
import { createServer } from "node:http";
import { extname, join, resolve } from "node:path";
import { after, before, describe, test } from "node:test";
import { CHROMIUM, startBrowser } from "../browser.mjs";

const GUIDE = resolve(process.env.PLYDRAPE_GUIDE ?? "../build/guide");
const PHONE = { width: 390, height: 844 };
const TYPES = {
  ".html": "text/html",
  ".js": "text/javascript",
  ".css": "text/css",
  ".svg": "image/svg+xml",
};

const missing =
  CHROMIUM === ""
    ? "there is no Chromium (install it or set CHROMIUM)"
    : existsSync(join(GUIDE, "index.html"))
      ? null
      : `${GUIDE} has no guide (scripts/guide makes it)`;
if (missing !== null) {
  if (process.env.CI) throw new Error(`the guide cannot be tested: ${missing}`);
  console.error(`\n*** THE GUIDE IS NOT TESTED: ${missing} ***\n`);
}

/** Pages of the guide, as paths below its folder. */
const pages =
  missing === null
    ? ["", "guide", "theory"].flatMap((folder) =>
        readdirSync(join(GUIDE, folder))
          .filter((name) => name.endsWith(".html"))
          .map((name) => (folder === "" ? name : `${folder}/${name}`)),
      )
    : [];

describe("user guide", { skip: missing ?? false }, () => {
  let browser;
  let server;
  let origin;
  const found = new Map();

  before(async () => {
    browser = await startBrowser({ webgl: false });
    server = createServer((request, answer) => {
      const path = join(GUIDE, decodeURIComponent(new URL(request.url, "http://guide").pathname));
      if (!path.startsWith(GUIDE) || !existsSync(path) || !statSync(path).isFile()) {
        answer.writeHead(404).end();
        return;
      }
      answer.writeHead(200, { "content-type": TYPES[extname(path)] ?? "application/octet-stream" });
      answer.end(readFileSync(path));
    });
    await new Promise((done) => server.listen(0, "127.0.0.1", done));
    origin = `http://127.0.0.1:${server.address().port}`;

    const context = await browser.newContext({ viewport: PHONE });
    const page = await context.newPage();
    const diagnostics = [];
    page.on("pageerror", (error) => diagnostics.push(error.message));
    for (const path of pages) {
      await page.goto(`${origin}/${path}`);
      found.set(path, { ...(await page.evaluate(look)), diagnostics: diagnostics.splice(0) });
    }
    await context.close();
  });
  after(async () => {
    await browser?.close();
    server?.close();
  });

  test("has all its pages", () => assert.ok(pages.length > 40, `${pages.length} pages`));

  test("no link within the guide is broken", () => {
    const broken = [];
    for (const [path, { links }] of found) {
      for (const link of links) {
        const url = new URL(link);
        if (url.origin !== origin) continue;
        const to = decodeURIComponent(url.pathname).replace(/^\//, "").replace(/^$/, "index.html");
        const file = join(GUIDE, to);
        const anchor = decodeURIComponent(url.hash.slice(1));
        const there = existsSync(file) && statSync(file).isFile();
        const ids = found.get(to)?.ids;
        if (!there || (anchor !== "" && ids !== undefined && !ids.includes(anchor)))
          broken.push(`${path}: ${to}${url.hash}`);
      }
    }
    assert.deepEqual([...new Set(broken)], []);
  });

  test("every picture is drawn", () => {
    const blank = [...found].flatMap(([path, { blank }]) => blank.map((from) => `${path}: ${from}`));
    assert.deepEqual(blank, []);
  });

  test("no page scrolls sideways on a phone", () => {
    const wide = [...found]
      .filter(([, { width, wide }]) => width > PHONE.width || wide !== "")
      .map(([path, { width, wide }]) => `${path}: ${width} px, ${wide}`);
    assert.deepEqual(wide, []);
  });

  test("no script fails", () => {
    const failed = [...found].filter(([, { diagnostics }]) => diagnostics.length > 0);
    assert.deepEqual(failed, []);
  });

  for (const [words, page] of [
    ["pad_radius", "guide/keys.html"],
    ["how exact must my robot be", "guide/exactness.html"],
    ["elastica", "guide/validation.html"],
    ["with_motion", "guide/api.html"],
  ]) {
    test(`the search for "${words}" leads to ${page}`, async () => {
      const context = await browser.newContext({ viewport: PHONE });
      const tab = await context.newPage();
      await tab.goto(`${origin}/search.html?q=${encodeURIComponent(words)}`);
      const result = tab.locator(`#search-results a[href*="${page}"]`).first();
      await result.waitFor({ timeout: 20_000 });
      await result.click();
      await tab.waitForURL((url) => url.pathname === `/${page}`);
      await context.close();
    });
  }
});

/** What a page holds; runs in the browser. */
function look() {
  const article = document.querySelector("article");
  // what is wider than its own box may scroll there; the page itself may not
  const scrolls = (element) => {
    for (let at = element; at !== null && at !== article; at = at.parentElement)
      if (["auto", "scroll", "hidden"].includes(getComputedStyle(at).overflowX)) return true;
    return false;
  };
  const wide = [...(article?.querySelectorAll("*") ?? [])].find(
    (element) => element.getBoundingClientRect().right > innerWidth + 1 && !scrolls(element),
  );
  return {
    links: [...document.querySelectorAll("a[href]")].map((a) => a.href),
    ids: [...document.querySelectorAll("[id]")].map((element) => element.id),
    blank: [...document.querySelectorAll("article img")]
      .filter((image) => !image.complete || image.naturalWidth === 0)
      .map((image) => image.src),
    width: document.documentElement.scrollWidth,
    wide: wide ? wide.outerHTML.slice(0, 120) : "",
  };
}
