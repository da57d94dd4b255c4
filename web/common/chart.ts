// SPDX-License-Identifier: Apache-2.0
/** Line plots with uPlot: one look for all, linked cursors, themes, sizes. */
import uPlot from "uplot";
import { clock, h, number, tick } from "./dom";
import { onThemeChange, theme } from "./theme";

export type Dash = "solid" | "dashed" | "dotted"; // as borders in style sheets
const kDashes: Record<Dash, number[] | undefined> = { solid: undefined, dashed: [7, 5], dotted: [2, 4] };

export interface Line {
  name: string;
  x: ArrayLike<number>;
  y: ArrayLike<number | null>;
  low?: ArrayLike<number | null>;
  high?: ArrayLike<number | null>;
  colour: number | "ink"; // index into the theme's series colours
  dash?: Dash;
  points?: boolean;
}

export interface ChartOptions {
  title: string;
  note?: string; // one line under the title
  unit?: string;
  xLabel?: string; // without it, x is a time in seconds
  yLabel?: string;
  logX?: boolean;
  logY?: boolean;
  range?: [number | null, number | null]; // fixed ends of y
  lines: Line[];
  levels?: { y: number; label: string }[];
  band?: [number, number]; // a range of y that is good
  marks?: { x: number; label: string }[];
  sync?: string;
  onPick?: (x: number) => void;
  height?: number; // [px]
  live?: boolean; // its lines come and change later: it is made without any data too
}

export interface Chart {
  element: HTMLElement;
  /** Shows a time in the plot, as the map's slider moves. */
  showTime(x: number): void;
  /** Shows these lines from now on: as many as before, with the same names and bands. */
  update(lines: Line[]): void;
  /** Takes the plot off the page for good. */
  remove(): void;
}

const kTimeSteps = [1, 2, 5, 10, 15, 30, 60, 120, 300, 600, 900, 1800, 3600, 7200, 14400, 21600, 43200, 86400];
const kHeight = 220;

const finite = (value: number | null | undefined, log: boolean | undefined) => (value != null && Number.isFinite(value) && (!log || value > 0) ? value : null);

const paint = (line: Line) => (line.colour === "ink" ? theme().ink : theme().series[line.colour]);

/** Joins lines with x of their own into one table, and names the bands' columns. */
function table(options: ChartOptions): { data: uPlot.AlignedData; bands: uPlot.Band[] } {
  const tables: uPlot.AlignedData[] = [];
  const bands: uPlot.Band[] = [];
  let column = 1;
  for (const line of options.lines) {
    const keep = Array.from(line.x, (x, i) => [x, i] as const)
      .filter(([x]) => finite(x, options.logX) != null)
      .sort((a, b) => a[0] - b[0]);
    const values = (source: ArrayLike<number | null>) => keep.map(([, i]) => finite(source[i], options.logY));
    const columns: (number | null)[][] = [values(line.y)];
    if (line.low && line.high) {
      columns.push(values(line.high), values(line.low));
      bands.push({ series: [column + 1, column + 2], fill: () => `${paint(line)}2e` });
    }
    column += columns.length;
    tables.push([keep.map(([x]) => x), ...columns] as uPlot.AlignedData);
  }
  const data = tables.length > 0 ? uPlot.join(tables) : ([[]] as unknown as uPlot.AlignedData);
  return { data, bands };
}

function series(options: ChartOptions): uPlot.Series[] {
  const unit = options.unit ? ` ${options.unit}` : "";
  const time = !options.xLabel;
  const out: uPlot.Series[] = [{ label: time ? "time" : options.xLabel, value: (_, v) => (v == null ? "–" : time ? clock(v) : number(v, 4)) }];
  for (const line of options.lines) {
    const single = line.y.length === 1;
    out.push({
      label: line.name,
      stroke: () => paint(line),
      width: line.points ? 0 : line.colour === "ink" ? 2 : 1.75,
      dash: kDashes[line.dash ?? "solid"],
      points: line.points || single ? { show: true, size: 6, fill: () => paint(line) } : { show: false },
      spanGaps: false,
      value: (_, v) => (v == null ? "–" : number(v, 3) + unit),
    });
    if (line.low && line.high)
      for (const end of ["high", "low"])
        out.push({ label: `${line.name} ${end}`, stroke: "transparent", width: 0, points: { show: false }, class: "u-hidden" } as uPlot.Series);
  }
  return out;
}

