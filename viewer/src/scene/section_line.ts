/** The fabric line of the section on the ply, and the place of it that the chart is asked about. */

import { Group } from "three";
import type { LinePoint } from "../data/fabric_line";
import { Lines } from "./lines";

/** Pieces of lines at most; more of them are drawn coarser. */
const MOST = 1500;

export class SectionLine {
  readonly group = new Group();
  private readonly line: Lines;

  constructor(push: number) {
    this.line = new Lines(new Array<number>(MOST).fill(2), 3, push);
    this.line.mesh.renderOrder = 4;
    this.group.add(this.line.mesh);
    this.group.visible = false;
  }

  ink(color: string): void {
    this.line.ink(color);
  }

  /** Shows a line; without pieces there is nothing to see. */
  show(pieces: LinePoint[][]): void {
    const total = pieces.reduce((sum, piece) => sum + piece.length - 1, 0);
    this.group.visible = total > 0;
    if (total === 0) return;
    const every = Math.ceil(total / MOST);
    const { points } = this.line;
    let k = 0;
    for (const piece of pieces) {
      for (let n = 0; n + 1 < piece.length && k + 6 <= points.length; n += every) {
        points.set(piece[n]!.place, k);
        points.set(piece[Math.min(n + every, piece.length - 1)]!.place, k + 3);
        k += 6;
      }
    }
    // what is left has no length
    const last = points.slice(k - 3, k);
    for (; k < points.length; k += 3) points.set(last, k);
    this.line.changed();
  }
}
