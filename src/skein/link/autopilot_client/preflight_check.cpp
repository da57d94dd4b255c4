// SPDX-License-Identifier: Apache-2.0
#include "skein/link/autopilot_client/preflight_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "skein/link/mavlink/constants.h"

namespace skein::autopilot_client {
namespace {

constexpr int kFix3d = static_cast<int>(mavlink::GpsFix::k3d);
constexpr int kMinSatellites = 6;
constexpr double kMaxHdop = 2.5;
constexpr double kMaxPositionSd = 10;   // as the receiver says [m]
constexpr double kMaxPositionAge = 2;   // [s]
constexpr double kMinPositionRate = 1;  // [Hz]
constexpr double kMaxSilence = 3;       // of heartbeats [s]
constexpr double kMaxLinkTrip = 2;      // [s]
constexpr double kSteadyAfter = 10;     // a jump of position or clock [s]
constexpr double kFlightShare = 10;     // of the distance on the ground, in flight
constexpr double kMinCharge = 0.2;      // of the battery

// MAV_TYPE.
constexpr std::uint8_t kRotorcraft[] = {2, 3, 4, 13, 14, 15, 29};
constexpr std::uint8_t kWings[] = {1, 19, 20, 21, 22, 23, 24, 25};

template <std::size_t N>
bool is_one_of(std::uint8_t type, const std::uint8_t (&types)[N]) {
  return std::find(std::begin(types), std::end(types), type) != std::end(types);
}

std::string as_distance(double metres) {
  return metres < 10'000 ? fmt::format("{:.0f} m", metres)
                         : fmt::format("{:.1f} km", metres / 1000);
}

// The items of the list, each empty when it passes.

std::string check_identity(const PreflightInputs& in) {
  const bool fits =
      in.hovers ? is_one_of(in.type, kRotorcraft) : is_one_of(in.type, kWings);
  if (fits) return {};
  return fmt::format("MAV_TYPE {} is no {}", in.type,
                     in.hovers ? "multirotor" : "fixed wing");
}

std::string check_health(const PreflightInputs& in) {
  return in.emergency ? "it reports state critical or emergency" : "";
}

std::string check_clock(const PreflightInputs& in) {
  if (in.since_clock < kSteadyAfter)
    return fmt::format("it was set less than {} s ago", kSteadyAfter);
  if (in.position && in.position_age > kMaxPositionAge)
    return fmt::format(
        "its positions are {:.1f} s old when they come in, {} s are allowed",
        in.position_age, kMaxPositionAge);
  return {};
}

std::string check_position(const PreflightInputs& in) {
  const PositionQuality& q = in.quality;
  if (in.since_jump < kSteadyAfter)
    return fmt::format("it jumped less than {} s ago", kSteadyAfter);
  if (!q.receiver && !q.estimator)
    return "nothing says how good it is: no GPS_RAW_INT, and no EKF_STATUS_REPORT or "
           "ESTIMATOR_STATUS";
  if (!knows_position(q))
    return q.receiver
               ? fmt::format("it has no 3D fix (GPS_FIX_TYPE {})", q.fix)
               : fmt::format("its estimator has no absolute position (flags {:#x})",
                             *q.estimator);
  if (q.receiver && q.fix >= kFix3d) {
    if (q.satellites && *q.satellites < kMinSatellites)
      return fmt::format("{} satellites, {} are needed", *q.satellites, kMinSatellites);
    if (q.hdop && *q.hdop > kMaxHdop)
      return fmt::format("its dilution (eph) is {:.1f}, {} is allowed", *q.hdop,
                         kMaxHdop);
    if (q.sd && *q.sd > kMaxPositionSd)
      return fmt::format("its error is {:.0f} m, {} m are allowed", *q.sd,
                         kMaxPositionSd);
  }
  if (in.origin) return "it says latitude and longitude 0";
  return {};
}

std::string check_place(const PreflightInputs& in) {
  return in.position && in.start ? misplaced(*in.position, *in.start, true)
                                 : std::string();
}

std::string check_home(const PreflightInputs& in) {
  if (!in.home) return "not known (no HOME_POSITION)";
  if (!in.position || !in.start) return {};
  const double distance = geo::horizontal(*in.home - *in.position).norm();
  const double height = std::abs(in.home->z() - in.position->z());
  if (distance > in.start->max_distance)
    return fmt::format("it is {} away from the vehicle, {} are allowed",
                       as_distance(distance), as_distance(in.start->max_distance));
  if (height > in.start->max_height_error)
    return fmt::format("it is {} above or below the vehicle, {} are allowed",
                       as_distance(height), as_distance(in.start->max_height_error));
  return {};
}

std::string check_telemetry(const PreflightInputs& in) {
  if (in.position_rate < kMinPositionRate || in.since_position > kMaxPositionAge)
    return fmt::format("{:.1f} positions a second (GLOBAL_POSITION_INT), {} is needed",
                       in.since_position > kMaxPositionAge ? 0.0 : in.position_rate,
                       kMinPositionRate);
  return {};
}

std::string check_link(const PreflightInputs& in) {
  if (in.since_heartbeat > kMaxSilence)
    return fmt::format("no heartbeat for {:.1f} s", in.since_heartbeat);
  if (in.round_trip > kMaxLinkTrip)
    return fmt::format("a round trip takes {:.1f} s, {} s are allowed", in.round_trip,
                       kMaxLinkTrip);
  return {};
}

std::string check_energy(const PreflightInputs& in) {
  if (!in.charge || *in.charge >= kMinCharge) return {};
  return fmt::format("its battery has {:.0f} %, {:.0f} % are needed", *in.charge * 100,
                     kMinCharge * 100);
}

}  // namespace

bool knows_position(const PositionQuality& quality) {
  if (quality.receiver && quality.fix > 0) return quality.fix >= kFix3d;
  return quality.estimator &&
         (*quality.estimator & mavlink::estimator_bit::kAbsolutePosition) != 0;
}

std::string misplaced(const Vec3& p_N, const StartArea& start, bool on_ground) {
  const double distance = geo::horizontal(p_N - start.p_N).norm();
  const double allowed = (on_ground ? 1 : kFlightShare) * start.max_distance;
  if (distance > allowed)
    return fmt::format(
        "it is {} from its start, {} are allowed{} "
        "(vehicle.max_start_distance_m)",
        as_distance(distance), as_distance(allowed), on_ground ? "" : " in flight");
  const double height = start.p_N.z() - p_N.z();
  if (on_ground && std::abs(height) > start.max_height_error)
    return fmt::format(
        "its altitude is {} {} that of its start, {} are allowed "
        "(vehicle.max_start_height_error_m)",
        as_distance(std::abs(height)), height > 0 ? "above" : "below",
        as_distance(start.max_height_error));
  return {};
}

PreflightResult check_preflight(const PreflightInputs& in) {
  struct Item {
    const char* name;
    std::string (*check)(const PreflightInputs&);
  };
  constexpr Item kItems[] = {
      {"identity", check_identity},   {"health", check_health}, {"clock", check_clock},
      {"position", check_position},   {"place", check_place},   {"home", check_home},
      {"telemetry", check_telemetry}, {"link", check_link},     {"energy", check_energy},
  };
  PreflightResult result;
  std::uint32_t bit = 1;
  for (const Item& item : kItems) {
    const std::string why = item.check(in);
    if (!why.empty()) {
      result.failed |= bit;
      if (!result.text.empty()) result.text += "; ";
      result.text += fmt::format("{}: {}", item.name, why);
    }
    bit <<= 1;
  }
  return result;
}

}  // namespace skein::autopilot_client
