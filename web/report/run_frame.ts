// SPDX-License-Identifier: Apache-2.0
/** A run of a report on its map: all that the operator's page shows of a recorded one. */
import { contextMenu } from "../common/context_menu";
import { listenToKeys } from "../common/keys";
import { mapControls, mapFoot } from "../common/map/controls";
import type { Player } from "../common/player";
import { RecordedView, type RecordedRun } from "../common/recorded_view";
import { Timeline } from "../common/timeline";
import { dimensionButton, settingsMenu } from "../common/page_controls";
import { alertStrip, type AlertStrip } from "./alert_strip";
import { Alerts } from "./alerts";
import { floats, type RunData } from "./data";
import { h, number } from "../common/dom";
import { unpacked } from "./unpack";

const kMany = 20; // from so many aircraft on, recent tracks are short at first
const kShortTail = 15; // [s]

/** A run that can be shown, with its figures over time. */
export interface ShownRun {
  run: RunData;
  recorded: RecordedRun;
  alerts: Alerts;
  metricTimes: Float32Array;
  metrics: Record<string, Float32Array>;
}

/** Null where the run has no map. */
export async function unpack(run: RunData): Promise<ShownRun | null> {
  if (!run.map) return null;
  const { run: description, step_s, ...packed } = run.map;
  const [terrain, records, frames] = await Promise.all([packed.terrain, packed.records, packed.frames].map(unpacked));
  return {
    run,
    recorded: { run: description, step_s, terrain, records, frames },
    alerts: new Alerts(run.alerting),
    metricTimes: floats(run.metrics.time_s),
    metrics: Object.fromEntries(Object.entries(run.metrics.columns).map(([name, column]) => [name, floats(column)])),
  };
}

/** Key figures at a time, as one line of text. */
function figuresAt({ metricTimes, metrics }: ShownRun, time: number): string {
  let i = metricTimes.length - 1;
  while (i >= 0 && metricTimes[i] > time + 1e-3) --i;
  const part = (label: string, column: string, unit: string) => {
    const value = i < 0 ? null : metrics[column]?.[i];
    return value != null && Number.isFinite(value) ? [`${label} ${number(value)}${unit}`] : [];
  };
  return [
    ...part("Perf", "perf_m", " m"),
    ...part("boundary RMS", "boundary_rms_m", " m"),
    ...part("IoU", "iou", ""),
    ...part("coverage", "coverage_95", ""),
  ].join(" · ");
}

/** What a frame does not decide alone. */
export interface FrameOptions {
  /** What stands in the bar above the map. */
  bar: (frame: RunFrame) => HTMLElement;
  /** It stands beside others: what moves through the time is elsewhere. */
  isOneOfSeveral: boolean;
  /** Turns the map into three dimensions and back. */
  dimension: () => void;
}

export class RunFrame {
  readonly element = h("div", { class: "map-frame" });
  private readonly status = h("p", { class: "status" });
  private current!: RecordedView;
  private strip: AlertStrip | null = null;

  constructor(
    private shown: ShownRun,
    private readonly player: Player,
    private readonly options: FrameOptions,
  ) {
    this.show(shown);
    listenToKeys(
      {
        "0": () => this.current.map.fit(),
        d: () => options.dimension(),
        n: () => this.current.map.map.easeTo({ bearing: 0 }),
        m: () => this.current.tools.measure(),
        Escape: () => this.current.map.select([]),
      },
      (event) => this.current.tools.key(event),
      this.element,
    );
  }

  get view(): RecordedView {
    return this.current;
  }
  get run(): RunData {
    return this.shown.run;
  }
  get alerts(): Alerts {
    return this.shown.alerts;
  }
  /** Two runs of one place can be looked at from the same point. */
  isAt(other: RunFrame): boolean {
    const a = this.shown.recorded.run.origin,
      b = other.shown.recorded.run.origin;
    return a?.latitude_deg === b?.latitude_deg && a?.longitude_deg === b?.longitude_deg;
  }

  /** Shows another run. */
  change(shown: ShownRun): void {
    this.current.remove();
    this.show(shown);
  }

  private show(shown: ShownRun): void {
    this.shown = shown;
    const view = new RecordedView(shown.recorded, this.player),
      { map, tools } = view;
    this.current = view;
    if (view.world.fleet.count > kMany) view.settings.tail = kShortTail;
    map.applyLayers();
    const stage = h("div", { class: "stage" }, map.element, mapControls(view).element, mapFoot(view), tools.hint);
    contextMenu(view, stage);
    this.strip = alertStrip(shown.run, shown.alerts, this.player.end, (time) => this.player.stand(time));
    this.element.replaceChildren(
      h(
        "div",
        { class: "map-bar" },
        this.options.bar(this),
        h(
          "div",
          { class: "right" },
          dimensionButton(view, () => this.options.dimension()),
          settingsMenu(view),
        ),
      ),
      stage,
      new Timeline(view, this.options.isOneOfSeveral).element,
      ...(this.strip ? [this.strip.element] : []),
      ...(shown.metricTimes.length > 0 ? [this.status] : []),
    );
  }

  /** What is said of a time. */
  figures(time: number): string {
    return figuresAt(this.shown, time);
  }

  showTime(time: number): void {
    this.status.textContent = this.figures(time);
    this.strip?.showTime(time);
  }
}
