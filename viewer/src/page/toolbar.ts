/** The bar over the picture: color modes, standard views, what is shown. */

import { drapeOf, fieldsOf, modelText, type Field, type Model, type PageData } from "../data/page_data";
import type { Eye, StandardView } from "../scene/camera";
import { byId, make } from "./dom";
import type { State } from "./state";

const VIEWS: [StandardView, string, string][] = [
  ["iso", "Iso", "I"],
  ["top", "Top", "T"],
  ["front", "Front", "F"],
  ["side", "Side", "S"],
];

/** Shows a model, in the same color mode if it has it; what is marked on the other one's ply goes. */
export function chooseModel(state: State, data: PageData, model: Model): void {
  const known = fieldsOf(data, model);
  const color = known.find(({ key }) => key === state.now.color)?.key ?? known[0]?.key ?? state.now.color;
  state.set({ model, color, pointer: model === state.now.model ? state.now.pointer : null });
}

export function linkToolbar(state: State, data: PageData, eye: Eye | null): void {
  const models = byId("models");
  models.hidden = data.also === null;
  for (const { model } of data.also === null ? [] : [data.drape, data.also]) {
    const input = make("input", { type: "radio", name: "model", value: model });
    const name = model.charAt(0).toUpperCase() + model.slice(1);
    const role = model === data.drape.model ? `${name}, by which is judged` : modelText(data, model);
    models.append(make("label", { title: `${role} (C changes)` }, input, make("span", {}, name)));
    input.addEventListener("change", () => chooseModel(state, data, model));
    state.listen((now) => (input.checked = now.model === model));
  }

  const colors = byId("colors");
  state.listen((now, before) => {
    if (now !== before && now.model === before.model) return;
    const { fields, catenaries } = drapeOf(data, now.model);
    colors.hidden = fields.length === 0;
    colors.replaceChildren(...fields.map((field, k) => color(state, field, k)));
    byId("show-diagonals").parentElement!.hidden = (catenaries?.diagonals.count ?? 0) === 0;
  });
  state.listen(({ color }) => {
    for (const input of colors.querySelectorAll("input")) input.checked = input.value === color;
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
  byId("show-mold").parentElement!.hidden = data.mold === null;
  byId("show-cell").parentElement!.hidden = data.cell === null;
}

function color(state: State, { key, name, label }: Field, k: number): HTMLElement {
  const input = make("input", { type: "radio", name: "color", value: key });
  input.addEventListener("change", () => state.set({ color: key }));
  return make("label", { title: `Color by ${label} (${k + 1})` }, input, make("span", {}, name));
}

function linkCheck(state: State, key: "diagonals" | "mold" | "cell" | "forces" | "paths"): void {
  const input = byId<HTMLInputElement>(`show-${key}`);
  input.addEventListener("change", () => state.set({ [key]: input.checked }));
  state.listen((now) => (input.checked = now[key]));
}
