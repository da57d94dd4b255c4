// SPDX-License-Identifier: Apache-2.0
/** Made by `skein schema records` from the descriptions in src/skein/data: do not edit. */

/** An aircraft or ground station. */
export interface Entity {
  entity_id: number; // its number
  name: string; // as the scenario has it
  kind: string; // aircraft or station
  presence: "none" | "virtual" | "physical" | "both"; // corporeal presence: the world that its body is in
  interaction: "none" | "virtual" | "physical" | "both"; // interactive capacity: the worlds that it perceives
  updates: "none" | "virtual" | "physical" | "both"; // update capability: the worlds of which it may refresh what the server knows
}

/** The true state of a vehicle. */
export interface Truth {
  time_s: number; // when
  entity_id: number; // whose
  north_m: number | null; // position
  east_m: number | null; // position
  altitude_msl_m: number | null; // position
  velocity_north_mps: number | null; // over ground
  velocity_east_mps: number | null; // over ground
  climb_mps: number | null; // over ground
  heading_deg: number; // attitude; the heading is that of the forward axis
  roll_deg: number; // attitude; the heading is that of the forward axis
  pitch_deg: number; // attitude; the heading is that of the forward axis
  roll_rate_dps: number | null; // rates of turn
  pitch_rate_dps: number | null; // rates of turn
  yaw_rate_dps: number | null; // rates of turn
  airspeed_mps: number | null; // through the air
  actuator_1: number | null; // what they do; see the plant
  actuator_2: number | null; // what they do; see the plant
  actuator_3: number | null; // what they do; see the plant
  actuator_4: number | null; // what they do; see the plant
  actuator_5: number | null; // what they do; see the plant
  actuator_6: number | null; // what they do; see the plant
  actuator_7: number | null; // what they do; see the plant
  actuator_8: number | null; // what they do; see the plant
  charge: number | null; // left, from 0 to 1
  voltage_v: number | null; // under load; 0: not modelled
  power_w: number | null; // drawn now; 0: not modelled
  dead_actuators: number; // bit k: actuator k gives nothing
  stuck_actuators: number; // bit k: actuator k is stuck
  battery_failed: boolean; // it gives nothing any more
  on_ground: boolean; // it stands or rolls
  held: boolean; // by its crew, before the start
}

/** What an autopilot believes and does. */
export interface Estimate {
  entity_id: number; // whose
  time_s: number; // that it is of
  north_m: number | null; // position
  east_m: number | null; // position
  altitude_msl_m: number | null; // position
  velocity_north_mps: number | null; // over ground
  velocity_east_mps: number | null; // over ground
  climb_mps: number | null; // over ground
  heading_deg: number | null; // of the air-relative velocity
  wind_north_mps: number | null; // estimated, horizontal
  wind_east_mps: number | null; // estimated, horizontal
  position_sd_m: number | null; // per horizontal axis
  roll_deg: number | null; // right wing down positive
  pitch_deg: number | null; // nose up positive
  altitude_sd_m: number | null; // of the altitude
  remaining_m: number | null; // along the path
  cross_track_m: number | null; // off the path that it follows, right positive
  done: boolean; // the path's end has been passed
  follows: boolean; // there is a path, plan or leg: cross_track means something
  time_error_s: number | null; // behind its plan; 0 on paths, which have no times
  along_north: number | null; // tangent of what it follows
  along_east: number | null; // tangent of what it follows
  lap: number; // laps of its waypoints that have been completed
  demanded_altitude_msl_m: number | null; // of fixed-wing guidance
  demanded_airspeed_mps: number | null; // of fixed-wing guidance
  on_ground: boolean; // as far as it knows
  mode: "manual" | "stabilized" | "auto" | "guided"; // who flies
  failsafe: "none" | "link" | "battery" | "geofence" | "gnss" | "motor" | "imu" | "unknown"; // what has gone wrong
  reaction: "none" | "hold" | "return" | "land" | "descend"; // what is done about it
  refusals: number; // commands that could not be flown
  charge: number | null; // as its battery monitor says
  reserve: number | null; // the charge less what it takes to get home; 1 while nothing is known of it
  endurance_s: number | null; // flight time left at the present power; null while not known
  lost_sensors: number; // bit k: nothing is received any more of the IMU (0), barometer, magnetometer, airspeed, power
  unit_1: number; // of each of these, the one flown by
  unit_2: number; // of each of these, the one flown by
  unit_3: number; // of each of these, the one flown by
  unit_4: number; // of each of these, the one flown by
  unit_5: number; // of each of these, the one flown by
}

/** One look of an in/out fire sensor, placed where the aircraft believes it. */
export interface Reading {
  time_s: number; // when it was measured
  entity_id: number; // whose sensor
  north_m: number | null; // the point looked at
  east_m: number | null; // the point looked at
  position_sd_m: number | null; // of the point, per axis
  inside: boolean; // it burns
}

/** Two successive readings of one aircraft that differ, as the agent found that keeps the belief. Not in order of time where readings came late. */
export interface Crossing {
  time_s: number; // of the later reading
  entity_id: number; // who crossed the boundary
  north_m: number | null; // middle of the two readings
  east_m: number | null; // middle of the two readings
  position_sd_m: number | null; // of the place, per axis
  entered: boolean; // the later reading is inside
  track_north_m: number | null; // from the earlier to the later reading
  track_east_m: number | null; // from the earlier to the later reading
}

/** What an aircraft says about itself, once a second. */
export interface Report {
  time_s: number; // that it is of
  north_m: number | null; // position
  east_m: number | null; // position
  altitude_msl_m: number | null; // position
  velocity_north_mps: number | null; // over ground
  velocity_east_mps: number | null; // over ground
  climb_mps: number | null; // over ground
  heading_deg: number | null; // of the air-relative velocity
  wind_north_mps: number | null; // estimated, horizontal
  wind_east_mps: number | null; // estimated, horizontal
  position_sd_m: number | null; // per horizontal axis
  roll_deg: number | null; // right wing down positive
  pitch_deg: number | null; // nose up positive
  altitude_sd_m: number | null; // of the altitude
  limits: number | null; // what it can do
  task_number: number; // the newest order; 0: none yet
  task_state: "none" | "flying" | "paused" | "done" | "impossible"; // how far it is with its task
  obeys: boolean; // no pilot and no failsafe flies
  zone_changes: number; // it knows all changes up to this number
  task_share: number | null; // of its task that is done
  task_time_to_go_s: number | null; // until its task is done; null: not known, or without end
  next_in_s: number | null; // until its next report, where the air has no room for more; null: soon
}

/** Circle a point until another order comes. */
export interface Loiter {
  north_m: number | null; // the point
  east_m: number | null; // the point
}

/** Fly to a point and through it. */
export interface FlyTo {
  north_m: number | null; // the point
  east_m: number | null; // the point
  altitude_msl_m: number | null; // reached evenly until there; null: the height over ground that the aircraft flies at
}

/** Follow the real edge of the fire with the in/out sensor. */
export interface FollowEdge {
  clockwise: boolean; // around the fire, on the map
  north_m: number | null; // where to look for the edge first
  east_m: number | null; // where to look for the edge first
  tangent_north: number | null; // believed direction of the edge there; 0: not known
  tangent_east: number | null; // believed direction of the edge there; 0: not known
  angle_deg: number | null; // between course and edge; 0: the agent's own
}

/** Follow a line of points, once. */
export interface FollowLine {
  points: [number, number][]; // of the line
}

/** Fly a fixed course. */
export interface FlyCourse {
  course_deg: number | null; // over ground
}

/** Fly through points, lap after lap. */
export interface FlyRoute {
  points: [number, number][]; // of the route
  laps: number; // times around
  report_to: number[]; // who gets the own position directly, each second
}

/** Stay at a place that moves with another aircraft. */
export interface FollowLeader {
  leader_id: number; // whom to follow
  forward_m: number | null; // ahead of the leader and to its right
  right_m: number | null; // ahead of the leader and to its right
}

/** Fly through points on curves planned for the wind, lap after lap. */
export interface FlyTour {
  points: [number, number][]; // of the tour
  laps: number; // times around
}

/** Stay where the aircraft is when the order comes. */
export interface Hold {
}

/** See all of an area. */
export interface Survey {
  area: [number, number][]; // its corners
  holes: [number, number][][]; // not to be seen, may be flown over
  swath_m: number | null; // width that is seen
  overlap: number | null; // of it, that neighbouring lines have in common
  lines: [number, number][]; // begin and end of each line that is left; empty: all, as it finds best
}

/** Fly along a line again and again. */
export interface Patrol {
  line: [number, number][]; // its points
  closed: boolean; // around, instead of there and back
  offset_m: number | null; // to the right of the line
  rounds: number; // there and back, or around; 0: until another order
}

/** Stay with a point or an object on the ground and look at it. */
export interface Orbit {
  north_m: number | null; // where it is, or was seen last
  east_m: number | null; // where it is, or was seen last
  object: number | null; // which object, as cameras number them; null: none
  radius_m: number | null; // of the circle; 0: the smallest
  weave: boolean; // S-turns along its track instead of a circle
  duration_s: number | null; // with it; 0: until another order
}

/** Fly to a point, stay there for a time and report. */
export interface Measure {
  north_m: number | null; // the point
  east_m: number | null; // the point
  stay_s: number | null; // near it
}

/** Be at a point at a time, and stay there. */
export interface Rendezvous {
  north_m: number | null; // the point
  east_m: number | null; // the point
  time_s: number; // of the run, when to be there
  course_deg: number | null; // over ground there; null: any
}

/** Stay between two others, so that they receive each other. */
export interface Relay {
  first_id: number; // aircraft or ground station
  second_id: number; // the other
}

/** One piece of a flight through air that moves evenly. */
export interface FlightElement {
  start_s: number | null; // when it begins
  duration_s: number | null; // how long it lasts
  north_m: number | null; // where it begins
  east_m: number | null; // where it begins
  altitude_msl_m: number | null; // where it begins
  heading_deg: number | null; // at the start, through the air
  airspeed_mps: number | null; // horizontal
  turn_rate_dps: number | null; // right positive
  climb_rate_mps: number | null; // at the start, upwards
  wind_north_mps: number | null; // that it was planned in
  wind_east_mps: number | null; // that it was planned in
  climb_acceleration_mps2: number | null; // change of the climb rate, upwards
}

/** Fly a plan of turns and straights as it is. */
export interface FlyPlan {
  plan: FlightElement[]; // its elements
  any_time: boolean; // begun when the aircraft is at its start; else in time
}

/** Fly home and stay above. */
export interface Return {
}

/** Land. */
export interface Land {
  at_home: boolean; // where the flight began
  north_m: number | null; // else here
  east_m: number | null; // else here
}

/** A task of a kind that messages know by its name only. */
export interface Named {
  task_kind: string; // which kind
  others: number[]; // whom it is about
  begin: number | null; // where it begins; null: anywhere
  end: number | null; // where it ends; null: where it begins
  centre_north_m: number | null; // of it; of no place: the origin
  centre_east_m: number | null; // of it; of no place: the origin
  length_m: number | null; // of the flight within it
  stay_s: number | null; // besides
  endless: boolean; // until another order
  sensors: number; // a bit for each kind that it takes
  better_hovering: boolean; // it is about one place
  foreseen: boolean; // where it leads follows from its values
  coded: number[]; // its values, coded
}

/** One order for one aircraft. */
export interface Task {
  task_number: number; // the newest counts
  what: ({ kind: "loiter" } & Loiter) | ({ kind: "fly_to" } & FlyTo) | ({ kind: "follow_edge" } & FollowEdge) | ({ kind: "follow_line" } & FollowLine) | ({ kind: "fly_course" } & FlyCourse) | ({ kind: "fly_route" } & FlyRoute) | ({ kind: "follow_leader" } & FollowLeader) | ({ kind: "fly_tour" } & FlyTour) | ({ kind: "hold" } & Hold) | ({ kind: "survey" } & Survey) | ({ kind: "patrol" } & Patrol) | ({ kind: "orbit" } & Orbit) | ({ kind: "measure" } & Measure) | ({ kind: "rendezvous" } & Rendezvous) | ({ kind: "relay" } & Relay) | ({ kind: "fly_plan" } & FlyPlan) | ({ kind: "return" } & Return) | ({ kind: "land" } & Land) | ({ kind: "named" } & Named); // what to do
}

