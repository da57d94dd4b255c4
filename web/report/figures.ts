/** The table of key figures, for one run or several side by side. */
import type { RunData } from "./data";
import { clock, h, number } from "./dom";

interface Figure {
  label: string;
  help: string;
  show: (run: RunData) => number | undefined;
  text?: (value: number) => string;
  best?: "low" | "high" | { near: number };
  unit?: string;
}

const key = (name: string) => (run: RunData) => run.summary[name];

const metric = (name: string, unit: string, label: string, help: string,
  best: Figure["best"]): Figure[] => {
  const suffix = unit === "" ? "" : `_${unit}`;
  return [
    { label: `${label}, mean`, help, unit, best, show: key(`${name}_mean${suffix}`) },
    { label: `${label}, at the end`, help, unit, best, show: key(`${name}_final${suffix}`) },
  ];
};

const kFigures: Figure[] = [
  ...metric("perf", "m", "Perf", "root mean square of error and stated deviation together", "low"),
  { label: "Perf, mean of the whole run", help: "including the deployment", unit: "m", best: "low",
    show: key("perf_run_mean_m") },
  ...metric("boundary_rms", "m", "Boundary RMS", "distance between the boundaries, both ways", "low"),
  ...metric("boundary_hausdorff", "m", "Hausdorff", "largest distance between the boundaries", "low"),
  ...metric("iou", "", "IoU", "intersection over union of the areas", "high"),
  ...metric("coverage_95", "", "95 % coverage", "share of points inside their 95 % band", { near: 0.95 }),
  ...metric("nees", "", "NEES", "squared error over stated variance; 1 is consistent", { near: 1 }),
  ...metric("sigma", "m", "Stated deviation", "root mean square of sigma", undefined),
  ...metric("crps", "m", "CRPS", "continuous ranked probability score", "low"),
  ...metric("latency_mean", "s", "Age of knowledge", "since the last crossing nearby", "low"),
  { label: "Simulated time", help: "", show: (run) => run.duration_s, text: clock },
  { label: "Speed", help: "simulated time over wall time", unit: "× real time", show: key("real_time_factor") },
  { label: "Aircraft", help: "", show: key("aircraft") },
  { label: "Distance flown", help: "all aircraft", unit: "km",
    show: (run) => run.summary.distance_flown_total_m / 1000 },
  { label: "Observations", help: "in/out readings", show: key("observations") },
  { label: "Crossings", help: "of the boundary", show: key("crossings") },
  { label: "Messages lost", help: "of those sent", unit: "%",
    show: (run) => run.summary.messages_sent > 0
      ? (100 * run.summary.messages_lost) / run.summary.messages_sent : undefined },
];

/** Which values are the best ones; none when all are alike or nothing is better. */
function bestOf(values: (number | undefined)[], best: Figure["best"]): boolean[] {
  const cost = values.map((v) =>
    v == null || !Number.isFinite(v) ? Infinity
      : best === "low" ? v : best === "high" ? -v
      // Ratios are judged as ratios: 0.5 is as far from 1 as 2.
      : best ? Math.abs(best.near === 1 ? Math.log(Math.max(v, 1e-9)) : v - best.near) : 0);
  const least = Math.min(...cost);
  const useful = best != null && values.length > 1 && new Set(cost).size > 1;
  return cost.map((c) => useful && c === least && Number.isFinite(c));
}

export function figuresTable(runs: RunData[]): HTMLElement {
  const rows = kFigures.flatMap((figure) => {
    const values = runs.map(figure.show);
    if (values.every((v) => v == null || !Number.isFinite(v))) return [];
    const best = bestOf(values, figure.best);
    const cells = values.map((value, i) => {
      const text = value == null || !Number.isFinite(value) ? "–"
        : figure.text ? figure.text(value) : number(value);
      return h("td", { class: best[i] ? "best" : "" }, text,
        figure.unit && text !== "–" ? h("span", { class: "unit" }, ` ${figure.unit}`) : null,
        best[i] ? h("span", { class: "visually-hidden" }, " (best)") : null);
    });
    return [h("tr", {}, h("th", { scope: "row" }, figure.label,
      figure.help ? h("span", { class: "help" }, figure.help) : null), ...cells)];
  });
  const head = h("tr", {}, h("th", { scope: "col" }, "Figure"),
    ...runs.map((run, i) => h("th", { scope: "col" },
      h("span", { class: `swatch c${i % 8}`, "aria-hidden": "true" }), run.label)));
  return h("div", { class: "scroll" },
    h("table", { class: "figures" }, h("thead", {}, head), h("tbody", {}, ...rows)));
}

/** Large tiles with what matters most, for a single run. */
export function tiles(run: RunData): HTMLElement {
  const tile = (label: string, value: number | undefined, unit: string, text: (value: number) => string = number) =>
    value == null || !Number.isFinite(value) ? null
      : h("div", { class: "tile" }, h("span", { class: "tile-label" }, label),
        h("span", { class: "tile-value" }, text(value), h("span", { class: "unit" }, ` ${unit}`)));
  const s = run.summary;
  return h("div", { class: "tiles" },
    tile("Perf, mean", s.perf_mean_m ?? s.perf_run_mean_m, "m"),
    tile("Boundary RMS, mean", s.boundary_rms_mean_m ?? s.boundary_rms_run_mean_m, "m"),
    tile("IoU, mean", s.iou_mean ?? s.iou_run_mean, ""),
    tile("95 % coverage, mean", s.coverage_95_mean ?? s.coverage_95_run_mean, ""),
    tile("Aircraft", s.aircraft, ""),
    tile("Simulated", run.duration_s, "", clock));
}
