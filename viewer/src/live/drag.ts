/** Dragging a gripper: where the pointer takes it, in the plane of the screen, level or straight up and down. */

import { Vector3 } from "three";
import type { Place } from "../data/page_data";
import type { Scene3d } from "../scene/scene3d";

export const WAYS = ["screen", "level", "upright"] as const;
export type Way = (typeof WAYS)[number];

/** The coordinates that a way of dragging does not change. */
export const KEPT: Record<Way, boolean[]> = {
  screen: [false, false, false],
  level: [false, false, true],
  upright: [true, true, false],
};

/** A finger takes hold of a gripper within this distance (CSS pixels). */
const FINGER = 30;
/** A plane that is seen under a flatter angle than this (its sine) is dragged as if under this one. */
const FLATTEST = 0.2;

export interface Dragging {
  /** The way that the reader has chosen; Shift and Alt change it while they are held. */
  way: () => Way;
  /** Where a gripper is (m). */
  place: (gripper: number) => Place;
  taken: (gripper: number) => void;
  moved: (gripper: number, to: Place, way: Way) => void;
  dropped: (gripper: number) => void;
}

/** What a move across the picture (CSS pixels) is in the scene (m). */
export function displacement(scene: Scene3d, [dx, dy]: [number, number], way: Way): Place {
  const { zoom } = scene.eye.camera;
  const direction = scene.eye.direction();
  const right = new Vector3(0, 0, 1).cross(direction).normalize();
  const above = direction.clone().cross(right);
  const [across, up] = [dx / zoom, -dy / zoom];
  switch (way) {
    case "screen":
      return right.multiplyScalar(across).addScaledVector(above, up).toArray();
    case "level": {
      const slant = Math.max(Math.abs(direction.z), FLATTEST) * (direction.z < 0 ? -1 : 1);
      return [across * right.x - (up / slant) * right.y, across * right.y + (up / slant) * right.x, 0];
    }
    case "upright":
      return [0, 0, up / Math.max(above.z, FLATTEST)];
  }
}

/** Lets the reader drag the grippers of a picture; elsewhere the picture is turned and moved as before. */
export function linkDrag(view: HTMLElement, scene: Scene3d, acts: Dragging): void {
  let held: { gripper: number; pointer: number; at: [number, number]; from: Place } | null = null;
  const placeOf = (event: { clientX: number; clientY: number }): [number, number] => {
    const box = view.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };
  const wayOf = (event: PointerEvent): Way =>
    event.shiftKey ? "level" : event.altKey ? "upright" : acts.way();
  const under = (event: PointerEvent): number | null => {
    const reach = event.pointerType === "touch" ? FINGER : undefined;
    return scene.gripperUnder(placeOf(event), reach)?.number ?? null;
  };

  // before the eye hears of it
  view.addEventListener(
    "pointerdown",
    (event) => {
      const gripper = event.button === 0 && held === null ? under(event) : null;
      if (gripper === null) return;
      event.stopPropagation();
      view.setPointerCapture(event.pointerId);
      held = { gripper, pointer: event.pointerId, at: placeOf(event), from: acts.place(gripper) };
      view.classList.add("dragging");
      acts.taken(gripper);
    },
    { capture: true },
  );
  view.addEventListener("pointermove", (event) => {
    if (held === null) {
      if (event.buttons === 0) view.classList.toggle("over-gripper", under(event) !== null);
      return;
    }
    if (event.pointerId !== held.pointer) return;
    const [x, y] = placeOf(event);
    const way = wayOf(event);
    const by = displacement(scene, [x - held.at[0], y - held.at[1]], way);
    acts.moved(held.gripper, held.from.map((c, n) => c + by[n]!) as Place, way);
  });
  const drop = (event: PointerEvent) => {
    if (event.pointerId !== held?.pointer) return;
    const { gripper } = held;
    held = null;
    view.classList.remove("dragging");
    acts.dropped(gripper);
  };
  view.addEventListener("pointerup", drop);
  view.addEventListener("pointercancel", drop);
  // a finger that holds a gripper does not scroll the page
  view.addEventListener(
    "touchstart",
    (event) => {
      const touch = event.touches[0];
      if (touch !== undefined && scene.gripperUnder(placeOf(touch), FINGER) !== null) event.preventDefault();
    },
    { passive: false },
  );
}
