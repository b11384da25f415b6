/**
 * Light and dark: as the system asks, until the reader chooses. Print is always light.
 */

import { byId } from "./dom";
import type { State } from "./state";

const system = matchMedia("(prefers-color-scheme: dark)");

/** Whether the system asks for dark. */
export function systemIsDark(): boolean {
  return system.matches;
}

/** Puts the theme on the document at once, so that colors read afterwards are the new ones. */
export function applyTheme(dark: boolean): void {
  document.documentElement.dataset.theme = dark ? "dark" : "light";
}

export function linkTheme(state: State): void {
  const button = byId<HTMLButtonElement>("theme");
  let chosen = false;
  button.addEventListener("click", () => {
    chosen = true;
    state.set({ dark: !state.now.dark });
  });
  system.addEventListener("change", () => {
    if (!chosen) state.set({ dark: system.matches });
  });
  state.listen(({ dark }) => {
    applyTheme(dark);
    button.textContent = dark ? "Light" : "Dark";
    button.setAttribute("aria-label", `Change to ${dark ? "light" : "dark"} colors`);
  });
}
