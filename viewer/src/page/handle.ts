/**
 * `window.plydrape`: the page for scripts and tests. Steps are numbered as in the result.
 */

import { Vector3 } from "three";
import type { FabricLine, LinePoint } from "../data/fabric_line";
import type { Drape } from "../data/drape";
import { MICRO, type Motion } from "../data/motion";
import type { FieldKey, Measure, Model, Place } from "../data/page_data";
import { fieldInForce } from "../data/ranges";
import type { Scene3d } from "../scene/scene3d";
import type { Comparison } from "./compare";
import { legendOf, type LegendFacts } from "./legend";
import type { Player } from "./player";
import type { Section } from "./section";
import type { State } from "./state";
import { chooseModel } from "./toolbar";

export interface Handle {
  /** Resolves when everything is drawn; rejects if the data is broken. */
  readonly ready: Promise<void>;
}

export interface FullHandle extends Handle {
  /** The number of the step in view. */
  readonly step: number;
  readonly steps: number[];
  /** Goes to the step with this number. */
  goto(step: number): void;
  play(speed?: number): void;
  pause(): void;
  readonly playing: boolean;
  /** Milliseconds between the frames while playing. */
  readonly frames: number[];
  /** The model that is shown; can be set. */
  model: Model;
  /** A node of the sheet in view (m), or null where none is shown. */
  node(number: number): Place | null;
  /** A gripper in view (m), or null where the model has not done the step. */
  gripper(number: number): Place | null;
  /** Fabric coordinates of a node of the sheet (mm), or null without a sheet. */
  fabric(number: number): [number, number] | null;
  /** Where a place is on the picture (CSS pixels from its top left), or null without a picture. */
  onScreen(place: Place): [number, number] | null;
  /** Color mode; can be set. */
  color: FieldKey;
  readonly colors: FieldKey[];
  legend(): LegendFacts;
  /** The numbers of the charts in view. */
  readonly measures: Measure[];
  /** Vertex of the surface as drawn (m); u runs fastest. */
  vertex(index: number): Place;
  /** The fabric line of the section; can be set, and null closes it. */
  section: FabricLine | null;
  /** The points of the section as they are charted, or null without one. */
  sectionPoints(): LinePoint[] | null;
  /** Takes a second result from the text of its report.html or result.json. */
  compare(text: string, name: string): Promise<void>;
  /** The number of the step of the second result that is shown, or null without one. */
  readonly otherStep: number | null;
  /** The place that is pointed at, or null. */
  readonly pointer: { step: number; place: Place; label: string } | null;
  /** Whether there is a 3D picture. */
  readonly webgl: boolean;
}

export function handle(
  ready: Promise<void>,
  state: State,
  player: Player,
  motion: Motion,
  scene: Scene3d | null,
  section: Section,
  comparison: Comparison,
): FullHandle {
  const { data } = motion;
  const shown = () => motion.drape(state.now.model);
  return {
    ready,
    get step() {
      return data.steps[state.now.index]!;
    },
    steps: data.steps,
    goto: (step) => state.goto(data.steps.indexOf(step)),
    play: (speed = 1) => {
      player.speed = speed;
      player.play();
    },
    pause: () => player.pause(),
    get playing() {
      return state.now.playing;
    },
    frames: player.frames,
    get model() {
      return state.now.model;
    },
    set model(model) {
      chooseModel(state, data, model);
    },
    node: (number) => {
      const { sheet } = shown();
      const picture = shown().picture(state.now.index);
      return sheet === null || picture === null ? null : sheet.node(picture, number);
    },
    gripper: (number) => {
      const pads = shown().pads(state.now.index);
      return pads.length === 0 ? null : ([0, 1, 2].map((c) => pads[3 * number + c]! * MICRO) as Place);
    },
    fabric: (number) => {
      const places = shown().sheet?.places;
      return places === undefined ? null : [places[2 * number]! / 1000, places[2 * number + 1]! / 1000];
    },
    onScreen: (place) => scene?.eye.project(new Vector3(...place)) ?? null,
    get color() {
      return state.now.color;
    },
    set color(color) {
      state.set({ color });
    },
    get colors() {
      return shown().data.fields.map((field) => field.key);
    },
    legend: () => legendOf(fieldInForce(motion, state.now)!),
    get measures() {
      return shown().data.measures;
    },
    vertex: (index) => scene?.vertex(index) ?? stored(shown(), state.now.index, index),
    get section() {
      return state.now.section;
    },
    set section(line) {
      state.set({ section: line });
    },
    sectionPoints: () => section.facts()?.points ?? null,
    compare: (text, name) => comparison.take(text, name),
    get otherStep() {
      const { other, otherIndex } = state.now;
      return other === null ? null : other.data.steps[otherIndex]!;
    },
    get pointer() {
      const { pointer } = state.now;
      return pointer && { step: data.steps[pointer.index]!, place: pointer.place, label: pointer.label };
    },
    webgl: scene !== null,
  };
}

function stored(drape: Drape, step: number, index: number): Place {
  const points = drape.points(step);
  return [0, 1, 2].map((c) => points[3 * index + c]! * MICRO) as Place;
}
