// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/avoidance/alerting/alert_text.h"

#include <fmt/format.h>

#include <cmath>

#include "skein/geo/vec.h"

namespace skein::reasoning {
namespace {

constexpr double kSameHeight = 15;  // [m]
constexpr double kNoTurn = geo::radians(1);
constexpr double kNoClimb = 0.1;  // [m/s]

int clock_hour(double bearing) {
  const int hour = static_cast<int>(std::lround(geo::degrees(bearing) / 30));
  return (hour + 11) % 12 + 1;
}

std::string distance_text(double distance) {
  return distance < 1000 ? fmt::format("{:.0f} m", 10 * std::round(distance / 10))
                         : fmt::format("{:.1f} km", distance / 1000);
}

std::string height_text(double height) {
  if (std::abs(height) < kSameHeight) return "same altitude";
  return fmt::format("{:.0f} m {}", 10 * std::round(std::abs(height) / 10),
                     height > 0 ? "above" : "below");
}

std::string advice_text(const TrafficAlert& alert, double track, double vertical_speed) {
  if (alert.track_advised) {
    const double turn = geo::wrap_pi(*alert.track_advised - track);
    if (std::abs(turn) > kNoTurn) {
      const long degrees =
          std::lround(geo::degrees(geo::wrap_2pi(*alert.track_advised))) % 360;
      return fmt::format(", turn {} {:03d}", turn > 0 ? "right" : "left", degrees);
    }
  }
  if (alert.vertical_speed_advised &&
      std::abs(*alert.vertical_speed_advised - vertical_speed) > kNoClimb) {
    const double advised = *alert.vertical_speed_advised;
    if (std::abs(advised) <= kNoClimb) return ", level off";
    return fmt::format(", {} {:.1f} m/s", advised > 0 ? "climb" : "descend",
                       std::abs(advised));
  }
  if (alert.speed_advised) return fmt::format(", fly {:.0f} m/s", *alert.speed_advised);
  return {};
}

}  // namespace

std::string spoken(const TrafficAlert& alert, double track, double vertical_speed) {
  return fmt::format("traffic, {} o'clock, {}, {}{}", clock_hour(alert.bearing),
                     distance_text(alert.distance), height_text(alert.height),
                     advice_text(alert, track, vertical_speed));
}

}  // namespace skein::reasoning
