/**
 * The ply surface, colored by the chosen field.
 *
 * Each cell has its own (n+1)² vertices, so that a field given on cells has sharp borders. Positions and
 * normals are computed once a step on the shared grid and copied to the cells; all buffers are written in
 * place. The value goes to the shader as a share of its range and is looked up in the color map there.
 */

import { BufferAttribute, BufferGeometry, DynamicDrawUsage, Mesh, type ShaderMaterial } from "three";
import { shareOf } from "../data/color_map";
import type { CatenaryStates } from "../data/catenary_states";
import { MICRO } from "../data/micro";
import type { Field } from "../data/page_data";
import { clothMaterial, useMap } from "./cloth";

export class PlySurface {
  readonly mesh: Mesh<BufferGeometry, ShaderMaterial>;
  private readonly columns: number;
  private readonly rows: number;
  /** For each drawn vertex, the vertex of the shared grid, and its cell. */
  private readonly source: Uint32Array;
  private readonly cell: Uint32Array;
  private readonly first: Int32Array;
  private readonly normals: Float32Array;
  private readonly every: BufferAttribute;
  private stride = 1;
  private readonly position: BufferAttribute;
  private readonly normal: BufferAttribute;
  private readonly share: BufferAttribute;

  constructor(
    private readonly states: CatenaryStates,
    push: number,
  ) {
    const [nu, nv] = states.data.grid;
    const n = states.data.divisions;
    const none = nu === 0;
    this.columns = none ? 0 : (nu - 1) * n + 1;
    this.rows = none ? 0 : (nv - 1) * n + 1;
    const cells = none ? 0 : (nu - 1) * (nv - 1);
    const total = cells * (n + 1) ** 2;
    this.source = new Uint32Array(total);
    this.cell = new Uint32Array(total);
    this.first = new Int32Array(this.columns * this.rows).fill(-1);
    this.normals = new Float32Array(3 * this.columns * this.rows);
    const threads = new Float32Array(2 * total);
    this.layOut(nu, nv, n, threads);
    this.every = new BufferAttribute(triangles(cells, n, 1), 1);

    const dynamic = (size: number) =>
      new BufferAttribute(new Float32Array(size * total), size).setUsage(DynamicDrawUsage);
    this.position = dynamic(3);
    this.normal = dynamic(3);
    this.share = dynamic(1);
    const geometry = new BufferGeometry();
    geometry.setIndex(this.every);
    geometry.setAttribute("position", this.position);
    geometry.setAttribute("normal", this.normal);
    geometry.setAttribute("share", this.share);
    geometry.setAttribute("thread", new BufferAttribute(threads, 2));
    this.mesh = new Mesh(geometry, clothMaterial(push));
    this.mesh.frustumCulled = false;
  }

  /** Lists the vertices cell by cell. */
  private layOut(nu: number, nv: number, n: number, threads: Float32Array): void {
    let k = 0;
    for (let cj = 0; cj < nv - 1; cj++) {
      for (let ci = 0; ci < nu - 1; ci++) {
        for (let b = 0; b <= n; b++) {
          for (let a = 0; a <= n; a++) {
            const [column, row] = [ci * n + a, cj * n + b];
            const at = row * this.columns + column;
            this.source[k] = at;
            this.cell[k] = cj * (nu - 1) + ci;
            if (this.first[at]! < 0) this.first[at] = k;
            threads.set([column, row], 2 * k);
            k++;
          }
        }
      }
    }
  }

  /** Draws every vertex of each cell, or, which is less work, some along each side: one in `stride`. */
  thin(stride: number): void {
    if (stride === this.stride) return;
    this.stride = stride;
    const n = this.states.data.divisions;
    const cells = this.source.length / (n + 1) ** 2;
    const index = stride === 1 ? this.every : new BufferAttribute(triangles(cells, n, stride), 1);
    this.mesh.geometry.setIndex(index);
  }

  /** Moves the surface to a picture. */
  moveTo(picture: number): void {
    const points = this.states.positions.at(picture);
    this.findNormals(points);
    const position = this.position.array;
    const normal = this.normal.array;
    for (let k = 0; k < this.source.length; k++) {
      const from = 3 * this.source[k]!;
      for (let c = 0; c < 3; c++) {
        position[3 * k + c] = points[from + c]! * MICRO;
        normal[3 * k + c] = this.normals[from + c]!;
      }
    }
    this.position.needsUpdate = true;
    this.normal.needsUpdate = true;
  }

  /** Colors the surface by a field in a picture. */
  color(field: Field, picture: number): void {
    const item = field.on === "cell" ? this.cell : this.source;
    const share = this.share.array;
    for (let k = 0; k < item.length; k++) {
      share[k] = shareOf(field, this.states.value(field, picture, item[k]!) ?? 0);
    }
    this.share.needsUpdate = true;
  }

  /** Loads the color map of a field. */
  useMap(field: Field): void {
    useMap(this.mesh.material, field);
  }

  /** Draws the threads where two of them are this many CSS pixels apart that they can be told apart. */
  showThreads(apart: number): void {
    this.mesh.material.uniforms.threads!.value = apart > 5.5;
  }

  /** A vertex of the shared grid as it is drawn now (m); null for a strip of ply, which has no cells. */
  vertex(at: number): [number, number, number] | null {
    const k = 3 * (this.first[at] ?? -1);
    const { array } = this.position;
    return k < 0 ? null : [array[k]!, array[k + 1]!, array[k + 2]!];
  }

  /** Normals from the two diagonals through the neighbors of every vertex (their scale does not matter). */
  private findNormals(points: Int32Array): void {
    const { columns, rows, normals } = this;
    for (let row = 0; row < rows; row++) {
      const below = Math.max(row - 1, 0) * columns;
      const above = Math.min(row + 1, rows - 1) * columns;
      for (let column = 0; column < columns; column++) {
        const here = row * columns;
        const west = 3 * (here + Math.max(column - 1, 0));
        const east = 3 * (here + Math.min(column + 1, columns - 1));
        const south = 3 * (below + column);
        const north = 3 * (above + column);
        const ux = (points[east]! - points[west]!) * 1e-3;
        const uy = (points[east + 1]! - points[west + 1]!) * 1e-3;
        const uz = (points[east + 2]! - points[west + 2]!) * 1e-3;
        const vx = (points[north]! - points[south]!) * 1e-3;
        const vy = (points[north + 1]! - points[south + 1]!) * 1e-3;
        const vz = (points[north + 2]! - points[south + 2]!) * 1e-3;
        const k = 3 * (here + column);
        normals[k] = uy * vz - uz * vy;
        normals[k + 1] = uz * vx - ux * vz;
        normals[k + 2] = ux * vy - uy * vx;
      }
    }
  }
}

/** Two triangles for each square of `stride` intervals in each cell; the last ones end at the cell's side. */
function triangles(cells: number, n: number, stride: number): Uint32Array {
  const index: number[] = [];
  const stops: number[] = [];
  for (let a = 0; a < n; a += stride) stops.push(a);
  for (let cell = 0; cell < cells; cell++) {
    const at = (a: number, b: number) => cell * (n + 1) ** 2 + b * (n + 1) + a;
    for (const b of stops) {
      for (const a of stops) {
        const [east, north] = [Math.min(a + stride, n), Math.min(b + stride, n)];
        index.push(at(a, b), at(east, b), at(east, north), at(a, b), at(east, north), at(a, north));
      }
    }
  }
  return Uint32Array.from(index);
}
