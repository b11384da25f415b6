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
  private readonly around: number[][];

  private constructor(
    readonly data: SheetData,
    private readonly steps: number[],
    readonly places: Int32Array,
    readonly positions: Frames,
    private readonly height: Frames | null,
    private readonly contact: Frames,
    private readonly shear: Frames,
    private readonly strain: Frames,
    private readonly tension: Frames,
    readonly grippers: Frames,
    readonly normals: Frames,
    readonly forces: Frames,
    private readonly held: Frames | null,
    private readonly used: Frames,
    private readonly spread: Int32Array | null,
  ) {
    this.around = data.landing.map(() => []);
    data.cells.forEach((node, k) => this.around[node]!.push(k >> 2));
  }

  /** `steps` are the numbers of the page's steps. */
  static async unpack(data: SheetData, steps: number[]): Promise<SheetStates> {
    return new SheetStates(
      data,
      steps,
      (await unpack(data.places, "places of the nodes")).values,
      await unpack(data.positions, "nodes"),
      data.height === null ? null : await unpack(data.height, "heights"),
      await unpack(data.contact, "contact of the nodes"),
      await unpack(data.shear, "shear of the cells"),
      await unpack(data.strain, "strain"),
      await unpack(data.tension, "tension"),
      await unpack(data.grippers, "pads"),
      await unpack(data.normals, "normals of the pads"),
      await unpack(data.forces, "forces"),
      data.holds === null ? null : await unpack(data.holds, "pads that hold"),
      await unpack(data.used, "margins of the grippers"),
      data.spread === null ? null : (await unpack(data.spread, "heights of the sample")).values,
    );
  }

  /** The state that is shown in a step of the page, by their indices; null for none. */
  stateOf(index: number): number | null {
    return this.data.states[index] ?? null;
  }

  /** The first step of the page in which a node touches, as an index. */
  get firstContact(): number | null {
    const index = this.data.states.findIndex((state) => state !== null && this.contact.at(state).includes(1));
    return index < 0 ? null : index;
  }

  /** The value of a color mode at a node or cell in a step of the page, in the mode's unit; null where there is none. */
  value(field: Field, index: number, item: number): number | null {
    const state = this.stateOf(index);
    if (state === null) return null;
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
        return step > 0 && step <= this.steps[index]! ? step : null;
      }
      default:
        return null;
    }
  }

  /** How many values a color mode has in a step. */
  countOf(field: Field): number {
    return field.on === "cell" ? this.shear.count : this.positions.count;
  }

  /** Whether a pad holds the ply; null where all of them always do. */
  holds(state: number, gripper: number): boolean | null {
    return this.held === null ? null : this.held.at(state)[gripper] !== 0;
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

  /** The cell around a node that is sheared most, as its shear angle (°). */
  shearAt(state: number, node: number): number | null {
    return this.most(this.shear.at(state), node, 100)?.[0] ?? null;
  }

  /** Strain (%) and tension (N/m) beside a node, where the strain is largest. */
  yarnAt(state: number, node: number): [strain: number, tension: number] | null {
    const most = this.most(this.strain.at(state), node, 1e4);
    return most && [most[0], this.tension.at(state)[most[1]]! / 1000];
  }

  /** Force of the sheet on a pad (N). */
  force(state: number, gripper: number): Place {
    const forces = this.forces.at(state);
    return [0, 1, 2].map((c) => forces[3 * gripper + c]! * this.data.force_unit) as Place;
  }

  /** The force on a pad (N), parted: along the ply, and across it, which is along the normal of the pad. */
  loads(state: number, gripper: number): [along: Place, across: Place] {
    const force = this.force(state, gripper);
    const normal = this.normals.at(state).subarray(3 * gripper, 3 * gripper + 3);
    const size = Math.hypot(...normal);
    const unit = [0, 1, 2].map((c) => (size > 0 ? normal[c]! / size : Number(c === 2)));
    const up = force.reduce((sum, f, c) => sum + f * unit[c]!, 0);
    return [
      [0, 1, 2].map((c) => force[c]! - up * unit[c]!) as Place,
      [0, 1, 2].map((c) => up * unit[c]!) as Place,
    ];
  }

  /** Shares of what a gripper holds that the loads on it use, along the ply and across it; null without a limit. */
  shares(state: number, gripper: number): [along: number | null, across: number | null] {
    const used = this.used.at(state);
    const share = (c: number) => (used[2 * gripper + c]! < 0 ? null : used[2 * gripper + c]! / 1000);
    return [share(0), share(1)];
  }

  /** Largest load along or across the ply in a state (N): what the longest arrow stands for. */
  mostLoad(state: number): number {
    let most = 0;
    for (let k = 0; k < this.forces.count; k++) {
      most = Math.max(most, ...this.loads(state, k).map((load) => Math.hypot(...load)));
    }
    return most;
  }

  /** Where a node is (m). */
  node(state: number, node: number): Place {
    const points = this.positions.at(state);
    return [0, 1, 2].map((c) => points[3 * node + c]! * MICRO) as Place;
  }

  /** The largest amount in the cells around a node, and its cell. */
  private most(values: Int32Array, node: number, unit: number): [number, number] | null {
    let found: [number, number] | null = null;
    for (const cell of this.around[node]!) {
      const value = values[cell]! / unit;
      if (found === null || Math.abs(value) > Math.abs(found[0])) found = [value, cell];
    }
    return found;
  }
}
