/**
 * The cell: what the grippers carry, what stands there, and the tool of a robot, if one carries the grippers.
 *
 * Bodies are drawn through, with their rims as lines, so that they do not hide the ply. Each is a list of triangles in
 * the coordinates of what it is mounted on; they are placed anew in every step.
 */

import {
  BufferAttribute,
  BufferGeometry,
  Color,
  DoubleSide,
  DynamicDrawUsage,
  EdgesGeometry,
  Group,
  Mesh,
  ShaderMaterial,
} from "three";
import { MICRO } from "../data/micro";
import type { CellData, Solid } from "../data/page_data";
import { Lines, screenColor } from "./lines";
import { PROJECT, SHADE } from "./shade";

const VERTEX = /* glsl */ `
  varying vec3 vView;
  ${PROJECT}
  void main() {
    vView = (modelViewMatrix * vec4(position, 1.0)).xyz;
    gl_Position = project(position);
  }
`;

const FRAGMENT = /* glsl */ `
  uniform vec3 color;
  uniform float opacity;
  varying vec3 vView;
  ${SHADE}
  void main() {
    float light = shade(cross(dFdx(vView), dFdy(vView)));
    gl_FragColor = vec4(color * mix(0.72, 1.0, (light - 0.74) / 0.32), opacity);
  }
`;

/** An edge is sharp from this angle between its faces on: the rims of a cylinder are, its sides are not. */
const SHARP = 30;
const OPACITY = { moving: 0.28, standing: 0.55 };

/** Seven integers: a place in micrometers, and a quaternion in millionths. */
type Origin = Int32Array;
const STANDS: Origin = Int32Array.from([0, 0, 0, 0, 0, 0, 1e6]);

/** Triangles and rims of one solid, once for each of its origins. */
interface Part {
  vertices: number[];
  rims: number[];
  origins: number[];
}

export class Cell {
  readonly group = new Group();
  private readonly moving: Solids | null;
  private readonly standing: Solids | null;
  private readonly tool: Lines | null;
  private readonly arm: Lines | null;

  constructor(
    private readonly cell: CellData,
    private readonly grippers: number,
    push: number,
  ) {
    const { bodies, obstacles, mounts, links } = cell;
    const every = Array.from({ length: grippers }, (_, n) => n);
    const origins = {
      pad: every,
      stem: every.map((n) => grippers + n),
      flange: mounts === null ? [] : [2 * grippers],
    };
    const places = (on: (typeof bodies)[number]["on"]) =>
      typeof on === "string" ? origins[on] : [2 * grippers + 1 + on.link];
    const parts = bodies.map((body) => part(body, places(body.on)));
    this.moving = parts.length === 0 ? null : new Solids(parts, OPACITY.moving, push);
    const fixed = obstacles.map((obstacle) => part(obstacle, [0]));
    this.standing = fixed.length === 0 ? null : new Solids(fixed, OPACITY.standing, push);
    this.standing?.place(() => STANDS);
    this.tool = mounts === null ? null : new Lines(new Array<number>(grippers).fill(3), 1.2, 0.5 * push);
    // from link to link, and to the flange
    this.arm = links === 0 ? null : new Lines([links + 1], 2.4, 0.5 * push);
    for (const solids of [this.standing, this.moving]) if (solids !== null) this.group.add(solids.group);
    if (this.tool !== null) {
      this.tool.mesh.renderOrder = 7;
      this.group.add(this.tool.mesh);
    }
    if (this.arm !== null) {
      this.arm.mesh.renderOrder = 7;
      this.group.add(this.arm.mesh);
    }
  }

  ink(color: string, line: string): void {
    this.moving?.ink(color, line);
    this.standing?.ink(color, line);
    this.tool?.ink(line);
    this.arm?.ink(line);
  }