/** The sender is there, nothing more. */
export interface Heartbeat {
}

/** Where an aircraft of the team is. */
export interface TeamPosition {
  entity_id: number; // which aircraft
  time_s: number; // that it is of
  north_m: number | null; // position
  east_m: number | null; // position
  altitude_msl_m: number | null; // position
  velocity_north_mps: number | null; // over ground
  velocity_east_mps: number | null; // over ground
  climb_mps: number | null; // over ground
  heading_deg: number | null; // of the air-relative velocity
  wind_north_mps: number | null; // estimated, horizontal
  wind_east_mps: number | null; // estimated, horizontal
  position_sd_m: number | null; // per horizontal axis
  roll_deg: number | null; // right wing down positive
  pitch_deg: number | null; // nose up positive
  altitude_sd_m: number | null; // of the altitude
}

/** A circle and what is inside. */
export interface Disc {
  centre_north_m: number | null; // its middle
  centre_east_m: number | null; // its middle
  radius_m: number | null; // its radius
}

/** A no-fly zone that is put into force or taken back. */
export interface ZoneChange {
  number: number; // of the ground station's changes; 0: in force from the start
  in_force: boolean; // else it is taken back, and only its name counts
  name: string; // for people
  area: { kind: "ring"; points: [number, number][] } | ({ kind: "disc" } & Disc); // a ring of corners or a disc
  floor_msl_m: number | null; // lowest altitude; null: no limit
  ceiling_msl_m: number | null; // highest altitude; null: no limit
  from_s: number | null; // forbidden since; null: always
  until_s: number | null; // forbidden until; null: for ever
}

/** A plugin's own value. */
export interface Plugin {
  plugin_kind: string; // what it is
  coded: number[]; // its bytes
}

/** An order about the task that an aircraft has. */
export interface TaskChange {
  task_number: number; // the newest counts
  action: "pause" | "resume" | "cancel"; // pause, resume or cancel
}

/** What an aircraft has still to do of its task. */
export interface TaskReport {
  task_number: number; // of the task
  state: "none" | "flying" | "paused" | "done" | "impossible"; // how far it is
  reason: string; // why it is impossible; else empty
  rest: ({ kind: "loiter" } & Loiter) | ({ kind: "fly_to" } & FlyTo) | ({ kind: "follow_edge" } & FollowEdge) | ({ kind: "follow_line" } & FollowLine) | ({ kind: "fly_course" } & FlyCourse) | ({ kind: "fly_route" } & FlyRoute) | ({ kind: "follow_leader" } & FollowLeader) | ({ kind: "fly_tour" } & FlyTour) | ({ kind: "hold" } & Hold) | ({ kind: "survey" } & Survey) | ({ kind: "patrol" } & Patrol) | ({ kind: "orbit" } & Orbit) | ({ kind: "measure" } & Measure) | ({ kind: "rendezvous" } & Rendezvous) | ({ kind: "relay" } & Relay) | ({ kind: "fly_plan" } & FlyPlan) | ({ kind: "return" } & Return) | ({ kind: "land" } & Land) | ({ kind: "named" } & Named); // what is left of it
}

/** Where somebody has seen an object. */
export interface Sighting {
  object_id: number; // which
  time_s: number; // when
  north_m: number | null; // where it was believed
  east_m: number | null; // where it was believed
  position_sd_m: number | null; // per axis
  class: "person" | "animal" | "vehicle" | "structure"; // what it is
}

/** The flight that the sender flies. */
export interface PlanReport {
  plan_number: number; // the newest counts
  agreed: number; // number of the negotiation it comes from; 0: none
  priority: "normal" | "landing" | "cannot-manoeuvre" | "manned" | "pilot-flies" | "emergency"; // who flies on where two meet
  horizontal_m: number; // separation that it keeps
  vertical_m: number; // the same, up and down
  across_error_m: number; // how far it is off its plan
  height_error_m: number; // the same, up and down
  flight: number[]; // its pieces, coded
}

/** Where the sender is. */
export interface PlaceReport {
  north_m: number; // position
  east_m: number; // position
  down_m: number; // position
  v_north_mps: number; // over ground
  v_east_mps: number; // over ground
  v_down_mps: number; // over ground
  plan_number: number; // the plan that it flies; 0: none
}

/** The sender and the receiver will not be apart. */
export interface ConflictNotice {
  negotiation: number; // counts those of the sender
  own_plan: number; // number of the sender's plan
  other_plan: number; // number of the receiver's plan
  begin_s: number; // what is agreed on begins then
  meets_s: number; // when they come too near
  closest_s: number; // when they are closest
  apart_s: number; // when they are apart again
  horizontal_m: number; // that the two have to keep
  vertical_m: number; // the same, up and down
}

/** Something that can be done, and its cost. */
export interface OfferedManoeuvre {
  manoeuvre: number; // which kind
  amount: number; // how much of it
  lead: number; // how long before the conflict
  cost_s: number; // to the sender
}

/** All that the sender can do about a conflict. */
export interface Offers {
  opener: number; // who has opened the negotiation
  negotiation: number; // its number
  deal: number; // by which rule the sender agrees
  strength: number; // of the manoeuvres
  rejoins_s: number; // where its plan must be met again
  airspeed_mps: number; // cruise
  turn_radius_m: number; // smallest, at cruise
  slowest_mps: number; // level flight
  fastest_mps: number; // level flight
  climb_mps: number; // largest
  sink_mps: number; // largest
  acceleration_mps2: number; // largest change of the climb rate
  manoeuvres: OfferedManoeuvre[]; // what it can do
}

/** The sender flies its part of what comes out. */
export interface Acceptance {
  opener: number; // who has opened the negotiation
  negotiation: number; // its number
  strength: number; // of the offers
  of_opener: number; // which of its manoeuvres
  of_other: number; // which of the other's
}

/** The sender does not negotiate now. */
export interface Busy {
  opener: number; // who has opened the negotiation
  negotiation: number; // its number
  other_plan: boolean; // its plan is another one
}

/** A member of a group. */
export interface GroupMember {
  entity_id: number; // which aircraft
  plan_number: number; // that it flies
}

/** The sender coordinates a group. */
export interface GroupInvitation {
  group: number; // counts those of the sender
  begin_s: number; // what is agreed on begins then
  apart_s: number; // all conflicts are over then
  members: GroupMember[]; // who is invited
}

/** The sender takes part in a group. */
export interface GroupJoining {
  group: number; // of the receiver
  rejoins_s: number; // where its plan must be met again
  airspeed_mps: number; // cruise
  turn_radius_m: number; // smallest, at cruise
  slowest_mps: number; // level flight
  fastest_mps: number; // level flight
  climb_mps: number; // largest
  sink_mps: number; // largest
  acceleration_mps2: number; // largest change of the climb rate
}

/** What one member of a group shall do. */
export interface GroupManoeuvre {
  entity_id: number; // which aircraft
  manoeuvre: number; // which kind
  amount: number; // how much of it
  lead: number; // how long before the conflict
  meets_s: number; // when they come too near
  closest_s: number; // when they are closest
  apart_s: number; // when they are apart again
  horizontal_m: number; // to be kept
  vertical_m: number; // the same, up and down
}

/** What comes out for a group. */
export interface GroupPlan {
  group: number; // of the sender
  members: number[]; // who takes part
  manoeuvres: GroupManoeuvre[]; // who does not go on
}

/** The sender flies its part, or does not. */
export interface GroupAcceptance {
  coordinator_id: number; // of the group
  group: number; // of the coordinator
  accepted: boolean; // it flies its part
}

/** A master asks its followers, or a newcomer looks for masters. */
export interface TeamQuery {
  mission: number | null; // null: the sender is a newcomer
  members: number; // how many, the master included
  members_hash: number; // of their ids
  state_number: number; // of the state as it is now
  led_s: number; // for how long it has led
  round_trip_s: number; // the longest measured
  successor: number | null; // takes over from the sender
  predecessor: number | null; // from whom it took over
}

/** How far a member is with a task. */
export interface TeamProgress {
  task: number; // its number
  share: number | null; // that is done, from 0 to 1
}

/** What a member of a team says of itself. */
export interface TeamInform {
  mission: number | null; // null: a newcomer
  master_id: number | null; // whom it follows, or itself
  query: number; // number of its master's last one
  held_s: number; // since that was received
  members_hash: number; // of whom it knows
  state_number: number; // of what it has in full
  leaving: boolean; // it leads no more
  resources_place_north_m: number | null; // where it is
  resources_place_east_m: number | null; // where it is
  resources_place_altitude_msl_m: number | null; // where it is
  resources_speed_mps: number; // cruise
  resources_endurance_s: number; // what is left
  resources_sensors: number; // a bit for each kind
  resources_able: boolean; // it flies tasks
  resources_home_north_m: number; // where it flies in the end
  resources_home_east_m: number; // likewise
  resources_refused: number[]; // tasks that it cannot fly now
  tasks: TeamProgress[]; // that it executes
}

/** A newcomer offers itself to a master. */
export interface TeamPropose {
  exchange: number; // counts the sender's tries
  resources_place_north_m: number | null; // where it is
  resources_place_east_m: number | null; // where it is
  resources_place_altitude_msl_m: number | null; // where it is
  resources_speed_mps: number; // cruise
  resources_endurance_s: number; // what is left
  resources_sensors: number; // a bit for each kind
  resources_able: boolean; // it flies tasks
  resources_home_north_m: number; // where it flies in the end
  resources_home_east_m: number; // likewise
  resources_refused: number[]; // tasks that it cannot fly now
}

/** A master would take a newcomer. */
export interface TeamAccept {
  exchange: number; // of the proposal
  mission_name: string; // the operator's name; also its lineage
  mission_branch: number | null; // of a part: its first master
  distance_m: number | null; // to the nearest task's centre
  members: number; // of its team
}

/** A master has no use for a newcomer. */
export interface TeamReject {
  exchange: number; // of the proposal
}

/** A newcomer joins the receiver. */
export interface TeamConfirm {
  exchange: number; // of the proposal
}

/** A newcomer joins somebody else. */
export interface TeamDecline {
  exchange: number; // of the proposal
}

/** A task of a team's mission. */
export interface TeamTask {
  number: number; // among the mission's, from 1
  place_north_m: number | null; // its centre
  place_east_m: number | null; // its centre
  single: boolean; // one aircraft does it, not a group
  done: boolean; // nothing is left of it
  branch: number | null; // of a mission that was split
  sensors: number; // a bit for each kind that it takes
  what: number[]; // the task, coded
  released: boolean; // the operator has approved it
  after: number[]; // tasks that are over before it is flown
  withdrawn: boolean; // the operator wants it no more
}

/** A master's order: these tasks and no others. */
export interface TeamAssign {
  mission_name: string; // the operator's name; also its lineage
  mission_branch: number | null; // of a part: its first master
  number: number; // counts the master's orders
  tasks: TeamTask[]; // in the order in which they are flown
}

/** An order is obeyed. */
export interface TeamAssignAck {
  number: number; // of the order
}

/** Two masters of one lineage that have met. */
export interface TeamMeeting {
  lower_id: number; // one of them
  higher_id: number; // the other
  times: number; // how often
}

/** What a team knows, for whoever takes over. */
export interface TeamState {
  number: number; // a fingerprint of all tasks
  part: number; // from 0
  parts: number; // how many there are
  members: number[]; // the master included
  met: TeamMeeting[]; // masters that met
  tasks: TeamTask[]; // of this part
}

