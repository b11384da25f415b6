/**
 * Plays the steps. Each picture is a computed step; nothing is made up between two of them.
 */

import type { State } from "./state";

/** Even pace: a step takes this long (s), within these limits for the whole motion. */
const STEP = 0.12;
const SHORTEST = 2.5;
const LONGEST = 9;

export class Player {
  /** Times of the frames drawn while playing (ms since the one before), the latest 1000. */
  readonly frames: number[] = [];
  /** Times as fast. */
  speed = 1;
  /** Follow the times of the steps instead of an even pace. */
  byTime = false;
  private clock = 0;
  private last = 0;

  constructor(
    private readonly state: State,
    private readonly times: number[],
  ) {
    state.listen((now, before) => {
      if (now.playing && !before.playing) this.start();
    });
  }

  /** Plays on, or from the start if the end is reached. */
  play(): void {
    if (this.state.count < 2) return;
    const { index } = this.state.now;
    this.state.set({ index: index === this.state.count - 1 ? 0 : index, playing: true });
  }

  pause(): void {
    this.state.set({ playing: false });
  }

  toggle(): void {
    if (this.state.now.playing) this.pause();
    else this.play();
  }

  /** Seconds of playing from the first step to each. */
  schedule(): number[] {
    const last = this.times.length - 1;
    const span = this.times[last]! - this.times[0]!;
    if (this.byTime && span > 0) return this.times.map((t) => (t - this.times[0]!) / this.speed);
    if (last === 0) return [0];
    const whole = Math.min(Math.max(STEP * last, SHORTEST), LONGEST) / this.speed;
    return this.times.map((_, k) => (whole * k) / last);
  }

  private start(): void {
    this.clock = this.schedule()[this.state.now.index]!;
    this.last = 0;
    this.frames.length = 0;
    requestAnimationFrame((now) => this.frame(now));
  }

  private frame(now: number): void {
    if (!this.state.now.playing) return;
    if (this.last > 0) {
      const passed = now - this.last;
      this.frames.push(passed);
      if (this.frames.length > 1000) this.frames.shift();
      this.clock += passed / 1000;
    }
    this.last = now;
    const schedule = this.schedule();
    let index = this.state.now.index;
    while (index + 1 < schedule.length && schedule[index + 1]! <= this.clock) index++;
    const ended = index === schedule.length - 1;
    this.state.set({ index, playing: !ended });
    if (!ended) requestAnimationFrame((next) => this.frame(next));
  }
}
