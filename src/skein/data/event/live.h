// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "skein/base/id.h"
#include "skein/base/time.h"
#include "skein/data/describe/describe.h"
#include "skein/data/describe/named_value.h"
#include "skein/data/event/record.h"
#include "skein/data/vehicle/autopilot.h"
#include "skein/data/vehicle/flight_path.h"

// What the live feed sends to those who watch a run, besides its records
// (docs/live-feed.md). Nothing of it is recorded, nor counts for the content hash.

namespace skein {

/// How far a run is, and how its clock goes.
struct RunClock {
  Time time;
  Time duration;
  double speed = 0;         ///< measured: simulated over wall time
  double wanted_speed = 0;  ///< 0: as fast as it can
  bool paused = false;
  bool over = false;         ///< the run has ended
  std::uint64_t misses = 0;  ///< steps that began too late
  std::string headline;      ///< key figures in one line
};

constexpr auto describe(const RunClock*) {
  using T = RunClock;
  return described<T>(
      {"run_clock"}, "How far a run is, and how its clock goes.",
      field("time", &T::time, "simulated"),
      field("duration", &T::duration, "when the run is over"),
      field("speed", &T::speed, "measured: simulated over wall time"),
      field("wanted_speed", &T::wanted_speed, "0: as fast as it can"),
      field("paused", &T::paused, "simulated time stands still"),
      field("over", &T::over, "the run has ended"),
      field("misses", &T::misses, "steps that began too late for real time"),
      field("headline", &T::headline, "key figures in one line"));
}

/// Where an aircraft believes to be and how it is, for a map and a table. Numbers are
/// those of its estimate, rounded to 32 bits.
struct VehicleView {
  EntityId id;
  float north = 0, east = 0, altitude_msl = 0;             ///< [m]
  float velocity_north = 0, velocity_east = 0, climb = 0;  ///< [m/s]
  float heading_deg = 0, roll_deg = 0;                     ///< [degrees]
  float position_sd = 0;                                   ///< [m]
  float cross_track = 0;                                   ///< [m]
  float time_error = 0;                                    ///< [s]
  float charge = 1;                                        ///< of 1
  std::optional<double> endurance = std::nullopt;          ///< [s]
  float age = 0;                                           ///< of the estimate [s]
  std::optional<Time> heard = std::nullopt;
  FlightMode mode = FlightMode::kGuided;
  FailsafeTrigger failsafe = FailsafeTrigger::kNone;
  FailsafeReaction reaction = FailsafeReaction::kNone;
  bool on_ground = false;
  std::uint32_t task_number = 0;  ///< of the newest order that it obeys; 0: none yet
  TaskState task_state = TaskState::kNone;
  float task_share = 0;                                  ///< that is done, of 1
  std::optional<double> task_time_to_go = std::nullopt;  ///< [s]
};

constexpr auto describe(const VehicleView*) {
  using T = VehicleView;
  return described<T>(
      {"vehicle_view"}, "Where an aircraft believes to be, and how it is.",
      field("entity_id", &T::id, "which aircraft"),
      field("north", &T::north, unit::kMetre, "of the origin"),
      field("east", &T::east, unit::kMetre, "of the origin"),
      field("altitude_msl", &T::altitude_msl, unit::kMetre, "above mean sea level"),
      field("velocity_north", &T::velocity_north, unit::kMetrePerSecond, "over ground"),
      field("velocity_east", &T::velocity_east, unit::kMetrePerSecond, "over ground"),
      field("climb", &T::climb, unit::kMetrePerSecond, "up"),
      field("heading_deg", &T::heading_deg, "of the air-relative velocity"),
      field("roll_deg", &T::roll_deg, "right wing down positive"),
      field("position_sd", &T::position_sd, unit::kMetre, "per horizontal axis"),
      field("cross_track", &T::cross_track, unit::kMetre,
            "off the path that it follows, right positive"),
      field("time_error", &T::time_error, unit::kSecond, "behind its plan"),
      field("charge", &T::charge, "left, from 0 to 1"),
      field("endurance", &T::endurance, unit::kSecond,
            "flight time left at the present power; null while not known"),
      field("age", &T::age, unit::kSecond, "of this estimate"),
      field("heard", &T::heard,
            "when a ground station heard of it last; null: never yet"),
      field("mode", &T::mode, "who flies"),
      field("failsafe", &T::failsafe, "what has gone wrong"),
      field("reaction", &T::reaction, "what is done about it"),
      field("on_ground", &T::on_ground, "as far as it knows"),
      field("task_number", &T::task_number,
            "of the newest order that it obeys, as its station has heard; 0: none yet"),
      field("task_state", &T::task_state, "how far it is with it"),
      field("task_share", &T::task_share, "that is done, from 0 to 1"),
      field("task_time_to_go", &T::task_time_to_go, unit::kSecond,
            "until it is done; null: not known, or without end"));
}

/// All aircraft that take part, at one time.
struct FleetFrame {
  Time time;
  std::vector<VehicleView> vehicles;
};

constexpr auto describe(const FleetFrame*) {
  using T = FleetFrame;
  return described<T>({"fleet_frame"}, "All aircraft that take part, at one time.",
                      field("time", &T::time, "when"),
                      field("vehicles", &T::vehicles, "in the order of their numbers"));
}

/// Where a vehicle truly is.
struct TruePlace {
  EntityId id;
  float north = 0, east = 0, altitude_msl = 0;  ///< [m]
  float heading_deg = 0;                        ///< [degrees]
};

constexpr auto describe(const TruePlace*) {
  using T = TruePlace;
  return described<T>(
      {"true_place"}, "Where a vehicle truly is.",
      field("entity_id", &T::id, "which vehicle"),
      field("north", &T::north, unit::kMetre, "of the origin"),
      field("east", &T::east, unit::kMetre, "of the origin"),
      field("altitude_msl", &T::altitude_msl, unit::kMetre, "above mean sea level"),
      field("heading_deg", &T::heading_deg, "of its forward axis"));
}

/// The truth about all aircraft, for those who may see it.
struct TruthFrame {
  Time time;
  std::vector<TruePlace> places;
};

constexpr auto describe(const TruthFrame*) {
  using T = TruthFrame;
  return described<T>({"truth_frame"}, "Where all aircraft truly are, at one time.",
                      field("time", &T::time, "when"),
                      field("places", &T::places, "in the order of their numbers"));
}

/// What somebody who watches a run may do.
enum class AccessRole : std::uint8_t {
  kViewer,      ///< sees
  kOperator,    ///< gives commands too
  kInstructor,  ///< makes faults and wind, and sees the truth, too
};
constexpr auto names_of(const AccessRole*) {
  return std::to_array<std::string_view>({"viewer", "operator", "instructor"});
}

/// Somebody who watches a run.
struct ClientView {
  std::uint32_t client = 0;  ///< counts from 1
  std::string name;
  AccessRole role = AccessRole::kViewer;
};

constexpr auto describe(const ClientView*) {
  using T = ClientView;
  return described<T>({"client_view"}, "Somebody who watches a run.",
                      field("client", &T::client, "counts from 1"),
                      field("name", &T::name, "that was given, for people"),
                      field("role", &T::role, "what they may do"));
}

/// Everybody who watches, and who of them gives commands.
struct ClientList {
  std::vector<ClientView> clients;
  std::uint32_t holder = 0;  ///< who holds control; 0: nobody
  std::uint32_t you = 0;     ///< to whom this is said
  bool truth_shown = true;   ///< to instructors
};

constexpr auto describe(const ClientList*) {
  using T = ClientList;
  return described<T>({"clients"},
                      "Everybody who watches, and who of them gives commands.",
                      field("clients", &T::clients, "in the order of their numbers"),
                      field("holder", &T::holder, "who holds control; 0: nobody"),
                      field("you", &T::you, "to whom this is said"),
                      field("truth_shown", &T::truth_shown, "instructors see the truth"));
}

/// How far a request of a client is.
enum class RequestState : std::uint8_t {
  kGiven,     ///< it waits for the next step of the run
  kAccepted,  ///< the run has obeyed
  kRefused,   ///< it cannot be obeyed, or those to whom it was given have refused
};
constexpr auto names_of(const RequestState*) {
  return std::to_array<std::string_view>({"given", "accepted", "refused"});
}

/// What becomes of a request of a client.
struct RequestReply {
  std::uint32_t number = 0;  ///< of the client's requests
  RequestState state = RequestState::kGiven;
  std::string text;  ///< why it is refused, for people
};

constexpr auto describe(const RequestReply*) {
  using T = RequestReply;
  return described<T>({"command_reply"}, "What becomes of a request of a client.",
                      field("number", &T::number, "of the client's requests"),
                      field("state", &T::state, "how far it is"),
                      field("text", &T::text, "why it is refused, for people"));
}

/// How well a mission goes, measured against the truth.
struct MetricSample {
  Time time;
  std::string mission;
  std::vector<NamedValue> values;
};

constexpr auto describe(const MetricSample*) {
  using T = MetricSample;
  return described<T>({"metric_sample"}, "How well a mission goes, by the truth.",
                      field("time", &T::time, "when"),
                      field("mission", &T::mission, "which mission; empty: the run"),
                      field("values", &T::values, "figures of docs/records.md"));
}

/// The state of a run is told from the begin on, or has been told.
struct SnapshotMark {
  bool begins = true;
};

constexpr auto describe(const SnapshotMark*) {
  return described<SnapshotMark>(
      {"snapshot"}, "The full state of a run follows, or is complete.",
      field("begins", &SnapshotMark::begins, "all that was said before is void"));
}

/// What an aircraft would do with a task: flown ahead in a world of its own, as whoever
/// asked for it is told before the task is given.
struct TaskPreview {
  std::uint32_t number = 0;  ///< of the client's request
  std::string problem;       ///< why the task cannot be flown, for people; empty: it can
  FlightPath path;
  bool done = false;       ///< the task is done within the time that is looked ahead
  double duration = 0;     ///< until then, or that is looked ahead [s]
  double length = 0;       ///< of the path over ground [m]
  double charge = 0;       ///< that it takes, of 1
  double charge_left = 0;  ///< after it
};

constexpr auto describe(const TaskPreview*) {
  using T = TaskPreview;
  return described<T>(
      {"task_preview"}, "What an aircraft would do with a task.",
      field("number", &T::number, "of the client's request"),
      field("problem", &T::problem, "why it cannot be flown; empty: it can"),
      field("", &T::path, "that would be flown"),
      field("done", &T::done, "the task is done within the time looked ahead"),
      field("duration", &T::duration, unit::kSecond, "until then, or looked ahead"),
      field("length", &T::length, unit::kMetre, "of the path over ground"),
      field("charge", &T::charge, "that it takes, from 0 to 1"),
      field("charge_left", &T::charge_left, "after it, from 0 to 1"));
}

/// A record of the run.
struct LiveRecord {
  Record record;
};

constexpr auto describe(const LiveRecord*) {
  return described<LiveRecord>({"live_record"}, "A record of the run.",
                               field("record", &LiveRecord::record, "which"));
}

/// What a live feed says. New kinds go to the end: the place in this list is part of the
/// wire form.
using LiveItem = std::variant<RunClock, FleetFrame, TruthFrame, ClientList, RequestReply,
                              MetricSample, SnapshotMark, LiveRecord, TaskPreview>;

}  // namespace skein
