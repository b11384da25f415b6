/**
 * The live page: the reader moves grippers, bends the mold and changes the material, and the solver of plydrape, which the page
 * holds, answers in every frame. All mechanics are in the solver; what it says is drawn by the parts of the results page.
 */

import { checked, type Field, type FieldKey, type PageData, type Place } from "../data/page_data";
import { Motion } from "../data/motion";
import { byId, measureHead } from "../page/dom";
import { linkHover } from "../page/hover";
import { linkKeys } from "../page/keyboard";
import { linkLegend } from "../page/legend";
import { save } from "../page/save";
import { State } from "../page/state";
import { applyTheme, linkTheme, systemIsDark } from "../page/theme";
import { linkToolbar } from "../page/toolbar";
import { Scene3d } from "../scene/scene3d";
import { Asker, type Told, type Wanted } from "./ask";
import { linkControls } from "./controls";
import { linkDrag, WAYS, type Way } from "./drag";
import { Paced } from "./paced";
import { hashOf, moved, ofHash, sameMold, sceneOf, start, type Setup } from "./setup";
import { Solver, type Hanging } from "./solver";
import { forceMarks, say, showNumbers, showVerdict, verdictOf } from "./told";

/** For scripts and tests. */
export interface LiveHandle {
  /** Resolves when the first ply is drawn. */
  readonly ready: Promise<void>;
  /** What is set, and the scene that says so. */
  setup?: () => Setup;
  scene?: () => string;
  /** The last answer of the solver. */
  hanging?: () => Hanging;
  /** Resolves when all that was asked for is drawn. */
  idle?: () => Promise<void>;
  /** Milliseconds of the last solves, and times at which the last answers were shown. */
  solves?: number[];
  shown?: number[];
  /** Where a place is on the picture (CSS pixels from its top left). */
  onScreen?: (place: Place) => [number, number];
}

declare global {
  interface Window {
    live: LiveHandle;
  }
}

const HELP: [string, string][] = [
  ["Drag a gripper", "move it in the plane of the screen, or as chosen below the picture"],
  ["Shift + drag", "move it level"],
  ["Alt + drag", "move it up and down"],
  ["1 – 4", "the colors in their order"],
  ["T F S I", "view from top, front, side, iso"],
  ["0", "fit into the picture"],
  ["+ −", "nearer, farther"],
  ["Shift + arrows", "turn the view"],
  ["R", "colors over the range of this ply, or of all since the start"],
  ["O", "scale of the gap by orders of size, or an even one"],
  ["D, M, N", "diagonals, mold, forces in the picture on or off"],
  ["Home", "start again"],
  ["L", "light or dark"],
  ["?", "this list"],
];

/** Below this height of an even scale (in its unit) colors would show rounding. */
const LEAST_RANGE = 0.5;

/** Words and numbers beside the picture are written once in this many milliseconds: the browser lays the page out anew each time. */
const WRITTEN = 200;

/** Ranges that grow with what was seen, so that colors stay while a gripper moves. */
class Ranges {
  private readonly seen = new Map<FieldKey, [number, number]>();

  widen(fields: Field[]): void {
    for (const field of fields) {
      const [low, high] = this.seen.get(field.key) ?? [Infinity, -Infinity];
      const least = Math.max(0, LEAST_RANGE - (field.high - field.low)) / 2;
      field.low = Math.min(low, field.low - least);
      field.high = Math.max(high, field.high + least);
      this.seen.set(field.key, [field.low, field.high]);
    }
  }

  forget(): void {
    this.seen.clear();
  }
}

