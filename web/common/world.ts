// SPDX-License-Identifier: Apache-2.0
/** All that is known of the run, built from the items of the feed. */
import type {
  AirTraffic,
  Alert,
  Arrival,
  Conflict,
  Crossing,
  Entity,
  Event,
  Footprint,
  Forecast,
  GroundObject,
  ObjectBelief,
  ObjectMotion,
  Perimeter,
  Planner,
  RadioLink,
  Reading,
  RecommendationChange,
  TeamAllocation,
  TeamLead,
  TeamTaskChange,
  TrafficMotion,
  TrafficTrack,
  ZoneRecord,
  Detection,
} from "./records";
import { Fleet, PlayTime, type ShownTime } from "./fleet";
import type { Frame } from "./frames";
import { taskKind } from "./protocol";
import type { Clients, CommandReply, FlightPath, MetricSample, MissionState, OrderMessage, RunClock, TaskOrder, TaskPreview, TaskReason } from "./protocol";
import type { Decoder, Table } from "./wire";

/** What may change; panels compare the counts with those that they have shown. */
export type Topic =
  | "clock"
  | "entities"
  | "fire"
  | "forecast"
  | "arrival"
  | "zones"
  | "missions"
  | "events"
  | "metrics"
  | "links"
  | "clients"
  | "tasks"
  | "objects"
  | "traffic"
  | "alerts"
  | "allocations"
  | "planners"
  | "snapshot"
  | "tracks"
  | "paths";

const kEventsKept = 5000,
  kReadingsKept = 1500,
  kCrossingsKept = 600,
  kMetricsKept = 8000;

/** A metric of a mission over time. */
export interface Series {
  time: number[];
  value: (number | null)[];
}

/** A link in one direction. */
export interface Link {
  from: number;
  to: number;
  last: RadioLink;
  /** Share that arrived, smoothed over the last reports; null: nothing was sent yet. */
  quality: number | null;
}

/** A path that is recommended to the pilot of an aircraft. */
export type Recommended = RecommendationChange;

/** What of an event is for people, whatever it is an event of. */
type Said = Pick<Event, "time_s" | "entity_id" | "kind" | "text">;

export interface KeptEvent extends Said {
  number: number;
  sender: string; // of a command; else empty
}

/** A command in a few words: its kind and the words among its fields. */
function commandText(command: Record<string, unknown>): string {
  const what = command.what as { kind?: string; task_kind?: string } | undefined;
  const words = ["action", "aircraft", "name", "mission", "part", "to", "factor", "steps", "number"].map((key) => command[key]);
  return [command.kind, ...words, what && taskKind(what)].filter((word) => (typeof word === "string" ? word !== "" : typeof word === "number")).join(" ");
}

