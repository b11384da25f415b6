/**
 * The eye: parallel projection, z up, orbit, pan and zoom, standard views, and fitting a box into the picture.
 *
 * The frustum is measured in CSS pixels, so the camera's zoom is pixels per meter.
 */

import { Box3, OrthographicCamera, Vector3 } from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import type { Place } from "../data/page_data";

export type StandardView = "top" | "front" | "side" | "iso";

/** From where each standard view looks. Top is a hair off the z axis, so that x stays to the right. */
const DIRECTIONS: Record<StandardView, Place> = {
  top: [0, -1e-4, 1],
  front: [0, -1, 0],
  side: [1, 0, 0],
  iso: [0.38, -1, 0.72],
};

/** Room kept free around the fitted box (CSS pixels): the legend is on the right, labels below. */
const MARGIN = { left: 84, right: 156, top: 30, bottom: 48 };
/** In a narrow picture the legend is elsewhere. */
const NARROW = { below: 560, left: 70, right: 30, top: 16, bottom: 40 };

const stillness = matchMedia("(prefers-reduced-motion: reduce)");

export class Eye {
  readonly camera = new OrthographicCamera(-1, 1, 1, -1, 0, 1);
  private readonly controls: OrbitControls;
  private readonly reach: number;
  /** What is shown until the reader moves the eye: the whole from a side, or a part. */
  private view: StandardView | Box3 | null = "iso";
  private flight = 0;
  /** Called after every move of this eye. */
  moved: (() => void) | null = null;

  constructor(
    element: HTMLElement,
    private box: Box3,
    private readonly redraw: () => void,
  ) {
    this.reach = 4 * box.getSize(new Vector3()).length();
    this.camera.up.set(0, 0, 1);
    this.camera.near = 0;
    this.camera.far = 2 * this.reach;
    this.controls = new OrbitControls(this.camera, element);
    this.controls.enableDamping = false;
    this.controls.zoomToCursor = true;
    this.controls.zoomSpeed = 1.4;
    this.controls.addEventListener("start", () => {
      this.view = null;
      this.flight++;
    });
    this.controls.addEventListener("change", () => this.changed());
    // one finger across the picture turns it; up and down it scrolls the page, where that is all there is
    element.style.touchAction = "";
  }

  /** Takes another box as the whole, and shows it from the standard view that was chosen last if it shall `fit`. */
  show(box: Box3, fit: boolean): void {
    this.box = box;
    if (fit) this.look(this.view === null || this.view instanceof Box3 ? "iso" : this.view, false);
  }

  private changed(): void {
    this.redraw();
    this.moved?.();
  }

  resize(width: number, height: number): void {
    Object.assign(this.camera, { left: -width / 2, right: width / 2, top: height / 2, bottom: -height / 2 });
    this.camera.updateProjectionMatrix();
    if (this.view instanceof Box3) {
      const direction = this.direction();
      this.flyTo(direction, ...this.fitted(direction, this.view), false);
    } else if (this.view !== null) this.look(this.view, false);
    this.changed();
  }

  /** Shows the whole box from a standard direction. */
  look(view: StandardView, smooth = true): void {
    const direction = new Vector3(...DIRECTIONS[view]).normalize();
    this.flyTo(direction, ...this.fitted(direction), smooth);
    this.view = view;
  }

  /** Shows a part of the scene from that one of its four upper corners that is nearest to a place. */
  frame(part: Box3, place: Place): void {
    const away = new Vector3(...place).sub(part.getCenter(new Vector3()));
    const corners = [0, 1, 2, 3].map((k) =>
      new Vector3(...DIRECTIONS.iso).applyAxisAngle(this.camera.up, (k * Math.PI) / 2).normalize(),
    );
    // the usual corner, unless another one is clearly nearer
    const clearly = 0.08 * part.getSize(new Vector3()).length();
    const [usual, ...others] = corners as [Vector3, ...Vector3[]];
    const nearest = others.reduce(
      (best, corner) => (corner.dot(away) > best.dot(away) ? corner : best),
      usual,
    );
    const direction = nearest.dot(away) > usual.dot(away) + clearly ? nearest : usual;
    this.flyTo(direction, ...this.fitted(direction, part), false);
    this.view = part;
  }

  /** Looks as another eye does. */
  follow(other: Eye): void {
    const { moved } = this;
    this.moved = null;
    this.view = null;
    this.flight++;
    [this.controls.minZoom, this.controls.maxZoom] = [0, Infinity];
    this.place(other.direction(), other.controls.target, other.camera.zoom);
    this.moved = moved;
  }

  /** Shows the whole box from where the eye is. */
  fit(): void {
    const direction = this.direction();
    this.flyTo(direction, ...this.fitted(direction), true);
  }

  /** Brings a place to the middle, nearer if it was far. */
  lookAt(place: Place): void {
    const direction = this.direction();
    if (Math.abs(direction.z) < 0.3) direction.setZ(0.5).normalize();
    const [, whole] = this.fitted(direction);
    this.view = null;
    this.flyTo(direction, new Vector3(...place), Math.max(this.camera.zoom, 2 * whole), true);
  }

