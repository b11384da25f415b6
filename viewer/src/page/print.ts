/**
 * Print: light colors, the 3D picture of the step in view as an image, all charts at the width of the
 * paper; afterwards everything as before. What is hidden on paper is said in the style sheet.
 */

import type { Scene3d } from "../scene/scene3d";
import type { Charts } from "./charts";
import { byId } from "./dom";
import type { State } from "./state";
import { applyTheme } from "./theme";

/** Width of a chart on paper (CSS pixels): three are side by side on A4 and on US Letter. */
const PAPER = 214;

export function linkPrint(state: State, charts: Charts, scene: Scene3d | null): void {
  const image = byId<HTMLImageElement>("snapshot");
  const input = document.querySelector<HTMLDetailsElement>("#input");
  let printing = false;
  let opened = false;
  const recolor = (dark: boolean) => {
    applyTheme(dark);
    scene?.ink();
    charts.redraw();
  };
  const begin = () => {
    if (printing) return;
    printing = true;
    recolor(false);
    if (scene !== null) image.src = scene.snapshot();
    document.documentElement.classList.add("printing");
    opened = input?.open ?? false;
    if (input !== null) input.open = true;
    charts.resize(PAPER);
  };
  const end = () => {
    if (!printing) return;
    printing = false;
    document.documentElement.classList.remove("printing");
    image.removeAttribute("src");
    if (input !== null) input.open = opened;
    recolor(state.now.dark);
    charts.resize(null);
    scene?.draw();
  };
  addEventListener("beforeprint", begin);
  addEventListener("afterprint", end);
  matchMedia("print").addEventListener("change", (event) => (event.matches ? begin() : end()));
}
