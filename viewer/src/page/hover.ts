/** What lies under the pointer, or under the finger after a tap: a node with its values, or a gripper with its state and loads. */

import { vertexPlace } from "../data/fabric_line";
import type { Motion } from "../data/motion";
import { quantity, short } from "../data/number";
import { deciding, fieldsOf, gripperName, type Place } from "../data/page_data";
import { valueOf } from "../data/ranges";
import type { Found, Scene3d } from "../scene/scene3d";
import { make } from "./dom";
import type { Choice, State } from "./state";

/** Distance of the plate from the pointer (CSS pixels). */
const AWAY = 16;
/** A press that moves no farther (CSS pixels) and lasts no longer (ms) is a tap. */
const TAP = { away: 8, time: 500 };

/** A line of the plate; the one that the colors show stands out. */
interface Row {
  label: string;
  value: string;
  coloured?: boolean;
}

/** Shows a plate over a view; `tapped` hears of clicks and taps on the ply. */
export function linkHover(
  view: HTMLElement,
  state: State,
  motion: Motion,
  scene: Scene3d,
  tapped: (found: Found) => void,
): void {
  const plate = make("div", { class: "hover" });
  plate.hidden = true;
  const note = make("p", { class: "no-state" }, "There is no state of the sheet in this step.");
  view.append(plate, note);
  let pointer: [number, number] | null = null;
  let pressed: { at: [number, number]; time: number } | null = null;
  let waiting = false;

  const show = () => {
    waiting = false;
    const { now } = state;
    const none = pointer === null || now.playing || isEmpty(motion, now);
    const found = none ? null : scene.under(pointer!);
    plate.hidden = found === null;
    if (found === null || pointer === null) return;
    const [title, rows] = found.kind === "node" ? ofNode(motion, now, found) : ofGripper(motion, now, found);
    const list = make("dl");
    for (const { label, value, coloured } of rows) {
      const kind: Record<string, string> = coloured === true ? { class: "coloured" } : {};
      list.append(make("dt", kind, label), make("dd", kind, value));
    }
    plate.replaceChildren(make("b", {}, title), list);
    const [x, y] = pointer;
    const [wide, tall] = [
      view.clientWidth - plate.offsetWidth - 4,
      view.clientHeight - plate.offsetHeight - 4,
    ];
    // beside the pointer, or where there is no room beside it above or below
    const right = x + AWAY <= wide;
    const beside = right || x - AWAY - plate.offsetWidth >= 4;
    const left = right ? x + AWAY : beside ? x - AWAY - plate.offsetWidth : Math.min(Math.max(x, 4), wide);
    const below = y + AWAY <= tall ? y + AWAY : y - AWAY - plate.offsetHeight;
    const top = Math.min(Math.max(beside ? y - plate.offsetHeight / 2 : below, 4), tall);
    plate.style.translate = `${String(Math.max(left, 0))}px ${String(Math.max(top, 0))}px`;
  };
  const later = () => {
    if (waiting) return;
    waiting = true;
    requestAnimationFrame(show);
  };
  const placeOf = (event: PointerEvent): [number, number] => {
    const box = view.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };
  view.addEventListener("pointermove", (event) => {
    // a finger shows by a tap, and what it shows stays until the picture moves
    if (event.pointerType === "touch") {
      if (pressed !== null && far(pressed.at, placeOf(event))) pointer = null;
    } else pointer = event.buttons === 0 ? placeOf(event) : null;
    later();
  });
  view.addEventListener("pointerdown", (event) => {
    pressed = event.isPrimary ? { at: placeOf(event), time: event.timeStamp } : null;
  });
  view.addEventListener("pointerup", (event) => {
    const at = placeOf(event);
    const tap = pressed !== null && !far(pressed.at, at) && event.timeStamp - pressed.time < TAP.time;
    pressed = null;
    if (!tap || event.button !== 0) return;
    pointer = at;
    later();
    const found = isEmpty(motion, state.now) ? null : scene.under(at);
    if (found !== null) tapped(found);
  });
  view.addEventListener("pointercancel", () => (pressed = null));
  view.addEventListener("pointerleave", (event) => {
    if (event.pointerType === "touch") return;
    pointer = null;
    later();
  });
  state.listen((now) => {
    note.hidden = !isEmpty(motion, now);
    later();
  });
}

