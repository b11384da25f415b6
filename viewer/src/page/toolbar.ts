/** The bar over the picture: color modes, standard views, what is shown. */

import {
  fieldsOf,
  hasCatenaries,
  hasSurface,
  type FieldKey,
  type Model,
  type PageData,
} from "../data/page_data";
import type { Eye, StandardView } from "../scene/camera";
import { byId, make } from "./dom";
import type { State } from "./state";

const MODES: [FieldKey, string][] = [
  ["over_mold", "Height over mold"],
  ["spread", "Spread"],
  ["height", "Height"],
  ["gap", "Gap"],
  ["shear", "Shear"],
  ["strain", "Strain"],
  ["direction", "Fiber direction"],
  ["landing", "Landing"],
];
const MODELS: [Model, string][] = [
  ["sheet", "Sheet"],
  ["catenaries", "Catenaries"],
];
const VIEWS: [StandardView, string, string][] = [
  ["iso", "Iso", "I"],
  ["top", "Top", "T"],
  ["front", "Front", "F"],
  ["side", "Side", "S"],
];

/** The color modes of a model, in the order of their keys. */
export function modes(data: PageData, model: Model): [FieldKey, string][] {
  const fields = fieldsOf(data, model);
  return MODES.filter(([key]) => fields.some((field) => field.key === key));
}

/** Shows a model, in the same color mode if it has it. */
export function chooseModel(state: State, data: PageData, model: Model): void {
  const known = modes(data, model);
  const colour = known.find(([key]) => key === state.now.colour)?.[0] ?? known[0]?.[0] ?? state.now.colour;
  state.set({ model, colour });
}

export function linkToolbar(state: State, data: PageData, eye: Eye | null): void {
  const models = byId("models");
  models.hidden = data.sheet === null || !hasCatenaries(data);
  for (const [key, name] of MODELS) {
    const input = make("input", { type: "radio", name: "model", value: key });
    models.append(make("label", { title: `${name} (C changes)` }, input, make("span", {}, name)));
    input.addEventListener("change", () => chooseModel(state, data, key));
    state.listen(({ model }) => (input.checked = model === key));
  }

  const colours = byId("colours");
  state.listen((now, before) => {
    if (now !== before && now.model === before.model) return;
    colours.hidden = now.model === "catenaries" && !hasSurface(data);
    colours.replaceChildren(...modes(data, now.model).map(([key, name], k) => colour(state, key, name, k)));
    byId("show-diagonals").parentElement!.hidden =
      now.model === "sheet" || data.geometry.diagonals.count === 0;
    byId("show-forces").parentElement!.hidden = now.model !== "sheet";
  });
  state.listen(({ colour }) => {
    for (const input of colours.querySelectorAll("input")) input.checked = input.value === colour;
  });

  const views = byId("views");
  const viewButton = (name: string, key: string, act: () => void) => {
    const button = make(
      "button",
      { type: "button", title: `${name} (${key})`, "aria-keyshortcuts": key },
      name,
    );
    button.disabled = eye === null;
    button.addEventListener("click", act);
    views.append(button);
  };
  for (const [view, name, key] of VIEWS) viewButton(name, key, () => eye?.look(view));
  viewButton("Fit", "0", () => eye?.fit());

  linkCheck(state, "diagonals");
  linkCheck(state, "mold");
  linkCheck(state, "cell");
  linkCheck(state, "forces");
  linkCheck(state, "paths");
  byId("show-paths").parentElement!.hidden = state.count < 2;
  byId("show-mold").parentElement!.hidden = data.geometry.mold === null;
  byId("show-cell").parentElement!.hidden = data.cell === null;
}

function colour(state: State, key: FieldKey, name: string, k: number): HTMLElement {
  const input = make("input", { type: "radio", name: "colour", value: key });
  input.addEventListener("change", () => state.set({ colour: key }));
  return make(
    "label",
    { title: `Colour by ${name.toLowerCase()} (${k + 1})` },
    input,
    make("span", {}, name),
  );
}

function linkCheck(state: State, key: "diagonals" | "mold" | "cell" | "forces" | "paths"): void {
  const input = byId<HTMLInputElement>(`show-${key}`);
  input.addEventListener("change", () => state.set({ [key]: input.checked }));
  state.listen((now) => (input.checked = now[key]));
}