  zoomBy(factor: number): void {
    this.view = null;
    this.camera.zoom = Math.min(
      Math.max(this.camera.zoom * factor, this.controls.minZoom),
      this.controls.maxZoom,
    );
    this.camera.updateProjectionMatrix();
    this.controls.update();
    this.changed();
  }

  /** Turns around the z axis and over the horizon (rad). */
  turnBy(around: number, over: number): void {
    this.view = null;
    const offset = this.direction();
    const polar = Math.min(Math.max(Math.acos(offset.z) + over, 1e-4), Math.PI - 1e-4);
    const azimuth = Math.atan2(offset.y, offset.x) + around;
    offset.set(Math.sin(polar) * Math.cos(azimuth), Math.sin(polar) * Math.sin(azimuth), Math.cos(polar));
    this.place(offset, this.controls.target, this.camera.zoom);
  }

  /** Direction from the target to the eye. */
  direction(): Vector3 {
    return this.camera.position.clone().sub(this.controls.target).normalize();
  }

  /** Where on the picture a point is (CSS pixels from its top left). */
  project(point: Vector3): [number, number] {
    const screen = this.screen();
    const place = point.toArray();
    return [screen(place, 0), screen(place, 1)];
  }

  /** Projects many points to the screen: across (0) or down (1). */
  screen(): (place: Place, c: 0 | 1) => number {
    this.camera.updateMatrixWorld();
    const m = this.camera.projectionMatrix.clone().multiply(this.camera.matrixWorldInverse).elements;
    const half = [
      (this.camera.right - this.camera.left) / 2,
      (this.camera.bottom - this.camera.top) / 2,
    ] as const;
    return ([x, y, z], c) =>
      Math.abs(half[c]) + half[c] * (m[c] * x + m[4 + c]! * y + m[8 + c]! * z + m[12 + c]!);
  }

  /** Target and zoom that show a box, the whole one unless a part is given, inside the margins. */
  private fitted(direction: Vector3, box = this.box): [Vector3, number] {
    const right = new Vector3(0, 0, 1).cross(direction).normalize();
    const up = direction.clone().cross(right);
    const [x, y] = [new Box3(), new Box3()];
    for (let k = 0; k < 8; k++) {
      const { min, max } = box;
      const p = new Vector3(k & 1 ? max.x : min.x, k & 2 ? max.y : min.y, k & 4 ? max.z : min.z);
      x.expandByPoint(new Vector3(p.dot(right), 0, 0));
      y.expandByPoint(new Vector3(p.dot(up), 0, 0));
    }
    const whole = this.camera.right - this.camera.left;
    const margin = whole < NARROW.below ? NARROW : MARGIN;
    const width = whole - margin.left - margin.right;
    const height = this.camera.top - this.camera.bottom - margin.top - margin.bottom;
    const zoom = Math.max(
      Math.min(width / Math.max(x.max.x - x.min.x, 1e-9), height / Math.max(y.max.x - y.min.x, 1e-9)),
      1e-3,
    );
    if (box === this.box) [this.controls.minZoom, this.controls.maxZoom] = [0.2 * zoom, 60 * zoom];
    const shiftRight = (margin.right - margin.left) / 2 / zoom;
    const shiftUp = (margin.top - margin.bottom) / 2 / zoom;
    const target = right
      .clone()
      .multiplyScalar((x.min.x + x.max.x) / 2 + shiftRight)
      .addScaledVector(up, (y.min.x + y.max.x) / 2 + shiftUp)
      .addScaledVector(direction, box.getCenter(new Vector3()).dot(direction));
    return [target, zoom];
  }

  private place(direction: Vector3, target: Vector3, zoom: number): void {
    this.controls.target.copy(target);
    this.camera.position.copy(target).addScaledVector(direction, this.reach);
    this.camera.zoom = zoom;
    this.camera.updateProjectionMatrix();
    this.controls.update();
    this.changed();
  }

  /** Moves the eye in a third of a second, or at once where less motion is asked for. */
  private flyTo(direction: Vector3, target: Vector3, zoom: number, smooth: boolean): void {
    const flight = ++this.flight;
    if (!smooth || stillness.matches || this.camera.position.lengthSq() === 0) {
      this.place(direction, target, zoom);
      return;
    }
    const from = {
      direction: this.direction(),
      target: this.controls.target.clone(),
      zoom: this.camera.zoom,
    };
    const start = performance.now();
    const frame = (now: number) => {
      if (flight !== this.flight) return;
      const share = Math.min(Math.max((now - start) / 330, 0), 1);
      const eased = share * share * (3 - 2 * share);
      const between = from.direction.clone().lerp(direction, eased);
      if (between.lengthSq() < 1e-6) between.copy(direction);
      this.place(
        between.normalize(),
        from.target.clone().lerp(target, eased),
        from.zoom * (zoom / from.zoom) ** eased,
      );
      if (share < 1) requestAnimationFrame(frame);
    };
    requestAnimationFrame(frame);
  }
}
