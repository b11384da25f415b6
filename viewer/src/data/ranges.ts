/**
 * The range and scale that colors have: as the reader chose them, and the same for two results that are compared.
 *
 * Heights and strains have a scale of orders unless the reader wants an even one. Its ends are the same on all pages, so that
 * pictures can be compared; those of an even scale are the least and the largest value of all steps. Either can span the step in
 * view alone.
 */

import type { Motion } from "./motion";
import type { Drape } from "./drape";
import type { Field, FieldKey, Model } from "./page_data";

/** What a range depends on. */
export interface Ranging {
  /** Index of the step. */
  index: number;
  model: Model;
  color: FieldKey;
  stepRange: boolean;
  /** Scales of orders, where a color mode can have one. */
  orders: boolean;
  /** A second result beside this one, and the index of the step that is shown of it. */
  other: Motion | null;
  otherIndex: number;
}

/** Ends of the colors of heights on a scale of orders (mm): what touches, and what lies clear of the mold. */
const HEIGHTS: [number, number] = [0.1, 10];
/** Over this many orders a scale spans the values of one step, down from the largest. */
const ORDERS = 100;
/** No value on a scale of orders is smaller: heights in mm, strains in %. */
const LEAST = 1e-3;

/** Whether a color mode can have a scale of orders. */
export function hasOrders(field: Field): boolean {
  return field.scale === "orders" || field.key === "gap";
}

/** The color mode in force, with the scale and range in force. */
export function fieldInForce(motion: Motion, now: Ranging): Field | undefined {
  const find = (drape: Drape) => drape.data.fields.find(({ key }) => key === now.color);
  const drape = motion.drape(now.model);
  const own = find(drape);
  if (own === undefined) return undefined;
  const beside = now.other?.drape(now.model);
  const other = beside === undefined ? undefined : find(beside);
  const parts: [Drape, Field, number][] = [[drape, own, now.index]];
  if (beside !== undefined && other !== undefined) parts.push([beside, other, now.otherIndex]);
  const orders = hasOrders(own) && now.orders;
  if (orders && !now.stepRange) {
    const [low, high] = own.scale === "orders" ? [own.low, own.high] : HEIGHTS;
    return { ...own, scale: "orders", low, high };
  }
  const ends = parts.map(([of, field, index]) => {
    if (now.stepRange) return extremes(of, field, index);
    // the ends of a scale of orders are no values
    return field.scale === "orders"
      ? extremesOfAll(of, field)
      : ([field.low, field.high] as [number, number]);
  });
  const low = Math.min(...ends.map(([end]) => end));
  const high = Math.max(...ends.map(([, end]) => end));
  if (!(low <= high)) return own;
  if (!orders) return { ...own, scale: "even", low, high };
  const most = Math.max(Math.abs(low), Math.abs(high), 2 * LEAST);
  return { ...own, scale: "orders", low: Math.max(most / ORDERS, LEAST), high: most };
}

/** Least and largest value in a step; (∞, −∞) where there is none. */
function extremes(drape: Drape, field: Field, index: number): [number, number] {
  let [low, high] = [Infinity, -Infinity];
  const count = drape.countOf(field);
  for (let item = 0; item < count; item++) {
    const value = drape.value(field, index, item);
    if (value === null) continue;
    if (value < low) low = value;
    if (value > high) high = value;
  }
  return [low, high];
}

const found = new WeakMap<Drape, Map<string, [number, number]>>();

/** Least and largest value of all steps, computed once. */
function extremesOfAll(drape: Drape, field: Field): [number, number] {
  const known = found.get(drape) ?? new Map<string, [number, number]>();
  found.set(drape, known);
  let ends = known.get(field.key);
  if (ends === undefined) {
    ends = [Infinity, -Infinity];
    for (let index = 0; index < drape.data.pictures.length; index++) {
      const [low, high] = extremes(drape, field, index);
      ends = [Math.min(ends[0], low), Math.max(ends[1], high)];
    }
    known.set(field.key, ends);
  }
  return ends;
}