async function open(): Promise<void> {
  if (typeof WebAssembly !== "object") throw new Error("this browser has no WebAssembly");
  const solver = await Solver.load(byId("plydrape-solver").textContent.trim());
  // an address whose scene is refused gives the start
  let wanted = ofHash(location.hash);
  let answer = await solver.answer(sceneOf(wanted), true);
  const refused = "refused" in answer ? answer : null;
  if ("refused" in answer) {
    wanted = start();
    answer = await solver.answer(sceneOf(wanted), true);
    if ("refused" in answer) throw new Error(answer.refused);
  }
  let hanging: Hanging = answer;
  let setup = wanted;
  const ranges = new Ranges();
  ranges.widen(hanging.page.drape.fields);
  const motion = await Motion.unpack(checked(hanging.page));

  const state = new State(
    {
      index: 0,
      model: "catenaries",
      color: "gap",
      stepRange: false,
      orders: false,
      diagonals: true,
      mold: true,
      cell: true,
      forces: false,
      paths: false,
      section: null,
      other: null,
      otherIndex: 0,
      playing: false,
      answer: 0,
      dark: systemIsDark(),
      pointer: null,
    },
    1,
  );
  linkTheme(state);
  byId("page").hidden = false;
  measureHead();
  const view = byId("view");
  const scene = new Scene3d(view, motion, state);
  linkToolbar(state, motion.data, scene.eye);
  linkLegend(state, motion);
  linkHover(view, state, motion, scene, () => undefined);

  let held: number | null = null;
  const numbers = byId<HTMLInputElement>("show-numbers");
  const marks = () => {
    const ring = held === null ? [] : [{ place: setup.grippers[held]!, text: null }];
    scene.overlay.marks = [...(numbers.checked ? forceMarks(hanging, setup.grippers, scene) : []), ...ring];
    scene.draw();
  };
  numbers.addEventListener("change", marks);

  const controls = linkControls(
    () => wanted,
    (next) => want(next, null),
    () => void finish(),
  );
  const written = byId<HTMLDetailsElement>("scene");
  const showScene = () => {
    if (written.open) byId("scene-text").textContent = sceneOf(setup);
  };
  written.addEventListener("toggle", showScene);
  let said: Pick<Told, "refused" | "hanging"> = { refused, hanging };
  let verdict = "";
  const words = new Paced(() => {
    verdict = verdictOf(hanging).name;
    // sliders stand where the reader holds them, and grippers where they have come
    controls.show({ ...wanted, grippers: setup.grippers });
    showVerdict(hanging);
    showNumbers(hanging);
    showScene();
    say(said.refused, said.hanging);
    pace();
  }, WRITTEN);

  let fit = false;
  const asker = new Asker(solver, setup, async (told: Told) => {
    setup = told.setup;
    if (told.hanging !== null) {
      hanging = told.hanging;
      const page: PageData = checked(hanging.page);
      if (!told.mold) page.mold = motion.data.mold;
      ranges.widen(page.drape.fields);
      motion.become(await Motion.unpack(page));
      state.set({ answer: state.now.answer + 1 });
      if (told.mold) scene.renew(fit);
      fit &&= !told.mold;
    }
    if (!told.again) said = { refused: told.refused, hanging };
    marks();
    scene.flush();
    // that a limit is exceeded, or kept again, is said at once
    if (verdictOf(hanging).name === verdict) words.want();
    else words.now();
  });
  const want = (next: Setup, dragged: Wanted["dragged"]) => {
    const mold = !sameMold(next, setup);
    if (next.kind !== wanted.kind) {
      fit = true;
      ranges.forget();
    }
    wanted = next;
    asker.ask({ setup: next, dragged, mold, again: false });
  };
  /** What was asked for and refused is forgotten, the mold under the grippers is drawn anew, and the address says what is set. */
  const finish = async () => {
    await asker.idle();
    wanted = setup;
    asker.ask({ setup, dragged: null, mold: true, again: true });
    await asker.idle();
    words.now();
    const hash = hashOf(setup);
    history.replaceState(null, "", hash === "" ? location.pathname + location.search : `#${hash}`);
  };
  /** How fast the last answers came. */
  const pace = () => {
    const { solves, shown } = asker;
    const last = solves.slice(-20);
    if (last.length === 0) return;
    const mean = last.reduce((sum, ms) => sum + ms, 0) / Math.max(1, last.length);
    const frames = shown.slice(-20);
    const apart = frames.slice(1).map((time, k) => time - frames[k]!);
    const moving = apart.length > 5 && Math.max(...apart) < 250;
    const rate = (1000 * apart.length) / Math.max(1, (frames.at(-1) ?? 0) - (frames[0] ?? 0));
    byId("pace").textContent =
      `solved in ${mean.toFixed(1)} ms` + (moving ? `, ${rate.toFixed(0)} a second` : "");
  };

  let way: Way = "screen";
  const ways = byId("way");
  for (const input of ways.querySelectorAll("input")) {
    input.addEventListener("change", () => (way = WAYS.find((known) => known === input.value) ?? way));
  }
  linkDrag(view, scene, {
    way: () => way,
    place: (gripper) => setup.grippers[gripper]!,
    taken: (gripper) => {
      held = gripper;
      byId("hint").hidden = true;
      byId<HTMLSelectElement>("gripper").value = String(gripper);
      marks();
    },
    moved: (gripper, to, dragWay) => want(moved(setup, gripper, to), { gripper, way: dragWay }),
    dropped: () => {
      held = null;
      void finish();
    },
  });

  const again = () => {
    ranges.forget();
    fit = true;
    wanted = start();
    asker.ask({ setup: wanted, dragged: null, mold: true, again: false });
    void finish();
  };
  byId("again").addEventListener("click", again);
  byId("save-scene").addEventListener("click", () =>
    save(new Blob([sceneOf(setup)], { type: "text/plain" }), "live.toml"),
  );
  addEventListener("hashchange", () => {
    want(ofHash(location.hash), null);
    void finish();
  });
  linkKeys(HELP, state, motion.data, scene.eye, () => ({
    n: () => numbers.click(),
    Home: again,
  }));
  byId<HTMLAnchorElement>("sees-not").href = location.pathname.endsWith("/docs/live.html")
    ? "guide/sheet.md"
    : "guide/sheet.html";
  byId("program").textContent = hanging.program;
  marks();
  words.now();
  window.live = {
    ready,
    setup: () => setup,
    scene: () => sceneOf(setup),
    hanging: () => hanging,
    idle: async () => {
      await asker.idle();
      words.now();
    },
    solves: asker.solves,
    shown: asker.shown,
    onScreen: (place) => {
      const screen = scene.eye.screen();
      return [screen(place, 0), screen(place, 1)];
    },
  };
  // laid out, and then drawn
  await new Promise(requestAnimationFrame);
  await new Promise(requestAnimationFrame);
}

function fail(error: unknown): void {
  const sentence = byId("failure");
  const reason = error instanceof Error ? error.message : String(error);
  sentence.textContent = `This page cannot be shown: ${reason}. It needs a browser with WebAssembly and WebGL 2.`;
  sentence.hidden = false;
  byId("page").hidden = true;
}

applyTheme(systemIsDark());
const ready = open();
window.live = { ready };
ready.catch(fail);
