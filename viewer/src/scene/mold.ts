/** The mold: a quiet, neutral surface with its borders and sharp edges drawn as thin lines. */

import {
  BufferAttribute,
  BufferGeometry,
  Color,
  DoubleSide,
  EdgesGeometry,
  Group,
  Mesh,
  ShaderMaterial,
} from "three";
import { mergeVertices, toCreasedNormals } from "three/addons/utils/BufferGeometryUtils.js";
import type { MoldData } from "../data/page_data";
import { Lines, screenColor } from "./lines";
import { PROJECT, SHADE } from "./shade";

const VERTEX = /* glsl */ `
  varying float vShade;
  ${PROJECT}
  ${SHADE}
  void main() {
    vShade = mix(0.72, 1.0, (shade(normalMatrix * normal) - 0.74) / 0.32);
    gl_Position = project(position);
  }
`;

const FRAGMENT = /* glsl */ `
  uniform vec3 color;
  varying float vShade;
  void main() {
    gl_FragColor = vec4(color * vShade, 1.0);
  }
`;

/** Above this many triangles sharp edges are not looked for. */
const MANY = 60_000;
/** An edge is sharp from this angle between its faces on. */
const SHARP = 30;

export class Mold {
  readonly group = new Group();
  private readonly surface: Mesh<BufferGeometry, ShaderMaterial>;
  private readonly outline: Lines | null = null;

  constructor(mold: MoldData, push: number) {
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(Float32Array.from(mold.vertices), 3));
    geometry.setIndex(new BufferAttribute(Uint32Array.from(mold.triangles), 1));
    const few = mold.triangles.length / 3 <= MANY;
    let shaded = geometry;
    if (few) shaded = mergeVertices(toCreasedNormals(geometry, (SHARP * Math.PI) / 180));
    else geometry.computeVertexNormals();
    const material = new ShaderMaterial({
      vertexShader: VERTEX,
      fragmentShader: FRAGMENT,
      side: DoubleSide,
      uniforms: { color: { value: new Color() }, push: { value: push } },
    });
    this.surface = new Mesh(shaded, material);
    // After the ply, which hides much of it.
    this.surface.renderOrder = 1;
    this.group.add(this.surface);
    if (few) {
      const edges = new EdgesGeometry(geometry, SHARP).getAttribute("position").array;
      this.outline = new Lines(new Array<number>(edges.length / 6).fill(2), 1, 0.9 * push);
      this.outline.points.set(edges);
      this.outline.changed();
      this.outline.mesh.renderOrder = 2;
      this.group.add(this.outline.mesh);
    }
  }

  /** Gives its memory of the graphics card back. */
  free(): void {
    this.surface.geometry.dispose();
    this.surface.material.dispose();
    this.outline?.free();
  }

  ink(color: string, line: string): void {
    (this.surface.material.uniforms.color!.value as Color).copy(screenColor(color));
    this.outline?.ink(line);
  }
}
