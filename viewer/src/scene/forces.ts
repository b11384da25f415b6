/**
 * Forces of the sheet on the pads: arrows from the middle of each pad, in front of everything.
 *
 * The longest arrow of each step has the same length, so that small forces of the air and large ones of the end can both be
 * read; the legend says what it stands for.
 */

import { Group } from "three";
import { MICRO } from "../data/micro";
import type { SheetStates } from "../data/sheet_states";
import { Lines } from "./lines";

/** Length and half width of an arrow's head, as shares of the longest arrow. */
const HEAD = 0.22;
const HALF = 0.09;
/** Forces below this share of the largest are not drawn. */
const LEAST = 0.02;

export class Forces {
  readonly group = new Group();
  private readonly shafts: Lines;
  private readonly heads: Lines;

  /** `longest` is the length of the longest arrow (m); `pull` how far the arrows are pulled towards the eye (m). */
  constructor(
    private readonly sheet: SheetStates,
    private readonly longest: number,
    pull: number,
  ) {
    const { count } = sheet.grippers;
    this.shafts = new Lines(new Array<number>(count).fill(2), 2.4, -pull);
    this.heads = new Lines(new Array<number>(2 * count).fill(3), 2.4, -pull);
    this.group.add(this.shafts.mesh, this.heads.mesh);
  }

  ink(colour: string): void {
    this.shafts.ink(colour);
    this.heads.ink(colour);
  }

  set order(order: number) {
    this.shafts.mesh.renderOrder = this.heads.mesh.renderOrder = order;
  }

  moveTo(state: number): void {
    const most = this.sheet.mostForce(state);
    const pads = this.sheet.grippers.at(state);
    for (let k = 0; k < this.sheet.grippers.count; k++) {
      const force = this.sheet.force(state, k);
      const size = Math.hypot(...force);
      const length = size < LEAST * most || most === 0 ? 0 : (this.longest * size) / most;
      const along = force.map((f) => (size > 0 ? f / size : 0));
      const from = [0, 1, 2].map((c) => pads[3 * k + c]! * MICRO);
      const to = from.map((x, c) => x + length * along[c]!);
      this.shafts.points.set([...from, ...to], 6 * k);
      // two heads square to each other, so that one is seen from every side
      const level = Math.hypot(along[0]!, along[1]!);
      const side = level > 1e-6 ? [-along[1]! / level, along[0]! / level, 0] : [1, 0, 0];
      const other = [1, 2, 0].map((a, c) => along[a]! * side[(c + 2) % 3]! - along[(c + 2) % 3]! * side[a]!);
      const head = Math.min(HEAD * this.longest, 0.5 * length);
      [side, other].forEach((across, n) => {
        const barb = (sign: number) =>
          to.map((x, c) => x - head * along[c]! + (sign * head * HALF * across[c]!) / HEAD);
        const points = length > 0 ? [...barb(1), ...to, ...barb(-1)] : [...from, ...from, ...from];
        this.heads.points.set(points, 9 * (2 * k + n));
      });
    }
    this.shafts.changed();
    this.heads.changed();
  }
}
