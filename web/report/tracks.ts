// SPDX-License-Identifier: Apache-2.0
/** Tracks over ground, north up, both axes to the same scale. Drawn as SVG. */
import { h, tick } from "../common/dom";
import type { StudyMap } from "./data";
import { linearTicks, svg } from "./dots";

const kWidth = 560,
  kLeft = 48,
  kRight = 12,
  kTop = 10,
  kAxis = 40,
  kMost = 640,
  kLeast = 200;
const kColours = 8;

export function trackMap(data: StudyMap): HTMLElement {
  const caption = h("figcaption", {}, h("strong", {}, data.title), data.caption ? h("span", { class: "note" }, data.caption) : null);
  const ends = (values: number[]): [number, number] => values.reduce(([low, high], v) => [Math.min(low, v), Math.max(high, v)], [Infinity, -Infinity]);
  const [west, east] = ends(data.series.flatMap((series) => series.x.map((v) => v ?? NaN)));
  const [south, north] = ends(data.series.flatMap((series) => series.y.map((v) => v ?? NaN)));
  if (!(east >= west && north >= south)) return h("figure", { class: "chart" }, caption, h("p", { class: "empty" }, "Nothing has been flown yet."));
  const margin = 0.04 * Math.max(east - west, north - south, 1);
  const wide = east - west + 2 * margin,
    high = north - south + 2 * margin;
  const scale = Math.min((kWidth - kLeft - kRight) / wide, kMost / high);
  const right = kWidth - kRight,
    bottom = kTop + Math.max(high * scale, kLeast),
    height = bottom + kAxis;
  const middleX = (kLeft + right) / 2,
    middleY = (kTop + bottom) / 2;
  const x = (value: number) => middleX + (value - (west + east) / 2) * scale;
  const y = (value: number) => middleY - (value - (south + north) / 2) * scale;
  const seen = (from: number, to: number, centre: number, at: number): [number, number] => [centre + (from - at) / scale, centre + (to - at) / scale];
  const parts: SVGElement[] = [];
  for (const value of linearTicks(...seen(kLeft, right, (west + east) / 2, middleX)))
    parts.push(
      svg("line", { x1: x(value), x2: x(value), y1: kTop, y2: bottom, class: "grid" }),
      svg("text", { x: x(value), y: bottom + 16, "text-anchor": "middle" }, tick(value)),
    );
  for (const value of linearTicks(...seen(middleY - bottom, middleY - kTop, (south + north) / 2, 0)))
    parts.push(
      svg("line", { x1: kLeft, x2: right, y1: y(value), y2: y(value), class: "grid" }),
      svg("text", { x: kLeft - 6, y: y(value) + 4, "text-anchor": "end" }, tick(value)),
    );
  parts.push(
    svg("text", { x: middleX, y: height - 6, "text-anchor": "middle" }, "east [m]"),
    svg("text", { x: 12, y: middleY, "text-anchor": "middle", transform: `rotate(-90 12 ${middleY})` }, "north [m]"),
  );
  const style = (i: number) => `way ${data.series[i].dashed ? "plan" : `s${i % kColours}`}`;
  data.series.forEach((series, i) => {
    const points = series.x.map((value, k) => `${x(value ?? NaN).toFixed(1)},${y(series.y[k] ?? NaN).toFixed(1)}`);
    parts.push(svg("polyline", { points: points.join(" "), class: style(i) }, svg("title", {}, series.name)));
  });
  const legend = h(
    "ul",
    { class: "dot-legend" },
    ...data.series.map((series, i) => {
      const item = h("li", {});
      item.append(
        svg("svg", { width: 24, height: 8, viewBox: "0 0 24 8", "aria-hidden": "true" }, svg("polyline", { points: "0,4 24,4", class: style(i) })),
        ` ${series.name}`,
      );
      return item;
    }),
  );
  const picture = svg(
    "svg",
    {
      viewBox: `0 0 ${kWidth} ${height}`,
      class: "dots tracks",
      role: "img",
      "aria-label": `${data.title}: ${data.series.map((series) => series.name).join(", ")}`,
    },
    ...parts,
  );
  const figure = h("figure", { class: "chart" }, caption, legend);
  figure.append(picture);
  return figure;
}
