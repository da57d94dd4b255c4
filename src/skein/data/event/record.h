// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <variant>

#include "skein/base/id.h"
#include "skein/base/time.h"
#include "skein/data/airspace/zone_change.h"
#include "skein/data/command/command.h"
#include "skein/data/describe/describe.h"
#include "skein/data/event/event.h"
#include "skein/data/event/plugin_record.h"
#include "skein/data/event/stamped.h"
#include "skein/data/perimeter/fire.h"
#include "skein/data/perimeter/object.h"
#include "skein/data/perimeter/observation.h"
#include "skein/data/radio/message.h"
#include "skein/data/radio/radio.h"
#include "skein/data/team/mission.h"
#include "skein/data/team/separation_message.h"
#include "skein/data/team/task_reason.h"
#include "skein/data/team/team_task_report.h"
#include "skein/data/traffic/separation_loss.h"
#include "skein/data/traffic/traffic.h"
#include "skein/data/vehicle/autopilot.h"
#include "skein/data/vehicle/flight_path.h"
#include "skein/data/vehicle/payload.h"
#include "skein/data/vehicle/planner_change.h"
#include "skein/data/vehicle/vehicle.h"
#include "skein/data/vehicle/vehicle_report.h"
#include "skein/geo/polygon.h"

// What a run leaves behind: everything that a Recorder is given. All of it counts for the
// content hash.

