/** Text over the 3D picture: the numbers of the axes box, and the place that is pointed at. */

import { Vector3 } from "three";
import { themeColour } from "../page/dom";
import type { Place } from "../data/page_data";
import type { Pointer } from "../page/state";
import type { AxesBox } from "./axes_box";
import type { Eye } from "./camera";

const FONT = "system-ui, -apple-system, 'Segoe UI', 'Liberation Sans', Arial, sans-serif";

/** Room that the legend takes on the right (CSS pixels). */
const LEGEND = 126;
/** In a picture narrower than this it stands elsewhere. */
const NARROW = 560;

/** A text at a place of the picture, or a ring around it. */
export interface Mark {
  place: Place;
  text: string | null;
}

export class Overlay {
  /** What is written over the picture beside the axes box. */
  marks: Mark[] = [];
  private readonly context: CanvasRenderingContext2D | null;
  /** What the text on the picture depends on, when it was drawn last. */
  private drawn = "";

  constructor(
    readonly canvas: HTMLCanvasElement,
    public box: AxesBox,
    private readonly eye: Eye,
  ) {
    this.context = canvas.getContext("2d");
  }

  draw(width: number, height: number, ratio: number, pointer: Pointer | null): void {
    const pen = this.context;
    if (pen === null) return;
    const { camera } = this.eye;
    const key = [
      width,
      height,
      ratio,
      themeColour("text"),
      pointer?.label,
      ...this.marks.map(({ place, text }) => `${String(text)} ${place.join(" ")}`),
      ...this.box.extent,
      camera.zoom,
      ...camera.matrixWorld.elements,
    ].join();
    if (key === this.drawn) return;
    this.drawn = key;
    const [w, h] = [Math.round(width * ratio), Math.round(height * ratio)];
    if (this.canvas.width !== w) this.canvas.width = w;
    if (this.canvas.height !== h) this.canvas.height = h;
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    pen.clearRect(0, 0, width, height);
    pen.textAlign = "center";
    pen.textBaseline = "middle";
    for (const label of this.box.labels(this.eye)) {
      pen.font = label.name ? `12px ${FONT}` : `11px ${FONT}`;
      pen.fillStyle = themeColour(label.name ? "text" : "text-quiet");
      const half = pen.measureText(label.text).width / 2 + 4;
      const inside = Math.min(Math.max(label.x, half), width - half);
      // Moved in if it is cut off by a little; one that is far outside stays there.
      pen.fillText(label.text, Math.abs(inside - label.x) < 24 ? inside : label.x, label.y);
    }
    for (const { place, text } of this.marks) {
      if (text === null) this.ring(pen, place);
      else this.write(pen, place, text);
    }
    if (pointer !== null) this.point(pen, pointer, width, height);
  }

  /** A text with a halo, so that it can be read on the ply. */
  private write(pen: CanvasRenderingContext2D, place: Place, text: string): void {
    const [x, y] = this.eye.project(new Vector3(...place));
    pen.font = `600 11.5px ${FONT}`;
    pen.lineJoin = "round";
    pen.lineWidth = 3.5;
    pen.strokeStyle = themeColour("surface");
    pen.strokeText(text, x, y);
    pen.fillStyle = themeColour("text");
    pen.fillText(text, x, y);
  }

  /** A ring around a place; where it is on the picture. */
  private ring(pen: CanvasRenderingContext2D, place: Place): [number, number] {
    const [x, y] = this.eye.project(new Vector3(...place));
    for (const [colour, line] of [
      [themeColour("surface"), 5],
      [themeColour("accent"), 2.5],
    ] as const) {
      pen.strokeStyle = colour;
      pen.lineWidth = line;
      pen.beginPath();
      pen.arc(x, y, 13, 0, 2 * Math.PI);
      pen.stroke();
    }
    return [x, y];
  }

  /** A ring around the place and a plate with its label beside it. */
  private point(
    pen: CanvasRenderingContext2D,
    { place, label }: Pointer,
    width: number,
    height: number,
  ): void {
    const [x, y] = this.ring(pen, place);
    pen.font = `600 12.5px ${FONT}`;
    const lines = label.split("\n");
    const plate = Math.max(...lines.map((line) => pen.measureText(line).width)) + 18;
    const tall = 17 * lines.length + 9;
    const left = Math.min(Math.max(x + 22, 6), width - plate - (width < NARROW ? 6 : LEGEND));
    const top = Math.min(Math.max(y - tall - 18, 6), height - tall - 6);
    pen.fillStyle = themeColour("surface");
    pen.strokeStyle = themeColour("accent");
    pen.lineWidth = 1.5;
    pen.beginPath();
    pen.roundRect(left, top, plate, tall, 5);
    pen.fill();
    pen.stroke();
    pen.beginPath();
    pen.moveTo(x + 9.5, y - 9.5);
    pen.lineTo(Math.min(Math.max(x + 24, left), left + plate), Math.min(top + tall, Math.max(y - 18, top)));
    pen.stroke();
    pen.textAlign = "left";
    pen.fillStyle = themeColour("text");
    lines.forEach((line, k) => {
      pen.font = `${k === 0 ? 600 : 400} 12.5px ${FONT}`;
      pen.fillText(line, left + 9, top + 13 + 17 * k);
    });
  }
}
