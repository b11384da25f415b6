/**
 * What the reader has chosen: the step, the color mode, what is shown, and a place that is pointed at.
 * Every part of the page listens here, so that none needs to know another.
 */

import type { FabricLine } from "../data/fabric_line";
import type { Motion } from "../data/motion";
import type { FieldKey, Model, Place } from "../data/page_data";

/** A place on the ply that the view points at, in one step only. */
export interface Pointer {
  index: number;
  place: Place;
  label: string;
}

export interface Choice {
  /** Index of the step, from 0. */
  index: number;
  /** The model of the ply that is shown. */
  model: Model;
  color: FieldKey;
  /** Colors span the values of the step in view, not those of all steps. */
  stepRange: boolean;
  /** Scales of orders, where a color mode can have one. */
  orders: boolean;
  diagonals: boolean;
  mold: boolean;
  /** Bodies, obstacles and tool. */
  cell: boolean;
  /** Forces of the ply on the pads. */
  forces: boolean;
  /** Lines along which the grippers move. */
  paths: boolean;
  /** The fabric line of the section; null while there is none. */
  section: FabricLine | null;
  /** A second result, and the index of the step that is shown of it. */
  other: Motion | null;
  otherIndex: number;
  playing: boolean;
  /** Counts the answers of the solver of a live page; that of a result has one. */
  answer: number;
  dark: boolean;
  pointer: Pointer | null;
}

type Listener = (now: Choice, before: Choice) => void;

export class State {
  private readonly listeners: Listener[] = [];
  /** Index of the step of a second result that is compared with one of this result. */
  partner: ((index: number) => number) | null = null;

  constructor(
    private choice: Choice,
    readonly count: number,
  ) {}

  get now(): Readonly<Choice> {
    return this.choice;
  }

  /** Calls the listener now and after every change. */
  listen(listener: Listener): void {
    this.listeners.push(listener);
    listener(this.choice, this.choice);
  }

  set(change: Partial<Choice>): void {
    const before = this.choice;
    const now = { ...before, ...change };
    now.index = Math.min(Math.max(Math.round(now.index), 0), this.count - 1);
    if (this.partner !== null && now.index !== before.index) now.otherIndex = this.partner(now.index);
    if (now.pointer !== null && now.pointer.index !== now.index) now.pointer = null;
    const same = (Object.keys(now) as (keyof Choice)[]).every((key) => now[key] === before[key]);
    if (same) return;
    this.choice = now;
    for (const listener of this.listeners) listener(now, before);
  }

  /** Goes to a step by index, and stops playing. */
  goto(index: number): void {
    this.set({ index, playing: false });
  }
}