/** A master gives way to another, or both stay. */
export interface TeamMerge {
  mission_name: string; // the operator's name; also its lineage
  mission_branch: number | null; // of a part: its first master
  meeting_lower_id: number; // one of them
  meeting_higher_id: number; // the other
  meeting_times: number; // how often
  split: boolean; // both stay, the mission is split
  members: number[]; // of the sender
}

/** How a mission was split between two masters. */
export interface TeamSplit {
  mission_name: string; // the operator's name; also its lineage
  mission_branch: number | null; // of a part: its first master
  meeting_lower_id: number; // one of them
  meeting_higher_id: number; // the other
  meeting_times: number; // how often
  part: number; // from 0
  parts: number; // how many there are
  tasks: TeamTask[]; // of this part
}

/** Who is believed to win a task. */
export interface TeamBid {
  task: number; // its number
  winner_id: number | null; // null: nobody
  value: number | null; // of the highest bid
  round: number; // counts the winner's changes
}

/** The highest bids that a member knows. */
export interface TeamBids {
  mission_name: string; // the operator's name; also its lineage
  mission_branch: number | null; // of a part: its first master
  bids: TeamBid[]; // one for each task
}

/** A task that a member is given. */
export interface TeamShare {
  entity_id: number; // which member
  task: number; // its number
}

/** An allocation that a leader proposes. */
export interface TeamProposal {
  mission_name: string; // the operator's name; also its lineage
  mission_branch: number | null; // of a part: its first master
  number: number; // from 1; grows
  state: "waits" | "approved" | "rejected" | "withdrawn" | "taken-over" | "unasked"; // what becomes of it
  value: number | null; // its utility; null: not measured
  bound: number | null; // no allocation is better
  shares: TeamShare[]; // who gets which tasks
}

/** A station's answer to a proposal. */
export interface TeamDecision {
  number: number; // of the proposal
  answer: "seen" | "approve" | "reject" | "taken"; // what the operator says
}

/** A follower is there; its inform still holds. */
export interface TeamHere {
  master_id: number | null; // whom it follows
  query: number; // number of its master's last one
  held_s: number; // since that was received
  members_hash: number; // of whom it knows
  state_number: number; // of what it has in full
}

/** A message of a team that leads itself. */
export interface Team {
  version: number; // of the protocol
  team_number: number; // counts the sender's messages
  said: ({ kind: "team_query" } & TeamQuery) | ({ kind: "team_inform" } & TeamInform) | ({ kind: "team_propose" } & TeamPropose) | ({ kind: "team_accept" } & TeamAccept) | ({ kind: "team_reject" } & TeamReject) | ({ kind: "team_confirm" } & TeamConfirm) | ({ kind: "team_decline" } & TeamDecline) | ({ kind: "team_assign" } & TeamAssign) | ({ kind: "team_assign_ack" } & TeamAssignAck) | ({ kind: "team_state" } & TeamState) | ({ kind: "team_merge" } & TeamMerge) | ({ kind: "team_split" } & TeamSplit) | ({ kind: "team_bids" } & TeamBids) | ({ kind: "team_proposal" } & TeamProposal) | ({ kind: "team_decision" } & TeamDecision) | ({ kind: "team_here" } & TeamHere); // what it says
}

/** The sender wants to land, or has landed. */
export interface LandingReport {
  phase: "waits" | "claims" | "lands" | "landed" | "leaves"; // how far it is
  north_m: number; // where it lands
  east_m: number; // where it lands
  course_deg: number; // of approaches
  altitude_msl_m: number; // at which it waits
  since_s: number; // when it began to want that
  endurance_s: number; // flight time left
  lasts_s: number; // until it stands, from now on
  attempts: number; // turns that it has given back
  emergency: boolean; // it lands without a turn
  committed: boolean; // it breaks off no more
}

/** A reading of a fire sensor among others of the same. */
export interface BriefReading {
  before_ms: number; // milliseconds by which it is older than the last
  place_north_dm: number; // decimetres north
  place_east_dm: number; // decimetres east
  inside: boolean; // it burns
  adjacent: boolean; // nothing was read between it and the one before
}

/** A place, to the decimetre. */
export interface BriefPlace {
  north_dm: number; // decimetres north
  east_dm: number; // decimetres east
}

/** What an aircraft has seen of a fire since it said so last. */
export interface Readings {
  time_s: number; // of the last reading
  position_sd: number; // metres, of all places, per axis
  readings: BriefReading[]; // in order of time
  burning: BriefPlace[]; // where it burns too, seen before
}

/** The sender asks the receiver to give way in a conflict. */
export interface YieldRequest {
  request: number; // counts those of the sender
  own_plan: number; // number of the sender's plan
  other_plan: number; // number of the receiver's plan
  meets_s: number; // when they come too near
  apart_s: number; // when they are apart again
}

/** Whether the sender gives way in a conflict. */
export interface YieldAnswer {
  request: number; // of the receiver
  granted: boolean; // it gives way
}

/** How high and how fast an aircraft flies. */
export interface FlightChange {
  number: number; // the newest counts
  altitude_agl_m: number | null; // above the ground; null: as before
  airspeed_mps: number | null; // at cruise; null: as before
}

/** A message that arrived or was lost. */
export interface MessageRecord {
  from_id: number; // who sent it
  to_id: number; // for whom
  number: number; // counts the sender's messages
  sent_s: number; // when it was sent
  content: ({ kind: "reading" } & Reading) | ({ kind: "report" } & Report) | ({ kind: "task" } & Task) | ({ kind: "heartbeat" } & Heartbeat) | ({ kind: "team_position" } & TeamPosition) | ({ kind: "zone" } & ZoneChange) | ({ kind: "plugin" } & Plugin) | ({ kind: "task_change" } & TaskChange) | ({ kind: "task_report" } & TaskReport) | ({ kind: "sighting" } & Sighting) | ({ kind: "plan_report" } & PlanReport) | ({ kind: "place_report" } & PlaceReport) | ({ kind: "conflict_notice" } & ConflictNotice) | ({ kind: "offers" } & Offers) | ({ kind: "acceptance" } & Acceptance) | ({ kind: "busy" } & Busy) | ({ kind: "group_invitation" } & GroupInvitation) | ({ kind: "group_joining" } & GroupJoining) | ({ kind: "group_plan" } & GroupPlan) | ({ kind: "group_acceptance" } & GroupAcceptance) | ({ kind: "team" } & Team) | ({ kind: "landing_report" } & LandingReport) | ({ kind: "readings" } & Readings) | ({ kind: "yield_request" } & YieldRequest) | ({ kind: "yield_answer" } & YieldAnswer) | ({ kind: "flight_change" } & FlightChange); // what it says
  arrived_s: number; // when it arrived, or was lost
  size_bytes: number; // as coded on the air
  lost: boolean; // it never arrived
  said: string; // of content team: what it says
  copy: boolean; // a further receiver's copy of a message to all
  cause: "none" | "chance" | "outage" | "out-of-range" | "queue-full" | "retry-limit" | "expired" | "not-received" | "link-down" | "nobody" | "refused" | "pending"; // why it was lost
  on_air_s: number | null; // when its first frame began; null: never, or not known
  transmissions: number; // data frames, of all its parts
  hops: number; // radios that passed it on
  forged: boolean; // it was sent by another in the name of from_id
  read_s: number | null; // when its receiver's agent reads it; null: nobody does
}

/** One point of a believed boundary. */
export interface BoundaryPoint {
  north_m: number | null; // where
  east_m: number | null; // where
  normal_north: number | null; // outward unit normal
  normal_east: number | null; // outward unit normal
  sigma_m: number | null; // standard deviation along the normal
  sigma_growth_mps: number | null; // of sigma while nothing is observed
  rate_mps: number | null; // believed speed along the normal
  major_axis_north_m: number | null; // major semi-axis of the 1-sigma ellipse; 0 where it is not known
  major_axis_east_m: number | null; // major semi-axis of the 1-sigma ellipse; 0 where it is not known
}

/** A true boundary and what is believed about it. */
export interface Perimeter {
  time_s: number; // when
  believer_id: number; // whose belief
  truth: [number, number][][]; // rings of the burnt area
  belief_time_s: number; // that it is of
  belief_rings: BoundaryPoint[][]; // closed; outer ones run clockwise on the map
  mission: string; // whose belief it is
  phenomenon: number; // whose boundary it is
}

/** Something worth reporting. */
export interface Event {
  time_s: number; // when
  entity_id: number; // to whom it happened
  kind: string; // short and stable: docs/events.md
  text: string; // for people
  other_id: number | null; // whom else it concerns
  task: number | null; // number of a task that was ordered
  team_task: number | null; // number of a task of a team
  value: number | null; // as the kind has it
  threshold: number | null; // that the value is compared with
}

/** A no-fly zone put into force or taken back. */
export interface ZoneRecord {
  time_s: number; // when
  number: number; // of the ground station's changes; 0: in force from the start
  in_force: boolean; // else it is taken back, and only its name counts
  name: string; // for people
  area: { kind: "ring"; points: [number, number][] } | ({ kind: "disc" } & Disc); // a ring of corners or a disc
  floor_msl_m: number | null; // lowest altitude; null: no limit
  ceiling_msl_m: number | null; // highest altitude; null: no limit
  from_s: number | null; // forbidden since; null: always
  until_s: number | null; // forbidden until; null: for ever
}

/** A thing on the ground (environment.objects). */
export interface GroundObject {
  object_id: number; // which
  name: string; // as the scenario has it
  class: "person" | "animal" | "vehicle" | "structure"; // what it is
}

/** An object found in one picture of a camera. */
export interface Detection {
  time_s: number; // of the picture
  entity_id: number; // whose camera
  sensor: number; // which of its payload sensors
  object_id: number; // what was found
  north_m: number | null; // where the aircraft believes it
  east_m: number | null; // where the aircraft believes it
  position_sd_m: number | null; // per axis: of the aircraft's own position and of the picture together
}

/** One picture: the ground in it. */
export interface Footprint {
  time_s: number; // of the picture
  entity_id: number; // whose camera
  sensor: number; // which of its payload sensors
  corner_1_north_m: number | null; // front left, front right, back right, back left, as the aircraft believes them
  corner_1_east_m: number | null; // front left, front right, back right, back left, as the aircraft believes them
  corner_2_north_m: number | null; // front left, front right, back right, back left, as the aircraft believes them
  corner_2_east_m: number | null; // front left, front right, back right, back left, as the aircraft believes them
  corner_3_north_m: number | null; // front left, front right, back right, back left, as the aircraft believes them
  corner_3_east_m: number | null; // front left, front right, back right, back left, as the aircraft believes them
  corner_4_north_m: number | null; // front left, front right, back right, back left, as the aircraft believes them
  corner_4_east_m: number | null; // front left, front right, back right, back left, as the aircraft believes them
}

/** Distance along one beam. */
export interface Range {
  time_s: number; // when it was measured
  forward: number | null; // unit vector of the beam in the body
  right: number | null; // unit vector of the beam in the body
  down: number | null; // unit vector of the beam in the body
  range_m: number | null; // 0: nothing within reach
}

/** One scan of a LiDAR, or one sample of a rangefinder. */
export interface RangeScan {
  time_s: number; // when it was measured
  entity_id: number; // whose sensor
  sensor: number; // which of its payload sensors
  beams: Range[]; // of the scan, in its order
}

/** One aircraft shall do this until the mission resumes. */
export interface TaskCommand {
  aircraft: string; // who
  what: ({ kind: "loiter" } & Loiter) | ({ kind: "fly_to" } & FlyTo) | ({ kind: "follow_edge" } & FollowEdge) | ({ kind: "follow_line" } & FollowLine) | ({ kind: "fly_course" } & FlyCourse) | ({ kind: "fly_route" } & FlyRoute) | ({ kind: "follow_leader" } & FollowLeader) | ({ kind: "fly_tour" } & FlyTour) | ({ kind: "hold" } & Hold) | ({ kind: "survey" } & Survey) | ({ kind: "patrol" } & Patrol) | ({ kind: "orbit" } & Orbit) | ({ kind: "measure" } & Measure) | ({ kind: "rendezvous" } & Rendezvous) | ({ kind: "relay" } & Relay) | ({ kind: "fly_plan" } & FlyPlan) | ({ kind: "return" } & Return) | ({ kind: "land" } & Land) | ({ kind: "named" } & Named); // what to do
  others: string[]; // names of those it is about; empty: it has their numbers
  file: string; // with the plan of a fly_plan
}

