/**
 * A section along any line of the fabric: the ply and the mold under it, and the height of the ply over the mold.
 *
 * The line is chosen by a slider, or by a click on the ply. Where two results are compared, the same line of both is shown.
 */

import { Vector3 } from "three";
import uPlot from "uplot";
import { fabricBounds, pieces, type FabricLine, type LinePoint } from "../data/fabric_line";
import { MoldBelow } from "../data/mold_below";
import type { Drape } from "../data/drape";
import type { Motion } from "../data/motion";
import { quantity, short, ticks } from "../data/number";
import type { Found, Scene3d } from "../scene/scene3d";
import { byId, make, themeColor } from "./dom";
import { fabricPlace } from "./hover";
import type { State } from "./state";

/** Heights of the charts (CSS pixels). */
const HEIGHT = 118;
/** Steps of the slider from one side of the ply to the other. */
const STEPS = 400;

/** What the section says, for scripts: its line, and the points of all its pieces. */
export interface SectionFacts {
  line: FabricLine;
  points: LinePoint[];
}

export class Section {
  private readonly host = byId("section");
  private readonly slider = byId<HTMLInputElement>("section-at");
  private readonly said = byId("section-said");
  private readonly under = byId("section-under");
  private readonly profile: Chart;
  private readonly height: Chart;
  private readonly molds = new WeakMap<Motion, MoldBelow | null>();
  private shown: LinePoint[][] = [];

  constructor(
    private readonly state: State,
    private readonly motion: Motion,
    private readonly scene: Scene3d | null,
  ) {
    const limit = motion.data.drape.fields.find(({ key }) => key === "over_mold")?.limit ?? null;
    this.profile = new Chart(byId("section-profile"), "Height z of ply and mold (mm)", null, this.point);
    this.height = new Chart(byId("section-height"), "Height over the mold (mm)", limit, this.point);
    const open = byId<HTMLButtonElement>("section-open");
    open.addEventListener("click", () => this.toggle());
    byId("section-close").addEventListener("click", () => this.toggle());
    for (const along of ["u", "v"] as const) {
      byId<HTMLInputElement>(`section-${along}`).addEventListener("change", () => {
        this.choose(along, this.middle(along));
      });
    }
    this.slider.addEventListener("input", () => {
      const { section } = state.now;
      const bounds = fabricBounds(this.drape);
      if (section === null || bounds === null) return;
      const [low, high] = bounds[section.along === "u" ? 1 : 0];
      this.choose(section.along, low + (Number(this.slider.value) / STEPS) * (high - low));
    });
    this.slider.max = String(STEPS);
    new ResizeObserver(() => this.fit()).observe(this.host);
    state.listen((now, before) => {
      const keys = ["section", "index", "model", "other", "otherIndex", "dark"] as const;
      if (now !== before && !keys.some((key) => now[key] !== before[key])) return;
      open.hidden = fabricBounds(this.drape) === null;
      open.setAttribute("aria-pressed", String(now.section !== null));
      this.host.hidden = now.section === null;
      if (now.section !== null) this.draw(now.section);
    });
  }

  /** The drape by the model in view. */
  private get drape(): Drape {
    return this.motion.drape(this.state.now.model);
  }

  /** Opens the section in the middle of the ply, or closes it. */
  toggle(): void {
    if (this.state.now.section !== null) this.state.set({ section: null });
    else if (fabricBounds(this.drape) !== null) this.choose("u", this.middle("u"));
  }

  /** A click on the ply brings the line there. */
  through(found: Found): void {
    const { now } = this.state;
    if (now.section === null) return;
    const place =
      found.kind === "node"
        ? fabricPlace(this.drape, found.number)
        : padAt(this.motion, this.drape, now.index, found);
    if (place !== null) this.choose(now.section.along, place[now.section.along === "u" ? 1 : 0]);
  }

  facts(): SectionFacts | null {
    const { section } = this.state.now;
    return section === null ? null : { line: section, points: this.shown.flat() };
  }

  private choose(along: "u" | "v", at: number): void {
    this.state.set({ section: { along, at: Math.round(at * 10) / 10 } });
  }

  /** Where a line goes first: through the place that is pointed at, or through the middle. */
  private middle(along: "u" | "v"): number {
    const { now } = this.state;
    const across = along === "u" ? 1 : 0;
    const at = now.pointer === null ? null : nodeAt(this.drape, now.index, now.pointer.place);
    if (at !== null) return at[across];
    const bounds = fabricBounds(this.drape)!;
    return (bounds[across][0] + bounds[across][1]) / 2;
  }

