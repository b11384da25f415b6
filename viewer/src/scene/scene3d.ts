/**
 * The 3D picture: what is drawn, in which order, and when. It draws on demand only: after a change of the
 * step, the eye, the size or the theme.
 */

import { Box3, Color, Scene, Vector3, WebGLRenderer } from "three";
import { MICRO, type Motion } from "../data/motion";
import { pieces } from "../data/fabric_line";
import type { Drape } from "../data/drape";
import type { Field, Model, Place } from "../data/page_data";
import { fieldInForce } from "../data/ranges";
import { themeColor } from "../page/dom";
import type { Choice, State } from "../page/state";
import { AxesBox } from "./axes_box";
import { Eye } from "./camera";
import { CatenaryPicture } from "./catenary_picture";
import { Cell } from "./cell";
import { Forces, USES } from "./forces";
import { Grippers } from "./grippers";
import { pixelRatio, resolution } from "./lines";
import { LookPicture } from "./look";
import { Mold } from "./mold";
import { Overlay } from "./overlay";
import { Paths } from "./paths";
import type { PlyPicture } from "./ply_picture";
import { SectionLine } from "./section_line";
import { SheetPicture } from "./sheet_picture";

/** A node or a gripper is found within this distance of the pointer (CSS pixels). */
const REACH = 16;

/** A node of the sheet, or a vertex of the surface between the catenaries, or a gripper under the pointer. */
export interface Found {
  kind: "node" | "gripper";
  number: number;
  place: Place;
}

/** More pixels of the device in one CSS pixel are not drawn. */
const MOST_PIXELS = 2;
/** A moving picture with slower frames (ms) gets coarser; one that rests this long (ms) is drawn finely again. */
const SLOW = 40;
const REST = 250;

/** How far mold and axes box are pushed back, as shares of the size of the scene. */
const MOLD = 0.02;
const BOX = 0.03;

export class Scene3d {
  /** The ply by each model that was draped. */
  private readonly pictures = new Map<Model, PlyPicture>();
  readonly eye: Eye;
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly grippers: Grippers;
  private readonly forces: Forces;
  private mold: Mold | null;
  private readonly cell: Cell | null;
  private readonly paths: Paths;
  private readonly line: SectionLine;
  private readonly look: LookPicture | null;
  private bounds: Box3;
  private box: AxesBox;
  readonly overlay: Overlay;
  private waiting: number | null = null;
  private coarse = false;
  private lastDrawn = 0;
  private slowFrames = 0;
  private resting = 0;
  private readonly size: number;
  private width = 1;
  private height = 1;

  /** Throws where WebGL is missing. */
  constructor(
    private readonly host: HTMLElement,
    private readonly motion: Motion,
    private readonly state: State,
  ) {
    const canvas = host.querySelector<HTMLCanvasElement>("canvas.picture")!;
    this.renderer = new WebGLRenderer({
      canvas,
      alpha: true,
      antialias: false,
      powerPreference: "high-performance",
    });
    const bounds = sceneBox(motion);
    this.bounds = bounds;
    const size = bounds.getSize(new Vector3()).length();
    this.size = size;
    const { mold, cell, look } = motion.data;
    const { spacing } = motion;
    const { count } = motion.deciding.grippers;

    for (const { model, sheet, catenaries } of motion.drapes) {
      if (sheet !== null) this.pictures.set(model, new SheetPicture(sheet, size, spacing, count));
      else if (catenaries !== null) this.pictures.set(model, new CatenaryPicture(catenaries, size, spacing));
    }
    this.grippers = new Grippers(count, Math.min(0.1 * spacing, 0.03 * size), -0.004 * size);
    this.forces = new Forces(count, Math.min(0.8 * spacing, 0.12 * size), 0.5 * size);
    this.mold = mold === null ? null : new Mold(mold, MOLD * size);
    this.cell = cell === null ? null : new Cell(cell, count, 0.001 * size);
    this.paths = new Paths(motion, -0.001 * size);
    this.line = new SectionLine(-0.006 * size);
    this.look = look === undefined ? null : new LookPicture(look, spacing, -0.002 * size);
    this.box = new AxesBox(bounds, BOX * size);
    this.grippers.mesh.renderOrder = 5;
    this.forces.order = 6;
    this.scene.add(
      this.box.group,
      ...[...this.pictures.values()].map(({ group }) => group),
      this.grippers.mesh,
      this.forces.group,
      this.paths.lines.mesh,
      this.line.group,
    );
    if (this.mold !== null) this.scene.add(this.mold.group);
    if (this.cell !== null) this.scene.add(this.cell.group);
    if (this.look !== null) this.scene.add(this.look.group);

    this.eye = new Eye(canvas, bounds, () => this.draw());
    this.overlay = new Overlay(this.box, this.eye);
    this.overlay.mesh.renderOrder = 8;
    this.scene.add(this.overlay.mesh);
    new ResizeObserver(() => this.resize()).observe(host);
    canvas.addEventListener("webglcontextrestored", () => this.draw());
    this.resize();
    this.eye.look("iso", false);
    state.listen((now, before) => this.follow(now, before));
  }

