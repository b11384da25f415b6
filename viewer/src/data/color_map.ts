/**
 * Color maps: lightness grows evenly with the value, also for color-blind eyes and in gray print.
 *
 * Lengths are shown in viridis (S. van der Walt and N. Smith, matplotlib, CC0), angles in cividis
 * (Nuñez, Anderton and Renslow 2018, doi 10.1371/journal.pone.0199239).
 */

import type { Field } from "./page_data";

export type Rgb = [number, number, number];

/** Every sixteenth of the range. */
const VIRIDIS: Rgb[] = hex(
  "440154 48186a 472d7b 424086 3b528b 33638d 2c728e 26828e 21918c 1fa088 28ae80 3fbc73 5ec962 84d44b addc30 d8e219 fde725",
);
const CIVIDIS: Rgb[] = hex(
  "00224e 002e6c 1a386f 31446b 434e6c 52596e 60646f 6d6f71 7b7b78 898779 989378 a89f75 b8ad6e c9ba65 dbc95a ecd648 fee838",
);

function hex(text: string): Rgb[] {
  return text.split(" ").map((c) => [0, 2, 4].map((k) => parseInt(c.slice(k, k + 2), 16)) as Rgb);
}

/** Color modes that tell lengths, or the order of landing. */
const LENGTHS = ["height", "gap", "over_mold", "spread", "landing"];

/** The map that a color mode is shown with. */
export function mapOf(field: Field): Rgb[] {
  return LENGTHS.includes(field.key) ? VIRIDIS : CIVIDIS;
}

/** The color at a share of the range, 0 to 1; beyond it the end's color. */
export function colorAt(map: Rgb[], share: number): Rgb {
  const last = map.length - 1;
  const place = Math.min(Math.max(share, 0), 1) * last;
  const low = Math.min(Math.floor(place), last - 1);
  const [a, b] = [map[low]!, map[low + 1]!];
  return [0, 1, 2].map((c) => Math.round(a[c]! + (place - low) * (b[c]! - a[c]!))) as Rgb;
}

/** Position of a value in the range of its color mode, 0 to 1; on a scale of orders its amount counts. */
export function shareOf(field: Field, value: number): number {
  if (field.scale === "orders") {
    const share = Math.log(Math.max(Math.abs(value), 1e-300) / field.low) / Math.log(field.high / field.low);
    return Math.min(Math.max(share, 0), 1);
  }
  const span = field.high - field.low;
  return span > 0 ? (value - field.low) / span : 0.5;
}

/** The map as the colors of a CSS gradient, the lowest first. */
export function gradient(map: Rgb[]): string {
  return map.map((c) => `rgb(${c.join(" ")})`).join(", ");
}
