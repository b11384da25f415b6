/**
 * What the page is given: one JSON object, written by the program.
 *
 * The page shows these numbers and computes no mechanics. It knows no measure and no limit by name: which there are, in which
 * order, with which words and units, the data say. Everything that belongs to a step is a list with one entry a step; positions
 * over the steps are packed in blocks (`block.ts`).
 */

export type Place = [number, number, number];
/** Column and row of a gripper. */
export type GripperId = [number, number];
/** What a color mode is found by; which there are, and their names, the data say. */
export type FieldKey = string;
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
  /** Key of the measure that it limits. */
  key: string;
  name: string;
  /** The value in other units, where it is slack. */
  note: string | null;
  value: number;
  limit: number;
  unit: string;
  /** The limit is the least allowed, not the most. */
  least: boolean;
  ok: boolean;
  /** The value as a multiple of its limit: beyond 1 it is exceeded. */
  ratio: number;
  /** About the motion as a whole, not about the ply of a step. */
  motion: boolean;
  step: number | null;
  where: string;
  place: Place | null;
}

/** One quantity over the steps: a column of steps.csv. */
export interface Measure {
  key: string;
  label: string;
  unit: string;
  values: (number | null)[];
  where: (string | null)[];
  places: (Place | null)[];
  /** Null where nothing is judged by it. */
  limit: number | null;
  least: boolean;
}

/** A color mode: what it shows, on vertices or on cells, and its range over all steps. */
export interface Field {
  key: FieldKey;
  /** In a few words, for its button. */
  name: string;
  label: string;
  unit: string;
  on: "vertex" | "cell";
  /** On a scale of orders equal ratios are equally far apart; what lies beyond its ends has their colors. */
  scale: "even" | "orders";
  low: number;
  high: number;
  /** Key of the measure that is the worst of its values. */
  measure: string | null;
  limit: number | null;
}

/** Triangles (m). */
export interface MoldData {
  vertices: number[];
  triangles: number[];
}

/** A body of triangles with a name (m). */
export interface Solid extends MoldData {
  name: string;
}

/** What the grippers carry, what stands in the cell, and the tool of a robot. */
export interface CellData {
  /** In the coordinates of what they move with. */
  bodies: (Solid & { on: "pad" | "stem" | "flange" | { link: number } })[];
  obstacles: Solid[];
  /** Where the tool holds each gripper with its strokes at zero, in the coordinates of the flange; null without a tool. */
  mounts: number[] | null;
  /** How many links of an arm there are, its foot among them; 0 where it is not known. */
  links: number;
}

/** What the vacuum of some grippers does at a time (s). */
export interface VacuumEvent {
  time: number;
  kind: "grip" | "press" | "release";
  grippers: string[];
}

/** A measure of every gripper in every step. */
export interface ReadingData {
  label: string;
  unit: string;
  /** The most that is allowed; null where nothing is judged by it. */
  limit: number | null;
  /** Values in one of the unit. */
  fine: number;
  values: Block;
}

/** The grippers over the steps: micrometers and ten-thousandths. */
export interface GrippersData {
  positions: Block;
  normals: Block;
  /** What the numbers of `forces` count (N). */
  force_unit: number;
  /** Of the ply on the grippers. */
  forces: Block;
  /** Whether each pad holds the ply, 1 or 0; null where all of them always do. */
  holds: Block | null;
  readings: ReadingData[];
  /**
   * Thousandths of the limits that the loads use, along the ply and across it, -1 without a limit; null of a model that judges
   * nothing.
   */
  used: Block | null;
}

/** The ply as a net of catenaries. Micrometers and hundredths of a degree. */
export interface CatenariesData {
  /** Grippers along u and v; zeros where catenaries make no surface. */
  grid: [number, number];
  /** Fabric between neighboring grippers along u and v (mm). */
  pitch: [number, number];
  divisions: number;
  surface: Block;
  gap: Block | null;
  /** Fiber lines where they are no lines of a surface: the grid is zero, and cups hold that are no whole array. */
  fibers: Block | null;
  diagonals: Block;
  shear: Block;
  direction: Block;
  contacts: { counts: number[]; points: Block };
}

/** The ply as a sheet. Micrometers, hundredths of a degree, millionths of strain and mN/m. */
export interface SheetData {
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
  /** Height at the end that the needed share of the cells of the sample keeps at each node; one step. */
  spread: Block | null;
}

/** A cell of which a part is ply: rings, in shares of its sides from its first corner, and the cell whose values it has. */
export interface CutCell {
  nodes: [number, number, number, number];
  cell: number;
  rings: [number, number][][];
}

/** The drape by one model. */
export interface DrapeData {
  model: Model;
  /** Numbers of the steps in which the ply is drawn. */
  drawn: number[];
  /** For each step of the page that the model has done, the first ones, which of the drawn ones is the nearest. */
  pictures: number[];
  measures: Measure[];
  fields: Field[];
  grippers: GrippersData;
  /** The pads, the stems, of a tool the flange, and of an arm its links: a place in micrometers and a quaternion in millionths. */
  origins: Block | null;
  catenaries: CatenariesData | null;
  sheet: SheetData | null;
}

