/** Paths of the grippers over the whole motion: what they have passed in full color, what comes in a quiet one. */

import type { Drape } from "../data/drape";
import { MICRO } from "../data/micro";
import type { Motion } from "../data/motion";
import { Lines } from "./lines";

export class Paths {
  readonly lines: Lines;
  private drape: Drape | null = null;

  constructor(
    private readonly motion: Motion,
    push: number,
  ) {
    const steps = motion.data.steps.length;
    const { count } = motion.deciding.grippers;
    const times = Array.from({ length: steps * count }, (_, k) => k % steps);
    this.lines = new Lines(new Array<number>(count).fill(steps), 1.7, push, times);
    this.lines.mesh.renderOrder = 5;
  }

  ink(color: string, later: string): void {
    this.lines.ink(color, 1, later);
  }

  /** Shows those of a drape, up to a step by its index. */
  moveTo(index: number, drape: Drape): void {
    this.lines.now = index + 1e-3;
    if (drape === this.drape) return;
    this.drape = drape;
    const { grippers } = drape;
    const steps = this.motion.data.steps.length;
    for (let step = 0; step < steps; step++) {
      // a drape that ended early goes no farther
      const places = grippers.positions.at(Math.min(step, grippers.steps - 1));
      for (let n = 0; n < grippers.count; n++) {
        for (let c = 0; c < 3; c++)
          this.lines.points[3 * (n * steps + step) + c] = places[3 * n + c]! * MICRO;
      }
    }
    this.lines.changed();
  }
}
