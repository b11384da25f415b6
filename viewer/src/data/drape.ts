/** The drape by one model, unpacked: its grippers in every step, and the ply in the steps that are drawn. */

import { unpack, type Frames } from "./block";
import { CatenaryStates } from "./catenary_states";
import { GripperFrames } from "./gripper_frames";
import type { DrapeData, Field, Model } from "./page_data";
import { SheetStates } from "./sheet_states";

export class Drape {
  private constructor(
    readonly data: DrapeData,
    readonly grippers: GripperFrames,
    readonly catenaries: CatenaryStates | null,
    readonly sheet: SheetStates | null,
    /** Where bodies are that move with grippers and robot. */
    readonly origins: Frames | null,
  ) {}

  static async unpack(data: DrapeData): Promise<Drape> {
    return new Drape(
      data,
      await GripperFrames.unpack(data.grippers),
      data.catenaries === null ? null : await CatenaryStates.unpack(data.catenaries),
      data.sheet === null ? null : await SheetStates.unpack(data.sheet, data.drawn),
      data.origins === null ? null : await unpack(data.origins, "bodies of the cell"),
    );
  }

  get model(): Model {
    return this.data.model;
  }

  /** The ply in the steps that are drawn. */
  get ply(): CatenaryStates | SheetStates | null {
    return this.sheet ?? this.catenaries;
  }

  /** Which picture of the ply is shown in a step of the page, by its index; null for none. */
  picture(index: number): number | null {
    return this.data.pictures[index] ?? null;
  }

  /** The value of a color mode in a step of the page, at a vertex, node or cell; null where there is none. */
  value(field: Field, index: number, item: number): number | null {
    const picture = this.picture(index);
    return picture === null ? null : (this.ply?.value(field, picture, item) ?? null);
  }

  /** How many values a color mode has in a step. */
  countOf(field: Field): number {
    return this.ply?.countOf(field) ?? 0;
  }

  /** Nodes of the sheet, or vertices of the surface between catenaries, in a step of the page, three micrometers each. */
  points(index: number): Int32Array {
    const picture = this.picture(index);
    return picture === null ? NONE : (this.ply?.positions.at(picture) ?? NONE);
  }

  /** Places of the grippers in a step of the page, three micrometers each. */
  pads(index: number): Int32Array {
    return index < this.grippers.steps ? this.grippers.positions.at(index) : NONE;
  }

  /** Becomes another drape of the same ply. */
  become(other: Drape): void {
    Object.assign(this.grippers, other.grippers);
    if (this.catenaries !== null && other.catenaries !== null)
      Object.assign(this.catenaries, other.catenaries);
    const { grippers, catenaries } = this;
    Object.assign(this, other, { grippers, catenaries });
  }
}

const NONE = new Int32Array(0);
