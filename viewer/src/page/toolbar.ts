/** The bar over the picture: colour modes, standard views, what is shown. */

import type { FieldKey, PageData } from "../data/page_data";
import type { Eye, StandardView } from "../scene/camera";
import { byId, make } from "./dom";
import type { State } from "./state";

const MODES: [FieldKey, string][] = [
  ["height", "Height"],
  ["gap", "Gap"],
  ["shear", "Shear"],
  ["direction", "Fibre direction"],
];
const VIEWS: [StandardView, string, string][] = [
  ["iso", "Iso", "I"],
  ["top", "Top", "T"],
  ["front", "Front", "F"],
  ["side", "Side", "S"],
];

/** The colour modes that exist here, in the order of their keys. */
export function modes(data: PageData): [FieldKey, string][] {
  return MODES.filter(([key]) => data.fields.some((field) => field.key === key));
}

export function linkToolbar(state: State, data: PageData, eye: Eye | null): void {
  const colours = byId("colours");
  colours.hidden = data.grid.includes(1);
  modes(data).forEach(([key, name], k) => {
    const input = make("input", { type: "radio", name: "colour", value: key });
    colours.append(
      make("label", { title: `Colour by ${name.toLowerCase()} (${k + 1})` }, input, make("span", {}, name)),
    );
    input.addEventListener("change", () => state.set({ colour: key }));
    state.listen(({ colour }) => (input.checked = colour === key));
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
  byId("show-diagonals").parentElement!.hidden = data.geometry.diagonals.count === 0;
  byId("show-mold").parentElement!.hidden = data.geometry.mold === null;
}

function linkCheck(state: State, key: "diagonals" | "mold"): void {
  const input = byId<HTMLInputElement>(`show-${key}`);
  input.addEventListener("change", () => state.set({ [key]: input.checked }));
  state.listen((now) => (input.checked = now[key]));
}
