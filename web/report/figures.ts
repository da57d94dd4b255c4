// SPDX-License-Identifier: Apache-2.0
/** The tables of key figures, for one run or several side by side. */
import type { RunData } from "./data";
import { clock, h, number } from "../common/dom";
import { chosen, sameFire } from "./scenario_text";

type Best = "low" | "high" | { near: number };

/** A metric over time: its mean and its last value are in the summary. */
interface Metric {
  name: string;
  unit: string;
  label: string;
  help: string;
  best?: Best;
}

/** A single number of a run. */
interface Count {
  label: string;
  unit?: string;
  show: (run: RunData) => number | undefined;
  text?: (value: number) => string;
}

interface Row {
  label: string;
  help?: string;
  unit?: string;
  best?: Best;
  values: (number | undefined)[];
  text?: (value: number) => string;
}

const kMetrics: Metric[] = [
  { name: "perf", unit: "m", label: "Perf", help: "error and stated deviation together", best: "low" },
  { name: "boundary_rms", unit: "m", label: "Boundary RMS", help: "between the boundaries, in both directions", best: "low" },
  { name: "boundary_hausdorff", unit: "m", label: "Hausdorff", help: "largest distance between them", best: "low" },
  { name: "iou", unit: "", label: "IoU", help: "intersection over union of the areas", best: "high" },
  { name: "coverage_95", unit: "", label: "95 % coverage", help: "points inside their band", best: { near: 0.95 } },
  { name: "nees", unit: "", label: "NEES", help: "squared error over variance; 1 is consistent", best: { near: 1 } },
  { name: "rmse", unit: "m", label: "RMS error", help: "of the believed points", best: "low" },
  { name: "sigma", unit: "m", label: "Stated deviation", help: "of the believed points" },
  { name: "crps", unit: "m", label: "CRPS", help: "score of the whole distribution", best: "low" },
  { name: "latency_mean", unit: "s", label: "Age of knowledge", help: "since the last crossing nearby", best: "low" },
];

const key = (name: string) => (run: RunData) => run.summary[name];
const of = (run: RunData, metric: Metric, part: string) => run.summary[`${metric.name}_${part}${metric.unit ? `_${metric.unit}` : ""}`];

/** The smallest figure whose name begins so, times `factor`; undefined without any. */
function lowest(run: RunData, beginning: string, factor: number): number | undefined {
  const all = Object.entries(run.summary)
    .filter(([name]) => name.startsWith(beginning))
    .map(([, value]) => value);
  return all.length > 0 ? factor * Math.min(...all) : undefined;
}

