/** Paths of the grippers over the whole motion: what they have passed in full color, what comes in a quiet one. */

import { MICRO, type Motion } from "../data/motion";
import type { Model } from "../data/page_data";
import { Lines } from "./lines";

export class Paths {
  readonly lines: Lines;
  private model: Model | null = null;

  constructor(
    private readonly motion: Motion,
    push: number,
  ) {
    const steps = motion.data.steps.length;
    const count = motion.grippers.count;
    const times = Array.from({ length: steps * count }, (_, k) => k % steps);
    this.lines = new Lines(new Array<number>(count).fill(steps), 1.7, push, times);
    this.lines.mesh.renderOrder = 5;
  }

  ink(colour: string, later: string): void {
    this.lines.ink(colour, 1, later);
  }

  /** Shows those of a model, up to a step by its index. */
  moveTo(index: number, model: Model): void {
    this.lines.now = index + 1e-3;
    if (model === this.model) return;
    this.model = model;
    const { grippers, sheet, data } = this.motion;
    const steps = data.steps.length;
    for (let step = 0; step < steps; step++) {
      const state = model === "sheet" ? (sheet?.stateOf(step) ?? null) : null;
      const places = state === null ? grippers.at(step) : sheet!.grippers.at(state);
      for (let n = 0; n < grippers.count; n++) {
        for (let c = 0; c < 3; c++)
          this.lines.points[3 * (n * steps + step) + c] = places[3 * n + c]! * MICRO;
      }
    }
    this.lines.changed();
  }
}