  /** The color mode in force, with the range in force; undefined where nothing is colored. */
  private field(now: Choice): Field | undefined {
    return fieldInForce(this.motion, now) ?? this.motion.drape(now.model).data.fields[0];
  }

  private follow(now: Choice, before: Choice): void {
    const first = now === before;
    const changed = (...keys: (keyof Choice)[]) => first || keys.some((key) => now[key] !== before[key]);
    const drape = this.motion.drape(now.model);
    const shown = this.pictures.get(drape.model);
    if (changed("dark")) this.ink();
    if (changed("index", "model", "answer")) this.moveTo(now.index, drape);
    const field = this.field(now);
    const picture = drape.picture(now.index);
    if (field !== undefined && changed("color", "model")) shown?.useMap(field);
    if (
      field !== undefined &&
      picture !== null &&
      changed("index", "model", "answer", "stepRange", "orders", "color", "other", "otherIndex")
    ) {
      shown?.color(field, picture);
    }
    this.paths.lines.mesh.visible = now.paths;
    if (now.paths && changed("paths", "index", "model")) this.paths.moveTo(now.index, drape);
    if (changed("section", "index", "model")) {
      this.line.show(now.section === null ? [] : pieces(drape, now.index, now.section, null));
    }
    const done = now.index < drape.grippers.steps;
    this.grippers.mesh.visible = done;
    this.forces.group.visible = done && now.forces;
    if (done && now.forces && changed("forces", "index", "model", "answer"))
      this.forces.moveTo(drape.grippers, now.index);
    shown?.showDiagonals(now.diagonals);
    if (this.mold !== null) this.mold.group.visible = now.mold;
    if (this.cell !== null) this.cell.group.visible = now.cell;
    if (now.pointer !== null && now.pointer !== before.pointer) this.eye.lookAt(now.pointer.place);
    this.draw();
  }

  /** Moves what is shown to a step of a drape; a step that was not done has neither ply nor grippers. */
  private moveTo(index: number, drape: Drape): void {
    const at = drape.picture(index);
    for (const [model, picture] of this.pictures)
      picture.group.visible = model === drape.model && at !== null;
    if (at !== null) this.pictures.get(drape.model)?.moveTo(at);
    const { grippers, origins } = drape;
    if (index >= grippers.steps) return;
    this.grippers.moveTo(grippers.positions.at(index), grippers.normals.at(index));
    if (origins !== null) this.cell?.moveTo(origins.at(index));
  }

  /** Shows the mold that the motion has now, and a box around everything, which the eye looks at anew if it shall `fit`. */
  renew(fit: boolean): void {
    const { mold } = this.motion.data;
    if (this.mold !== null) this.scene.remove(this.mold.group);
    this.mold?.free();
    this.mold = mold === null ? null : new Mold(mold, MOLD * this.size);
    if (this.mold !== null) this.scene.add(this.mold.group);
    const bounds = sceneBox(this.motion);
    // a box that only grows stays where it is while the ply moves in it
    if (!fit) bounds.union(this.bounds);
    this.bounds = bounds;
    this.scene.remove(this.box.group);
    this.box.free();
    this.box = new AxesBox(bounds, BOX * this.size);
    this.scene.add(this.box.group);
    this.overlay.box = this.box;
    this.eye.show(bounds, fit);
    this.ink();
    this.draw();
  }

