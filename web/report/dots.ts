// SPDX-License-Identifier: Apache-2.0
/** Values of every pair of a row and a series along one axis: drawn as SVG, so that they
 * stay crisp on paper. */
import { h, number, tick } from "../common/dom";
import type { StudyDots } from "./data";

const kWidth = 900,
  kLeft = 150,
  kRight = 24,
  kTop = 8,
  kLane = 11,
  kGap = 9,
  kAxis = 44;
const kColours = 8;
const kFar = 30; // times the middle value

type Attributes = Record<string, string | number>;

export function svg(tag: string, attributes: Attributes, ...children: (Node | string)[]): SVGElement {
  const element = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, String(value));
  element.append(...children);
  return element;
}

const known = (value: number | null): value is number => value != null && Number.isFinite(value);

/** 1, 2, 5 times powers of ten within [low, high]; powers only when those are many. */
function logTicks(low: number, high: number): number[] {
  const all: number[] = [];
  for (let power = Math.floor(Math.log10(low)); power <= Math.ceil(Math.log10(high)); ++power) for (const digit of [1, 2, 5]) all.push(digit * 10 ** power);
  const inside = all.filter((value) => value >= low * 0.999 && value <= high * 1.001);
  return inside.length > 9 ? inside.filter((value) => Math.abs(Math.log10(value) % 1) < 1e-9) : inside;
}

export function linearTicks(low: number, high: number): number[] {
  const rough = (high - low) / 6,
    power = 10 ** Math.floor(Math.log10(rough));
  const step = power * ([1, 2, 5, 10].find((digit) => digit * power >= rough) ?? 10);
  const out: number[] = [];
  for (let k = Math.ceil(low / step); k * step <= high; ++k) out.push(k * step);
  return out;
}

/** The mark of a series: eight colours, first filled, then hollow. */
function mark(series: number, x: number, y: number): SVGElement {
  const hollow = series >= kColours;
  const shapes: ((r: number) => [string, Attributes])[] = [
    (r) => ["circle", { cx: x, cy: y, r }],
    (r) => ["rect", { x: x - r, y: y - r, width: 2 * r, height: 2 * r }],
    (r) => ["path", { d: `M${x} ${y - 1.3 * r}l${1.3 * r} ${1.3 * r}l${-1.3 * r} ${1.3 * r}l${-1.3 * r} ${-1.3 * r}z` }],
    (r) => ["path", { d: `M${x} ${y - 1.2 * r}l${1.2 * r} ${2.1 * r}h${-2.4 * r}z` }],
  ];
  const [tag, place] = shapes[series % shapes.length](hollow ? 3.2 : 3.6);
  return svg(tag, { ...place, class: `dot s${series % kColours}${hollow ? " hollow" : ""}` });
}

export function dotPlot(data: StudyDots): HTMLElement {
  const all = data.dots
    .flat(2)
    .filter(known)
    .filter((value) => !data.log_x || value > 0);
  const caption = h("figcaption", {}, h("strong", {}, data.title), data.caption ? h("span", { class: "note" }, data.caption) : null);
  if (all.length === 0) return h("figure", { class: "chart" }, caption, h("p", { class: "empty" }, "No run has ended yet."));
  // The values decide the axis; an interval that goes far beyond them is cut off.
  const values = data.dots
    .flat()
    .map(([value]) => value)
    .filter(known)
    .sort((a, b) => a - b);
  const least = values[0],
    middle = values[Math.floor(values.length / 2)];
  // Values far beyond the others stand at the edge, with their number.
  const most = Math.max(...values.filter((value) => value <= kFar * middle));
  const pad = data.log_x ? 1.25 : 0;
  const low = data.log_x ? Math.max(Math.min(...all), least / 3) / pad : Math.min(0, ...all);
  const high = data.log_x ? Math.min(Math.max(...all), most * 3) * pad : 1.05 * Math.min(Math.max(...all), most * 3);
  const scale = (value: number) => {
    const part = data.log_x ? Math.log(Math.max(value, 1e-12) / low) / Math.log(high / low) : (value - low) / (high - low);
    return kLeft + Math.min(1, Math.max(0, part)) * (kWidth - kLeft - kRight);
  };
  const rowHeight = data.series.length * kLane + kGap;
  const bottom = kTop + data.rows.length * rowHeight,
    height = bottom + kAxis;
  const parts: SVGElement[] = [];
  for (const value of data.log_x ? logTicks(low, high) : linearTicks(low, high)) {
    const x = scale(value);
    parts.push(svg("line", { x1: x, x2: x, y1: kTop, y2: bottom, class: "grid" }), svg("text", { x, y: bottom + 16, "text-anchor": "middle" }, tick(value)));
  }
  parts.push(svg("text", { x: (kLeft + kWidth - kRight) / 2, y: height - 6, "text-anchor": "middle" }, data.x_label));
  data.rows.forEach((name, r) => {
    const top = kTop + r * rowHeight;
    if (r % 2 === 0) parts.unshift(svg("rect", { x: 0, y: top, width: kWidth, height: rowHeight, class: "stripe" }));
    parts.push(svg("text", { x: kLeft - 10, y: top + rowHeight / 2 + 4, "text-anchor": "end", class: "row" }, name));
    data.dots[r].forEach(([value, from, to], s) => {
      if (!known(value)) return;
      const y = top + kGap / 2 + (s + 0.5) * kLane,
        x = scale(value);
      const text = `${name}, ${data.series[s]}: ${number(value)}` + (known(from) && known(to) ? ` (${number(from)} to ${number(to)})` : "");
      const group = svg("g", {}, svg("title", {}, text));
      if (known(from) && known(to) && value <= high)
        group.append(svg("line", { x1: scale(from), x2: scale(to), y1: y, y2: y, class: `whisker s${s % kColours}` }));
      if (value > high)
        group.append(svg("text", { x: kWidth - kRight - 6, y: y + 4, "text-anchor": "end", class: `beyond s${s % kColours}` }, `${number(value)} ▸`));
      else group.append(mark(s, x, y));
      parts.push(group);
    });
  });
  const legend = h(
    "ul",
    { class: "dot-legend" },
    ...data.series.map((name, s) => {
      const key = svg("svg", { width: 14, height: 14, viewBox: "0 0 14 14", "aria-hidden": "true" }, mark(s, 7, 7));
      const item = h("li", {});
      item.append(key, ` ${name}`);
      return item;
    }),
  );
  const picture = svg(
    "svg",
    { viewBox: `0 0 ${kWidth} ${height}`, class: "dots", role: "img", "aria-label": `${data.title}, ${data.x_label}: ${data.series.join(", ")}` },
    ...parts,
  );
  const figure = h("figure", { class: "chart dots-figure" }, caption, legend);
  figure.append(picture);
  return figure;
}
