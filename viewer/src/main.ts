/**
 * The results page: reads its data, and links the parts, each of which listens to one state.
 */

import { Motion } from "./data/motion";
import { BrokenData, readPageData, type PageData } from "./data/page_data";
import { Charts } from "./page/charts";
import { byId } from "./page/dom";
import { handle, type FullHandle, type Handle } from "./page/handle";
import { linkHover } from "./page/hover";
import { linkKeyboard } from "./page/keyboard";
import { linkLegend } from "./page/legend";
import { showLimits, showStrength, showVerdict } from "./page/limits";
import { Player } from "./page/player";
import { linkPrint } from "./page/print";
import { showSample, showStands } from "./page/sample";
import { showFacts } from "./page/scene_facts";
import { State } from "./page/state";
import { applyTheme, linkTheme, systemIsDark } from "./page/theme";
import { linkTimeline } from "./page/timeline";
import { linkToolbar, modes } from "./page/toolbar";
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
  showStands(data.stands);
  const motion = await Motion.unpack(data);
  const model = data.sheet === null ? "catenaries" : "sheet";
  const state = new State(
    {
      index: data.steps.length - 1,
      model,
      colour: modes(data, model)[0]?.[0] ?? "height",
      stepRange: false,
      diagonals: true,
      mold: true,
      cell: true,
      forces: true,
      playing: false,
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
  showStrength(data);
  showSample(state, motion);
  const charts = new Charts(state, data);
  showFacts(data);
  if (scene !== null) linkHover(state, motion, scene);
  linkKeyboard(state, player, data, scene?.eye ?? null);
  linkPrint(state, charts, scene);
  window.plydrape = handle(ready, state, player, motion, scene);
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