  /** Takes the colors of the theme in force. */
  ink(): void {
    for (const picture of this.pictures.values()) picture.ink(themeColor("red"));
    this.forces.ink(USES.map(({ color }) => themeColor(color)));
    this.grippers.ink(themeColor("disc"), themeColor("disc-rim"));
    this.paths.ink(themeColor("path"), themeColor("path-later"));
    this.line.ink(themeColor("section"));
    this.look?.ink(themeColor("path"), themeColor("accent"), themeColor("path"), themeColor("path-later"));
    this.mold?.ink(themeColor("mold"), themeColor("mold-line"));
    this.cell?.ink(themeColor("cell"), themeColor("cell-line"));
    this.box.ink(themeColor("box-line"));
    this.overlay.ink();
    this.renderer.setClearColor(new Color(themeColor("surface")));
  }

  private resize(): void {
    // one that is not shown keeps its size
    if (this.host.clientWidth === 0) return;
    this.width = Math.max(1, this.host.clientWidth);
    this.height = Math.max(1, this.host.clientHeight);
    this.setPixels(this.ratio);
    this.eye.resize(this.width, this.height);
    // a canvas of another size is empty
    if (this.lastDrawn > 0) this.drawNow();
  }

  private setPixels(ratio: number): void {
    this.renderer.setPixelRatio(ratio);
    this.renderer.setSize(this.width, this.height, false);
  }

  /** Draws the scene as it is; lines are as wide as the pixels of this picture ask for. */
  private render(): void {
    const ratio = this.renderer.getPixelRatio();
    pixelRatio.value = ratio;
    resolution.set(Math.floor(this.width * ratio), Math.floor(this.height * ratio));
    this.box.turn(this.eye);
    this.overlay.suit(this.width, this.height, ratio, this.state.now.pointer);
    this.renderer.render(this.scene, this.eye.camera);
  }

  /** A vertex of the ply between the catenaries as it is drawn now (m); null where it is not. */
  vertex(at: number): Place | null {
    return this.shownPicture?.vertex(at) ?? null;
  }

  /** The ply of the model in view. */
  private get shownPicture(): PlyPicture | undefined {
    return this.pictures.get(this.motion.drape(this.state.now.model).model);
  }

  /** Draws before the next repaint. */
  draw(): void {
    this.waiting ??= requestAnimationFrame(() => this.flush());
  }

  /** Draws at once what waits to be drawn, for one who is called as a frame begins. */
  flush(): void {
    if (this.waiting === null) return;
    cancelAnimationFrame(this.waiting);
    this.waiting = null;
    this.adapt(performance.now());
    this.drawNow();
  }

  private drawNow(): void {
    const { zoom } = this.eye.camera;
    this.shownPicture?.suit(zoom);
    this.grippers.showWalls(zoom);
    this.render();
  }

  /** Fewer triangles and pixels while a moving picture is too slow for this machine. */
  private adapt(now: number): void {
    const passed = now - this.lastDrawn;
    this.lastDrawn = now;
    this.slowFrames = passed > SLOW && passed < REST ? this.slowFrames + 1 : 0;
    if (this.slowFrames >= 3 && !this.coarse) this.setCoarse(true);
    clearTimeout(this.resting);
    if (this.coarse) this.resting = setTimeout(() => this.setCoarse(false), REST);
  }

  private setCoarse(coarse: boolean): void {
    this.coarse = coarse;
    this.slowFrames = 0;
    for (const picture of this.pictures.values()) picture.thin(coarse ? this.eye.camera.zoom : null);
    this.setPixels(this.ratio);
    if (!coarse) this.draw();
  }

  private get ratio(): number {
    return Math.min(devicePixelRatio, this.coarse ? 1 : MOST_PIXELS);
  }

  /** The picture of now with its labels, this many pixels for one of CSS. */
  still(ratio: number): HTMLCanvasElement {
    const before = this.renderer.getPixelRatio();
    this.setPixels(ratio);
    this.render();
    const sheet = document.createElement("canvas");
    sheet.width = Math.round(this.width * ratio);
    sheet.height = Math.round(this.height * ratio);
    sheet.getContext("2d")?.drawImage(this.renderer.domElement, 0, 0, sheet.width, sheet.height);
    this.setPixels(before);
    this.drawNow();
    return sheet;
  }

