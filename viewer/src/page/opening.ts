/**
 * Where the page opens: at the end, at the place of the limit that is exceeded most there. If nothing is exceeded at the end it is
 * the worst one of another step, and if nothing is exceeded at all what is closest to its limit at the end.
 */

import { quantity } from "../data/number";
import { nearest, type FieldKey, type Limit, type Model, type PageData } from "../data/page_data";
import type { Pointer } from "./state";

/** The color mode of the model that decides that shows what a limit is about; null if none does. */
export function colorOf(data: PageData, limit: Limit): FieldKey | null {
  return data.drape.fields.find(({ measure }) => measure === limit.key)?.key ?? null;
}

/** The place of a limit as a marker; null for one without a step or a place. */
export function pointerOf(data: PageData, limit: Limit): Pointer | null {
  const index = nearest(data.steps, limit.step);
  if (index < 0 || limit.place === null) return null;
  const name = limit.name.charAt(0).toUpperCase() + limit.name.slice(1);
  const allowed = `at ${limit.least ? "least" : "most"} ${quantity(limit.limit, limit.unit)} allowed`;
  const verdict = `${limit.ok ? "pass" : "exceeded"}, ${allowed}`;
  return {
    index,
    place: limit.place,
    label: `${name}: ${quantity(limit.value, limit.unit)}\n${verdict}\n${limit.where}`,
  };
}

/** The limit that the page opens with; null where none has a step. */
export function worst(data: PageData): Limit | null {
  const known = data.limits.filter(({ step }) => step !== null);
  const last = data.steps.length - 1;
  const atEnd = (limit: Limit) => nearest(data.steps, limit.step) === last;
  const failed = known.filter(({ ok }) => !ok);
  const placed = known.filter((limit) => limit.place !== null && !limit.motion && atEnd(limit));
  for (const some of [failed.filter(atEnd), failed, placed]) {
    const [first, ...rest] = some;
    if (first !== undefined)
      return rest.reduce((most, limit) => (limit.ratio > most.ratio ? limit : most), first);
  }
  return null;
}

/** What the address asks for behind its #: `step=12&color=shear`. */
export function asked(data: PageData): {
  index: number | null;
  color: FieldKey | null;
  model: Model | null;
} {
  const given = new URLSearchParams(location.hash.slice(1));
  const step = given.get("step");
  const index = step === null || !/^\d+$/.test(step) ? null : nearest(data.steps, Number(step));
  const model = given.get("model");
  const color = given.get("color") ?? given.get("colour");
  const known = [...data.drape.fields, ...(data.also?.fields ?? [])].find(({ key }) => key === color);
  return {
    index,
    color: known?.key ?? null,
    model: [data.drape, data.also].find((drape) => drape?.model === model)?.model ?? null,
  };
}
