/**
 * One small chart for each measure over the steps: its line, its limit dashed, and the step in view. Measures, words and units are
 * those of the data, in their order. They are of the model in view, which is the one that decides unless the reader asks for the other.
 *
 * A click or drag goes to a step. The marker of the step is an element over the drawing, so that moving it
 * draws nothing anew.
 */

import uPlot from "uplot";
import { full, quantity, short, ticks, withUnit } from "../data/number";
import {
  drapeOf,
  isBeside,
  modelText,
  type Measure,
  type Model,
  type PageData,
  type PeerCourse,
} from "../data/page_data";
import { byId, make, themeColor } from "./dom";
import type { State } from "./state";

/** A second result in the charts: its measures, and where along the steps of this one its steps are. */
export interface Beside {
  data: PageData;
  at: (index: number) => number;
}

/** A second line in a chart, dashed: its values, where along the steps they are, and what it is called. */
interface Other {
  name: string;
  x: number[];
  values: (number | null)[];
}

const HEIGHT = 104;
/** Least time between two moves of the markers (ms). */
const PAUSE = 90;

/** The charts of one model. */
interface Group {
  host: HTMLElement;
  charts: Chart[];
}

export class Charts {
  private readonly groups = new Map<Model, Group>();
  /** Charts of another program, in view whichever model is. */
  private readonly peers: Chart[] = [];
  private width: number | null = null;
  private last = -Infinity;
  private later = 0;
  private shown: Model;

  constructor(
    private readonly state: State,
    data: PageData,
  ) {
    const room = byId("charts");
    for (const { model, measures } of data.also === null ? [data.drape] : [data.drape, data.also]) {
      const host = make("div", { class: "charts", "data-model": model });
      room.append(host);
      const known = measures.filter((m) => m.values.some((value) => value !== null));
      const charts = known.map((measure) => new Chart(host, measure, data.steps, state));
      if (charts.length === 0) host.append(make("p", { class: "quiet" }, "There is nothing to chart."));
      this.groups.set(model, { host, charts });
    }
    this.shown = data.drape.model;
    new ResizeObserver(() => this.resize()).observe(room);
    state.listen((now, before) => {
      if (now === before || now.model !== before.model) this.show(data, now.model);
      if (now.dark !== before.dark) this.redraw();
      if (now.index !== before.index || now.model !== before.model || now === before) this.follow(now.index);
    });
  }

  /** Shows the charts of a model. */
  private show(data: PageData, model: Model): void {
    this.shown = drapeOf(data, model).model;
    for (const [key, { host }] of this.groups) host.hidden = key !== this.shown;
    const beside = byId("charts-model");
    beside.hidden = !isBeside(data, model);
    beside.textContent = modelText(data, model);
    this.resize();
  }

  private get charts(): Chart[] {
    return [...(this.groups.get(this.shown)?.charts ?? []), ...this.peers];
  }

  /** Moves the markers, at most so often that drawing them does not slow the picture down. */
  private follow(index: number): void {
    clearTimeout(this.later);
    const wait = this.last + PAUSE - performance.now();
    if (wait > 0) {
      this.later = setTimeout(() => this.follow(index), wait);
      return;
    }
    this.last = performance.now();
    for (const chart of this.charts) chart.mark(index);
  }

  /** A chart of two values over the steps in another place of the page. */
  add(host: HTMLElement, steps: number[], { key, label, unit, first, name, second }: PeerCourse): void {
    const none = steps.map(() => null);
    const measure = { key, label, unit, values: first, where: none, places: none, limit: null, least: false };
    const other = { name, x: steps, values: second };
    const chart = new Chart(host, measure, steps, this.state, other);
    chart.mark(this.state.now.index);
    this.peers.push(chart);
  }

  /** Draws the lines of a second result too, or none. */
  compare(beside: Beside | null): void {
    for (const [model, { charts }] of this.groups) {
      const measures = beside === null ? [] : drapeOf(beside.data, model).measures;
      for (const chart of charts) chart.compare(measures, beside);
    }
  }

  redraw(): void {
    for (const chart of this.charts) chart.plot.redraw(false);
  }

  /** Gives all charts this width (CSS pixels), or fits them to the room they have. */
  resize(width: number | null = this.width): void {
    this.width = width;
    for (const chart of this.charts) chart.fit(width);
  }
}