  /** Places what moves, by the origins of a step. */
  moveTo(all: Int32Array): void {
    const origin = (n: number) => all.subarray(7 * n, 7 * n + 7);
    this.moving?.place(origin);
    const { mounts, links } = this.cell;
    if (this.tool === null || mounts === null) return;
    // from the flange to where the frame holds a gripper, and along its axes to the gripper
    const flange = origin(2 * this.grippers);
    for (let n = 0; n < this.grippers; n++) {
      write(this.tool.points, 9 * n, [0, 0, 0], 0, flange);
      write(this.tool.points, 9 * n + 3, mounts, 3 * n, flange);
      write(this.tool.points, 9 * n + 6, [0, 0, 0], 0, origin(this.grippers + n));
    }
    this.tool.changed();
    if (this.arm === null) return;
    for (let n = 0; n <= links; n++) {
      write(this.arm.points, 3 * n, [0, 0, 0], 0, n < links ? origin(2 * this.grippers + 1 + n) : flange);
    }
    this.arm.changed();
  }
}

/** Solids that are drawn alike. */
class Solids {
  readonly group = new Group();
  private readonly mesh: Mesh<BufferGeometry, ShaderMaterial>;
  private readonly position: BufferAttribute;
  private readonly rims: Lines;

  constructor(
    private readonly parts: Part[],
    opacity: number,
    push: number,
  ) {
    const size = parts.reduce((sum, { vertices, origins }) => sum + vertices.length * origins.length, 0);
    this.position = new BufferAttribute(new Float32Array(size), 3).setUsage(DynamicDrawUsage);
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", this.position);
    const material = new ShaderMaterial({
      vertexShader: VERTEX,
      fragmentShader: FRAGMENT,
      side: DoubleSide,
      transparent: true,
      depthWrite: false,
      uniforms: { color: { value: new Color() }, opacity: { value: opacity }, push: { value: push } },
    });
    this.mesh = new Mesh(geometry, material);
    this.mesh.frustumCulled = false;
    this.mesh.renderOrder = 6;
    const rims = parts.reduce((sum, { rims, origins }) => sum + (rims.length / 6) * origins.length, 0);
    this.rims = new Lines(new Array<number>(rims).fill(2), 1, 0.9 * push);
    this.rims.mesh.renderOrder = 7;
    this.group.add(this.mesh, this.rims.mesh);
  }

  ink(color: string, line: string): void {
    (this.mesh.material.uniforms.color!.value as Color).copy(screenColor(color));
    this.rims.ink(line);
  }

  place(origin: (n: number) => Origin): void {
    const positions = this.position.array as Float32Array;
    let [vertex, rim] = [0, 0];
    for (const { vertices, rims, origins } of this.parts) {
      for (const n of origins) {
        const at = origin(n);
        for (let k = 0; k < vertices.length; k += 3, vertex += 3) write(positions, vertex, vertices, k, at);
        for (let k = 0; k < rims.length; k += 3, rim += 3) write(this.rims.points, rim, rims, k, at);
      }
    }
    this.position.needsUpdate = true;
    this.rims.changed();
  }
}

/** A solid as corners of triangles side by side, and its sharp edges. */
function part(solid: Solid, origins: number[]): Part {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(Float32Array.from(solid.vertices), 3));
  geometry.setIndex(solid.triangles);
  const rims = Array.from(new EdgesGeometry(geometry, SHARP).getAttribute("position").array);
  const vertices = solid.triangles.flatMap((corner) => solid.vertices.slice(3 * corner, 3 * corner + 3));
  return { vertices, rims, origins };
}

/** Writes a point (m) that is given in the coordinates of an origin. */
function write(to: Float32Array, start: number, from: number[], k: number, origin: Origin): void {
  const [x, y, z] = [from[k]!, from[k + 1]!, from[k + 2]!];
  const [a, b, c, w] = [origin[3]! * 1e-6, origin[4]! * 1e-6, origin[5]! * 1e-6, origin[6]! * 1e-6];
  // v + 2 q × (q × v + w v)
  const [s, t, u] = [b * z - c * y + w * x, c * x - a * z + w * y, a * y - b * x + w * z];
  to[start] = origin[0]! * MICRO + x + 2 * (b * u - c * t);
  to[start + 1] = origin[1]! * MICRO + y + 2 * (c * s - a * u);
  to[start + 2] = origin[2]! * MICRO + z + 2 * (a * t - b * s);
}