/** A mission is paused, goes on, begins or ends. */
export interface Mission {
  action: "pause" | "resume" | "start" | "end"; // what becomes of it
  mission: string; // its name; empty: all
}

/** Simulated time stands still, or goes on. */
export interface Pause {
  paused: boolean; // it stands still
}

/** A paused run makes some steps. */
export interface Step {
  steps: number; // of the run
}

/** How fast simulated time goes. */
export interface Speed {
  factor: number | null; // simulated over wall time; 0: as fast as possible
}

/** A part of an aircraft fails, or works again. */
export interface Fault {
  aircraft: string; // whose part
  part: string; // as in the events of failures
  fails: boolean; // else it works again
}

/** The true mean wind changes everywhere. */
export interface Wind {
  wind_north_mps: number | null; // on top of the scenario's
  wind_east_mps: number | null; // on top of the scenario's
}

/** An aircraft of the scenario joins now. */
export interface Add {
  aircraft: string; // who
}

/** An aircraft takes no further part. */
export interface Remove {
  aircraft: string; // who
}

/** The task of an aircraft is paused, resumed, cancelled, or another gets what is left of it. */
export interface ChangeTask {
  aircraft: string; // whose task
  action: "pause" | "resume" | "cancel"; // what becomes of it
  to: string; // who goes on with it; empty: nobody
}

/** It shall change its mode. */
export interface SetMode {
  mode: "other" | "manual" | "stabilized" | "hold" | "guided" | "mission" | "take-off" | "return" | "land"; // to this
}

/** Its motors shall be ready to turn, or not. */
export interface Arm {
  arm: boolean; // ready
  force: boolean; // whatever the checks say
}

/** It shall take off. */
export interface TakeOff {
  altitude_msl_m: number | null; // to climb to
  course_deg: number | null; // of the run; null: as it stands
}

/** Flown from moment to moment by a bank. */
export interface BankSetpoint {
  roll_deg: number | null; // right positive
  altitude_msl_m: number | null; // to be at
  climb_rate_mps: number | null; // on the way there
  airspeed_mps: number | null; // to fly
}

/** Flown from moment to moment along a line. */
export interface TrackSetpoint {
  north_m: number | null; // to be at now
  east_m: number | null; // to be at now
  altitude_msl_m: number | null; // to be at now
  velocity_north_mps: number | null; // over ground
  velocity_east_mps: number | null; // over ground
  climb_mps: number | null; // over ground
  acceleration_north_m: number | null; // over ground
  acceleration_east_m: number | null; // over ground
  acceleration_down_m: number | null; // over ground
  heading_deg: number | null; // null: its own
}

/** It shall fly at another airspeed. */
export interface SetSpeed {
  airspeed_mps: number | null; // from now on
}

/** One part of a stored mission. */
export interface MissionItem {
  kind: "take-off" | "waypoint" | "hold" | "speed" | "land" | "return" | "jump"; // what to do
  north_m: number | null; // where
  east_m: number | null; // where
  altitude_msl_m: number | null; // where
  hold_s: number | null; // of a hold; 0: for good
  airspeed_mps: number | null; // to fly
  to: number; // of a jump: the item to go on with
  repeats: number; // of a jump: how often
}

/** Its stored mission is replaced. */
export interface UploadMission {
  items: MissionItem[]; // one after the other
}

/** Its stored mission is flown. */
export interface StartMission {
  item: number; // from this one on
}

/** What sticks say, sent over the link. */
export interface Pilot {
  input_time_s: number; // when
  input_takes_over: boolean; // the pilot flies
  input_mode: "manual" | "stabilized" | "auto" | "guided"; // manual or stabilized
  input_roll: number | null; // stick, right positive, -1 to 1
  input_pitch: number | null; // stick, nose up positive, -1 to 1
  input_yaw: number | null; // stick, right positive, -1 to 1
  input_throttle: number | null; // 0 to 1
}

/** What stands around it in the virtual world. */
export interface Obstacles {
  range_m: number | null; // looked so far
  distances_1: number | null; // in metres, every 5 degrees from ahead clockwise; null: nothing in range
  distances_2: number | null; // in metres, every 5 degrees from ahead clockwise; null: nothing in range
  distances_3: number | null; // in metres, every 5 degrees from ahead clockwise; null: nothing in range
  distances_4: number | null; // in metres, every 5 degrees from ahead clockwise; null: nothing in range
  distances_5: number | null; // in metres, every 5 degrees from ahead clockwise; null: nothing in range
  distances_6: number | null; // in metres, every 5 degrees from ahead clockwise; null: nothing in range
  distances_7: number | null; // in metres, every 5 degrees from ahead clockwise; null: nothing in range
  distances_8: number | null; // in metres, every 5 degrees from ahead clockwise; null: nothing in range
  distances_9: number | null; // in metres, every 5 degrees from ahead clockwise; null: nothing in range
  distances_10: number | null; // in metres, every 5 degrees from ahead clockwise; null: nothing in range
  distances_11: number | null; // in metres, every 5 degrees from ahead clockwise; null: nothing in range
  distances_12: number | null; // in metres, every 5 degrees from ahead clockwise; null: nothing in range
  distances_13: number | null; // in metres, every 5 degrees from ahead clockwise; null: nothing in range
  distances_14: number | null; // in metres, every 5 degrees from ahead clockwise; null: nothing in range
  distances_15: number | null; // in metres, every 5 degrees from ahead clockwise; null: nothing in range
  distances_16: number | null; // in metres, every 5 degrees from ahead clockwise; null: nothing in range
  distances_17: number | null; // in metres, every 5 degrees from ahead clockwise; null: nothing in range
  distances_18: number | null; // in metres, every 5 degrees from ahead clockwise; null: nothing in range
  distances_19: number | null; // in metres, every 5 degrees from ahead clockwise; null: nothing in range
  distances_20: number | null; // in metres, every 5 degrees from ahead clockwise; null: nothing in range
  distances_21: number | null; // in metres, every 5 degrees from ahead clockwise; null: nothing in range
  distances_22: number | null; // in metres, every 5 degrees from ahead clockwise; null: nothing in range
  distances_23: number | null; // in metres, every 5 degrees from ahead clockwise; null: nothing in range
  distances_24: number | null; // in metres, every 5 degrees from ahead clockwise; null: nothing in range
  distances_25: number | null; // in metres, every 5 degrees from ahead clockwise; null: nothing in range
  distances_26: number | null; // in metres, every 5 degrees from ahead clockwise; null: nothing in range
  distances_27: number | null; // in metres, every 5 degrees from ahead clockwise; null: nothing in range
  distances_28: number | null; // in metres, every 5 degrees from ahead clockwise; null: nothing in range
  distances_29: number | null; // in metres, every 5 degrees from ahead clockwise; null: nothing in range
  distances_30: number | null; // in metres, every 5 degrees from ahead clockwise; null: nothing in range
  distances_31: number | null; // in metres, every 5 degrees from ahead clockwise; null: nothing in range
  distances_32: number | null; // in metres, every 5 degrees from ahead clockwise; null: nothing in range
  distances_33: number | null; // in metres, every 5 degrees from ahead clockwise; null: nothing in range
  distances_34: number | null; // in metres, every 5 degrees from ahead clockwise; null: nothing in range
  distances_35: number | null; // in metres, every 5 degrees from ahead clockwise; null: nothing in range
  distances_36: number | null; // in metres, every 5 degrees from ahead clockwise; null: nothing in range
  distances_37: number | null; // in metres, every 5 degrees from ahead clockwise; null: nothing in range
  distances_38: number | null; // in metres, every 5 degrees from ahead clockwise; null: nothing in range
  distances_39: number | null; // in metres, every 5 degrees from ahead clockwise; null: nothing in range
  distances_40: number | null; // in metres, every 5 degrees from ahead clockwise; null: nothing in range
  distances_41: number | null; // in metres, every 5 degrees from ahead clockwise; null: nothing in range
  distances_42: number | null; // in metres, every 5 degrees from ahead clockwise; null: nothing in range
  distances_43: number | null; // in metres, every 5 degrees from ahead clockwise; null: nothing in range
  distances_44: number | null; // in metres, every 5 degrees from ahead clockwise; null: nothing in range
  distances_45: number | null; // in metres, every 5 degrees from ahead clockwise; null: nothing in range
  distances_46: number | null; // in metres, every 5 degrees from ahead clockwise; null: nothing in range
  distances_47: number | null; // in metres, every 5 degrees from ahead clockwise; null: nothing in range
  distances_48: number | null; // in metres, every 5 degrees from ahead clockwise; null: nothing in range
  distances_49: number | null; // in metres, every 5 degrees from ahead clockwise; null: nothing in range
  distances_50: number | null; // in metres, every 5 degrees from ahead clockwise; null: nothing in range
  distances_51: number | null; // in metres, every 5 degrees from ahead clockwise; null: nothing in range
  distances_52: number | null; // in metres, every 5 degrees from ahead clockwise; null: nothing in range
  distances_53: number | null; // in metres, every 5 degrees from ahead clockwise; null: nothing in range
  distances_54: number | null; // in metres, every 5 degrees from ahead clockwise; null: nothing in range
  distances_55: number | null; // in metres, every 5 degrees from ahead clockwise; null: nothing in range
  distances_56: number | null; // in metres, every 5 degrees from ahead clockwise; null: nothing in range
  distances_57: number | null; // in metres, every 5 degrees from ahead clockwise; null: nothing in range
  distances_58: number | null; // in metres, every 5 degrees from ahead clockwise; null: nothing in range
  distances_59: number | null; // in metres, every 5 degrees from ahead clockwise; null: nothing in range
  distances_60: number | null; // in metres, every 5 degrees from ahead clockwise; null: nothing in range
  distances_61: number | null; // in metres, every 5 degrees from ahead clockwise; null: nothing in range
  distances_62: number | null; // in metres, every 5 degrees from ahead clockwise; null: nothing in range
  distances_63: number | null; // in metres, every 5 degrees from ahead clockwise; null: nothing in range
  distances_64: number | null; // in metres, every 5 degrees from ahead clockwise; null: nothing in range
  distances_65: number | null; // in metres, every 5 degrees from ahead clockwise; null: nothing in range
  distances_66: number | null; // in metres, every 5 degrees from ahead clockwise; null: nothing in range
  distances_67: number | null; // in metres, every 5 degrees from ahead clockwise; null: nothing in range
  distances_68: number | null; // in metres, every 5 degrees from ahead clockwise; null: nothing in range
  distances_69: number | null; // in metres, every 5 degrees from ahead clockwise; null: nothing in range
  distances_70: number | null; // in metres, every 5 degrees from ahead clockwise; null: nothing in range
  distances_71: number | null; // in metres, every 5 degrees from ahead clockwise; null: nothing in range
  distances_72: number | null; // in metres, every 5 degrees from ahead clockwise; null: nothing in range
}

/** A no-fly zone. */
export interface Zone {
  name: string; // for people
  area: { kind: "ring"; points: [number, number][] } | ({ kind: "disc" } & Disc); // a ring of corners or a disc
  floor_msl_m: number | null; // lowest altitude; null: no limit
  ceiling_msl_m: number | null; // highest altitude; null: no limit
  from_s: number | null; // forbidden since; null: always
  until_s: number | null; // forbidden until; null: for ever
}

/** Its exclusion fence is replaced. */
export interface UploadFence {
  zones: Zone[]; // that it shall keep out of
}

/** What a satellite receiver on board would say. */
export interface PositionFix {
  north_m: number | null; // position
  east_m: number | null; // position
  altitude_msl_m: number | null; // position
  velocity_north_mps: number | null; // over ground
  velocity_east_mps: number | null; // over ground
  climb_mps: number | null; // over ground
  position_sd_m: number | null; // per horizontal axis
}

