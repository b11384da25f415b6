/** The verdict over a sample of cells: how many keep the limits, how high their sheets are, and where the highest place is. */

import { full, quantity, short, ticks } from "../data/number";
import type { Motion } from "../data/motion";
import type { SampleData } from "../data/page_data";
import { byId, make } from "./dom";
import { limitsTable, sign } from "./limits";
import type { Choice, Pointer, State } from "./state";

/** Width and height of the histogram, in its own units. */
const [WIDTH, HEIGHT] = [400, 132];
/** Room in it for the numbers below, and for the line of the limit above. */
const [BELOW, ABOVE] = [30, 16];
/** Room at the left for the number of cells. */
const COUNT = 56;
/** Bars of a histogram, about. */
const BARS = 18;
/** More of them, and the limit is no border between two. */
const MOST_BARS = 45;

/** Says beside the verdict what the motion tolerates. */
export function showTolerance(lines: string[]): void {
  const place = byId("tolerance");
  place.hidden = lines.length === 0;
  const sentence = (line: string) => `${line.charAt(0).toUpperCase()}${line.slice(1)}.`;
  place.textContent = lines.map(sentence).join(" ");
}

/** Fills the part of the page that is about the sample; without one there is none. */
export function showSample(state: State, motion: Motion): void {
  const { sample } = motion.data;
  const section = byId("sample");
  section.hidden = sample === null;
  if (sample === null) return;
  const count = sample.cells.length;
  section.append(
    make(
      "p",
      { class: sample.ok ? "sample-verdict pass" : "sample-verdict fail" },
      sign(sample.ok),
      make("b", {}, sample.ok ? "Accepted" : "Not accepted"),
      ` with errors: ${sample.words}.`,
    ),
  );
  const heights = sample.cells.filter((cell) => cell.height_mm !== null);
  if (heights.length > 0) section.append(histogram(sample));
  const missing = count - heights.length;
  if (heights.length > 0 && missing > 0) {
    const cells = missing === 1 ? "One cell has" : `${String(missing)} cells have`;
    section.append(make("p", { class: "quiet" }, `${cells} no end, and so no height.`));
  }
  const pointer = pointerOf(motion);
  if (sample.highest !== null) section.append(highest(state, sample, pointer));
  if (sample.limits.length > 0) {
    section.append(
      make(
        "details",
        {},
        make("summary", {}, `Limits, by the values that ${sample.share} of these cells keep`),
        limitsTable(state, motion.data, sample.limits),
      ),
    );
  }
  if (pointer !== null) followColor(state, pointer);
}

/** Cells by the largest height of their sheets. */
function histogram(sample: SampleData): HTMLElement {
  const { height_limit: limit } = sample;
  const heights = sample.cells.flatMap(({ height_mm, accepted }) =>
    height_mm === null ? [] : [{ height: height_mm, accepted }],
  );
  const bins = binsOf(
    heights.map(({ height }) => height),
    limit,
  );
  const counts = bins.map(([from, to], k) => {
    const within = heights.filter(
      ({ height }) => height >= from && (height < to || (k === bins.length - 1 && height <= to)),
    );
    return [within.filter((cell) => cell.accepted).length, within.filter((cell) => !cell.accepted).length];
  });
  const high = bins[bins.length - 1]![1];
  const most = Math.max(...counts.map(([kept, not]) => kept! + not!));
  const x = (height: number) => (WIDTH * height) / high;
  const y = (cells: number) => HEIGHT - BELOW - ((HEIGHT - BELOW - ABOVE) * cells) / most;

  const svg = vector("svg", { viewBox: `0 0 ${String(WIDTH)} ${String(HEIGHT)}`, role: "img" });
  const said = limit === null ? "" : `, limit ${full(limit)} mm`;
  svg.setAttribute("aria-label", `Cells by the largest height of the ply at the end${said}`);
  counts.forEach(([kept, not], k) => {
    const [from, to] = bins[k]!;
    const bar = (below: number, cells: number, kind: string) => {
      if (cells === 0) return;
      const [top, bottom] = [y(below + cells), y(below)];
      const box = {
        x: x(from) + 0.75,
        y: top,
        width: Math.max(x(to) - x(from) - 1.5, 1),
        height: bottom - top,
      };
      const word = kind === "kept" ? "accepted" : "not accepted";
      const title = vector("title", {});
      title.textContent = `${String(cells)} ${cells === 1 ? "cell" : "cells"} ${word}, ${short(from)} to ${short(to)} mm`;
      const rect = vector("rect", { ...box, class: kind, "data-cells": cells });
      rect.append(title);
      svg.append(rect);
    };
    bar(0, kept!, "kept");
    bar(kept!, not!, "not-kept");
  });
  svg.append(vector("line", { x1: 0, x2: WIDTH, y1: y(0), y2: y(0), class: "axis" }));
  for (const tick of ticks(0, high, 6)) {
    svg.append(write(x(tick), HEIGHT - BELOW + 12, short(tick), tick === 0 ? "start" : anchor(x(tick))));
  }
  svg.append(write(WIDTH / 2, HEIGHT - 3, "largest height at the end (mm)", "middle"));
  svg.append(write(0, 11, `${String(most)} cells`, "start"));
  if (limit !== null) {
    const at = x(limit);
    svg.append(vector("line", { x1: at, x2: at, y1: ABOVE - 2, y2: y(0), class: "limit" }));
    // beside the number of cells, which stands at the left
    const text = write(
      at < 90 ? Math.max(at, COUNT) : at,
      11,
      `limit ${short(limit)} mm`,
      at > WIDTH - 60 ? "end" : at < 90 ? "start" : "middle",
    );
    text.classList.add("limit");
    svg.append(text);
  }
  return make("div", { class: "histogram" }, svg);
}