export class World {
  readonly fleet: Fleet;
  readonly truth: Fleet;
  clock: RunClock = { time_s: 0, duration_s: 0, speed: 0, wanted_speed: 1, paused: false, over: false, misses: 0, headline: "" };
  clients: Clients = { clients: [], holder: 0, you: 0 };
  /** False while the first full state is on its way. */
  complete = false;
  readonly entities = new Map<number, Entity>();
  readonly events: KeptEvent[] = [];
  readonly perimeters = new Map<string, Perimeter>(); // by mission
  readonly forecasts = new Map<string, Map<number, Forecast>>(); // by mission, then by time
  readonly arrivals = new Map<string, Arrival>();
  readonly crossings: Crossing[] = [];
  readonly readings: Reading[] = [];
  readonly zones = new Map<string, ZoneRecord>();
  readonly objects = new Map<number, GroundObject>();
  readonly objectMotions = new Map<number, ObjectMotion>();
  readonly objectBeliefs = new Map<number, ObjectBelief>();
  readonly detections: Detection[] = [];
  readonly found = new Set<number>(); // objects that a camera has seen
  readonly recommendations = new Map<number, Recommended>(); // by aircraft, while they stand
  readonly missions = new Map<string, MissionState>();
  readonly metrics = new Map<string, Map<string, Series>>(); // by mission and name
  readonly tasks = new Map<number, TaskOrder>();
  readonly paths = new Map<number, FlightPath>(); // how aircraft expect to fly
  readonly reasons = new Map<number, TaskReason>(); // why they have their tasks
  readonly planners = new Map<number, Planner>();
  readonly flown = new Map<number, string>(); // the kind of task that is flown, whoever gave it
  readonly footprints = new Map<number, Footprint>();
  readonly allocations = new Map<string, TeamAllocation>();
  readonly leads = new Map<number, TeamLead>();
  /** Of each station's team, by station and number. */
  readonly teamTasks = new Map<string, TeamTaskChange>();
  readonly alerts = new Map<string, Alert>();
  readonly links = new Map<string, Link>();
  readonly traffic = new Map<number, AirTraffic>();
  readonly trafficMotions = new Map<number, TrafficMotion>();
  readonly trafficTracks = new Map<string, TrafficTrack>();
  readonly conflicts: Conflict[] = [];
  readonly version: Record<Topic, number> = {} as Record<Topic, number>;
  onReply: (reply: CommandReply) => void = () => undefined;
  onPreview: (preview: TaskPreview) => void = () => undefined;
  private readonly ids = new Map<string, number>();
  private eventNumber = 0;

  readonly play: ShownTime;
  private readonly follower: PlayTime | null; // of a run that goes on elsewhere
  /** Between frames, and tracks of others, that follow each other, where they were thinned [s]. */
  readonly gap: number;

  /** @param recorded  of a recording: its clock is exact */
  constructor(
    readonly frame: Frame,
    decoder: Decoder,
    table: Table,
    private readonly recorded?: { play: ShownTime; gap: number },
  ) {
    this.follower = recorded ? null : new PlayTime();
    this.play = recorded?.play ?? this.follower!;
    this.gap = recorded?.gap ?? 0;
    for (const topic of [
      "clock",
      "entities",
      "fire",
      "forecast",
      "arrival",
      "zones",
      "missions",
      "events",
      "metrics",
      "links",
      "clients",
      "tasks",
      "objects",
      "traffic",
      "alerts",
      "allocations",
      "planners",
      "snapshot",
      "tracks",
      "paths",
    ] as Topic[])
      this.version[topic] = 0;
    this.fleet = new Fleet(decoder, "fleet_frame", "FleetFrame", table, frame);
    this.truth = new Fleet(decoder, "truth_frame", "TruthFrame", table, frame, false);
    for (const each of [this.fleet, this.truth]) each.gap = Math.max(each.gap, 2.5 * this.gap);
    this.fleet.onFrame = (time) => this.follower?.frame(time, performance.now() / 1000);
  }

  name(id: number): string {
    return this.entities.get(id)?.name ?? String(id);
  }
  id(name: string): number | undefined {
    return this.ids.get(name);
  }
  /** The newest of which something is known. */
  get time(): number {
    return this.recorded ? this.clock.time_s : Math.max(this.clock.time_s, this.fleet.time);
  }

  /** The zones that are in force at a time. */
  zonesAt(time: number): ZoneRecord[] {
    return [...this.zones.values()].filter(({ from_s, until_s }) => (from_s ?? -Infinity) <= time && time < (until_s ?? Infinity));
  }

  private clear(): void {
    this.fleet.clear();
    this.truth.clear();
    for (const map of [
      this.entities,
      this.perimeters,
      this.forecasts,
      this.arrivals,
      this.zones,
      this.objects,
      this.objectMotions,
      this.objectBeliefs,
      this.missions,
      this.metrics,
      this.tasks,
      this.paths,
      this.reasons,
      this.planners,
      this.flown,
      this.footprints,
      this.allocations,
      this.leads,
      this.teamTasks,
      this.alerts,
      this.recommendations,
      this.links,
      this.traffic,
      this.trafficMotions,
      this.trafficTracks,
      this.ids,
    ])
      (map as Map<unknown, unknown>).clear();
    this.found.clear();
    for (const list of [this.events, this.crossings, this.readings, this.detections, this.conflicts]) list.length = 0;
    for (const topic of Object.keys(this.version) as Topic[]) this.version[topic]++;
  }

