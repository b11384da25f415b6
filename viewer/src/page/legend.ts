/** The colour bar over the picture: title, unit, round ticks, and the limit where there is one. */

import { gradient, mapOf, shareOf } from "../data/colour_map";
import { bracketed, full, short, ticks, ticksOfOrders, withUnit } from "../data/number";
import type { Motion } from "../data/motion";
import { USES } from "../scene/forces";
import { fieldsOf, hasSurface, type Field } from "../data/page_data";
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
  const round = field.scale === "orders" ? ticksOfOrders(low, high, 7) : ticks(low, high, 6);
  // steps are whole numbers
  const marks = key === "landing" ? round.filter(Number.isInteger) : round;
  return { key, title: label, unit, low, high, ticks: marks, limit };
}

/** The colour mode in force, with the range in force. */
export function fieldOf(motion: Motion, now: Choice): Field | undefined {
  const field = fieldsOf(motion.data, now.model).find(({ key }) => key === now.colour);
  if (field === undefined || !now.stepRange) return field;
  return (now.model === "sheet" ? motion.sheet : motion)?.within(field, now.index) ?? field;
}

export function linkLegend(state: State, motion: Motion): void {
  const host = byId("legend");
  const bar = byId("legend-bar");
  const check = byId<HTMLInputElement>("step-range");
  check.addEventListener("change", () => state.set({ stepRange: check.checked }));
  state.listen((now, before) => {
    showForceScale(motion, now);
    const ranged = now.stepRange !== before.stepRange || (now.stepRange && now.index !== before.index);
    const same = now.colour === before.colour && now.model === before.model;
    if (now !== before && same && !ranged) return;
    const field = fieldOf(motion, now);
    // A strip of ply has no cells, so nothing is coloured.
    host.hidden = field === undefined || (now.model === "catenaries" && !hasSurface(motion.data));
    check.checked = now.stepRange;
    // the ends of a scale of orders are those of every result, so that pictures can be compared
    check.parentElement!.hidden = field?.scale === "orders";
    if (field !== undefined) bar.replaceChildren(...draw(field));
  });
}

/** What the longest arrow stands for. */
function showForceScale(motion: Motion, now: Choice): void {
  const note = byId("force-scale");
  const state = motion.sheet?.stateOf(now.index) ?? null;
  const shown = now.model === "sheet" && now.forces && state !== null;
  const load = shown ? motion.sheet!.mostLoad(state) : 0;
  // pads that have let go have no loads
  note.hidden = load === 0;
  if (load === 0) return;
  const uses = USES.map(({ colour, text }) => {
    const swatch = make("i", { class: "swatch", "aria-hidden": "true" });
    swatch.style.background = `var(--${colour})`;
    return make("span", {}, swatch, text);
  });
  note.replaceChildren(make("b", {}, `longest arrow ${withUnit(short(load), "N")}`), ...uses);
}

/** The ends of a scale of orders stand for everything beyond them too. */
function beyond(field: Field, value: number): string {
  if (field.scale !== "orders") return "";
  return value <= field.low ? "≤\u202f" : value >= field.high ? "≥\u202f" : "";
}

function draw(field: Field): HTMLElement[] {
  const facts = legendOf(field);
  const bar = make("div", { class: "bar" });
  bar.style.background = gradient(mapOf(field));
  const scale = make("div", { class: "scale" }, bar);
  const at = (value: number) => `${100 * shareOf(field, value)}%`;
  for (const value of facts.ticks) {
    const tick = make("span", { class: "tick" }, beyond(field, value) + short(value));
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
  if (field.key === "landing") parts.push(make("p", { class: "quiet" }, "grey: in the air"));
  if (limit !== null && (limit < field.low || limit > field.high)) {
    parts.push(make("p", { class: "legend-note" }, `limit ${short(limit)}`));
  }
  return parts;
}
