// SPDX-License-Identifier: Apache-2.0
#include "app/serve/map_record.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace skein::serve {
namespace {

constexpr double kPlace = 1.0 / 16;       // [m]
constexpr double kDirection = 1.0 / 512;  // of unit vectors
constexpr double kAngle = 1.0 / 4;        // [degrees]
constexpr double kCharge = 1.0 / 128;
constexpr double kAhead = 1.0 / 8;  // of paths [s]
// An aircraft that has been heard of so lately need not say when.
constexpr double kLately = 4;  // [s]
// Of true perimeters: this share of their size, at least half a metre.
constexpr double kTolerance = 1.0 / 2000;

double rounded(double value, double step) {
  return std::round(value / step) * step;
}
float rounded(float value, double step) {
  return static_cast<float>(rounded(double{value}, step));
}
Vec2 rounded(const Vec2& value, double step) {
  return {rounded(value.x(), step), rounded(value.y(), step)};
}
Time rounded(Time time) {
  return Time::from_seconds(std::round(time.seconds()));
}

// Marks the points of the open line first..last that stay.
void keep_corners(const geo::Ring& ring, std::size_t first, std::size_t last,
                  double tolerance, std::vector<bool>& keep) {
  std::vector<std::pair<std::size_t, std::size_t>> open = {{first, last}};
  while (!open.empty()) {
    const auto [from, to] = open.back();
    open.pop_back();
    const Vec2& a = ring[from];
    const Vec2 chord = ring[to % ring.size()] - a;
    double worst = tolerance;
    std::size_t at = from;
    for (std::size_t i = from + 1; i < to; ++i) {
      const Vec2 p = ring[i] - a;
      const double along =
          std::clamp(p.dot(chord) / std::max(chord.squaredNorm(), 1e-12), 0.0, 1.0);
      const double off = (p - along * chord).norm();
      if (off > worst) {
        worst = off;
        at = i;
      }
    }
    if (at == from) continue;
    keep[at] = true;
    open.push_back({from, at});
    open.push_back({at, to});
  }
}

geo::Ring coarse(const geo::Ring& ring) {
  double size = 0;
  for (const Vec2& p : ring)
    size = std::max(size, (p - ring.front()).lpNorm<Eigen::Infinity>());
  geo::Ring out = simplified(ring, std::max(0.5, kTolerance * size));
  for (Vec2& p : out) p = rounded(p, kPlace);
  return out;
}

void coarsen(BoundaryEstimate& boundary) {
  for (auto& ring : boundary.rings)
    for (BoundaryPoint& p : ring)
      p = {rounded(p.position, kPlace),
           rounded(p.normal, kDirection),
           rounded(p.sigma, kPlace),
           0,
           0,
           Vec2::Zero()};
}

struct ForMap {
  using Shown = std::optional<Record>;

  // As they are.
  Shown operator()(const EntityRecord& r) const { return r; }
  Shown operator()(const Event& r) const { return r; }
  Shown operator()(const CommandRecord& r) const { return r; }
  Shown operator()(const ZoneRecord& r) const { return r; }
  Shown operator()(const GroundObject& r) const { return r; }
  Shown operator()(const AirTraffic& r) const { return r; }
  Shown operator()(const MissionRecord& r) const { return r; }
  Shown operator()(const ArrivalRecord& r) const { return r; }
  Shown operator()(const AlertRecord& r) const { return r; }
  Shown operator()(const RecommendationRecord& r) const { return r; }
  // Orders only: of others a map shows nothing.
  Shown operator()(const MessageRecord& r) const {
    if (r.lost || !std::holds_alternative<Task>(r.message.content)) return {};
    return r;
  }

