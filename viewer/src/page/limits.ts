/** The verdict and the table of limits; a row shows its step and its place on the ply. */

import { full, short, withUnit } from "../data/number";
import type { Limit, PageData } from "../data/page_data";
import { byId, make } from "./dom";
import type { State } from "./state";

/** One line: accepted or not. */
function verdict(data: PageData): string {
  const failed = data.limits.filter((limit) => !limit.ok).length;
  const count = data.limits.length;
  let text: string;
  if (data.accepted) text = count === 0 ? "Accepted: no limit is set" : `Accepted: ${all(count)} kept`;
  else if (failed === 0) text = "Not accepted";
  else text = `Not accepted: ${failed} of ${count} ${count === 1 ? "limit" : "limits"} exceeded`;
  return text;
}

/** Why there are fewer steps than planned, if there are. */
function shortened(data: PageData): string {
  if (data.stopped !== null) return `. Stopped: ${data.stopped}`;
  return data.interrupted ? ". Interrupted: fewer steps than planned" : "";
}

function all(count: number): string {
  return count === 1 ? "the one limit is" : `all ${count} limits are`;
}

export function showVerdict(data: PageData): void {
  const badge = byId("verdict");
  badge.className = data.accepted ? "verdict pass" : "verdict fail";
  badge.replaceChildren(
    sign(data.accepted),
    verdict(data),
    make("span", { class: "reason" }, shortened(data)),
  );
}

/** A tick or a cross; the word beside it says the same. */
function sign(ok: boolean): HTMLElement {
  return make("span", { class: "sign", "aria-hidden": "true" }, ok ? "✓" : "✗");
}

export function showLimits(state: State, data: PageData): void {
  const section = byId("limits");
  if (data.limits.length === 0) {
    section.append(make("p", { class: "quiet" }, "The scene sets no limits."));
    return;
  }
  const heads: [string, string][] = [
    ["Limit", ""],
    ["", ""],
    ["Worst", "number"],
    ["Allowed", "number"],
    ["Step", "number"],
    ["At", ""],
  ];
  const body = make("tbody");
  for (const limit of data.limits) body.append(row(state, data, limit));
  const head = make("tr");
  for (const [text, kind] of heads) {
    head.append(
      text === ""
        ? make("th", { scope: "col", "aria-label": "Verdict" })
        : make("th", { scope: "col", class: kind }, text),
    );
  }
  section.append(make("table", { class: "limits" }, make("thead", {}, head), body));
}

function row(state: State, data: PageData, limit: Limit): HTMLTableRowElement {
  const value = withUnit(short(limit.value), limit.unit);
  const bound = `${limit.least ? "≥" : "≤"}\u202f${withUnit(short(limit.limit), limit.unit)}`;
  const index = nearest(data.steps, limit.step);
  const word = limit.ok ? "pass" : "fail";
  const cells = [
    make("th", { scope: "row" }, limit.name),
    make("td", { class: "word" }, sign(limit.ok), word),
    make("td", { class: "number", title: withUnit(full(limit.value), limit.unit) }, value),
    make("td", { class: "number", title: withUnit(full(limit.limit), limit.unit) }, bound),
    make("td", { class: "number" }, limit.step === null ? "–" : String(limit.step)),
    make("td", { class: "where", title: limit.where }, limit.where),
  ];
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
    const name = limit.name.charAt(0).toUpperCase() + limit.name.slice(1);
    const allowed = `at ${limit.least ? "least" : "most"} ${withUnit(short(limit.limit), limit.unit)} allowed`;
    const label = `${name}: ${value}\n${limit.ok ? "pass" : "exceeded"}, ${allowed}\n${limit.where}`;
    state.goto(index);
    if (limit.place !== null) state.set({ pointer: { index, place: limit.place, label } });
    for (const other of tr.parentElement?.children ?? []) other.removeAttribute("aria-current");
    tr.setAttribute("aria-current", "true");
  });
  state.listen((now) => {
    if (now.index !== index) tr.removeAttribute("aria-current");
  });
  return tr;
}

/** Index of a step, or of the one nearest to it if it was left out; -1 for none. */
export function nearest(steps: number[], step: number | null): number {
  if (step === null) return -1;
  const away = steps.map((number) => Math.abs(number - step));
  return away.indexOf(Math.min(...away));
}
