// What every page must keep on a phone.

import assert from "node:assert/strict";

/** Nothing is wider than the screen, and no table has to be scrolled sideways. */
export async function fitsScreen(page, width, state) {
  const wide = await page.evaluate(() => {
    const beyond = [...document.querySelectorAll("body *")].filter((e) => {
      const { left, right, width: w } = e.getBoundingClientRect();
      return w > 0 && (right > innerWidth + 1 || left < -1) && !e.closest(".view, .visually-hidden, .plot");
    });
    const scrolls = [...document.querySelectorAll("main *")].filter(
      (e) =>
        e.scrollWidth > e.clientWidth + 1 && getComputedStyle(e).overflowX === "auto" && e.tagName !== "PRE",
    );
    return [
      document.documentElement.scrollWidth - innerWidth,
      ...[...beyond, ...scrolls].map((e) => `${e.tagName}.${e.className}#${e.id}`),
    ];
  });
  assert.deepEqual(wide, [wide[0]], `${state} at ${width}: ${wide.join(", ")}`);
  assert.ok(wide[0] <= 0, `${state} at ${width} is wider by ${wide[0]}`);
}
