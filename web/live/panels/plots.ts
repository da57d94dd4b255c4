// SPDX-License-Identifier: Apache-2.0
/** Live plots: how well the missions do, and one aircraft over the last minutes. */
import { h, number } from "../../common/dom";
import { chart, type Chart, type Line } from "../../common/chart";
import type { App } from "../app";
import { T } from "../../common/texts";
import { option, setText } from "../../common/ui";
import type { Series } from "../../common/world";
import type { Panel } from "./panel";

const kEvery = 1; // [s]
const kKept = 1200; // samples of an aircraft
const kHigh = 150; // of a plot [px]

const kNone: Series = { time: [], value: [] };

/** What is kept of one aircraft while it is chosen. */
interface Flight {
  id: number;
  time: number[];
  altitude: number[];
  speed: number[];
  battery: number[];
  cross: number[];
}

export class PlotsPanel implements Panel {
  readonly element = h("div", { class: "panel plots-panel" });
  private readonly mission = h("select", { "aria-label": T.plots.mission, onchange: () => this.rebuild() });
  private readonly holder = h("div", { class: "plots" });
  private readonly flightTitle = h("h3", {}, T.plots.aircraft);
  private readonly flightHint = h("p", { class: "hint" }, T.plots.noAircraft);
  private readonly flightHolder = h("div", { class: "plots" });
  private readonly none = h("p", { class: "hint" }, T.plots.none);
  private charts: { chart: Chart; lines: () => Line[] }[] = [];
  private flightCharts: { chart: Chart; lines: () => Line[] }[] = [];
  private names = "";
  private shown = -1;
  private flightShown = -1;
  private last = 0;
  private flight: Flight | null = null;
  private sampled = 0;
  private missionsShown = "";

  constructor(private readonly app: App) {
    this.element.append(
      h("section", {}, h("div", { class: "bar" }, h("h3", {}, T.plots.mission), this.mission), this.none, this.holder),
      h("section", {}, this.flightTitle, this.flightHint, this.flightHolder),
    );
    app.every(() => this.sample());
  }

  private series(name: string): Series {
    return this.app.world.metrics.get(this.mission.value)?.get(name) ?? kNone;
  }

  private rebuild(): void {
    for (const { chart: each } of this.charts) each.remove();
    this.charts = [];
    this.names = "";
    this.update(performance.now() / 1000 + kEvery);
  }

  private add(list: typeof this.charts, holder: HTMLElement, title: string, unit: string, lines: () => Line[], range?: [number | null, number | null]): void {
    const made = chart({ title, unit, lines: lines(), height: kHigh, live: true, sync: "live", range });
    made.element.classList.toggle("single", lines().length === 1);
    const latest = h("span", { class: "latest" });
    made.element.querySelector("figcaption")?.append(latest);
    holder.append(made.element);
    list.push({
      chart: made,
      lines: () => {
        const now = lines();
        setText(latest, now.map(({ y }) => number(y[y.length - 1], 3)).join(" / "));
        return now;
      },
    });
  }

  private build(names: string[]): void {
    const line =
      (name: string, colour: number, label = name, dash: Line["dash"] = "solid") =>
      (): Line => ({ name: label, x: this.series(name).time, y: this.series(name).value, colour, dash });
    const taken = new Set<string>();
    const both = (a: string, b: string) => names.includes(a) && names.includes(b);
    if (names.includes("perf_m")) {
      const l = line("perf_m", 0, "Perf");
      this.add(this.charts, this.holder, T.plots.names.perf_m, "m", () => [l()]);
      taken.add("perf_m");
    }
    if (both("rmse_m", "sigma_m")) {
      const a = line("rmse_m", 1, T.plots.rmse),
        b = line("sigma_m", 0, T.plots.sigma, "dashed");
      this.add(this.charts, this.holder, T.plots.names.rmse_m, "m", () => [a(), b()]);
      taken.add("rmse_m").add("sigma_m");
    }
    for (const name of names) {
      if (taken.has(name)) continue;
      const unit = /_(m|ha|s|mps|deg)$/.exec(name)?.[1] ?? "",
        l = line(name, 2, T.plots.names[name] ?? name);
      const share = /iou|coverage|share/.test(name);
      this.add(this.charts, this.holder, T.plots.names[name] ?? name.replace(/_/g, " "), unit, () => [l()], share ? [0, 1] : undefined);
    }
  }

  // A few times a second, whether the panel is seen or not: a plot that is opened late has something to show.
  private sample(): void {
    const id = this.app.map.selected.values().next().value,
      { fleet } = this.app.world;
    if (id === undefined) {
      this.flight = null;
      return;
    }
    if (this.flight?.id !== id) this.flight = { id, time: [], altitude: [], speed: [], battery: [], cross: [] };
    const row = fleet.row(id),
      f = this.flight,
      last = f.time[f.time.length - 1] ?? -Infinity;
    if (row < 0 || fleet.time < last + 0.5) {
      if (fleet.time < last) this.flight = null;
      return;
    }
    f.time.push(fleet.time);
    f.altitude.push(fleet.get(row, "altitude_msl_m"));
    f.speed.push(Math.hypot(fleet.get(row, "velocity_north_mps"), fleet.get(row, "velocity_east_mps")));
    f.battery.push(100 * fleet.get(row, "charge"));
    f.cross.push(fleet.get(row, "cross_track_m"));
    if (f.time.length > kKept) for (const list of [f.time, f.altitude, f.speed, f.battery, f.cross]) list.splice(0, kKept / 4);
    ++this.sampled;
  }

  private buildFlight(): void {
    for (const { chart: each } of this.flightCharts) each.remove();
    this.flightCharts = [];
    const one = (title: string, unit: string, key: "altitude" | "speed" | "battery" | "cross", colour: number) =>
      this.add(this.flightCharts, this.flightHolder, title, unit, () => [{ name: title, x: this.flight?.time ?? [], y: this.flight?.[key] ?? [], colour }]);
    one(T.plots.altitude, "m", "altitude", 0);
    one(T.plots.speed, "m/s", "speed", 2);
    one(T.plots.battery, "%", "battery", 3);
    one(T.plots.cross, "m", "cross", 1);
  }

  update(wall: number): void {
    if (wall - this.last < kEvery) return;
    this.last = wall;
    const { world } = this.app;
    const missions = [...world.metrics.keys()],
      key = missions.join("|");
    if (key !== this.missionsShown) {
      this.missionsShown = key;
      const before = this.mission.value;
      this.mission.replaceChildren(...missions.map((name) => option(name, name, name === before)));
    }
    const names = [...(world.metrics.get(this.mission.value)?.keys() ?? [])],
      all = names.join("|");
    this.none.hidden = names.length > 0;
    if (all !== this.names) {
      for (const { chart: each } of this.charts) each.remove();
      this.charts = [];
      this.names = all;
      this.build(names);
      this.shown = -1;
    }
    if (this.shown !== world.version.metrics) {
      this.shown = world.version.metrics;
      for (const { chart: each, lines } of this.charts) each.update(lines());
    }
    this.flightHint.hidden = this.flight !== null;
    if (this.flight && this.flight.id !== this.flightShown) {
      this.flightShown = this.flight.id;
      this.buildFlight();
    } else if (!this.flight && this.flightCharts.length > 0) {
      for (const { chart: each } of this.flightCharts) each.remove();
      this.flightCharts = [];
      this.flightShown = -1;
    }
    if (this.flight) {
      setText(this.flightTitle, `${T.plots.aircraft}: ${world.name(this.flight.id)}`);
      for (const { chart: each, lines } of this.flightCharts) each.update(lines());
    }
  }
}
