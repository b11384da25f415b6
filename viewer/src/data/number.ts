/**
 * Numbers as text: short, with a true minus sign, and round ticks for axes.
 */

/** A number with four digits; the full one belongs in a title beside it. */
export function short(value: number): string {
  if (value === 0) return "0";
  const size = Math.abs(value);
  const text =
    size < 1e-4 || size >= 1e6
      ? value
          .toExponential(2)
          .replace(/\.?0+e/, "e")
          .replace("e+", "e")
      : String(Number(value.toPrecision(4)));
  return minus(text);
}

/** The same number with every digit it was given with. */
export function full(value: number): string {
  return minus(String(value));
}

/** How units are written, and the amount below which a number of that unit is shown as zero. */
const UNITS: Record<string, { sign: string; least: number }> = {
  mm: { sign: "mm", least: 1e-3 },
  "°": { sign: "°", least: 1e-3 },
  deg: { sign: "°", least: 1e-3 },
  N: { sign: "N", least: 1e-3 },
  "N/m": { sign: "N/m", least: 1e-3 },
  s: { sign: "s", least: 1e-3 },
  "%": { sign: "%", least: 1e-4 },
  "1": { sign: "", least: 0 },
  slope: { sign: "", least: 0 },
};

/** A value as tables, charts and plates show it: four digits, its unit, and “<” where it is too small to tell. */
export function quantity(value: number, unit: string): string {
  const least = UNITS[unit]?.least ?? 0;
  if (value !== 0 && Math.abs(value) < least) return `<\u202f${withUnit(short(least), unit)}`;
  return withUnit(short(value), unit);
}

/** A value with its unit; the unit 1 is left out and a degree sign follows directly. */
export function withUnit(text: string, unit: string): string {
  const sign = signOf(unit);
  if (sign === "") return text;
  return sign === "°" ? `${text}°` : `${text}\u00a0${sign}`;
}

/** A unit behind a name, in brackets; nothing for the unit 1. */
export function bracketed(unit: string): string {
  const sign = signOf(unit);
  return sign === "" ? "" : ` (${sign})`;
}

function signOf(unit: string): string {
  return UNITS[unit]?.sign ?? unit;
}

function minus(text: string): string {
  return text.replace(/-/g, "\u2212");
}

/** Round numbers inside a range, about `count` of them: steps of 1, 2 or 5 times a power of ten. */
export function ticks(low: number, high: number, count: number): number[] {
  const span = high - low;
  if (!(span > 0)) return [low];
  const rough = span / Math.max(1, count);
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = power * (rough / power > 7 ? 10 : rough / power > 3.5 ? 5 : rough / power > 1.5 ? 2 : 1);
  const found: number[] = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * span; k++) {
    found.push(Number((k * step).toPrecision(12)));
  }
  return found;
}

/** Round numbers inside a range on a scale of orders: 1, 2 and 5 times the powers of ten, or these alone if there are many. */
export function ticksOfOrders(low: number, high: number, count: number): number[] {
  const found: number[] = [];
  for (let power = Math.floor(Math.log10(low)); power <= Math.ceil(Math.log10(high)); power++) {
    for (const times of [1, 2, 5]) found.push(Number((times * 10 ** power).toPrecision(6)));
  }
  const inside = found.filter((tick) => tick >= 0.999 * low && tick <= 1.001 * high);
  return inside.length <= count ? inside : inside.filter((tick) => Number.isInteger(Math.log10(tick)));
}
