// SPDX-License-Identifier: Apache-2.0
/** The report of one run or several. */
import { chart, type Chart, type ChartOptions, type Dash, type Line } from "../common/chart";
import { floats, type RunData } from "./data";
import { clock, h, section } from "../common/dom";
import { eventKind } from "../common/events";
import { comparisonTables, figuresTable, hasMetrics, missionTable, tiles } from "./figures";
import { flightCharts } from "./flight_plots";
import { chosen, sameFire } from "./scenario_text";
import { MapPanel, noMap } from "./map_panel";
import { pilotPanel } from "./pilot_panel";
import { loadLines, radioPanel } from "./radio_panel";

const kStates = {
  complete: "complete",
  interrupted: "interrupted by the user, records complete up to there",
  "cut off": "cut off: the program ended without closing its records",
};

function identity(run: RunData): HTMLElement {
  const row = (label: string, value: string) => (value ? [h("dt", {}, label), h("dd", {}, value)] : []);
  const monitors = hasMetrics(run) ? [...row("Estimator", chosen(run.scenario, "estimator")), ...row("Strategy", chosen(run.scenario, "strategy"))] : [];
  return h(
    "dl",
    { class: "identity" },
    ...row("Scenario", run.name),
    ...monitors,
    ...row("Directory", run.directory),
    ...row("Seed", run.seed),
    ...row("Skein", run.version),
    ...row("Start", run.start_utc),
    ...row("Simulated", clock(run.duration_s)),
    ...row("State", kStates[run.state]),
    ...row("Content hash", run.content_hash),
  );
}

/** The second quantity of a run is dashed; runs beyond the eight colours are dotted. */
const dashOf = (run: number, second: boolean): Dash => (run >= 8 ? "dotted" : second ? "dashed" : "solid");

/** Whether a linear axis would hide the good runs beside a bad one. */
function needsLog(all: Line[], runs: RunData[]): boolean {
  if (runs.length < 2) return false;
  const series = all
    .map((line) =>
      Array.from(line.y)
        .filter((y): y is number => y != null && Number.isFinite(y) && y > 0)
        .sort((a, b) => a - b),
    )
    .filter((values) => values.length > 0);
  if (series.length < 2) return false;
  const most = Math.max(...series.map((values) => values[values.length - 1]));
  const good = Math.min(...series.map((values) => values[Math.floor(values.length / 2)]));
  return most > 20 * good;
}

/** Lines of metrics columns for every run; with several runs, the run has the colour. */
function lines(runs: RunData[], columns: [string, string][]): Line[] {
  return runs.flatMap((run, r) =>
    columns.flatMap(([column, name], c) => {
      const packed = run.metrics.columns[column];
      if (!packed) return [];
      const y = floats(packed);
      if (!y.some(Number.isFinite)) return [];
      const label = runs.length === 1 ? name : columns.length === 1 ? run.label : `${run.label}: ${name}`;
      return [{ name: label, x: floats(run.metrics.time_s), y: Array.from(y), colour: (runs.length === 1 ? c : r) % 8, dash: dashOf(r, c > 0) }];
    }),
  );
}

const kKindsShown = 6;

/** Bytes/s that all together send: by kind of message of one run, in sum of several. */
function byteLines(runs: RunData[]): Line[] {
  const sumOf = (all: number[][], bins: number) => Array.from({ length: bins }, (_, i) => all.reduce((sum, each) => sum + each[i], 0));
  return runs.flatMap((run, r) => {
    const bins = run.messages.sent.length,
      total = (values: number[]) => values.reduce((a, b) => a + b, 0);
    const kinds = Object.entries(run.messages.bytes).sort((a, b) => total(b[1]) - total(a[1]));
    if (kinds.length === 0) return [];
    const rest = kinds.slice(kKindsShown).map(([, bytes]) => bytes);
    const shown: [string, number[]][] =
      runs.length > 1
        ? [
            [
              run.label,
              sumOf(
                kinds.map(([, bytes]) => bytes),
                bins,
              ),
            ],
          ]
        : [...kinds.slice(0, kKindsShown), ...(rest.length > 0 ? [["all others", sumOf(rest, bins)] as [string, number[]]] : [])];
    return shown.map(([name, bytes], k) => ({
      name,
      x: bytes.map((_, i) => (i + 0.5) * run.messages.bin_s),
      y: bytes.map((sum, i) => {
        const left = run.duration_s - i * run.messages.bin_s; // the last bin may be short
        return left > 0 ? sum / Math.min(run.messages.bin_s, left) : null;
      }),
      colour: (runs.length === 1 ? k : r) % 8,
      dash: dashOf(r, false),
    }));
  });
}

function messageLines(runs: RunData[]): Line[] {
  return runs.flatMap((run, r) =>
    (["sent", "lost"] as const).map((kind, k) => ({
      name: runs.length === 1 ? kind : `${run.label}: ${kind}`,
      x: run.messages.sent.map((_, i) => (i + 0.5) * run.messages.bin_s),
      y: run.messages[kind].map((count, i) => {
        const left = run.duration_s - i * run.messages.bin_s; // the last bin may be short
        return left > 0 ? (count * 60) / Math.min(run.messages.bin_s, left) : null;
      }),
      colour: (runs.length === 1 ? k : r) % 8,
      dash: dashOf(r, k > 0),
    })),
  );
}

