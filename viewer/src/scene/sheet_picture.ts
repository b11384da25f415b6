/** The picture of the sheet: its cells, and the forces on its pads. */

import { Group } from "three";
import type { Field } from "../data/page_data";
import type { SheetStates } from "../data/sheet_states";
import { Forces } from "./forces";
import { SheetSurface } from "./sheet_surface";

export class SheetPicture {
  readonly group = new Group();
  private readonly surface: SheetSurface;
  private readonly forces: Forces;
  private state: number | null = null;

  /** `size` is that of the scene, `spacing` the distance of neighboring grippers (m). */
  constructor(
    private readonly sheet: SheetStates,
    size: number,
    private readonly spacing: number,
  ) {
    this.surface = new SheetSurface(sheet, 0.003 * size);
    this.forces = new Forces(sheet, Math.min(0.8 * spacing, 0.12 * size), 0.5 * size);
    this.forces.order = 6;
    this.group.add(this.surface.mesh, this.forces.group);
  }

  /** Takes the colors of the arrows. */
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

  /** Draws fabric lines where they are far enough apart, at so many CSS pixels a meter. */
  suit(zoom: number): void {
    const along = Math.sqrt(this.sheet.data.cells.length / 4 / Math.max(1, this.sheet.grippers.count));
    this.surface.showThreads((zoom * this.spacing) / Math.max(1, along));
  }
}
