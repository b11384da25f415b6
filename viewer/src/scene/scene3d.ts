/**
 * The 3D picture: what is drawn, in which order, and when. It draws on demand only: after a change of the
 * step, the eye, the size or the theme.
 */

import { Box3, Color, Scene, Vector3, WebGLRenderer } from "three";
import { MICRO, type Motion } from "../data/motion";
import { pieces } from "../data/fabric_line";
import { fieldsOf, type Field, type Place } from "../data/page_data";
import { fieldInForce } from "../data/ranges";
import { themeColour } from "../page/dom";
import type { Choice, State } from "../page/state";
import { AxesBox } from "./axes_box";
import { Eye } from "./camera";
import { Catenaries } from "./catenaries";
import { Cell } from "./cell";
import { Contacts } from "./contacts";
import { USES } from "./forces";
import { Grippers } from "./grippers";
import { pixelRatio, resolution } from "./lines";
import { Mold } from "./mold";
import { Overlay } from "./overlay";
import { Paths } from "./paths";
import { SectionLine } from "./section_line";
import { SheetPicture } from "./sheet_picture";
import { PlySurface } from "./surface";

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
/** A ply with fewer vertices is drawn with all of them: leaving some out would save nothing. */
const MANY = 20_000;

/** How far mold and axes box are pushed back, as shares of the size of the scene. */
const MOLD = 0.02;
const BOX = 0.03;

export class Scene3d {
  private readonly surface: PlySurface;
  readonly eye: Eye;
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly catenaries: Catenaries;
  private readonly grippers: Grippers;
  private readonly contacts: Contacts;
  private mold: Mold | null;
  private readonly cell: Cell | null;
  readonly sheet: SheetPicture | null;
  private readonly paths: Paths;
  private readonly line: SectionLine;
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
    const { mold } = motion.data.geometry;

    this.surface = new PlySurface(motion, 0.003 * size);
    this.catenaries = new Catenaries(motion, 0.0005 * size, 0.02 * size);
    this.grippers = new Grippers(motion, Math.min(0.1 * motion.spacing, 0.03 * size), -0.004 * size);
    this.contacts = new Contacts(motion, -0.003 * size);
    this.mold = mold === null ? null : new Mold(mold, MOLD * size);
    const { sheet, cell } = motion;
    this.cell = cell === null ? null : new Cell(cell, motion.grippers.count, 0.001 * size);
    this.sheet = sheet === null ? null : new SheetPicture(sheet, size, motion.spacing);
    this.paths = new Paths(motion, -0.001 * size);
    this.line = new SectionLine(-0.006 * size);
    this.box = new AxesBox(bounds, BOX * size);
    this.catenaries.order = 3;
    this.contacts.points.renderOrder = 4;
    this.grippers.mesh.renderOrder = 5;
    this.scene.add(
      this.box.group,
      this.surface.mesh,
      this.catenaries.group,
      this.contacts.points,
      this.grippers.mesh,
      this.paths.lines.mesh,
      this.line.group,
    );
    if (this.mold !== null) this.scene.add(this.mold.group);
    if (this.cell !== null) this.scene.add(this.cell.group);
    if (this.sheet !== null) this.scene.add(this.sheet.group);

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

  /** The color mode in force, with the range in force. */
  private field(now: Choice): Field {
    return fieldInForce(this.motion, now) ?? fieldsOf(this.motion.data, now.model)[0]!;
  }

  private follow(now: Choice, before: Choice): void {
    const first = now === before;
    const changed = (...keys: (keyof Choice)[]) => first || keys.some((key) => now[key] !== before[key]);
    const sheet = now.model === "sheet" ? this.sheet : null;
    if (changed("dark")) this.ink();
    if (changed("model")) this.showModel(sheet !== null);
    if (changed("colour", "model")) (sheet ?? this.surface).useMap(this.field(now));
    if (changed("index", "model", "answer")) this.moveTo(now.index, sheet);
    if (changed("index", "model", "answer", "stepRange", "orders", "colour", "other", "otherIndex")) {
      (sheet ?? this.surface).colour(this.field(now), now.index);
    }
    this.paths.lines.mesh.visible = now.paths;
    if (now.paths && changed("paths", "index", "model")) this.paths.moveTo(now.index, now.model);
    if (changed("section", "index", "model")) {
      this.line.show(
        now.section === null ? [] : pieces(this.motion, now.model, now.index, now.section, null),
      );
    }
    sheet?.showForces(now.forces);
    this.catenaries.showDiagonals(now.diagonals);
    if (this.mold !== null) this.mold.group.visible = now.mold;
    if (this.cell !== null) this.cell.group.visible = now.cell;
    if (now.pointer !== null && now.pointer !== before.pointer) this.eye.lookAt(now.pointer.place);
    this.draw();
  }

  /** Shows the sheet, or the catenaries. */
  private showModel(sheet: boolean): void {
    if (this.sheet !== null) this.sheet.group.visible = sheet;
    for (const part of [this.surface.mesh, this.catenaries.group, this.contacts.points])
      part.visible = !sheet;
  }

