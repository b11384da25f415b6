/**
 * A line of the fabric across the ply as it lies in a step: where it runs, how high over the mold, and where the mold is under it.
 *
 * Between the nodes of the model places and heights are interpolated in the cell that the line crosses; of cells that the boundary
 * cuts only what is ply counts.
 */

import { MICRO } from "./micro";
import type { MoldBelow } from "./mold_below";
import type { CatenaryStates } from "./catenary_states";
import type { Drape } from "./drape";
import type { CutCell, Place } from "./page_data";
import type { SheetStates } from "./sheet_states";

/** A line along u or along v, at a value of the other coordinate (mm). */
export interface FabricLine {
  along: "u" | "v";
  at: number;
}

/** A place on a fabric line. */
export interface LinePoint {
  /** Fabric coordinate along the line (mm). */
  s: number;
  place: Place;
  /** Height over the mold (mm), where it is known. */
  height: number | null;
  /** Height of the mold below or above (mm). */
  mold: number | null;
}

type Quad = [number, number, number, number];

/** Shortest piece of a line (mm). */
const LEAST = 1e-3;

/** Ends of the fabric coordinates of a drape along u and v (mm); null where it has no surface. */
export function fabricBounds({ sheet, catenaries }: Drape): [[number, number], [number, number]] | null {
  if (sheet !== null) {
    const ends: [[number, number], [number, number]] = [
      [Infinity, -Infinity],
      [Infinity, -Infinity],
    ];
    for (let k = 0; k < sheet.places.length; k++) {
      const end = ends[k % 2]!;
      const at = sheet.places[k]! / 1000;
      end[0] = Math.min(end[0], at);
      end[1] = Math.max(end[1], at);
    }
    return ends;
  }
  if (catenaries === null) return null;
  const { grid, pitch } = catenaries.data;
  if (grid[0] < 2 || grid[1] < 2) return null;
  return [
    [0, (grid[0] - 1) * pitch[0]],
    [0, (grid[1] - 1) * pitch[1]],
  ];
}

/** Fabric coordinates of a vertex of the surface between the catenaries (mm). */
export function vertexPlace({ data }: CatenaryStates, vertex: number): [number, number] {
  const { grid, divisions, pitch } = data;
  const columns = (grid[0] - 1) * divisions + 1;
  return [((vertex % columns) / divisions) * pitch[0], (Math.floor(vertex / columns) / divisions) * pitch[1]];
}

/** The pieces of a fabric line in a step of the page, each from its start to its end; none where the drape has no state. */
export function pieces(drape: Drape, index: number, line: FabricLine, mold: MoldBelow | null): LinePoint[][] {
  const picture = drape.picture(index);
  if (picture === null) return [];
  const found =
    drape.sheet !== null
      ? ofSheet(drape.sheet, picture, line)
      : drape.catenaries !== null
        ? ofCatenaries(drape.catenaries, picture, line)
        : [];
  for (const piece of found) {
    for (const point of piece) {
      const [x, y, z] = point.place;
      const below = mold?.at(x, y, z - (point.height ?? 0) / 1000) ?? null;
      point.mold = below === null ? null : below * 1000;
    }
  }
  return found;
}