/** The verdict over a sample of cells, each with errors of its own. */
export interface SampleData {
  /** Cells that keep every limit. */
  accepted: number;
  ok: boolean;
  /** What the sample says of all cells, and with which confidence, as text. */
  words: string;
  /** The share of the cells that must keep the limits, as text. */
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

/** What is drawn of a scene before anything is draped on its mold (m). */
export interface Look {
  /** The boundary of the ply and of its holes where they must end on the mold. */
  outline: Place[][];
  /** Arrows along the warp from the middle of the ply, on the table and on the mold. */
  warp: Place[][];
  /** Where the cups shall end. */
  targets: Place[];
  /** Cups of the array that do not hold the ply, at the start. */
  off: Place[];
}

/** The drape of the same motion by another program, beside that of the sheet. */
export interface PeerData {
  name: string;
  /** Of the end and of the first touch: words, the sheet's value, the other program's, as text. */
  ends: [string, string, string][];
  /** What the other drape took, in a sentence. */
  cost: string;
  courses: PeerCourse[];
  /** Where the same fabric point is farthest apart. */
  farthest: { step: number; node: number; uv_mm: [number, number]; apart_mm: number } | null;
}

/** Two values over the steps; null in steps whose states were not kept. */
export interface PeerCourse {
  key: string;
  label: string;
  unit: string;
  first: (number | null)[];
  /** What the second one is called. */
  name: string;
  second: (number | null)[];
}

export interface PageData {
  format: string;
  version: number;
  /** Version of the result files that it can be compared with. */
  result_version: number;
  program: string;
  title: string;
  input: string | null;
  facts: { label: string; value: string }[];
  /** The verdict of the model that decides. */
  accepted: boolean;
  /** In which world, as it follows the word accepted: " without errors"; empty where it was judged with errors. */
  world: string;
  /** Why its end does not count. */
  ended: string | null;
  steps: number[];
  times: number[];
  /** The first step in which the ply touches the mold. */
  first_contact: number | null;
  /** Column and row of each gripper. */
  ids: GripperId[];
  /** Every limit of the model that decides, the closest first. */
  limits: Limit[];
  /** The drape by the model that decides. */
  drape: DrapeData;
  /** The drape by the other model, if it was asked for: shown for comparison, and judging nothing. */
  also: DrapeData | null;
  mold: MoldData | null;
  cell: CellData | null;
  /** When pads grip, press and let go; empty where they hold the ply from first to last. */
  events: VacuumEvent[];
  sample: SampleData | null;
  /** What the motion tolerates, line by line. */
  tolerance: string[];
  /** What is shown of a scene that is not draped yet, in place of a verdict. */
  look?: Look;
  /** The drape of the same motion by another program, if it was compared. */
  peer?: PeerData;
  left_out: string[];
}

/** Data that cannot be shown; the message completes the sentence "This page cannot be shown: …". */
export class BrokenData extends Error {}

const LISTS = ["facts", "steps", "times", "ids", "limits", "events", "left_out"] as const;

/** The version of the data that this page reads. */
const VERSION = 4;

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
  const data = found as PageData;
  if (data.steps.length === 0) throw new BrokenData("its data has no step");
  if (data.times.length !== data.steps.length)
    throw new BrokenData(`it has ${data.steps.length} steps but ${data.times.length} times`);
  checkDrape(data, data.drape);
  if (data.also !== null) checkDrape(data, data.also);
  if (data.also !== null && data.also.model === data.drape.model) {
    throw new BrokenData("the drape for comparison is by the model that decides");
  }
  if (data.sample !== null) checkSample(data.sample);
  for (const { key, first, second } of data.peer?.courses ?? []) {
    if (first.length !== data.steps.length || second.length !== data.steps.length)
      throw new BrokenData(`the course “${key}” of the compared drape does not fit its steps`);
  }
  return data;
}

/** Whether a block has this many items in this many steps; none is as it should be. */
const fits = (block: Block | null | undefined, steps: number, count: number): boolean =>
  block === null || (block?.data !== undefined && block.steps === steps && block.count === count);