const kCounts: Count[] = [
  { label: "Simulated time", show: (run) => run.duration_s, text: clock },
  { label: "Speed", unit: "×", show: key("real_time_factor") },
  { label: "Missed deadlines", show: key("deadline_misses") },
  { label: "Aircraft", show: key("aircraft") },
  { label: "Distance flown, all", unit: "km", show: (run) => run.summary.distance_flown_total_m / 1000 },
  { label: "Accidents", show: key("accidents") },
  { label: "Failsafes", show: key("failsafes") },
  { label: "Off the path, RMS", unit: "m", show: key("cross_track_rms_m") },
  { label: "Error of own position, RMS", unit: "m", show: key("position_error_rms_m") },
  { label: "Lowest charge", unit: "%", show: (run) => 100 * run.summary.min_charge },
  { label: "Separation violations", show: key("violations") },
  { label: "Near collisions", show: key("near_collisions") },
  { label: "Least distance over separation", show: key("separation_min_ratio") },
  { label: "Conflicts", show: key("conflicts") },
  { label: "Conflicts unsolved", show: key("conflicts_unsolved") },
  { label: "Conflicts solved before, least", unit: "s", show: key("conflict_fixed_before_min_s") },
  { label: "Team leads", show: key("team_masters") },
  { label: "Changes of the lead", show: key("team_changes") },
  { label: "Team tasks done", show: key("team_tasks_done") },
  { label: "Tasks flown twice, longest", unit: "s", show: key("team_double_max_s") },
  { label: "Allocations proposed", show: key("team_allocations_proposed") },
  { label: "Allocations approved", show: key("team_allocations_approved") },
  { label: "Allocations rejected", show: key("team_allocations_rejected") },
  { label: "Allocations taken over", show: key("team_allocations_taken_over") },
  { label: "Observations", show: key("observations") },
  { label: "Crossings", show: key("crossings") },
  { label: "Lowest reserve", unit: "%", show: (run) => lowest(run, "min_reserve_", 100) },
  { label: "Objects found", show: (run) => run.summary.objects && run.summary.objects_found },
  { label: "Non-actual observations", show: key("non_actual_observations") },
  { label: "Unknown object interactions", show: key("unknown_object_interactions") },
  { label: "Detections", show: key("detections") },
  { label: "Other aircraft", show: key("traffic") },
  { label: "Error of their tracks, RMS", unit: "m", show: key("traffic_error_rms_m") },
  { label: "Alerts", show: key("traffic_alerts") },
  { label: "Highest alert", show: (run) => (run.summary.traffic_alerts ? run.summary.traffic_alert_level_max : undefined) },
  { label: "Recommendations, followed", show: key("recommendations_followed") },
  { label: "Recommendations, ignored", show: (run) => run.summary.recommendations_ignored },
  { label: "Scans", show: key("range_scans") },
  {
    label: "Messages lost",
    unit: "%",
    show: (run) => (run.summary.message_copies > 0 ? (100 * run.summary.messages_lost) / run.summary.message_copies : undefined),
  },
];

/** Counts that say something only when they are not zero. */
const kWhenAny = ["Missed deadlines", "Accidents", "Failsafes", "Observations", "Crossings", "Tasks flown twice, longest"];

const known = (value: number | undefined): value is number => value != null && Number.isFinite(value);

/** Which values are the best ones, as far as the printed digits distinguish them. */
function bestOf(values: (number | undefined)[], texts: string[], best?: Best): boolean[] {
  const cost = values.map((v) =>
    !known(v)
      ? Infinity
      : best === "low"
        ? v
        : best === "high"
          ? -v
          : // Ratios are judged as ratios: 0.5 is as far from 1 as 2.
            best
            ? Math.abs(best.near === 1 ? Math.log(Math.max(v, 1e-9)) : v - best.near)
            : 0,
  );
  const winner = texts[cost.indexOf(Math.min(...cost))];
  const useful = best != null && new Set(texts).size > 1;
  return values.map((v, i) => useful && known(v) && texts[i] === winner);
}

function table(caption: string | null, columns: (Node | string)[], rows: Row[], compare: boolean, before: HTMLElement[] = []): HTMLElement {
  const body = rows
    .filter((row) => row.values.some(known))
    .map((row) => {
      const texts = row.values.map((value) => (!known(value) ? "–" : (row.text ?? number)(value)));
      const best = compare ? bestOf(row.values, texts, row.best) : [];
      const cells = row.values.map((value, i) =>
        h(
          "td",
          { class: best[i] ? "best" : undefined },
          texts[i],
          row.unit && known(value) ? h("span", { class: "unit" }, ` ${row.unit}`) : null,
          best[i] ? h("span", { class: "visually-hidden" }, " (best)") : null,
        ),
      );
      return h("tr", {}, h("th", { scope: "row" }, row.label, row.help ? h("span", { class: "help" }, row.help) : null), ...cells);
    });
  return h(
    "div",
    { class: "scroll" },
    h(
      "table",
      { class: "figures" },
      caption ? h("caption", {}, caption) : null,
      h("thead", {}, h("tr", {}, h("th", { scope: "col" }, "Figure"), ...columns.map((column) => h("th", { scope: "col" }, column)))),
      h("tbody", {}, ...before, ...body),
    ),
  );
}

