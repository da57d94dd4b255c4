/** The map of a run, or of one of several: all that the operator's page shows of a recorded one. */
import { contextMenu } from "../live/context_menu";
import { listenToKeys } from "../live/keys";
import { mapControls, mapFoot } from "../live/map/controls";
import { Player } from "../live/player";
import { RecordedView, type RecordedRun } from "../live/recorded_view";
import { T } from "../live/texts";
import { Timeline } from "../live/timeline";
import { dimensionButton, settingsMenu, timeControls } from "../live/top_bar";
import { alertStrip, type AlertStrip } from "./alert_strip";
import { Alerts } from "./alerts";
import { floats, type RunData } from "./data";
import { h, number } from "./dom";
import { printedMaps } from "./printed_maps";
import { unpacked } from "./unpack";

const kMany = 20; // from so many aircraft on, tracks of late are short at first
const kShortTail = 15; // [s]

/** A run that can be shown, with its figures over time. */
interface Shown {
  run: RunData;
  recorded: RecordedRun;
  alerts: Alerts;
  metricTimes: Float32Array;
  metrics: Record<string, Float32Array>;
}

async function unpack(run: RunData): Promise<Shown | null> {
  if (!run.map) return null;
  const { run: description, step_s, ...packed } = run.map;
  const [terrain, records, frames] = await Promise.all([packed.terrain, packed.records, packed.frames].map(unpacked));
  return {
    run, recorded: { run: description, step_s, terrain, records, frames }, alerts: new Alerts(run.alerting),
    metricTimes: floats(run.metrics.time_s),
    metrics: Object.fromEntries(Object.entries(run.metrics.columns).map(([name, column]) => [name, floats(column)])),
  };
}

/** Key figures at a time, as one line of text. */
function figuresAt({ metricTimes, metrics }: Shown, time: number): string {
  let i = metricTimes.length - 1;
  while (i > 0 && metricTimes[i] > time + 1e-3) --i;
  if (i < 0 || metricTimes[i] > time + 1e-3) return "";
  const part = (label: string, column: string, unit: string) => {
    const value = metrics[column]?.[i];
    return value != null && Number.isFinite(value) ? [`${label} ${number(value)}${unit}`] : [];
  };
  return [...part("Perf", "perf_m", " m"), ...part("boundary RMS", "boundary_rms_m", " m"),
    ...part("IoU", "iou", ""), ...part("coverage", "coverage_95", "")].join(" · ");
}

export class MapPanel {
  readonly element = h("div", { class: "run-map" });
  readonly player: Player;
  /** Called whenever another time is shown, or another run. */
  onTime: (time: number) => void = () => undefined;
  private readonly status = h("p", { class: "status" });
  private readonly holder = h("div", { class: "map-frame" });
  private shown: Shown;
  private current!: RecordedView;
  private strip: AlertStrip | null = null;

  /** Makes the panel of the runs that have a map; null when none has. */
  static async make(runs: RunData[]): Promise<MapPanel | null> {
    const shown = (await Promise.all(runs.map(unpack))).filter((each): each is Shown => each !== null);
    return shown.length > 0 ? new MapPanel(shown) : null;
  }

  private constructor(private readonly all: Shown[]) {
    this.shown = all[0];
    this.player = new Player(Math.max(...all.map(({ run }) => run.duration_s)));
    this.player.time = this.player.end; // the first look is at the result; playing starts at the beginning
    this.element.append(...[this.runChoice(), this.holder, this.status].filter((part): part is HTMLElement => part !== null));
    this.show(this.shown);
    this.player.listeners.push(() => this.tell());
    listenToKeys({
      " ": () => this.current.pause(this.player.playing), ".": () => this.current.step(1), ",": () => this.current.step(-1),
      "0": () => this.current.map.fit(), d: () => this.current.map.set3d(!this.current.map.is3d),
      n: () => this.current.map.map.easeTo({ bearing: 0 }), m: () => this.current.tools.measure(),
      Escape: () => this.current.map.select([]),
    }, (event) => this.current.tools.key(event), this.holder);
    printedMaps(this.element, this.player, () => this.current.map, (time) => figuresAt(this.shown, time));
  }

  /** The run that is shown. */
  get view(): RecordedView {
    return this.current;
  }
  get run(): RunData {
    return this.shown.run;
  }
  get alerts(): Alerts {
    return this.shown.alerts;
  }

  private runChoice(): HTMLElement | null {
    if (this.all.length < 2) return null;
    return h("fieldset", { class: "runs" }, h("legend", {}, "Run on the map"),
      ...this.all.map((each, i) => h("label", {},
        h("input", { type: "radio", name: "map-run", checked: i === 0, onchange: () => this.change(each) }), ` ${each.run.label}`)));
  }

  // Another run is looked at from where the one before was.
  private change(shown: Shown): void {
    const { map } = this.current.map, camera = { center: map.getCenter(), zoom: map.getZoom(), bearing: map.getBearing() };
    const from = this.shown.recorded.run.origin, to = shown.recorded.run.origin;
    this.current.remove();
    this.show(shown);
    if (from?.latitude_deg === to?.latitude_deg && from?.longitude_deg === to?.longitude_deg) this.current.map.map.jumpTo(camera);
    this.tell();
  }

  private show(shown: Shown): void {
    this.shown = shown;
    const view = new RecordedView(shown.recorded, this.player), { map, tools } = view;
    this.current = view;
    if (view.world.fleet.count > kMany) view.settings.tail = kShortTail;
    map.applyLayers();
    const stage = h("div", { class: "stage" }, map.element, mapControls(view).element, mapFoot(view), tools.hint);
    contextMenu(view, stage);
    const bar = h("div", { class: "map-bar" }, timeControls(view),
      h("div", { class: "right" }, dimensionButton(view, () => map.set3d(!map.is3d)), settingsMenu(view)));
    this.strip = alertStrip(shown.run, shown.alerts, this.player.end, (time) => this.seek(time));
    this.holder.replaceChildren(bar, stage, new Timeline(view).element);
    if (this.strip) this.holder.append(this.strip.element);
  }

  /** Stands still at a time. */
  seek(time: number): void {
    this.player.pause();
    this.player.seek(time);
  }

  private tell(): void {
    const { time } = this.player;
    this.status.textContent = figuresAt(this.shown, time);
    this.strip?.showTime(time);
    this.onTime(time);
  }

  /** Shows the time where the player is, everywhere: once, when all is put together. */
  start(): void {
    this.tell();
  }
}

/** What stands in place of the map of a browser that cannot draw it. */
export const noMap = (problem: unknown): HTMLElement =>
  h("p", { class: "failure", role: "status" }, problem instanceof Error && problem.message ? problem.message : T.map.noWebgl);
