/** Contact points: open red circles of one size on the screen, as in the paper's figure. */

import { BufferAttribute, BufferGeometry, Color, DynamicDrawUsage, Points, ShaderMaterial } from "three";
import type { CatenaryStates } from "../data/catenary_states";
import { MICRO } from "../data/micro";
import { pixelRatio, screenColor } from "./lines";
import { PROJECT } from "./shade";

const VERTEX = /* glsl */ `
  uniform float size;
  ${PROJECT}
  void main() {
    gl_Position = project(position);
    gl_PointSize = size;
  }
`;

const FRAGMENT = /* glsl */ `
  uniform vec3 color;
  uniform float size;
  uniform float line;
  void main() {
    float r = length(gl_PointCoord - 0.5) * size;
    float away = abs(r - (0.5 * size - line));
    float inside = clamp(0.5 * line + 0.5 - away, 0.0, 1.0);
    if (inside < 0.02) discard;
    gl_FragColor = vec4(color, inside);
  }
`;

/** Diameter at most and at least, and line (CSS pixels). */
const LARGEST = 9;
const SMALLEST = 4;
const LINE = 1.3;

export class Contacts {
  readonly points: Points<BufferGeometry, ShaderMaterial>;
  private position: BufferAttribute;
  private size = LARGEST;

  constructor(
    private readonly states: CatenaryStates,
    push: number,
  ) {
    const geometry = new BufferGeometry();
    this.position = makeRoom(geometry, states.mostContacts);
    const material = new ShaderMaterial({
      vertexShader: VERTEX,
      fragmentShader: FRAGMENT,
      transparent: true,
      depthWrite: false,
      uniforms: {
        color: { value: new Color() },
        size: { value: LARGEST },
        line: { value: LINE },
        push: { value: push },
      },
    });
    this.points = new Points(geometry, material);
    this.points.frustumCulled = false;
    this.points.onBeforeRender = () => {
      material.uniforms.size!.value = this.size * pixelRatio.value;
      material.uniforms.line!.value = LINE * pixelRatio.value;
      material.uniformsNeedUpdate = true;
    };
  }

  ink(color: string): void {
    (this.points.material.uniforms.color!.value as Color).copy(screenColor(color));
  }

  /** Smaller circles where neighboring grippers are less than this many CSS pixels apart. */
  suit(apart: number): void {
    this.size = Math.min(Math.max(apart / 15, SMALLEST), LARGEST);
  }

  moveTo(picture: number): void {
    const points = this.states.contacts(picture);
    if (points.length > this.position.array.length)
      this.position = makeRoom(this.points.geometry, points.length / 3);
    const { array } = this.position;
    for (let k = 0; k < points.length; k++) array[k] = points[k]! * MICRO;
    this.position.needsUpdate = true;
    this.points.geometry.setDrawRange(0, points.length / 3);
  }
}

/** Gives a geometry positions for this many points. */
function makeRoom(geometry: BufferGeometry, points: number): BufferAttribute {
  const position = new BufferAttribute(new Float32Array(3 * Math.max(1, points)), 3);
  geometry.setAttribute("position", position.setUsage(DynamicDrawUsage));
  return position;
}
