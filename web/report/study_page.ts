// SPDX-License-Identifier: Apache-2.0
/** The report of a study: text, tables, plots. */
import { chart } from "../common/chart";
import type { StudyCell, StudyData } from "./data";
import { h, number, section } from "../common/dom";
import { dotPlot } from "./dots";
import { trackMap } from "./tracks";

function cell(content: StudyCell): HTMLElement {
  const numeric = content.number !== undefined;
  return h(
    "td",
    { class: [numeric ? "number" : "text", content.highlight ? "best" : ""].join(" ").trim() },
    numeric ? number(content.number) : (content.text ?? ""),
    content.highlight ? h("span", { class: "visually-hidden" }, " (highlighted)") : null,
  );
}

function table(data: StudyData["tables"][number]): HTMLElement {
  // A column of numbers has its heading above them, on the right.
  const numeric = (column: number) => data.rows.some((row) => row[column]?.number !== undefined);
  return h(
    "figure",
    { class: "study-table" },
    data.title ? h("h3", {}, data.title) : null,
    h(
      "div",
      { class: "scroll" },
      h(
        "table",
        { class: "study" },
        h("thead", {}, h("tr", {}, ...data.columns.map((name, i) => h("th", { scope: "col", class: numeric(i) ? "number" : "text" }, name)))),
        h("tbody", {}, ...data.rows.map((row) => h("tr", {}, ...row.map(cell)))),
      ),
    ),
    data.caption ? h("figcaption", {}, data.caption) : null,
  );
}

export function studyPage(data: StudyData): HTMLElement[] {
  const plots = data.plots.map((plot) =>
    chart({
      title: plot.title,
      note: plot.caption,
      xLabel: plot.x_label || "x",
      yLabel: plot.y_label,
      logX: plot.log_x,
      logY: plot.log_y,
      levels: plot.lines,
      range: [plot.y_low, plot.y_high],
      lines: plot.series.map((series, i) => ({
        name: series.name,
        x: series.x.map((v) => v ?? NaN),
        y: series.y,
        low: series.low,
        high: series.high,
        colour: series.dashed ? "ink" : i % 8, // what others are compared with
        dash: series.dashed ? "dashed" : i >= 8 ? "dotted" : "solid",
        points: series.points,
      })),
    }),
  );
  return [
    h(
      "header",
      {},
      h("h1", {}, data.title),
      data.alert ? h("p", { class: "failure", role: "status" }, data.alert) : null,
      ...data.intro.map((text) => h("p", { class: "intro" }, text)),
    ),
    ...(data.dots.length > 0 ? [section("At a glance", "dots", ...data.dots.map(dotPlot))] : []),
    ...(data.tables.length > 0 ? [section("Results", "tables", ...data.tables.map(table))] : []),
    ...(plots.length + data.maps.length > 0
      ? [section("Plots", "plots", h("div", { class: "charts" }, ...plots.map((p) => p.element), ...data.maps.map(trackMap)))]
      : []),
    ...(data.notes.length > 0 ? [section("Notes", "notes", h("ul", {}, ...data.notes.map((text) => h("li", {}, text))))] : []),
  ];
}
