/**
 * Loads of the ply on the grippers: arrows from the middle of each pad, in front of everything, one along the ply and one
 * across it, each in the color of how much of what the gripper holds it uses.
 *
 * The longest arrow of each step has the same length, so that small loads of the air and large ones of the end can both be
 * read; the legend says what it stands for.
 */

import { Group } from "three";
import { MICRO } from "../data/micro";
import type { GripperFrames } from "../data/gripper_frames";
import { Lines } from "./lines";

/** Length and half width of an arrow's head, as shares of the longest arrow. */
const HEAD = 0.22;
const HALF = 0.09;
/** Loads below this share of the largest are not drawn. */
const LEAST = 0.02;
/** Width of an arrow (CSS pixels). */
const WIDTH = 2.4;

/** How much of what a gripper holds is used: the colors of the arrows, with their names in the style sheet. */
export const USES = [
  { upTo: 0.5, color: "load-low", text: "≤ ½ of limit" },
  { upTo: 1, color: "load-near", text: "≤ limit" },
  { upTo: Infinity, color: "load-beyond", text: "> limit" },
] as const;

export class Forces {
  readonly group = new Group();
  /** Of each use its arrows. */
  private readonly arrows: Arrows[];

  /** `longest` is the length of the longest arrow (m); `pull` how far the arrows are pulled towards the eye (m). */
  constructor(
    count: number,
    private readonly longest: number,
    pull: number,
  ) {
    this.arrows = USES.map(() => new Arrows(2 * count, longest, pull));
    for (const { shafts, heads } of this.arrows) this.group.add(shafts.mesh, heads.mesh);
  }

  /** Takes the colors of the uses, in their order. */
  ink(colors: string[]): void {
    this.arrows.forEach((arrows, n) => {
      arrows.shafts.ink(colors[n]!);
      arrows.heads.ink(colors[n]!);
    });
  }

  set order(order: number) {
    for (const { shafts, heads } of this.arrows) shafts.mesh.renderOrder = heads.mesh.renderOrder = order;
  }

  /** Shows those of a step that was done. */
  moveTo(grippers: GripperFrames, index: number): void {
    const most = grippers.mostLoad(index);
    const pads = grippers.positions.at(index);
    for (let k = 0; k < grippers.count; k++) {
      const from = [0, 1, 2].map((c) => pads[3 * k + c]! * MICRO);
      const shares = grippers.shares(index, k);
      grippers.loads(index, k).forEach((load, n) => {
        const size = Math.hypot(...load);
        const shown = most > 0 && size >= LEAST * most;
        const use = USES.findIndex(({ upTo }) => (shares[n] ?? 0) <= upTo);
        const way = load.map((c) => (shown ? (this.longest * c) / most : 0));
        this.arrows.forEach((arrows, of) => arrows.put(2 * k + n, from, of === use ? way : [0, 0, 0]));
      });
    }
    for (const arrows of this.arrows) arrows.changed();
  }
}

/** Arrows of one color. */
class Arrows {
  readonly shafts: Lines;
  readonly heads: Lines;

  constructor(
    count: number,
    private readonly longest: number,
    pull: number,
  ) {
    this.shafts = new Lines(new Array<number>(count).fill(2), WIDTH, -pull);
    this.heads = new Lines(new Array<number>(2 * count).fill(3), WIDTH, -pull);
  }

  /** Puts one of them at a place (m); one without a length is not seen. */
  put(number: number, from: number[], way: number[]): void {
    const length = Math.hypot(...way);
    const along = way.map((c) => (length > 0 ? c / length : 0));
    const to = from.map((x, c) => x + way[c]!);
    this.shafts.points.set([...from, ...to], 6 * number);
    // two heads square to each other, so that one is seen from every side
    const level = Math.hypot(along[0]!, along[1]!);
    const side = level > 1e-6 ? [-along[1]! / level, along[0]! / level, 0] : [1, 0, 0];
    const other = [1, 2, 0].map((a, c) => along[a]! * side[(c + 2) % 3]! - along[(c + 2) % 3]! * side[a]!);
    const head = Math.min(HEAD * this.longest, 0.5 * length);
    [side, other].forEach((across, n) => {
      const barb = (sign: number) =>
        to.map((x, c) => x - head * along[c]! + (sign * head * HALF * across[c]!) / HEAD);
      const points = length > 0 ? [...barb(1), ...to, ...barb(-1)] : [...from, ...from, ...from];
      this.heads.points.set(points, 9 * (2 * number + n));
    });
  }

  changed(): void {
    this.shafts.changed();
    this.heads.changed();
  }
}
