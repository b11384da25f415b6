/**
 * The catenaries: edges between neighboring grippers, which are lines of the surface's grid where there is one, and the
 * diagonals of every cell, or its sides where its diagonals are the fibers. Diagonals hang below the surface drawn between the edges; they are pulled towards
 * the eye by as much as that, so that they are seen through it.
 */

import { Group } from "three";
import type { CatenaryStates } from "../data/catenary_states";
import { MICRO } from "../data/micro";
import { Lines } from "./lines";

export class Catenaries {
  readonly group = new Group();
  private readonly edges: Lines;
  private readonly diagonals: Lines;
  /** Vertices of the surface's grid under the edges, edge line after edge line. */
  private readonly under: Uint32Array;

  constructor(
    private readonly states: CatenaryStates,
    push: number,
    pull: number,
  ) {
    const [nu, nv] = states.data.grid;
    const n = states.data.divisions;
    const { fibers } = states;
    const columns = fibers === null ? (nu - 1) * n + 1 : 0;
    const rows = fibers === null ? (nv - 1) * n + 1 : 0;
    const under: number[] = [];
    for (let row = 0; row < rows; row += n) {
      for (let k = 0; k < columns; k++) under.push(row * columns + k);
    }
    for (let column = 0; column < columns; column += n) {
      for (let k = 0; k < rows; k++) under.push(k * columns + column);
    }
    this.under = Uint32Array.from(under);
    const along = (count: number, length: number) => new Array<number>(count).fill(length);
    const edges =
      fibers === null ? [...along(nv, columns), ...along(nu, rows)] : along(fibers.count / (n + 1), n + 1);
    this.edges = new Lines(edges, 1.9, push);
    this.diagonals = new Lines(along(states.diagonals.count / (n + 1), n + 1), 1.2, -pull);
    this.group.add(this.diagonals.mesh, this.edges.mesh);
  }

  ink(color: string): void {
    this.edges.ink(color);
    this.diagonals.ink(color, 0.9);
  }

  /** Draws finer lines where neighboring grippers are less than this many CSS pixels apart. */
  suit(apart: number): void {
    const weight = Math.min(Math.max(apart / 55, 0.5), 1);
    this.edges.weight = weight;
    this.diagonals.weight = weight;
  }

  thin(stride: number): void {
    this.edges.thin(stride);
    this.diagonals.thin(stride);
  }

  showDiagonals(shown: boolean): void {
    this.diagonals.mesh.visible = shown;
  }

  set order(order: number) {
    this.edges.mesh.renderOrder = order;
    this.diagonals.mesh.renderOrder = order;
  }

  /** A vertex of the surface's grid as its edge is drawn now (m), or null inside a cell. */
  vertex(at: number): [number, number, number] | null {
    const k = 3 * this.under.indexOf(at);
    const { points } = this.edges;
    return k < 0 ? null : [points[k]!, points[k + 1]!, points[k + 2]!];
  }

  moveTo(picture: number): void {
    const grid = this.states.positions.at(picture);
    const edges = this.edges.points;
    for (let k = 0; k < this.under.length; k++) {
      const from = 3 * this.under[k]!;
      for (let c = 0; c < 3; c++) edges[3 * k + c] = grid[from + c]! * MICRO;
    }
    const fibers = this.states.fibers?.at(picture) ?? [];
    for (let k = 0; k < fibers.length; k++) edges[k] = fibers[k]! * MICRO;
    this.edges.changed();

    const given = this.states.diagonals.at(picture);
    const diagonals = this.diagonals.points;
    for (let k = 0; k < given.length; k++) diagonals[k] = given[k]! * MICRO;
    this.diagonals.changed();
  }
}