  Shown operator()(FireReading r) const {
    r.point = rounded(r.point, kPlace);
    r.point_sd = 0;
    return r;
  }
  Shown operator()(Crossing r) const {
    r.point = rounded(r.point, kPlace);
    r.track = Vec2::Zero();
    r.point_sd = 0;
    return r;
  }
  Shown operator()(Detection r) const {
    r.point = rounded(r.point, kPlace);
    r.point_sd = 0;
    return r;
  }
  Shown operator()(Footprint r) const {
    for (Vec2& corner : r.corners) corner = rounded(corner, kPlace);
    return r;
  }
  Shown operator()(ObjectMotion r) const {
    r.position = rounded(r.position, kPlace);
    r.velocity = rounded(r.velocity, kPlace);
    return r;
  }
  Shown operator()(ObjectBeliefRecord r) const {
    r.value.position = rounded(r.value.position, kPlace);
    r.value.velocity = rounded(r.value.velocity, kPlace);
    r.value.position_sd = rounded(r.value.position_sd, kPlace);
    r.value.velocity_sd = 0;
    return r;
  }
  Shown operator()(TrafficMotion r) const {
    for (int k = 0; k < 3; ++k) {
      r.position[k] = rounded(r.position[k], kPlace);
      r.velocity[k] = rounded(r.velocity[k], kPlace);
    }
    return r;
  }
  Shown operator()(TrafficBeliefRecord r) const {
    if (!r.value.firm) return {};
    for (int k = 0; k < 3; ++k) {
      r.value.position[k] = rounded(r.value.position[k], kPlace);
      r.value.velocity[k] = rounded(r.value.velocity[k], kPlace);
    }
    r.value.horizontal_sd = rounded(r.value.horizontal_sd, kPlace);
    r.value.vertical_sd = rounded(r.value.vertical_sd, kPlace);
    r.value.velocity_sd = 0;
    return r;
  }
  Shown operator()(FlightPathRecord r) const {
    for (PathPoint& p : r.value.points)
      p = {rounded(p.ahead, kAhead), rounded(p.north, kPlace), rounded(p.east, kPlace),
           rounded(p.altitude_msl, kPlace)};
    return r;
  }
  Shown operator()(PerimeterRecord r) const {
    for (geo::Ring& ring : r.truth) ring = coarse(ring);
    coarsen(r.belief);
    return r;
  }
  Shown operator()(ForecastRecord r) const {
    coarsen(r.forecast.boundary);
    return r;
  }
  template <class Other>
  Shown operator()(const Other&) const {
    return {};
  }
};

}  // namespace

geo::Ring simplified(const geo::Ring& ring, double tolerance) {
  if (ring.size() < 4 || tolerance <= 0) return ring;
  std::size_t far = 0;
  for (std::size_t i = 1; i < ring.size(); ++i)
    if ((ring[i] - ring[0]).squaredNorm() > (ring[far] - ring[0]).squaredNorm()) far = i;
  std::vector<bool> keep(ring.size(), false);
  keep[0] = keep[far] = true;
  keep_corners(ring, 0, far, tolerance, keep);
  keep_corners(ring, far, ring.size(), tolerance, keep);
  geo::Ring out;
  for (std::size_t i = 0; i < ring.size(); ++i)
    if (keep[i]) out.push_back(ring[i]);
  return out;
}

std::optional<Record> for_map(const Record& record) {
  return std::visit(ForMap{}, record);
}

FleetFrame for_map(FleetFrame frame) {
  for (VehicleView& v : frame.vehicles) {
    VehicleView shown;
    shown.id = v.id;
    shown.north = rounded(v.north, kPlace);
    shown.east = rounded(v.east, kPlace);
    shown.altitude_msl = rounded(v.altitude_msl, kPlace);
    shown.velocity_north = rounded(v.velocity_north, kPlace);
    shown.velocity_east = rounded(v.velocity_east, kPlace);
    shown.climb = rounded(v.climb, kPlace);
    shown.heading_deg = rounded(v.heading_deg, kAngle);
    shown.charge = rounded(v.charge, kCharge);
    if (v.heard && (frame.time - *v.heard).seconds() > kLately)
      shown.heard = rounded(*v.heard);
    shown.mode = v.mode;
    shown.failsafe = v.failsafe;
    shown.reaction = v.reaction;
    shown.on_ground = v.on_ground;
    v = shown;
  }
  return frame;
}

TruthFrame for_map(TruthFrame frame) {
  for (TruePlace& p : frame.places) {
    p.north = rounded(p.north, kPlace);
    p.east = rounded(p.east, kPlace);
    p.altitude_msl = rounded(p.altitude_msl, kPlace);
    p.heading_deg = rounded(p.heading_deg, kAngle);
  }
  return frame;
}

}  // namespace skein::serve
