/**
 * A second result beside this one: both pictures in the same colors and from the same side, or one after the other by a key, at
 * the same share of their motions or in the same step; both lines in the charts; and a table of what differs.
 */

import type { Motion } from "../data/motion";
import { quantity } from "../data/number";
import { readOther, type Other, type OtherLimit } from "../data/other";
import { BrokenData, nearest, type Limit } from "../data/page_data";
import { Scene3d } from "../scene/scene3d";
import type { Charts } from "./charts";
import { byId, make } from "./dom";
import { linkHover } from "./hover";
import { sign } from "./limits";
import type { Section } from "./section";
import { State, type Choice } from "./state";

/** Which of the two are shown. */
type Shown = "both" | "a" | "b";
/** What is shown beside a step: the step at the same share of the time, or the one with the same number. */
type Link = "share" | "step";

const SHOWN: [Shown, string][] = [
  ["both", "Both"],
  ["a", "A"],
  ["b", "B"],
];
/** A result that is in view. */
interface Picture {
  letter: string;
  title: string;
  accepted: boolean;
  scene: Scene3d;
}

/** A window narrower than this (CSS pixels) has no room for two pictures. */
const NARROW = 700;

export class Comparison {
  private other: Other | null = null;
  private scene: Scene3d | null = null;
  private view: HTMLElement | null = null;
  private shown: Shown = "both";
  private link: Link = "share";

  constructor(
    private readonly state: State,
    private readonly motion: Motion,
    private readonly first: Scene3d | null,
    private readonly charts: Charts,
    private readonly section: Section,
  ) {
    const input = byId<HTMLInputElement>("other-file");
    byId("compare-open").addEventListener("click", () => input.click());
    input.addEventListener("change", () => {
      const file = input.files?.[0];
      if (file !== undefined) void this.open(file);
      input.value = "";
    });
    byId("compare-close").addEventListener("click", () => this.close());
    const link = byId<HTMLSelectElement>("compare-link");
    link.addEventListener("change", () => {
      this.link = link.value === "step" ? "step" : "share";
      this.relink();
    });
    const which = byId("compare-shown");
    for (const [key, name] of SHOWN) {
      const radio = make("input", { type: "radio", name: "shown", value: key });
      radio.addEventListener("change", () => this.show(key));
      which.append(make("label", { title: `Show ${name} (A changes)` }, radio, make("span", {}, name)));
    }
    this.listenForDrops();
  }

  /** The pictures that are in view, with the letters of their results. */
  get pictures(): Picture[] {
    const out: Picture[] = [];
    const { title, accepted } = this.motion.data;
    if (this.first !== null && (this.scene === null || this.shown !== "b"))
      out.push({ letter: "A", title, accepted, scene: this.first });
    if (this.scene !== null && this.shown !== "a") {
      const { title: named, accepted: kept } = this.other!;
      out.push({ letter: "B", title: named, accepted: kept, scene: this.scene });
    }
    return out;
  }

  /** Whether a second result is open. */
  get isOpen(): boolean {
    return this.other !== null;
  }

  /** From both to A, from A to B and back. */
  change(): void {
    if (this.other?.motion) this.show(this.shown === "a" ? "b" : "a");
  }

  async open(file: File): Promise<void> {
    await this.take(await file.text(), file.name);
  }

  /** Takes a second result from its text; what is wrong with it is said. */
  async take(text: string, name: string): Promise<void> {
    let other: Other;
    try {
      other = await readOther(text, this.motion.data.result_version);
    } catch (error) {
      const reason = error instanceof BrokenData ? error.message : String(error);
      tell(`${name} cannot be compared: ${reason}.`);
      return;
    }
    this.close();
    this.other = other;
    tell(
      other.motion === null
        ? `${name} holds the numbers of its result and no picture. To see it beside this one, open its report.html.`
        : null,
    );
    byId("compare").hidden = false;
    const [a, b] = [this.motion.data.title, other.title];
    byId("compare-a").textContent = a;
    byId("compare-b").textContent = a === b ? `${b} (${name})` : b;
    for (const id of ["compare-shown", "compare-link"]) byId(id).hidden = other.motion === null;
    this.fillTable(other, name);
    if (other.motion !== null) this.draw(other.motion);
  }

  close(): void {
    this.view?.remove();
    this.scene?.free();
    if (this.first !== null) this.first.eye.moved = null;
    [this.other, this.scene, this.view] = [null, null, null];
    this.state.partner = null;
    this.state.set({ other: null, otherIndex: 0 });
    this.charts.compare(null);
    byId("compare").hidden = true;
    byId("comparison").hidden = true;
    byId("pictures").dataset.shown = "a";
    byId("letter-a").hidden = true;
    tell(null);
  }

  /** The picture of the second result, which follows this one. */
  private draw(motion: Motion): void {
    const { state, first } = this;
    this.state.partner = (index) => this.partner(motion, index);
    const derived = (now: Choice): Choice => ({
      ...now,
      index: now.otherIndex,
      other: this.motion,
      otherIndex: now.index,
      pointer: null,
    });
    state.set({ other: motion, otherIndex: this.partner(motion, state.now.index) });
    this.charts.compare({ data: motion.data, at: (k) => this.back(motion, k) });
    if (first !== null) {
      const view = make(
        "div",
        { class: "view", id: "view-b", role: "img", "aria-label": `3D picture of ${this.other!.title}` },
        make("canvas", { class: "picture" }),
        make("b", { class: "letter letter-b" }, "B"),
      );
      byId("pictures").append(view);
      const own = new State(derived(state.now), motion.data.steps.length);
      const scene = new Scene3d(view, motion, own);
      [this.view, this.scene] = [view, scene];
      state.listen((now) => {
        if (this.scene === scene) own.set(derived(now));
      });
      linkHover(view, own, motion, scene, (found) => this.section.through(found));
      first.eye.moved = () => scene.eye.follow(first.eye);
      scene.eye.moved = () => first.eye.follow(scene.eye);
      scene.eye.follow(first.eye);
    }
    this.show(innerWidth < NARROW ? "b" : "both");
  }

