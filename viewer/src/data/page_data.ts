/**
 * What the page is given: one JSON object, written by the program.
 *
 * The page shows these numbers and computes no mechanics. Everything that belongs to a step is a list with
 * one entry a step; positions over the steps are packed in blocks (`block.ts`).
 */

export type Place = [number, number, number];
/** Column and row of a gripper. */
export type GripperId = [number, number];
export type FieldKey =
  "height" | "gap" | "shear" | "direction" | "over_mold" | "spread" | "strain" | "landing";
/** The two models of the ply. */
export type Model = "sheet" | "catenaries";

/** Integers [steps][count][components], packed (see `block.ts`) or, of a live solver, as they are. */
export interface Block {
  steps: number;
  count: number;
  components: number;
  data: string | number[];
}

/** One line of the table of limits. */
export interface Limit {
  name: string;
  /** The same in other units, where it is slack. */
  note: string | null;
  value: number;
  limit: number;
  unit: string;
  /** The limit is the least allowed, not the most. */
  least: boolean;
  ok: boolean;
  /** The value as a multiple of its limit: beyond 1 it is exceeded. */
  ratio: number;
  /** One of the motion, which counts with every model. */
  motion: boolean;
  step: number | null;
  where: string;
  place: Place | null;
  /** Key of the measure that it limits, where there is one. */
  measure: string | null;
}

/** What a source says of the strength that the angles at the end cost. */
export interface StrengthNote {
  angles: string;
  text: string;
  source: string;
}

/** One quantity with a value in every step: a column of steps.csv. */
export interface Measure {
  key: string;
  label: string;
  unit: string;
  values: (number | null)[];
  where: (string | null)[];
  places: (Place | null)[];
  limit: number | null;
  least: boolean;
}

/** A color mode: what it shows, on vertices or on cells, and its range over all steps. */
export interface Field {
  key: FieldKey;
  label: string;
  unit: string;
  on: "vertex" | "cell";
  /** On a scale of orders equal ratios are equally far apart; what lies beyond its ends has their colors. */
  scale: "even" | "orders";
  low: number;
  high: number;
  limit: number | null;
}

export interface Geometry {
  surface: Block;
  gap: Block | null;
  /** Fiber lines where they are no lines of a surface: the grid is zero, and cups hold that are no whole array. */
  fibres: Block | null;
  diagonals: Block;
  grippers: Block;
  normals: Block;
  shear: Block;
  direction: Block;
  contacts: { counts: number[]; points: Block };
  mold: { vertices: number[]; triangles: number[] } | null;
}

/** A body of triangles with a name (m). */
export interface Solid {
  name: string;
  vertices: number[];
  triangles: number[];
}

/** What the grippers carry, what stands in the cell, and the tool of a robot. */
export interface CellData {
  /** In the coordinates of what they move with. */
  bodies: (Solid & { on: "pad" | "stem" | "flange" })[];
  obstacles: Solid[];
  /** Where the tool holds each gripper with its strokes at zero, in the coordinates of the flange; null without a tool. */
  mounts: number[] | null;
  /** The pads, the stems, and of a tool the flange: a place in micrometers and a quaternion in millionths. */
  origins: Block;
}

/** What the vacuum of some grippers does at a time (s). */
export interface VacuumEvent {
  time: number;
  kind: "grip" | "press" | "release";
  grippers: string[];
}

/** The ply as a sheet. Micrometers, hundredths of a degree, millionths of strain, mN/m and micronewtons. */
export interface SheetData {
  /** All of its own limits hold, and it is at rest. */
  accepted: boolean;
  /** Why its end does not count. */
  ended: string | null;
  nodes: number;
  /** For each step of the page the state that is shown in it. */
  states: (number | null)[];
  limits: Limit[];
  fields: Field[];
  /** Corners of the cells, four each. */
  cells: number[];
  /** Cells that the boundary of the ply cuts: drawn in place of those with the same corners. */
  cut: CutCell[];
  /** Step in which each node landed for good, 0 for never. */
  landing: number[];
  /** Fabric coordinates of the nodes; one step. */
  places: Block;
  positions: Block;
  height: Block | null;
  contact: Block;
  /** Of cells; strain and tension are those of the yarn beside the cell that is strained most. */
  shear: Block;
  strain: Block;
  tension: Block;
  grippers: Block;
  normals: Block;
  /** What the numbers of `forces` count (N). */
  force_unit: number;
  /** Of the sheet on the pads. */
  forces: Block;
  /** Whether each pad holds the ply, 1 or 0; null where all of them always do. */
  holds: Block | null;
  /** The largest loads that a gripper may have (N): along the ply, off the pad, and as a whole. */
  allowed: { along: number | null; across: number | null; whole: number | null };
  /** Thousandths of them that the loads use, along the ply and across it; -1 without a limit. */
  used: Block;
  /** Height at the end that the needed share of the cells of the sample keeps at each node; one step. */
  spread: Block | null;
}

