/**
 * Grippers: flat black discs with a light rim, tilted with the ply.
 *
 * A disc is two quads, cut round and smoothed by the shader, and a short wall between them, so that it can
 * also be seen edge-on. One instance a gripper.
 */

import {
  BufferAttribute,
  Color,
  DoubleSide,
  DynamicDrawUsage,
  InstancedBufferAttribute,
  InstancedBufferGeometry,
  Mesh,
  ShaderMaterial,
} from "three";
import { MICRO, type Motion } from "../data/motion";
import { screenColour } from "./lines";
import { PROJECT } from "./shade";

const VERTEX = /* glsl */ `
  attribute vec3 centre;
  attribute vec3 axis;
  uniform float radius;
  varying vec3 vLocal;
  varying float vTowards;
  ${PROJECT}
  void main() {
    vLocal = position;
    vTowards = (normalMatrix * axis).z * position.z;
    vec3 side = normalize(cross(abs(axis.x) < 0.9 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0), axis));
    vec3 other = cross(axis, side);
    gl_Position = project(centre + radius * (position.x * side + position.y * other + position.z * axis));
  }
`;

const FRAGMENT = /* glsl */ `
  uniform vec3 colour;
  uniform vec3 rim;
  varying vec3 vLocal;
  varying float vTowards;
  void main() {
    // The wall is dark, and so is the face that looks away.
    if (abs(vLocal.z) < 0.0799 || vTowards < 0.0) {
      if (length(vLocal.xy) > 0.941) discard;
      gl_FragColor = vec4(colour, 1.0);
      return;
    }
    float r = length(vLocal.xy);
    float soft = clamp(fwidth(r), 0.001, 0.5);
    float inside = clamp((1.0 - r) / soft + 0.5, 0.0, 1.0);
    if (inside < 0.02) discard;
    gl_FragColor = vec4(mix(colour, rim, clamp((r - 0.87) / soft + 0.5, 0.0, 1.0)), inside);
  }
`;

/** Thickness of a disc over its radius, one half. */
const HALF = 0.08;

export class Grippers {
  readonly mesh: Mesh<InstancedBufferGeometry, ShaderMaterial>;
  private readonly centre: InstancedBufferAttribute;
  private readonly axis: InstancedBufferAttribute;

  constructor(
    private readonly motion: Motion,
    radius: number,
    push: number,
  ) {
    const { count } = motion.grippers;
    const dynamic = () =>
      new InstancedBufferAttribute(new Float32Array(3 * count), 3).setUsage(DynamicDrawUsage);
    this.centre = dynamic();
    this.axis = dynamic();
    const geometry = disc();
    geometry.setAttribute("centre", this.centre);
    geometry.setAttribute("axis", this.axis);
    geometry.instanceCount = count;
    const material = new ShaderMaterial({
      vertexShader: VERTEX,
      fragmentShader: FRAGMENT,
      side: DoubleSide,
      transparent: true,
      uniforms: {
        colour: { value: new Color() },
        rim: { value: new Color() },
        radius: { value: radius },
        push: { value: push },
      },
    });
    this.mesh = new Mesh(geometry, material);
    this.mesh.frustumCulled = false;
  }

  ink(colour: string, rim: string): void {
    const { uniforms } = this.mesh.material;
    (uniforms.colour!.value as Color).copy(screenColour(colour));
    (uniforms.rim!.value as Color).copy(screenColour(rim));
  }

  moveTo(step: number): void {
    const positions = this.motion.grippers.at(step);
    const normals = this.motion.normals.at(step);
    const [centre, axis] = [this.centre.array, this.axis.array];
    for (let k = 0; k < positions.length; k++) {
      centre[k] = positions[k]! * MICRO;
      axis[k] = normals[k]! * 1e-4;
    }
    this.centre.needsUpdate = true;
    this.axis.needsUpdate = true;
  }
}

/** Two quads and a wall of 24 faces, in units of the radius. */
function disc(): InstancedBufferGeometry {
  const points: number[] = [];
  const index: number[] = [];
  const quad = (...corners: number[][]) => {
    const k = points.length / 3;
    points.push(...corners.flat());
    index.push(k, k + 1, k + 2, k, k + 2, k + 3);
  };
  const faces = 24;
  for (let k = 0; k < faces; k++) {
    const [a, b] = [k, k + 1].map((s) => (2 * Math.PI * s) / faces) as [number, number];
    const at = (angle: number, z: number) => [0.94 * Math.cos(angle), 0.94 * Math.sin(angle), z];
    quad(at(a, -HALF), at(b, -HALF), at(b, HALF), at(a, HALF));
  }
  for (const z of [-HALF, HALF]) quad([-1, -1, z], [1, -1, z], [1, 1, z], [-1, 1, z]);
  const geometry = new InstancedBufferGeometry();
  geometry.setIndex(index);
  geometry.setAttribute("position", new BufferAttribute(Float32Array.from(points), 3));
  return geometry;
}
