/** What lies under the pointer, or under the finger after a tap: a node with its values, or a gripper with its state and loads. */

import { vertexPlace } from "../data/fabric_line";
import type { Motion } from "../data/motion";
import { quantity, short } from "../data/number";
import type { CatenaryStates } from "../data/catenary_states";
import type { Drape } from "../data/drape";
import { gripperName, isBeside, modelText, type Field, type Place } from "../data/page_data";
import type { SheetStates } from "../data/sheet_states";
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
  colored?: boolean;
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
  const note = make("p", { class: "picture-note", role: "note" });
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
    for (const { label, value, colored } of rows) {
      const kind: Record<string, string> = colored === true ? { class: "colored" } : {};
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
    const said = noteOf(motion, now);
    note.hidden = said === null;
    note.textContent = said;
    later();
  });
}

function far([x, y]: [number, number], [a, b]: [number, number]): boolean {
  return Math.hypot(x - a, y - b) > TAP.away;
}

/** Whether the model in view has no ply in a step. */
function isEmpty(motion: Motion, { model, index }: Choice): boolean {
  return motion.drape(model).picture(index) === null;
}

/** What a reader must know of the picture: that it judges nothing, or that the ply is that of another step. */
function noteOf(motion: Motion, now: Choice): string | null {
  const { data } = motion;
  const drape = motion.drape(now.model);
  const picture = drape.picture(now.index);
  const said: string[] = [];
  if (isBeside(data, now.model)) said.push(modelText(data, now.model));
  if (picture === null) said.push(`there is no state of the ${drape.model} in this step`);
  else if (drape.data.drawn[picture] !== data.steps[now.index])
    said.push(`ply as in step ${String(drape.data.drawn[picture])}, the nearest that was kept`);
  if (said.length === 0) return null;
  const text = said.join(" · ");
  return text.charAt(0).toUpperCase() + text.slice(1);
}

/** Where something is, in millimeters. */
function position(place: Place): Row {
  const [x, y, z] = place.map((c) => short(round(c * 1000)));
  return { label: "x, y, z", value: `${x!}, ${y!}, ${z!}\u00a0mm` };
}

/** Fabric coordinates of a node or vertex (mm); null where catenaries span no surface. */
export function fabricPlace({ sheet, catenaries }: Drape, number: number): [number, number] | null {
  if (sheet !== null) return [sheet.places[2 * number]! / 1000, sheet.places[2 * number + 1]! / 1000];
  if (catenaries === null || catenaries.data.grid.includes(0)) return null;
  return vertexPlace(catenaries, number);
}

function ofNode(motion: Motion, now: Choice, { number, place }: Found): [string, Row[]] {
  const drape = motion.drape(now.model);
  const at = fabricPlace(drape, number);
  const title = at === null ? "ply" : `u ${short(at[0])}, v ${short(at[1])}\u00a0mm`;
  const picture = drape.picture(now.index)!;
  const rows =
    drape.sheet !== null
      ? ofSheet(drape.sheet, drape.data.fields, now.color, picture, number)
      : drape.catenaries !== null
        ? ofVertex(drape.catenaries, drape.data.fields, now.color, picture, number)
        : [];
  return [title, [...rows, position(place)]];
}

/** A node of the sheet: what colors tell, of values of cells the largest around it, and what they do not tell. */
function ofSheet(sheet: SheetStates, fields: Field[], color: string, state: number, number: number): Row[] {
  const rows: Row[] = [];
  for (const field of fields) {
    if (field.key === "landing") continue;
    const value =
      field.on === "cell" ? sheet.around(field, state, number) : sheet.value(field, state, number);
    if (value === null) continue;
    // strains are shown in full: most of them are far below a hundredth of a percent
    const digits = field.scale === "orders" && field.on === "cell" ? value : round(value);
    rows.push({ label: field.label, value: quantity(digits, field.unit), colored: field.key === color });
  }
  const tension = sheet.tensionAt(state, number);
  if (tension !== null) rows.push({ label: "yarn tension", value: quantity(tension, "N/m") });
  const step = sheet.data.landing[number]!;
  if (sheet.data.height !== null) {
    rows.push({ label: "contact", value: sheet.touches(state, number) ? "touches the mold" : "none" });
    const lands = step === 0 ? "never" : `in step ${String(step)}`;
    rows.push({ label: "lands", value: lands, colored: color === "landing" });
  }
  return rows;
}

/** A vertex between the catenaries; of values of cells those of the cell it lies in. */
function ofVertex(
  catenaries: CatenaryStates,
  fields: Field[],
  color: string,
  picture: number,
  number: number,
): Row[] {
  const { grid, divisions } = catenaries.data;
  const columns = (grid[0] - 1) * divisions + 1;
  const along = (k: number, count: number) => Math.min(Math.floor(k / divisions), count - 2);
  const cell =
    along(Math.floor(number / columns), grid[1]) * (grid[0] - 1) + along(number % columns, grid[0]);
  return fields.flatMap((field) => {
    const value = catenaries.value(field, picture, field.on === "cell" ? cell : number);
    if (value === null) return [];
    return [{ label: field.label, value: quantity(round(value), field.unit), colored: field.key === color }];
  });
}

function ofGripper(motion: Motion, now: Choice, { number, place }: Found): [string, Row[]] {
  const { grippers } = motion.drape(now.model);
  const { index } = now;
  const gone = grippers.holds(index, number) === false;
  const rows: Row[] = [{ label: "vacuum", value: vacuum(motion, now, gone, number) }];
  // a pad that has let go has no loads
  for (const { label, unit, value, limit } of gone ? [] : grippers.readings(index, number)) {
    const allowed = limit === null ? "" : `, ≤\u202f${quantity(limit, unit)} allowed`;
    rows.push({ label, value: quantity(value, unit) + allowed });
  }
  return [`gripper ${gripperName(motion.data.ids[number]!)}`, [...rows, position(place)]];
}

/** What the vacuum of a pad does in a step. */
function vacuum(motion: Motion, { index }: Choice, gone: boolean, gripper: number): string {
  const name = gripperName(motion.data.ids[gripper]!);
  const events = motion.data.events.filter(({ grippers }) => grippers.includes(name));
  const when = (kind: string) => events.find((event) => event.kind === kind)?.time ?? null;
  const [press, release] = [when("press"), when("release")];
  if (gone) return release === null ? "off, has let go" : `off since ${quantity(release, "s")}`;
  const presses = press !== null && motion.data.times[index]! >= press;
  return (
    (presses ? "on, presses" : "on, holds") + (release === null ? "" : ` until ${quantity(release, "s")}`)
  );
}

/** Whole micrometers, and no zero with a sign. */
function round(value: number): number {
  return Math.round(value * 1000) / 1000 + 0;
}
