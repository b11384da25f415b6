/**
 * The sheet: its cells, colored by the chosen field.
 *
 * Each cell has its own vertices, each of which knows the values at all four corners, so that a field given on cells has
 * sharp borders and one given on nodes can be unknown at some of them. Whole cells have vertices at their corners; those
 * that the boundary cuts have them around what is ply. All buffers are written in place.
 */

import {
  BufferAttribute,
  BufferGeometry,
  DynamicDrawUsage,
  Mesh,
  ShapeUtils,
  Vector2,
  type ShaderMaterial,
} from "three";
import { shareOf } from "../data/color_map";
import { MICRO } from "../data/micro";
import type { Field } from "../data/page_data";
import type { SheetStates } from "../data/sheet_states";
import { clothMaterial, useMap } from "./cloth";

/** The corners of a whole cell. */
const WHOLE: [number, number][] = [
  [0, 0],
  [1, 0],
  [1, 1],
  [0, 1],
];

/** A cell as it is drawn. */
interface Drawn {
  /** Corners. */
  nodes: number[];
  /** The cell whose values it has. */
  cell: number;
  /** Vertices: the first, and how many. */
  first: number;
  count: number;
}

export class SheetSurface {
  readonly mesh: Mesh<BufferGeometry, ShaderMaterial>;
  private readonly cells: Drawn[] = [];
  /** The place of each vertex in its cell, in shares of the cell's sides. */
  private readonly threads: number[] = [];
  private readonly normals: Float32Array;
  private readonly position: BufferAttribute;
  private readonly normal: BufferAttribute;
  private readonly share: BufferAttribute;

  constructor(
    private readonly sheet: SheetStates,
    push: number,
  ) {
    const index: number[] = [];
    const add = (nodes: number[], cell: number, places: [number, number][], triangles: number[]) => {
      const first = this.threads.length / 2;
      this.cells.push({ nodes, cell, first, count: places.length });
      index.push(...triangles.map((vertex) => first + vertex));
      this.threads.push(...places.flat());
    };
    const { cells, cut } = sheet.data;
    const isCut = new Set(cut.map(({ nodes }) => nodes.join()));
    for (let k = 0; k < cells.length; k += 4) {
      const nodes = cells.slice(k, k + 4);
      if (!isCut.has(nodes.join())) add(nodes, k >> 2, WHOLE, [0, 1, 2, 0, 2, 3]);
    }
    for (const { nodes, cell, rings } of cut) {
      const points = rings.map((ring) => ring.map(([x, y]) => new Vector2(x, y)));
      for (const [outer, holes] of regions(points)) {
        const places = [outer, ...holes].flat().map(({ x, y }): [number, number] => [x, y]);
        add(nodes, cell, places, ShapeUtils.triangulateShape(outer, holes).flat());
      }
    }
    const total = this.threads.length / 2;
    this.normals = new Float32Array(3 * sheet.positions.count);
    const dynamic = (size: number) =>
      new BufferAttribute(new Float32Array(size * total), size).setUsage(DynamicDrawUsage);
    this.position = dynamic(3);
    this.normal = dynamic(3);
    this.share = dynamic(4);
    const geometry = new BufferGeometry();
    geometry.setIndex(new BufferAttribute(Uint32Array.from(index), 1));
    geometry.setAttribute("position", this.position);
    geometry.setAttribute("normal", this.normal);
    geometry.setAttribute("corners", this.share);
    geometry.setAttribute("thread", new BufferAttribute(Float32Array.from(this.threads), 2));
    this.mesh = new Mesh(geometry, clothMaterial(push, "corners"));
    this.mesh.frustumCulled = false;
  }

  /** Moves the sheet to a state. */
  moveTo(state: number): void {
    const points = this.sheet.positions.at(state);
    this.findNormals(points);
    const [position, normal] = [this.position.array, this.normal.array];
    for (const { nodes, first, count } of this.cells) {
      const [a, b, c, d] = nodes.map((node) => 3 * node) as [number, number, number, number];
      for (let k = first; k < first + count; k++) {
        const [s, t] = [this.threads[2 * k]!, this.threads[2 * k + 1]!];
        const [wa, wb, wc, wd] = [(1 - s) * (1 - t), s * (1 - t), s * t, (1 - s) * t];
        for (let n = 0; n < 3; n++) {
          const at = (from: Int32Array | Float32Array) =>
            wa * from[a + n]! + wb * from[b + n]! + wc * from[c + n]! + wd * from[d + n]!;
          position[3 * k + n] = at(points) * MICRO;
          normal[3 * k + n] = at(this.normals);
        }
      }
    }
    this.position.needsUpdate = true;
    this.normal.needsUpdate = true;
  }

  /** Colors the sheet by a field in a state. */
  color(field: Field, state: number): void {
    const share = this.share.array;
    const at = (item: number) => {
      const value = this.sheet.value(field, state, item);
      return value === null ? -1 : Math.min(Math.max(shareOf(field, value), 0), 1);
    };
    for (const { nodes, cell, first, count } of this.cells) {
      const four = nodes.map((node) => at(field.on === "cell" ? cell : node));
      for (let k = first; k < first + count; k++) share.set(four, 4 * k);
    }
    this.share.needsUpdate = true;
  }

  useMap(field: Field): void {
    useMap(this.mesh.material, field);
  }

  /** Draws the fabric lines where two of them are this many CSS pixels apart that they can be told apart. */
  showThreads(apart: number): void {
    this.mesh.material.uniforms.threads!.value = apart > 5.5;
  }

  /** The normal of a node is the sum of those of its cells, each the product of its diagonals. */
  private findNormals(points: Int32Array): void {
    const { normals } = this;
    normals.fill(0);
    for (const { nodes } of this.cells) {
      const [a, b, c, d] = nodes.map((node) => 3 * node) as [number, number, number, number];
      const [ux, uy, uz] = [0, 1, 2].map((n) => (points[c + n]! - points[a + n]!) * 1e-3) as [
        number,
        number,
        number,
      ];
      const [vx, vy, vz] = [0, 1, 2].map((n) => (points[d + n]! - points[b + n]!) * 1e-3) as [
        number,
        number,
        number,
      ];
      const cross = [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
      for (const at of [a, b, c, d]) for (let n = 0; n < 3; n++) normals[at + n]! += cross[n]!;
    }
  }
}

/** Boundaries, each with the holes in it; a cell that a hole alone cuts has its own four sides as boundary. */
function regions(rings: Vector2[][]): [Vector2[], Vector2[][]][] {
  const outer = rings.filter((ring) => ShapeUtils.area(ring) > 0);
  const holes = rings.filter((ring) => ShapeUtils.area(ring) < 0);
  return outer.map((ring, n) => [ring, n === 0 ? holes : []]);
}
