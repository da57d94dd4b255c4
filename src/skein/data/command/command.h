// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "skein/base/time.h"
#include "skein/data/airspace/zone_change.h"
#include "skein/data/describe/describe.h"
#include "skein/data/team/task.h"
#include "skein/data/vehicle/vehicle_request.h"
#include "skein/geo/vec.h"

// What whoever steers a run may ask for: an operator, a scenario, a page, another
// program. Aircraft are named as the scenario names them.

namespace skein {

/// One aircraft shall do this, until the mission has it again (MissionCommand).
struct TaskCommand {
  std::string aircraft;
  TaskKind what = Loiter{};
  /// Names of those that the task is about, in the order of its entities: the leader, the
  /// two that a relay is between. Empty: `what` has their numbers.
  std::vector<std::string> others = {};
  /// With a plan to be flown; who reads commands loads it into `what`. Empty: it is
  /// there.
  std::string file = {};
};

constexpr auto describe(const TaskCommand*) {
  using T = TaskCommand;
  return described<T>({"task"}, "One aircraft shall do this until the mission resumes.",
                      field("aircraft", &T::aircraft, "who"),
                      field("what", &T::what, Storage::kJson, "what to do"),
                      field("others", &T::others, Storage::kJson,
                            "names of those it is about; empty: it has their numbers"),
                      field("file", &T::file, "with the plan of a fly_plan"));
}

/// What becomes of a mission.
enum class MissionAction : std::uint8_t {
  kPause,   ///< it gives no more orders, its aircraft circle where they are
  kResume,  ///< it goes on and has all its aircraft again, the operator's too
  kStart,   ///< it begins now, whatever its own condition is
  kEnd,     ///< it is over, its aircraft are free
};
constexpr auto names_of(const MissionAction*) {
  return std::to_array<std::string_view>({"pause", "resume", "start", "end"});
}

/// A mission, or all of them, is paused, goes on, begins or ends.
struct MissionCommand {
  MissionAction action = MissionAction::kPause;
  std::string mission = {};  ///< its name; empty: all
};

constexpr auto describe(const MissionCommand*) {
  using T = MissionCommand;
  return described<T>({"mission"}, "A mission is paused, goes on, begins or ends.",
                      field("action", &T::action, "what becomes of it"),
                      field("mission", &T::mission, "its name; empty: all"));
}

/// Simulated time stands still, or goes on.
struct PauseCommand {
  bool paused = true;
};

constexpr auto describe(const PauseCommand*) {
  using T = PauseCommand;
  return described<T>({"pause"}, "Simulated time stands still, or goes on.",
                      field("paused", &T::paused, "it stands still"));
}

/// Of a run that stands still: this many steps, then it stands still again.
struct StepCommand {
  std::uint32_t steps = 1;
};

constexpr auto describe(const StepCommand*) {
  using T = StepCommand;
  return described<T>({"step"}, "A paused run makes some steps.",
                      field("steps", &T::steps, "of the run"));
}

/// How fast simulated time goes.
struct SpeedCommand {
  double factor = 0;  ///< simulated over wall time; 0: as fast as possible
};

constexpr auto describe(const SpeedCommand*) {
  using T = SpeedCommand;
  return described<T>(
      {"speed"}, "How fast simulated time goes.",
      field("factor", &T::factor, "simulated over wall time; 0: as fast as possible"));
}

/// A part of a simulated aircraft fails, or works again.
struct FaultCommand {
  std::string aircraft;
  std::string part;  ///< "motor 1", "sensor imu", "battery", "link"...
  bool fails = true;
};

constexpr auto describe(const FaultCommand*) {
  using T = FaultCommand;
  return described<T>({"fault"}, "A part of an aircraft fails, or works again.",
                      field("aircraft", &T::aircraft, "whose part"),
                      field("part", &T::part, "as in the events of failures"),
                      field("fails", &T::fails, "else it works again"));
}

/// The true mean wind is this much off the scenario's, everywhere from now on.
struct WindCommand {
  Vec2 added = Vec2::Zero();  ///< velocity of the air [m/s]
};

constexpr auto describe(const WindCommand*) {
  using T = WindCommand;
  return described<T>({"wind"}, "The true mean wind changes everywhere.",
                      field("", &T::added, axes::kWind, "on top of the scenario's"));
}

/// An aircraft of the scenario that takes no part joins now.
struct AddCommand {
  std::string aircraft;
};

constexpr auto describe(const AddCommand*) {
  return described<AddCommand>({"add"}, "An aircraft of the scenario joins now.",
                               field("aircraft", &AddCommand::aircraft, "who"));
}

/// An aircraft takes no further part.
struct RemoveCommand {
  std::string aircraft;
};

constexpr auto describe(const RemoveCommand*) {
  return described<RemoveCommand>({"remove"}, "An aircraft takes no further part.",
                                  field("aircraft", &RemoveCommand::aircraft, "who"));
}

/// The task that an aircraft has is paused, goes on, is cancelled, or another gets what
/// is left of it.
struct TaskChangeCommand {
  std::string aircraft;
  TaskAction action = TaskAction::kPause;
  std::string to = {};  ///< of a cancelled task: who goes on with it; empty: nobody
};

constexpr auto describe(const TaskChangeCommand*) {
  using T = TaskChangeCommand;
  return described<T>({"change_task"},
                      "The task of an aircraft is paused, resumed, cancelled, or another "
                      "gets what is left of it.",
                      field("aircraft", &T::aircraft, "whose task"),
                      field("action", &T::action, "what becomes of it"),
                      field("to", &T::to, "who goes on with it; empty: nobody"));
}

/// What a program outside asks of an aircraft by MAVLink; for agents that fly by it.
struct VehicleCommand {
  std::string aircraft;
  VehicleRequest request = ModeRequest{};
};

constexpr auto describe(const VehicleCommand*) {
  using T = VehicleCommand;
  return described<T>({"vehicle"}, "What a program outside asks of an aircraft.",
                      field("aircraft", &T::aircraft, "who"),
                      field("request", &T::request, Storage::kJson, "what"));
}

/// What becomes of an allocation that a team has proposed.
enum class AllocationAction : std::uint8_t {
  kApprove,  ///< it comes into force
  kReject,   ///< what is in force stays
};
constexpr auto names_of(const AllocationAction*) {
  return std::to_array<std::string_view>({"approve", "reject"});
}

/// An allocation that a team has proposed to its operator comes into force, or does not.
struct AllocationCommand {
  AllocationAction action = AllocationAction::kApprove;
  std::uint32_t number = 0;  ///< of the proposal, from 1; 0: the one that waits
  std::string station = {};  ///< whose team; empty: of every station
};

constexpr auto describe(const AllocationCommand*) {
  using T = AllocationCommand;
  return described<T>({"allocation"},
                      "An allocation that a team has proposed comes into force, or not.",
                      field("action", &T::action, "what becomes of it"),
                      field("number", &T::number, "of the proposal; 0: that waits"),
                      field("station", &T::station, "whose team; empty: of all"));
}

/// How high and how fast an aircraft flies whatever it is given, from now on.
struct FlightChangeCommand {
  std::string aircraft;
  std::optional<double> altitude_agl = std::nullopt;  ///< [m]; none: as before
  std::optional<double> airspeed = std::nullopt;      ///< [m/s]; none: as before
};

constexpr auto describe(const FlightChangeCommand*) {
  using T = FlightChangeCommand;
  return described<T>({"change_flight"},
                      "How high and how fast an aircraft flies from now on.",
                      field("aircraft", &T::aircraft, "who"),
                      field("altitude_agl", &T::altitude_agl, unit::kMetre,
                            "above the ground; null: as before"),
                      field("airspeed", &T::airspeed, unit::kMetrePerSecond,
                            "at cruise; null: as before"));
}

/// What becomes of a task of a team that leads itself.
enum class TeamTaskAction : std::uint8_t {
  kAdd,       ///< there is one more
  kWithdraw,  ///< it is not flown, or not any more
  kChange,    ///< another one is flown in its place
};
constexpr auto names_of(const TeamTaskAction*) {
  return std::to_array<std::string_view>({"add", "withdraw", "change"});
}

/// A team that leads itself gets one more task, another one in the place of one, or one
/// less.
struct TeamTaskCommand {
  TeamTaskAction action = TeamTaskAction::kAdd;
  std::uint32_t number = 0;  ///< which is withdrawn or changed, from 1
  TaskKind what = Hold{};    ///< what is to be done; of no use for kWithdraw
  /// As in TaskCommand: names of those that `what` is about.
  std::vector<std::string> others = {};
  std::vector<std::uint32_t> after = {};  ///< kAdd: tasks that are over before it begins
  bool group = false;                     ///< kAdd: several may fly it at once
  std::string station = {};               ///< whose team; empty: of every station
};

constexpr auto describe(const TeamTaskCommand*) {
  using T = TeamTaskCommand;
  return described<T>(
      {"change_team_task"},
      "A task of a team that leads itself is added, withdrawn or changed.",
      field("action", &T::action, "what becomes of it"),
      field("number", &T::number, "which is withdrawn or changed"),
      field("what", &T::what, Storage::kJson, "what to do"),
      field("others", &T::others, Storage::kJson,
            "names of those it is about; empty: it has their numbers"),
      field("after", &T::after, Storage::kJson,
            "numbers of tasks that are over before one that is added"),
      field("group", &T::group, "several may fly one that is added"),
      field("station", &T::station, "whose team; empty: of all"));
}

/// An aircraft behind a link that a failsafe of its own or somebody else has taken is
/// commanded by its agent again.
struct HandBackCommand {
  std::string aircraft;
};

constexpr auto describe(const HandBackCommand*) {
  return described<HandBackCommand>(
      {"hand_back"},
      "An aircraft that was taken from its agent is commanded by it again.",
      field("aircraft", &HandBackCommand::aircraft, "who"));
}

/// An order that somebody outside gave to an aircraft was refused where it came in. It
/// changes nothing, but is an event of the aircraft.
struct RefusedCommand {
  std::string aircraft;  ///< empty: one that there is not, or all
  std::string text;      ///< who gave it, and why it was refused
};

constexpr auto describe(const RefusedCommand*) {
  using T = RefusedCommand;
  return described<T>({"refused"}, "An order of somebody outside was refused.",
                      field("aircraft", &T::aircraft, "whom it was for; empty: nobody"),
                      field("text", &T::text, "who gave it, and why it was refused"));
}

/// New kinds go to the end: the place in this list is part of the wire form.
using Command =
    std::variant<ZoneChange, TaskCommand, MissionCommand, PauseCommand, StepCommand,
                 SpeedCommand, FaultCommand, WindCommand, AddCommand, RemoveCommand,
                 TaskChangeCommand, VehicleCommand, AllocationCommand,
                 FlightChangeCommand, TeamTaskCommand, HandBackCommand, RefusedCommand>;

/// The word for a command.
std::string_view kind_of(const Command& command);

/// A command that was given, as a run keeps it.
struct CommandRecord {
  Time time;           ///< before the step that begins then
  std::string sender;  ///< "terminal", "scenario"...
  Command command;
};

constexpr auto describe(const CommandRecord*) {
  using T = CommandRecord;
  return described<T>({"command", "commands"}, "A command that somebody gave.",
                      field("time", &T::time, "it counts from this step on"),
                      field("sender", &T::sender, "who gave it"),
                      field("", &T::command, Storage::kCoded, "what was asked for"));
}

}  // namespace skein