namespace skein {

/// An entity exists. Comes before anything else about it.
struct EntityRecord {
  EntityId id;
  std::string name;
  std::string kind;  ///< "aircraft" or "station"
  EntityReality reality = {};
};

constexpr auto describe(const EntityRecord*) {
  using T = EntityRecord;
  return described<T>({"entity", "entities"}, "An aircraft or ground station.",
                      field("entity_id", &T::id, "its number"),
                      field("name", &T::name, "as the scenario has it"),
                      field("kind", &T::kind, "aircraft or station"),
                      field("", &T::reality, "physical or virtual"));
}

/// The true motion of a vehicle.
struct TruthRecord {
  Time time;
  EntityId id;
  VehicleState state;
};

constexpr auto describe(const TruthRecord*) {
  using T = TruthRecord;
  return described<T>(
      {"truth", "truth"}, "The true state of a vehicle.", field("time", &T::time, "when"),
      field("entity_id", &T::id, "whose"), field("", &T::state, "its motion and parts"));
}

/// What an autopilot believes and does.
struct EstimateRecord {
  EntityId id;
  NavEstimate nav;
  AutopilotStatus status;
};

constexpr auto describe(const EstimateRecord*) {
  using T = EstimateRecord;
  return described<T>({"estimate", "estimates"}, "What an autopilot believes and does.",
                      field("entity_id", &T::id, "whose"),
                      field("", &T::nav, "where it believes to be"),
                      field("", &T::status, "what it does"));
}

/// A message that arrived at `arrived`, or was lost then.
struct MessageRecord {
  Message message;
  Time arrived;
  std::uint32_t size_bytes = 0;  ///< as coded on the air
  bool lost = false;
  std::string said = {};  ///< of a team's message what it says; else empty
  bool copy = false;      ///< of a message to all: it was sent once, to others too
  LossCause cause = LossCause::kNone;
  MessageWay way = {};
  bool forged = false;
  std::optional<Time> read = {};  ///< its receiver's agent reads it; none: nobody does
};

constexpr auto describe(const MessageRecord*) {
  using T = MessageRecord;
  return described<T>(
      {"message", "messages"}, "A message that arrived or was lost.",
      field("", &T::message, "the message"),
      field("arrived", &T::arrived, "when it arrived, or was lost"),
      field("size_bytes", &T::size_bytes, "as coded on the air"),
      field("lost", &T::lost, "it never arrived"),
      field("said", &T::said, "of content team: what it says"),
      field("copy", &T::copy, "a further receiver's copy of a message to all"),
      field("cause", &T::cause, "why it was lost"),
      field("", &T::way, "how it went over the air"),
      field("forged", &T::forged, "it was sent by another in the name of from_id"),
      field("read", &T::read, "when its receiver's agent reads it; null: nobody does"));
}

/// The true burnt region and what an agent believes about its boundary at that time.
struct PerimeterRecord {
  Time time;
  EntityId believer;
  geo::Region truth;
  BoundaryEstimate belief;
  std::string mission = {};      ///< whose belief it is
  std::uint32_t phenomenon = 0;  ///< whose boundary: its place in the environment's list
};

constexpr auto describe(const PerimeterRecord*) {
  using T = PerimeterRecord;
  return described<T>(
      {"perimeter"}, "A true boundary and what is believed about it.",
      field("time", &T::time, "when"), field("believer_id", &T::believer, "whose belief"),
      field("truth", &T::truth, Storage::kFloats, "rings of the burnt area"),
      field("belief", &T::belief, "the boundary as believed"),
      field("mission", &T::mission, "whose belief it is"),
      field("phenomenon", &T::phenomenon, "whose boundary it is"));
}

using ObjectBeliefRecord = Stamped<ObjectBelief>;

constexpr StampedWords stamped_words(const ObjectBelief*) {
  return {{"object_belief", "object_beliefs"},
          "What a mission believes of an object.",
          "when",
          "believer_id",
          "whose belief",
          "of which object, and what"};
}

using MissionRecord = Stamped<MissionChange>;

constexpr StampedWords stamped_words(const MissionChange*) {
  return {{"mission", "missions"},
          "A mission begins, is paused, goes on or is over.",
          "when",
          "station_id",
          "that pursues it",
          "which mission, and how"};
}

/// A forecast of a boundary.
struct ForecastRecord {
  EntityId believer;
  PerimeterForecast forecast;
};

constexpr auto describe(const ForecastRecord*) {
  using T = ForecastRecord;
  return described<T>({"forecast"}, "A forecast of a boundary.",
                      field("believer_id", &T::believer, "whose"),
                      field("", &T::forecast, "of when, and what"));
}

/// A forecast of an arrival.
struct ArrivalRecord {
  EntityId believer;
  ArrivalForecast forecast;
};

constexpr auto describe(const ArrivalRecord*) {
  using T = ArrivalRecord;
  return described<T>({"arrival", "arrivals"},
                      "When a fire is believed to reach a place, as forecast.",
                      field("believer_id", &T::believer, "whose forecast"),
                      field("", &T::forecast, "where and when"));
}

/// A no-fly zone comes into force for those who have received it, or is taken back.
struct ZoneRecord {
  Time time;
  ZoneChange change;
};

constexpr auto describe(const ZoneRecord*) {
  using T = ZoneRecord;
  return described<T>({"zone", "zones"}, "A no-fly zone put into force or taken back.",
                      field("time", &T::time, "when"),
                      field("", &T::change, "which zone, and how"));
}

using PlannerRecord = Stamped<PlannerChange>;

constexpr StampedWords stamped_words(const PlannerChange*) {
  return {
      {"planner", "planners"},
      "What the planners on board make of what shall be flown, whenever that changes.",
      "from when on",
      "entity_id",
      "whose planner",
      "which planner, and what it does"};
}

using ConflictRecord = Stamped<ConflictReport>;

constexpr StampedWords stamped_words(const ConflictReport*) {
  return {{"conflict", "conflicts"},
          "A conflict between two aircraft that is over, as one of them saw it.",
          "when it was over",
          "entity_id",
          "who saw it",
          "with whom, and what was done"};
}

using VehicleReportRecord = Stamped<VehicleReport>;

constexpr StampedWords stamped_words(const VehicleReport*) {
  return {{"vehicle_report", "vehicle_reports"},
          "What a vehicle behind a link has said: all that a run is told from outside.",
          "of the step that took it in",
          "entity_id",
          "whose",
          "what it said",
          true};
}

using MissionProgressRecord = Stamped<MissionProgress>;

constexpr StampedWords stamped_words(const MissionProgress*) {
  return {{"mission_progress", "mission_progress"},
          "Where an aircraft is in its stored mission.",
          "from when on",
          "entity_id",
          "whose mission",
          "the item"};
}

/// What became of an observation in the server's memory of the physical world: the newest
/// that is remembered of an object, and not forgotten since, is what is known of it.
struct ObservationRecord {
  Time time;
  Observation observation;
  ObservationFate fate = ObservationFate::kRemembered;
};

constexpr auto describe(const ObservationRecord*) {
  using T = ObservationRecord;
  return described<T>(
      {"observation", "observations"},
      "What became of an observation in the server's memory of the physical world.",
      field("time", &T::time, "when it was taken in, refused or forgotten"),
      field("", &T::observation, "of what, by whom"),
      field("fate", &T::fate, "what became of it"));
}

using TrafficBeliefRecord = Stamped<TrafficBelief>;

constexpr StampedWords stamped_words(const TrafficBelief*) {
  return {{"traffic_track", "traffic_tracks"},
          "What is believed on board of another aircraft, once a second.",
          "when",
          "believer_id",
          "whose belief",
          "of which aircraft, and what"};
}

using TeamLeadRecord = Stamped<TeamLead>;

constexpr StampedWords stamped_words(const TeamLead*) {
  return {{"team_lead", "team_leads"},
          "Who leads a member of a team, as it believes itself.",
          "from when on",
          "entity_id",
          "which member",
          "who leads it, and why"};
}

using AlertRecord = Stamped<TrafficAlert>;

constexpr StampedWords stamped_words(const TrafficAlert*) {
  return {
      {"alert", "alerts"}, "An alert about another aircraft, whenever its level changes.",
      "from when on",      "entity_id",
      "who is alerted",    "to which aircraft, and how"};
}

using BandRecord = Stamped<FlightBands>;

constexpr StampedWords stamped_words(const FlightBands*) {
  return {{"band", "bands"},
          "What an aircraft may fly while an alert stands, once a second; none: level 0.",
          "when",
          "entity_id",
          "which aircraft",
          "what leads into conflict"};
}

using RecommendationRecord = Stamped<Recommendation>;

constexpr StampedWords stamped_words(const Recommendation*) {
  return {{"recommendation_change", "recommendations"},
          "What becomes of a path that is recommended to the pilot on board.",
          "when",
          "entity_id",
          "which aircraft",
          "which path"};
}

using TeamAllocationRecord = Stamped<TeamAllocationReport>;

constexpr StampedWords stamped_words(const TeamAllocationReport*) {
  return {{"team_allocation", "team_allocations"},
          "What becomes of an allocation of a team's tasks, as its leader says it; as "
          "its operator's station, where the leader was lost first.",
          "when",
          "entity_id",
          "who says so",
          "which allocation, and what becomes of it"};
}

using RadioUseRecord = Stamped<RadioUse>;

constexpr StampedWords stamped_words(const RadioUse*) {
  return {{"radio", "radios"}, "What the radio of an entity did since the row before.",
          "the end",           "entity_id",
          "whose radio",       "what it did"};
}

/// How well one radio heard another in a while.
struct LinkUseRecord {
  Time time;
  LinkUse use;
};

constexpr auto describe(const LinkUseRecord*) {
  using T = LinkUseRecord;
  return described<T>({"radio_link", "radio_links"},
                      "How well one radio heard another since the last such time, also "
                      "what was not for it; "
                      "arrived and lost are 0 where nothing was.",
                      field("time", &T::time, "the end"),
                      field("", &T::use, "who heard whom, and how"));
}

using FlightPathRecord = Stamped<FlightPath>;

constexpr StampedWords stamped_words(const FlightPath*) {
  return {{"flight_path", "flight_paths"},
          "How an aircraft expects to fly: said when that changes.",
          "when it was planned",
          "entity_id",
          "which aircraft",
          "where it leads"};
}

using TaskReasonRecord = Stamped<TaskReason>;

constexpr StampedWords stamped_words(const TaskReason*) {
  return {{"task_reason", "task_reasons"},
          "Why an aircraft was given its task: the terms that have decided.",
          "when",
          "entity_id",
          "who has given it",
          "to whom, and why"};
}

using TeamTaskRecord = Stamped<TeamTaskReport>;

constexpr StampedWords stamped_words(const TeamTaskReport*) {
  return {{"team_task_change", "team_tasks"},
          "How far a task of a team is: said when that changes.",
          "when",
          "entity_id",
          "which station has heard so",
          "which task, and how far it is"};
}

/// Everything that a Recorder is given. New kinds go to the end: the place in this list
/// is part of the wire form and of the content hash.
using Record = std::variant<
    EntityRecord, TruthRecord, EstimateRecord, FireReading, Crossing, MessageRecord,
    PerimeterRecord, Event, ZoneRecord, GroundObject, Detection, Footprint, RangeScan,
    CommandRecord, PluginRecord, PlannerRecord, ObjectMotion, ObjectBeliefRecord,
    MissionRecord, ForecastRecord, ArrivalRecord, VehicleReportRecord,
    MissionProgressRecord, PhysicalObject, ObservationRecord, ConflictRecord, AirTraffic,
    TrafficMotion, TrafficBeliefRecord, TeamLeadRecord, AlertRecord, BandRecord,
    RecommendationRecord, TeamAllocationRecord, RadioUseRecord, LinkUseRecord,
    FlightPathRecord, TaskReasonRecord, TeamTaskRecord, SeparationLossRecord>;

}  // namespace skein