function areaLines(runs: RunData[]): Line[] {
  return runs.flatMap((run, r) => {
    const truth = run.metrics.columns.truth_area_m2,
      error = run.metrics.columns.area_error_m2;
    if (!truth || !error) return [];
    const x = floats(run.metrics.time_s),
      real = floats(truth),
      more = floats(error);
    const name = (text: string) => (runs.length === 1 ? text : `${run.label}: ${text}`);
    return [
      { name: name("true"), x, y: Array.from(real, (v) => v / 1e4), colour: (runs.length === 1 ? 1 : r) % 8 },
      { name: name("believed"), x, y: Array.from(real, (v, i) => (v + more[i]) / 1e4), colour: (runs.length === 1 ? 0 : r) % 8, dash: dashOf(r, true) },
    ];
  });
}

/** One chart for each figure of missions that changes over time. */
function missionCharts(runs: RunData[]): Omit<ChartOptions, "sync" | "marks" | "onPick">[] {
  const byText = new Map<string, Line[]>();
  runs.forEach((run, r) =>
    run.missions.series.forEach(({ name, text, time_s, values }) => {
      const y = floats(values);
      if (!text || y.every((v) => v === y[0])) return;
      const all = byText.get(text) ?? [];
      byText.set(text, all);
      all.push({
        name: runs.length === 1 ? name : `${run.label}: ${name}`,
        x: floats(time_s),
        y: Array.from(y),
        colour: (runs.length === 1 ? all.length : r) % 8,
        dash: dashOf(r, false),
      });
    }),
  );
  return Array.from(byText, ([text, lines]) => {
    const unit = /\[(.*)\]$/.exec(text)?.[1];
    const title = text.charAt(0).toUpperCase() + text.slice(1).replace(/ \[.*\]$/, "");
    return { title, unit, lines, range: unit || title.startsWith("Objects") ? undefined : ([0, 1.02] as [number, number]) };
  });
}

function plots(runs: RunData[], onPick: (time: number) => void): Chart[] {
  const marks = runs.length === 1 && runs[0].allocation_start_s != null ? [{ x: runs[0].allocation_start_s, label: "allocation starts" }] : [];
  const make = (options: Omit<ChartOptions, "sync" | "marks" | "onPick">) =>
    options.lines.length === 0
      ? []
      : chart({ ...options, logY: options.logY || (options.unit === "m" && needsLog(options.lines, runs)), marks, sync: "time", onPick });
  return [
    make({ title: "Perf", unit: "m", note: "error and stated deviation together; small is good", lines: lines(runs, [["perf_m", "Perf"]]) }),
    make({
      title: "Error and stated deviation",
      unit: "m",
      note: "alike when the estimator knows how good it is",
      lines: lines(runs, [
        ["rmse_m", "RMS error"],
        ["sigma_m", "sigma"],
      ]),
    }),
    make({
      title: "Distance between the boundaries",
      unit: "m",
      note: "in both directions",
      lines: lines(runs, [
        ["boundary_rms_m", "RMS"],
        ["boundary_hausdorff_m", "largest"],
      ]),
    }),
    make({ title: "Intersection over union", note: "of the true and the believed area", range: [null, 1], lines: lines(runs, [["iou", "IoU"]]) }),
    make({
      title: "Coverage of the 95 % band",
      note: "share of believed points whose band holds the truth",
      range: [null, 1.02],
      levels: [{ y: 0.95, label: "95 %" }],
      lines: lines(runs, [["coverage_95", "coverage"]]),
    }),
    make({
      title: "NEES",
      note: "squared error over stated variance; consistent within 0.5 to 2",
      logY: true,
      band: [0.5, 2],
      lines: lines(runs, [["nees", "NEES"]]),
    }),
    make({ title: "CRPS", unit: "m", note: "score of the whole distribution; small is good", lines: lines(runs, [["crps_m", "CRPS"]]) }),
    make({
      title: "Age of knowledge",
      unit: "s",
      note: "since the boundary was last crossed nearby",
      lines: lines(runs, [
        ["latency_mean_s", "mean"],
        ["latency_max_s", "oldest"],
      ]),
    }),
    make({ title: "Burnt area", unit: "ha", lines: areaLines(runs) }),
    ...missionCharts(runs).map(make),
    ...(runs.length === 1 ? flightCharts(runs[0]).map(make) : []),
    make({ title: "Messages per minute", note: "one to everyone counts once for each receiver", lines: messageLines(runs) }),
    make({ title: "Bytes sent", unit: "B/s", note: "of all together, in the wire form; what goes to everyone counts once", lines: byteLines(runs) }),
    make({ title: "Load of the air", note: "share of the time in which radios sent or heard others", range: [0, 1.02], lines: loadLines(runs) }),
  ].flat();
}