  private touch(topic: Topic): void {
    this.version[topic]++;
  }

  /** Takes one item in. */
  take(kind: string, value: unknown): void {
    this.takers[kind]?.(value as never);
  }

  private readonly takers: Record<string, (value: never) => void> = {
    run_clock: (clock: RunClock) => {
      this.clock = clock;
      if (this.follower) this.follower.paused = clock.paused;
      this.touch("clock");
    },
    snapshot: ({ begins }: { begins: boolean }) => {
      if (begins) this.clear();
      this.complete = !begins;
      this.touch("snapshot");
    },
    clients: (clients: Clients) => {
      this.clients = clients;
      this.touch("clients");
    },
    command_reply: (reply: CommandReply) => this.onReply(reply),
    task_preview: (preview: TaskPreview) => this.onPreview(preview),
    metric_sample: (sample: MetricSample) => this.addMetric(sample),
    message: (message: OrderMessage) => {
      const { task_number, what } = message.content;
      if (!what) return;
      const order: TaskOrder = { time_s: message.arrived_s, entity_id: message.to_id, number: task_number, what };
      this.tasks.set(order.entity_id, order);
      this.touch("tasks");
    },
    entity: (entity: Entity) => {
      this.entities.set(entity.entity_id, entity);
      this.ids.set(entity.name, entity.entity_id);
      this.touch("entities");
    },
    event: (event: Event) => this.addEvent(event, ""),
    command: (command: { time_s: number; sender: string; kind: string }) =>
      this.addEvent({ time_s: command.time_s, entity_id: -1, kind: "command", text: commandText(command as never) }, command.sender),
    crossing: (crossing: Crossing) => this.keep(this.crossings, crossing, kCrossingsKept, "tracks"),
    reading: (reading: Reading) => this.keep(this.readings, reading, kReadingsKept, "tracks"),
    detection: (detection: Detection) => {
      this.found.add(detection.object_id);
      this.keep(this.detections, detection, kCrossingsKept, "objects");
    },
    perimeter: (perimeter: Perimeter) => {
      this.perimeters.set(perimeter.mission, perimeter);
      this.touch("fire");
    },
    forecast: (forecast: Forecast) => this.addForecast(forecast),
    arrival: (arrival: Arrival) => {
      this.arrivals.set(arrival.place, arrival);
      this.touch("arrival");
    },
    zone: (zone: ZoneRecord) => {
      if (zone.in_force) this.zones.set(zone.name, zone);
      else this.zones.delete(zone.name);
      this.touch("zones");
    },
    object: (object: GroundObject) => {
      this.objects.set(object.object_id, object);
      this.touch("objects");
    },
    object_motion: (motion: ObjectMotion) => {
      this.objectMotions.set(motion.object_id, motion);
      this.touch("objects");
    },
    object_belief: (belief: ObjectBelief) => {
      this.objectBeliefs.set(belief.object_id, belief);
      this.touch("objects");
    },
    mission: (mission: MissionState) => {
      this.missions.set(mission.mission, mission);
      this.touch("missions");
    },
    team_lead: (lead: TeamLead) => {
      this.leads.set(lead.entity_id, lead);
      this.touch("allocations");
    },
    team_allocation: (each: TeamAllocation) => {
      this.allocations.set(`${each.team} ${each.proposer_id} ${each.number}`, each);
      this.touch("allocations");
    },
    team_task_change: (task: TeamTaskChange) => {
      this.teamTasks.set(`${task.entity_id} ${task.number}`, task);
      this.touch("allocations");
    },
    alert: (alert: Alert) => {
      const key = `${alert.entity_id} ${alert.track}`;
      if (alert.level > 0) this.alerts.set(key, alert);
      else this.alerts.delete(key);
      this.touch("alerts");
    },
    recommendation_change: (change: RecommendationChange) => {
      const known = this.recommendations.get(change.entity_id);
      // Where it leads is said once, when it is shown.
      const path = change.path.length > 0 ? change.path : known?.number === change.number ? known.path : [];
      if (change.state === "over") this.recommendations.delete(change.entity_id);
      else this.recommendations.set(change.entity_id, { ...change, path });
      this.touch("alerts");
    },
    radio_link: (link: RadioLink) => this.addLink(link),
    conflict: (conflict: Conflict) => this.keep(this.conflicts, conflict, 500, "alerts"),
    traffic: (traffic: AirTraffic) => {
      this.traffic.set(traffic.traffic_id, traffic);
      this.touch("traffic");
    },
    traffic_motion: (motion: TrafficMotion) => {
      this.trafficMotions.set(motion.traffic_id, motion);
      this.touch("traffic");
    },
    traffic_track: (track: TrafficTrack) => {
      this.trafficTracks.set(`${track.believer_id} ${track.track}`, track);
      this.touch("traffic");
    },
    flight_path: (path: FlightPath) => {
      this.paths.set(path.entity_id, path);
      this.touch("paths");
    },
    task_reason: (reason: TaskReason) => {
      this.reasons.set(reason.aircraft_id, reason);
      this.touch("tasks");
    },
    planner: (planner: Planner) => {
      this.planners.set(planner.entity_id, planner);
      if (planner.link === "task") this.flown.set(planner.entity_id, planner.reason);
      this.touch("planners");
    },
    footprint: (footprint: Footprint) => {
      this.footprints.set(footprint.entity_id, footprint);
      this.touch("tracks");
    },
  };