class Chart {
  readonly plot: uPlot;
  private readonly card = make("figure", { class: "chart" });
  private readonly room = make("div", { class: "plot" });
  private readonly value = make("output", { class: "chart-value" });
  private readonly where = make("span", { class: "chart-where" });
  private readonly line = make("div", { class: "chart-marker" });
  private readonly dot = make("div", { class: "chart-dot" });
  private index = 0;
  /** Lines that are there from the start, of another program, go on over steps whose states were not kept. */
  private readonly gaps: boolean;

  constructor(
    host: HTMLElement,
    private readonly measure: Measure,
    private readonly steps: number[],
    private readonly state: State,
    private other: Other | null = null,
  ) {
    this.gaps = other !== null;
    const { label, unit, limit, least } = measure;
    const allowed = limit === null ? "" : `limit ${least ? "≥" : "≤"}\u202f${quantity(limit, unit)}`;
    const bound = make("span", { class: "chart-limit" }, allowed);
    if (limit !== null) bound.title = `${least ? "at least" : "at most"} ${withUnit(full(limit), unit)}`;
    const head = make(
      "figcaption",
      {},
      make("p", {}, make("span", { class: "chart-name", title: label }, label), this.value),
      make("p", {}, bound, this.where),
    );
    this.card.dataset.measure = measure.key;
    this.card.classList.toggle("compared", other !== null);
    this.card.append(head, this.room);
    host.append(this.card);
    this.plot = new uPlot(this.options(), [steps, measure.values], this.room);
    this.plot.over.append(this.line, this.dot);
    this.plot.over.setAttribute("role", "img");
    this.plot.over.setAttribute(
      "aria-label",
      `${label} over the steps${allowed === "" ? "" : `, ${allowed}`}`,
    );
    this.listen();
  }

  private options(): uPlot.Options {
    const axis: uPlot.Axis = {
      stroke: () => themeColor("text-quiet"),
      grid: { stroke: () => themeColor("chart-grid"), width: 1 },
      ticks: { show: false },
      font: "11px system-ui, 'Liberation Sans', Arial, sans-serif",
      gap: 4,
    };
    const first = this.steps[0]!;
    const last = this.steps[this.steps.length - 1]!;
    const single = first === last;
    return {
      width: 200,
      height: HEIGHT,
      padding: [6, 10, 0, 0],
      legend: { show: false },
      cursor: { x: true, y: false, drag: { x: false, y: false }, points: { show: false } },
      scales: {
        x: { time: false, range: () => (single ? [first - 1, last + 1] : [first, last]) },
        y: { range: () => this.range() },
      },
      axes: [
        {
          ...axis,
          size: 20,
          space: 34,
          splits: (u) => stepTicks(first, last, u.width),
          values: (_, v) => v.map(String),
        },
        { ...axis, size: 46, splits: () => ticks(...this.range(), 2.6), values: (_, v) => v.map(short) },
      ],
      series: [
        {},
        {
          stroke: () => themeColor("chart-line"),
          width: 1.6,
          spanGaps: this.gaps,
          points: { show: this.steps.length === 1, size: 5 },
        },
      ],
      hooks: { drawAxes: [(u) => this.drawLimit(u)], drawSeries: [(u) => this.drawOther(u)] },
    };
  }

  /** From zero where that is near, and wide enough to show the limit. */
  private range(): [low: number, high: number] {
    const all = [...this.measure.values, ...(this.other?.values ?? [])];
    const values = all.filter((v): v is number => v !== null);
    if (this.measure.limit !== null) values.push(this.measure.limit);
    let low = Math.min(...values);
    const high = Math.max(...values);
    if (low > 0 && low < 0.6 * high) low = 0;
    const span = high - low;
    if (span <= 1e-12 * Math.max(Math.abs(high), 1e-300)) {
      return high === 0 ? [0, 1] : [Math.min(0, 2 * high), Math.max(0, 2 * high)];
    }
    return [low === 0 ? 0 : low - 0.06 * span, high + 0.08 * span];
  }

