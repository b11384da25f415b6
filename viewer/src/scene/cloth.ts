/**
 * How the ply is painted, by both models: colours looked up in a map, fabric lines, and a mild shade.
 *
 * The geometry gives `share`, the place of each vertex in the colour map; below zero there is no value, and the ply is
 * grey. `thread` counts fabric lines: one is drawn at every whole number.
 */

import { DataTexture, DoubleSide, NearestFilter, ShaderMaterial } from "three";
import { colourAt, mapOf } from "../data/colour_map";
import type { Field } from "../data/page_data";
import { PROJECT, SHADE } from "./shade";

const VERTEX = /* glsl */ `
  attribute float share;
  attribute vec2 thread;
  varying float vShare;
  varying vec2 vThread;
  varying float vShade;
  ${PROJECT}
  ${SHADE}
  void main() {
    vShare = share;
    vThread = thread;
    vShade = shade(normalMatrix * normal);
    gl_Position = project(position);
  }
`;

const FRAGMENT = /* glsl */ `
  uniform sampler2D map;
  uniform bool threads;
  varying float vShare;
  varying vec2 vThread;
  varying float vShade;
  void main() {
    vec3 colour = texture2D(map, vec2(clamp(vShare, 0.0, 0.9999), 0.5)).rgb * vShade;
    if (vShare < -1e-3) colour = vec3(0.62, 0.64, 0.67) * vShade;
    // Threads of the fabric, where they are far enough apart to be seen.
    if (threads) {
      vec2 width = fwidth(vThread);
      vec2 away = abs(fract(vThread - 0.5) - 0.5) / width;
      float line = 1.0 - min(min(away.x, away.y), 1.0);
      float room = clamp(0.36 - 1.1 * max(width.x, width.y), 0.0, 0.26);
      colour = mix(colour, vec3(1.0), line * room);
    }
    gl_FragColor = vec4(colour, 1.0);
  }
`;

/** Colours in the map: so many that none need be mixed, which is dear in software. */
const TEXELS = 512;

/** The material of a ply that is pushed back by `push` (m). */
export function clothMaterial(push: number): ShaderMaterial {
  return new ShaderMaterial({
    vertexShader: VERTEX,
    fragmentShader: FRAGMENT,
    side: DoubleSide,
    uniforms: { map: { value: null }, push: { value: push }, threads: { value: true } },
  });
}

/** Loads the colour map of a field. */
export function useMap(material: ShaderMaterial, field: Field): void {
  const map = mapOf(field);
  const texels = new Uint8Array(4 * TEXELS);
  for (let k = 0; k < TEXELS; k++) texels.set([...colourAt(map, k / (TEXELS - 1)), 255], 4 * k);
  const texture = new DataTexture(texels, TEXELS, 1);
  texture.magFilter = texture.minFilter = NearestFilter;
  texture.needsUpdate = true;
  const uniform = material.uniforms.map!;
  (uniform.value as DataTexture | null)?.dispose();
  uniform.value = texture;
}
