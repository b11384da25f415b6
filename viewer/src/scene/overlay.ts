/**
 * Text in the 3D picture: the numbers of the axes box, forces, and the place that is pointed at.
 *
 * Each text is painted once, side by side with the others on a small sheet, and drawn with the scene from there. A second
 * canvas over the picture would have to be blended with it by the browser in every frame, all of it, however little is
 * written on it; where the browser draws in software that takes longer than the ply.
 */

import {
  BufferAttribute,
  BufferGeometry,
  CanvasTexture,
  CustomBlending,
  DynamicDrawUsage,
  Mesh,
  NearestFilter,
  OneFactor,
  OneMinusSrcAlphaFactor,
  ShaderMaterial,
  Vector3,
} from "three";
import { themeColor } from "../page/dom";
import type { Place } from "../data/page_data";
import type { Pointer } from "../page/state";
import type { AxesBox } from "./axes_box";
import type { Eye } from "./camera";
import { resolution } from "./lines";

const FONT = "system-ui, -apple-system, 'Segoe UI', 'Liberation Sans', Arial, sans-serif";
/** Fonts of the names of the axes, of their numbers, of marks, and of the two parts of a label. */
const NAME = `12px ${FONT}`;
const NUMBER = `11px ${FONT}`;
const MARK = `600 11.5px ${FONT}`;
const HEADING = `600 12.5px ${FONT}`;
const LINE = `400 12.5px ${FONT}`;

/** Room that the legend takes on the right (CSS pixels). */
const LEGEND = 126;
/** In a picture narrower than this it is elsewhere. */
const NARROW = 560;
/** Width of the sheet that texts are painted on (CSS pixels); longer texts make it wider. */
const SHEET = 512;
/** Half the height of a line of text with its halo (CSS pixels). */
const TALL = 11;
/** Radius of a ring with its line (CSS pixels). */
const RING = 16;

/** A text at a place of the picture, or a ring around it. */
export interface Mark {
  place: Place;
  text: string | null;
}

/** Something painted: where its anchor is on the picture, its box around the anchor, and what it looks like (CSS pixels). */
interface Piece {
  at: [number, number];
  box: { left: number; top: number; width: number; height: number };
  /** Pieces with equal looks are painted alike. */
  look: string;
  paint: (pen: CanvasRenderingContext2D) => void;
}

const VERTEX = /* glsl */ `
  attribute vec2 corner;
  attribute vec2 source;
  uniform vec2 resolution;
  uniform vec2 sheet;
  varying vec2 vSource;
  void main() {
    vSource = source / sheet;
    gl_Position = vec4(2.0 * corner.x / resolution.x - 1.0, 1.0 - 2.0 * corner.y / resolution.y, 0.0, 1.0);
  }
`;

const FRAGMENT = /* glsl */ `
  uniform sampler2D map;
  varying vec2 vSource;
  void main() {
    gl_FragColor = texture2D(map, vSource);
  }
`;

export class Overlay {
  /** What is written over the picture beside the axes box. */
  marks: Mark[] = [];
  readonly mesh: Mesh<BufferGeometry, ShaderMaterial>;
  private readonly sheet = document.createElement("canvas");
  /** Null in a browser without 2D canvases. */
  private readonly pen = this.sheet.getContext("2d", { willReadFrequently: true });
  private texture = this.newTexture();
  /** What the sheet shows, and where each piece begins on it (pixels of the device). */
  private painted = "";
  private starts: [number, number][] = [];
  private colors = { text: "", quiet: "", surface: "", accent: "" };
  private readonly widths = new Map<string, number>();

  constructor(
    public box: AxesBox,
    private readonly eye: Eye,
  ) {
    const material = new ShaderMaterial({
      vertexShader: VERTEX,
      fragmentShader: FRAGMENT,
      transparent: true,
      depthTest: false,
      depthWrite: false,
      // the sheet's colors are multiplied with their opacity
      blending: CustomBlending,
      blendSrc: OneFactor,
      blendDst: OneMinusSrcAlphaFactor,
      uniforms: {
        map: { value: this.texture },
        resolution: { value: resolution },
        sheet: { value: [1, 1] },
      },
    });
    this.mesh = new Mesh(new BufferGeometry(), material);
    this.mesh.frustumCulled = false;
  }

