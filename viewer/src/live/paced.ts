/** Something that every frame asks for and that is done less often. */

export class Paced {
  private last = -Infinity;
  private timer: number | null = null;

  /** Does `act` at most once in `apart` milliseconds; a call in between is done when they have passed. */
  constructor(
    private readonly act: () => void,
    private readonly apart: number,
  ) {}

  want(): void {
    if (this.timer !== null) return;
    const wait = this.last + this.apart - performance.now();
    if (wait <= 0) this.now();
    else this.timer = setTimeout(() => this.now(), wait);
  }

  /** Does it at once. */
  now(): void {
    if (this.timer !== null) clearTimeout(this.timer);
    this.timer = null;
    this.last = performance.now();
    this.act();
  }
}
