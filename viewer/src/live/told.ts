/** What the page says of a ply: the verdict, the limits, numbers, and what the solver refused. */

import { quantity } from "../data/number";
import type { GripperId, Limit, Place } from "../data/page_data";
import { byId, make, renew } from "../page/dom";
import { limitCells, sign } from "../page/limits";
import type { Mark } from "../scene/overlay";
import type { Scene3d } from "../scene/scene3d";
import type { Hanging, Refused } from "./solver";

/** The limit that is exceeded most; null if all are kept. */
function worst(limits: Limit[]): Limit | null {
  const failed = limits.filter(({ ok }) => !ok);
  return failed.reduce<Limit | null>(
    (most, limit) => (most !== null && most.ratio >= limit.ratio ? most : limit),
    null,
  );
}

/** Whether the ply is as it should be, a name for what is wrong with it, and the sentence that says so. */
export function verdictOf({ page, found }: Hanging): { ok: boolean; name: string; text: string } {
  if (!found) return { ok: false, name: "no equilibrium", text: "No equilibrium found" };
  const { limits } = page;
  const most = worst(limits);
  if (most === null) return { ok: true, name: "kept", text: `All ${limits.length} limits kept` };
  const { name, value, unit, least, limit, where } = most;
  const allowed = `${least ? "at least" : "at most"} ${quantity(limit, unit)} allowed`;
  const Name = name.charAt(0).toUpperCase() + name.slice(1);
  return { ok: false, name, text: `${Name} ${quantity(value, unit)}, ${allowed} (${where})` };
}

/** The verdict in the head, with the model that it is of. */
export function showVerdict(hanging: Hanging): void {
  const badge = byId("verdict");
  const { ok, text } = verdictOf(hanging);
  badge.className = ok ? "verdict pass" : "verdict fail";
  const model = make(
    "span",
    { class: "reason model" },
    " by the catenaries: lines of ply, not the sheet that decides on motions",
  );
  renew(badge, [sign(ok), text, model]);
}

/** The table of limits, and some numbers. */
export function showNumbers({ page }: Hanging): void {
  const rows = page.limits.map((limit) =>
    make("tr", { class: limit.ok ? "pass" : "fail" }, ...limitCells(limit)),
  );
  renew(byId("limits-body"), rows);
  // what has a limit is in the table
  const others = page.drape.measures.filter(({ limit }) => limit === null);
  const told = others.flatMap(({ label, unit, values: [value = null], where: [at = null] }) =>
    value === null
      ? []
      : [make("dt", {}, label), make("dd", {}, `${quantity(value, unit)}, ${at ?? "nowhere"}`)],
  );
  renew(byId("numbers"), told);
}

/** How the search ended where it found no equilibrium. */
const ENDS: Record<string, string> = {
  stalled: "no step improves it any further",
  "iteration-limit": "the limit of iterations came first",
  "length-not-met": "no force gives a span its length",
  "round-limit": "the contact with the mold goes on changing",
};

/** Says over the picture why the ply is not where it was asked for, or that its numbers do not count; nothing if neither. */
export function say(refused: Refused | null, hanging: Hanging | null): void {
  const note = byId("live-said");
  const parts: (Node | string)[] = [];
  if (refused !== null) {
    // the scene says where grippers start, the page where they are
    const why = refused.refused
      .replace(/\bare (.*) apart at the start/, "would be $1 apart")
      .replace(" starts ", " would be ");
    parts.push(`${why.charAt(0).toUpperCase()}${why.slice(1)}.`);
    // a gripper at the end of its reach is where the picture shows it
    if (!refused.reached) parts.push(make("b", {}, " Shown is the last ply that hangs."));
  } else if (hanging?.found === false) {
    const why =
      hanging.status.map((status) => ENDS[status]).find((text) => text !== undefined) ??
      hanging.status.join(", ");
    parts.push(
      make("b", {}, "No equilibrium was found"),
      `: ${why}. The last state of the search is shown, and its numbers do not count.`,
    );
  }
  note.hidden = parts.length === 0;
  renew(note, parts);
}

/** Between grippers that are less than so far apart on the picture there is no room for a force (CSS pixels). */
const ROOM = 64;

/**
 * The forces of the edges as texts in the picture, where there is room for them. What the mold holds has none: it would be that of
 * the axial stiffness.
 */
export function forceMarks({ catenaries, page }: Hanging, grippers: Place[], scene: Scene3d): Mark[] {
  const screen = scene.eye.screen();
  const at = (id: GripperId) => grippers[id[1] * page.drape.catenaries!.grid[0] + id[0]]!;
  return catenaries
    .filter(({ kind }) => kind.startsWith("edge"))
    .filter(({ from, to }) => {
      const [a, b] = [at(from), at(to)];
      return Math.hypot(screen(a, 0) - screen(b, 0), screen(a, 1) - screen(b, 1)) > ROOM;
    })
    .map(({ forces: [force = null], holds, touches, middle }) => {
      const text = touches ? (holds.every((hold) => hold === "lying") ? "lies" : "touches") : null;
      return { place: middle, text: text ?? (force === null ? "taut" : `${force.toPrecision(3)}\u00a0N`) };
    });
}