/** What a program outside asks of an aircraft. */
export interface Vehicle {
  aircraft: string; // who
  request: ({ kind: "set_mode" } & SetMode) | ({ kind: "arm" } & Arm) | ({ kind: "take_off" } & TakeOff) | ({ kind: "land" } & Land) | ({ kind: "fly_to" } & FlyTo) | ({ kind: "bank_setpoint" } & BankSetpoint) | ({ kind: "track_setpoint" } & TrackSetpoint) | ({ kind: "set_speed" } & SetSpeed) | ({ kind: "upload_mission" } & UploadMission) | ({ kind: "start_mission" } & StartMission) | ({ kind: "pilot" } & Pilot) | ({ kind: "obstacles" } & Obstacles) | ({ kind: "upload_fence" } & UploadFence) | ({ kind: "position_fix" } & PositionFix); // what
}

/** An allocation that a team has proposed comes into force, or not. */
export interface Allocation {
  action: "approve" | "reject"; // what becomes of it
  number: number; // of the proposal; 0: that waits
  station: string; // whose team; empty: of all
}

/** How high and how fast an aircraft flies from now on. */
export interface ChangeFlight {
  aircraft: string; // who
  altitude_agl_m: number | null; // above the ground; null: as before
  airspeed_mps: number | null; // at cruise; null: as before
}

/** A task of a team that leads itself is added, withdrawn or changed. */
export interface ChangeTeamTask {
  action: "add" | "withdraw" | "change"; // what becomes of it
  number: number; // which is withdrawn or changed
  what: ({ kind: "loiter" } & Loiter) | ({ kind: "fly_to" } & FlyTo) | ({ kind: "follow_edge" } & FollowEdge) | ({ kind: "follow_line" } & FollowLine) | ({ kind: "fly_course" } & FlyCourse) | ({ kind: "fly_route" } & FlyRoute) | ({ kind: "follow_leader" } & FollowLeader) | ({ kind: "fly_tour" } & FlyTour) | ({ kind: "hold" } & Hold) | ({ kind: "survey" } & Survey) | ({ kind: "patrol" } & Patrol) | ({ kind: "orbit" } & Orbit) | ({ kind: "measure" } & Measure) | ({ kind: "rendezvous" } & Rendezvous) | ({ kind: "relay" } & Relay) | ({ kind: "fly_plan" } & FlyPlan) | ({ kind: "return" } & Return) | ({ kind: "land" } & Land) | ({ kind: "named" } & Named); // what to do
  others: string[]; // names of those it is about; empty: it has their numbers
  after: number[]; // numbers of tasks that are over before one that is added
  group: boolean; // several may fly one that is added
  station: string; // whose team; empty: of all
}

/** An aircraft that was taken from its agent is commanded by it again. */
export interface HandBack {
  aircraft: string; // who
}

/** An order of somebody outside was refused. */
export interface Refused {
  aircraft: string; // whom it was for; empty: nobody
  text: string; // who gave it, and why it was refused
}

/** A command that somebody gave. */
export interface CommandRecord {
  time_s: number; // it counts from this step on
  sender: string; // who gave it
  kind: string; // what was asked for: fields of ({ kind: "zone" } & ZoneChange) | ({ kind: "task" } & TaskCommand) | ({ kind: "mission" } & Mission) | ({ kind: "pause" } & Pause) | ({ kind: "step" } & Step) | ({ kind: "speed" } & Speed) | ({ kind: "fault" } & Fault) | ({ kind: "wind" } & Wind) | ({ kind: "add" } & Add) | ({ kind: "remove" } & Remove) | ({ kind: "change_task" } & ChangeTask) | ({ kind: "vehicle" } & Vehicle) | ({ kind: "allocation" } & Allocation) | ({ kind: "change_flight" } & ChangeFlight) | ({ kind: "change_team_task" } & ChangeTeamTask) | ({ kind: "hand_back" } & HandBack) | ({ kind: "refused" } & Refused)
}

/** A value that a plugin has recorded. */
export interface PluginRecord {
  time_s: number; // when
  plugin_kind: string; // what it is
  coded: number[]; // its bytes
}

/** What the planners on board make of what shall be flown, whenever that changes. */
export interface Planner {
  time_s: number; // from when on
  entity_id: number; // whose planner
  link: "loiter" | "task" | "separation" | "trajectory"; // which planner of the chain
  verdict: "passed-on" | "modified" | "replaced"; // what it does with what it is handed
  reason: string; // why
}

/** How an object truly moves from now on, until the next of its rows. */
export interface ObjectMotion {
  time_s: number; // from when on
  object_id: number; // which
  north_m: number | null; // then
  east_m: number | null; // then
  velocity_north_mps: number | null; // over ground
  velocity_east_mps: number | null; // over ground
}

/** What a mission believes of an object. */
export interface ObjectBelief {
  time_s: number; // when
  believer_id: number; // whose belief
  object_id: number; // which
  seen_s: number; // when it was last seen
  north_m: number | null; // then
  east_m: number | null; // then
  velocity_north_mps: number | null; // then
  velocity_east_mps: number | null; // then
  position_sd_m: number | null; // per axis, then
  velocity_sd_mps: number | null; // per axis
  persistence_s: number | null; // time constant with which the velocity decays
  mission: string; // whose belief it is
}

/** A forecast of a boundary. */
export interface Forecast {
  believer_id: number; // whose
  made_s: number; // when
  boundary_time_s: number; // that it is of
  boundary_rings: BoundaryPoint[][]; // closed; outer ones run clockwise on the map
  phenomenon: number; // whose boundary
  mission: string; // whose belief
}

/** Probability that a boundary has come by a time. */
export interface ArrivalStep {
  time_s: number; // by when
  probability: number | null; // that it has come
}

/** When a fire is believed to reach a place, as forecast. */
export interface Arrival {
  believer_id: number; // whose forecast
  made_s: number; // when it was said
  place: string; // its name
  north_m: number | null; // where it is
  east_m: number | null; // where it is
  early_s: number | null; // by then with 10 %; null: not within the horizons
  middle_s: number | null; // the same with 50 %
  late_s: number | null; // the same with 90 %
  steps: ArrivalStep[]; // the distribution
  phenomenon: number; // whose boundary
  mission: string; // whose belief
}

/** How a vehicle behind a link moves, as it says. */
export interface Motion {
  time_s: number; // when it was so
  north_m: number | null; // position
  east_m: number | null; // position
  altitude_msl_m: number | null; // position
  velocity_north_mps: number | null; // over ground
  velocity_east_mps: number | null; // over ground
  climb_mps: number | null; // over ground
  heading_deg: number; // attitude
  roll_deg: number; // attitude
  pitch_deg: number; // attitude
  roll_rate_dps: number | null; // rates of turn
  pitch_rate_dps: number | null; // rates of turn
  yaw_rate_dps: number | null; // rates of turn
  airspeed_mps: number | null; // 0: not measured
  wind_north_mps: number | null; // as it estimates it
  wind_east_mps: number | null; // as it estimates it
  position_sd_m: number | null; // per horizontal axis
  altitude_sd_m: number | null; // of the altitude
}

/** What a vehicle behind a link does, and how it is. */
export interface Condition {
  armed: boolean; // its motors may turn
  on_ground: boolean; // it stands
  ready: boolean; // its checks let it arm
  emergency: boolean; // as it says of itself
  mode: "other" | "manual" | "stabilized" | "hold" | "guided" | "mission" | "take-off" | "return" | "land"; // who flies it
  mode_name: string; // as its make calls it
  charge: number | null; // left, from 0 to 1
  voltage_v: number | null; // 0: it does not say
  current: number | null; // in ampere; 0: it does not say
  position: boolean; // it knows where it is
}

/** Something happened to a link. */
export interface LinkChange {
  change: "up" | "down" | "rebooted" | "mismatch" | "duplicate"; // what
  text: string; // for people
}

/** What became of a request to a vehicle. */
export interface Answer {
  number: number; // of the request
  outcome: "accepted" | "denied" | "unsupported" | "no answer" | "withdrawn"; // what became of it
  text: string; // a reason, if it gave one
}

/** Something that a vehicle says to people. */
export interface Text {
  severity: number; // 0: emergency, to 7: debug
  text: string; // what
}

/** Where a vehicle is in its stored mission. */
export interface MissionProgress {
  current: number; // item flown now
  finished: boolean; // the last one is done
}

/** What a vehicle behind a link is. */
export interface Identity {
  make: string; // of its autopilot
  airframe: string; // as it says
  hovers: boolean; // it can stay in one place
  following: "places" | "bank" | "trajectory"; // by what it flies along a line
}

/** How a link did so far. */
export interface LinkHealth {
  received: number; // frames
  lost: number; // frames, by the sender's count
  damaged: number; // frames with a bad checksum
  sent: number; // frames
  dropped: number; // frames not sent in time
  round_trip_s: number | null; // 0: not measured yet
}

/** What an outside autopilot had the actuators of a plant here do. */
export interface ActuatorOutputs {
  channels: number; // numbers of a row
  values: number[]; // row after row
  steps: number[]; // physics steps for which each row held
}

/** Something happened to an outside autopilot or its program. */
export interface OutsideEvent {
  event: string; // short and stable: docs/events.md
  text: string; // for people
}

/** What a vehicle was sent of the virtual world so far. */
export interface FeedHealth {
  traffic: number; // frames about other aircraft
  traffic_limited: number; // too soon, or too many in range
  obstacles: number; // frames
  obstacles_limited: number; // a newer one was there
  fences: number; // accepted
  fences_refused: number; // or not answered
  fixes: number; // positions, in place of a receiver's
  fixes_limited: number; // a newer one was there
}

/** What a vehicle behind a link has said: all that a run is told from outside. */
export interface VehicleReport {
  time_s: number; // of the step that took it in
  entity_id: number; // whose
  kind: string; // what it said: fields of ({ kind: "motion" } & Motion) | ({ kind: "condition" } & Condition) | ({ kind: "link_change" } & LinkChange) | ({ kind: "answer" } & Answer) | ({ kind: "text" } & Text) | ({ kind: "mission_progress" } & MissionProgress) | ({ kind: "identity" } & Identity) | ({ kind: "link_health" } & LinkHealth) | ({ kind: "actuator_outputs" } & ActuatorOutputs) | ({ kind: "outside_event" } & OutsideEvent) | ({ kind: "feed_health" } & FeedHealth) | ({ kind: "entity" } & Entity)
}

/** An object that exists in reality: an upright cylinder on the ground. */
export interface PhysicalObject {
  object_id: number; // which
  radius_m: number | null; // of the cylinder
  height_m: number | null; // above the ground
}

/** What became of an observation in the server's memory of the physical world. */
export interface Observation {
  time_s: number; // when it was taken in, refused or forgotten
  object_id: number; // what was seen
  seen_s: number; // when
  north_m: number | null; // where
  east_m: number | null; // where
  position_sd_m: number | null; // per axis
  class: "person" | "animal" | "vehicle" | "structure"; // what it is
  entity_id: number; // who saw it
  source: "none" | "virtual" | "physical" | "both"; // of the sensor: physical or virtual
  fate: "remembered" | "late" | "refused" | "expired" | "not-found"; // what became of it
}

/** A conflict between two aircraft that is over, as one of them saw it. */
export interface Conflict {
  time_s: number; // when it was over
  entity_id: number; // who saw it
  other_id: number; // with whom
  seen_s: number; // when it was seen first
  meets_s: number; // when they would have come too near
  method: "none" | "rule" | "priority" | "negotiated" | "group" | "non-cooperative" | "last-moment" | "auto"; // the last that acted
  outcome: string; // what was done
  messages: number; // that the aircraft sent about it
  bytes: number; // of them
  fixed_before_s: number | null; // between the plan that solved it and the conflict
  planned_ratio: number | null; // least distance over separation, as planned in the end
  flown_ratio: number | null; // the same as flown, by what both reported
}

