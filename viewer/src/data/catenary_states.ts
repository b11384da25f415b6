/** The net of catenaries in the steps that are drawn: everything that the page is given of it, unpacked. */

import { unpack, type Frames } from "./block";
import { BrokenData, type CatenariesData, type Field } from "./page_data";

export class CatenaryStates {
  private constructor(
    readonly data: CatenariesData,
    readonly positions: Frames,
    readonly gap: Frames | null,
    readonly fibers: Frames | null,
    readonly diagonals: Frames,
    private readonly shear: Frames,
    private readonly direction: Frames,
    private readonly contactPoints: Frames,
    private readonly contactStarts: number[],
  ) {}

  static async unpack(data: CatenariesData): Promise<CatenaryStates> {
    const starts = [0];
    for (const count of data.contacts.counts) starts.push(starts[starts.length - 1]! + count);
    if (starts[starts.length - 1] !== data.contacts.points.count) {
      throw new BrokenData("the contacts of its catenaries do not fit its steps");
    }
    return new CatenaryStates(
      data,
      await unpack(data.surface, "surface"),
      data.gap === null ? null : await unpack(data.gap, "gap"),
      data.fibers === null ? null : await unpack(data.fibers, "fibers"),
      await unpack(data.diagonals, "diagonals"),
      await unpack(data.shear, "shear"),
      await unpack(data.direction, "direction"),
      await unpack(data.contacts.points, "contacts"),
      starts,
    );
  }

  /** Contact points of a picture, three micrometers each. */
  contacts(picture: number): Int32Array {
    const [from, to] = [this.contactStarts[picture]!, this.contactStarts[picture + 1]!];
    return this.contactPoints.values.subarray(3 * from, 3 * to);
  }

  /** The most contact points in any picture. */
  get mostContacts(): number {
    return Math.max(0, ...this.data.contacts.counts);
  }

  /** The value of a color mode at a vertex or cell, in the mode's unit; null where there is none. */
  value(field: Field, picture: number, item: number): number | null {
    switch (field.key) {
      case "height":
        return this.positions.at(picture)[3 * item + 2]! / 1000;
      case "gap":
        return (this.gap?.at(picture)[item] ?? 0) / 1000;
      case "shear":
        return this.shear.at(picture)[item]! / 100;
      case "direction":
        return this.direction.at(picture)[item]! / 100;
      default:
        return null;
    }
  }

  /** How many values a color mode has in a picture. */
  countOf(field: Field): number {
    return field.on === "cell" ? this.shear.count : this.positions.count;
  }
}