/** Draws what lies under the lines: the good range, levels and marks. */
function drawGround(u: uPlot, options: ChartOptions): void {
  const { left, top, width, height } = u.bbox;
  const context = u.ctx,
    colours = theme(),
    ratio = window.devicePixelRatio || 1;
  context.save();
  context.beginPath();
  context.rect(left, top, width, height);
  context.clip();
  context.font = `${11 * ratio}px system-ui, sans-serif`;
  if (options.band) {
    const [low, high] = options.band.map((y) => u.valToPos(y, "y", true));
    context.fillStyle = colours.dark ? "rgba(63,207,159,0.14)" : "rgba(10,143,107,0.11)";
    context.fillRect(left, high, width, low - high);
  }
  context.strokeStyle = context.fillStyle = colours.muted;
  context.setLineDash([3 * ratio, 3 * ratio]);
  context.lineWidth = ratio;
  const stroke = (x0: number, y0: number, x1: number, y1: number) => {
    context.beginPath();
    context.moveTo(x0, y0);
    context.lineTo(x1, y1);
    context.stroke();
  };
  for (const level of options.levels ?? []) {
    const y = u.valToPos(level.y, "y", true);
    stroke(left, y, left + width, y);
    context.textAlign = "right";
    context.fillText(level.label, left + width - 4 * ratio, y - 4 * ratio);
  }
  for (const mark of options.marks ?? []) {
    const x = u.valToPos(mark.x, "x", true);
    stroke(x, top, x, top + height);
  }
  context.restore();
  // Above the plot, where no curve runs.
  context.save();
  context.font = `${11 * ratio}px system-ui, sans-serif`;
  context.fillStyle = colours.muted;
  for (const mark of options.marks ?? []) {
    const x = u.valToPos(mark.x, "x", true);
    if (x < left || x > left + width) continue; // zoomed away
    const wide = context.measureText(mark.label).width;
    context.textAlign = "left";
    context.fillText(mark.label, Math.min(x, left + width - wide), top - 5 * ratio);
  }
  context.restore();
}

function yRange(options: ChartOptions): uPlot.Scale.Range {
  return (_, low, high) => {
    if (low == null || high == null || !Number.isFinite(low)) return options.logY ? [0.1, 10] : [0, 1];
    for (const level of [...(options.levels ?? []).map((l) => l.y), ...(options.band ?? [])]) {
      low = Math.min(low, level);
      high = Math.max(high, level);
    }
    if (options.logY) return uPlot.rangeLog(low, high === low ? low * 10 : high, 10, false);
    // Zero belongs to the picture unless the values are all far from it.
    const mode = low > 0.6 * high ? 0 : 1;
    const [from, to] = uPlot.rangeNum(low, high, { min: { pad: 0.08, soft: 0, mode }, max: { pad: 0.08, soft: 0, mode: 2 } });
    return [options.range?.[0] ?? from, options.range?.[1] ?? to];
  };
}

function axes(options: ChartOptions): uPlot.Axis[] {
  const common: uPlot.Axis = {
    stroke: () => theme().muted,
    grid: { stroke: () => theme().grid, width: 1 },
    ticks: { stroke: () => theme().grid, width: 1, size: 4 },
    font: "12px system-ui, sans-serif",
    labelFont: "12px system-ui, sans-serif",
  };
  const time = !options.xLabel;
  const plain = (_: uPlot, values: (number | null)[]) => values.map((v) => (v == null ? "" : tick(v)));
  return [
    {
      ...common,
      label: options.xLabel,
      labelSize: 18,
      size: 30,
      space: 64,
      incrs: time ? kTimeSteps : undefined,
      values: time ? (_, values) => values.map((v) => clock(v)) : plain,
    },
    {
      ...common,
      label: options.yLabel,
      labelSize: 18,
      values: plain,
      size: (_, texts) => Math.max(56, 16 + 7 * Math.max(0, ...(texts ?? []).map((text) => text.length))),
    },
  ];
}

