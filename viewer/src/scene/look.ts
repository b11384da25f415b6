/** What a page shows of a scene that is not draped yet: where the ply must end, its warp, where cups must end, and idle cups. */

import { Group } from "three";
import type { Look, Place } from "../data/page_data";
import { Lines } from "./lines";

/** Half the length of the bars of a cross, as a share of the distance of grippers. */
const CROSS = 0.08;

export class LookPicture {
  readonly group = new Group();
  private readonly outline: Lines;
  private readonly warp: Lines;
  private readonly targets: Lines;
  private readonly off: Lines;

  constructor(look: Look, spacing: number, push: number) {
    const reach = CROSS * spacing;
    this.outline = drawn(look.outline, 2, push);
    this.warp = drawn(look.warp, 2.5, push);
    this.targets = drawn(
      look.targets.flatMap((at) => bars(at, reach, false)),
      1.7,
      push,
    );
    this.off = drawn(
      look.off.flatMap((at) => bars(at, reach, true)),
      1.7,
      push,
    );
    for (const lines of [this.outline, this.warp, this.targets, this.off]) {
      lines.mesh.renderOrder = 5;
      this.group.add(lines.mesh);
    }
  }

  ink(ply: string, warp: string, target: string, off: string): void {
    this.outline.ink(ply);
    this.warp.ink(warp);
    this.targets.ink(target);
    this.off.ink(off);
  }
}

/** Lines through places. */
function drawn(curves: Place[][], width: number, push: number): Lines {
  const lines = new Lines(
    curves.map((curve) => curve.length),
    width,
    push,
  );
  lines.points.set(curves.flat(2));
  lines.changed();
  return lines;
}

/** The bars of a cross: upright, or lying on its side as a mark that something is off. */
function bars([x, y, z]: Place, reach: number, off: boolean): Place[][] {
  const across = off ? reach * Math.SQRT1_2 : 0;
  return [
    [
      [x - (off ? across : reach), y - across, z],
      [x + (off ? across : reach), y + across, z],
    ],
    [
      [x + across, y - (off ? across : reach), z],
      [x - across, y + (off ? across : reach), z],
    ],
  ];
}