  /** Puts all texts where they belong in a picture of this size (CSS pixels), this many pixels of the device for one of CSS. */
  suit(width: number, height: number, ratio: number, pointer: Pointer | null): void {
    if (this.pen === null) return;
    const pieces = [
      ...this.box.labels(this.eye).map((label) => this.label(label, width)),
      ...this.marks.map(({ place, text }) => (text === null ? this.ring(place) : this.mark(place, text))),
      ...(pointer === null ? [] : [this.pointer(pointer, width, height)]),
    ];
    const painted = [ratio, ...pieces.map(({ look }) => look)].join("\n");
    if (painted !== this.painted) this.paint(this.pen, pieces, ratio);
    this.painted = painted;
    this.arrange(pieces, ratio);
  }

  /** Takes the colors of the theme in force. */
  ink(): void {
    const [text, quiet, surface, accent] = ["text", "text-quiet", "surface", "accent"].map(themeColor) as [
      string,
      string,
      string,
      string,
    ];
    this.colors = { text, quiet, surface, accent };
    this.painted = "";
  }

  /** Gives its memory of the graphics card back. */
  free(): void {
    this.texture.dispose();
    this.mesh.geometry.dispose();
    this.mesh.material.dispose();
  }

  /** Paints the pieces in rows on the sheet, which grows if it must. */
  private paint(pen: CanvasRenderingContext2D, pieces: Piece[], ratio: number): void {
    const sizes = pieces.map(
      ({ box }) => [Math.ceil(box.width * ratio), Math.ceil(box.height * ratio)] as const,
    );
    const wide = Math.max(Math.ceil(SHEET * ratio), ...sizes.map(([w]) => w));
    let [x, y, row] = [0, 0, 0];
    this.starts = sizes.map(([w, h]) => {
      if (x + w > wide) [x, y, row] = [0, y + row, 0];
      const start: [number, number] = [x, y];
      [x, row] = [x + w, Math.max(row, h)];
      return start;
    });
    const tall = Math.max(1, y + row);
    if (this.sheet.width !== wide || this.sheet.height < tall) {
      [this.sheet.width, this.sheet.height] = [wide, tall];
      this.texture.dispose();
      this.texture = this.newTexture();
      this.mesh.material.uniforms.map!.value = this.texture;
    }
    this.mesh.material.uniforms.sheet!.value = [this.sheet.width, this.sheet.height];
    pen.setTransform(1, 0, 0, 1, 0, 0);
    pen.clearRect(0, 0, this.sheet.width, this.sheet.height);
    pieces.forEach(({ box, paint }, k) => {
      const [left, top] = this.starts[k]!;
      pen.setTransform(ratio, 0, 0, ratio, left - box.left * ratio, top - box.top * ratio);
      pen.textAlign = "center";
      pen.textBaseline = "middle";
      pen.lineJoin = "round";
      paint(pen);
    });
    this.texture.needsUpdate = true;
  }

  /** Two triangles for each piece; they begin at whole pixels, so that texts are sharp. */
  private arrange(pieces: Piece[], ratio: number): void {
    const { geometry } = this.mesh;
    const room = (geometry.getAttribute("corner") as BufferAttribute | undefined)?.count ?? -1;
    if (room < 4 * pieces.length) {
      geometry.dispose();
      for (const name of ["corner", "source"]) {
        const places = new Float32Array(2 * 8 * pieces.length);
        geometry.setAttribute(name, new BufferAttribute(places, 2).setUsage(DynamicDrawUsage));
      }
      const index = Array.from({ length: 2 * pieces.length }, (_, k) =>
        [0, 1, 2, 0, 2, 3].map((c) => 4 * k + c),
      );
      geometry.setIndex(index.flat());
    }
    const [corner, source] = ["corner", "source"].map(
      (name) => geometry.getAttribute(name) as BufferAttribute,
    ) as [BufferAttribute, BufferAttribute];
    pieces.forEach(({ at, box }, k) => {
      const [w, h] = [Math.ceil(box.width * ratio), Math.ceil(box.height * ratio)];
      const [x, y] = [Math.round((at[0] + box.left) * ratio), Math.round((at[1] + box.top) * ratio)];
      const [u, v] = this.starts[k]!;
      corner.array.set([x, y, x, y + h, x + w, y + h, x + w, y], 8 * k);
      source.array.set([u, v, u, v + h, u + w, v + h, u + w, v], 8 * k);
    });
    corner.needsUpdate = true;
    source.needsUpdate = true;
    geometry.setDrawRange(0, 6 * pieces.length);
  }

  private newTexture(): CanvasTexture {
    const texture = new CanvasTexture(this.sheet);
    texture.magFilter = texture.minFilter = NearestFilter;
    texture.generateMipmaps = false;
    texture.flipY = false;
    texture.premultiplyAlpha = true;
    return texture;
  }

