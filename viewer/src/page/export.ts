/**
 * The picture as it is, as PNG, and the whole motion as a video: with title, verdict, step, and the scale of the colors.
 */

import { colorAt, mapOf, shareOf } from "../data/color_map";
import type { Motion } from "../data/motion";
import { bracketed, quantity, short } from "../data/number";
import { modelText, type Field } from "../data/page_data";
import { fieldInForce } from "../data/ranges";
import { tell, type Comparison } from "./compare";
import { byId, themeColor } from "./dom";
import { beyond, legendOf } from "./legend";
import type { Player } from "./player";
import { save } from "./save";
import type { State } from "./state";

const FONT = "system-ui, -apple-system, 'Segoe UI', 'Liberation Sans', Arial, sans-serif";
/** Heights of the lines above and below the picture, and the width of the scale beside it (CSS pixels). */
const [HEAD, FOOT, SCALE] = [44, 30, 128];
/** A picture narrower than this leaves no room for the scale. */
const NARROW = 560;
/** A video is at most so wide (pixels). */
const WIDEST = 1280;
/** Containers and codecs, the best known first. */
const FORMATS = ["video/webm;codecs=vp9", "video/webm;codecs=vp8", "video/webm", "video/mp4"];
/** Pictures a second at most. */
const FRAMES = 30;
/** Bits a second, and how long the last step stays (ms). */
const [BITS, STAY] = [8e6, 700];

export class Exporter {
  private recorder: MediaRecorder | null = null;

  constructor(
    private readonly state: State,
    private readonly motion: Motion,
    private readonly comparison: Comparison,
    private readonly player: Player,
  ) {
    byId("save-png").addEventListener("click", () => void this.savePng());
    byId("save-video").addEventListener("click", () => {
      if (this.recorder !== null) this.recorder.stop();
      else void this.saveVideo();
    });
    for (const id of ["save-png", "save-video"])
      byId<HTMLButtonElement>(id).disabled = comparison.pictures.length === 0;
    byId("save-video").hidden = state.count < 2;
  }

  private async savePng(): Promise<void> {
    const sheet = this.compose(2);
    const blob = await new Promise<Blob | null>((done) => sheet.toBlob(done, "image/png"));
    if (blob === null) tell("The picture is too large for this browser.");
    else save(blob, `${this.name()}_step_${String(this.motion.data.steps[this.state.now.index])}.png`);
  }

  /** Plays the motion once and records it; a second click ends it early. */
  private async saveVideo(): Promise<void> {
    const format =
      typeof MediaRecorder === "undefined"
        ? undefined
        : FORMATS.find((type) => MediaRecorder.isTypeSupported(type));
    if (format === undefined) {
      tell(
        "This browser cannot record a video (MediaRecorder is missing). Open the page in a current Chrome, Edge or Firefox, or save pictures with PNG.",
      );
      return;
    }
    tell(null);
    const before = this.state.now.index;
    const canvas = document.createElement("canvas");
    const pen = canvas.getContext("2d")!;
    const width = this.width();
    const ratio = Math.min(2, WIDEST / width);
    const draw = () => {
      const frame = this.compose(ratio);
      // codecs want even sides
      const [w, h] = [frame.width & ~1, frame.height & ~1];
      if (canvas.width !== w) canvas.width = w;
      if (canvas.height !== h) canvas.height = h;
      pen.drawImage(frame, 0, 0);
    };
    this.state.goto(0);
    draw();
    const recorder = new MediaRecorder(canvas.captureStream(FRAMES), {
      mimeType: format,
      videoBitsPerSecond: BITS,
    });
    this.recorder = recorder;
    const parts: Blob[] = [];
    recorder.addEventListener("dataavailable", (event) => parts.push(event.data));
    const ended = new Promise((done) => recorder.addEventListener("stop", done));
    const button = byId("save-video");
    button.textContent = "Stop";
    button.classList.add("recording");
    recorder.start();
    const schedule = this.player.schedule();
    const runs = () => recorder.state === "recording";
    // every step is in the video: on a slow machine it takes longer
    let shown = schedule[0]!;
    for (let index = 1; index < schedule.length && runs(); index++) {
      const last = index === schedule.length - 1;
      const pause = schedule[index]! - shown;
      if (pause < 1 / FRAMES && !last) continue;
      shown = schedule[index]!;
      await wait(1000 * Math.max(pause, 1 / FRAMES));
      this.state.goto(index);
      draw();
    }
    if (runs()) {
      await wait(STAY);
      draw();
      await wait(2000 / FRAMES);
      if (runs()) recorder.stop();
    }
    await ended;
    this.recorder = null;
    button.textContent = "Video";
    button.classList.remove("recording");
    this.state.goto(before);
    const blob = new Blob(parts, { type: format.split(";")[0]! });
    save(blob, `${this.name()}.${format.startsWith("video/mp4") ? "mp4" : "webm"}`);
  }

  /** Width of the pictures, and of the room for the scale beside them; one wide picture has room for it (CSS pixels). */
  private widths(): [number, number] {
    const { pictures } = this.comparison;
    const wide = pictures.reduce((sum, { scene }) => sum + scene.extent[0], 0);
    const inside = this.field() === null || (pictures.length === 1 && wide >= NARROW);
    return [wide, inside ? 0 : SCALE];
  }