function far([x, y]: [number, number], [a, b]: [number, number]): boolean {
  return Math.hypot(x - a, y - b) > TAP.away;
}

/** Whether the sheet is to be shown in a step in which it has no state. */
function isEmpty(motion: Motion, { model, index }: Choice): boolean {
  return model === "sheet" && motion.sheet !== null && motion.sheet.stateOf(index) === null;
}

/** Where something is, in millimeters. */
function position(place: Place): Row {
  const [x, y, z] = place.map((c) => short(round(c * 1000)));
  return { label: "x, y, z", value: `${x!}, ${y!}, ${z!}\u00a0mm` };
}

/** Fabric coordinates of a node or vertex (mm); null where catenaries span no surface. */
export function fabricPlace(motion: Motion, now: Choice, number: number): [number, number] | null {
  const { sheet } = motion;
  if (now.model === "sheet" && sheet !== null)
    return [sheet.places[2 * number]! / 1000, sheet.places[2 * number + 1]! / 1000];
  return motion.data.grid.includes(0) ? null : vertexPlace(motion, number);
}

function ofNode(motion: Motion, now: Choice, { number, place }: Found): [string, Row[]] {
  const at = fabricPlace(motion, now, number);
  const title = at === null ? "ply" : `u ${short(at[0])}, v ${short(at[1])}\u00a0mm`;
  const rows =
    now.model === "sheet" && motion.sheet !== null
      ? ofSheet(motion, now, number)
      : ofVertex(motion, now, number);
  return [title, [...rows, position(place)]];
}

function ofSheet(motion: Motion, { index, colour }: Choice, number: number): Row[] {
  const sheet = motion.sheet!;
  const state = sheet.stateOf(index)!;
  const rows: Row[] = [];
  const add = (key: string, label: string, value: string | null) => {
    if (value !== null) rows.push({ label, value, coloured: key === colour });
  };
  const told = (value: number | null, unit: string) => (value === null ? null : quantity(round(value), unit));
  add("over_mold", "height over the mold", told(sheet.overMold(state, number), "mm"));
  const share = motion.data.sample?.share ?? "";
  add("spread", `kept by ${share} of the cells`, told(sheet.spreadAt(number), "mm"));
  if (sheet.data.height === null)
    add("height", "height", told(sheet.positions.at(state)[3 * number + 2]! / 1000, "mm"));
  add("shear", "shear", told(sheet.shearAt(state, number), "°"));
  const yarn = sheet.yarnAt(state, number);
  if (yarn !== null) {
    add("strain", "yarn strain", quantity(yarn[0], "%"));
    add("", "yarn tension", quantity(yarn[1], "N/m"));
  }
  const step = sheet.data.landing[number]!;
  if (sheet.data.height !== null) {
    add("", "contact", sheet.touches(state, number) ? "touches the mold" : "none");
    add("landing", "lands", step === 0 ? "never" : `in step ${String(step)}`);
  }
  return rows;
}

/** A vertex between the catenaries; of values of cells those of the cell it lies in. */
function ofVertex(motion: Motion, { index, colour }: Choice, number: number): Row[] {
  const { grid, divisions } = motion.data;
  const columns = (grid[0] - 1) * divisions + 1;
  const along = (k: number, count: number) => Math.min(Math.floor(k / divisions), count - 2);
  const cell =
    along(Math.floor(number / columns), grid[1]) * (grid[0] - 1) + along(number % columns, grid[0]);
  return fieldsOf(motion.data, "catenaries").flatMap((field) => {
    if (field.on === "cell" && (grid[0] < 2 || grid[1] < 2)) return [];
    const value = valueOf(motion, "catenaries", field, index, field.on === "cell" ? cell : number);
    if (value === null) return [];
    return [
      { label: field.label, value: quantity(round(value), field.unit), coloured: field.key === colour },
    ];
  });
}

