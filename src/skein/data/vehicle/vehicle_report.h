// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "skein/base/id.h"
#include "skein/base/time.h"
#include "skein/data/describe/describe.h"
#include "skein/data/event/event_kind.h"
#include "skein/data/vehicle/entity_report.h"
#include "skein/data/vehicle/vehicle_request.h"
#include "skein/geo/rotation.h"
#include "skein/geo/vec.h"

// What a vehicle behind a link says. Times are of the run's clock.

namespace skein {

/// How it moves, as its own estimator has it.
struct VehicleMotion {
  Time time;  ///< when it was so
  Vec3 p_N = Vec3::Zero();
  Vec3 v_N = Vec3::Zero();       ///< over ground [m/s]
  Quat q_NB = Quat::Identity();  ///< attitude
  Vec3 w_NB_B = Vec3::Zero();    ///< rates of turn [rad/s]
  double airspeed = 0;           ///< [m/s]; 0: not measured
  Vec2 wind_N = Vec2::Zero();    ///< as it estimates it [m/s]
  double position_sd = 0;        ///< per horizontal axis [m]
  double altitude_sd = 0;        ///< [m]
};

constexpr auto describe(const VehicleMotion*) {
  using T = VehicleMotion;
  return described<T>(
      {"motion"}, "How a vehicle behind a link moves, as it says.",
      field("time", &T::time, "when it was so"),
      field("", &T::p_N, axes::kPlace, "position"),
      field("", &T::v_N, axes::kVelocity, "over ground"), field("", &T::q_NB, "attitude"),
      field("", &T::w_NB_B, axes::kBodyRates, "rates of turn"),
      field("airspeed", &T::airspeed, unit::kMetrePerSecond, "0: not measured"),
      field("", &T::wind_N, axes::kWind, "as it estimates it"),
      field("position_sd", &T::position_sd, unit::kMetre, "per horizontal axis"),
      field("altitude_sd", &T::altitude_sd, unit::kMetre, "of the altitude"));
}

/// What it does, and how it is.
struct VehicleCondition {
  bool armed = false;
  bool on_ground = true;
  bool ready = true;       ///< healthy: its checks let it arm
  bool emergency = false;  ///< as it says of itself
  VehicleMode mode = VehicleMode::kOther;
  std::string mode_name;  ///< as its make calls it
  double charge = 1;      ///< of its battery, from 0 to 1; 1 while it does not say
  double voltage = 0;     ///< [V]; 0: it does not say
  double current = 0;     ///< [A]; 0: it does not say
  bool position = false;  ///< it knows where it is

