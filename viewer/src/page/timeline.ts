/** The bar under the picture: play, step by step, the slider with its marks, time and speed. */

import type { Motion } from "../data/motion";
import { full, quantity } from "../data/number";
import { nearest } from "../data/page_data";
import { byId, make } from "./dom";
import type { Player } from "./player";
import type { State } from "./state";

export function linkTimeline(state: State, player: Player, motion: Motion): void {
  const { data } = motion;
  const last = data.steps.length - 1;
  const slider = byId<HTMLInputElement>("slider");
  const play = byId<HTMLButtonElement>("play");
  const speed = byId<HTMLSelectElement>("speed");
  const byTime = byId<HTMLInputElement>("by-time");
  const said = byId("said");
  slider.max = String(last);
  slider.disabled = play.disabled = last === 0;
  slider.addEventListener("input", () => state.goto(Number(slider.value)));
  play.addEventListener("click", () => player.toggle());
  byId("start").addEventListener("click", () => state.goto(0));
  byId("back").addEventListener("click", () => state.goto(state.now.index - 1));
  byId("forth").addEventListener("click", () => state.goto(state.now.index + 1));
  speed.addEventListener("change", () => (player.speed = Number(speed.value)));
  byTime.addEventListener("change", () => (player.byTime = byTime.checked));
  addMarks(state, motion);

  let saying = 0;
  state.listen(({ index, playing }, before) => {
    const step = `Step ${data.steps[index]!} of ${data.steps[last]!}`;
    const time = data.times[index]!;
    const seconds = `t = ${quantity(time, "s")}`;
    slider.value = String(index);
    slider.setAttribute("aria-valuetext", `${step}, ${seconds}`);
    byId("step").textContent = String(data.steps[index]!);
    byId("steps").textContent = String(data.steps[last]!);
    byId("time").textContent = seconds;
    byId("time").title = `${full(time)} s`;
    byId<HTMLButtonElement>("start").disabled = index === 0;
    byId<HTMLButtonElement>("back").disabled = index === 0;
    byId<HTMLButtonElement>("forth").disabled = index === last;
    play.dataset.playing = String(playing);
    play.setAttribute("aria-label", playing ? "Pause" : "Play");
    play.title = `${playing ? "Pause" : "Play"} (space)`;
    // Said once the step rests, not on every frame.
    clearTimeout(saying);
    if (index !== before.index) saying = setTimeout(() => (said.textContent = `${step}, ${seconds}`), 400);
  });
}

/** Marks over the slider: the first contact, pads that press or let go, and steps in which a limit is exceeded most. */
function addMarks(state: State, motion: Motion): void {
  const { data } = motion;
  const host = byId("marks");
  const last = Math.max(1, data.steps.length - 1);
  const mark = (index: number, kind: string, text: string) => {
    const button = make("button", {
      type: "button",
      class: `mark ${kind}`,
      title: text,
      tabindex: "-1",
      "aria-hidden": "true",
    });
    button.style.left = `calc(var(--thumb) / 2 + (100% - var(--thumb)) * ${index / last})`;
    button.addEventListener("click", () => state.goto(index));
    host.append(button);
  };
  const contact = nearest(data.steps, data.first_contact);
  if (contact > 0) {
    mark(contact, "mark-contact", `First contact: step ${data.first_contact!}`);
  }
  for (const { time, kind, grippers } of data.events) {
    if (kind === "grip") continue;
    const step = data.times.findIndex((t) => t >= time);
    const who = grippers.length === data.ids.length ? "all pads" : grippers.join(", ");
    const what = kind === "press" ? "press" : "let go";
    mark(step < 0 ? last : step, "mark-vacuum", `${quantity(time, "s")}: ${who} ${what}`);
  }
  const failed = new Map<number, string[]>();
  for (const limit of data.limits) {
    const index = nearest(data.steps, limit.step);
    if (!limit.ok && index >= 0) failed.set(index, [...(failed.get(index) ?? []), limit.name]);
  }
  for (const [index, names] of failed) {
    mark(index, "mark-failed", `Step ${data.steps[index]!}: ${names.join(", ")} exceeded`);
  }
}
