/**
 * Lines of a given width on the screen: catenaries, the axes box, outlines of the mold.
 *
 * Each point of a curve is two vertices, one on either side of the line; the shader moves them apart, square to
 * the curve's tangent, and smooths the sides. Buffers are written in place. No instances: software renderers
 * draw them one by one.
 */

import {
  BufferAttribute,
  BufferGeometry,
  Color,
  DoubleSide,
  DynamicDrawUsage,
  Mesh,
  ShaderMaterial,
  Vector2,
} from "three";
import { PROJECT } from "./shade";

const VERTEX = /* glsl */ `
  attribute vec3 tangent3;
  attribute float side;
  uniform vec2 resolution;
  uniform float width;
  varying float vSide;
  #ifdef TIMED
    attribute float time;
    varying float vTime;
  #endif
  ${PROJECT}
  void main() {
    #ifdef TIMED
      vTime = time;
    #endif
    vec4 here = project(position);
    vec2 along = (projectionMatrix * (modelViewMatrix * vec4(tangent3, 0.0))).xy * resolution;
    float run = length(along);
    along = run > 1e-6 ? along / run : vec2(1.0, 0.0);
    // One pixel more than the width, for the smooth sides.
    float half_width = width + 1.0;
    vSide = side * half_width;
    here.xy += vec2(-along.y, along.x) * vSide / resolution;
    gl_Position = here;
  }
`;

const FRAGMENT = /* glsl */ `
  uniform vec3 color;
  uniform float opacity;
  uniform float width;
  varying float vSide;
  #ifdef TIMED
    uniform float now;
    uniform vec3 later;
    varying float vTime;
  #endif
  void main() {
    vec4 ink = vec4(color, opacity);
    #ifdef TIMED
      if (vTime > now) ink = vec4(later, 0.55 * opacity);
    #endif
    ink.a *= clamp(0.5 * (width + 1.0 - abs(vSide)), 0.0, 1.0);
    gl_FragColor = ink;
  }
`;

/** Size of the picture in pixels of the device, shared by all lines. */
export const resolution = new Vector2(1, 1);
/** Pixels of the device in one CSS pixel, shared by all lines. */
export const pixelRatio = { value: 1 };

export class Lines {
  readonly mesh: Mesh<BufferGeometry, ShaderMaterial>;
  /** Three coordinates for every point, curve after curve (m); call `changed` after writing. */
  readonly points: Float32Array;
  private readonly position: BufferAttribute;
  private readonly every: BufferAttribute;
  private stride = 1;
  /** Share of the full width, for pictures in which there is little room between lines. */
  weight = 1;
  private readonly tangent: BufferAttribute;

  /**
   * Curves with this many points each, `width` CSS pixels wide, pushed back by `push` meters. With `times`, one for each point,
   * what is later than `now` has a color of its own.
   */
  constructor(
    private readonly lengths: number[],
    private readonly width: number,
    push: number,
    times: number[] | null = null,
  ) {
    const total = lengths.reduce((sum, length) => sum + length, 0);
    this.points = new Float32Array(3 * total);
    this.position = new BufferAttribute(new Float32Array(6 * total), 3).setUsage(DynamicDrawUsage);
    this.tangent = new BufferAttribute(new Float32Array(6 * total), 3).setUsage(DynamicDrawUsage);
    const geometry = new BufferGeometry();
    this.every = new BufferAttribute(quads(lengths, 1), 1);
    geometry.setIndex(this.every);
    geometry.setAttribute("position", this.position);
    geometry.setAttribute("tangent3", this.tangent);
    const sides = Float32Array.from({ length: 2 * total }, (_, k) => (k % 2 === 0 ? -1 : 1));
    geometry.setAttribute("side", new BufferAttribute(sides, 1));
    if (times !== null) {
      const twice = times.flatMap((time) => [time, time]);
      geometry.setAttribute("time", new BufferAttribute(Float32Array.from(twice), 1));
    }
    const material = new ShaderMaterial({
      defines: times === null ? {} : { TIMED: "" },
      vertexShader: VERTEX,
      fragmentShader: FRAGMENT,
      transparent: true,
      depthWrite: false,
      side: DoubleSide,
      uniforms: {
        resolution: { value: resolution },
        width: { value: width },
        push: { value: push },
        color: { value: new Color() },
        opacity: { value: 1 },
        now: { value: 0 },
        later: { value: new Color() },
      },
    });
    this.mesh = new Mesh(geometry, material);
    this.mesh.frustumCulled = false;
    this.mesh.onBeforeRender = () => {
      material.uniforms.width!.value = this.width * this.weight * pixelRatio.value;
      material.uniformsNeedUpdate = true;
    };
  }

  /** Draws through every point of each curve, or, which is less work, through some: one in `stride`. */
  thin(stride: number): void {
    if (stride === this.stride) return;
    this.stride = stride;
    const { geometry } = this.mesh;
    geometry.setIndex(stride === 1 ? this.every : new BufferAttribute(quads(this.lengths, stride), 1));
  }

  /** The points were written. */
  changed(): void {
    const { points } = this;
    const [position, tangent] = [this.position.array, this.tangent.array];
    let start = 0;
    for (const length of this.lengths) {
      const last = start + length - 1;
      for (let k = start; k <= last; k++) {
        const before = 3 * Math.max(k - 1, start);
        const after = 3 * Math.min(k + 1, last);
        for (let c = 0; c < 3; c++) {
          position[6 * k + c] = position[6 * k + 3 + c] = points[3 * k + c]!;
          tangent[6 * k + c] = tangent[6 * k + 3 + c] = points[after + c]! - points[before + c]!;
        }
      }
      start += length;
    }
    this.position.needsUpdate = true;
    this.tangent.needsUpdate = true;
  }

  /** Gives its memory of the graphics card back. */
  free(): void {
    this.mesh.geometry.dispose();
    this.mesh.material.dispose();
  }

  ink(color: string, opacity = 1, later = color): void {
    const { uniforms } = this.mesh.material;
    (uniforms.color!.value as Color).copy(screenColor(color));
    (uniforms.later!.value as Color).copy(screenColor(later));
    uniforms.opacity!.value = opacity;
  }

  /** The time that parts what was from what comes. */
  set now(time: number) {
    this.mesh.material.uniforms.now!.value = time;
  }
}

/** Two triangles for each piece of each curve; a piece runs over this many points, and the last ends at the end. */
function quads(lengths: number[], stride: number): Uint32Array {
  const index: number[] = [];
  let start = 0;
  for (const length of lengths) {
    const last = start + length - 1;
    for (let k = start; k < last; k += stride) {
      const [a, b] = [2 * k, 2 * Math.min(k + stride, last)];
      index.push(a, b, a + 1, a + 1, b, b + 1);
    }
    start += length;
  }
  return Uint32Array.from(index);
}

/** A CSS color as the shaders write it: as it is on the screen, not linear. */
export function screenColor(color: string): Color {
  return new Color().setStyle(color, "srgb-linear");
}
