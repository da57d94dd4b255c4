/** What is where at a time: unpacked tracks and perimeters of one run. */
import { Alerts } from "./alerts";
import { floats, octets, shorts, type Frame, type MapData, type RunData, type Terrain } from "./data";
import type { AirTraffic, GroundObject } from "./records";

/** A believed ring: places, outward directions and deviations, point by point. */
export interface Ring {
  north: Float32Array;
  east: Float32Array;
  normal?: Float32Array; // bearing [rad]
  sigma?: Float32Array; // [m]
}

export interface Track {
  name: string;
  start: number;
  step: number;
  north: Float32Array;
  east: Float32Array;
  heading: Uint8Array;
  entity: number;
  altitude: Float32Array; // [m]
}

export interface Pose {
  north: number;
  east: number;
  heading: number; // [rad]
  altitude: number; // above mean sea level [m]
}

/** A thing on the ground: time, north, east and velocity of each of its motions. */
export interface SceneObject extends GroundObject {
  motions: Float32Array;
}

/** Another aircraft, its motions likewise; the north of one that is not there is NaN. */
export interface SceneTraffic extends AirTraffic {
  motions: Float32Array;
}

/** Where a thing is; null before it is known. */
export function objectAt(object: { motions: Float32Array }, time: number): [number, number] | null {
  const m = object.motions;
  let low = -1; // the last motion that has begun
  let high = m.length / 5;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (m[5 * middle] <= time + 1e-3) low = middle;
    else high = middle;
  }
  if (low < 0) return null;
  const gone = time - m[5 * low];
  return [m[5 * low + 1] + gone * m[5 * low + 3], m[5 * low + 2] + gone * m[5 * low + 4]];
}

const kTurn = 2 * Math.PI;

/** Numbers of a believed track in Scene.trafficBeliefs. */
export const kBelief = 10;

/** Another aircraft as one of ours believes it at a time. */
export interface Believed {
  believer: number;
  track: number;
  north: number;
  east: number;
  altitude: number;
  velocity: [number, number, number]; // north, east, up [m/s]
  deviation: number; // [m]
}

export class Scene {
  readonly tracks: Track[];
  readonly crossings: { time: Float32Array; north: Float32Array; east: Float32Array };
  readonly objects: SceneObject[];
  readonly detections: { time: Float32Array; north: Float32Array; east: Float32Array; object: Uint16Array };
  readonly traffic: SceneTraffic[];
  readonly trafficBeliefs: Float32Array; // kBelief numbers of each, see data.ts
  readonly alerting: Alerts;
  readonly zones: MapData["zones"];
  readonly missions: MapData["missions"];
  readonly terrain?: Terrain;
  readonly duration: number;
  private readonly cache = new Map<Frame, Ring[]>();

  constructor(run: RunData, private readonly map: MapData) {
    const names = new Map(run.entities.map((entity) => [entity.entity_id, entity.name]));
    this.duration = run.duration_s;
    this.terrain = map.terrain;
    this.zones = map.zones;
    this.missions = map.missions;
    this.tracks = map.tracks.map((track) => ({
      name: names.get(track.entity) ?? `${track.entity}`,
      start: track.start_s,
      step: track.step_s,
      north: this.places(shorts(track.north), map.low_north_m),
      east: this.places(shorts(track.east), map.low_east_m),
      heading: octets(track.heading),
      entity: track.entity,
      altitude: Float32Array.from(shorts(track.altitude), (v) => -1000 + 0.25 * v),
    }));
    this.crossings = {
      time: floats(map.crossings.time_s),
      north: this.places(shorts(map.crossings.north), map.low_north_m),
      east: this.places(shorts(map.crossings.east), map.low_east_m),
    };
    this.objects = map.objects.map((object) => ({ ...object, motions: floats(object.motions) }));
    this.traffic = map.traffic.map((each) => ({ ...each, motions: floats(each.motions) }));
    this.trafficBeliefs = floats(map.traffic_beliefs);
    this.alerting = new Alerts(run.alerting);
    this.detections = {
      time: floats(map.detections.time_s),
      north: this.places(shorts(map.detections.north), map.low_north_m),
      east: this.places(shorts(map.detections.east), map.low_east_m),
      object: shorts(map.detections.object),
    };
  }

  private places(packed: Uint16Array, low: number): Float32Array {
    return Float32Array.from(packed, (v) => low + v * this.map.step_m);
  }

