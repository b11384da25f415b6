/** The mold as it is drawn, asked for its height at a place: triangles in bins as seen from above. */

import type { MoldData } from "./page_data";

/** Bins along each side. */
const BINS = 64;

export class MoldBelow {
  private readonly bins = new Map<number, number[]>();
  private readonly low: [number, number] = [Infinity, Infinity];
  private readonly size: [number, number];

  constructor(private readonly mold: MoldData) {
    const { vertices, triangles } = mold;
    const high = [-Infinity, -Infinity];
    for (let k = 0; k < vertices.length; k += 3) {
      for (const c of [0, 1] as const) {
        this.low[c] = Math.min(this.low[c], vertices[k + c]!);
        high[c] = Math.max(high[c]!, vertices[k + c]!);
      }
    }
    this.size = [0, 1].map((c) => Math.max((high[c]! - this.low[c]!) / BINS, 1e-9)) as [number, number];
    for (let t = 0; t < triangles.length; t += 3) {
      const bin = (c: 0 | 1) => {
        const places = [0, 1, 2].map((n) => vertices[3 * triangles[t + n]! + c]!);
        return [this.bin(c, Math.min(...places)), this.bin(c, Math.max(...places))] as const;
      };
      const [[x0, x1], [y0, y1]] = [bin(0), bin(1)];
      for (let x = x0; x <= x1; x++) {
        for (let y = y0; y <= y1; y++) {
          const key = x * BINS + y;
          const list = this.bins.get(key);
          if (list === undefined) this.bins.set(key, [t]);
          else list.push(t);
        }
      }
    }
  }

  private bin(c: 0 | 1, at: number): number {
    return Math.min(Math.max(Math.floor((at - this.low[c]) / this.size[c]), 0), BINS - 1);
  }

  /** Height of the mold at a place (m), where it has several the one nearest to `near`; null beside it. */
  at(x: number, y: number, near: number): number | null {
    const { vertices, triangles } = this.mold;
    let found: number | null = null;
    for (const t of this.bins.get(this.bin(0, x) * BINS + this.bin(1, y)) ?? []) {
      const [a, b, c] = [triangles[t]!, triangles[t + 1]!, triangles[t + 2]!].map((n) => 3 * n) as [
        number,
        number,
        number,
      ];
      const [ax, ay] = [vertices[a]!, vertices[a + 1]!];
      const [bx, by] = [vertices[b]! - ax, vertices[b + 1]! - ay];
      const [cx, cy] = [vertices[c]! - ax, vertices[c + 1]! - ay];
      const area = bx * cy - by * cx;
      if (area === 0) continue;
      const s = ((x - ax) * cy - (y - ay) * cx) / area;
      const r = (bx * (y - ay) - by * (x - ax)) / area;
      if (s < -1e-9 || r < -1e-9 || s + r > 1 + 1e-9) continue;
      const z =
        vertices[a + 2]! +
        s * (vertices[b + 2]! - vertices[a + 2]!) +
        r * (vertices[c + 2]! - vertices[a + 2]!);
      if (found === null || Math.abs(z - near) < Math.abs(found - near)) found = z;
    }
    return found;
  }
}
