/**
 * The sheet: its cells, coloured by the chosen field.
 *
 * Each cell has its own four vertices, each of which knows the values at all four corners, so that a field given on
 * cells has sharp borders and one given on nodes can be unknown at some of them. All buffers are written in place.
 */

import { BufferAttribute, BufferGeometry, DynamicDrawUsage, Mesh, type ShaderMaterial } from "three";
import { shareOf } from "../data/colour_map";
import { MICRO } from "../data/micro";
import type { Field } from "../data/page_data";
import type { SheetStates } from "../data/sheet_states";
import { clothMaterial, useMap } from "./cloth";

export class SheetSurface {
  readonly mesh: Mesh<BufferGeometry, ShaderMaterial>;
  private readonly corners: number[];
  private readonly normals: Float32Array;
  private readonly position: BufferAttribute;
  private readonly normal: BufferAttribute;
  private readonly share: BufferAttribute;

  constructor(
    private readonly sheet: SheetStates,
    push: number,
  ) {
    this.corners = sheet.data.cells;
    const total = this.corners.length;
    this.normals = new Float32Array(3 * sheet.positions.count);
    const dynamic = (size: number) =>
      new BufferAttribute(new Float32Array(size * total), size).setUsage(DynamicDrawUsage);
    this.position = dynamic(3);
    this.normal = dynamic(3);
    this.share = dynamic(4);
    const geometry = new BufferGeometry();
    const index: number[] = [];
    const threads: number[] = [];
    for (let k = 0; k < total; k += 4) {
      index.push(k, k + 1, k + 2, k, k + 2, k + 3);
      threads.push(0, 0, 1, 0, 1, 1, 0, 1);
    }
    geometry.setIndex(new BufferAttribute(Uint32Array.from(index), 1));
    geometry.setAttribute("position", this.position);
    geometry.setAttribute("normal", this.normal);
    geometry.setAttribute("corners", this.share);
    geometry.setAttribute("thread", new BufferAttribute(Float32Array.from(threads), 2));
    this.mesh = new Mesh(geometry, clothMaterial(push, "corners"));
    this.mesh.frustumCulled = false;
  }

  /** Moves the sheet to a state. */
  moveTo(state: number): void {
    const points = this.sheet.positions.at(state);
    this.findNormals(points);
    const [position, normal] = [this.position.array, this.normal.array];
    this.corners.forEach((node, k) => {
      for (let c = 0; c < 3; c++) {
        position[3 * k + c] = points[3 * node + c]! * MICRO;
        normal[3 * k + c] = this.normals[3 * node + c]!;
      }
    });
    this.position.needsUpdate = true;
    this.normal.needsUpdate = true;
  }

  /** Colours the sheet by a field in a step of the page. */
  colour(field: Field, index: number): void {
    const share = this.share.array;
    const at = (item: number) => {
      const value = this.sheet.value(field, index, item);
      return value === null ? -1 : Math.min(Math.max(shareOf(field, value), 0), 1);
    };
    for (let k = 0; k < this.corners.length; k += 4) {
      const four = [0, 1, 2, 3].map((n) => at(field.on === "cell" ? k >> 2 : this.corners[k + n]!));
      for (let n = 0; n < 4; n++) share.set(four, 4 * (k + n));
    }
    this.share.needsUpdate = true;
  }

  useMap(field: Field): void {
    useMap(this.mesh.material, field);
  }

  /** Draws the fabric lines where two of them are so many CSS pixels apart that they can be told apart. */
  showThreads(apart: number): void {
    this.mesh.material.uniforms.threads!.value = apart > 5.5;
  }

  /** The normal of a node is the sum of those of its cells, each the product of its diagonals. */
  private findNormals(points: Int32Array): void {
    const { corners, normals } = this;
    normals.fill(0);
    for (let k = 0; k < corners.length; k += 4) {
      const [a, b, c, d] = [3 * corners[k]!, 3 * corners[k + 1]!, 3 * corners[k + 2]!, 3 * corners[k + 3]!];
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
