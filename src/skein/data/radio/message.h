// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "skein/base/id.h"
#include "skein/base/time.h"
#include "skein/data/airspace/zone_change.h"
#include "skein/data/describe/describe.h"
#include "skein/data/perimeter/fire.h"
#include "skein/data/perimeter/fire_report.h"
#include "skein/data/perimeter/object.h"
#include "skein/data/team/landing_message.h"
#include "skein/data/team/separation_message.h"
#include "skein/data/team/task.h"
#include "skein/data/team/team_message.h"
#include "skein/data/vehicle/vehicle.h"

namespace skein {

/// What an aircraft reports to the team about itself, once a second where the air has
/// room for it.
struct AircraftReport {
  NavEstimate nav;
  /// Said now and then, as they do not change.
  std::optional<FlightLimits> limits;
  std::uint32_t task_number = 0;  ///< the newest order that it obeys; 0 = none yet
  TaskState task_state = TaskState::kNone;
  /// False while a pilot or a failsafe flies: then orders wait.
  bool obeys = true;
  /// It has received all changes of no-fly zones up to this number.
  std::uint32_t zone_changes = 0;
  double task_share = 0;  ///< of its task that is done, from 0 to 1
  /// Until it is done [s]; none: not known, or it has no end.
  std::optional<double> task_time_to_go = std::nullopt;
  /// Until its next report, where the air has no room for more [s]; none: soon.
  std::optional<double> next_in = std::nullopt;
};

constexpr auto describe(const AircraftReport*) {
  using T = AircraftReport;
  return described<T>(
      {"report"}, "What an aircraft says about itself, once a second.",
      field("", &T::nav, "where it believes to be"),
      field("limits", &T::limits, "what it can do"),
      field("task_number", &T::task_number, "the newest order; 0: none yet"),
      field("task_state", &T::task_state, "how far it is with its task"),
      field("obeys", &T::obeys, "no pilot and no failsafe flies"),
      field("zone_changes", &T::zone_changes, "it knows all changes up to this number"),
      field("task_share", &T::task_share, "of its task that is done"),
      field("task_time_to_go", &T::task_time_to_go, unit::kSecond,
            "until its task is done; null: not known, or without end"),
      field("next_in", &T::next_in, unit::kSecond,
            "until its next report, where the air has no room for more; null: soon"));
}

/// How long an aircraft may say nothing until it is not counted on any more [s].
///
/// @param least  where reports come as often as is wanted [s]
double silence_allowed(const AircraftReport& report, double least);

/// Where an aircraft of the team is, reported by the ground station or by itself.
struct TeamPosition {
  EntityId aircraft;
  NavEstimate nav;
};

constexpr auto describe(const TeamPosition*) {
  using T = TeamPosition;
  return described<T>({"team_position"}, "Where an aircraft of the team is.",
                      field("entity_id", &T::aircraft, "which aircraft"),
                      field("", &T::nav, "where it believes to be"));
}

/// The sender is there, nothing more.
struct Heartbeat {};

constexpr auto describe(const Heartbeat*) {
  return described<Heartbeat>({"heartbeat"}, "The sender is there, nothing more.");
}

/// What a plugin's agents say to each other: Skein carries it and does not look inside.
/// `coded` is best made of a described struct by wire::encode().
struct PluginPayload {
  std::string kind;  ///< starts with the plugin's name
  std::vector<std::uint8_t> coded;
};

constexpr auto describe(const PluginPayload*) {
  using T = PluginPayload;
  return described<T>({"plugin"}, "A plugin's own value.",
                      field("plugin_kind", &T::kind, "what it is"),
                      field("coded", &T::coded, Storage::kBytes, "its bytes"));
}

/// What a message may say. New kinds go to the end: the place in this list is part of
/// the wire form.
using MessageContent =
    std::variant<FireReading, AircraftReport, Task, Heartbeat, TeamPosition, ZoneChange,
                 PluginPayload, TaskChange, TaskReport, ObjectSighting, PlanReport,
                 PlaceReport, ConflictNotice, Offers, Acceptance, Busy, GroupInvitation,
                 GroupJoining, GroupPlan, GroupAcceptance, TeamMessage, LandingReport,
                 FireReport, YieldRequest, YieldAnswer, FlightChange>;

/// As `to` of a message: all entities but the sender.
inline constexpr EntityId kEveryone{0xFFFFFFFFu};

/// A message between agents. `number` counts the sender's messages.
struct Message {
  EntityId from;
  EntityId to;
  std::uint64_t number = 0;
  Time sent;
  MessageContent content;
  /// Of a message to all, which is sent once: a further receiver's copy. Of the
  /// simulated radio, not of what is said: no part of the description.
  bool copy = false;
  /// Somebody else sent it in the name of `from`. No part of what is said either.
  bool forged = false;
};

constexpr auto describe(const Message*) {
  using T = Message;
  return described<T>({"message"}, "A message between agents.",
                      field("from_id", &T::from, "who sent it"),
                      field("to_id", &T::to, "for whom"),
                      field("number", &T::number, "counts the sender's messages"),
                      field("sent", &T::sent, "when it was sent"),
                      field("content", &T::content, Storage::kKindOnly, "what it says"));
}

/// The word for what a message says.
std::string_view kind_of(const MessageContent& content);

/// How soon a message should be sent when others wait.
enum class Urgency : std::uint8_t {
  kReport,   ///< what is said again soon: places, readings
  kCommand,  ///< what somebody is to do, and that it is done
  kSafety,   ///< what keeps aircraft apart
};

constexpr auto names_of(const Urgency*) {
  return std::to_array<std::string_view>({"report", "command", "safety"});
}

Urgency urgency_of(const MessageContent& content);

/// Bytes of a message on the air, as wire::encode() makes them.
std::size_t coded_size(const Message& message);

}  // namespace skein
