// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace skein {

/// What kinds of event are about: a section of docs/events.md each.
enum class EventSubject : std::uint8_t {
  kFlight,    ///< an aircraft, its autopilot and its sensors
  kGuidance,  ///< plans, paths and landings
  kTask,      ///< tasks of single aircraft
  kMission,   ///< missions and stations
  kZone,      ///< no-fly zones
  kFire,      ///< what is believed of a perimeter
  kTeam,      ///< teams that lead themselves
  kProtocol,  ///< messages of teams that are refused
  kTraffic,   ///< other aircraft
  kRadio,     ///< radio, attackers, modems
  kVehicle,   ///< real vehicles and their links
  kProgram,   ///< outside programs
  kMemory,    ///< memory of physical objects
  kPlugin,    ///< a plugin's own
};
constexpr auto names_of(const EventSubject*) {
  return std::to_array<std::string_view>({"flight", "guidance", "task", "mission", "zone",
                                          "fire", "team", "protocol", "traffic", "radio",
                                          "vehicle", "program", "memory", "plugin"});
}

/// How much an event matters to whom it concerns.
enum class EventSeverity : std::uint8_t {
  kInformation,  ///< all goes as it is to
  kNotice,       ///< something has changed that one may want to know
  kWarning,      ///< something fails, or is refused
  kAlarm,        ///< something is lost, or in danger
};
constexpr auto names_of(const EventSeverity*) {
  return std::to_array<std::string_view>({"information", "notice", "warning", "alarm"});
}

/// Whom an event concerns first.
enum class EventAudience : std::uint8_t {
  kOperator,    ///< who commands the run
  kPilot,       ///< who flies one aircraft, or watches its display
  kResearcher,  ///< who studies what was believed and decided
  kIntegrator,  ///< who connects radios, protocols and programs
};
constexpr auto names_of(const EventAudience*) {
  return std::to_array<std::string_view>(
      {"operator", "pilot", "researcher", "integrator"});
}

