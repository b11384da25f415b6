/** How far a gripper can be dragged: no farther from its neighbors than the ply between them is long. */

import { gripperName, type Place } from "../data/page_data";
import { CELL, GRID } from "./setup";

/** What is left of the ply's length between grippers at the end of their reach: there it is all but straight. */
const TAUT = 1 - 1e-4;
/** Rounds over the neighbors; each brings the place nearer to all of them. */
const ROUNDS = 60;

/** The neighbors of a gripper along the ply. */
function neighbors(gripper: number): number[] {
  const [i, j] = [gripper % GRID[0], Math.floor(gripper / GRID[0])];
  const beside: [number, number][] = [
    [i - 1, j],
    [i + 1, j],
    [i, j - 1],
    [i, j + 1],
  ];
  return beside
    .filter(([a, b]) => a >= 0 && a < GRID[0] && b >= 0 && b < GRID[1])
    .map(([a, b]) => b * GRID[0] + a);
}

const distance = (a: Place, b: Place) => Math.hypot(...a.map((c, n) => c - b[n]!));

/**
 * The place, or one near it that the ply to all neighbors lets the gripper come to; some coordinates are `kept` as they are in the
 * place. One that cannot be reached so is as near as the rounds bring it.
 */
export function withinReach(grippers: Place[], gripper: number, to: Place, kept: boolean[]): Place {
  const around = neighbors(gripper).map((k) => grippers[k]!);
  const most = TAUT * CELL;
  let place = to;
  for (let round = 0; round < ROUNDS; round++) {
    const before = place;
    for (const center of around) {
      const away = distance(place, center);
      if (away > most)
        place = center.map((c, n) =>
          kept[n] === true ? to[n]! : c + (place[n]! - c) * (most / away),
        ) as Place;
    }
    if (place === before) return place;
  }
  return place;
}

/** A sentence that names the neighbors to which the ply is all but straight. */
export function tautTo(grippers: Place[], gripper: number): string {
  const name = (k: number) => gripperName([k % GRID[0], Math.floor(k / GRID[0])]);
  const taut = neighbors(gripper).filter(
    (k) => distance(grippers[k]!, grippers[gripper]!) > CELL * (2 * TAUT - 1),
  );
  const to = taut.length === 0 ? "its neighbors" : taut.map(name).join(" and ");
  return `gripper ${name(gripper)} goes no farther, because the ply to ${to} is taut`;
}
