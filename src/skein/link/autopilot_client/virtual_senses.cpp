// SPDX-License-Identifier: Apache-2.0
#include "skein/link/autopilot_client/virtual_senses.h"

#include <algorithm>
#include <cmath>

#include "skein/link/autopilot_client/request_steps.h"

namespace skein::autopilot_client {
namespace {

constexpr double kMaxRange = 650;           // of what a message can say [m]
constexpr std::uint8_t kUnknownSensor = 4;  // MAV_DISTANCE_SENSOR
constexpr std::uint8_t kBodyFrame = 12;     // MAV_FRAME_BODY_FRD

constexpr std::int64_t kGpsEpoch = 315'964'800;  // 1980-01-06, in seconds since 1970
constexpr std::int64_t kLeapSeconds = 18;        // since then
constexpr std::int64_t kMsPerWeek = std::int64_t{7} * 24 * 3600 * 1000;
constexpr double kRangeError = 2;       // that dilutions of precision are of [m]
constexpr double kVerticalShare = 1.5;  // vertical errors over horizontal ones
constexpr float kSpeedAccuracy = 0.3F;  // [m/s]

}  // namespace

mavlink::ObstacleDistance coded(const ObstacleDistances& obstacles, Time now) {
  const double range = std::clamp(obstacles.range, 0.0, kMaxRange);
  mavlink::ObstacleDistance message;
  message.time_usec = static_cast<std::uint64_t>(now.ns() / 1000);
  message.sensor_type = kUnknownSensor;
  message.increment = 360 / ObstacleDistances::kDirections;
  message.increment_f = message.increment;
  message.max_distance = static_cast<std::uint16_t>(std::lround(range * 100));
  message.frame = kBodyFrame;
  static_assert(std::tuple_size_v<decltype(message.distances)> ==
                ObstacleDistances::kDirections);
  for (std::size_t k = 0; k < obstacles.distances.size(); ++k) {
    const double distance = obstacles.distances[k];
    message.distances[k] = static_cast<std::uint16_t>(
        distance <= range ? std::lround(std::max(distance, 0.0) * 100)
                          : message.max_distance + 1);
  }
  return message;
}

mavlink::GpsInput coded(const PositionFix& fix, const geo::LocalFrame& frame,
                        std::int64_t unix_ns) {
  const std::int64_t gps_ms =
      unix_ns / 1'000'000 + (kLeapSeconds - kGpsEpoch) * std::int64_t{1000};
  const ScaledPlace place = scaled_place(fix.p_N.head<2>(), frame);
  const Eigen::Vector3f v = fix.v_N.cast<float>();
  const double across = std::sqrt(2.0) * fix.position_sd;
  mavlink::GpsInput message;
  message.time_usec = static_cast<std::uint64_t>(unix_ns / 1000);
  message.time_week = static_cast<std::uint16_t>(gps_ms / kMsPerWeek);
  message.time_week_ms = static_cast<std::uint32_t>(gps_ms % kMsPerWeek);
  message.fix_type = 3;
  message.lat = place.latitude;
  message.lon = place.longitude;
  message.alt = static_cast<float>(-fix.p_N.z());
  message.hdop = static_cast<float>(across / kRangeError);
  message.vdop = static_cast<float>(kVerticalShare * fix.position_sd / kRangeError);
  message.vn = v.x();
  message.ve = v.y();
  message.vd = v.z();
  message.speed_accuracy = kSpeedAccuracy;
  message.horiz_accuracy = static_cast<float>(across);
  message.vert_accuracy = static_cast<float>(kVerticalShare * fix.position_sd);
  message.satellites_visible = 12;
  return message;
}

}  // namespace skein::autopilot_client
