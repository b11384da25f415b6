/** Everything that is drawn, unpacked: the drape by the model that decides, and the one beside it. */

import { Drape } from "./drape";
import { MICRO } from "./micro";
import type { Model, PageData, Place } from "./page_data";

export { MICRO };

export class Motion {
  /** The smallest distance of neighboring grippers in the first step (m): the scale for what is drawn. */
  readonly spacing: number;

  private constructor(
    readonly data: PageData,
    /** By the model that decides. */
    readonly deciding: Drape,
    readonly also: Drape | null,
  ) {
    this.spacing = leastSpacing(deciding.grippers.positions.at(0));
  }

  static async unpack(data: PageData): Promise<Motion> {
    const also = data.also === null ? null : await Drape.unpack(data.also);
    return new Motion(data, await Drape.unpack(data.drape), also);
  }

  /** The drape by a model, or by the one that decides if that was not draped. */
  drape(model: Model): Drape {
    return this.also?.model === model ? this.also : this.deciding;
  }

  /** All that were draped. */
  get drapes(): Drape[] {
    return this.also === null ? [this.deciding] : [this.deciding, this.also];
  }

  /** Becomes another motion of the same ply: the live page has a new one in every frame. */
  become(other: Motion): void {
    this.deciding.become(other.deciding);
    Object.assign(this, other, { deciding: this.deciding });
  }

  /** The box around the ply, by both models, and its grippers over all steps (m). */
  bounds(): { low: Place; high: Place } {
    const low: Place = [Infinity, Infinity, Infinity];
    const high: Place = [-Infinity, -Infinity, -Infinity];
    const parts = this.drapes.flatMap(({ ply, catenaries, grippers }) => [
      ply?.positions,
      catenaries?.fibers,
      grippers.positions,
    ]);
    for (const part of parts) {
      const values = part?.values ?? new Int32Array(0);
      for (let k = 0; k < values.length; k++) {
        const c = k % 3;
        const x = values[k]! * MICRO;
        if (x < low[c]!) low[c] = x;
        if (x > high[c]!) high[c] = x;
      }
    }
    return { low, high };
  }
}

/** The distance of the closest two grippers (m), of as many as are quickly compared. */
function leastSpacing(at: Int32Array): number {
  const count = Math.min(at.length / 3, 500);
  let least = Infinity;
  for (let a = 0; a < count; a++) {
    for (let b = a + 1; b < count; b++) {
      const apart = Math.hypot(...[0, 1, 2].map((c) => (at[3 * a + c]! - at[3 * b + c]!) * MICRO));
      if (apart > 0) least = Math.min(least, apart);
    }
  }
  return Number.isFinite(least) ? least : 0.1;
}