/** Borders of the bars from zero to the highest; the limit is one of them where that is possible. */
function binsOf(heights: number[], limit: number | null): [number, number][] {
  const high = 1.04 * Math.max(...heights, limit ?? 0, 1e-6);
  let width = high / BARS;
  if (limit !== null && limit > 0) {
    const even = limit / Math.max(1, Math.round(limit / width));
    if (high / even <= MOST_BARS) width = even;
  }
  const count = Math.max(1, Math.ceil(high / width - 1e-9));
  return Array.from({ length: count }, (_, k) => [k * width, (k + 1) * width]);
}

function anchor(x: number): string {
  return x > WIDTH - 12 ? "end" : "middle";
}

function vector(tag: string, attributes: Record<string, string | number>): SVGElement {
  const element = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, String(value));
  return element;
}

function write(x: number, y: number, text: string, from: string): SVGElement {
  const element = vector("text", { x, y, "text-anchor": from });
  element.textContent = text;
  return element;
}

/** A line about the highest place, which shows it on the ply. */
function highest(state: State, sample: SampleData, pointer: Pointer | null): HTMLElement {
  const { height_mm, uv_mm, line, gripper } = sample.highest!;
  const text = `on the line from ${line}, near ${gripper} (u ${short(uv_mm[0])}, v ${short(uv_mm[1])} mm)`;
  const size = `Highest place: ${quantity(height_mm, "mm")} is kept by ${sample.share} of the cells, `;
  if (pointer === null) return make("p", {}, size + text);
  const button = make("button", { type: "button", class: "link" }, text);
  button.addEventListener("click", () => {
    state.set({ model: "sheet", color: "spread", index: pointer.index, playing: false });
    state.set({ pointer });
  });
  return make("p", {}, size, button);
}

/** The highest place as a marker; null where no state of the sheet shows it. */
function pointerOf(motion: Motion): Pointer | null {
  const { sample, steps } = motion.data;
  const index = steps.length - 1;
  const { sheet } = motion.deciding;
  const at = motion.deciding.picture(index);
  const node = sample?.highest?.node ?? null;
  if (sample === null || sheet === null || at === null || node === null || sheet.data.spread === null)
    return null;
  const { height_mm, line, gripper } = sample.highest!;
  const label = `Highest: ${quantity(height_mm, "mm")}\n${sample.share} of the cells keep it\nline from ${line}\nnear ${gripper}`;
  return { index, place: sheet.node(at, node), label };
}

/** The colors of the spread are about the end: choosing them goes there and marks the highest place. */
function followColor(state: State, pointer: Pointer): void {
  const spread = (choice: Choice) => choice.model === "sheet" && choice.color === "spread";
  state.listen((now, before) => {
    if (now === before || spread(now) === spread(before)) return;
    // after all that listens has seen this change
    queueMicrotask(() => {
      if (spread(state.now)) {
        state.set({ index: pointer.index, playing: false });
        state.set({ pointer });
      } else if (state.now.pointer === pointer) state.set({ pointer: null });
    });
  });
}