  private keep<T>(list: T[], value: T, most: number, topic: Topic): void {
    list.push(value);
    if (list.length > 1.25 * most) list.splice(0, list.length - most);
    this.touch(topic);
  }

  private addEvent(event: Said, sender: string): void {
    this.events.push({ ...event, number: ++this.eventNumber, sender });
    if (this.events.length > kEventsKept) this.events.splice(0, this.events.length - kEventsKept);
    this.touch("events");
  }

  /** To whom an event happened, or who gave a command. */
  whose(event: KeptEvent): string {
    return event.sender || this.name(event.entity_id);
  }

  private addMetric(sample: MetricSample): void {
    let mission = this.metrics.get(sample.mission);
    if (!mission) this.metrics.set(sample.mission, (mission = new Map()));
    for (const { name, value } of sample.values) {
      let series = mission.get(name);
      if (!series) mission.set(name, (series = { time: [], value: [] }));
      if (series.time.length > 0 && sample.time_s <= series.time[series.time.length - 1]) continue;
      series.time.push(sample.time_s);
      series.value.push(value);
      if (series.time.length > kMetricsKept) {
        // Every second of the older half goes: the whole run stays in the picture.
        const half = kMetricsKept / 2,
          keepEach = (_: unknown, i: number) => i >= half || i % 2 === 0;
        series.time = series.time.filter(keepEach);
        series.value = series.value.filter(keepEach);
      }
    }
    this.touch("metrics");
  }

  private addForecast(forecast: Forecast): void {
    let all = this.forecasts.get(forecast.mission);
    const first = all?.values().next().value;
    if (!all || (first && first.made_s !== forecast.made_s)) this.forecasts.set(forecast.mission, (all = new Map()));
    all.set(forecast.boundary_time_s, forecast);
    this.touch("forecast");
  }

  private addLink(record: RadioLink): void {
    const key = `${record.from_id} ${record.to_id}`,
      all = record.arrived + record.lost;
    const now = all > 0 ? record.arrived / all : null,
      known = this.links.get(key);
    if (known) {
      known.last = record;
      if (now !== null) known.quality = known.quality === null ? now : known.quality + 0.3 * (now - known.quality);
    } else {
      this.links.set(key, { from: record.from_id, to: record.to_id, last: record, quality: now });
    }
    this.touch("links");
  }
}