/** An aircraft that belongs to nobody who takes part (traffic). */
export interface AirTraffic {
  traffic_id: number; // which
  name: string; // as the scenario has it
  flight: string; // kind of its behaviour
  address: number; // that it sends
  ads_b: boolean; // it broadcasts its place by ADS-B
  flarm: boolean; // the same by FLARM
  transponder: boolean; // it answers radars
}

/** How another aircraft truly flies from now on, until the next of its rows (off by less than 0.5 m). */
export interface TrafficMotion {
  time_s: number; // from when on
  traffic_id: number; // which
  north_m: number | null; // then
  east_m: number | null; // then
  altitude_msl_m: number | null; // then
  velocity_north_mps: number | null; // over ground
  velocity_east_mps: number | null; // over ground
  climb_mps: number | null; // over ground
  phase: "absent" | "flies" | "gap" | "jumped"; // whether it is there
}

/** What is believed on board of another aircraft, once a second. */
export interface TrafficTrack {
  time_s: number; // when
  believer_id: number; // whose belief
  track: number; // its number on board
  address: number | null; // that it has sent; null: none
  north_m: number | null; // where it is believed to be
  east_m: number | null; // where it is believed to be
  altitude_msl_m: number | null; // where it is believed to be
  velocity_north_mps: number | null; // how it is believed to fly
  velocity_east_mps: number | null; // how it is believed to fly
  climb_mps: number | null; // how it is believed to fly
  horizontal_sd_m: number | null; // in the worst direction
  vertical_sd_m: number | null; // of the altitude
  velocity_sd_mps: number | null; // on the worst axis
  updates: number; // measurements of it so far
  firm: boolean; // it may be acted on
  by_broadcast: boolean; // heard by ADS-B or FLARM, of late
  by_radar: boolean; // seen by radar, of late
  by_passive: boolean; // heard by a passive detector, of late
  measured_s: number; // when its last measurement was
}

/** Who leads a member of a team, as it believes itself. */
export interface TeamLead {
  time_s: number; // from when on
  entity_id: number; // which member
  team: string; // its mission; M/7: a branch; empty: none
  master_id: number | null; // null: nobody
  members: number[]; // itself included
  reason: "newcomer" | "selected" | "following" | "joined" | "merged" | "split" | "handover" | "lost" | "fixed" | "alone" | "members"; // why
}

/** An alert about another aircraft, whenever its level changes. */
export interface Alert {
  time_s: number; // from when on
  entity_id: number; // who is alerted
  track: number; // number of the other on board
  level: number; // from 1 on; 0: the alert is over
  region: "NONE" | "FAR" | "MID" | "NEAR" | "RECOVERY"; // that the level stands for
  bearing_deg: number | null; // from the nose, to the right
  distance_m: number | null; // horizontal
  height_m: number | null; // of the other above the own aircraft
  track_advised_deg: number | null; // out of the conflict, toward the goal; null: not needed, or none is found
  speed_advised_mps: number | null; // the same
  vertical_speed_advised_mps: number | null; // the same, up
}

/** Tracks and what they lead to. */
export interface TrackBand {
  from_deg: number | null; // clockwise from north
  to_deg: number | null; // the same
  region: "NONE" | "FAR" | "MID" | "NEAR" | "RECOVERY"; // what they lead to
}

/** Speeds and what they lead to. */
export interface SpeedBand {
  from_mps: number | null; // of the range
  to_mps: number | null; // of the range
  region: "NONE" | "FAR" | "MID" | "NEAR" | "RECOVERY"; // what they lead to
}

/** Altitudes and what they lead to. */
export interface AltitudeBand {
  from_m: number | null; // above mean sea level
  to_m: number | null; // above mean sea level
  region: "NONE" | "FAR" | "MID" | "NEAR" | "RECOVERY"; // what they lead to
}

/** What an aircraft may fly while an alert stands, once a second; none: level 0. */
export interface Band {
  time_s: number; // when
  entity_id: number; // which aircraft
  level: number; // the highest of all alerts; 0: none any more
  track_deg: number | null; // the own one, over ground
  speed_mps: number | null; // the own one, over ground
  vertical_speed_mps: number | null; // the own one, up
  track_advised_deg: number | null; // out of the conflict, toward the goal; null: not needed, or none is found
  speed_advised_mps: number | null; // the same
  vertical_speed_advised_mps: number | null; // the same, up
  recovery_s: number | null; // until well clear again, by a track that is RECOVERY; null: there is none
  tracks: TrackBand[]; // bands of tracks; others are free
  speeds: SpeedBand[]; // the same of speeds
  vertical_speeds: SpeedBand[]; // the same, up
  altitudes: AltitudeBand[]; // the same of altitudes
}

/** A point of a recommended path. */
export interface RecommendedPoint {
  time_s: number | null; // when
  north_m: number | null; // where
  east_m: number | null; // where
  altitude_msl_m: number | null; // where
}

/** What becomes of a path that is recommended to the pilot on board. */
export interface RecommendationChange {
  time_s: number; // when
  entity_id: number; // which aircraft
  number: number; // of those of the aircraft
  state: "shown" | "followed" | "ignored" | "over"; // what becomes of it
  reason: string; // why another path than the task's
  path: RecommendedPoint[]; // the next minutes of it, when it is shown
}

/** What becomes of an allocation of a team's tasks, as its leader says it; as its operator's station, where the leader was lost first. */
export interface TeamAllocation {
  time_s: number; // when
  entity_id: number; // who says so
  team: string; // its mission; M/7: a branch
  proposer_id: number; // who leads, and has worked it out
  number: number; // of the proposal; 0: it was none
  state: "waits" | "approved" | "rejected" | "withdrawn" | "taken-over" | "unasked"; // what becomes of it
  value: number | null; // its utility; null: not measured
  bound: number | null; // no allocation is better; null: not known
  gap: number | null; // bound minus value over the larger of both
  shares: TeamShare[]; // who gets which tasks
}

/** What the radio of an entity did since the row before. */
export interface Radio {
  time_s: number; // the end
  entity_id: number; // whose radio
  frames: number; // sent: data, answers, announcements
  sending_share: number | null; // of the time
  busy_share: number | null; // of the time: others were heard
  waiting: number; // packets in its queue, the most at once
  queue_full: number; // packets that the queue had no room for
  retry_limit: number; // packets given up
  expired: number; // packets too old before they were sent
  received: number; // packets that arrived for it
}

/** How well one radio heard another since the last such time, also what was not for it; arrived and lost are 0 where nothing was. */
export interface RadioLink {
  time_s: number; // the end
  from_id: number; // who sent
  to_id: number; // for whom
  arrived: number; // messages
  lost: number; // messages
  rssi_dbm: number | null; // mean level of what was received
  sinr_db: number | null; // mean ratio of signal to noise and interference, the least of each frame
  delay_s: number | null; // mean from sending to arrival
}

/** A point of a flight ahead. */
export interface PathPoint {
  ahead_s: number; // after the flight was planned
  north_m: number; // of the origin
  east_m: number; // of the origin
  altitude_msl_m: number; // above mean sea level
}

/** How an aircraft expects to fly: said when that changes. */
export interface FlightPath {
  time_s: number; // when it was planned
  entity_id: number; // which aircraft
  points: PathPoint[]; // straight pieces lead from one to the next
  ends: boolean; // at the last; else it goes on from there
}

/** A number with a name. */
export interface NamedValue {
  name: string; // with its unit
  value: number | null; // in that unit; null: not known
}

/** Why an aircraft was given its task: the terms that have decided. */
export interface TaskReason {
  time_s: number; // when
  entity_id: number; // who has given it
  aircraft_id: number; // who was given it
  terms: NamedValue[]; // that have decided
}

/** How far a task of a team is: said when that changes. */
export interface TeamTaskChange {
  time_s: number; // when
  entity_id: number; // which station has heard so
  team: string; // its mission
  number: number; // among the mission's, from 1
  what: string; // its kind
  north_m: number | null; // its centre
  east_m: number | null; // its centre
  after: number[]; // tasks that are over before it is flown
  several: boolean; // several may fly it at once
  state: "waits" | "open" | "flown" | "done" | "withdrawn"; // how far it is
  executor_id: number | null; // who flies it; null: nobody
}

/** Two aircraft that came nearer to each other than they have to keep, by the truth. */
export interface SeparationLoss {
  time_s: number; // when they were well apart again, or the run ended
  entity_id: number; // one of both, of the lower number
  other_id: number; // the other
  phase: "air" | "formation" | "ground"; // what both did when they were closest
  begun_s: number; // when separation was lost
  closest_s: number; // when the ratio was least
  ratio: number | null; // least distance over what is required: the larger of the horizontal and the vertical one
  horizontal_m: number | null; // distance when closest
  vertical_m: number | null; // distance when closest
  distance_m: number | null; // least, straight
  required_horizontal_m: number | null; // of the pair, unless the vertical one is kept
  required_vertical_m: number | null; // of the pair, unless the horizontal one is kept
  over: boolean; // they were well apart again; else one has left, or the run has ended
}

/** How far a run is, and how its clock goes. */
export interface RunClock {
  time_s: number; // simulated
  duration_s: number; // when the run is over
  speed: number | null; // measured: simulated over wall time
  wanted_speed: number | null; // 0: as fast as it can
  paused: boolean; // simulated time stands still
  over: boolean; // the run has ended
  misses: number; // steps that began too late for real time
  headline: string; // key figures in one line
}

/** Where an aircraft believes to be, and how it is. */
export interface VehicleView {
  entity_id: number; // which aircraft
  north_m: number; // of the origin
  east_m: number; // of the origin
  altitude_msl_m: number; // above mean sea level
  velocity_north_mps: number; // over ground
  velocity_east_mps: number; // over ground
  climb_mps: number; // up
  heading_deg: number; // of the air-relative velocity
  roll_deg: number; // right wing down positive
  position_sd_m: number; // per horizontal axis
  cross_track_m: number; // off the path that it follows, right positive
  time_error_s: number; // behind its plan
  charge: number; // left, from 0 to 1
  endurance_s: number | null; // flight time left at the present power; null while not known
  age_s: number; // of this estimate
  heard_s: number | null; // when a ground station heard of it last; null: never yet
  mode: "manual" | "stabilized" | "auto" | "guided"; // who flies
  failsafe: "none" | "link" | "battery" | "geofence" | "gnss" | "motor" | "imu" | "unknown"; // what has gone wrong
  reaction: "none" | "hold" | "return" | "land" | "descend"; // what is done about it
  on_ground: boolean; // as far as it knows
  task_number: number; // of the newest order that it obeys, as its station has heard; 0: none yet
  task_state: "none" | "flying" | "paused" | "done" | "impossible"; // how far it is with it
  task_share: number; // that is done, from 0 to 1
  task_time_to_go_s: number | null; // until it is done; null: not known, or without end
}

/** All aircraft that take part, at one time. */
export interface FleetFrame {
  time_s: number; // when
  vehicles: VehicleView[]; // in the order of their numbers
}

/** Where a vehicle truly is. */
export interface TruePlace {
  entity_id: number; // which vehicle
  north_m: number; // of the origin
  east_m: number; // of the origin
  altitude_msl_m: number; // above mean sea level
  heading_deg: number; // of its forward axis
}

/** Where all aircraft truly are, at one time. */
export interface TruthFrame {
  time_s: number; // when
  places: TruePlace[]; // in the order of their numbers
}

/** Somebody who watches a run. */
export interface ClientView {
  client: number; // counts from 1
  name: string; // that was given, for people
  role: "viewer" | "operator" | "instructor"; // what they may do
}

/** Everybody who watches, and who of them gives commands. */
export interface Clients {
  clients: ClientView[]; // in the order of their numbers
  holder: number; // who holds control; 0: nobody
  you: number; // to whom this is said
  truth_shown: boolean; // instructors see the truth
}

/** What becomes of a request of a client. */
export interface CommandReply {
  number: number; // of the client's requests
  state: "given" | "accepted" | "refused"; // how far it is
  text: string; // why it is refused, for people
}

