// SPDX-License-Identifier: Apache-2.0
/** What the server says besides records: GET /api/run, and items of the live feed (interfaces of what the decoder yields). */
import type { Loiter, NamedValue, TaskCommand } from "./records";
import type { Origin } from "./frames";

export type { FlightPath, NamedValue, PathPoint, TaskPreview, TaskReason } from "./records";

export type Role = "viewer" | "operator" | "instructor";

/** A field of a task's form. */
export interface TaskField {
  name: string; // in JSON; of a place the prefix of north_m and east_m
  type: "number" | "integer" | "flag" | "text" | "word" | "place" | "places" | "aircraft" | "aircraft_list";
  unit?: string;
  help: string;
  default?: unknown;
  words?: string[];
  shape?: "line" | "area"; // of places
}

export interface TaskForm {
  kind: string;
  help: string;
  syntax: string;
  fields: TaskField[];
}

export interface RunAircraft {
  name: string;
  kind: string;
  joins_later: boolean;
  hovers?: boolean; // multirotors
  safety_radius_m?: number; // to be kept to others
}

export interface RunDescription {
  protocol: number;
  version: string;
  name: string;
  run: string;
  seed: number;
  replay: boolean;
  duration_s: number;
  start_utc: string;
  origin: Origin | null; // null: not known, in a file
  centre: { north_m: number; east_m: number };
  extent_m: number;
  missions: { name: string; kind: string }[];
  aircraft: RunAircraft[];
  task_kinds: TaskForm[];
  imagery?: string; // address of pictures of the ground, with {z}, {x}, {y}; empty: none; a file cannot have any
  you: { role: Role; name: string };
}

export interface RunClock {
  time_s: number;
  duration_s: number;
  speed: number;
  wanted_speed: number;
  paused: boolean;
  over: boolean;
  misses: number;
  headline: string;
}

export interface Client {
  client: number;
  name: string;
  role: Role;
}

export interface Clients {
  clients: Client[];
  holder: number;
  you: number;
}

export interface CommandReply {
  number: number;
  state: "given" | "accepted" | "refused";
  text: string;
}

export interface MetricSample {
  time_s: number;
  mission: string;
  values: NamedValue[];
}

export type What = TaskCommand["what"];

/** The word for a task's kind, one that the page has no type for included. */
export function taskKind(what: { kind?: string; task_kind?: string }): string {
  return (what.kind === "named" ? what.task_kind : what.kind) ?? "";
}

export interface TaskOrder {
  time_s: number;
  entity_id: number;
  number: number;
  what: What;
}

/** A message with an order: the only ones that the feed has. */
export interface OrderMessage {
  to_id: number;
  arrived_s: number;
  content: { kind: string; task_number: number; what?: What };
}

/** What a mission is to reach, as far as it can be drawn. */
export interface MissionState {
  time_s: number;
  station_id: number;
  mission: string;
  state: "begun" | "paused" | "resumed" | "over" | "changed";
  goal: { kind: string; area?: [number, number][]; holes?: [number, number][][]; line?: [number, number][]; closed?: boolean };
}

/** A place in a task, where it has one. */
export type Placed = Pick<Loiter, "north_m" | "east_m">;
