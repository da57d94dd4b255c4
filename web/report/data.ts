/** What the program puts into the page, and how its packed numbers are read. */

import type { AirTraffic, Alert, Entity, Event, GroundObject, RecommendationChange } from "./records";

/** Base64 of little-endian numbers of the kind that the field's comment names. */
export type Packed = string;

export interface Track {
  entity: number;
  start_s: number;
  step_s: number;
  north: Packed; // uint16, see MapData
  east: Packed; // uint16
  heading: Packed; // uint8, 256 = one turn
  altitude: Packed; // uint16, -1000 m + 0.25 m * number
}

export interface Frame {
  time_s: number;
  rings: Packed[]; // truth: uint16 north, east; belief: north, east, normal, sigma
}

/** What a mission believed at one time about a later one. */
export interface Forecast extends Frame { // rings: uint16 north, east
  made_s: number;
  mission: string;
}

export interface Terrain {
  rows: number;
  columns: number;
  low_north_m: number;
  low_east_m: number;
  spacing_m: number;
  low_m: number;
  step_m: number;
  heights: Packed; // uint16, height = low + step * number, row by row from the south
}

/** A thing on the ground and how it moved. */
export interface MovingObject extends GroundObject {
  motions: Packed; // float32: time, north, east, velocity north and east, of each
}

/** Another aircraft and how it flew. */
export interface FlyingTraffic extends AirTraffic {
  motions: Packed; // float32: time, north (NaN: it is not there), east, velocity north and east, of each
}

/** Places are uint16: coordinate = low + step * number. */
export interface MapData {
  low_north_m: number;
  low_east_m: number;
  step_m: number;
  sigma_step_m: number;
  tracks: Track[];
  truth: Frame[];
  belief: Frame[];
  ahead: Forecast[]; // in order of made_s
  crossings: { time_s: Packed; north: Packed; east: Packed }; // float32, uint16, uint16
  objects: MovingObject[];
  detections: { time_s: Packed; north: Packed; east: Packed; object: Packed }; // the same, uint16
  traffic: FlyingTraffic[];
  /** float32, of each firm track, in order of time: time, north, east, horizontal deviation, altitude, velocity
   * north, east and up, believer, track. */
  traffic_beliefs: Packed;
  zones: { name: string; on_s: number; off_s: number | null; ring: Corner[] }[];
  missions: { name: string; begun_s: number; areas: Corner[][]; lines: Corner[][] }[];
  terrain?: Terrain;
}

/** North and east [m]. */
export type Corner = [number, number];

export type FlightColumn =
  "altitude_msl_m" | "airspeed_mps" | "cross_track_m" | "position_error_m" | "charge" | "reserve";

/** Ranges of values: from, to, number of the region (kRegions), one after the other. */
export type BandList = number[];

/** What an aircraft may fly at a time: time, highest level, advised track [deg], speed, vertical speed, time to
 * recovery; bands of tracks [deg], speeds, vertical speeds, altitudes. */
export type BandRow = [number, number, number | null, number | null, number | null, number | null,
  BandList, BandList, BandList, BandList];

/** A point of a recommended path. */
export interface PathPoint {
  time_s: number;
  north_m: number;
  east_m: number;
  altitude_msl_m: number;
}

export interface Alerting {
  alerts: Alert[]; // in order of time
  bands: { entity: number; rows: BandRow[] }[];
  recommendations: (Omit<RecommendationChange, "path"> & { path: PathPoint[] })[];
}

export interface RunData {
  label: string;
  name: string;
  version: string;
  seed: string;
  start_utc: string;
  directory: string;
  content_hash: string;
  state: "complete" | "interrupted" | "cut off";
  duration_s: number;
  allocation_start_s: number | null;
  summary: Record<string, number>;
  /** `class`: what entities between the physical and the virtual like it are called. */
  entities: (Entity & { class: string })[];
  metrics: { time_s: Packed; columns: Record<string, Packed> }; // float32, NaN = absent
  /** The first aircraft, over time; empty in comparisons. */
  flights: { entity: number; time_s: Packed; columns: Record<FlightColumn, Packed> }[]; // float32
  /** Figures of missions and their forecasts over time, lines of one text in one chart; what each of the summary's says. */
  missions: {
    series: { name: string; text: string; time_s: Packed; values: Packed }[]; // float32
    texts: Record<string, string>;
  };
  messages: { bin_s: number; sent: number[]; lost: number[] };
  /** Of a run whose radio has a medium: load of the air over time (float32), radios, links. */
  radio: {
    time_s: Packed;
    load_mean: Packed;
    load_max: Packed;
    radios: { entity: number; frames: number; sending: number; busy: number; waiting: number; queue_full: number;
      retry_limit: number; expired: number; received: number }[];
    links: { from: number; to: number; arrived: number; lost: number; rssi_dbm: number | null; sinr_db: number | null;
      delay_s: number | null }[];
  } | null;
  events: Event[];
  events_left_out: number;
  scenario: string;
  alerting: Alerting;
  map: MapData | null;
}

export interface StudyCell {
  text?: string;
  number?: number | null;
  highlight?: boolean;
}

export interface StudySeries {
  name: string;
  x: (number | null)[];
  y: (number | null)[];
  low?: (number | null)[];
  high?: (number | null)[];
  dashed?: boolean;
  points?: boolean;
}

/** By row, then by series: value and the ends of its confidence interval. */
export interface StudyDots {
  title: string;
  caption: string;
  x_label: string;
  log_x: boolean;
  rows: string[];
  series: string[];
  dots: [number | null, number | null, number | null][][];
}

/** Tracks over ground: x east, y north [m]. */
export interface StudyMap {
  title: string;
  caption: string;
  series: StudySeries[];
}

export interface StudyData {
  title: string;
  alert: string;
  dots: StudyDots[];
  intro: string[];
  tables: { title: string; caption: string; columns: string[]; rows: StudyCell[][] }[];
  plots: {
    title: string;
    caption: string;
    x_label: string;
    y_label: string;
    log_x: boolean;
    log_y: boolean;
    series: StudySeries[];
    lines: { y: number; label: string }[];
    y_low: number | null; // ends of the axis; null = as the lines need
    y_high: number | null;
  }[];
  maps: StudyMap[];
  notes: string[];
}

export type PageData =
  | { page: "runs"; title: string; runs: RunData[] }
  | ({ page: "study" } & StudyData);

function bytes(packed: Packed): ArrayBuffer {
  const text = atob(packed);
  const out = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) out[i] = text.charCodeAt(i);
  return out.buffer;
}

export const floats = (packed: Packed) => new Float32Array(bytes(packed));
export const shorts = (packed: Packed) => new Uint16Array(bytes(packed));
export const octets = (packed: Packed) => new Uint8Array(bytes(packed));