/** Whether the run was about a fire at all. */
export const hasMetrics = (run: RunData) => kMetrics.some((metric) => ["mean", "run_mean", "final"].some((part) => known(of(run, metric, part))));

/** One run: each metric's means and last value. */
export function figuresTable(run: RunData): HTMLElement {
  return table(
    null,
    ["mean", "whole run", "at the end"],
    kMetrics.map((metric) => ({ ...metric, values: ["mean", "run_mean", "final"].map((part) => of(run, metric, part)) })),
    false,
  );
}

function headings(runs: RunData[]): HTMLElement[] {
  return runs.map((run, i) => h("span", {}, h("span", { class: `swatch c${i % 8}`, "aria-hidden": "true" }), run.label));
}

/** Who flew and thought: before the figures. */
function settingRows(runs: RunData[]): HTMLElement[] {
  const settings: [string, (run: RunData) => string][] = [
    ["Estimator", (run) => chosen(run.scenario, "estimator")],
    ["Strategy", (run) => chosen(run.scenario, "strategy")],
    ["Seed", (run) => run.seed],
    ["State", (run) => (runs.every((each) => each.state === "complete") ? "" : run.state)],
  ];
  return settings
    .filter(([, of]) => runs.some(of))
    .map(([label, of]) => h("tr", {}, h("th", { scope: "row" }, label), ...runs.map((run) => h("td", {}, of(run) || "–"))));
}

/** Figures of missions, one column for each run; none where no mission has any. */
export function missionTable(runs: RunData[]): HTMLElement | null {
  const texts = Object.assign({}, ...runs.map((run) => run.missions.texts)) as Record<string, string>;
  const rows: Row[] = Object.entries(texts).map(([name, text]) => ({ label: text, values: runs.map((run) => run.summary[name]) }));
  return rows.length > 0 ? table("Missions", runs.length > 1 ? headings(runs) : ["value"], rows, false) : null;
}

/** Several runs: one column for each. */
export function comparisonTables(runs: RunData[]): HTMLElement[] {
  const rows = (part: string): Row[] => kMetrics.map((metric) => ({ ...metric, values: runs.map((run) => of(run, metric, part)) }));
  const counts: Row[] = kCounts.map((count) => ({ ...count, values: runs.map(count.show) }));
  const fair = sameFire(runs);
  const more = (title: string, part: string) => h("details", {}, h("summary", {}, title), table(null, headings(runs), rows(part), fair));
  return [
    table(null, headings(runs), [...rows("mean"), ...counts], fair, settingRows(runs)),
    more("Means over the whole run, with the deployment", "run_mean"),
    more("Values at the end", "final"),
  ];
}

/** Large tiles with what matters most of a single run, and its counts. */
export function tiles(run: RunData): HTMLElement {
  const tile = (label: string, value: number | undefined, unit = "", text: (v: number) => string = number) =>
    !known(value)
      ? null
      : h(
          "div",
          { class: "tile" },
          h("span", { class: "tile-label" }, label),
          h("span", { class: "tile-value" }, text(value), unit ? h("span", { class: "unit" }, ` ${unit}`) : null),
        );
  return h(
    "div",
    { class: "tiles" },
    ...["perf", "boundary_rms", "iou", "coverage_95"].map((name) => {
      const metric = kMetrics.find((each) => each.name === name)!;
      const mean = of(run, metric, "mean");
      // Without an allocation phase there is only the whole run, and the tile says so.
      return known(mean) ? tile(`${metric.label}, mean`, mean, metric.unit) : tile(`${metric.label}, whole run`, of(run, metric, "run_mean"), metric.unit);
    }),
    ...kCounts.filter((count) => !kWhenAny.includes(count.label) || count.show(run)).map((count) => tile(count.label, count.show(run), count.unit, count.text)),
  );
}
