/** The colour bar over the picture: title, unit, round ticks, and the limit where there is one. */

import { gradient, mapOf, shareOf } from "../data/colour_map";
import { bracketed, full, short, ticks } from "../data/number";
import type { Motion } from "../data/motion";
import type { Field } from "../data/page_data";
import { byId, make } from "./dom";
import type { Choice, State } from "./state";

/** What the legend says, for scripts. */
export interface LegendFacts {
  key: string;
  title: string;
  unit: string;
  low: number;
  high: number;
  ticks: number[];
  limit: number | null;
}

export function legendOf(field: Field): LegendFacts {
  const { key, label, unit, low, high, limit } = field;
  return { key, title: label, unit, low, high, ticks: ticks(low, high, 6), limit };
}

/** The colour mode in force, with the range in force. */
export function fieldOf(motion: Motion, now: Choice): Field | undefined {
  const field = motion.data.fields.find(({ key }) => key === now.colour);
  return field !== undefined && now.stepRange ? motion.within(field, now.index) : field;
}

export function linkLegend(state: State, motion: Motion): void {
  const host = byId("legend");
  const bar = byId("legend-bar");
  const check = byId<HTMLInputElement>("step-range");
  check.addEventListener("change", () => state.set({ stepRange: check.checked }));
  state.listen((now, before) => {
    const ranged = now.stepRange !== before.stepRange || (now.stepRange && now.index !== before.index);
    if (now !== before && now.colour === before.colour && !ranged) return;
    const field = fieldOf(motion, now);
    // A strip of ply has no cells, so nothing is coloured.
    host.hidden = field === undefined || motion.data.grid.includes(1);
    check.checked = now.stepRange;
    if (field !== undefined) bar.replaceChildren(...draw(field));
  });
}

function draw(field: Field): HTMLElement[] {
  const facts = legendOf(field);
  const bar = make("div", { class: "bar" });
  bar.style.background = gradient(mapOf(field));
  const scale = make("div", { class: "scale" }, bar);
  const at = (value: number) => `${100 * shareOf(field, value)}%`;
  for (const value of facts.ticks) {
    const tick = make("span", { class: "tick" }, short(value));
    tick.style.bottom = at(value);
    scale.append(tick);
  }
  const { limit } = field;
  if (limit !== null && limit >= field.low && limit <= field.high) {
    const line = make(
      "span",
      { class: "limit-line", title: `limit ${full(limit)}` },
      make("b", {}, `limit ${short(limit)}`),
    );
    line.style.bottom = at(limit);
    scale.append(line);
  }
  const title = make("p", { class: "legend-title" }, `${field.label}${bracketed(field.unit)}`);
  const range = make("p", { class: "visually-hidden" });
  range.textContent = `from ${full(field.low)} to ${full(field.high)} ${field.unit}`;
  const parts = [title, scale, range];
  if (limit !== null && (limit < field.low || limit > field.high)) {
    parts.push(make("p", { class: "legend-note" }, `limit ${short(limit)}`));
  }
  return parts;
}
