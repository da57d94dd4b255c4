// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <variant>
#include <vector>

#include "skein/data/describe/describe.h"
#include "skein/data/vehicle/path.h"
#include "skein/data/vehicle/pilot.h"
#include "skein/data/vehicle/plan.h"
#include "skein/geo/vec.h"

namespace skein {

/// Follow a path over ground, then circle its end.
struct FollowPath {
  Path path;
};

/// Turn to a course over ground and hold it.
struct HoldCourse {
  double course = 0;  ///< [rad]
};

/// Bank as told, from moment to moment: whoever commands closes the loop. What hovers
/// does not bank to turn and refuses.
struct HoldBank {
  double roll = 0;  ///< [rad], right positive
};

/// Circle a point.
struct Circle {
  Vec2 centre = Vec2::Zero();
  double radius = 100;    ///< [m]
  bool clockwise = true;  ///< on the map
};

/// Stay at a point: hover, or circle it as tightly as the vehicle can.
struct HoldPosition {
  Vec2 point = Vec2::Zero();
};

/// Be where the plan says when it says, then stay at its end. Altitudes are the plan's. A
/// fixed wing that is commanded an airspeed too flies the plan's line at that airspeed
/// and does not keep its times.
struct FollowPlan {
  Plan plan;
};

/// Fly through points one after the other, by straight legs, then stay at the last.
struct FlyWaypoints {
  struct Waypoint {
    Vec2 point = Vec2::Zero();
    double altitude_msl = 0;  ///< [m]
  };
  std::vector<Waypoint> points;
  int laps = 1;  ///< times around; after the last point comes the first again
};

/// From the ground to the commanded altitude.
struct TakeOff {
  double course = 0;  ///< fixed wing: of the run [rad]
};

/// Come down at a point; a fixed wing approaches on a course.
struct Land {
  Vec2 point = Vec2::Zero();
  double ground_msl = 0;                        ///< [m]
  std::optional<double> course = std::nullopt;  ///< [rad]; none: against the wind
};

/// Go to a place and stay above.
struct Return {
  std::optional<Vec2> point = std::nullopt;  ///< [m]; none: where the flight began
};

/// What the vehicle shall do now.
struct AutopilotCommand {
  std::variant<FollowPath, HoldCourse, Circle, HoldPosition, FollowPlan, FlyWaypoints,
               TakeOff, Land, Return, HoldBank>
      guidance = HoldCourse{};
  double altitude_msl = 0;  ///< [m]; for guidance that has none of its own
  std::optional<double> airspeed = std::nullopt;  ///< [m/s]; none: cruise
};

/// Where returns lead from now on, those of failsafes too, and by what route: around what
/// is forbidden.
struct ReturnRoute {
  /// One after the other, each straight from the last; at the last one it stays or lands
  /// [m]. Empty: straight to where the flight began.
  std::vector<Vec2> points;
  double ground_msl = 0;  ///< at the last one [m]

