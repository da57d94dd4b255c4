// SPDX-License-Identifier: Apache-2.0
/** A run on a map, wherever what is known of it comes from: a server, or a recording in the page. */
import { kIcon, kMotion, kRadius, type Fleet } from "./fleet";
import type { Frame } from "./frames";
import { MapView } from "./map/map_view";
import type { Terrain } from "./map/terrain";
import { MapTools } from "./map/tools";
import { taskKind, type RunDescription } from "./protocol";
import { loadSettings, saveSettings, type Settings } from "./settings";
import { T } from "./texts";
import { Units } from "./units";
import type { KeptEvent, World } from "./world";

export abstract class RunView {
  readonly settings: Settings = loadSettings();
  readonly units = new Units(this.settings);
  readonly map: MapView;
  readonly tools: MapTools;
  /** Speeds to choose from, simulated over wall time; 0: as fast as it can. */
  abstract readonly speeds: readonly number[];
  /** Another time is there at once: a slider shows it while it is dragged. */
  abstract readonly seeksAtOnce: boolean;
  /** Called a few times a second for parts that show numbers. */
  private readonly tickers: ((wall: number) => void)[] = [];
  private readonly kinds = new Map<string, { hovers: boolean; radius: number }>();
  private readonly timer: number;

  constructor(
    readonly run: RunDescription,
    readonly terrain: Terrain | null,
    readonly world: World,
  ) {
    for (const { name, kind, hovers, safety_radius_m } of run.aircraft)
      this.kinds.set(name, { hovers: hovers ?? /copter|quad|hexa|rotor|multi/i.test(kind), radius: safety_radius_m ?? 0 });
    this.map = new MapView(run, this.world, terrain, this.settings);
    this.tools = new MapTools(this.units, this.map);
    this.map.labelText = (row) => this.label(row);
    for (const each of [world.fleet, world.truth]) each.onNew = (_, row) => this.dressRow(each, row);
    this.timer = window.setInterval(() => this.tick(), 250);
  }

  /** Takes the map off the page for good. */
  remove(): void {
    clearInterval(this.timer);
    this.map.remove();
  }

  // Who moves the time of what is shown.

  abstract readonly mayMoveTime: boolean;
  abstract pause(paused: boolean): void;
  abstract step(steps: number): void;
  abstract speed(factor: number): void;
  abstract seek(seconds: number): void;

  get frame(): Frame {
    return this.world.frame;
  }
  /** When the run is over, as far as that is known [s]. */
  get end(): number {
    return Math.max(this.run.duration_s || this.world.clock.duration_s, this.world.time, 1);
  }
  /** What has happened; in a recording, what will, too. */
  get events(): readonly KeptEvent[] {
    return this.world.events;
  }

  every(ticker: (wall: number) => void): void {
    this.tickers.push(ticker);
  }

  private tick(): void {
    this.dress();
    const wall = performance.now() / 1000;
    for (const ticker of this.tickers) ticker(wall);
  }

  saveSettings(): void {
    saveSettings(this.settings);
  }

  // Icons by kind and reality, safety zones: they follow from what is known of the entity.
  private dressed = -1;
  private dress(): void {
    const { fleet, truth, version } = this.world;
    if (this.dressed === version.entities) return;
    this.dressed = version.entities;
    for (const each of [fleet, truth]) {
      for (let row = 0; row < each.count; ++row) this.dressRow(each, row);
      each.version++;
    }
  }

  private dressRow(fleet: Fleet, row: number): void {
    const id = fleet.ids[row],
      kind = this.kinds.get(this.world.name(id)),
      reality = this.reality(id),
      at = row * kMotion;
    fleet.motion[at + kIcon] = (reality === "real" ? 8 : reality === "outside simulator" ? 4 : 0) + (kind?.hovers ? 1 : 0);
    fleet.motion[at + kRadius] = fleet === this.world.fleet ? (kind?.radius ?? 0) : 0;
  }

  /** Real: a body in the physical world; outside simulator: it perceives both worlds, its body is not real. */
  reality(id: number): "simulated" | "outside simulator" | "real" {
    const entity = this.world.entities.get(id);
    if (!entity) return "simulated";
    if (entity.presence === "physical" || entity.presence === "both") return "real";
    return entity.interaction === "both" || entity.updates === "both" || entity.updates === "physical" ? "outside simulator" : "simulated";
  }

  /** What an aircraft does, in a few words. */
  doing(row: number): string {
    const { fleet, tasks, flown } = this.world,
      failsafe = fleet.word(row, "failsafe"),
      reaction = fleet.word(row, "reaction");
    if (failsafe && failsafe !== "none") {
      const does = T.task.reactions[reaction];
      return `${T.task.failsafes[failsafe] ?? failsafe}${does ? `, ${does}` : ""}`;
    }
    const mode = fleet.word(row, "mode");
    if (mode === "manual" || mode === "stabilized") return mode;
    const id = fleet.ids[row],
      task = tasks.get(id);
    // Members of a team that leads itself have their tasks from there.
    if (!task) return T.task.verbs[flown.get(id) ?? ""] ?? T.task.none;
    return T.task.verbs[taskKind(task.what)] ?? taskKind(task.what);
  }

  private readonly text = { name: "", line: "", warned: false };
  private label(row: number) {
    this.text.name = this.world.name(this.world.fleet.ids[row]);
    const silence = this.silence(row);
    this.text.line = silence > 5 ? `${this.doing(row)}, ${T.fleet.age(this.units.seconds(silence))}` : this.doing(row);
    this.text.warned = this.world.fleet.get(row, "failsafe") > 0;
    return this.text;
  }

  /** Seconds since an aircraft was heard of. */
  silence(row: number): number {
    const { fleet } = this.world,
      heard = fleet.get(row, "heard_s"),
      age = fleet.get(row, "age_s") || 0;
    return Number.isFinite(heard) ? Math.max(age, fleet.time - heard) : age;
  }

  /** Shows who an event is about; a replay goes to its time. */
  jumpTo(event: KeptEvent): void {
    if (this.run.replay) this.seek(event.time_s);
    if (this.world.fleet.row(event.entity_id) < 0) return;
    this.map.select([event.entity_id]);
    this.map.centreOn(event.entity_id);
  }
}
