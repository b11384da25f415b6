/**
 * Asks the solver, one setup after the other: the newest one that was asked for, once a frame.
 *
 * A scene that is refused leaves the ply as it was. A gripper that is dragged to where no ply can follow goes as far as it can.
 */

import type { Place } from "../data/page_data";
import { KEPT, type Way } from "./drag";
import { tautTo, withinReach } from "./reach";
import { moved, sceneOf, type Setup } from "./setup";
import type { Hanging, Refused, Solver } from "./solver";

/** How often the way to a place that is refused is halved. */
const HALVINGS = 5;
/** A gripper that stays so far behind the pointer (m) is seen to do so. */
const SEEN = 5e-4;

export interface Wanted {
  setup: Setup;
  /** The gripper that is dragged, if one is, and how. */
  dragged: { gripper: number; way: Way } | null;
  /** Whether the mold is drawn anew. */
  mold: boolean;
  /** Whether nothing has changed since the last answer, and only the mold is drawn: what was said stays. */
  again: boolean;
}

/** What came of it. */
export interface Told {
  /** The setup that the ply belongs to. */
  setup: Setup;
  hanging: Hanging | null;
  refused: Refused | null;
  mold: boolean;
  again: boolean;
}

type Followed = Omit<Told, "again">;

export class Asker {
  private wanted: Wanted | null = null;
  private running: Promise<void> | null = null;
  /** Milliseconds that the solver took for each of the last answers. */
  readonly solves: number[] = [];
  /** Times (ms) at which the last answers were shown. */
  readonly shown: number[] = [];

  constructor(
    private readonly solver: Solver,
    /** The last setup with a ply. */
    private setup: Setup,
    private readonly tell: (told: Told) => Promise<void>,
  ) {}

  /** Asks for the ply of a setup; one that was asked for before and has not begun is forgotten. */
  ask(wanted: Wanted): void {
    const mold = wanted.mold || (this.wanted?.mold ?? false);
    this.wanted = { ...wanted, mold };
    this.running ??= this.run().finally(() => (this.running = null));
  }

  /** Resolves when nothing is left to solve. */
  async idle(): Promise<void> {
    while (this.running !== null) await this.running;
  }

  private async run(): Promise<void> {
    while (this.wanted !== null) {
      // pointers are heard at the start of a frame, before this: what they want is drawn in the same frame
      await new Promise(requestAnimationFrame);
      const { wanted } = this;
      this.wanted = null;
      const told = { ...(await this.follow(wanted)), again: wanted.again };
      this.setup = told.setup;
      await this.tell(told);
      keep(this.shown, performance.now());
    }
  }

  private async follow({ setup, dragged, mold }: Wanted): Promise<Followed> {
    if (dragged !== null) return this.drag(setup, dragged.gripper, KEPT[dragged.way]);
    const answer = await this.solve(setup, mold);
    if ("refused" in answer) return { setup: this.setup, hanging: null, refused: answer, mold: false };
    return { setup, hanging: answer, refused: null, mold };
  }

  /** Takes a gripper as near to its place as the ply and the mold let it come. */
  private async drag(setup: Setup, gripper: number, kept: boolean[]): Promise<Followed> {
    const before = this.setup;
    const place = (of: Setup) => of.grippers[gripper]!;
    const put = (to: Place) => moved(before, gripper, withinReach(before.grippers, gripper, to, kept));
    const [from, to] = [place(before), place(setup)];
    const wanted = put(to);
    const answer = await this.solve(wanted, false);
    if (!("refused" in answer)) {
      const away = Math.hypot(...to.map((c, n) => c - place(wanted)[n]!));
      const taut =
        away > SEEN ? { refused: tautTo(wanted.grippers, gripper), help: "", reached: true } : null;
      return { setup: wanted, hanging: answer, refused: taut, mold: false };
    }
    // level beside the mold, or else as far towards the place as there is a ply
    const level = put([to[0], to[1], from[2]]);
    const beside = await this.solve(level, false);
    if (!("refused" in beside)) return { setup: level, hanging: beside, refused: answer, mold: false };
    let told: Followed = { setup: before, hanging: null, refused: answer, mold: false };
    let [low, high] = [0, 1];
    for (let n = 0; n < HALVINGS; n++) {
      const share = (low + high) / 2;
      const nearer = put(from.map((c, k) => c + share * (to[k]! - c)) as Place);
      const found = await this.solve(nearer, false);
      if ("refused" in found) high = share;
      else {
        low = share;
        told = { ...told, setup: nearer, hanging: found };
      }
    }
    return told;
  }

  private async solve(setup: Setup, mold: boolean): Promise<Hanging | Refused> {
    const scene = sceneOf(setup);
    const began = performance.now();
    const answer = await this.solver.answer(scene, mold);
    keep(this.solves, performance.now() - began);
    return answer;
  }
}

/** The last hundred. */
function keep(list: number[], value: number): void {
  list.push(value);
  if (list.length > 100) list.shift();
}
