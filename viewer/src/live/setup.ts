/**
 * What the reader has set: where the grippers are, the mold, the material. It becomes a scene, which the solver reads as
 * `plydrape simulate` would, and the end of the page's address.
 */

import type { Place } from "../data/page_data";
import { inScene, MATERIALS } from "./materials";

/** Grippers along u and v, and fabric between neighbors (m): the paper's example. */
export const GRID = [4, 2] as const;
export const CELL = 0.1;
/** How far apart they start, and how high (m). */
const SPACING = 0.098;
const HEIGHT = 0.075;
/** The shear at the end of the paper's motion (rad). */
const SHEAR = (20 * Math.PI) / 180;
/** The middle of the ply at the start: there every mold has its middle. */
const MIDDLE = [0.147, 0.049] as const;

export const KINDS = ["plane", "cylinder", "sphere", "saddle"] as const;
export type Kind = (typeof KINDS)[number];
export const RULES = ["min-force", "moment-balance"] as const;
export type Rule = (typeof RULES)[number];

export interface Setup {
  /** Where the grippers are (m), u running fastest. */
  grippers: Place[];
  kind: Kind;
  /** Height of the middle of the mold (mm). */
  height: number;
  /** Radius of a mold that is not flat (mm). */
  radius: number;
  /** Slope of a flat one along x (°). */
  tilt: number;
  material: string;
  /** Mass and rigidity as multiples of the material's. */
  mass: number;
  rigidity: number;
  slopes: Rule;
}

/** A number of a setup: its ends, and whether equal ratios are equally far apart on its slider. */
export interface Range {
  key: "height" | "radius" | "tilt" | "mass" | "rigidity";
  low: number;
  high: number;
  digits: number;
  ratios: boolean;
}

export const RANGES: Record<Range["key"], Range> = {
  height: { key: "height", low: -100, high: 70, digits: 0, ratios: false },
  radius: { key: "radius", low: 100, high: 2000, digits: 0, ratios: true },
  tilt: { key: "tilt", low: -25, high: 25, digits: 1, ratios: false },
  mass: { key: "mass", low: 0.25, high: 4, digits: 2, ratios: true },
  rigidity: { key: "rigidity", low: 0.1, high: 10, digits: 2, ratios: true },
};

/** A value of a range, rounded and inside its ends. */
export function fit({ low, high, digits }: Range, value: number): number {
  return Math.min(Math.max(Number(value.toFixed(digits)), low), high);
}

const micrometers = (place: Place): Place => place.map((c) => Math.round(c * 1e6) / 1e6) as Place;

/** A place for each gripper, by its column and row. */
function each(at: (i: number, j: number) => Place): Place[] {
  const columns = Array.from({ length: GRID[0] }, (_, i) => i);
  const rows = Array.from({ length: GRID[1] }, (_, j) => j);
  return rows.flatMap((j) => columns.map((i) => at(i, j)));
}

/** The grippers a share of the way along the paper's motion, from the level start to the sheared ply on the mold. */
export function along(share: number): Place[] {
  const between = (a: number, b: number) => a + share * (b - a);
  return each((i, j) =>
    micrometers([
      between(i * SPACING, i * CELL + j * CELL * Math.sin(SHEAR)),
      between(j * SPACING, j * CELL * Math.cos(SHEAR)),
      between(HEIGHT, 0),
    ]),
  );
}

/** The start of the paper's example. */
export function start(): Setup {
  return {
    grippers: along(0),
    kind: "plane",
    height: 0,
    radius: 300,
    tilt: 0,
    material: "krogh2018",
    mass: 1,
    rigidity: 1,
    slopes: "min-force",
  };
}

/** The setup with a gripper elsewhere. */
export function moved(setup: Setup, gripper: number, to: Place): Setup {
  const grippers = setup.grippers.map((place, k) => (k === gripper ? micrometers(to) : place));
  return { ...setup, grippers };
}

/** Whether two setups have the same mold. */
export function sameMold(a: Setup, b: Setup): boolean {
  return a.kind === b.kind && a.height === b.height && a.radius === b.radius && a.tilt === b.tilt;
}