  private draw(line: FabricLine): void {
    const { model, index, other, otherIndex } = this.state.now;
    const across = line.along === "u" ? "v" : "u";
    const bounds = fabricBounds(this.drape);
    if (bounds !== null) {
      const [low, high] = bounds[line.along === "u" ? 1 : 0];
      this.slider.value = String(Math.round((STEPS * (line.at - low)) / Math.max(high - low, 1e-9)));
    }
    byId<HTMLInputElement>(`section-${line.along}`).checked = true;
    this.slider.setAttribute("aria-valuetext", `${across} = ${quantity(line.at, "mm")}`);
    this.shown = pieces(this.drape, index, line, this.moldOf(this.motion));
    const beside = other === null ? [] : pieces(other.drape(model), otherIndex, line, this.moldOf(other));
    const heights = this.shown.flat().filter(({ height }) => height !== null);
    const highest = heights.reduce<LinePoint | null>(
      (most, point) => (most === null || point.height! > most.height! ? point : most),
      null,
    );
    this.said.textContent =
      `${across} = ${quantity(line.at, "mm")}` +
      (this.shown.length === 0 ? ": no ply" : "") +
      (highest === null
        ? ""
        : `, highest ${quantity(highest.height!, "mm")} at ${line.along} = ${quantity(Math.round(highest.s * 10) / 10, "mm")}`);
    this.profile.show(line.along, [
      { name: "mold", points: this.shown, value: ({ mold }) => mold, fill: true },
      { name: "ply", points: this.shown, value: ({ place }) => place[2] * 1000 },
      ...(other === null
        ? []
        : [
            {
              name: "ply of B",
              points: beside,
              value: ({ place }: LinePoint) => place[2] * 1000,
              other: true,
            },
          ]),
    ]);
    this.height.show(line.along, [
      { name: "height", points: this.shown, value: ({ height }) => height },
      ...(other === null
        ? []
        : [{ name: "height of B", points: beside, value: ({ height }: LinePoint) => height, other: true }]),
    ]);
    byId("section-height").hidden = heights.length === 0;
    this.fit();
  }

  /** A place of the chart is asked about: it is shown on the ply, with its numbers. */
  private readonly point = (s: number | null): void => {
    const dot = byId("section-dot");
    const all = this.shown.flat();
    const nearest =
      s === null
        ? null
        : all.reduce<LinePoint | null>(
            (best, point) => (best === null || Math.abs(point.s - s) < Math.abs(best.s - s) ? point : best),
            null,
          );
    dot.hidden = nearest === null || this.scene === null;
    this.under.textContent = "";
    if (nearest === null) return;
    const { along } = this.state.now.section!;
    const parts = [
      `${along} ${short(Math.round(nearest.s * 10) / 10)}`,
      `z ${quantity(nearest.place[2] * 1000, "mm")}`,
    ];
    if (nearest.mold !== null) parts.push(`mold ${quantity(nearest.mold, "mm")}`);
    if (nearest.height !== null) parts.push(`height ${quantity(nearest.height, "mm")}`);
    this.under.textContent = parts.join(" · ");
    const at = this.scene?.eye.project(new Vector3(...nearest.place));
    if (at !== undefined) dot.style.translate = `${String(at[0])}px ${String(at[1])}px`;
  };

  private moldOf(motion: Motion): MoldBelow | null {
    let mold = this.molds.get(motion);
    if (mold === undefined) {
      const given = motion.data.mold;
      mold = given === null ? null : new MoldBelow(given);
      this.molds.set(motion, mold);
    }
    return mold;
  }

  private fit(): void {
    this.profile.fit();
    this.height.fit();
  }
}

/** Fabric coordinates of the node of the sheet that is nearest to a place (mm); null of catenaries. */
function nodeAt(drape: Drape, index: number, place: [number, number, number]): [number, number] | null {
  const { sheet } = drape;
  const state = drape.picture(index);
  if (sheet === null || state === null) return null;
  let [best, least] = [-1, Infinity];
  for (let node = 0; node < sheet.data.landing.length; node++) {
    const away = Math.hypot(...sheet.node(state, node).map((c, n) => c - place[n]!));
    if (away < least) [best, least] = [node, away];
  }
  return best < 0 ? null : fabricPlace(drape, best);
}

/** Fabric coordinates of a gripper (mm). */
function padAt(
  motion: Motion,
  drape: Drape,
  index: number,
  { number, place }: Found,
): [number, number] | null {
  if (drape.catenaries === null) return nodeAt(drape, index, place);
  const [column, row] = motion.data.ids[number]!;
  const { pitch } = drape.catenaries.data;
  return [column * pitch[0], row * pitch[1]];
}

interface Course {
  name: string;
  points: LinePoint[][];
  value: (point: LinePoint) => number | null;
  fill?: boolean;
  other?: boolean;
}

