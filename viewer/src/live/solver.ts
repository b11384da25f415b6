/** The solver of plydrape as a WebAssembly module: a scene in, the ply that hangs there out. */

import type { GripperId, PageData, Place } from "../data/page_data";
import { inflate, fromBase64 } from "../data/block";

/** One catenary: horizontal force (N) and state of each of its spans. */
export interface Catenary {
  kind: "edge-u" | "edge-v" | "rising" | "falling";
  from: GripperId;
  to: GripperId;
  forces: (number | null)[];
  holds: ("hanging" | "overstretched" | "straight" | "lying")[];
  shearing: boolean;
  /** Whether the mold holds a part of it: its force is then that of its axial stiffness. */
  touches: boolean;
  /** Middle (m). */
  middle: Place;
}

/** The ply as it hangs. */
export interface Hanging {
  program: string;
  /** Whether equilibrium and contact were found. */
  found: boolean;
  status: [string, string];
  catenaries: Catenary[];
  /** What a page of a result with this one step is given; the mold only if it was asked for. */
  page: PageData;
}

/** Why there is no ply, and what would help. */
export interface Refused {
  refused: string;
  help: string;
  /** The ply is shown all the same, with the gripper as near to its place as it comes. */
  reached?: boolean;
}

interface Exports {
  memory: WebAssembly.Memory;
  room: (bytes: number) => number;
  solve: (withMold: number) => number;
  told: () => number;
}

/** The module stopped at a fault of its own; the next answer comes from a new one. */
const FAULT: Refused = {
  refused: "the solver stopped at a fault of plydrape",
  help: "move back a little, and please report what you did",
};

export class Solver {
  private constructor(
    private readonly module: WebAssembly.Module,
    private exports: Exports,
  ) {}

  /** Unpacks the module that the page holds. */
  static async load(packed: string): Promise<Solver> {
    const module = await WebAssembly.compile(await inflate(fromBase64(packed)));
    return new Solver(module, await begin(module));
  }

  /** Solves a scene; brings its mold along only `withMold`, because that takes longer than the ply. */
  async answer(scene: string, withMold: boolean): Promise<Hanging | Refused> {
    try {
      const { room, solve, told, memory } = this.exports;
      const asked = new TextEncoder().encode(scene);
      const at = room(asked.length);
      new Uint8Array(memory.buffer, at, asked.length).set(asked);
      const length = solve(withMold ? 1 : 0);
      const text = new TextDecoder().decode(new Uint8Array(memory.buffer, told(), length));
      return JSON.parse(text) as Hanging | Refused;
    } catch (error) {
      if (!(error instanceof WebAssembly.RuntimeError)) throw error;
      this.exports = await begin(this.module);
      return FAULT;
    }
  }
}

/**
 * A new instance. Libraries that the solver is compiled with can ask a browser for the time and for random numbers;
 * nothing that the page calls does so, and if it did it would stop there.
 */
async function begin(module: WebAssembly.Module): Promise<Exports> {
  const imports: WebAssembly.Imports = {};
  for (const { module: from, name } of WebAssembly.Module.imports(module)) {
    (imports[from] ??= {})[name] = () => {
      throw new WebAssembly.RuntimeError(`${name} is not there`);
    };
  }
  const instance = await WebAssembly.instantiate(module, imports);
  return instance.exports as unknown as Exports;
}