  /** Width of the whole (CSS pixels). */
  private width(): number {
    const [pictures, scale] = this.widths();
    return pictures + scale;
  }

  /** The colors that are shown, if any are. */
  private field(): Field | null {
    return fieldInForce(this.motion, this.state.now) ?? null;
  }

  /** Pictures, scale and words on one sheet, this many pixels for one of CSS. */
  private compose(ratio: number): HTMLCanvasElement {
    const { data } = this.motion;
    const { now } = this.state;
    const { pictures } = this.comparison;
    const tall = Math.max(...pictures.map(({ scene }) => scene.extent[1]));
    const sheet = document.createElement("canvas");
    sheet.width = Math.round(this.width() * ratio);
    sheet.height = Math.round((HEAD + tall + FOOT) * ratio);
    const pen = sheet.getContext("2d")!;
    pen.scale(ratio, ratio);
    pen.fillStyle = themeColor("surface");
    pen.fillRect(0, 0, this.width(), HEAD + tall + FOOT);
    pen.textBaseline = "middle";
    const write = (text: string, x: number, y: number, font: string, color: string) => {
      pen.font = `${font} ${FONT}`;
      pen.fillStyle = themeColor(color);
      pen.fillText(text, x, y);
      return pen.measureText(text).width;
    };
    const compared = this.comparison.isOpen;
    let left = 0;
    for (const { letter, title, accepted, scene } of pictures) {
      const [width] = scene.extent;
      pen.drawImage(scene.still(ratio), left, HEAD, width, scene.extent[1]);
      pen.save();
      pen.beginPath();
      pen.rect(left, 0, width - 8, HEAD);
      pen.clip();
      const used = write(compared ? `${letter}: ${title}` : title, left + 14, HEAD / 2, "600 16px", "text");
      const word = accepted ? "✓ accepted" : "✗ not accepted";
      write(word, left + 28 + used, HEAD / 2, "600 13px", accepted ? "pass" : "fail");
      pen.restore();
      left += width;
    }
    const field = this.field();
    if (field !== null) this.drawScale(pen, field, this.width() - SCALE + 12, HEAD, tall);
    const step = `Step ${String(data.steps[now.index])} of ${String(data.steps[data.steps.length - 1])}`;
    const model = modelText(data, now.model);
    const foot = `${step}, t = ${quantity(data.times[now.index]!, "s")}, ${model}${compared ? " (step and time of A)" : ""}`;
    const arrow = byId("force-scale");
    const loads = arrow.hidden ? "" : `, ${arrow.querySelector("b")?.textContent ?? ""}`;
    write(foot + loads, 14, HEAD + tall + FOOT / 2, "13px", "text-quiet");
    return sheet;
  }

  private drawScale(
    pen: CanvasRenderingContext2D,
    field: Field,
    left: number,
    top: number,
    tall: number,
  ): void {
    const facts = legendOf(field);
    pen.font = `12px ${FONT}`;
    pen.fillStyle = themeColor("text");
    const words = `${field.label}${bracketed(field.unit)}`.replace(/^./, (c) => c.toUpperCase()).split(" ");
    const lines: string[] = [];
    for (const word of words) {
      const longer = lines.length === 0 ? word : `${lines[lines.length - 1]!} ${word}`;
      if (lines.length > 0 && pen.measureText(longer).width <= SCALE - 18) lines[lines.length - 1] = longer;
      else lines.push(word);
    }
    const height = Math.min(250, 0.5 * tall);
    const first = top + (tall - height) / 2;
    lines.forEach((line, k) => pen.fillText(line, left, first - 18 - 15 * (lines.length - 1 - k)));
    const map = mapOf(field);
    for (let y = 0; y < height; y++) {
      pen.fillStyle = `rgb(${colorAt(map, 1 - y / (height - 1)).join(" ")})`;
      pen.fillRect(left, first + y, 15, 1.5);
    }
    pen.strokeStyle = themeColor("line");
    pen.strokeRect(left, first, 15, height);
    const at = (value: number) => first + height * (1 - shareOf(field, value));
    pen.fillStyle = themeColor("text");
    for (const tick of facts.ticks) {
      pen.fillRect(left + 16, at(tick) - 0.5, 5, 1);
      pen.fillText(beyond(field, tick) + short(tick), left + 25, at(tick));
    }
    const { limit } = field;
    if (limit !== null && limit >= field.low && limit <= field.high) {
      pen.fillStyle = themeColor("red");
      pen.fillRect(left - 4, at(limit) - 1, 23, 2);
      const text = `limit ${short(limit)}`;
      pen.font = `600 12px ${FONT}`;
      pen.fillStyle = themeColor("surface");
      pen.fillRect(left + 22, at(limit) - 8, pen.measureText(text).width + 6, 16);
      pen.fillStyle = themeColor("red");
      pen.fillText(text, left + 25, at(limit));
    }
  }

  /** A name for files, of letters and digits. */
  private name(): string {
    const name = this.motion.data.title
      .toLowerCase()
      .replace(/[^a-z0-9]+/g, "_")
      .replace(/^_|_$/g, "");
    return name === "" ? "plydrape" : name;
  }
}

async function wait(milliseconds: number): Promise<void> {
  await new Promise((done) => setTimeout(done, milliseconds));
}
