/**
 * Pieces of shaders that everything drawn shares.
 *
 * Parallel projection, so a shift along the line of sight moves nothing on the screen and only decides what
 * lies in front: the mold is pushed back a little, the ply less, and lines and discs are pulled forward.
 * Shading is mild, so that colors stay close to those of the legend.
 */

/** View position and clip position of a point in meters; `push` (m) shifts it away from the eye. */
export const PROJECT = /* glsl */ `
  uniform float push;
  vec4 project(vec3 point) {
    vec4 view = modelViewMatrix * vec4(point, 1.0);
    view.z -= push;
    return projectionMatrix * view;
  }
`;

/** Light from the upper left behind the eye, on both sides of a surface; computed at vertices, which is cheap. */
export const SHADE = /* glsl */ `
  float shade(vec3 normal) {
    vec3 n = normalize(normal);
    if (n.z < 0.0) n = -n;
    return mix(0.74, 1.06, max(dot(n, vec3(-0.32, 0.48, 0.82)), 0.0));
  }
`;
