/**
 * Lines of a given width on the screen: catenaries, the axes box, outlines of the mold.
 *
 * Every segment is a quad, drawn as an instance and smoothed at its sides; ends are written in place.
 */

import {
  BufferAttribute,
  Color,
  DynamicDrawUsage,
  InstancedBufferGeometry,
  InstancedInterleavedBuffer,
  InterleavedBufferAttribute,
  Mesh,
  ShaderMaterial,
  Vector2,
} from "three";
import { PROJECT } from "./shade";

const VERTEX = /* glsl */ `
  attribute vec3 from;
  attribute vec3 to;
  uniform vec2 resolution;
  uniform float width;
  varying float vSide;
  ${PROJECT}
  void main() {
    vec4 a = project(from);
    vec4 b = project(to);
    vec2 along = (b.xy - a.xy) * resolution;
    float run = length(along);
    along = run > 1e-6 ? along / run : vec2(1.0, 0.0);
    // One pixel more than the width, for the smooth sides.
    float half_width = width + 1.0;
    vSide = position.y * half_width;
    vec4 p = position.x < 0.5 ? a : b;
    p.xy += (vec2(-along.y, along.x) * position.y * half_width + along * (position.x * 2.0 - 1.0) * 0.3 * width) / resolution;
    gl_Position = p;
  }
`;

const FRAGMENT = /* glsl */ `
  uniform vec3 colour;
  uniform float opacity;
  uniform float width;
  varying float vSide;
  void main() {
    gl_FragColor = vec4(colour, opacity * clamp(0.5 * (width + 1.0 - abs(vSide)), 0.0, 1.0));
  }
`;

/** Size of the picture in pixels of the device, shared by all lines. */
export const resolution = new Vector2(1, 1);
/** Pixels of the device in one CSS pixel, shared by all lines. */
export const pixelRatio = { value: 1 };

export class Lines {
  readonly mesh: Mesh<InstancedBufferGeometry, ShaderMaterial>;
  /** Two ends of three coordinates for every segment (m). */
  readonly ends: Float32Array;
  private readonly buffer: InstancedInterleavedBuffer;

  /** Room for `segments` lines, `width` CSS pixels wide, pushed back by `push` metres. */
  constructor(
    segments: number,
    private readonly width: number,
    push: number,
  ) {
    this.ends = new Float32Array(6 * segments);
    this.buffer = new InstancedInterleavedBuffer(this.ends, 6, 1).setUsage(DynamicDrawUsage);
    const geometry = new InstancedBufferGeometry();
    const corners = new Float32Array([0, -1, 0, 1, -1, 0, 1, 1, 0, 0, 1, 0]);
    geometry.setIndex([0, 1, 2, 0, 2, 3]);
    geometry.setAttribute("position", new BufferAttribute(corners, 3));
    geometry.setAttribute("from", new InterleavedBufferAttribute(this.buffer, 3, 0));
    geometry.setAttribute("to", new InterleavedBufferAttribute(this.buffer, 3, 3));
    geometry.instanceCount = segments;
    const material = new ShaderMaterial({
      vertexShader: VERTEX,
      fragmentShader: FRAGMENT,
      transparent: true,
      depthWrite: false,
      uniforms: {
        resolution: { value: resolution },
        width: { value: width },
        push: { value: push },
        colour: { value: new Color() },
        opacity: { value: 1 },
      },
    });
    this.mesh = new Mesh(geometry, material);
    this.mesh.frustumCulled = false;
    this.mesh.onBeforeRender = () => {
      material.uniforms.width!.value = this.width * pixelRatio.value;
      material.uniformsNeedUpdate = true;
    };
  }

  /** The ends were written. */
  changed(): void {
    this.buffer.needsUpdate = true;
  }

  ink(colour: string, opacity = 1): void {
    const { uniforms } = this.mesh.material;
    (uniforms.colour!.value as Color).copy(screenColour(colour));
    uniforms.opacity!.value = opacity;
  }
}

/** A CSS colour as the shaders write it: as it is on the screen, not linear. */
export function screenColour(colour: string): Color {
  return new Color().setStyle(colour, "srgb-linear");
}