/** The table `[mold]`. */
function mold({ kind, height, radius, tilt }: Setup): string[] {
  const [x, y] = MIDDLE;
  const z = height / 1000;
  const r = radius / 1000;
  const place = (up: number) => `[${x}, ${y}, ${Number(up.toFixed(6))}]`;
  switch (kind) {
    case "plane": {
      const heading = tilt < 0 ? ['tilt_direction = "180 deg"'] : [];
      const slope = tilt === 0 ? [] : [`tilt = "${Math.abs(tilt)} deg"`, ...heading];
      return ['kind = "plane"', `point = ${place(z)}`, ...slope];
    }
    case "cylinder":
      return [
        'kind = "cylinder"',
        `radius = ${r}`,
        `position = ${place(z - r)}`,
        'rotation = [0, 0, "90 deg"]           # its axis along y',
      ];
    case "sphere":
      return ['kind = "sphere"', `radius = ${r}`, `position = ${place(z - r)}`];
    case "saddle":
      return ['kind = "saddle"', `radii = [${r}, ${r}]`, `position = ${place(z)}`];
  }
}

/** The scene that says so: a ply that is held, by the catenaries. */
export function sceneOf(setup: Setup): string {
  const rows = Array.from({ length: GRID[1] }, (_, j) =>
    setup.grippers
      .slice(j * GRID[0], (j + 1) * GRID[0])
      .map((place) => `[${place.join(", ")}]`)
      .join(", "),
  );
  return [
    "# Written by the live page of plydrape: a ply that is held. `plydrape simulate` gives the same forces.",
    'title = "Ply of the live page"',
    "",
    "[ply]",
    `grippers = [${GRID.join(", ")}]`,
    'cell = ["100 mm", "100 mm"]',
    ...inScene(setup.material, setup.mass, setup.rigidity),
    "",
    "[mold]",
    ...mold(setup),
    "",
    "[grippers]",
    "positions = [                        # m, a row for each line of grippers along u",
    ...rows.map((row) => `  [${row}],`),
    "]",
    "",
    "[model]",
    'kind = "catenaries"',
    `slopes = "${setup.slopes}"`,
    "gravity = 9.8                        # m/s^2",
    "",
    "[contact]",
    'tolerance = "1 mm"',
    'end = "free"',
    "",
  ].join("\n");
}

/** The end of the address that says so, in micrometers and the units of the sliders. */
export function hashOf(setup: Setup): string {
  const { grippers, ...rest } = setup;
  const standard = start();
  const said = new URLSearchParams();
  const places = grippers
    .flat()
    .map((c) => Math.round(c * 1e6))
    .join("_");
  if (
    places !==
    standard.grippers
      .flat()
      .map((c) => Math.round(c * 1e6))
      .join("_")
  )
    said.set("g", places);
  for (const [key, value] of Object.entries(rest)) {
    if (value !== standard[key as keyof typeof rest]) said.set(key, String(value));
  }
  return said.toString();
}

/** The setup that an address asks for; what it does not say, or says wrongly, is that of the start. */
export function ofHash(hash: string): Setup {
  const said = new URLSearchParams(hash.replace(/^#/, ""));
  const setup = start();
  const places = said.get("g")?.split("_").map(Number) ?? [];
  if (places.length === 3 * GRID[0] * GRID[1] && places.every((c) => Math.abs(c) < 1e7)) {
    setup.grippers = setup.grippers.map((_, k) =>
      micrometers(places.slice(3 * k, 3 * k + 3).map((c) => c / 1e6) as Place),
    );
  }
  for (const range of Object.values(RANGES)) {
    const value = Number(said.get(range.key) ?? NaN);
    if (Number.isFinite(value)) setup[range.key] = fit(range, value);
  }
  setup.kind = KINDS.find((kind) => kind === said.get("kind")) ?? setup.kind;
  setup.slopes = RULES.find((rule) => rule === said.get("slopes")) ?? setup.slopes;
  const material = said.get("material") ?? "";
  if (Object.hasOwn(MATERIALS, material)) setup.material = material;
  return setup;
}