/** Who is real and sees what; nothing where everybody is purely simulated. */
function realityTable(run: RunData): HTMLElement | null {
  const aircraft = run.entities.filter((entity) => entity.interaction !== "none");
  if (aircraft.every((entity) => entity.class === "pure-simulated")) return null;
  const columns = ["Aircraft", "Class", "Its body is", "It perceives", "It may update"];
  return h(
    "div",
    { class: "scroll" },
    h(
      "table",
      { class: "events" },
      h("caption", {}, "Physical and virtual"),
      h("thead", {}, h("tr", {}, ...columns.map((t) => h("th", { scope: "col" }, t)))),
      h(
        "tbody",
        {},
        ...aircraft.map((entity) =>
          h("tr", {}, ...[entity.name, entity.class, entity.presence, entity.interaction, entity.updates].map((text) => h("td", {}, text))),
        ),
      ),
    ),
  );
}

function eventList(runs: RunData[]): HTMLElement | null {
  const tables = runs
    .filter((run) => run.events.length > 0)
    .map((run) => {
      const names = new Map(run.entities.map((entity) => [entity.entity_id, entity.name]));
      return h(
        "details",
        { open: runs.length === 1 && run.events.length <= 15 },
        h("summary", {}, `${run.label}: ${run.events.length + run.events_left_out} events`),
        h(
          "div",
          { class: "scroll" },
          h(
            "table",
            { class: "events" },
            h("thead", {}, h("tr", {}, ...["Time", "Who", "Kind", "What"].map((t) => h("th", { scope: "col" }, t)))),
            h(
              "tbody",
              {},
              ...run.events.map((event) =>
                h(
                  "tr",
                  { class: `of-${eventKind(event.kind).severity}`, title: eventKind(event.kind).meaning },
                  h("td", {}, clock(event.time_s)),
                  h("td", {}, names.get(event.entity_id) ?? String(event.entity_id)),
                  h("td", {}, event.kind),
                  h("td", {}, event.text),
                ),
              ),
            ),
          ),
        ),
        run.events_left_out > 0 ? h("p", { class: "hint" }, `${run.events_left_out} more are in the run's database.`) : null,
      );
    });
  return tables.length > 0 ? section("Events", "events", ...tables) : null;
}

/** The map, or what is said where there is none. */
async function mapOf(runs: RunData[]): Promise<{ panel: MapPanel | null; element: HTMLElement }> {
  try {
    const panel = await MapPanel.make(runs);
    return { panel, element: panel?.element ?? h("p", { class: "empty" }, "The records hold no positions and no perimeters.") };
  } catch (problem) {
    return { panel: null, element: noMap(problem) }; // the rest of the page is good without
  }
}

export async function runsPage(title: string, runs: RunData[]): Promise<HTMLElement[]> {
  const { panel, element: map } = await mapOf(runs);
  const charts = plots(runs, (time) => panel?.seek(time));
  const pilot = panel && runs.length === 1 ? pilotPanel(panel.first.view.world, panel.first.alerts) : null;
  if (panel) {
    panel.onTime = (time) => {
      charts.forEach((c) => c.showTime(time));
      pilot?.showTime(time);
    };
    panel.start();
  }
  const scenarios = runs
    .filter((run) => run.scenario)
    .map((run) => h("details", {}, h("summary", {}, `${run.label}: scenario as run`), h("pre", {}, run.scenario)));
  const several = runs.length > 1;
  const meaning = h("p", { class: "hint" }, "Means are over the allocation phase, from the moment the aircraft have found the fire.");
  const overview = several
    ? section(
        "Comparison",
        "overview",
        h(
          "p",
          {},
          `${runs.length} runs; ` +
            (sameFire(runs) ? "the best value of each row is marked." : "their fires differ (environment or seed), so no value is marked as the best."),
        ),
        ...comparisonTables(runs),
        missionTable(runs),
        meaning,
        ...runs.map((run) => h("details", {}, h("summary", {}, `What ${run.label} was`), identity(run))),
      )
    : section(
        "Overview",
        "overview",
        tiles(runs[0]),
        hasMetrics(runs[0]) ? h("div", { class: "side-by-side" }, h("div", {}, figuresTable(runs[0]), meaning), identity(runs[0])) : identity(runs[0]),
        missionTable(runs),
        realityTable(runs[0]),
      );
  return [
    h("header", {}, h("h1", {}, title)),
    overview,
    section("Map", "map", map),
    ...(pilot ? [section("Pilot's display", "pilot", pilot.element)] : []),
    section(
      "Over time",
      "plots",
      h("p", { class: "hint" }, "Drag across a plot to zoom, double-click to see all; a click moves the map to that time."),
      h("div", { class: "charts" }, ...charts.map((c) => c.element)),
    ),
    ...(several || !runs[0].radio ? [] : [section("Radios", "radios", ...radioPanel(runs[0]))]),
    ...[eventList(runs), scenarios.length > 0 ? section("Scenario", "scenario", ...scenarios) : null].filter((part): part is HTMLElement => part !== null),
  ];
}