/// Kinds of event. Each has a row in the table of its subject, beside this file, in the
/// same order; what counts elsewhere is its name, so kinds may be added anywhere.
enum class EventKind : std::uint8_t {
  // An aircraft, its autopilot and its sensors: flight_events.cpp.
  kJoined,
  kLeft,
  kTookOff,
  kLanded,
  kAccident,
  kMode,
  kFailsafe,
  kRefused,
  kFailure,
  kRepaired,
  kSensorLost,
  kSensorBack,
  kSensorSwitched,
  // What is flown: plans, paths and landings: flight_events.cpp.
  kPlanned,
  kNoPlan,
  kNoPath,
  kPointLeftOut,
  kOffPlan,
  kOnPlan,
  kFlightChanged,
  kFlightRefused,
  kLandingWait,
  kLandingTurn,
  kReturnMoved,
  kSetpointsEnded,
  // Tasks of single aircraft: mission_events.cpp.
  kOrdered,
  kTask,
  kTaskRefused,
  kTaskPaused,
  kTaskResumed,
  kTaskCancelled,
  kTaskImpossible,
  kTaskDone,
  kTaskMoved,
  kTaskOver,
  kTaskGivenUp,
  kRouteDone,
  kLate,
  kArrived,
  kMeasured,
  kEdgeLost,
  kEdgeFound,
  kSurveyIncomplete,
  // Missions, and what stations do for them: mission_events.cpp.
  kMission,
  kCommandRefused,
  kAllocated,
  kSurveyed,
  kShared,
  kObjectFound,
  kObjectLost,
  kLeader,
  kLeaderLost,
  // No-fly zones: mission_events.cpp.
  kZone,
  kZoneOn,
  kZoneOff,
  kZoneRefused,
  kZonesKnown,
  // What is believed of a perimeter: mission_events.cpp.
  kCrossing,
  kNoCrossing,
  kForcedCrossing,
  kEntry,
  kAllocation,
  kSilent,
  kOutlier,
  kTooLate,
  kOverConfident,
  kTrusted,
  kHandOver,
  // Teams that lead themselves: team_events.cpp.
  kTeamSelected,
  kTeamFollowing,
  kTeamMasterLost,
  kTeamJoined,
  kTeamFollowerLost,
  kTeamMerged,
  kTeamSplit,
  kTeamTookBack,
  kTeamGaveBack,
  kTeamHandover,
  kTeamRejected,
  kTeamOrderUnanswered,
  kTeamOrderExpired,
  kTeamOrderSuperseded,
  kTeamTaskTwice,
  kTeamTaskYielded,
  kTeamProposed,
  kAllocationProposed,
  kAllocationOver,
  kTeamTask,
  kTeamTaskOver,
  kTeamTaskAdded,
  kTeamTaskWithdrawn,
  // Messages of teams that are refused: team_events.cpp.
  kTeamOwnId,
  kTeamDuplicateId,
  kTeamOtherVersion,
  kTeamUnknownSender,
  kTeamImplausible,
  kTeamOrderRefused,
  kTeamAnswerRefused,
  // Other aircraft: traffic_events.cpp.
  kTrafficAlert,
  kClearOfTraffic,
  kRecommended,
  kSeparationLost,
  kSeparationRestored,
  kSeparationNotRestored,
  // Radio, attackers and modems: traffic_events.cpp.
  kNeighbourFound,
  kNeighbourLost,
  kMessageRefused,
  kMessageDoubted,
  kAttackBegins,
  kAttackEnds,
  kModemClash,
  kModemRefused,
  kModemDoubted,
  kModemClosed,
  kModemOpen,
  // Real vehicles and their links: vehicle_events.cpp.
  kLinkUp,
  kLinkLost,
  kVehicleIdentified,
  kVehicleSays,
  kVehicleRebooted,
  kWrongVehicle,
  kWrongPlace,
  kNotHeard,
  kDuplicateVehicle,
  kClockSet,
  kOtherClock,
  kTakeOffDenied,
  kRequestDenied,
  kNotCommandable,
  kNotBroughtBack,
  kPilotTookOver,
  kModeChanged,
  kHandedBack,
  kPositionOld,
  kPositionLost,
  kPositionJumped,
  kPositionBack,
  kFenceUploaded,
  kFenceRefused,
  // Programs outside: autopilots, flight models, agents, the world: vehicle_events.cpp.
  kAutopilotHeard,
  kAutopilotSilent,
  kAutopilotBack,
  kAutopilotEnded,
  kAutopilotRestarted,
  kFlightModelHeard,
  kFlightModelSilent,
  kFlightModelBack,
  kFlightModelReset,
  kFlightModelEnded,
  kFlightModelRestarted,
  kAgentRestarted,
  kWrongAgent,
  kDuplicateAgent,
  kWorldJoined,
  kWorldLost,
  kWorldBack,
  kWorldRestarted,
  kWorldRefused,
  // Memory of physical objects: vehicle_events.cpp.
  kUpdateRefused,
  kUnknownObjectInteraction,
  kForgotten,
  kNonActualObservation,
  // Plugins: vehicle_events.cpp.
  kPlugin,
};

/// What is said of a kind of event, once.
struct EventKindRow {
  EventKind kind;
  /// Stable: databases, the page, scripts and the content hash have it. Lower case,
  /// hyphens.
  std::string_view name;
  EventSeverity severity;
  EventAudience audience;
  std::string_view meaning;       ///< one sentence
  std::string_view numbers = {};  ///< which EventNumbers it has, and what they are
  bool announced = false;         ///< whoever commands is shown it at once
};

/// The kinds of one subject.
struct EventGroup {
  EventSubject subject;
  std::string_view title;
  std::span<const EventKindRow> rows;
};

/// All kinds, by subject, in the order of EventKind.
std::span<const EventGroup> event_groups();

/// The row of a kind. Never fails.
const EventKindRow& row_of(EventKind kind);

/// What a kind is about.
EventSubject subject_of(EventKind kind);

/// What an event is called: a kind of Skein's, or a name of a plugin's own.
class EventLabel {
 public:
  // NOLINTNEXTLINE: a kind is its label
  EventLabel(EventKind kind = EventKind::kPlugin) : kind_(kind) {}

  /// The label of that name: of the kind that is called so, or was in an earlier version;
  /// otherwise of a plugin's own event. That of a plugin starts with its name.
  static EventLabel named(std::string_view name);

  /// kPlugin for all that are not Skein's.
  EventKind kind() const { return kind_; }
  std::string_view name() const { return own_.empty() ? row_of(kind_).name : own_; }

  friend bool operator==(const EventLabel& a, EventKind b) { return a.kind_ == b; }
  friend bool operator==(const EventLabel&, const EventLabel&) = default;

 private:
  EventKind kind_;
  std::string own_;  // of a plugin
};

}  // namespace skein