/** How well a mission goes, by the truth. */
export interface MetricSample {
  time_s: number; // when
  mission: string; // which mission; empty: the run
  values: NamedValue[]; // figures of docs/records.md
}

/** The full state of a run follows, or is complete. */
export interface Snapshot {
  begins: boolean; // all that was said before is void
}

/** What an aircraft would do with a task. */
export interface TaskPreview {
  number: number; // of the client's request
  problem: string; // why it cannot be flown; empty: it can
  points: PathPoint[]; // straight pieces lead from one to the next
  ends: boolean; // at the last; else it goes on from there
  done: boolean; // the task is done within the time looked ahead
  duration_s: number | null; // until then, or looked ahead
  length_m: number | null; // of the path over ground
  charge: number | null; // that it takes, from 0 to 1
  charge_left: number | null; // after it, from 0 to 1
}

/** What is said of a kind of event. */
export interface EventKind {
  subject: "flight" | "guidance" | "task" | "mission" | "zone" | "fire" | "team" | "protocol" | "traffic" | "radio" | "vehicle" | "program" | "memory" | "plugin";
  severity: "information" | "notice" | "warning" | "alarm";
  audience: "operator" | "pilot" | "researcher" | "integrator";
  announced: boolean; // whoever commands is shown it at once
  meaning: string;
}

