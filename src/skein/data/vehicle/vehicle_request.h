// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "skein/data/airspace/zone.h"
#include "skein/data/describe/describe.h"
#include "skein/data/vehicle/pilot.h"
#include "skein/data/vehicle/setpoint.h"
#include "skein/geo/vec.h"

// What a vehicle behind a link is asked for. A real vehicle is sent these; a simulated
// one that appears as a MAVLink vehicle receives them.

namespace skein {

/// Who flies a vehicle and by what, as far as autopilots of all makes have it in common.
enum class VehicleMode : std::uint8_t {
  kOther,       ///< none of these
  kManual,      ///< sticks move the actuators
  kStabilized,  ///< sticks say the attitude
  kHold,        ///< stays where it is
  kGuided,      ///< what it is sent from moment to moment
  kMission,     ///< its stored mission
  kTakeOff,
  kReturn,
  kLand,
};
constexpr auto names_of(const VehicleMode*) {
  return std::to_array<std::string_view>({"other", "manual", "stabilized", "hold",
                                          "guided", "mission", "take-off", "return",
                                          "land"});
}

/// It shall change its mode.
struct ModeRequest {
  VehicleMode mode = VehicleMode::kGuided;
};

constexpr auto describe(const ModeRequest*) {
  return described<ModeRequest>({"set_mode"}, "It shall change its mode.",
                                field("mode", &ModeRequest::mode, "to this"));
}

/// Its motors shall be ready to turn, or not.
struct ArmRequest {
  bool arm = true;
  bool force = false;  ///< whatever the checks say
};

constexpr auto describe(const ArmRequest*) {
  using T = ArmRequest;
  return described<T>({"arm"}, "Its motors shall be ready to turn, or not.",
                      field("arm", &T::arm, "ready"),
                      field("force", &T::force, "whatever the checks say"));
}

/// It shall take off to an altitude.
struct TakeOffRequest {
  double altitude_msl = 0;                      ///< [m]
  std::optional<double> course = std::nullopt;  ///< of the run [rad]; none: as it stands
};

constexpr auto describe(const TakeOffRequest*) {
  using T = TakeOffRequest;
  return described<T>(
      {"take_off"}, "It shall take off.",
      field("altitude_msl", &T::altitude_msl, unit::kMetre, "to climb to"),
      field("course", &T::course, unit::kDegree, "of the run; null: as it stands"));
}

/// It shall land.
struct LandRequest {
  std::optional<Vec2> point = std::nullopt;     ///< [m]; none: where it is
  double ground_msl = 0;                        ///< there [m]
  std::optional<double> course = std::nullopt;  ///< of the approach [rad]
};

constexpr auto describe(const LandRequest*) {
  using T = LandRequest;
  return described<T>(
      {"land"}, "It shall land.",
      field("", &T::point, axes::kPlace, "where; null: where it is"),
      field("ground_msl", &T::ground_msl, unit::kMetre, "there"),
      field("course", &T::course, unit::kDegree, "of the approach; null: any"));
}

/// It shall go to a place and stay: hover, or circle it.
struct FlyToRequest {
  Vec3 p_N = Vec3::Zero();                        ///< [m]
  std::optional<double> airspeed = std::nullopt;  ///< [m/s]
  double radius = 0;                              ///< of the circle [m]; 0: its own
  bool clockwise = true;                          ///< on the map
};

constexpr auto describe(const FlyToRequest*) {
  using T = FlyToRequest;
  return described<T>(
      {"fly_to"}, "It shall go to a place and stay.",
      field("", &T::p_N, axes::kPlace, "where"),
      field("airspeed", &T::airspeed, unit::kMetrePerSecond, "null: its own"),
      field("radius", &T::radius, unit::kMetre, "of the circle; 0: its own"),
      field("clockwise", &T::clockwise, "on the map"));
}

/// It shall fly at another airspeed from now on.
struct SpeedRequest {
  double airspeed = 0;  ///< [m/s]
};

constexpr auto describe(const SpeedRequest*) {
  return described<SpeedRequest>(
      {"set_speed"}, "It shall fly at another airspeed.",
      field("airspeed", &SpeedRequest::airspeed, unit::kMetrePerSecond, "from now on"));
}

/// One part of a stored mission.
struct MissionItem {
  enum class Kind : std::uint8_t {
    kTakeOff,
    kWaypoint,  ///< fly to it, and over or past it
    kHold,      ///< stay there, for `hold`, or for good where that is 0
    kSpeed,     ///< another airspeed
    kLand,      ///< at the place
    kReturn,    ///< to where it began
    kJump,      ///< go on with item `to`, `repeats` times
  };
  Kind kind = Kind::kWaypoint;
  Vec3 p_N = Vec3::Zero();  ///< [m]
  double hold = 0;          ///< [s]
  double airspeed = 0;      ///< [m/s]
  std::uint16_t to = 0;
  std::uint16_t repeats = 0;
};
constexpr auto names_of(const MissionItem::Kind*) {
  return std::to_array<std::string_view>(
      {"take-off", "waypoint", "hold", "speed", "land", "return", "jump"});
}

constexpr auto describe(const MissionItem*) {
  using T = MissionItem;
  return described<T>({"mission_item"}, "One part of a stored mission.",
                      field("kind", &T::kind, "what to do"),
                      field("", &T::p_N, axes::kPlace, "where"),
                      field("hold", &T::hold, unit::kSecond, "of a hold; 0: for good"),
                      field("airspeed", &T::airspeed, unit::kMetrePerSecond, "to fly"),
                      field("to", &T::to, "of a jump: the item to go on with"),
                      field("repeats", &T::repeats, "of a jump: how often"));
}

/// Its stored mission is replaced.
struct MissionUpload {
  std::vector<MissionItem> items;
};

constexpr auto describe(const MissionUpload*) {
  return described<MissionUpload>(
      {"upload_mission"}, "Its stored mission is replaced.",
      field("items", &MissionUpload::items, Storage::kJson, "one after the other"));
}

/// Its stored mission is flown from an item on.
struct MissionStart {
  std::uint16_t item = 0;
};

constexpr auto describe(const MissionStart*) {
  return described<MissionStart>({"start_mission"}, "Its stored mission is flown.",
                                 field("item", &MissionStart::item, "from this one on"));
}

/// What a transmitter's sticks say, sent over the link.
struct PilotRequest {
  PilotInput input;
};

constexpr auto describe(const PilotRequest*) {
  return described<PilotRequest>({"pilot"}, "What sticks say, sent over the link.",
                                 field("input", &PilotRequest::input, "the sticks"));
}

/// What stands around it in the virtual world at its altitude: the distance to it in each
/// of 72 directions, every 5 degrees from straight ahead clockwise.
struct ObstacleDistances {
  static constexpr std::size_t kDirections = 72;
  double range = 0;                                ///< looked so far [m]
  std::array<double, kDirections> distances = {};  ///< [m]; infinite: nothing in range
};

constexpr auto describe(const ObstacleDistances*) {
  using T = ObstacleDistances;
  return described<T>(
      {"obstacles"}, "What stands around it in the virtual world.",
      field("range", &T::range, unit::kMetre, "looked so far"),
      field("distances", &T::distances, Storage::kJson,
            "in metres, every 5 degrees from ahead clockwise; null: nothing in range"));
}

/// Its exclusion fence is replaced by the areas of these zones, at all altitudes: fences
/// of autopilots have none.
struct FenceUpload {
  std::vector<Zone> zones;
};

constexpr auto describe(const FenceUpload*) {
  return described<FenceUpload>(
      {"upload_fence"}, "Its exclusion fence is replaced.",
      field("zones", &FenceUpload::zones, Storage::kJson, "that it shall keep out of"));
}

/// What a satellite receiver on board would say, for a vehicle that flies without one.
struct PositionFix {
  Vec3 p_N = Vec3::Zero();  ///< [m]
  Vec3 v_N = Vec3::Zero();  ///< over ground [m/s]
  double position_sd = 1;   ///< per horizontal axis [m]
};

constexpr auto describe(const PositionFix*) {
  using T = PositionFix;
  return described<T>(
      {"position_fix"}, "What a satellite receiver on board would say.",
      field("", &T::p_N, axes::kPlace, "position"),
      field("", &T::v_N, axes::kVelocity, "over ground"),
      field("position_sd", &T::position_sd, unit::kMetre, "per horizontal axis"));
}

/// New kinds go to the end: the place in this list is part of the wire form.
using VehicleRequest =
    std::variant<ModeRequest, ArmRequest, TakeOffRequest, LandRequest, FlyToRequest,
                 BankSetpoint, TrackSetpoint, SpeedRequest, MissionUpload, MissionStart,
                 PilotRequest, ObstacleDistances, FenceUpload, PositionFix>;

}  // namespace skein
