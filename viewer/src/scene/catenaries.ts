/**
 * The catenaries: edges between neighbouring grippers, which are lines of the surface's grid, and the two
 * diagonals of every cell. Diagonals hang below the surface drawn between the edges; they are pulled towards
 * the eye by as much as that, so that they are seen through it.
 */

import { Group } from "three";
import { MICRO, type Motion } from "../data/motion";
import { Lines } from "./lines";

export class Catenaries {
  readonly group = new Group();
  private readonly edges: Lines;
  private readonly diagonals: Lines;
  /** Pairs of grid vertices, one a segment of an edge. */
  private readonly pairs: Uint32Array;

  constructor(
    private readonly motion: Motion,
    push: number,
    pull: number,
  ) {
    const [nu, nv] = motion.data.grid;
    const n = motion.data.divisions;
    const columns = (nu - 1) * n + 1;
    const rows = (nv - 1) * n + 1;
    const pairs: number[] = [];
    for (let row = 0; row < rows; row += n) {
      for (let k = 0; k < columns - 1; k++) pairs.push(row * columns + k, row * columns + k + 1);
    }
    for (let column = 0; column < columns; column += n) {
      for (let k = 0; k < rows - 1; k++) pairs.push(k * columns + column, (k + 1) * columns + column);
    }
    this.pairs = Uint32Array.from(pairs);
    this.edges = new Lines(pairs.length / 2, 1.9, push);
    this.diagonals = new Lines(2 * (nu - 1) * (nv - 1) * n, 1.2, -pull);
    this.group.add(this.diagonals.mesh, this.edges.mesh);
  }

  ink(colour: string): void {
    this.edges.ink(colour);
    this.diagonals.ink(colour, 0.9);
  }

  showDiagonals(shown: boolean): void {
    this.diagonals.mesh.visible = shown;
  }

  set order(order: number) {
    this.edges.mesh.renderOrder = order;
    this.diagonals.mesh.renderOrder = order;
  }

  moveTo(step: number): void {
    const points = this.motion.surface.at(step);
    const { ends } = this.edges;
    for (let k = 0; k < this.pairs.length; k++) {
      const from = 3 * this.pairs[k]!;
      for (let c = 0; c < 3; c++) ends[3 * k + c] = points[from + c]! * MICRO;
    }
    this.edges.changed();
    this.moveDiagonals(this.motion.diagonals.at(step));
  }

  private moveDiagonals(points: Int32Array): void {
    const n = this.motion.data.divisions;
    const { ends } = this.diagonals;
    const curves = points.length / (3 * (n + 1));
    let k = 0;
    for (let curve = 0; curve < curves; curve++) {
      const start = 3 * curve * (n + 1);
      for (let piece = 0; piece < n; piece++) {
        for (let c = 0; c < 6; c++) ends[k++] = points[start + 3 * piece + c]! * MICRO;
      }
    }
    this.diagonals.changed();
  }
}
