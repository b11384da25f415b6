/** The color bar over the picture: title, unit, round ticks, and the limit where there is one. */

import { gradient, mapOf, shareOf } from "../data/color_map";
import { bracketed, full, quantity, short, ticks, ticksOfOrders } from "../data/number";
import type { Drape } from "../data/drape";
import type { Motion } from "../data/motion";
import { USES } from "../scene/forces";
import { fieldsOf, type Field } from "../data/page_data";
import { fieldInForce, hasOrders } from "../data/ranges";
import { byId, make, renew } from "./dom";
import type { Choice, State } from "./state";

/** What the legend says, for scripts. */
export interface LegendFacts {
  key: string;
  title: string;
  unit: string;
  scale: Field["scale"];
  low: number;
  high: number;
  ticks: number[];
  limit: number | null;
}

export function legendOf(field: Field): LegendFacts {
  const { key, label, unit, scale, low, high, limit } = field;
  const round = field.scale === "orders" ? ticksOfOrders(low, high, 7) : ticks(low, high, 6);
  // steps are whole numbers
  const marks = key === "landing" ? round.filter(Number.isInteger) : round;
  return { key, title: label, unit, scale, low, high, ticks: marks, limit };
}

export function linkLegend(state: State, motion: Motion): void {
  const host = byId("legend");
  const bar = byId("legend-bar");
  const check = byId<HTMLInputElement>("step-range");
  const orders = byId<HTMLInputElement>("orders");
  check.addEventListener("change", () => state.set({ stepRange: check.checked }));
  orders.addEventListener("change", () => state.set({ orders: orders.checked }));
  state.listen((now, before) => {
    showForceScale(motion, now);
    const keys = ["color", "model", "stepRange", "orders", "other", "answer"] as const;
    const changed = now === before || keys.some((key) => now[key] !== before[key]);
    const moved = now.index !== before.index || now.otherIndex !== before.otherIndex;
    if (!changed && !(now.stepRange && moved)) return;
    const field = fieldInForce(motion, now);
    // a strip of ply has no cells, so nothing is colored
    host.hidden = field === undefined;
    check.checked = now.stepRange;
    orders.checked = now.orders;
    const given = fieldsOf(motion.data, now.model).find(({ key }) => key === now.color);
    orders.parentElement!.hidden = given === undefined || !hasOrders(given);
    if (field !== undefined) renew(bar, draw(field, grayOf(field, motion.drape(now.model))));
  });
}

/** What the longest arrow stands for, of a second result too. */
function showForceScale(motion: Motion, now: Choice): void {
  const note = byId("force-scale");
  const most = (of: Motion | null, index: number) =>
    now.forces && of !== null ? of.drape(now.model).grippers.mostLoad(index) : 0;
  const [load, other] = [most(motion, now.index), most(now.other, now.otherIndex)];
  // pads that have let go have no loads
  note.hidden = load === 0 && other === 0;
  if (load === 0 && other === 0) return;
  // a model that judges nothing has no limits
  const judged = motion.drape(now.model).grippers.isJudged;
  const uses = USES.map(({ color, text }) => {
    const swatch = make("i", { class: "swatch", "aria-hidden": "true" });
    swatch.style.background = `var(--${color})`;
    return make("span", {}, swatch, text);
  });
  const beside = now.other === null ? "" : `, of B ${quantity(other, "N")}`;
  note.replaceChildren(
    make("b", {}, `longest arrow ${quantity(load, "N")}${beside}`),
    ...(judged ? uses : []),
  );
}

/** The ends of a scale of orders stand for everything beyond them too. */
export function beyond(field: Field, value: number): string {
  if (field.scale !== "orders") return "";
  return value <= field.low ? "≤\u202f" : value >= field.high ? "≥\u202f" : "";
}

/** What is gray in a color mode; null where nothing is. */
function grayOf(field: Field, drape: Drape): string | null {
  if (field.key === "landing") return "gray: in the air";
  return field.key === "over_mold" && drape.sheet?.endsBesideMold === true ? "gray: beside the mold" : null;
}

function draw(field: Field, gray: string | null): HTMLElement[] {
  const facts = legendOf(field);
  const bar = make("div", { class: "bar" });
  bar.style.setProperty("--map", gradient(mapOf(field)));
  const scale = make("div", { class: "scale" }, bar);
  const at = (value: number) => `${String(100 * shareOf(field, value))}%`;
  for (const value of facts.ticks) {
    const tick = make("span", { class: "tick" }, beyond(field, value) + short(value));
    tick.style.setProperty("--at", at(value));
    scale.append(tick);
  }
  const { limit } = field;
  if (limit !== null && limit >= field.low && limit <= field.high) {
    const line = make(
      "span",
      { class: "limit-line", title: `limit ${full(limit)}` },
      make("b", {}, `limit ${short(limit)}`),
    );
    line.style.setProperty("--at", at(limit));
    scale.append(line);
  }
  const title = make("p", { class: "legend-title" }, `${field.label}${bracketed(field.unit)}`);
  const range = make("p", { class: "visually-hidden" });
  range.textContent = `from ${full(field.low)} to ${full(field.high)} ${field.unit}`;
  const parts = [title, scale, range];
  if (gray !== null) parts.push(make("p", { class: "quiet" }, gray));
  if (limit !== null && (limit < field.low || limit > field.high)) {
    parts.push(make("p", { class: "legend-note" }, `limit ${short(limit)}`));
  }
  return parts;
}
