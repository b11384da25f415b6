/**
 * A box with round numbers around everything, as in the paper's figure: lines on the sides that lie behind,
 * and millimeters along three of its edges.
 */

import { Group, Vector3, type Box3 } from "three";
import { full, ticks } from "../data/number";
import type { Eye } from "./camera";
import { Lines } from "./lines";

/** A line of text on the picture, at CSS pixels, pushed outwards from the box. */
export interface Label {
  text: string;
  x: number;
  y: number;
  name: boolean;
}

const NAMES = ["x", "y", "z"] as const;
const MM = 1000;

export class AxesBox {
  readonly group = new Group();
  private readonly low: [number, number, number];
  private readonly high: [number, number, number];
  private readonly ticks: number[][];
  private readonly sides: { axis: number; end: 0 | 1; lines: Lines }[] = [];

  constructor(box: Box3, push: number) {
    this.low = box.min.toArray();
    this.high = box.max.toArray();
    const largest = Math.max(...[0, 1, 2].map((c) => this.high[c]! - this.low[c]!));
    this.ticks = [0, 1, 2].map((c) => {
      const span = this.high[c]! - this.low[c]!;
      return ticks(this.low[c]! * MM, this.high[c]! * MM, Math.max(2.4, (5 * span) / largest)).map(
        (t) => t / MM,
      );
    });
    for (const axis of [0, 1, 2]) {
      for (const end of [0, 1] as const) {
        const lines = this.side(axis, end, push);
        this.sides.push({ axis, end, lines });
        this.group.add(lines.mesh);
      }
    }
  }

  /** Grid and frame of one side. */
  private side(axis: number, end: 0 | 1, push: number): Lines {
    const [a, b] = [(axis + 1) % 3, (axis + 2) % 3];
    const at = end === 0 ? this.low[axis]! : this.high[axis]!;
    const segments: number[] = [];
    for (const [along, across] of [
      [a, b],
      [b, a],
    ] as const) {
      for (const value of [...this.ticks[across]!, this.low[across]!, this.high[across]!]) {
        for (const to of [this.low[along]!, this.high[along]!]) {
          const p = [0, 0, 0];
          p[axis] = at;
          p[across] = value;
          p[along] = to;
          segments.push(...p);
        }
      }
    }
    const lines = new Lines(new Array<number>(segments.length / 6).fill(2), 1, push);
    lines.points.set(segments);
    lines.changed();
    return lines;
  }

  /** Gives its memory of the graphics card back. */
  free(): void {
    for (const { lines } of this.sides) lines.free();
  }

  /** Lowest and highest x, y and z (m). */
  get extent(): number[] {
    return [...this.low, ...this.high];
  }

  ink(color: string): void {
    for (const { lines } of this.sides) lines.ink(color);
  }

  /** Shows the sides that face away from the eye. */
  turn(eye: Eye): void {
    const direction = eye.direction().toArray();
    for (const { axis, end, lines } of this.sides) {
      lines.mesh.visible = (end === 0 ? 1 : -1) * direction[axis]! > 1e-3;
    }
  }

  /** Numbers and names along one outer edge for each axis that is not seen end-on. */
  labels(eye: Eye): Label[] {
    const direction = eye.direction().toArray();
    const center = eye.project(new Vector3(...this.low).add(new Vector3(...this.high)).multiplyScalar(0.5));
    const labels: Label[] = [];
    for (const axis of [0, 1, 2]) {
      const edge = this.outerEdge(axis, direction, eye, center);
      if (edge === null) continue;
      const { out, point, length } = edge;
      const values = this.ticks[axis]!;
      const texts = values.map((value) => full(Math.round(value * MM * 1e6) / 1e6));
      const widest = Math.max(...texts.map(widthOf));
      const every = Math.ceil((values.length * (Math.abs(out[1]) * widest + 14)) / length);
      const put = (text: string, value: number, away: number, name: boolean) => {
        const [x, y] = eye.project(point.setComponent(axis, value));
        const reach = away + Math.abs(out[0]) * 0.5 * widthOf(text) + Math.abs(out[1]) * 7;
        const label = { text, x: x + reach * out[0], y: y + reach * out[1], name };
        // Left of the numbers there may be no room for the name of z: then it stands above them.
        const half = 0.5 * widthOf(text);
        if (name && axis === 2 && label.x < half) {
          const [left, top] = eye.project(point.setComponent(axis, this.high[axis]));
          [label.x, label.y] = [Math.max(left, half), top - 20];
        }
        if (!labels.some((other) => overlap(label, other))) labels.push(label);
      };
      const beyond = 16 + Math.abs(out[0]) * widest + Math.abs(out[1]) * 12;
      put(`${NAMES[axis]!} (mm)`, (this.low[axis]! + this.high[axis]!) / 2, beyond, true);
      values.forEach((value, k) => {
        if (k % every === 0) put(texts[k]!, value, 7, false);
      });
    }
    return labels;
  }

  /** For x and y the edge at the bottom nearer to the eye; for z the leftmost upright edge. */
  private outerEdge(axis: number, direction: number[], eye: Eye, center: [number, number]) {
    const corner = (pick: (c: number) => 0 | 1) =>
      new Vector3(...([0, 1, 2] as const).map((c) => (pick(c) === 0 ? this.low[c] : this.high[c])));
    let point: Vector3;
    if (axis === 2) {
      const four = [0, 1, 2, 3].map((k) => corner((c) => (((k >> c) & 1) === 1 ? 1 : 0)));
      point = four.reduce((best, p) => (eye.project(p)[0] < eye.project(best)[0] - 1e-6 ? p : best));
    } else {
      const floor = direction[2]! >= -1e-3 ? 0 : 1;
      point = corner((c) =>
        c === 2 ? floor : direction[c]! > -1e-3 && direction[c]! < 1e-3 ? 0 : direction[c]! > 0 ? 1 : 0,
      );
    }
    const ends = [this.low[axis]!, this.high[axis]!].map((value) =>
      eye.project(point.clone().setComponent(axis, value)),
    );
    const [[ax, ay], [bx, by]] = [ends[0]!, ends[1]!];
    const length = Math.hypot(bx - ax, by - ay);
    if (length < 30) return null;
    // Outwards: square to the edge, away from the middle of the box.
    let out: [number, number] = [-(by - ay) / length, (bx - ax) / length];
    const away = ((ax + bx) / 2 - center[0]) * out[0] + ((ay + by) / 2 - center[1]) * out[1];
    if (away < -1e-6 || (Math.abs(away) <= 1e-6 && out[1] < 0)) out = [-out[0], -out[1]];
    return { point, out, length };
  }
}

/** About how wide a label is (CSS pixels). */
function widthOf(text: string): number {
  return 6.6 * text.length;
}

function overlap(a: Label, b: Label): boolean {
  return Math.abs(a.x - b.x) < (widthOf(a.text) + widthOf(b.text)) / 2 + 4 && Math.abs(a.y - b.y) < 14;
}
