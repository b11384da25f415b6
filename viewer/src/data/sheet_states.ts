/**
 * The states of the sheet as they are drawn: everything that the page is given of it, unpacked.
 */

import { unpack, type Frames } from "./block";
import { MICRO } from "./micro";
import type { Field, Place, SheetData } from "./page_data";

/** What stands for a height that is not known. */
const UNKNOWN = -(2 ** 31);

export class SheetStates {
  /** Cells around each node. */
  private readonly cellsAround: number[][];

  private constructor(
    readonly data: SheetData,
    /** Numbers of the steps of its pictures. */
    private readonly drawn: number[],
    readonly places: Int32Array,
    readonly positions: Frames,
    private readonly height: Frames | null,
    private readonly contact: Frames,
    private readonly shear: Frames,
    private readonly strain: Frames,
    private readonly tension: Frames,
    private readonly spread: Int32Array | null,
  ) {
    this.cellsAround = data.landing.map(() => []);
    data.cells.forEach((node, k) => this.cellsAround[node]!.push(k >> 2));
  }

  static async unpack(data: SheetData, drawn: number[]): Promise<SheetStates> {
    return new SheetStates(
      data,
      drawn,
      (await unpack(data.places, "places of the nodes")).values,
      await unpack(data.positions, "nodes"),
      data.height === null ? null : await unpack(data.height, "heights"),
      await unpack(data.contact, "contact of the nodes"),
      await unpack(data.shear, "shear of the cells"),
      await unpack(data.strain, "strain"),
      await unpack(data.tension, "tension"),
      data.spread === null ? null : (await unpack(data.spread, "heights of the sample")).values,
    );
  }

  /** The value of a color mode at a node or cell of a picture, in the mode's unit; null where there is none. */
  value(field: Field, state: number, item: number): number | null {
    switch (field.key) {
      case "over_mold":
        return this.overMold(state, item);
      case "spread":
        return this.spreadAt(item);
      case "height":
        return this.positions.at(state)[3 * item + 2]! / 1000;
      case "shear":
        return this.shear.at(state)[item]! / 100;
      case "strain":
        return this.strain.at(state)[item]! / 1e4;
      case "landing": {
        const step = this.data.landing[item]!;
        return step > 0 && step <= this.drawn[state]! ? step : null;
      }
      default:
        return null;
    }
  }

  /** How many values a color mode has in a picture. */
  countOf(field: Field): number {
    return field.on === "cell" ? this.shear.count : this.positions.count;
  }

  /** Whether some of the ply hangs beside the mold in the last picture, where it has no height. */
  get endsBesideMold(): boolean {
    return this.height?.at(this.height.steps - 1).includes(UNKNOWN) ?? false;
  }

  /** Height of a node over the mold (mm). */
  overMold(state: number, node: number): number | null {
    const height = this.height?.at(state)[node] ?? UNKNOWN;
    return height === UNKNOWN ? null : height / 1000;
  }

  /** Height of a node at the end that the needed share of the cells of the sample keeps (mm). */
  spreadAt(node: number): number | null {
    return this.spread === null ? null : this.spread[node]! / 1000;
  }

  touches(state: number, node: number): boolean {
    return this.contact.at(state)[node] !== 0;
  }

  /** The largest amount of a color mode in the cells around a node; null where there is none. */
  around(field: Field, state: number, node: number): number | null {
    let found: number | null = null;
    for (const cell of this.cellsAround[node]!) {
      const value = this.value(field, state, cell);
      if (value !== null && (found === null || Math.abs(value) > Math.abs(found))) found = value;
    }
    return found;
  }

  /** Tension (N/m) beside a node, where the strain is largest. */
  tensionAt(state: number, node: number): number | null {
    const strains = this.strain.at(state);
    const [first, ...rest] = this.cellsAround[node]!;
    if (first === undefined) return null;
    const most = rest.reduce((a, b) => (Math.abs(strains[b]!) > Math.abs(strains[a]!) ? b : a), first);
    return this.tension.at(state)[most]! / 1000;
  }

  /** Where a node is (m). */
  node(state: number, node: number): Place {
    const points = this.positions.at(state);
    return [0, 1, 2].map((c) => points[3 * node + c]! * MICRO) as Place;
  }
}