/** A chart along the line. */
class Chart {
  private plot: uPlot | null = null;
  private readonly room = make("div", { class: "plot" });
  private readonly title: HTMLElement;
  private names = "";
  private range: [number, number] = [0, 1];
  private ends: [number, number] = [0, 1];

  constructor(
    host: HTMLElement,
    private readonly name: string,
    private readonly limit: number | null,
    private readonly pointed: (s: number | null) => void,
  ) {
    this.title = make("figcaption", {}, name);
    host.append(this.title, this.room);
  }

  show(along: "u" | "v", courses: Course[]): void {
    const all = courses.flatMap(({ points, value }) =>
      points.flatMap((piece) => piece.map(value).filter((v): v is number => v !== null)),
    );
    const arcs = courses.flatMap(({ points }) => points.flatMap((piece) => piece.map(({ s }) => s)));
    this.ends = arcs.length === 0 ? [0, 1] : [Math.min(...arcs), Math.max(...arcs)];
    if (this.limit !== null) all.push(this.limit, 0);
    const [low, high] = all.length === 0 ? [0, 1] : [Math.min(...all), Math.max(...all)];
    const room = 0.06 * Math.max(high - low, 0.1);
    this.range = [low - room, high + room];
    // one table for each course, with a gap after each piece
    const tables = courses.map(({ points, value }): uPlot.AlignedData => {
      const x: number[] = [];
      const y: (number | null)[] = [];
      for (const piece of points) {
        for (const point of piece) {
          x.push(point.s);
          y.push(value(point));
        }
        x.push(piece[piece.length - 1]!.s + 1e-6);
        y.push(null);
      }
      return [x, y];
    });
    const data = uPlot.join(tables);
    const names = [along, ...courses.map(({ name }) => name)].join();
    if (this.plot !== null && names === this.names) {
      this.plot.setData(data);
      this.plot.redraw();
      return;
    }
    this.names = names;
    this.plot?.destroy();
    this.plot = new uPlot(this.options(courses), data, this.room);
    this.plot.over.addEventListener("pointerleave", () => this.pointed(null));
    this.title.replaceChildren(
      `${this.name} along ${along} (mm)`,
      ...courses
        .filter(() => courses.length > 1)
        .map(({ name, fill, other }) =>
          make("span", { class: `key ${fill ? "key-mold" : other ? "key-other" : "key-ply"}` }, name),
        ),
    );
  }

  private options(courses: Course[]): uPlot.Options {
    const axis: uPlot.Axis = {
      stroke: () => themeColor("text-quiet"),
      grid: { stroke: () => themeColor("chart-grid"), width: 1 },
      ticks: { show: false },
      font: "11px system-ui, 'Liberation Sans', Arial, sans-serif",
      gap: 4,
    };
    return {
      width: 300,
      height: HEIGHT,
      padding: [6, 14, 0, 0],
      legend: { show: false },
      cursor: { x: true, y: false, drag: { x: false, y: false }, points: { show: false } },
      scales: { x: { time: false, range: () => this.ends }, y: { range: () => this.range } },
      axes: [
        {
          ...axis,
          size: 20,
          splits: (u) => ticks(...this.ends, Math.max(2, u.width / 70)),
          values: (_, v) => v.map(short),
        },
        { ...axis, size: 46, splits: () => ticks(...this.range, 3.2), values: (_, v) => v.map(short) },
      ],
      series: [
        {},
        ...courses.map(({ fill, other }): uPlot.Series => ({
          stroke: () => themeColor(fill ? "mold-line" : other ? "other" : "section"),
          width: fill ? 1 : 1.8,
          ...(fill ? { fill: () => themeColor("mold"), fillTo: () => this.range[0] } : {}),
          ...(other ? { dash: [5, 4] } : {}),
          points: { show: false },
        })),
      ],
      hooks: {
        draw: [(u) => this.drawLimit(u)],
        setCursor: [
          (u) => {
            const { left } = u.cursor;
            if (left !== undefined && left >= 0) this.pointed(u.posToVal(left, "x"));
          },
        ],
      },
    };
  }

  private drawLimit(u: uPlot): void {
    if (this.limit === null) return;
    const { ctx, bbox } = u;
    const y = Math.round(u.valToPos(this.limit, "y", true)) + 0.5;
    ctx.save();
    ctx.strokeStyle = themeColor("red");
    ctx.lineWidth = 1.25 * devicePixelRatio;
    ctx.setLineDash([5 * devicePixelRatio, 4 * devicePixelRatio]);
    ctx.beginPath();
    ctx.moveTo(bbox.left, y);
    ctx.lineTo(bbox.left + bbox.width, y);
    ctx.stroke();
    ctx.restore();
  }

  fit(): void {
    const width = this.room.clientWidth;
    if (this.plot !== null && width > 0 && width !== this.plot.width)
      this.plot.setSize({ width, height: HEIGHT });
  }
}
