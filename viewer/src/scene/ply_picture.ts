/** The ply as a model draws it. */

import type { Group } from "three";
import type { Field, Place } from "../data/page_data";

export interface PlyPicture {
  readonly group: Group;
  /** Takes the color of lines. */
  ink: (line: string) => void;
  /** Shows one of its pictures. */
  moveTo: (picture: number) => void;
  color: (field: Field, picture: number) => void;
  /** Loads the color map of a field. */
  useMap: (field: Field) => void;
  showDiagonals: (shown: boolean) => void;
  /** Suits what it draws to this many CSS pixels a meter. */
  suit: (zoom: number) => void;
  /** Leaves vertices out at this many CSS pixels a meter, or draws all of them for null. */
  thin: (zoom: number | null) => void;
  /** A vertex as it is drawn now (m), of a surface between catenaries. */
  vertex: (at: number) => Place | null;
  /** Distance of neighboring points (m), about. */
  readonly fineness: number;
}