  /** The newest of each track of the last `seconds`, carried on to `time`; of one believer or of all. */
  believed(time: number, seconds: number, believer?: number): Believed[] {
    const b = this.trafficBeliefs;
    let low = 0, high = b.length / kBelief; // the first of these seconds
    while (low < high) {
      const middle = (low + high) >> 1;
      if (b[kBelief * middle] <= time - seconds) low = middle + 1;
      else high = middle;
    }
    const newest = new Map<string, Believed>();
    for (let i = kBelief * low; i < b.length && b[i] <= time + 1e-3; i += kBelief) {
      if (believer !== undefined && b[i + 8] !== believer) continue;
      const age = time - b[i];
      newest.set(`${b[i + 8]} ${b[i + 9]}`, {
        believer: b[i + 8], track: b[i + 9],
        north: b[i + 1] + age * b[i + 5], east: b[i + 2] + age * b[i + 6], altitude: b[i + 4] + age * b[i + 7],
        velocity: [b[i + 5], b[i + 6], b[i + 7]], deviation: b[i + 3],
      });
    }
    return [...newest.values()];
  }

  /** The newest rings at `time`; none before the first. */
  truth(time: number): Ring[] {
    return this.at(this.map.truth, time, 2);
  }
  belief(time: number): Ring[] {
    return this.at(this.map.belief, time, 4);
  }

  /** What the newest forecast of each mission at `time` says of later times. */
  ahead(time: number): { time: number; rings: Ring[] }[] {
    const made = new Map<string, number>();
    for (const forecast of this.map.ahead)
      if (forecast.made_s <= time + 1e-6) made.set(forecast.mission, forecast.made_s);
    return this.map.ahead
      .filter((each) => made.get(each.mission) === each.made_s && each.time_s > time)
      .map((each) => ({ time: each.time_s, rings: this.rings(each, 2) }));
  }

  private rings(frame: Frame, stride: number): Ring[] {
    let rings = this.cache.get(frame);
    if (!rings) {
      rings = frame.rings.map((packed) => this.ring(shorts(packed), stride));
      this.cache.set(frame, rings);
    }
    return rings;
  }

  private at(frames: Frame[], time: number, stride: number): Ring[] {
    let low = 0, high = frames.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (frames[middle].time_s <= time + 1e-6) low = middle + 1;
      else high = middle;
    }
    if (low === 0) return [];
    return this.rings(frames[low - 1], stride);
  }

  private ring(values: Uint16Array, stride: number): Ring {
    const column = (k: number, read: (v: number) => number) =>
      Float32Array.from({ length: values.length / stride }, (_, i) => read(values[i * stride + k]));
    const { low_north_m, low_east_m, step_m, sigma_step_m } = this.map;
    const ring: Ring = {
      north: column(0, (v) => low_north_m + v * step_m),
      east: column(1, (v) => low_east_m + v * step_m),
    };
    if (stride === 4) {
      ring.normal = column(2, (v) => (v / 65536) * kTurn);
      ring.sigma = column(3, (v) => v * sigma_step_m);
    }
    return ring;
  }

  /** Where a track is at `time`; nothing before its start or after its end. */
  pose(track: Track, time: number): Pose | null {
    const exact = (time - track.start) / track.step, last = track.north.length - 1;
    if (exact < 0 || exact > last + 1 || last < 0) return null;
    const i = Math.min(Math.floor(exact), last), k = Math.min(i + 1, last), f = Math.min(exact - i, 1);
    const turn = ((track.heading[k] - track.heading[i] + 384) % 256) - 128;
    return {
      north: track.north[i] + f * (track.north[k] - track.north[i]),
      east: track.east[i] + f * (track.east[k] - track.east[i]),
      heading: ((track.heading[i] + f * turn) / 256) * kTurn,
      altitude: track.altitude[i] + f * (track.altitude[k] - track.altitude[i]),
    };
  }

  /** South-west and north-east corners of everything but the terrain. */
  bounds(): { low: [number, number]; high: [number, number] } {
    let n0 = Infinity, n1 = -Infinity, e0 = Infinity, e1 = -Infinity;
    const add = (north: Float32Array, east: Float32Array) => {
      for (let i = 0; i < north.length; ++i) {
        n0 = Math.min(n0, north[i]);
        n1 = Math.max(n1, north[i]);
        e0 = Math.min(e0, east[i]);
        e1 = Math.max(e1, east[i]);
      }
    };
    for (const track of this.tracks) add(track.north, track.east);
    add(this.detections.north, this.detections.east);
    for (const { areas, lines } of this.missions)
      for (const line of [...areas, ...lines])
        add(Float32Array.from(line, (p) => p[0]), Float32Array.from(line, (p) => p[1]));
    for (const object of this.objects) {
      const places = [0, this.duration].map((time) => objectAt(object, time)).filter((at) => at !== null);
      add(Float32Array.from(places, (at) => at[0]), Float32Array.from(places, (at) => at[1]));
    }
    for (const rings of [this.truth(this.duration), this.belief(this.duration), this.truth(0)])
      for (const ring of rings) add(ring.north, ring.east);
    if (!(n0 <= n1)) return { low: [-500, -500], high: [500, 500] };
    return { low: [n0, e0], high: [n1, e1] };
  }
}