  bool operator==(const ReturnRoute&) const = default;
};

/// What has gone wrong, most severe last.
enum class FailsafeTrigger : std::uint8_t {
  kNone,
  kLink,      ///< nothing received from the ground
  kBattery,   ///< what is left is needed to get home
  kGeofence,  ///< outside the area or above the ceiling
  kGnss,      ///< no fix
  kMotor,     ///< a motor stands
  kImu,       ///< no inertial measurement: the attitude is not known
  kUnknown,   ///< of an autopilot elsewhere that does not say why
};
constexpr auto names_of(const FailsafeTrigger*) {
  return std::to_array<std::string_view>(
      {"none", "link", "battery", "geofence", "gnss", "motor", "imu", "unknown"});
}

/// What an autopilot flies by, besides satellites. Each may be fitted more than once.
enum class FlightSensor : std::uint8_t {
  kImu,
  kBarometer,
  kMagnetometer,
  kAirspeed,
  kPower,
};
constexpr auto names_of(const FlightSensor*) {
  return std::to_array<std::string_view>(
      {"imu", "barometer", "magnetometer", "airspeed", "power"});
}
inline constexpr std::size_t kFlightSensors = 5;

/// What is done about it.
enum class FailsafeReaction : std::uint8_t {
  kNone,     ///< reported, nothing more
  kHold,     ///< stay here
  kReturn,   ///< fly home, stay above
  kLand,     ///< fly home and land
  kDescend,  ///< come down here: glide or sink in circles
};
constexpr auto names_of(const FailsafeReaction*) {
  return std::to_array<std::string_view>({"none", "hold", "return", "land", "descend"});
}

/// What has become of the last command to an autopilot.
struct CommandFate {
  enum class State : std::uint8_t {
    kNone,      ///< there was none
    kPending,   ///< given, not yet answered
    kAccepted,  ///< it is flown, or was
    kRefused,   ///< it cannot be flown; what was flown before goes on
  };
  std::uint32_t number = 0;  ///< counts the commands, from 1
  State state = State::kNone;
  std::string_view reason = {};  ///< of a refusal; good until the next command
};

/// How far the autopilot is with its command, and how it flies.
struct AutopilotStatus {
  double remaining = 0;    ///< along the path [m]; 0 when there is none
  double cross_track = 0;  ///< distance to the path [m], right positive
  bool done = false;       ///< the path's end has been passed
  bool follows = false;    ///< there is a path, plan or leg: cross_track means something
  double time_error = 0;   ///< behind the plan [s], negative = ahead; 0 without plan
  Vec2 along = Vec2::Zero();  ///< unit tangent of a path, plan or leg where it is nearest
  int lap = 0;                ///< laps of FlyWaypoints that have been completed
  double altitude_msl = 0;    ///< demanded now [m]; of Skein's fixed-wing guidance only
  double airspeed = 0;        ///< demanded now [m/s]; of the same
  bool on_ground = false;     ///< it stands, as far as the autopilot knows
  FlightMode mode = FlightMode::kGuided;
  FailsafeTrigger trigger = FailsafeTrigger::kNone;
  FailsafeReaction reaction = FailsafeReaction::kNone;
  int refusals = 0;  ///< commands that could not be flown so far
  std::string_view refused =
      {};  ///< why the last of them could not; good until the next one
  /// Why its agent does not command it now, in words for people: somebody else flies it,
  /// or its position is not known. Empty while its agent does, and of what is simulated.
  /// Good until the next step. Orders given meanwhile are refused with it.
  std::string_view held = {};
  double charge = 1;   ///< left, from 0 to 1
  double reserve = 1;  ///< of it, when what it takes to get home is taken off
  /// Bit k: of FlightSensor k, which is fitted, nothing is received any more.
  std::uint8_t lost_sensors = 0;
  std::array<std::uint8_t, kFlightSensors> units{};  ///< of each, the one flown by
  std::optional<double> endurance =
      std::nullopt;  ///< flight time left at the present power [s]
};

// Without `refused` and `held`, which become events.
constexpr auto describe(const AutopilotStatus*) {
  using T = AutopilotStatus;
  return described<T>(
      {"autopilot_status"}, "What an autopilot does, and how well.",
      untabled(field("remaining", &T::remaining, unit::kMetre, "along the path")),
      field("cross_track", &T::cross_track, unit::kMetre,
            "off the path that it follows, right positive"),
      untabled(field("done", &T::done, "the path's end has been passed")),
      field("follows", &T::follows,
            "there is a path, plan or leg: cross_track means something"),
      field("time_error", &T::time_error, unit::kSecond,
            "behind its plan; 0 on paths, which have no times"),
      untabled(field("along", &T::along, axes::kDirection, "tangent of what it follows")),
      field("lap", &T::lap, "laps of its waypoints that have been completed"),
      untabled(field("demanded_altitude_msl", &T::altitude_msl, unit::kMetre,
                     "of fixed-wing guidance")),
      untabled(field("demanded_airspeed", &T::airspeed, unit::kMetrePerSecond,
                     "of fixed-wing guidance")),
      field("on_ground", &T::on_ground, "as far as it knows"),
      field("mode", &T::mode, "who flies"),
      field("failsafe", &T::trigger, "what has gone wrong"),
      field("reaction", &T::reaction, "what is done about it"),
      untabled(field("refusals", &T::refusals, "commands that could not be flown")),
      field("charge", &T::charge, "as its battery monitor says"),
      field("reserve", &T::reserve,
            "the charge less what it takes to get home; 1 while nothing is known of it"),
      field("endurance", &T::endurance, unit::kSecond,
            "flight time left at the present power; null while not known"),
      field(
          "lost_sensors", &T::lost_sensors,
          "bit k: nothing is received any more of the IMU (0), barometer, magnetometer, "
          "airspeed, power"),
      untabled(field("unit", &T::units, "of each of these, the one flown by")));
}

/// Whether the autopilot does what its agent says: no pilot, no failsafe flies or forbids
/// to take off.
constexpr bool obeys_orders(const AutopilotStatus& status) {
  if (status.on_ground && status.trigger != FailsafeTrigger::kNone) return false;
  const bool pilot =
      status.mode == FlightMode::kManual || status.mode == FlightMode::kStabilized;
  return !pilot && status.reaction == FailsafeReaction::kNone;
}

/// What is flown by instead of a sensor that is lost, for people.
constexpr std::string_view instead_of(FlightSensor sensor) {
  constexpr std::string_view kNames[] = {
      "nothing shows the attitude; motors off, surfaces at trim",
      "altitude by satellites", "heading by gyros and the flight over ground",
      "airspeed by the estimated wind, with a margin",
      "charge by the consumption so far"};
  return kNames[static_cast<std::size_t>(sensor)];
}

}  // namespace skein