  private show(shown: Shown): void {
    this.shown = shown;
    byId("pictures").dataset.shown = shown;
    byId("letter-a").hidden = false;
    for (const input of byId("compare-shown").querySelectorAll("input"))
      input.checked = input.value === shown;
  }

  /** Index of the step of the other result that is compared with one of this result. */
  private partner({ data }: Motion, index: number): number {
    const { steps, times } = this.motion.data;
    if (this.link === "step") return nearest(data.steps, steps[index]!);
    return nearest(shares(data.times), shares(times)[index]!);
  }

  /** Position of a step of the other result along the steps of this one. */
  private back({ data }: Motion, index: number): number {
    const { steps, times } = this.motion.data;
    if (this.link === "step") return data.steps[index]!;
    const [share, own] = [shares(data.times)[index]!, shares(times)];
    let k = 0;
    while (k + 2 < own.length && own[k + 1]! < share) k++;
    const [from, to] = [own[k]!, own[k + 1] ?? own[k]!];
    const part = to > from ? (share - from) / (to - from) : 0;
    return steps[k]! + part * ((steps[k + 1] ?? steps[k]!) - steps[k]!);
  }

  private relink(): void {
    const motion = this.other?.motion;
    if (!motion) return;
    this.state.set({ otherIndex: this.partner(motion, this.state.now.index) });
    this.charts.compare({ data: motion.data, at: (k) => this.back(motion, k) });
  }

  private fillTable(other: Other, name: string): void {
    const { data } = this.motion;
    const section = byId("comparison");
    section.hidden = false;
    const body = make("tbody");
    const add = (cells: (string | Node)[], kind = "") => {
      const tr = make("tr", { class: kind });
      cells.forEach((cell, k) => {
        tr.append(k === 0 ? make("th", { scope: "row" }, cell) : make("td", { class: "number" }, cell));
      });
      body.append(tr);
    };
    const words = (of: { accepted: boolean; world: string }) =>
      of.accepted ? `accepted${of.world}` : "not accepted";
    add(["Verdict", words(data), words(other), ""]);
    const duration = data.times[data.times.length - 1]! - data.times[0]!;
    add([
      "Duration",
      quantity(duration, "s"),
      quantity(other.duration, "s"),
      signed(other.duration - duration, "s"),
    ]);
    const missing: string[] = [];
    for (const limit of data.limits) {
      const same = partnerOf(other.limits, limit);
      if (same === null) {
        missing.push(limit.name);
        continue;
      }
      const more = same.value - limit.value;
      const equal = Math.abs(more) <= 1e-9 * Math.max(Math.abs(same.value), Math.abs(limit.value), 1e-9);
      const better = more > 0 === limit.least;
      const kind = equal ? "same" : better ? "better" : "worse";
      add(
        [
          limit.name,
          verdict(limit),
          verdict(same),
          make(
            "span",
            {},
            equal ? "–" : signed(more, limit.unit),
            make("span", { class: "word" }, equal ? "" : ` ${kind}`),
          ),
        ],
        kind,
      );
    }
    const head = make("tr");
    for (const text of ["Limit", "A", "B", "B − A"]) {
      head.append(make("th", { scope: "col", class: text === "Limit" ? "" : "number" }, text));
    }
    byId("comparison-body").replaceChildren(
      make(
        "p",
        { class: "quiet" },
        `A is this page, B is ${name}. Worst values of all steps, or of the end where the limit is about it.`,
      ),
      make("table", { class: "limits differences" }, make("thead", {}, head), body),
    );
    if (missing.length > 0) {
      byId("comparison-body").append(
        make("p", { class: "quiet" }, `B has no value of: ${missing.join(", ")}.`),
      );
    }
  }

  private listenForDrops(): void {
    const mark = (on: boolean) => document.documentElement.classList.toggle("dropping", on);
    addEventListener("dragover", (event) => {
      if (event.dataTransfer?.types.includes("Files") !== true) return;
      event.preventDefault();
      mark(true);
    });
    addEventListener("dragleave", (event) => {
      if (event.relatedTarget === null) mark(false);
    });
    addEventListener("drop", (event) => {
      mark(false);
      const file = event.dataTransfer?.files[0];
      if (file === undefined) return;
      event.preventDefault();
      void this.open(file);
    });
  }
}

/** Shares of the whole time at which steps are; of steps without times, of their number. */
function shares(times: number[]): number[] {
  const [first, last] = [times[0]!, times[times.length - 1]!];
  return times.map((time, k) =>
    last > first ? (time - first) / (last - first) : k / Math.max(1, times.length - 1),
  );
}

/** The limit of another result that is about the same, in the same unit. */
function partnerOf(list: OtherLimit[], limit: Limit): OtherLimit | null {
  return list.find(({ name, unit }) => name === limit.name && unit === limit.unit) ?? null;
}

function verdict({ value, unit, ok }: OtherLimit): HTMLElement {
  return make("span", { class: ok ? "kept" : "broken" }, sign(ok), quantity(value, unit));
}

function signed(value: number, unit: string): string {
  return (value > 0 ? "+" : "") + quantity(value, unit);
}

/** Says something about the page's own work; null takes it away. */
export function tell(sentence: string | null): void {
  const note = byId("told");
  note.hidden = sentence === null;
  byId("told-text").textContent = sentence ?? "";
}