/** Makes a plot; it takes the width of its element and follows it. */
export function chart(options: ChartOptions): Chart {
  const holder = h("div", { class: "plot" });
  const element = h(
    "figure",
    { class: "chart" },
    h(
      "figcaption",
      {},
      h("strong", {}, options.title),
      options.unit ? h("span", { class: "unit" }, ` ${options.unit}`) : null,
      options.note ? h("span", { class: "note" }, options.note) : null,
    ),
    holder,
  );
  const { data, bands } = table(options);
  // By column, as uPlot counts: a line with a band takes three.
  const dashes: string[] = [
    "solid",
    ...options.lines.flatMap((line) => {
      const dash = line.points ? "dotted" : (line.dash ?? "solid");
      return line.low && line.high ? [dash, dash, dash] : [dash];
    }),
  ];
  if (!(data[0]?.length > 0) && !options.live) {
    holder.append(h("p", { class: "empty" }, "The records hold nothing for this plot."));
    return { element, showTime: () => undefined, update: () => undefined, remove: () => element.remove() };
  }
  holder.setAttribute("role", "img");
  holder.setAttribute("aria-label", `${options.title}${options.unit ? ` in ${options.unit}` : ""}: ` + options.lines.map((line) => line.name).join(", "));

  const timeLine = h("div", { class: "time-line", hidden: true });
  let plot: uPlot | undefined;
  let shown: number | undefined;
  const place = () => {
    if (!plot || shown == null) return;
    timeLine.hidden = shown < (plot.scales.x.min ?? 0) || shown > (plot.scales.x.max ?? 0);
    timeLine.style.transform = `translateX(${plot.valToPos(shown, "x")}px)`;
  };
  const height = options.height ?? kHeight;
  const xLow = data[0][0] as number,
    xHigh = data[0][data[0].length - 1] as number;
  plot = new uPlot(
    {
      width: 480,
      height,
      bands,
      series: series(options),
      axes: axes(options),
      scales: {
        x: { time: false, distr: options.logX ? 3 : 1, ...(xLow === xHigh && !options.live ? { range: [xLow - 1, xHigh + 1] as [number, number] } : {}) },
        y: { distr: options.logY ? 3 : 1, range: yRange(options) },
      },
      padding: [(options.marks ?? []).length > 0 ? 20 : 8, null, null, null],
      legend: {
        markers: {
          width: 2,
          stroke: (u, i) => (typeof u.series[i].stroke === "function" ? (u.series[i].stroke as (u: uPlot, i: number) => string)(u, i) : ""),
          fill: () => "transparent",
          dash: (_, i) => dashes[i] ?? "solid",
        },
      },
      cursor: { sync: options.sync ? { key: options.sync, scales: ["x", null] } : undefined, points: { size: 7 }, drag: { x: true, y: false } },
      hooks: {
        drawClear: [(u) => drawGround(u, options)],
        draw: [place],
        ready: [
          (u) => {
            u.over.append(timeLine);
            if (options.onPick) u.over.addEventListener("click", (event) => options.onPick?.(u.posToVal(event.offsetX, "x")));
          },
        ],
      },
    },
    data,
    holder,
  );

  const sizes = new ResizeObserver(() => {
    const width = Math.floor(holder.clientWidth);
    if (width > 0 && plot && width !== plot.width) plot.setSize({ width, height });
  });
  sizes.observe(holder);
  const forget = onThemeChange(() => plot?.redraw(false));
  return {
    element,
    showTime: (x) => {
      shown = x;
      place();
    },
    update: (lines) => {
      options.lines = lines; // a colour is looked up when it is drawn
      plot?.setData(table(options).data);
    },
    remove: () => {
      forget();
      sizes.disconnect();
      plot?.destroy();
      plot = undefined;
      element.remove();
    },
  };
}