  bool operator==(const VehicleCondition&) const = default;
};

constexpr auto describe(const VehicleCondition*) {
  using T = VehicleCondition;
  return described<T>({"condition"}, "What a vehicle behind a link does, and how it is.",
                      field("armed", &T::armed, "its motors may turn"),
                      field("on_ground", &T::on_ground, "it stands"),
                      field("ready", &T::ready, "its checks let it arm"),
                      field("emergency", &T::emergency, "as it says of itself"),
                      field("mode", &T::mode, "who flies it"),
                      field("mode_name", &T::mode_name, "as its make calls it"),
                      field("charge", &T::charge, "left, from 0 to 1"),
                      field("voltage", &T::voltage, unit::kVolt, "0: it does not say"),
                      field("current", &T::current, "in ampere; 0: it does not say"),
                      field("position", &T::position, "it knows where it is"));
}

/// Something happened to the link, or to who is at its far end.
struct LinkChange {
  enum class Kind : std::uint8_t {
    kUp,         ///< the vehicle is heard, at first or again
    kDown,       ///< nothing heard of it for too long
    kRebooted,   ///< its clock went back
    kMismatch,   ///< another kind of vehicle answers than was asked for
    kDuplicate,  ///< two vehicles have its number
  };
  Kind kind = Kind::kUp;
  std::string text;  ///< for people
};
constexpr auto names_of(const LinkChange::Kind*) {
  return std::to_array<std::string_view>(
      {"up", "down", "rebooted", "mismatch", "duplicate"});
}

constexpr auto describe(const LinkChange*) {
  using T = LinkChange;
  return described<T>({"link_change"}, "Something happened to a link.",
                      field("change", &T::kind, "what"),
                      field("text", &T::text, "for people"));
}

/// What became of a request that is answered.
struct RequestAnswer {
  enum class Outcome : std::uint8_t {
    kAccepted,
    kDenied,       ///< it will not
    kUnsupported,  ///< it cannot
    kNoAnswer,     ///< repeated, and not answered
    kWithdrawn,    ///< somebody else has chosen the vehicle's mode meanwhile
  };
  std::uint32_t number = 0;  ///< as the request was numbered
  Outcome outcome = Outcome::kAccepted;
  std::string text;  ///< for people; a reason, if it gives one
};
constexpr auto names_of(const RequestAnswer::Outcome*) {
  return std::to_array<std::string_view>(
      {"accepted", "denied", "unsupported", "no answer", "withdrawn"});
}

constexpr auto describe(const RequestAnswer*) {
  using T = RequestAnswer;
  return described<T>({"answer"}, "What became of a request to a vehicle.",
                      field("number", &T::number, "of the request"),
                      field("outcome", &T::outcome, "what became of it"),
                      field("text", &T::text, "a reason, if it gave one"));
}

/// Something that it says to people.
struct VehicleText {
  std::uint8_t severity = 6;  ///< from 0, emergency, to 7, debug
  std::string text;
};

constexpr auto describe(const VehicleText*) {
  using T = VehicleText;
  return described<T>({"text"}, "Something that a vehicle says to people.",
                      field("severity", &T::severity, "0: emergency, to 7: debug"),
                      field("text", &T::text, "what"));
}

/// How it is to be commanded, as it says or as is known of its make.
struct VehicleIdentity {
  /// By what it flies along a given line.
  enum class Following : std::uint8_t {
    kPlaces,      ///< it goes to a place and stays
    kBank,        ///< it takes BankSetpoint
    kTrajectory,  ///< it takes TrackSetpoint
  };
  std::string make;      ///< "ArduPilot 4.5.7"
  std::string airframe;  ///< "fixed wing", "multirotor", ...
  bool hovers = false;
  Following following = Following::kPlaces;
};
constexpr auto names_of(const VehicleIdentity::Following*) {
  return std::to_array<std::string_view>({"places", "bank", "trajectory"});
}

constexpr auto describe(const VehicleIdentity*) {
  using T = VehicleIdentity;
  return described<T>({"identity"}, "What a vehicle behind a link is.",
                      field("make", &T::make, "of its autopilot"),
                      field("airframe", &T::airframe, "as it says"),
                      field("hovers", &T::hovers, "it can stay in one place"),
                      field("following", &T::following, "by what it flies along a line"));
}

/// How a link did since its begin. Of records only; nothing simulated depends on it.
struct LinkHealth {
  std::uint64_t received = 0;  ///< frames
  std::uint64_t lost = 0;      ///< on the way here, by the sender's count
  std::uint64_t damaged = 0;   ///< frames with a bad checksum
  std::uint64_t sent = 0;      ///< frames
  std::uint64_t dropped = 0;   ///< that could not go out in time
  double round_trip = 0;       ///< [s]; 0: not measured yet
};

constexpr auto describe(const LinkHealth*) {
  using T = LinkHealth;
  return described<T>(
      {"link_health"}, "How a link did so far.",
      field("received", &T::received, "frames"),
      field("lost", &T::lost, "frames, by the sender's count"),
      field("damaged", &T::damaged, "frames with a bad checksum"),
      field("sent", &T::sent, "frames"),
      field("dropped", &T::dropped, "frames not sent in time"),
      field("round_trip", &T::round_trip, unit::kSecond, "0: not measured yet"));
}

/// What an outside autopilot had the actuators of a plant here do in one step of the run,
/// physics step by physics step.
struct ActuatorOutputs {
  std::uint32_t channels = 0;        ///< numbers of a row, in the order of Actuators
  std::vector<float> values;         ///< row after row
  std::vector<std::uint32_t> steps;  ///< physics steps for which each row held
};

constexpr auto describe(const ActuatorOutputs*) {
  using T = ActuatorOutputs;
  return described<T>(
      {"actuator_outputs"},
      "What an outside autopilot had the actuators of a plant here do.",
      field("channels", &T::channels, "numbers of a row"),
      field("values", &T::values, Storage::kJson, "row after row"),
      field("steps", &T::steps, Storage::kJson, "physics steps for which each row held"));
}

/// Something happened to an outside autopilot that moves a plant here, or to its program.
struct OutsideEvent {
  EventLabel kind;
  std::string text;  ///< for people
};

constexpr auto describe(const OutsideEvent*) {
  using T = OutsideEvent;
  return described<T>({"outside_event"},
                      "Something happened to an outside autopilot or its program.",
                      field("event", &T::kind, "short and stable: docs/events.md"),
                      field("text", &T::text, "for people"));
}

/// What a vehicle was sent of the virtual world since the begin. Of records only; nothing
/// simulated depends on it.
struct FeedHealth {
  std::uint64_t traffic = 0;            ///< frames about other aircraft
  std::uint64_t traffic_limited = 0;    ///< left out: too soon, or too many in range
  std::uint64_t obstacles = 0;          ///< frames
  std::uint64_t obstacles_limited = 0;  ///< left out: a newer one was there
  std::uint64_t fences = 0;             ///< accepted by the vehicle
  std::uint64_t fences_refused = 0;     ///< or not answered
  std::uint64_t fixes = 0;              ///< positions, in place of a receiver's
  std::uint64_t fixes_limited = 0;      ///< left out: a newer one was there

  bool operator==(const FeedHealth&) const = default;
};

constexpr auto describe(const FeedHealth*) {
  using T = FeedHealth;
  return described<T>(
      {"feed_health"}, "What a vehicle was sent of the virtual world so far.",
      field("traffic", &T::traffic, "frames about other aircraft"),
      field("traffic_limited", &T::traffic_limited, "too soon, or too many in range"),
      field("obstacles", &T::obstacles, "frames"),
      field("obstacles_limited", &T::obstacles_limited, "a newer one was there"),
      field("fences", &T::fences, "accepted"),
      field("fences_refused", &T::fences_refused, "or not answered"),
      field("fixes", &T::fixes, "positions, in place of a receiver's"),
      field("fixes_limited", &T::fixes_limited, "a newer one was there"));
}

/// New kinds go to the end: the place in this list is part of the wire form.
using VehicleReport =
    std::variant<VehicleMotion, VehicleCondition, LinkChange, RequestAnswer, VehicleText,
                 MissionProgress, VehicleIdentity, LinkHealth, ActuatorOutputs,
                 OutsideEvent, FeedHealth, EntityReport>;

}  // namespace skein
