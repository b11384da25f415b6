/**
 * The motion as it is drawn: everything of the geometry, unpacked, and the values of the color modes.
 */

import { unpack, type Frames } from "./block";
import { MICRO } from "./micro";
import { BrokenData, type CellData, type Field, type PageData, type Place } from "./page_data";
import { SheetStates } from "./sheet_states";

export { MICRO };

/** The cell with where everything in it is. */
export interface CellFrames {
  data: CellData;
  origins: Frames;
}

export class Motion {
  /** The smallest distance of neighboring grippers in the first step (m): the scale for what is drawn. */
  readonly spacing: number;

  private constructor(
    readonly data: PageData,
    readonly surface: Frames,
    readonly gap: Frames | null,
    readonly fibres: Frames | null,
    readonly diagonals: Frames,
    readonly grippers: Frames,
    readonly normals: Frames,
    readonly shear: Frames,
    readonly direction: Frames,
    private readonly contactPoints: Frames,
    private readonly contactStarts: number[],
    readonly sheet: SheetStates | null,
    readonly cell: CellFrames | null,
  ) {
    this.spacing = this.leastSpacing();
  }

  static async unpack(data: PageData): Promise<Motion> {
    const g = data.geometry;
    const starts = [0];
    for (const count of g.contacts.counts) starts.push(starts[starts.length - 1]! + count);
    if (starts.length !== data.steps.length + 1 || starts[starts.length - 1] !== g.contacts.points.count) {
      throw new BrokenData("the contacts of its geometry do not fit its steps");
    }
    return new Motion(
      data,
      await unpack(g.surface, "surface"),
      g.gap === null ? null : await unpack(g.gap, "gap"),
      g.fibres === null ? null : await unpack(g.fibres, "fibres"),
      await unpack(g.diagonals, "diagonals"),
      await unpack(g.grippers, "grippers"),
      await unpack(g.normals, "normals"),
      await unpack(g.shear, "shear"),
      await unpack(g.direction, "direction"),
      await unpack(g.contacts.points, "contacts"),
      starts,
      data.sheet === null ? null : await SheetStates.unpack(data.sheet, data.steps),
      data.cell === null
        ? null
        : { data: data.cell, origins: await unpack(data.cell.origins, "bodies of the cell") },
    );
  }

  /** Becomes another motion of the same ply: the live page has a new one in every frame. */
  become(other: Motion): void {
    Object.assign(this, other);
  }

  /** Contact points of a step, three micrometers each. */
  contacts(index: number): Int32Array {
    const [from, to] = [this.contactStarts[index]!, this.contactStarts[index + 1]!];
    return this.contactPoints.values.subarray(3 * from, 3 * to);
  }

  /** The most contact points in any step. */
  get mostContacts(): number {
    return Math.max(0, ...this.data.geometry.contacts.counts);
  }

  /** The first step with contact, as an index. */
  get firstContact(): number | null {
    const index = this.data.geometry.contacts.counts.findIndex((count) => count > 0);
    return index < 0 ? null : index;
  }

  /** The value of a color mode at a vertex or cell, in the mode's unit. */
  value(field: Field, index: number, item: number): number {
    switch (field.key) {
      case "height":
        return this.surface.at(index)[3 * item + 2]! / 1000;
      case "gap":
        return (this.gap?.at(index)[item] ?? 0) / 1000;
      case "shear":
        return this.shear.at(index)[item]! / 100;
      case "direction":
        return this.direction.at(index)[item]! / 100;
      default:
        return 0;
    }
  }

  /** The box around the ply, by both models, and its grippers over all steps (m). */
  bounds(): { low: Place; high: Place } {
    const low: Place = [Infinity, Infinity, Infinity];
    const high: Place = [-Infinity, -Infinity, -Infinity];
    const none = new Int32Array(0);
    const parts = [this.surface.values, this.fibres?.values ?? none, this.sheet?.positions.values ?? none];
    for (const values of parts) {
      for (let k = 0; k < values.length; k++) {
        const c = k % 3;
        const x = values[k]! * MICRO;
        if (x < low[c]!) low[c] = x;
        if (x > high[c]!) high[c] = x;
      }
    }
    return { low, high };
  }

  private leastSpacing(): number {
    const [nu, nv] = this.data.grid;
    const at = this.grippers.at(0);
    let least = Infinity;
    const measure = (a: number, b: number) => {
      const d = [0, 1, 2].map((c) => (at[3 * a + c]! - at[3 * b + c]!) * MICRO);
      least = Math.min(least, Math.hypot(...d));
    };
    if (nu === 0) {
      // cups that are no array: the closest two, of as many as are quickly compared
      const count = Math.min(this.data.ids.length, 500);
      for (let a = 0; a < count; a++) for (let b = a + 1; b < count; b++) measure(a, b);
    }
    for (let j = 0; j < nv; j++) {
      for (let i = 0; i < nu; i++) {
        if (i + 1 < nu) measure(j * nu + i, j * nu + i + 1);
        if (j + 1 < nv) measure(j * nu + i, (j + 1) * nu + i);
      }
    }
    return Number.isFinite(least) ? least : 0.1;
  }
}
