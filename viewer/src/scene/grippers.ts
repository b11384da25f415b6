/**
 * Grippers: flat black discs with a light rim, tilted with the ply.
 *
 * A disc is two quads, cut round and smoothed by the shader, and a short wall between them, so that it can
 * also be seen edge-on. Every vertex knows its disc's center and axis, which are written in place.
 */

import {
  BufferAttribute,
  BufferGeometry,
  Color,
  DoubleSide,
  DynamicDrawUsage,
  Mesh,
  ShaderMaterial,
} from "three";
import { MICRO } from "../data/micro";
import { screenColor } from "./lines";
import { PROJECT } from "./shade";

/** Thickness of a disc over its radius, one half. */
const HALF = 0.06;
/** Faces of the wall. */
const FACES = 14;

const VERTEX = /* glsl */ `
  attribute vec3 local;
  attribute vec3 axis;
  uniform float radius;
  varying vec3 vLocal;
  varying float vTowards;
  ${PROJECT}
  void main() {
    vLocal = local;
    vTowards = (normalMatrix * axis).z * local.z;
    vec3 side = normalize(cross(abs(axis.x) < 0.9 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0), axis));
    vec3 other = cross(axis, side);
    gl_Position = project(position + radius * (local.x * side + local.y * other + local.z * axis));
  }
`;

const FRAGMENT = /* glsl */ `
  uniform vec3 color;
  uniform vec3 rim;
  varying vec3 vLocal;
  varying float vTowards;
  void main() {
    // The wall is dark, and so is the face that looks away.
    if (abs(vLocal.z) < ${(0.999 * HALF).toFixed(5)} || vTowards < 0.0) {
      if (length(vLocal.xy) > 0.941) discard;
      gl_FragColor = vec4(color, 1.0);
      return;
    }
    float r = length(vLocal.xy);
    float soft = clamp(fwidth(r), 0.001, 0.5);
    float inside = clamp((1.0 - r) / soft + 0.5, 0.0, 1.0);
    if (inside < 0.02) discard;
    gl_FragColor = vec4(mix(color, rim, clamp((r - 0.89) / soft + 0.5, 0.0, 1.0)), inside);
  }
`;

export class Grippers {
  readonly mesh: Mesh<BufferGeometry, ShaderMaterial>;
  private readonly center: BufferAttribute;
  private readonly axis: BufferAttribute;
  /** Corners of the quads in the index; those of the walls follow. */
  private readonly quads: number;

  constructor(
    count: number,
    private readonly radius: number,
    push: number,
  ) {
    const { points, quads, wall } = disc();
    const size = points.length / 3;
    const dynamic = () =>
      new BufferAttribute(new Float32Array(count * points.length), 3).setUsage(DynamicDrawUsage);
    this.center = dynamic();
    this.axis = dynamic();
    const locals = new Float32Array(count * points.length);
    for (let k = 0; k < count; k++) locals.set(points, k * points.length);
    // All quads first, then all walls, so that the walls can be left out.
    const faces = [quads, wall].map((part) =>
      Array.from({ length: count }, (_, k) => part.map((corner) => corner + k * size)).flat(),
    );
    this.quads = faces[0]!.length;
    const geometry = new BufferGeometry();
    geometry.setIndex(faces.flat());
    geometry.setAttribute("position", this.center);
    geometry.setAttribute("axis", this.axis);
    geometry.setAttribute("local", new BufferAttribute(locals, 3));
    const material = new ShaderMaterial({
      vertexShader: VERTEX,
      fragmentShader: FRAGMENT,
      side: DoubleSide,
      transparent: true,
      uniforms: {
        color: { value: new Color() },
        rim: { value: new Color() },
        radius: { value: radius },
        push: { value: push },
      },
    });
    this.mesh = new Mesh(geometry, material);
    this.mesh.frustumCulled = false;
  }

  ink(color: string, rim: string): void {
    const { uniforms } = this.mesh.material;
    (uniforms.color!.value as Color).copy(screenColor(color));
    (uniforms.rim!.value as Color).copy(screenColor(rim));
  }

  /** Leaves the walls out where they would be less than a pixel high, at this many CSS pixels a meter. */
  showWalls(zoom: number): void {
    this.mesh.geometry.setDrawRange(0, this.radius * zoom * 2 * HALF < 1 ? this.quads : Infinity);
  }

  /** Moves them to packed positions and normals. */
  moveTo(positions: Int32Array, normals: Int32Array): void {
    const [center, axis] = [this.center.array, this.axis.array];
    const size = center.length / positions.length;
    for (let k = 0; k < center.length; k += 3) {
      const from = 3 * Math.floor(k / (3 * size));
      for (let c = 0; c < 3; c++) {
        center[k + c] = positions[from + c]! * MICRO;
        axis[k + c] = normals[from + c]! * 1e-4;
      }
    }
    this.center.needsUpdate = true;
    this.axis.needsUpdate = true;
  }
}

/** Two quads and a wall, in units of the radius. */
function disc(): { points: number[]; quads: number[]; wall: number[] } {
  const points: number[] = [];
  const wall: number[] = [];
  const quads: number[] = [];
  for (let k = 0; k < FACES; k++) {
    const angle = (2 * Math.PI * k) / FACES;
    const [x, y] = [0.94 * Math.cos(angle), 0.94 * Math.sin(angle)];
    points.push(x, y, -HALF * 0.998, x, y, HALF * 0.998);
    const [a, b] = [2 * k, 2 * ((k + 1) % FACES)];
    wall.push(a, b, b + 1, a, b + 1, a + 1);
  }
  for (const z of [-HALF, HALF]) {
    const k = points.length / 3;
    points.push(-1, -1, z, 1, -1, z, 1, 1, z, -1, 1, z);
    quads.push(k, k + 1, k + 2, k, k + 2, k + 3);
  }
  return { points, quads, wall };
}