  /** How wide a text is (CSS pixels). */
  private widthOf(text: string, font: string): number {
    const key = `${font} ${text}`;
    let width = this.widths.get(key);
    if (width === undefined) {
      // a drag writes ever new numbers
      if (this.widths.size > 500) this.widths.clear();
      this.pen!.font = font;
      width = this.pen!.measureText(text).width;
      this.widths.set(key, width);
    }
    return width;
  }

  /** A number or a name at the axes box. */
  private label(
    { text, x, y, name }: { text: string; x: number; y: number; name: boolean },
    width: number,
  ): Piece {
    const font = name ? NAME : NUMBER;
    const half = this.widthOf(text, font) / 2 + 4;
    const inside = Math.min(Math.max(x, half), width - half);
    return {
      // Moved in if a part of it is cut off; one that is outside stays there.
      at: [Math.abs(inside - x) < 2 * half ? inside : x, y],
      box: { left: -Math.ceil(half), top: -TALL, width: 2 * Math.ceil(half), height: 2 * TALL },
      look: `${font} ${text}`,
      paint: (pen) => {
        pen.font = font;
        pen.fillStyle = name ? this.colors.text : this.colors.quiet;
        pen.fillText(text, 0, 0);
      },
    };
  }

  /** A text with a halo, so that it can be read on the ply. */
  private mark(place: Place, text: string): Piece {
    const half = Math.ceil(this.widthOf(text, MARK) / 2 + 3);
    return {
      at: this.eye.project(new Vector3(...place)),
      box: { left: -half, top: -TALL, width: 2 * half, height: 2 * TALL },
      look: `mark ${text}`,
      paint: (pen) => {
        pen.font = MARK;
        pen.lineWidth = 3.5;
        pen.strokeStyle = this.colors.surface;
        pen.strokeText(text, 0, 0);
        pen.fillStyle = this.colors.text;
        pen.fillText(text, 0, 0);
      },
    };
  }

  /** A ring around a place. */
  private ring(place: Place): Piece {
    return {
      at: this.eye.project(new Vector3(...place)),
      box: { left: -RING, top: -RING, width: 2 * RING, height: 2 * RING },
      look: "ring",
      paint: (pen) => this.paintRing(pen),
    };
  }

  /** A ring around the place and a plate with its label beside it. */
  private pointer({ place, label }: Pointer, width: number, height: number): Piece {
    const [x, y] = this.eye.project(new Vector3(...place));
    const lines = label.split("\n");
    const plate = Math.max(...lines.map((line) => this.widthOf(line, HEADING))) + 18;
    const tall = 17 * lines.length + 9;
    // from the place on
    const left = Math.min(Math.max(x + 22, 6), width - plate - (width < NARROW ? 6 : LEGEND)) - x;
    const top = Math.min(Math.max(y - tall - 18, 6), height - tall - 6) - y;
    const low = [Math.min(left - 1, -RING), Math.min(top - 1, -RING)].map(Math.floor) as [number, number];
    const high = [Math.max(left + plate + 1, RING), Math.max(top + tall + 1, RING)].map(Math.ceil) as [
      number,
      number,
    ];
    return {
      at: [x, y],
      box: { left: low[0], top: low[1], width: high[0] - low[0], height: high[1] - low[1] },
      look: `pointer ${left.toFixed(2)} ${top.toFixed(2)} ${label}`,
      paint: (pen) => {
        this.paintRing(pen);
        pen.fillStyle = this.colors.surface;
        pen.strokeStyle = this.colors.accent;
        pen.lineWidth = 1.5;
        pen.beginPath();
        pen.roundRect(left, top, plate, tall, 5);
        pen.fill();
        pen.stroke();
        pen.beginPath();
        pen.moveTo(9.5, -9.5);
        pen.lineTo(Math.min(Math.max(24, left), left + plate), Math.min(top + tall, Math.max(-18, top)));
        pen.stroke();
        pen.textAlign = "left";
        pen.fillStyle = this.colors.text;
        lines.forEach((line, k) => {
          pen.font = k === 0 ? HEADING : LINE;
          pen.fillText(line, left + 9, top + 13 + 17 * k);
        });
      },
    };
  }

  private paintRing(pen: CanvasRenderingContext2D): void {
    for (const [color, line] of [
      [this.colors.surface, 5],
      [this.colors.accent, 2.5],
    ] as const) {
      pen.strokeStyle = color;
      pen.lineWidth = line;
      pen.beginPath();
      pen.arc(0, 0, 13, 0, 2 * Math.PI);
      pen.stroke();
    }
  }
}