/** All kinds of event, by name: docs/events.md. Those of plugins are not among them. */
export const eventKinds = {
  "joined": { subject: "flight", severity: "information", audience: "operator", announced: false, meaning: "It takes part in the run from now on." },
  "left": { subject: "flight", severity: "notice", audience: "operator", announced: false, meaning: "It no longer takes part." },
  "took-off": { subject: "flight", severity: "information", audience: "operator", announced: false, meaning: "It has left the ground." },
  "landed": { subject: "flight", severity: "information", audience: "operator", announced: false, meaning: "It stands on the ground." },
  "accident": { subject: "flight", severity: "alarm", audience: "operator", announced: false, meaning: "It has hit the ground, or its motion stopped being finite; it is lost." },
  "mode": { subject: "flight", severity: "information", audience: "pilot", announced: false, meaning: "Its autopilot has changed its mode by itself or by an order." },
  "failsafe": { subject: "flight", severity: "warning", audience: "operator", announced: false, meaning: "A failsafe has another trigger or reaction now, or is over." },
  "refused": { subject: "flight", severity: "warning", audience: "pilot", announced: false, meaning: "Its autopilot has refused a command." },
  "failure": { subject: "flight", severity: "warning", audience: "operator", announced: false, meaning: "A part has failed, as the scenario or an instructor has it." },
  "repaired": { subject: "flight", severity: "notice", audience: "operator", announced: false, meaning: "A part that had failed works again." },
  "sensor-lost": { subject: "flight", severity: "warning", audience: "pilot", announced: false, meaning: "Its autopilot misses a flight sensor." },
  "sensor-back": { subject: "flight", severity: "notice", audience: "pilot", announced: false, meaning: "A flight sensor that was missed is there again." },
  "sensor-switched": { subject: "flight", severity: "notice", audience: "pilot", announced: false, meaning: "Its autopilot flies by another unit of a flight sensor." },
  "planned": { subject: "guidance", severity: "information", audience: "researcher", announced: false, meaning: "A path, or a whole survey, has been planned." },
  "no-plan": { subject: "guidance", severity: "warning", audience: "operator", announced: false, meaning: "Nothing can be planned for what was requested." },
  "no-path": { subject: "guidance", severity: "warning", audience: "operator", announced: false, meaning: "No path leads to where it is to fly." },
  "point-left-out": { subject: "guidance", severity: "notice", audience: "operator", announced: false, meaning: "A point of its route lies in a no-fly zone and is left out." },
  "off-plan": { subject: "guidance", severity: "notice", audience: "researcher", announced: false, meaning: "It is far behind, ahead of or beside its plan." },
  "on-plan": { subject: "guidance", severity: "information", audience: "researcher", announced: false, meaning: "It is close to its plan again." },
  "flight-changed": { subject: "guidance", severity: "information", audience: "operator", announced: false, meaning: "It flies at the height or speed that the operator has given." },
  "flight-refused": { subject: "guidance", severity: "warning", audience: "operator", announced: false, meaning: "It refuses a height or speed that the operator has given." },
  "landing-wait": { subject: "guidance", severity: "information", audience: "operator", announced: false, meaning: "It circles until it is its turn to land." },
  "landing-turn": { subject: "guidance", severity: "information", audience: "operator", announced: false, meaning: "It is its turn to land." },
  "return-moved": { subject: "guidance", severity: "notice", audience: "operator", announced: false, meaning: "Returns lead to another place, because of a no-fly zone, or home again." },
  "setpoints-ended": { subject: "guidance", severity: "notice", audience: "integrator", announced: false, meaning: "Setpoints from a ground station have ended; it holds its place." },
  "ordered": { subject: "task", severity: "information", audience: "operator", announced: false, meaning: "A station orders a task, a change of one, a height or a speed." },
  "task": { subject: "task", severity: "information", audience: "operator", announced: false, meaning: "It begins a task." },
  "task-refused": { subject: "task", severity: "warning", audience: "operator", announced: false, meaning: "It refuses a task that it was given." },
  "task-paused": { subject: "task", severity: "information", audience: "operator", announced: false, meaning: "Its task waits for the operator." },
  "task-resumed": { subject: "task", severity: "information", audience: "operator", announced: false, meaning: "Its task goes on." },
  "task-cancelled": { subject: "task", severity: "notice", audience: "operator", announced: false, meaning: "Its task is cancelled." },
  "task-impossible": { subject: "task", severity: "warning", audience: "operator", announced: false, meaning: "Its task cannot be flown any more." },
  "task-done": { subject: "task", severity: "information", audience: "operator", announced: false, meaning: "Its task is done." },
  "task-moved": { subject: "task", severity: "notice", audience: "operator", announced: false, meaning: "The place of its task is moved out of a no-fly zone, or back." },
  "task-over": { subject: "task", severity: "information", audience: "operator", announced: false, meaning: "A task of the mission's list is over." },
  "task-given-up": { subject: "task", severity: "warning", audience: "operator", announced: false, meaning: "A task of the mission's list is given up: nobody can fly it." },
  "route-done": { subject: "task", severity: "information", audience: "operator", announced: false, meaning: "The last point of a route or tour has been passed." },
  "late": { subject: "task", severity: "warning", audience: "operator", announced: false, meaning: "It cannot be at its rendezvous in time." },
  "arrived": { subject: "task", severity: "information", audience: "operator", announced: false, meaning: "It is at its rendezvous." },
  "measured": { subject: "task", severity: "information", audience: "researcher", announced: false, meaning: "A measurement at a place is complete." },
  "edge-lost": { subject: "task", severity: "notice", audience: "researcher", announced: false, meaning: "It has lost the edge of the fire that it follows." },
  "edge-found": { subject: "task", severity: "information", audience: "researcher", announced: false, meaning: "It has found the edge of the fire again." },
  "survey-incomplete": { subject: "task", severity: "warning", audience: "operator", announced: false, meaning: "Parts of a survey could not be flown." },
  "mission": { subject: "mission", severity: "information", audience: "operator", announced: false, meaning: "A mission begins, is paused, goes on or is over." },
  "command-refused": { subject: "mission", severity: "warning", audience: "operator", announced: false, meaning: "A command cannot be obeyed." },
  "allocated": { subject: "mission", severity: "information", audience: "operator", announced: false, meaning: "An aircraft is given to a mission, or to none." },
  "surveyed": { subject: "mission", severity: "information", audience: "operator", announced: false, meaning: "Nothing is left of a survey that its aircraft can fly." },
  "shared": { subject: "mission", severity: "information", audience: "researcher", announced: false, meaning: "The lines of a survey are divided among its aircraft." },
  "object-found": { subject: "mission", severity: "information", audience: "operator", announced: false, meaning: "A mission has found an object to be tracked." },
  "object-lost": { subject: "mission", severity: "warning", audience: "operator", announced: false, meaning: "An object that was tracked has not been seen for long." },
  "leader": { subject: "mission", severity: "notice", audience: "operator", announced: false, meaning: "It leads the formation from now on." },
  "leader-lost": { subject: "mission", severity: "warning", audience: "operator", announced: false, meaning: "The leader of a formation is silent, or under another command." },
  "zone": { subject: "zone", severity: "notice", audience: "operator", announced: false, meaning: "It is inside a no-fly zone, has left it, or turns away from one." },
  "zone-on": { subject: "zone", severity: "information", audience: "operator", announced: false, meaning: "A no-fly zone is in force: of a station, or as an aircraft has received it." },
  "zone-off": { subject: "zone", severity: "information", audience: "operator", announced: false, meaning: "A no-fly zone is taken back." },
  "zone-refused": { subject: "zone", severity: "warning", audience: "operator", announced: false, meaning: "A zone that was drawn cannot be put into force." },
  "zones-known": { subject: "zone", severity: "information", audience: "operator", announced: false, meaning: "All aircraft in contact have acknowledged the zones." },
  "crossing": { subject: "fire", severity: "information", audience: "researcher", announced: false, meaning: "An aircraft has crossed the boundary." },
  "no-crossing": { subject: "fire", severity: "notice", audience: "researcher", announced: false, meaning: "The deployment of an aircraft met no boundary." },
  "forced-crossing": { subject: "fire", severity: "notice", audience: "researcher", announced: false, meaning: "An aircraft is sent across the boundary, which it has not crossed for long." },
  "entry": { subject: "fire", severity: "information", audience: "researcher", announced: false, meaning: "The place from which an aircraft enters is chosen." },
  "allocation": { subject: "fire", severity: "information", audience: "researcher", announced: false, meaning: "The deployment is over: the strategy allocates." },
  "silent": { subject: "fire", severity: "warning", audience: "operator", announced: false, meaning: "No report of an aircraft has come for a while." },
  "outlier": { subject: "fire", severity: "notice", audience: "researcher", announced: false, meaning: "Observations were all but impossible under the belief." },
  "too-late": { subject: "fire", severity: "notice", audience: "researcher", announced: false, meaning: "Readings came too late to count." },
  "over-confident": { subject: "fire", severity: "warning", audience: "operator", announced: false, meaning: "Crossings lie outside the believed band far too often." },
  "trusted": { subject: "fire", severity: "information", audience: "operator", announced: false, meaning: "Crossings lie inside the believed band again." },
  "hand-over": { subject: "fire", severity: "notice", audience: "researcher", announced: false, meaning: "Another method makes the belief from now on." },
  "team-selected": { subject: "team", severity: "notice", audience: "operator", announced: false, meaning: "It leads the team from now on." },
  "team-following": { subject: "team", severity: "information", audience: "operator", announced: false, meaning: "It follows another member." },
  "team-master-lost": { subject: "team", severity: "warning", audience: "operator", announced: false, meaning: "Who leads has been silent for too long." },
  "team-joined": { subject: "team", severity: "information", audience: "operator", announced: false, meaning: "A member follows it." },
  "team-follower-lost": { subject: "team", severity: "warning", audience: "operator", announced: false, meaning: "A member follows it no longer." },
  "team-merged": { subject: "team", severity: "notice", audience: "operator", announced: false, meaning: "Two teams have become one." },
  "team-split": { subject: "team", severity: "notice", audience: "operator", announced: false, meaning: "A team splits its mission with another." },
  "team-took-back": { subject: "team", severity: "notice", audience: "operator", announced: false, meaning: "It takes over tasks of a branch that is lost." },
  "team-gave-back": { subject: "team", severity: "notice", audience: "operator", announced: false, meaning: "It gives back the tasks of a branch that is there again." },
  "team-handover": { subject: "team", severity: "information", audience: "operator", announced: false, meaning: "Another member shall lead." },
  "team-rejected": { subject: "team", severity: "notice", audience: "operator", announced: false, meaning: "No team has use for it." },
  "team-order-unanswered": { subject: "team", severity: "warning", audience: "integrator", announced: false, meaning: "A member has not acknowledged its order." },
  "team-order-expired": { subject: "team", severity: "notice", audience: "integrator", announced: false, meaning: "Who leads now has given no order; the old one is dropped." },
  "team-order-superseded": { subject: "team", severity: "notice", audience: "integrator", announced: false, meaning: "A newer order gives its task to another member." },
  "team-task-twice": { subject: "team", severity: "warning", audience: "operator", announced: false, meaning: "Another member executes the same task." },
  "team-task-yielded": { subject: "team", severity: "notice", audience: "operator", announced: false, meaning: "It drops a task that another member executes." },
  "team-proposed": { subject: "team", severity: "information", audience: "operator", announced: false, meaning: "It proposes an allocation to the station of the operator." },
  "allocation-proposed": { subject: "team", severity: "notice", audience: "operator", announced: true, meaning: "An allocation of a team waits for approval." },
  "allocation-over": { subject: "team", severity: "notice", audience: "operator", announced: true, meaning: "An allocation that waited is approved, rejected or withdrawn." },
  "team-task": { subject: "team", severity: "information", audience: "operator", announced: false, meaning: "It flies a task of its team." },
  "team-task-over": { subject: "team", severity: "information", audience: "operator", announced: false, meaning: "It flies the task of its team no longer." },
  "team-task-added": { subject: "team", severity: "information", audience: "operator", announced: false, meaning: "A task is added to those of a team." },
  "team-task-withdrawn": { subject: "team", severity: "notice", audience: "operator", announced: false, meaning: "A task of a team is withdrawn." },
  "team-own-id": { subject: "protocol", severity: "warning", audience: "integrator", announced: false, meaning: "Somebody sends in its own name." },
  "team-duplicate-id": { subject: "protocol", severity: "warning", audience: "integrator", announced: false, meaning: "Two members have one id; the first counts." },
  "team-other-version": { subject: "protocol", severity: "warning", audience: "integrator", announced: false, meaning: "A member speaks another version of the protocol." },
  "team-unknown-sender": { subject: "protocol", severity: "warning", audience: "integrator", announced: false, meaning: "Somebody unknown sends." },
  "team-implausible": { subject: "protocol", severity: "warning", audience: "integrator", announced: false, meaning: "A message makes no sense." },
  "team-order-refused": { subject: "protocol", severity: "warning", audience: "integrator", announced: false, meaning: "An order comes from somebody who does not lead." },
  "team-answer-refused": { subject: "protocol", severity: "warning", audience: "integrator", announced: false, meaning: "An answer comes to nothing that was asked." },
  "traffic-alert": { subject: "traffic", severity: "warning", audience: "pilot", announced: true, meaning: "An alert about another aircraft rises." },
  "clear-of-traffic": { subject: "traffic", severity: "information", audience: "pilot", announced: true, meaning: "The last alert about another aircraft is over." },
  "recommended": { subject: "traffic", severity: "notice", audience: "pilot", announced: true, meaning: "A path is recommended to the pilot." },
  "separation-lost": { subject: "traffic", severity: "warning", audience: "operator", announced: true, meaning: "Two aircraft are nearer to each other than is required; announced where one of both keeps apart." },
  "separation-restored": { subject: "traffic", severity: "notice", audience: "operator", announced: false, meaning: "Two aircraft are as far from each other again as is required." },
  "separation-not-restored": { subject: "traffic", severity: "warning", audience: "operator", announced: false, meaning: "A loss of separation lasts until the end of the run, or of one of both." },
  "neighbour-found": { subject: "radio", severity: "information", audience: "integrator", announced: false, meaning: "It receives another node." },
  "neighbour-lost": { subject: "radio", severity: "notice", audience: "integrator", announced: false, meaning: "It has not received another node for long." },
  "message-refused": { subject: "radio", severity: "warning", audience: "operator", announced: false, meaning: "It refuses a message that is not authentic." },
  "message-doubted": { subject: "radio", severity: "warning", audience: "operator", announced: false, meaning: "It accepts a message that is not authentic." },
  "attack-begins": { subject: "radio", severity: "warning", audience: "operator", announced: false, meaning: "An attacker of the radio begins." },
  "attack-ends": { subject: "radio", severity: "notice", audience: "operator", announced: false, meaning: "An attacker of the radio ends." },
  "modem-clash": { subject: "radio", severity: "warning", audience: "integrator", announced: false, meaning: "Another modem has the same address." },
  "modem-refused": { subject: "radio", severity: "warning", audience: "integrator", announced: false, meaning: "A modem refuses a datagram without a valid seal." },
  "modem-doubted": { subject: "radio", severity: "warning", audience: "integrator", announced: false, meaning: "A modem accepts a datagram without a valid seal." },
  "modem-closed": { subject: "radio", severity: "warning", audience: "integrator", announced: false, meaning: "The line to a modem cannot be opened, or is lost." },
  "modem-open": { subject: "radio", severity: "information", audience: "integrator", announced: false, meaning: "The line to a modem is open again." },
  "link-up": { subject: "vehicle", severity: "information", audience: "operator", announced: false, meaning: "The link to a vehicle or an agent in another program is up." },
  "link-lost": { subject: "vehicle", severity: "warning", audience: "operator", announced: false, meaning: "The link to a vehicle or an agent in another program is down." },
  "vehicle-identified": { subject: "vehicle", severity: "information", audience: "integrator", announced: false, meaning: "A vehicle has said what it is." },
  "vehicle-says": { subject: "vehicle", severity: "warning", audience: "operator", announced: false, meaning: "A vehicle has reported an error in words of its own." },
  "vehicle-rebooted": { subject: "vehicle", severity: "warning", audience: "operator", announced: false, meaning: "A vehicle has started anew." },
  "wrong-vehicle": { subject: "vehicle", severity: "alarm", audience: "operator", announced: true, meaning: "A vehicle is not what the scenario says." },
  "wrong-place": { subject: "vehicle", severity: "alarm", audience: "operator", announced: true, meaning: "A vehicle is not where it is to start; it is not commanded." },
  "not-heard": { subject: "vehicle", severity: "warning", audience: "operator", announced: true, meaning: "Nothing is received of a vehicle." },
  "duplicate-vehicle": { subject: "vehicle", severity: "alarm", audience: "operator", announced: false, meaning: "Two vehicles answer by one system id." },
  "clock-set": { subject: "vehicle", severity: "information", audience: "integrator", announced: false, meaning: "The clock of a vehicle was set ahead." },
  "other-clock": { subject: "vehicle", severity: "notice", audience: "integrator", announced: false, meaning: "A vehicle answers by another clock than its telemetry's." },
  "take-off-denied": { subject: "vehicle", severity: "warning", audience: "operator", announced: true, meaning: "A vehicle does not take off, or is not brought back." },
  "request-denied": { subject: "vehicle", severity: "warning", audience: "operator", announced: false, meaning: "A vehicle denies a request." },
  "not-commandable": { subject: "vehicle", severity: "alarm", audience: "operator", announced: true, meaning: "A vehicle flies and cannot be commanded; it is sent back." },
  "not-brought-back": { subject: "vehicle", severity: "alarm", audience: "operator", announced: true, meaning: "A vehicle that cannot be commanded takes no order to return." },
  "pilot-took-over": { subject: "vehicle", severity: "notice", audience: "operator", announced: false, meaning: "A safety pilot flies a vehicle." },
  "mode-changed": { subject: "vehicle", severity: "notice", audience: "operator", announced: false, meaning: "A vehicle is in a mode in which it is left alone." },
  "handed-back": { subject: "vehicle", severity: "notice", audience: "operator", announced: false, meaning: "A vehicle may be commanded again." },
  "position-old": { subject: "vehicle", severity: "warning", audience: "operator", announced: false, meaning: "The last position of a vehicle is too old to command it by." },
  "position-lost": { subject: "vehicle", severity: "warning", audience: "operator", announced: false, meaning: "A vehicle has no position by satellites any more." },
  "position-jumped": { subject: "vehicle", severity: "warning", audience: "operator", announced: false, meaning: "The position of a vehicle has jumped." },
  "position-back": { subject: "vehicle", severity: "notice", audience: "operator", announced: false, meaning: "The position of a vehicle is good again." },
  "fence-uploaded": { subject: "vehicle", severity: "information", audience: "operator", announced: false, meaning: "A vehicle has taken the no-fly zones as its fence." },
  "fence-refused": { subject: "vehicle", severity: "warning", audience: "operator", announced: false, meaning: "A vehicle has not taken the no-fly zones as its fence." },
  "autopilot-heard": { subject: "program", severity: "information", audience: "integrator", announced: false, meaning: "An outside autopilot answers." },
  "autopilot-silent": { subject: "program", severity: "warning", audience: "operator", announced: false, meaning: "An outside autopilot answers no more." },
  "autopilot-back": { subject: "program", severity: "notice", audience: "operator", announced: false, meaning: "An outside autopilot answers again." },
  "autopilot-ended": { subject: "program", severity: "warning", audience: "operator", announced: false, meaning: "The program of an outside autopilot has ended." },
  "autopilot-restarted": { subject: "program", severity: "notice", audience: "operator", announced: false, meaning: "The program of an outside autopilot was started again." },
  "flight-model-heard": { subject: "program", severity: "information", audience: "integrator", announced: false, meaning: "An outside flight model sends motion." },
  "flight-model-silent": { subject: "program", severity: "warning", audience: "operator", announced: false, meaning: "An outside flight model sends no motion." },
  "flight-model-back": { subject: "program", severity: "notice", audience: "operator", announced: false, meaning: "An outside flight model sends motion again." },
  "flight-model-reset": { subject: "program", severity: "notice", audience: "operator", announced: false, meaning: "An outside flight model begins anew." },
  "flight-model-ended": { subject: "program", severity: "warning", audience: "operator", announced: false, meaning: "The program of an outside flight model has ended." },
  "flight-model-restarted": { subject: "program", severity: "notice", audience: "operator", announced: false, meaning: "The program of an outside flight model was started again." },
  "agent-restarted": { subject: "program", severity: "warning", audience: "operator", announced: false, meaning: "The agent of an entity in another program has started anew." },
  "wrong-agent": { subject: "program", severity: "warning", audience: "operator", announced: false, meaning: "An agent in another program is of another run or entity." },
  "duplicate-agent": { subject: "program", severity: "warning", audience: "operator", announced: false, meaning: "Two agents say that they are one entity." },
  "world-joined": { subject: "program", severity: "information", audience: "integrator", announced: false, meaning: "An agent in a program of its own has joined the world." },
  "world-lost": { subject: "program", severity: "warning", audience: "operator", announced: false, meaning: "An agent in a program of its own does not receive the world." },
  "world-back": { subject: "program", severity: "notice", audience: "operator", announced: false, meaning: "An agent in a program of its own receives the world again." },
  "world-restarted": { subject: "program", severity: "warning", audience: "operator", announced: false, meaning: "The world of an agent has started anew." },
  "world-refused": { subject: "program", severity: "warning", audience: "operator", announced: false, meaning: "The world refuses an agent." },
  "update-refused": { subject: "memory", severity: "notice", audience: "researcher", announced: false, meaning: "A virtual sensor saw a remembered object, which does not refresh the memory." },
  "unknown-object-interaction": { subject: "memory", severity: "warning", audience: "researcher", announced: false, meaning: "A virtual aircraft was in or near an object of which nobody knew." },
  "forgotten": { subject: "memory", severity: "notice", audience: "researcher", announced: false, meaning: "An object is forgotten: too old, or not where it was remembered." },
  "non-actual-observation": { subject: "memory", severity: "warning", audience: "researcher", announced: false, meaning: "Somebody relied on an object that was no longer where it was remembered." },
  "plugin": { subject: "plugin", severity: "information", audience: "integrator", announced: false, meaning: "An event of a plugin's own, or of another version of Skein, with its own name." },
} satisfies Record<string, EventKind>;
