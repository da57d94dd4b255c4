// SPDX-License-Identifier: Apache-2.0
#include "skein/model/connection/connection.h"

#include <algorithm>
#include <cmath>

#include "skein/base/check.h"
#include "skein/base/math.h"
#include "skein/model/connection/plan_builder.h"
#include "skein/model/connection/words.h"
#include "skein/model/path/wind_triangle.h"

namespace skein::model {
namespace {

using words::kNever;

// The centres' distance below which the goal's path counts as irregular, in turn radii.
constexpr double kIrregular = 4;

bool finite(const Pose& pose) {
  return std::isfinite(pose.position.x()) && std::isfinite(pose.position.y()) &&
         std::isfinite(pose.course);
}

words::Problem reduced(const Pose& from, const Pose& to, const AirMotion& air) {
  const Vec2 along = geo::unit(from.course);
  const auto turned = [&](const Vec2& v) {
    return Vec2(along.dot(v), geo::cross(along, v));
  };
  words::Problem p;
  p.goal = turned(to.position - from.position) / air.turn_radius;
  p.phi = words::turned(to.course - from.course);
  p.sin_phi = math::sin(p.phi);
  p.cos_phi = math::cos(p.phi);
  p.wind = turned(air.wind) / air.airspeed;
  p.wind2 = p.wind.squaredNorm();
  return p;
}

Connection calm(const Pose& from, const Pose& to, const AirMotion& air) {
  const DubinsPath path = dubins(from, to, air.turn_radius);
  return {ConnectionStatus::kFound, path.word, false, path.parts,
          path.length() / air.airspeed};
}

// Whether the goal, seen from the air mass, is within 4 radii of the start at some time
// up to `time`.
bool irregular(const words::Problem& p, double time) {
  const double nearest = std::clamp(p.goal.dot(p.wind) / p.wind2, 0.0, time);
  return (p.goal - nearest * p.wind).squaredNorm() < kIrregular * kIrregular;
}

}  // namespace

std::string_view name_of(ConnectionStatus status) {
  switch (status) {
    case ConnectionStatus::kFound:
      return "found";
    case ConnectionStatus::kWindTooStrong:
      return "wind-too-strong";
    case ConnectionStatus::kBadInput:
      return "bad-input";
  }
  return "";
}

Connection connect(const Pose& from, const Pose& to, const AirMotion& air) {
  Connection best;
  best.time = kNever;
  const bool usable =
      finite(from) && finite(to) && std::isfinite(air.airspeed) &&
      std::isfinite(air.turn_radius) && air.wind.allFinite() && air.airspeed > 0 &&
      air.turn_radius > 0 &&
      (to.position - from.position).norm() <= words::kFarthest * air.turn_radius;
  if (!usable) return best;
  if (words::is_calm(air.wind, air.airspeed)) return calm(from, to, air);
  const words::Problem right = reduced(from, to, air);
  if (right.wind2 >= 1) {
    best.status = ConnectionStatus::kWindTooStrong;
    return best;
  }
  const words::Problem left = right.mirrored();
  double time = kNever;
  const auto take = [&](DubinsWord word, const words::Meeting& m) {
    if (!(m.time < time)) return;
    time = m.time;
    best.word = word;
    best.parts = m.parts;
  };
  take(DubinsWord::kRSR, words::equal_turns(right, time));
  take(DubinsWord::kLSL, words::equal_turns(left, time));
  take(DubinsWord::kRSL, words::opposite_turns(right, time));
  take(DubinsWord::kLSR, words::opposite_turns(left, time));
  take(DubinsWord::kRLR, words::three_turns(right, time));
  take(DubinsWord::kLRL, words::three_turns(left, time));
  SKEIN_CHECK(time < kNever, from.course, to.course, air.airspeed);
  best.status = ConnectionStatus::kFound;
  best.irregular = irregular(right, time);
  best.time = time * air.turn_radius / air.airspeed;
  return best;
}

std::optional<Pose> heading_pose(const Pose& over_ground, const AirMotion& air) {
  const auto heading = heading_for_course(over_ground.course, air.airspeed, air.wind);
  if (!heading) return std::nullopt;
  return Pose{over_ground.position, *heading};
}

void connect(std::span<const ConnectionQuery> queries, std::span<Connection> out) {
  SKEIN_CHECK(queries.size() == out.size(), queries.size(), out.size());
  for (std::size_t i = 0; i < queries.size(); ++i)
    out[i] = connect(queries[i].from, queries[i].to, queries[i].air);
}

FlightPlan to_flight_plan(const Connection& connection, const Pose& from,
                          const AirMotion& air, double start, double down) {
  if (connection.status != ConnectionStatus::kFound) return {};
  const std::array<int, 3> side = sides_of(connection.word);
  PlanBuilder plan(from, air, start, down);
  for (std::size_t i = 0; i < 3; ++i) plan.fly(connection.parts[i], side[i]);
  return plan.take();
}

}  // namespace skein::model
