/** The verdict and the table of limits; a row shows its step and its place on the ply. */

import { full, quantity, withUnit } from "../data/number";
import { nearest, type Limit, type PageData } from "../data/page_data";
import { byId, make } from "./dom";
import { colorOf, pointerOf } from "./opening";
import type { State } from "./state";
import { chooseModel } from "./toolbar";

/** One line: accepted and in which world, or not, by the model that decides. */
function verdict(data: PageData): string {
  const { limits, sample } = data;
  const failed = limits.filter((limit) => !limit.ok).length;
  const count = limits.length;
  const by = `by the ${data.drape.model}`;
  const cells = sample === null ? "" : `${String(sample.accepted)} of ${String(sample.cells.length)} cells`;
  if (data.accepted) {
    const kept = count === 0 ? "no limit is set" : `${all(count)} kept`;
    return `Accepted ${by}${data.world}: ${kept}${cells === "" ? "" : `, in ${cells}`}`;
  }
  if (failed === 0 && sample?.ok === false) {
    return `Not accepted ${by}: ${sample.words}`;
  }
  if (failed === 0) return `Not accepted ${by}`;
  return `Not accepted ${by}: ${failed} of ${count} ${count === 1 ? "limit" : "limits"} exceeded`;
}

/** Why the end does not count, if it does not. */
function shortened({ ended }: PageData): string {
  return ended === null ? "" : `. ${ended.charAt(0).toUpperCase()}${ended.slice(1)}`;
}

function all(count: number): string {
  return count === 1 ? "the one limit is" : `all ${count} limits are`;
}

export function showVerdict(data: PageData): void {
  const badge = byId("verdict");
  if (data.look !== undefined) {
    badge.className = "verdict look";
    badge.replaceChildren("Not draped yet: the scene at its start, judged by nothing");
    return;
  }
  badge.className = data.accepted ? "verdict pass" : "verdict fail";
  badge.replaceChildren(
    sign(data.accepted),
    verdict(data),
    make("span", { class: "reason" }, shortened(data)),
  );
}

/** A tick or a cross; the word beside it says the same. */
export function sign(ok: boolean): HTMLElement {
  return make("span", { class: "sign", "aria-hidden": "true" }, ok ? "✓" : "✗");
}

export function showLimits(state: State, data: PageData): void {
  const section = byId("limits");
  if (data.limits.length === 0) section.append(make("p", { class: "quiet" }, "The scene sets no limits."));
  else section.append(limitsTable(state, data, data.limits));
}

/** A table of limits of the model that decides. */
export function limitsTable(state: State, data: PageData, limits: Limit[]): HTMLElement {
  const heads: [string, string][] = [
    ["Limit", ""],
    ["", ""],
    ["Worst", "number"],
    ["Allowed", "number"],
    ["Step", "number"],
    ["At", ""],
  ];
  const body = make("tbody");
  for (const limit of limits) body.append(row(state, data, limit));
  const head = make("tr");
  for (const [text, kind] of heads) {
    head.append(
      text === ""
        ? make("th", { scope: "col", "aria-label": "Verdict" })
        : make("th", { scope: "col", class: kind }, text),
    );
  }
  return make("table", { class: "limits" }, make("thead", {}, head), body);
}

/** Name, verdict, value and bound of a limit, and where it is worst. */
export function limitCells(limit: Limit): HTMLElement[] {
  const value = quantity(limit.value, limit.unit);
  const bound = `${limit.least ? "≥" : "≤"}\u202f${quantity(limit.limit, limit.unit)}`;
  return [
    make("th", { scope: "row" }, limit.name),
    make("td", { class: "word" }, sign(limit.ok), limit.ok ? "pass" : "fail"),
    make("td", { class: "number", title: withUnit(full(limit.value), limit.unit) }, value),
    make("td", { class: "number", title: withUnit(full(limit.limit), limit.unit) }, bound),
    make("td", { class: "where", title: limit.where }, limit.where),
  ];
}

function row(state: State, data: PageData, limit: Limit): HTMLTableRowElement {
  const index = nearest(data.steps, limit.step);
  const cells = limitCells(limit);
  cells.splice(4, 0, make("td", { class: "number" }, limit.step === null ? "–" : String(limit.step)));
  if (limit.note !== null) cells[0]!.append(make("span", { class: "other-units" }, limit.note));
  const tr = make("tr", { class: limit.ok ? "pass" : "fail" }, ...cells);
  if (index < 0) return tr;
  const button = make(
    "button",
    { type: "button", "aria-label": `Show ${limit.name}: step ${String(limit.step)}, ${limit.where}` },
    limit.where,
  );
  cells[5]!.replaceChildren(button);
  tr.classList.add("linked");
  tr.addEventListener("click", () => {
    showLimit(state, data, limit);
    for (const other of document.querySelectorAll("table.limits [aria-current]"))
      other.removeAttribute("aria-current");
    tr.setAttribute("aria-current", "true");
  });
  state.listen((now) => {
    if (now.index !== index) tr.removeAttribute("aria-current");
  });
  return tr;
}

/** Goes to the step of a limit, in the colors that it is about, and marks its place. */
export function showLimit(state: State, data: PageData, limit: Limit): void {
  const { model } = data.drape;
  chooseModel(state, data, model);
  const color = colorOf(data, limit);
  if (color !== null) state.set({ color });
  state.goto(nearest(data.steps, limit.step));
  const pointer = pointerOf(data, limit);
  if (pointer !== null) state.set({ pointer });
}