function ofSheet(sheet: SheetStates, state: number, { along, at }: FabricLine): LinePoint[][] {
  const { cells, cut } = sheet.data;
  const points = sheet.positions.at(state);
  const [run, level] = along === "u" ? [0, 1] : [1, 0];
  const coordinate = (node: number, c: number) => sheet.places[2 * node + c]! / 1000;
  const rings = new Map<string, CutCell["rings"]>(cut.map((cell) => [cell.nodes.join(), cell.rings]));
  const seen = new Set<string>();
  const segments: [LinePoint, LinePoint][] = [];
  for (let k = 0; k < cells.length; k += 4) {
    const nodes = cells.slice(k, k + 4) as Quad;
    const levels = nodes.map((node) => coordinate(node, level));
    if (Math.min(...levels) > at + LEAST / 2 || Math.max(...levels) < at - LEAST / 2) continue;
    // the side of the cell along which the level changes
    const turned = Math.abs(levels[1]! - levels[0]!) > Math.abs(levels[3]! - levels[0]!);
    const rise = (turned ? levels[1]! : levels[3]!) - levels[0]!;
    if (rise === 0) continue;
    const share = Math.min(Math.max((at - levels[0]!) / rise, 0), 1);
    for (const [from, to] of inside(rings.get(nodes.join()), share, turned)) {
      const ends = [from, to].map((way): LinePoint => {
        const [s, t] = turned ? [share, way] : [way, share];
        const weights = [(1 - s) * (1 - t), s * (1 - t), s * t, (1 - s) * t];
        const mean = (value: (node: number) => number) =>
          nodes.reduce((sum, node, n) => sum + weights[n]! * value(node), 0);
        const heights = nodes.map((node) => sheet.overMold(state, node));
        return {
          s: mean((node) => coordinate(node, run)),
          place: [0, 1, 2].map((c) => mean((node) => points[3 * node + c]! * MICRO)) as Place,
          height: heights.includes(null)
            ? null
            : heights.reduce<number>((sum, height, n) => sum + weights[n]! * height!, 0),
          mold: null,
        };
      }) as [LinePoint, LinePoint];
      if (ends[0].s > ends[1].s) ends.reverse();
      // a line between two rows of cells is met in both
      const key = ends.map(({ s }) => Math.round(s / LEAST)).join();
      if (seen.has(key) || ends[1].s - ends[0].s < LEAST) continue;
      seen.add(key);
      segments.push(ends);
    }
  }
  segments.sort(([a], [b]) => a.s - b.s);
  const out: LinePoint[][] = [];
  for (const [from, to] of segments) {
    const last = out[out.length - 1];
    if (last !== undefined && from.s - last[last.length - 1]!.s < LEAST) last.push(to);
    else out.push([from, to]);
  }
  return out;
}

/** From where to where a line across a cell is ply, in shares of the cell's side. */
function inside(rings: CutCell["rings"] | undefined, share: number, turned: boolean): [number, number][] {
  if (rings === undefined) return [[0, 1]];
  // a line on the very side of a cell is taken a hair within it
  const level = Math.min(Math.max(share, 1e-6), 1 - 1e-6);
  const [run, rise] = turned ? [1, 0] : [0, 1];
  const meets: number[] = [];
  for (const ring of rings) {
    ring.forEach((a, n) => {
      const b = ring[(n + 1) % ring.length]!;
      if (a[rise]! > level === b[rise]! > level) return;
      meets.push(a[run]! + ((level - a[rise]!) / (b[rise]! - a[rise]!)) * (b[run]! - a[run]!));
    });
  }
  meets.sort((a, b) => a - b);
  return Array.from({ length: meets.length >> 1 }, (_, k) => [meets[2 * k]!, meets[2 * k + 1]!]);
}

function ofCatenaries(catenaries: CatenaryStates, picture: number, { along, at }: FabricLine): LinePoint[][] {
  const { grid, divisions, pitch } = catenaries.data;
  if (grid[0] < 2 || grid[1] < 2) return [];
  const [columns, rows] = [(grid[0] - 1) * divisions + 1, (grid[1] - 1) * divisions + 1];
  const points = catenaries.positions.at(picture);
  const gaps = catenaries.gap?.at(picture) ?? null;
  const [run, level] = along === "u" ? [0, 1] : [1, 0];
  const [count, lines] = along === "u" ? [columns, rows] : [rows, columns];
  const place = (at / pitch[level]!) * divisions;
  if (place < -1e-6 || place > lines - 1 + 1e-6) return [];
  const low = Math.min(Math.max(Math.floor(place), 0), lines - 2);
  const share = place - low;
  const vertex = (k: number, l: number) => (along === "u" ? l * columns + k : k * columns + l);
  const piece = Array.from({ length: count }, (_, k): LinePoint => {
    const [a, b] = [vertex(k, low), vertex(k, low + 1)];
    const between = (from: Int32Array, size: number, c: number) =>
      (1 - share) * from[size * a + c]! + share * from[size * b + c]!;
    return {
      s: (k / divisions) * pitch[run]!,
      place: [0, 1, 2].map((c) => between(points, 3, c) * MICRO) as Place,
      height: gaps === null ? null : between(gaps, 1, 0) / 1000,
      mold: null,
    };
  });
  return [piece];
}
