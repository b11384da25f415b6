/** What lies under the mouse on the sheet: a node with its values, or a gripper with its force. */

import type { Motion } from "../data/motion";
import { short, withUnit } from "../data/number";
import { gripperName, type Place } from "../data/page_data";
import type { Scene3d } from "../scene/scene3d";
import type { Found } from "../scene/sheet_picture";
import { byId, make } from "./dom";
import type { State } from "./state";

/** Distance of the plate from the mouse (CSS pixels). */
const AWAY = 16;

export function linkHover(state: State, motion: Motion, scene: Scene3d): void {
  const { sheet } = motion;
  if (sheet === null || scene.sheet === null) return;
  const picture = scene.sheet;
  const view = byId("view");
  const plate = byId("hover");
  let mouse: [number, number] | null = null;
  let waiting = false;

  const show = () => {
    waiting = false;
    const { index, model, playing } = state.now;
    const at = sheet.stateOf(index);
    const found =
      mouse === null || model !== "sheet" || playing || at === null ? null : picture.under(scene.eye, mouse);
    plate.hidden = found === null;
    if (found === null || mouse === null || at === null) return;
    const lines = found.kind === "node" ? ofNode(motion, at, found) : ofGripper(motion, at, found);
    plate.replaceChildren(...lines.map((line, k) => make(k === 0 ? "b" : "span", {}, line)));
    const [x, y] = mouse;
    const left = x + AWAY + plate.offsetWidth > view.clientWidth ? x - AWAY - plate.offsetWidth : x + AWAY;
    const top = Math.min(Math.max(y - plate.offsetHeight / 2, 4), view.clientHeight - plate.offsetHeight - 4);
    plate.style.translate = `${left}px ${top}px`;
  };
  const later = () => {
    if (waiting) return;
    waiting = true;
    requestAnimationFrame(show);
  };
  view.addEventListener("pointermove", (event) => {
    const box = view.getBoundingClientRect();
    mouse = event.buttons === 0 ? [event.clientX - box.left, event.clientY - box.top] : null;
    later();
  });
  view.addEventListener("pointerleave", () => {
    mouse = null;
    later();
  });
  state.listen(later);

  const note = byId("no-state");
  state.listen(({ index, model }) => {
    note.hidden = model !== "sheet" || sheet.stateOf(index) !== null;
    note.textContent = "There is no state of the sheet in this step.";
  });
}

function ofNode(motion: Motion, state: number, { number }: Found): string[] {
  const sheet = motion.sheet!;
  const { sample } = motion.data;
  const [u, v] = [0, 1].map((c) => short(sheet.places[2 * number + c]! / 1000));
  const height = sheet.overMold(state, number);
  const shear = sheet.shearAt(state, number);
  const yarn = sheet.yarnAt(state, number);
  const lines = [`u ${u!}, v ${v!} mm`];
  if (height !== null) lines.push(`${withUnit(short(round(height)), "mm")} over the mold`);
  const spread = sheet.spreadAt(number);
  if (spread !== null && sample !== null)
    lines.push(`${withUnit(short(round(spread)), "mm")} at the end kept by ${sample.share} of the cells`);
  if (sheet.touches(state, number)) lines.push("touches the mold");
  if (sheet.data.landing[number]! > 0) lines.push(`lands in step ${String(sheet.data.landing[number])}`);
  if (shear !== null) lines.push(`shear ${withUnit(short(shear), "°")}`);
  if (yarn !== null)
    lines.push(`strain ${withUnit(short(yarn[0]), "%")}, tension ${withUnit(short(yarn[1]), "N/m")}`);
  return lines;
}

function ofGripper(motion: Motion, state: number, { number }: Found): string[] {
  const id = motion.data.ids[number]!;
  const sheet = motion.sheet!;
  const force = sheet.force(state, number);
  const [along, across] = sheet.loads(state, number);
  const { allowed } = sheet.data;
  const newtons = (load: Place) => withUnit(short(Math.hypot(...load)), "N");
  const of = (limit: number | null) => (limit === null ? "" : `, ${withUnit(short(limit), "N")} allowed`);
  const normals = sheet.normals.at(state);
  const up = across.reduce((sum, f, c) => sum + f * normals[3 * number + c]!, 0);
  return [
    `gripper ${gripperName(id)}`,
    `force ${newtons(force)}${of(allowed.whole)}`,
    `${newtons(along)} along the ply${of(allowed.along)}`,
    up > 0
      ? `${newtons(across)} presses the pad`
      : `${newtons(across)} draws off the pad${of(allowed.across)}`,
  ];
}

/** Whole micrometres, and no zero with a sign. */
function round(value: number): number {
  return Math.round(value * 1000) / 1000 + 0;
}
