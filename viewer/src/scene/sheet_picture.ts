/** The picture of the sheet: its cells. */

import { Group } from "three";
import type { Field } from "../data/page_data";
import type { SheetStates } from "../data/sheet_states";
import type { PlyPicture } from "./ply_picture";
import { SheetSurface } from "./sheet_surface";

export class SheetPicture implements PlyPicture {
  readonly group = new Group();
  private readonly surface: SheetSurface;
  readonly fineness: number;

  /** `size` is that of the scene, `spacing` the distance of neighboring grippers (m). */
  constructor(sheet: SheetStates, size: number, spacing: number, grippers: number) {
    this.surface = new SheetSurface(sheet, 0.003 * size);
    this.fineness = spacing / Math.max(1, Math.sqrt(sheet.data.cells.length / 4 / Math.max(1, grippers)));
    this.group.add(this.surface.mesh);
  }

  ink(): void {
    // it has no lines of its own
  }

  moveTo(picture: number): void {
    this.surface.moveTo(picture);
  }

  color(field: Field, picture: number): void {
    this.surface.color(field, picture);
  }

  useMap(field: Field): void {
    this.surface.useMap(field);
  }

  showDiagonals(): void {
    // it has none
  }

  suit(zoom: number): void {
    this.surface.showThreads(zoom * this.fineness);
  }

  thin(): void {
    // it is drawn whole
  }

  vertex(): null {
    return null;
  }
}