  /** Width and height (CSS pixels). */
  get extent(): [number, number] {
    return [this.width, this.height];
  }

  /** Gives its memory of the graphics card back. */
  free(): void {
    this.overlay.free();
    this.renderer.dispose();
    this.renderer.forceContextLoss();
  }

  /** The picture as PNG for the print. */
  snapshot(): string {
    return this.still(2).toDataURL("image/png");
  }

  /** Nodes of the sheet or vertices of the surface, and the grippers, as they are shown now; three micrometers each. */
  shown(): { points: Int32Array; pads: Int32Array } {
    const { index, model } = this.state.now;
    const drape = this.motion.drape(model);
    return { points: drape.points(index), pads: drape.pads(index) };
  }

  /** Looks at the ply as it is shown, from the corner that is nearest to a place. */
  frame(place: Place): void {
    const { points, pads } = this.shown();
    const box = new Box3();
    for (const from of [points, pads]) {
      for (let k = 0; k < from.length; k += 3)
        box.expandByPoint(new Vector3(from[k], from[k + 1], from[k + 2]).multiplyScalar(MICRO));
    }
    if (!box.isEmpty()) this.eye.frame(box.expandByScalar(0.04 * box.getSize(new Vector3()).length()), place);
  }

  /** The node or gripper nearest to a place on the picture (CSS pixels) of those that no other one hides by far. */
  under(at: [number, number]): Found | null {
    return this.nearest(at, this.shown().points, REACH);
  }

  /** The gripper that is nearest to a place on the picture, at most so far away (CSS pixels). */
  gripperUnder(at: [number, number], reach = REACH): Found | null {
    return this.nearest(at, new Int32Array(0), reach);
  }

  private nearest([x, y]: [number, number], points: Int32Array, near: number): Found | null {
    const { pads } = this.shown();
    const towards = this.eye.direction();
    // in the middle of a cell that is drawn large something is found too
    const reach = Math.max(REACH, 0.8 * this.eye.camera.zoom * (this.shownPicture?.fineness ?? 0));
    const screen = this.eye.screen();
    let found: (Found & { rank: number }) | null = null;
    const look = (kind: Found["kind"], from: Int32Array, near: number, favor: number) => {
      for (let k = 0; 3 * k < from.length; k++) {
        const place: Place = [from[3 * k]! * MICRO, from[3 * k + 1]! * MICRO, from[3 * k + 2]! * MICRO];
        const away = Math.hypot(screen(place, 0) - x, screen(place, 1) - y);
        if (away > near) continue;
        // one that is farther from the eye by a tenth of the scene is behind the ply
        const depth = place[0] * towards.x + place[1] * towards.y + place[2] * towards.z;
        const rank = away - favor - (REACH * depth) / (0.1 * this.size);
        if (found === null || rank < found.rank) found = { kind, number: k, place, rank };
      }
    };
    look("node", points, reach, 0);
    look("gripper", pads, near, REACH / 3);
    return found;
  }
}

/** The box around the ply over all steps, and as much of the mold as lies near it. */
function sceneBox(motion: Motion): Box3 {
  const { low, high } = motion.bounds();
  const ply = new Box3(new Vector3(...low), new Vector3(...high));
  for (const place of motion.data.look?.targets ?? []) ply.expandByPoint(new Vector3(...place));
  const size = ply.getSize(new Vector3());
  const room = 0.35 * Math.max(size.x, size.y);
  const box = ply.clone();
  const near = ply.clone().expandByScalar(room);
  const vertices = motion.data.mold?.vertices ?? [];
  const point = new Vector3();
  for (let k = 0; k + 2 < vertices.length; k += 3) {
    point.set(vertices[k]!, vertices[k + 1]!, vertices[k + 2]);
    box.expandByPoint(near.clampPoint(point, point));
  }
  // A flat or narrow scene still has a box that can be seen.
  const least = 0.08 * Math.max(size.x, size.y, 1e-3);
  const lacking = box.getSize(size).multiplyScalar(-1).addScalar(least).max(new Vector3());
  return box.expandByVector(lacking.multiplyScalar(0.5));
}
