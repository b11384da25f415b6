/** The drape of the same motion by another program beside that of the sheet: its end, its first touch, and its course. */

import type { Motion } from "../data/motion";
import { quantity, short } from "../data/number";
import { nearest, type PeerData } from "../data/page_data";
import type { Charts } from "./charts";
import { byId, make } from "./dom";
import type { State } from "./state";
import { chooseModel } from "./toolbar";

/** Fills the part of the page that is about another program; without one there is none. */
export function showPeer(state: State, motion: Motion, charts: Charts): void {
  const { peer, steps } = motion.data;
  const section = byId("peer");
  section.hidden = peer === undefined;
  if (peer === undefined) return;
  byId("peer-name").textContent = `Beside ${peer.name}`;
  const heads = ["At the end", "Sheet", peer.name].map((text, k) =>
    make("th", { scope: "col", class: k === 0 ? "" : "number" }, text),
  );
  const rows = peer.ends.map(([words, ...values]) =>
    make(
      "tr",
      {},
      make("th", { scope: "row" }, words),
      ...values.map((value) => make("td", { class: "number" }, value)),
    ),
  );
  const courses = make("div", { class: "charts" });
  section.append(
    make("p", { class: "quiet" }, `The same motion, draped by ${peer.name}: dashed, and judging nothing.`),
    make(
      "table",
      { class: "limits differences" },
      make("thead", {}, make("tr", {}, ...heads)),
      make("tbody", {}, ...rows),
    ),
    courses,
  );
  for (const course of peer.courses) charts.add(courses, steps, course);
  if (peer.farthest !== null) section.append(farthest(state, motion, peer.farthest));
  section.append(make("p", { class: "quiet" }, peer.cost));
}

/** A line about the fabric point that is farthest apart, which shows it on the sheet. */
function farthest(
  state: State,
  motion: Motion,
  { step, node, uv_mm: [u, v], apart_mm }: NonNullable<PeerData["farthest"]>,
): HTMLElement {
  const index = nearest(motion.data.steps, step);
  const button = make("button", { type: "button", class: "link" });
  button.textContent = `u ${short(u)}, v ${short(v)} mm in step ${String(step)}`;
  button.addEventListener("click", () => {
    chooseModel(state, motion.data, "sheet");
    state.goto(index);
    const drape = motion.drape("sheet");
    const picture = drape.picture(index);
    if (drape.sheet === null || picture === null) return;
    const label = `Farthest apart: ${quantity(apart_mm, "mm")}`;
    state.set({ pointer: { index, place: drape.sheet.node(picture, node), label } });
  });
  return make("p", {}, `The same fabric point is ${quantity(apart_mm, "mm")} apart at most: `, button);
}
