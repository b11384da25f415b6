/** The picture of the catenaries: the surface between them, their lines, and where they touch. */

import { Group } from "three";
import type { CatenaryStates } from "../data/catenary_states";
import type { Field, Place } from "../data/page_data";
import { Catenaries } from "./catenaries";
import { Contacts } from "./contacts";
import type { PlyPicture } from "./ply_picture";
import { PlySurface } from "./surface";

/** A ply with fewer vertices is drawn with all of them: leaving some out would save nothing. */
const MANY = 20_000;

export class CatenaryPicture implements PlyPicture {
  readonly group = new Group();
  private readonly surface: PlySurface;
  private readonly lines: Catenaries;
  private readonly contacts: Contacts;

  /** `size` is that of the scene, `spacing` the distance of neighboring grippers (m). */
  constructor(
    private readonly states: CatenaryStates,
    size: number,
    private readonly spacing: number,
  ) {
    this.surface = new PlySurface(states, 0.003 * size);
    this.lines = new Catenaries(states, 0.0005 * size, 0.02 * size);
    this.contacts = new Contacts(states, -0.003 * size);
    this.lines.order = 3;
    this.contacts.points.renderOrder = 4;
    this.group.add(this.surface.mesh, this.lines.group, this.contacts.points);
  }

  ink(line: string): void {
    this.lines.ink(line);
    this.contacts.ink(line);
  }

  moveTo(picture: number): void {
    this.surface.moveTo(picture);
    this.lines.moveTo(picture);
    this.contacts.moveTo(picture);
  }

  color(field: Field, picture: number): void {
    this.surface.color(field, picture);
  }

  useMap(field: Field): void {
    this.surface.useMap(field);
  }

  showDiagonals(shown: boolean): void {
    this.lines.showDiagonals(shown);
  }

  suit(zoom: number): void {
    const apart = zoom * this.spacing;
    this.surface.showThreads(apart / this.states.data.divisions);
    this.lines.suit(apart);
    this.contacts.suit(apart);
  }

  thin(zoom: number | null): void {
    const stride = zoom === null ? 1 : this.stride(zoom);
    this.surface.thin(stride);
    this.lines.thin(stride);
  }

  vertex(at: number): Place | null {
    return this.surface.vertex(at) ?? this.lines.vertex(at);
  }

  get fineness(): number {
    return this.spacing / this.states.data.divisions;
  }

  /** Every second vertex is left out; where cells are small on the screen, all but two or three pieces a side. */
  private stride(zoom: number): number {
    const n = this.states.data.divisions;
    if (n % 2 !== 0 || this.states.positions.count < MANY) return 1;
    return zoom * this.spacing < 60 ? (n % 3 === 0 ? n / 3 : n / 2) : 2;
  }
}
