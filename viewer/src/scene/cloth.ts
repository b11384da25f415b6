/**
 * How the ply is painted, by both models: colors looked up in a map, fabric lines, and a mild shade.
 *
 * The geometry gives `share`, the place of each vertex in the color map, or `corners`, those of all four corners of
 * its cell; below zero there is no value, and the ply is gray. `thread` counts fabric lines: one is drawn at every
 * whole number.
 */

import { Color, DataTexture, DoubleSide, NearestFilter, ShaderMaterial } from "three";
import { colorAt, mapOf } from "../data/color_map";
import type { Field } from "../data/page_data";
import { PROJECT, SHADE } from "./shade";

const VERTEX = /* glsl */ `
  #ifdef CORNERS
    attribute vec4 corners;
    flat varying vec4 vCorners;
  #else
    attribute float share;
    varying float vShare;
  #endif
  attribute vec2 thread;
  varying vec2 vThread;
  varying float vShade;
  ${PROJECT}
  ${SHADE}
  void main() {
    #ifdef CORNERS
      vCorners = corners;
    #else
      vShare = share;
    #endif
    vThread = thread;
    vShade = shade(normalMatrix * normal);
    gl_Position = project(position);
  }
`;

const FRAGMENT = /* glsl */ `
  uniform sampler2D map;
  uniform bool threads;
  uniform vec3 unknown;
  varying vec2 vThread;
  varying float vShade;
  #ifdef CORNERS
    flat varying vec4 vCorners;
    // Between the corners that have a value; none where the nearest corner has none.
    float share() {
      vec2 a = vThread;
      vec4 weight = vec4((1.0 - a.x) * (1.0 - a.y), a.x * (1.0 - a.y), a.x * a.y, (1.0 - a.x) * a.y);
      float nearest = a.x < 0.5 ? (a.y < 0.5 ? vCorners.x : vCorners.w) : (a.y < 0.5 ? vCorners.y : vCorners.z);
      weight *= step(-0.5, vCorners);
      return nearest < -0.5 ? -1.0 : dot(weight, vCorners) / max(dot(weight, vec4(1.0)), 1e-6);
    }
  #else
    varying float vShare;
    float share() { return vShare; }
  #endif
  void main() {
    float here = share();
    vec3 color = here < -0.5 ? unknown : texture2D(map, vec2(clamp(here, 0.0, 0.9999), 0.5)).rgb;
    color *= vShade;
    // Threads of the fabric, where they are far enough apart to be seen.
    if (threads) {
      vec2 width = fwidth(vThread);
      vec2 away = abs(fract(vThread - 0.5) - 0.5) / width;
      float line = 1.0 - min(min(away.x, away.y), 1.0);
      float room = clamp(0.36 - 1.1 * max(width.x, width.y), 0.0, 0.26);
      color = mix(color, vec3(1.0), line * room);
    }
    gl_FragColor = vec4(color, 1.0);
  }
`;

/** Colors in the map: so many that none need be mixed, which is dear in software. */
const TEXELS = 512;

/** The gray of a ply without a value. */
const UNKNOWN = new Color(0.68, 0.7, 0.73);

/** The material of a ply that is pushed back by `push` (m), with values at vertices or at the corners of cells. */
export function clothMaterial(push: number, on: "vertices" | "corners" = "vertices"): ShaderMaterial {
  return new ShaderMaterial({
    defines: on === "corners" ? { CORNERS: "" } : {},
    vertexShader: VERTEX,
    fragmentShader: FRAGMENT,
    side: DoubleSide,
    uniforms: {
      map: { value: null },
      push: { value: push },
      threads: { value: true },
      unknown: { value: UNKNOWN },
    },
  });
}

/** Loads the color map of a field. */
export function useMap(material: ShaderMaterial, field: Field): void {
  const map = mapOf(field);
  const texels = new Uint8Array(4 * TEXELS);
  for (let k = 0; k < TEXELS; k++) texels.set([...colorAt(map, k / (TEXELS - 1)), 255], 4 * k);
  const texture = new DataTexture(texels, TEXELS, 1);
  texture.magFilter = texture.minFilter = NearestFilter;
  texture.needsUpdate = true;
  const uniform = material.uniforms.map!;
  (uniform.value as DataTexture | null)?.dispose();
  uniform.value = texture;
}
