// SPDX-License-Identifier: Apache-2.0
#include "skein/data/perimeter/fire_report.h"

#include <algorithm>
#include <cmath>

namespace skein {
namespace {

constexpr double kMost = 1e9;  // decimetres

std::int32_t decimetres(double metres) {
  const double all = std::isfinite(metres) ? 10 * metres : 0;
  return static_cast<std::int32_t>(std::lround(std::clamp(all, -kMost, kMost)));
}

Vec2 place_of(const BriefPlace& place) {
  return Vec2(place.north_dm, place.east_dm) / 10;
}

}  // namespace

BriefPlace brief(const Vec2& place) {
  return {decimetres(place.x()), decimetres(place.y())};
}

BriefReading brief(const FireReading& reading, Time last, bool adjacent) {
  const auto before = std::max<std::int64_t>(0, (last - reading.time).ns() / 1'000'000);
  return {static_cast<std::uint32_t>(std::min<std::int64_t>(before, UINT32_MAX)),
          brief(reading.point), reading.inside, adjacent};
}

FireReading reading_of(const FireReport& report, const BriefReading& reading,
                       EntityId aircraft) {
  return {report.time - Time::from_ns(1'000'000) * std::int64_t{reading.before_ms},
          aircraft, place_of(reading.place), report.position_sd, reading.inside};
}

FireReading reading_of(const FireReport& report, const BriefPlace& burning,
                       EntityId aircraft) {
  return {report.time, aircraft, place_of(burning), report.position_sd, true};
}

}  // namespace skein