function checkDrape(data: PageData, drape: Partial<DrapeData> | undefined): void {
  if (drape === undefined || (drape.model !== "sheet" && drape.model !== "catenaries")) {
    throw new BrokenData("the drape by the model that decides is missing in its data");
  }
  const { model, drawn, pictures, measures, fields, grippers } = drape;
  for (const list of [drawn, pictures, measures, fields]) {
    if (!Array.isArray(list)) throw new BrokenData(`a list of the ${model} is missing in its data`);
  }
  const count = data.steps.length;
  for (const { key, values } of measures!) {
    if (!Array.isArray(values) || values.length !== count) {
      throw new BrokenData(`measure “${key}” does not have one value for each of ${count} steps`);
    }
  }
  if (pictures!.length > count || pictures!.some((picture) => drawn![picture] === undefined)) {
    throw new BrokenData(`the pictures of the ${model} do not fit its steps`);
  }
  const steps = grippers?.positions.steps ?? -1;
  const pads = grippers && [
    grippers.positions,
    grippers.normals,
    grippers.forces,
    grippers.holds,
    grippers.used,
    ...grippers.readings.map(({ values }) => values),
  ];
  const whole =
    pads?.every((block) => fits(block, steps, data.ids.length)) === true && grippers!.force_unit > 0;
  if (!whole || steps > count || (pictures!.length > 0 && pictures!.length !== steps)) {
    throw new BrokenData(`the grippers of the ${model} do not fit its steps`);
  }
  const links = data.cell?.links ?? 0;
  const bodies = 2 * data.ids.length + ((data.cell?.mounts ?? null) === null ? 0 : 1) + links;
  const known = ({ on }: { on: unknown }) => typeof on !== "object" || (on as { link: number }).link < links;
  if (
    (data.cell === null) !== (drape.origins === null) ||
    !fits(drape.origins, steps, bodies) ||
    data.cell?.bodies.every(known) === false
  ) {
    throw new BrokenData("the bodies of its cell do not fit its grippers and steps");
  }
  if (drape.catenaries) checkCatenaries(drape.catenaries, drawn!.length);
  if (drape.sheet) checkSheet(drape.sheet, drawn!.length);
}

function checkCatenaries(catenaries: CatenariesData, drawn: number): void {
  const [nu, nv] = catenaries.grid;
  const n = catenaries.divisions;
  const none = nu === 0;
  const cells = none ? 0 : (nu - 1) * (nv - 1);
  const vertices = none ? 0 : ((nu - 1) * n + 1) * ((nv - 1) * n + 1);
  const expected = {
    surface: vertices,
    gap: vertices,
    shear: cells,
    direction: cells,
  };
  for (const [name, count] of Object.entries(expected)) {
    if (!fits(catenaries[name as keyof typeof expected], drawn, count)) {
      throw new BrokenData(`the ${name} of its catenaries does not fit ${nu} × ${nv} grippers`);
    }
  }
  // diagonals may be left out to keep the page small
  const { count } = catenaries.diagonals;
  if (count !== 0 && (none ? count % (n + 1) !== 0 : count !== 2 * cells * (n + 1))) {
    throw new BrokenData(`the diagonals of its catenaries do not fit ${nu} × ${nv} grippers`);
  }
  if (catenaries.contacts.counts.length !== drawn) {
    throw new BrokenData("the contacts of its catenaries do not fit its steps");
  }
}

function checkSample(sample: Partial<SampleData> | undefined): void {
  if (!Array.isArray(sample?.cells) || !Array.isArray(sample.limits)) {
    throw new BrokenData("the cells of its sample are missing");
  }
}

function checkSheet(sheet: SheetData, drawn: number): void {
  const nodes = sheet.landing.length;
  const cells = sheet.cells.length / 4;
  const fit =
    [sheet.positions, sheet.height, sheet.contact].every((block) => fits(block, drawn, nodes)) &&
    [sheet.shear, sheet.strain, sheet.tension].every((block) => fits(block, drawn, cells)) &&
    [sheet.places, sheet.spread].every((block) => fits(block, 1, nodes));
  const corners =
    sheet.cells.every((node) => node < nodes) &&
    sheet.cut.every((cut) => cut.cell < cells && cut.nodes.every((node) => node < nodes));
  if (!fit || !corners) throw new BrokenData("the states of its sheet do not fit each other");
}

/** Index of a step, or of the one nearest to it if it was left out; -1 for none. */
export function nearest(steps: number[], step: number | null): number {
  if (step === null) return -1;
  const away = steps.map((number) => Math.abs(number - step));
  return away.indexOf(Math.min(...away));
}

/** The drape by a model, or by the one that decides if that was not draped. */
export function drapeOf(data: PageData, model: Model): DrapeData {
  return data.also?.model === model ? data.also : data.drape;
}

/** Whether a model is shown for comparison and does not decide. */
export function isBeside(data: PageData, model: Model): boolean {
  return data.also?.model === model;
}

/** A model in words, with what it is good for. */
export function modelText(data: PageData, model: Model): string {
  return isBeside(data, model) ? `${model} (for comparison, judges nothing)` : model;
}

/** What colors can tell of a model. */
export function fieldsOf(data: PageData, model: Model): Field[] {
  return drapeOf(data, model).fields;
}

/** The name of a gripper, as in all files: `g2_0`. */
export function gripperName([i, j]: GripperId): string {
  return `g${String(i)}_${String(j)}`;
}