/** A cell of which a part is ply: rings, in shares of its sides from its first corner, and the cell whose values it has. */
export interface CutCell {
  nodes: [number, number, number, number];
  cell: number;
  rings: [number, number][][];
}

/** The verdict over a sample of cells, each with errors of its own. */
export interface SampleData {
  /** Cells that keep every limit, and how many must. */
  accepted: number;
  needed: number;
  ok: boolean;
  /** The share of the cells that must, as text. */
  share: string;
  /** Largest height of each at the end (mm); null of catenaries and without an end. */
  cells: { accepted: boolean; height_mm: number | null; ratio: number }[];
  height_limit: number | null;
  limits: Limit[];
  highest: {
    height_mm: number;
    uv_mm: [number, number];
    line: string;
    gripper: string;
    node: number | null;
  } | null;
}

export interface PageData {
  format: string;
  version: number;
  program: string;
  title: string;
  input: string | null;
  facts: { label: string; value: string }[];
  accepted: boolean;
  /** Somebody broke the drape off before its last step. */
  interrupted: boolean;
  /** Why the drape ended where no ply would have survived it; null if it did not. */
  stopped: string | null;
  steps: number[];
  times: number[];
  /** Grippers along u and v; zeros where catenaries make no surface. */
  grid: [number, number];
  /** Fabric between neighboring grippers along u and v (mm). */
  pitch: [number, number];
  /** Column and row of each gripper. */
  ids: GripperId[];
  divisions: number;
  limits: Limit[];
  /** What published data say of such angles, for information, and what they are not. */
  strength: { notes: StrengthNote[]; warning: string };
  measures: Measure[];
  fields: Field[];
  geometry: Geometry;
  cell: CellData | null;
  /** When pads grip, press and let go; empty where they hold the ply from first to last. */
  events: VacuumEvent[];
  /** The sheet, which decides, if it was draped. */
  sheet: SheetData | null;
  sample: SampleData | null;
  /** The largest errors that the motion stands, in words. */
  stands: string | null;
  left_out: string[];
}

/** Whether catenaries hang between the cups. */
export const hasCatenaries = (data: PageData): boolean =>
  !data.grid.includes(0) || data.geometry.fibres !== null;

/** Whether the catenaries span a surface: neither a strip nor cups that are no whole array do. */
export const hasSurface = (data: PageData): boolean => data.grid.every((count) => count > 1);

/** Data that cannot be shown; the message completes the sentence "This page cannot be shown: …". */
export class BrokenData extends Error {}

const LISTS = [
  "facts",
  "steps",
  "times",
  "grid",
  "pitch",
  "ids",
  "limits",
  "measures",
  "fields",
  "events",
  "left_out",
] as const;
const BLOCKS = ["surface", "diagonals", "grippers", "normals", "shear", "direction"] as const;

/** The version of the data that this page reads. */
const VERSION = 2;

/** The page's data from its text, checked as far as a wrong file would show. */
export function readPageData(text: string): PageData {
  try {
    return checked(JSON.parse(text) as Partial<PageData> | null);
  } catch (error) {
    if (error instanceof BrokenData) throw error;
    throw new BrokenData("its data is cut off or damaged");
  }
}

/** The same data, if it is that of a page and whole as far as can be seen. */
export function checked(found: Partial<PageData> | null): PageData {
  if (typeof found !== "object" || found?.format !== "plydrape-page") {
    throw new BrokenData("its data is not that of a results page");
  }
  if (found.version !== VERSION) {
    throw new BrokenData(
      `its data has version ${String(found.version)}, and this page reads version ${String(VERSION)}`,
    );
  }
  for (const key of LISTS) {
    if (!Array.isArray(found[key])) throw new BrokenData(`the list “${key}” is missing in its data`);
  }
  if (!Array.isArray(found.strength?.notes)) {
    throw new BrokenData("what is published of strength is missing in its data");
  }
  const data = found as PageData;
  checkLengths(data);
  checkGeometry(data);
  if (data.cell !== null) checkCell(data, data.cell);
  if (data.sheet !== null) checkSheet(data, data.sheet);
  if (data.sample !== null) checkSample(data.sample);
  return data;
}

