/** What was computed: facts of the scene, its input as written, what the page leaves out, the program. */

import type { PageData } from "../data/page_data";
import { byId, make } from "./dom";

export function showFacts(data: PageData): void {
  const list = byId("facts");
  for (const { label, value } of data.facts) list.append(make("dt", {}, label), make("dd", {}, value));
  list.hidden = data.facts.length === 0;
  byId("program").textContent = data.program;

  const input = byId<HTMLDetailsElement>("input");
  if (data.input === null)
    input.replaceWith(
      make("p", { class: "quiet" }, "The scene was built in a program; it has no input file."),
    );
  else byId("input-text").textContent = data.input;

  const notes = byId("left-out");
  notes.hidden = data.left_out.length === 0;
  for (const sentence of data.left_out) notes.append(make("p", {}, sentence));
}