function ofGripper(motion: Motion, now: Choice, { number, place }: Found): [string, Row[]] {
  const { data, sheet } = motion;
  const title = `gripper ${gripperName(data.ids[number]!)}`;
  const state = now.model === "sheet" ? (sheet?.stateOf(now.index) ?? null) : null;
  const normals = state === null ? motion.normals.at(now.index) : sheet!.normals.at(state);
  const normal = [...normals.subarray(3 * number, 3 * number + 3)] as Place;
  const rows: Row[] = [{ label: "vacuum", value: vacuum(motion, now, state, number) }];
  const limit = deciding(data).find(({ name }) => name === "tilt")?.limit ?? null;
  rows.push({
    label: "tilt",
    value: quantity(tilt(motion, now.index, number, normal), "°") + upTo(limit, "°"),
  });
  if (state !== null && sheet!.holds(state, number) !== false) {
    const [along, across] = sheet!.loads(state, number);
    const { allowed } = sheet!.data;
    const load = (force: Place, most: number | null) => quantity(Math.hypot(...force), "N") + upTo(most, "N");
    const up = across.reduce((sum, f, c) => sum + f * normal[c]!, 0);
    rows.push(
      { label: "force", value: load(sheet!.force(state, number), allowed.whole) },
      { label: "along the ply", value: load(along, allowed.along) },
      up > 0
        ? { label: "presses the pad", value: load(across, null) }
        : { label: "draws off the pad", value: load(across, allowed.across) },
    );
  }
  return [title, [...rows, position(place)]];
}

function upTo(limit: number | null, unit: string): string {
  return limit === null ? "" : `, ≤\u202f${quantity(limit, unit)} allowed`;
}

/** What the vacuum of a pad does in a step. */
function vacuum(motion: Motion, { index }: Choice, state: number | null, gripper: number): string {
  const name = gripperName(motion.data.ids[gripper]!);
  const events = motion.data.events.filter(({ grippers }) => grippers.includes(name));
  const when = (kind: string) => events.find((event) => event.kind === kind)?.time ?? null;
  const [press, release] = [when("press"), when("release")];
  if (state !== null && motion.sheet!.holds(state, gripper) === false)
    return release === null ? "off, has let go" : `off since ${quantity(release, "s")}`;
  const presses = press !== null && motion.data.times[index]! >= press;
  return (
    (presses ? "on, presses" : "on, holds") + (release === null ? "" : ` until ${quantity(release, "s")}`)
  );
}

/** Angle (°) between a pad's normal and its stem, which is upright unless a tool turns it. */
function tilt(motion: Motion, index: number, gripper: number, normal: Place): number {
  let stem: Place = [0, 0, 1];
  if (motion.cell !== null) {
    // the stems follow the pads
    const from = 7 * (motion.grippers.count + gripper);
    const [x, y, z, w] = [...motion.cell.origins.at(index).subarray(from + 3, from + 7)].map(
      (c) => c * 1e-6,
    ) as [number, number, number, number];
    stem = [2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)];
  }
  const dot = stem.reduce((sum, c, n) => sum + c * normal[n]!, 0);
  const cross = [0, 1, 2].map(
    (n) => stem[(n + 1) % 3]! * normal[(n + 2) % 3]! - stem[(n + 2) % 3]! * normal[(n + 1) % 3]!,
  );
  return (Math.atan2(Math.hypot(...cross), dot) * 180) / Math.PI;
}

/** Whole micrometers, and no zero with a sign. */
function round(value: number): number {
  return Math.round(value * 1000) / 1000 + 0;
}