function checkCell(data: PageData, cell: CellData): void {
  const expected = 2 * data.ids.length + (cell.mounts === null ? 0 : 1);
  if (cell.origins.count !== expected || cell.origins.steps !== data.steps.length) {
    throw new BrokenData("the bodies of its cell do not fit its grippers and steps");
  }
}

function checkLengths(data: PageData): void {
  const count = data.steps.length;
  if (count === 0) throw new BrokenData("its data has no step");
  if (data.times.length !== count)
    throw new BrokenData(`it has ${count} steps but ${data.times.length} times`);
  for (const { key, values } of data.measures) {
    if (!Array.isArray(values) || values.length !== count) {
      throw new BrokenData(`measure “${key}” does not have one value for each of ${count} steps`);
    }
  }
}

function checkGeometry(data: PageData): void {
  const geometry = data.geometry as Partial<Geometry> | undefined;
  if (typeof geometry !== "object") throw new BrokenData("its geometry is missing");
  for (const name of BLOCKS) {
    if (geometry[name]?.data === undefined) throw new BrokenData(`the ${name} of its geometry is missing`);
  }
  if (!Array.isArray(geometry.contacts?.counts))
    throw new BrokenData("the contacts of its geometry are missing");
  const [nu, nv] = data.grid;
  const n = data.divisions;
  const none = nu === 0;
  const cells = none ? 0 : (nu - 1) * (nv - 1);
  const expected: Record<(typeof BLOCKS)[number], number> = {
    surface: none ? 0 : ((nu - 1) * n + 1) * ((nv - 1) * n + 1),
    diagonals: 2 * cells * (n + 1),
    grippers: data.ids.length,
    normals: data.ids.length,
    shear: cells,
    direction: cells,
  };
  for (const name of BLOCKS) {
    const block = data.geometry[name];
    // Diagonals may be left out to keep the page small.
    if (name === "diagonals" && (block.count === 0 || (none && block.count % (n + 1) === 0))) continue;
    if (block.count !== expected[name] || block.steps !== data.steps.length) {
      throw new BrokenData(
        `the ${name} of its geometry do not fit ${data.ids.length} grippers and ${data.steps.length} steps`,
      );
    }
  }
}

function checkSample(sample: Partial<SampleData> | undefined): void {
  if (!Array.isArray(sample?.cells) || !Array.isArray(sample.limits)) {
    throw new BrokenData("the cells of its sample are missing");
  }
}

function checkSheet(data: PageData, sheet: SheetData): void {
  const nodes = sheet.landing.length;
  const cells = sheet.cells.length / 4;
  const count = sheet.positions.steps;
  const expected: [Block | null, number][] = [
    [sheet.positions, nodes],
    [sheet.height, nodes],
    [sheet.contact, nodes],
    [sheet.shear, cells],
    [sheet.strain, cells],
    [sheet.tension, cells],
    [sheet.forces, sheet.grippers.count],
    [sheet.holds, sheet.grippers.count],
    [sheet.normals, sheet.grippers.count],
    [sheet.used, sheet.grippers.count],
  ];
  const fit = expected.every(
    ([block, of]) => block === null || (block.count === of && block.steps === count),
  );
  const known = sheet.states.every((state) => state === null || state < count);
  const corners =
    sheet.cells.every((node) => node < nodes) &&
    sheet.cut.every((cut) => cut.cell < cells && cut.nodes.every((node) => node < nodes));
  const pads = sheet.grippers.count === data.geometry.grippers.count;
  if (
    !fit ||
    !known ||
    !corners ||
    !pads ||
    !(sheet.force_unit > 0) ||
    sheet.places.count !== nodes ||
    (sheet.spread !== null && sheet.spread.count !== nodes) ||
    sheet.states.length !== data.steps.length
  ) {
    throw new BrokenData("the states of its sheet do not fit each other");
  }
}

/** The limits that count: with a sheet its own and those of the motion. */
export function deciding(data: PageData): Limit[] {
  return data.sheet === null
    ? data.limits
    : [...data.sheet.limits, ...data.limits.filter((limit) => limit.motion)];
}

/** Index of a step, or of the one nearest to it if it was left out; -1 for none. */
export function nearest(steps: number[], step: number | null): number {
  if (step === null) return -1;
  const away = steps.map((number) => Math.abs(number - step));
  return away.indexOf(Math.min(...away));
}

/** What colors can tell of a model. */
export function fieldsOf(data: PageData, model: Model): Field[] {
  return model === "sheet" && data.sheet !== null ? data.sheet.fields : data.fields;
}

/** The name of a gripper, as in all files: `g2_0`. */
export function gripperName([i, j]: GripperId): string {
  return `g${String(i)}_${String(j)}`;
}
