/** The picture of the sheet: its cells, the forces on its pads, and what lies under the mouse. */

import { Group, Vector3 } from "three";
import { MICRO } from "../data/micro";
import type { Field, Place } from "../data/page_data";
import type { SheetStates } from "../data/sheet_states";
import type { Eye } from "./camera";
import { Forces } from "./forces";
import { SheetSurface } from "./sheet_surface";

/** A node or a gripper is found within this distance of the mouse (CSS pixels). */
const REACH = 16;

/** A node or a gripper under the mouse. */
export interface Found {
  kind: "node" | "gripper";
  number: number;
  place: Place;
}

export class SheetPicture {
  readonly group = new Group();
  private readonly surface: SheetSurface;
  private readonly forces: Forces;
  private state: number | null = null;

  /** `size` is that of the scene, `spacing` the distance of neighbouring grippers (m). */
  constructor(
    private readonly sheet: SheetStates,
    private readonly size: number,
    private readonly spacing: number,
  ) {
    this.surface = new SheetSurface(sheet, 0.003 * size);
    this.forces = new Forces(sheet, Math.min(0.8 * spacing, 0.12 * size), 0.5 * size);
    this.forces.order = 6;
    this.group.add(this.surface.mesh, this.forces.group);
  }

  /** Takes the colours of the arrows. */
  ink(colours: string[]): void {
    this.forces.ink(colours);
  }

  /** Moves to a step of the page; without a state there is nothing to see. */
  moveTo(index: number): void {
    this.state = this.sheet.stateOf(index);
    this.surface.mesh.visible = this.state !== null;
    this.forces.group.visible = this.state !== null;
    if (this.state === null) return;
    this.surface.moveTo(this.state);
    this.forces.moveTo(this.state);
  }

  /** Positions and normals of the pads in the step that is shown, as they are packed. */
  pads(): [Int32Array, Int32Array] | null {
    return this.state === null
      ? null
      : [this.sheet.grippers.at(this.state), this.sheet.normals.at(this.state)];
  }

  colour(field: Field, index: number): void {
    this.surface.colour(field, index);
  }

  useMap(field: Field): void {
    this.surface.useMap(field);
  }

  showForces(shown: boolean): void {
    this.forces.group.visible = shown && this.state !== null;
  }

  /** Draws fabric lines where they are far enough apart, at so many CSS pixels a metre. */
  suit(zoom: number): void {
    const along = Math.sqrt(this.sheet.data.cells.length / 4 / Math.max(1, this.sheet.grippers.count));
    this.surface.showThreads((zoom * this.spacing) / Math.max(1, along));
  }

  /** The node or gripper nearest to a place on the picture (CSS pixels) of those that no other one hides by far. */
  under(eye: Eye, [x, y]: [number, number]): Found | null {
    if (this.state === null) return null;
    const towards = eye.direction();
    const point = new Vector3();
    let found: (Found & { rank: number }) | null = null;
    const look = (kind: Found["kind"], points: Int32Array, favour: number) => {
      for (let k = 0; 3 * k < points.length; k++) {
        point.set(points[3 * k]! * MICRO, points[3 * k + 1]! * MICRO, points[3 * k + 2]! * MICRO);
        const depth = point.dot(towards);
        const place: Place = [point.x, point.y, point.z];
        const [px, py] = eye.project(point);
        const away = Math.hypot(px - x, py - y);
        if (away > REACH) continue;
        // one that is farther from the eye by a tenth of the scene is behind the ply
        const rank = away - favour - (REACH * depth) / (0.1 * this.size);
        if (found === null || rank < found.rank) found = { kind, number: k, place, rank };
      }
    };
    look("node", this.sheet.positions.at(this.state), 0);
    look("gripper", this.sheet.grippers.at(this.state), REACH / 3);
    return found;
  }
}
