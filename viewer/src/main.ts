/**
 * The results page: reads its data, and links the parts, each of which listens to one state.
 */

import { Motion } from "./data/motion";
import { BrokenData, fieldsOf, nearest, readPageData, type Limit, type PageData } from "./data/page_data";
import { Charts } from "./page/charts";
import { Comparison, tell } from "./page/compare";
import { byId, measureHead } from "./page/dom";
import { Exporter } from "./page/export";
import { handle, type FullHandle, type Handle } from "./page/handle";
import { linkHover } from "./page/hover";
import { linkKeyboard } from "./page/keyboard";
import { linkLegend } from "./page/legend";
import { showLimit, showLimits, showVerdict } from "./page/limits";
import { asked, colorOf, pointerOf, worst } from "./page/opening";
import { showPeer } from "./page/peer";
import { Player } from "./page/player";
import { linkPrint } from "./page/print";
import { showSample, showTolerance } from "./page/sample";
import { showFacts } from "./page/scene_facts";
import { Section } from "./page/section";
import { State } from "./page/state";
import { applyTheme, linkTheme, systemIsDark } from "./page/theme";
import { linkTimeline } from "./page/timeline";
import { chooseModel, linkToolbar } from "./page/toolbar";
import { Scene3d } from "./scene/scene3d";

declare global {
  interface Window {
    plydrape: Handle | FullHandle;
  }
}

async function open(): Promise<void> {
  const data = readPageData(byId("plydrape-data").textContent);
  byId("title").textContent = data.title;
  showVerdict(data);
  showTolerance(data.tolerance);
  measureHead();
  const motion = await Motion.unpack(data);
  const wanted = asked(data);
  const model = wanted.model ?? data.drape.model;
  const first = worst(data);
  const known = fieldsOf(data, model).map(({ key }) => key);
  const shows = wanted.color ?? (first === null ? null : colorOf(data, first));
  const state = new State(
    {
      index: wanted.index ?? (first === null ? data.steps.length - 1 : nearest(data.steps, first.step)),
      model,
      color: known.find((key) => key === shows) ?? known[0] ?? "height",
      stepRange: false,
      orders: true,
      diagonals: true,
      mold: true,
      cell: true,
      forces: data.look === undefined,
      paths: false,
      section: null,
      other: null,
      otherIndex: 0,
      playing: false,
      answer: 0,
      dark: systemIsDark(),
      pointer: null,
    },
    data.steps.length,
  );
  linkTheme(state);
  const page = byId("page");
  page.hidden = false;
  const scene = draw(motion, state, data);
  const player = new Player(state, data.times);
  linkToolbar(state, data, scene?.eye ?? null);
  linkLegend(state, motion);
  linkTimeline(state, player, motion);
  showLimits(state, data);
  // nothing is judged before a drape, and one step has no course
  for (const id of ["limits", "courses", "timeline"]) byId(id).hidden = data.look !== undefined;
  showSample(state, motion);
  const charts = new Charts(state, data);
  showPeer(state, motion, charts);
  showFacts(data);
  const section = new Section(state, motion, scene);
  if (scene !== null) linkHover(byId("view"), state, motion, scene, (found) => section.through(found));
  const comparison = new Comparison(state, motion, scene, charts, section);
  new Exporter(state, motion, comparison, player);
  byId("told-close").addEventListener("click", () => tell(null));
  linkKeyboard(state, player, data, scene?.eye ?? null, section, comparison);
  linkPrint(state, charts, scene);
  openAtWorst(state, data, first, wanted.index, scene);
  window.plydrape = handle(ready, state, player, motion, scene, section, comparison);
}

/** Marks the worst place, and looks at it; an address that asks for a step goes first. */
function openAtWorst(
  state: State,
  data: PageData,
  limit: Limit | null,
  step: number | null,
  scene: Scene3d | null,
): void {
  const pointer = limit === null ? null : pointerOf(data, limit);
  if (pointer !== null && step === null) {
    state.set({ pointer });
    scene?.frame(pointer.place);
  }
  const button = byId("worst");
  button.hidden = limit === null;
  if (limit !== null) {
    button.title = `To the worst limit: ${limit.name} in step ${String(limit.step)} (W)`;
    button.addEventListener("click", () => showLimit(state, data, limit));
  }
  addEventListener("hashchange", () => {
    const { index, color, model } = asked(data);
    if (model !== null) chooseModel(state, data, model);
    if (color !== null && fieldsOf(data, state.now.model).some(({ key }) => key === color))
      state.set({ color });
    if (index !== null) state.goto(index);
  });
}

/** The 3D picture, or a sentence where the browser cannot draw one. */
function draw(motion: Motion, state: State, data: PageData): Scene3d | null {
  const view = byId("view");
  view.setAttribute("aria-label", `3D picture of ${data.title}: ply, catenaries, grippers and mold`);
  try {
    if (document.createElement("canvas").getContext("webgl2") !== null)
      return new Scene3d(view, motion, state);
  } catch {
    // Said below.
  }
  view.classList.add("no-picture");
  byId("no-webgl").hidden = false;
  return null;
}

function fail(error: unknown): void {
  const reason = error instanceof BrokenData ? error.message : `of an unexpected fault (${String(error)})`;
  const sentence = byId("failure");
  const because = error instanceof BrokenData ? ":" : " because";
  sentence.textContent = `This page cannot be shown${because} ${reason}. Make it again from its result with “plydrape report result.json”.`;
  sentence.hidden = false;
  byId("page").hidden = true;
}

applyTheme(systemIsDark());
const ready = open();
window.plydrape = { ready };
ready.catch(fail);
