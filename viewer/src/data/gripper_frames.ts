/** The grippers over the steps of one model: places, turns, and what the ply does to them. */

import { unpack, type Frames } from "./block";
import type { GrippersData, Place, ReadingData } from "./page_data";

/** A measure of a gripper in a step. */
export interface Reading {
  label: string;
  unit: string;
  value: number;
  limit: number | null;
}

export class GripperFrames {
  private constructor(
    private readonly unit: number,
    readonly positions: Frames,
    readonly normals: Frames,
    private readonly forces: Frames,
    private readonly held: Frames | null,
    private readonly read: [ReadingData, Frames][],
    private readonly used: Frames | null,
  ) {}

  static async unpack(data: GrippersData): Promise<GripperFrames> {
    return new GripperFrames(
      data.force_unit,
      await unpack(data.positions, "grippers"),
      await unpack(data.normals, "normals of the pads"),
      await unpack(data.forces, "forces"),
      data.holds === null ? null : await unpack(data.holds, "pads that hold"),
      await Promise.all(
        data.readings.map(async (reading): Promise<[ReadingData, Frames]> => {
          return [reading, await unpack(reading.values, `${reading.label} of the grippers`)];
        }),
      ),
      data.used === null ? null : await unpack(data.used, "margins of the grippers"),
    );
  }

  get count(): number {
    return this.positions.count;
  }

  /** Steps that the model has done. */
  get steps(): number {
    return this.positions.steps;
  }

  /** Whether a pad holds the ply; null where all of them always do. */
  holds(index: number, gripper: number): boolean | null {
    return this.held === null ? null : this.held.at(index)[gripper] !== 0;
  }

  /** What is measured of a gripper in a step. */
  readings(index: number, gripper: number): Reading[] {
    return this.read.map(([{ label, unit, limit, fine }, values]) => {
      return { label, unit, limit, value: values.at(index)[gripper]! / fine };
    });
  }

  /** Whether its loads are judged. */
  get isJudged(): boolean {
    return this.used !== null;
  }

  /** Force of the ply on a pad (N). */
  force(index: number, gripper: number): Place {
    const forces = this.forces.at(index);
    return [0, 1, 2].map((c) => forces[3 * gripper + c]! * this.unit) as Place;
  }

  /** The force on a pad (N), parted: along the ply, and across it, which is along the normal of the pad. */
  loads(index: number, gripper: number): [along: Place, across: Place] {
    const force = this.force(index, gripper);
    const normal = this.normals.at(index).subarray(3 * gripper, 3 * gripper + 3);
    const size = Math.hypot(...normal);
    const unit = [0, 1, 2].map((c) => (size > 0 ? normal[c]! / size : Number(c === 2)));
    const up = force.reduce((sum, f, c) => sum + f * unit[c]!, 0);
    return [
      [0, 1, 2].map((c) => force[c]! - up * unit[c]!) as Place,
      [0, 1, 2].map((c) => up * unit[c]!) as Place,
    ];
  }

  /** Shares of the limits that the loads on a gripper use, along the ply and across it; null without a limit. */
  shares(index: number, gripper: number): [along: number | null, across: number | null] {
    if (this.used === null) return [null, null];
    const used = this.used.at(index);
    const share = (c: number) => (used[2 * gripper + c]! < 0 ? null : used[2 * gripper + c]! / 1000);
    return [share(0), share(1)];
  }

  /** Largest load along or across the ply in a step (N): what the longest arrow stands for; 0 in a step that was not done. */
  mostLoad(index: number): number {
    if (index >= this.steps) return 0;
    let most = 0;
    for (let k = 0; k < this.count; k++) {
      most = Math.max(most, ...this.loads(index, k).map((load) => Math.hypot(...load)));
    }
    return most;
  }
}