  /** Takes the same measure of a second result, if it has it in the same unit. */
  compare(measures: Measure[], beside: Beside | null): void {
    const { key, unit } = this.measure;
    const same = measures.find((measure) => measure.key === key && measure.unit === unit);
    this.other =
      beside === null || same === undefined
        ? null
        : { name: "B", x: same.values.map((_, k) => beside.at(k)), values: same.values };
    this.card.classList.toggle("compared", this.other !== null);
    this.plot.setData(this.plot.data);
    this.mark(this.index);
  }

  /** The line of the second result, dashed. */
  private drawOther(u: uPlot): void {
    if (this.other === null) return;
    const { ctx, bbox } = u;
    ctx.save();
    ctx.beginPath();
    ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
    ctx.clip();
    ctx.strokeStyle = themeColor("other");
    ctx.lineWidth = 1.6 * devicePixelRatio;
    ctx.setLineDash([5 * devicePixelRatio, 3 * devicePixelRatio]);
    ctx.beginPath();
    let drawing = false;
    this.other.values.forEach((value, k) => {
      if (value !== null) {
        const [x, y] = [u.valToPos(this.other!.x[k]!, "x", true), u.valToPos(value, "y", true)];
        if (drawing) ctx.lineTo(x, y);
        else ctx.moveTo(x, y);
      }
      drawing = value !== null || (drawing && this.gaps);
    });
    ctx.stroke();
    ctx.restore();
  }

  private drawLimit(u: uPlot): void {
    const { limit } = this.measure;
    if (limit === null) return;
    const { ctx, bbox } = u;
    const y = Math.round(u.valToPos(limit, "y", true)) + 0.5;
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

  private listen(): void {
    const { over } = this.plot;
    const under = (event: PointerEvent) =>
      this.plot.posToIdx(event.clientX - over.getBoundingClientRect().left);
    let held = false;
    over.addEventListener("pointerdown", (event) => {
      if (event.button !== 0) return;
      held = true;
      over.setPointerCapture(event.pointerId);
      this.state.goto(under(event));
    });
    over.addEventListener("pointermove", (event) => {
      if (held) this.state.goto(under(event));
      else this.show(under(event), true);
    });
    over.addEventListener("pointerup", () => (held = false));
    over.addEventListener("pointerleave", () => this.show(this.index, false));
  }

  /** Moves the marker to a step. */
  mark(index: number): void {
    this.index = index;
    const value = this.measure.values[index] ?? null;
    this.line.style.transform = `translateX(${this.plot.valToPos(this.steps[index]!, "x")}px)`;
    this.dot.hidden = value === null;
    if (value !== null) {
      const [x, y] = [this.plot.valToPos(this.steps[index]!, "x"), this.plot.valToPos(value, "y")];
      this.dot.style.transform = `translate(${x}px, ${y}px)`;
    }
    this.show(index, false);
  }

  /** Says the value of a step in the chart's head. */
  private show(index: number, hovered: boolean): void {
    const { values, where, unit } = this.measure;
    const value = values[index] ?? null;
    this.value.textContent = value === null ? "–" : quantity(value, unit);
    this.value.title = value === null ? "no value in this step" : withUnit(full(value), unit);
    const place = this.besides(index) ?? where[index] ?? "";
    this.where.textContent = hovered
      ? `step ${this.steps[index]!}${place === "" ? "" : `: ${place}`}`
      : place || "\u00a0";
    this.card.classList.toggle("hovered", hovered);
  }

  /** The value of a second result at a step. */
  private besides(index: number): string | null {
    if (this.other === null) return null;
    const { name, x, values } = this.other;
    const away = x.map((at) => Math.abs(at - this.steps[index]!));
    const value = values[away.indexOf(Math.min(...away))] ?? null;
    return value === null ? `${name} –` : `${name} ${quantity(value, this.measure.unit)}`;
  }

  fit(given: number | null): void {
    const width = given ?? this.room.clientWidth;
    if (width <= 0) return;
    if (width !== this.plot.width) this.plot.setSize({ width, height: HEIGHT });
    this.mark(this.index);
  }
}

/** Whole steps along the axis: the first, round ones, the last. */
function stepTicks(first: number, last: number, width: number): number[] {
  const round = ticks(first, last, Math.max(2, width / 60)).filter((t) => Number.isInteger(t));
  const apart = (last - first) / Math.max(3, width / 34);
  return [first, ...round.filter((t) => t - first > apart && last - t > apart), last].filter(
    (t, k, all) => k === 0 || t !== all[k - 1],
  );
}