  /** Moves what is shown to a step. */
  private moveTo(index: number, sheet: SheetPicture | null): void {
    if (sheet === null) {
      this.surface.moveTo(index);
      this.catenaries.moveTo(index);
      this.contacts.moveTo(index);
    } else sheet.moveTo(index);
    this.cell?.moveTo(index);
    this.grippers.moveTo(
      ...(sheet?.pads() ?? [this.motion.grippers.at(index), this.motion.normals.at(index)]),
    );
  }

  /** Shows the mold that the motion has now, and a box around everything, which the eye looks at anew if it shall `fit`. */
  renew(fit: boolean): void {
    const { mold } = this.motion.data.geometry;
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
    this.catenaries.ink(themeColour("red"));
    this.contacts.ink(themeColour("red"));
    this.sheet?.ink(USES.map(({ colour }) => themeColour(colour)));
    this.grippers.ink(themeColour("disc"), themeColour("disc-rim"));
    this.paths.ink(themeColour("path"), themeColour("path-later"));
    this.line.ink(themeColour("section"));
    this.mold?.ink(themeColour("mold"), themeColour("mold-line"));
    this.cell?.ink(themeColour("cell"), themeColour("cell-line"));
    this.box.ink(themeColour("box-line"));
    this.overlay.ink();
    this.renderer.setClearColor(new Color(themeColour("surface")));
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
    if (this.state.now.model === "sheet") return null;
    return this.surface.vertex(at) ?? this.catenaries.vertex(at);
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
    const apart = zoom * this.motion.spacing;
    this.surface.showThreads(apart / this.motion.data.divisions);
    this.sheet?.suit(zoom);
    this.catenaries.suit(apart);
    this.contacts.suit(apart);
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
    const stride = coarse ? this.stride() : 1;
    this.surface.thin(stride);
    this.catenaries.thin(stride);
    this.setPixels(this.ratio);
    if (!coarse) this.draw();
  }

  /** Every second vertex is left out; where cells are small on the screen, all but two or three pieces a side. */
  private stride(): number {
    const n = this.motion.data.divisions;
    if (n % 2 !== 0 || this.motion.surface.count < MANY) return 1;
    const small = this.eye.camera.zoom * this.motion.spacing < 60;
    return small ? (n % 3 === 0 ? n / 3 : n / 2) : 2;
  }

  private get ratio(): number {
    return Math.min(devicePixelRatio, this.coarse ? 1 : MOST_PIXELS);
  }

  /** The picture of now with its labels, so many pixels for one of CSS. */
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

  /** The same as PNG for the print. */
  snapshot(): string {
    return this.still(2).toDataURL("image/png");
  }

  /** Nodes of the sheet or vertices of the surface, and the grippers, as they are shown now; three micrometers each. */
  shown(): { points: Int32Array; pads: Int32Array } {
    const { index, model } = this.state.now;
    const { sheet } = this.motion;
    const at = model === "sheet" ? (sheet?.stateOf(index) ?? null) : null;
    return at === null
      ? { points: this.motion.surface.at(index), pads: this.motion.grippers.at(index) }
      : { points: sheet!.positions.at(at), pads: sheet!.grippers.at(at) };
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
    const reach = Math.max(REACH, 0.8 * this.eye.camera.zoom * this.fineness());
    const screen = this.eye.screen();
    let found: (Found & { rank: number }) | null = null;
    const look = (kind: Found["kind"], from: Int32Array, near: number, favour: number) => {
      for (let k = 0; 3 * k < from.length; k++) {
        const place: Place = [from[3 * k]! * MICRO, from[3 * k + 1]! * MICRO, from[3 * k + 2]! * MICRO];
        const away = Math.hypot(screen(place, 0) - x, screen(place, 1) - y);
        if (away > near) continue;
        // one that is farther from the eye by a tenth of the scene is behind the ply
        const depth = place[0] * towards.x + place[1] * towards.y + place[2] * towards.z;
        const rank = away - favour - (REACH * depth) / (0.1 * this.size);
        if (found === null || rank < found.rank) found = { kind, number: k, place, rank };
      }
    };
    look("node", points, reach, 0);
    look("gripper", pads, near, REACH / 3);
    return found;
  }

  /** Distance of neighboring nodes of what is shown (m), about. */
  private fineness(): number {
    const { sheet, data, spacing, grippers } = this.motion;
    if (this.state.now.model === "catenaries" || sheet === null) return spacing / data.divisions;
    return spacing / Math.max(1, Math.sqrt(sheet.data.cells.length / 4 / Math.max(1, grippers.count)));
  }
}

/** The box around the ply over all steps, and as much of the mold as lies near it. */
function sceneBox(motion: Motion): Box3 {
  const { low, high } = motion.bounds();
  const ply = new Box3(new Vector3(...low), new Vector3(...high));
  const size = ply.getSize(new Vector3());
  const room = 0.35 * Math.max(size.x, size.y);
  const box = ply.clone();
  const near = ply.clone().expandByScalar(room);
  const vertices = motion.data.geometry.mold?.vertices ?? [];
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
