// SPDX-License-Identifier: Apache-2.0
/** What the program puts into the page, and how its packed numbers are read. */

import type { RunDescription } from "../common/protocol";
import type { Alert, Entity, Event, RecommendationChange } from "../common/records";
import { bytes } from "./unpack";

/** Base64 of little-endian numbers of the kind that the field's comment names. */
export type Packed = string;

/** What the map shows of a run: as a server would describe it, and messages of the live feed. Compressed and in base64. */
export interface MapData {
  run: RunDescription;
  step_s: number; // between frames, and tracks of others, that follow each other
  terrain: Packed; // as /api/terrain answers; empty: none
  records: Packed; // messages, see live/recording.ts
  frames: Packed;
}

export type FlightColumn = "altitude_msl_m" | "airspeed_mps" | "cross_track_m" | "position_error_m" | "charge" | "reserve";

/** Ranges of values: from, to, number of the region (kRegions), one after the other. */
export type BandList = number[];

/** What an aircraft may fly at a time: time, highest level, advised track [deg], speed, vertical speed, time to
 * recovery; bands of tracks [deg], speeds, vertical speeds, altitudes. */
export type BandRow = [number, number, number | null, number | null, number | null, number | null, BandList, BandList, BandList, BandList];

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
  messages: { bin_s: number; sent: number[]; lost: number[]; bytes: Record<string, number[]> };
  /** Of a run whose radio has a medium: load of the air over time (float32), radios, links. */
  radio: {
    time_s: Packed;
    load_mean: Packed;
    load_max: Packed;
    radios: {
      entity: number;
      frames: number;
      sending: number;
      busy: number;
      waiting: number;
      queue_full: number;
      retry_limit: number;
      expired: number;
      received: number;
    }[];
    links: { from: number; to: number; arrived: number; lost: number; rssi_dbm: number | null; sinr_db: number | null; delay_s: number | null }[];
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

export interface RunsData {
  title: string;
  runs: RunData[];
}

export type PageData = RunsData | StudyData;

export const floats = (packed: Packed) => new Float32Array(bytes(packed));
