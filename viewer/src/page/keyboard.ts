/** Keys for everything, and the list of them. */

import { fieldsOf, type PageData } from "../data/page_data";
import type { Eye, StandardView } from "../scene/camera";
import type { Comparison } from "./compare";
import { byId, make } from "./dom";
import type { Player } from "./player";
import type { Section } from "./section";
import type { State } from "./state";
import { chooseModel } from "./toolbar";

const HELP: [string, string][] = [
  ["← →", "step back, step on"],
  ["Home, End", "first step, last step"],
  ["Space", "play, pause"],
  ["1 – 9", "the colors in their order"],
  ["C", "the model that decides, or the one for comparison"],
  ["T F S I", "view from top, front, side, iso"],
  ["0", "fit into the picture"],
  ["+ −", "nearer, farther"],
  ["Shift + arrows", "turn the view"],
  ["O", "scale by orders of size, or an even one"],
  ["R", "colors over the range of this step, or of all steps"],
  [
    "D, M, B, P, G",
    "diagonals, mold, bodies of the cell, forces on the pads, paths of the grippers on or off",
  ],
  ["W", "the worst limit and its place"],
  ["X", "section along a line of the fabric"],
  ["A", "the one or the other of two results that are compared"],
  ["L", "light or dark"],
  ["Escape", "take the marker away"],
  ["?", "this list"],
];
const VIEWS: Record<string, StandardView> = { t: "top", f: "front", s: "side", i: "iso" };
const TURN = Math.PI / 24;

export function linkKeyboard(
  state: State,
  player: Player,
  data: PageData,
  eye: Eye | null,
  section: Section,
  comparison: Comparison,
): void {
  linkKeys(HELP, state, data, eye, () => {
    const { index, cell, forces, paths, model } = state.now;
    return {
      ArrowLeft: () => state.goto(index - 1),
      ArrowRight: () => state.goto(index + 1),
      Home: () => state.goto(0),
      End: () => state.goto(state.count - 1),
      " ": () => player.toggle(),
      g: () => state.set({ paths: !paths }),
      w: () => byId("worst").click(),
      x: () => section.toggle(),
      a: () => comparison.change(),
      b: () => state.set({ cell: !cell }),
      p: () => state.set({ forces: !forces }),
      c: () => {
        if (data.also === null) return;
        chooseModel(state, data, model === data.also.model ? data.drape.model : data.also.model);
      },
      Escape: () => state.set({ pointer: null }),
    };
  });
}

/** Keys that every picture of a ply has, `more` of a page's own, and the list of them. */
export function linkKeys(
  help: [string, string][],
  state: State,
  data: PageData,
  eye: Eye | null,
  more: () => Record<string, () => void>,
): void {
  linkHelp(help);
  const find = (key: string): (() => void) | undefined => {
    const { stepRange, orders, diagonals, mold, model } = state.now;
    const mode = fieldsOf(data, model)[Number(key) - 1];
    if (mode !== undefined) return () => state.set({ color: mode.key });
    const view = VIEWS[key.toLowerCase()];
    if (view !== undefined) return () => eye?.look(view);
    const acts: Record<string, () => void> = {
      "0": () => eye?.fit(),
      "+": () => eye?.zoomBy(1.2),
      "=": () => eye?.zoomBy(1.2),
      "-": () => eye?.zoomBy(1 / 1.2),
      r: () => state.set({ stepRange: !stepRange }),
      o: () => state.set({ orders: !orders }),
      d: () => state.set({ diagonals: !diagonals }),
      m: () => state.set({ mold: !mold }),
      l: () => byId("theme").click(),
      "?": () => byId<HTMLDialogElement>("help").showModal(),
      ...more(),
    };
    return acts[key.length === 1 ? key.toLowerCase() : key];
  };
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || event.defaultPrevented) return;
    if (byId<HTMLDialogElement>("help").open) return;
    if (ownKeys(event)) return;
    const act = event.shiftKey && event.key.startsWith("Arrow") ? turn(event.key, eye) : find(event.key);
    if (act === undefined) return;
    event.preventDefault();
    act();
  });
}

function turn(key: string, eye: Eye | null): (() => void) | undefined {
  if (eye === null) return undefined;
  const turns: Record<string, () => void> = {
    ArrowLeft: () => eye.turnBy(-TURN, 0),
    ArrowRight: () => eye.turnBy(TURN, 0),
    ArrowUp: () => eye.turnBy(0, -TURN),
    ArrowDown: () => eye.turnBy(0, TURN),
  };
  return turns[key];
}

/** Whether the element in focus uses this key itself. */
function ownKeys(event: KeyboardEvent): boolean {
  const at = event.target;
  if (!(at instanceof HTMLElement)) return false;
  if (at instanceof HTMLPreElement) return event.key.startsWith("Arrow");
  if (at instanceof HTMLSelectElement) return event.key !== "?" && event.key !== "Escape";
  if (at instanceof HTMLButtonElement || at.tagName === "SUMMARY")
    return event.key === " " && at.id !== "play";
  if (at instanceof HTMLInputElement && at.type === "checkbox") return event.key === " ";
  if (at instanceof HTMLInputElement && at.type === "radio")
    return event.key.startsWith("Arrow") && !event.shiftKey;
  return false;
}

function linkHelp(help: [string, string][]): void {
  const dialog = byId<HTMLDialogElement>("help");
  const list = make("dl");
  for (const [keys, act] of help) list.append(make("dt", {}, make("kbd", {}, keys)), make("dd", {}, act));
  dialog.querySelector("h2")!.after(list);
  byId("help-open").addEventListener("click", () => dialog.showModal());
  dialog.addEventListener("click", (event) => {
    if (event.target === dialog) dialog.close();
  });
}
