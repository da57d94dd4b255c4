// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/avoidance/encounter/flight_envelope.h"

#include <algorithm>
#include <cmath>

#include "skein/base/math.h"
#include "skein/layer/reasoning/avoidance/encounter/plan_parts.h"
#include "skein/model/path/flight_plan.h"

namespace skein::reasoning {
namespace {

constexpr double kLeaf = 4;             // of a box of the tree, where it is not cut [s]
constexpr std::size_t kMaxLeaves = 64;  // of a tree
constexpr double kRoom = 0.5;           // more than first_encounter() may be off [m]

// How far a part of an element of length h gets from its chord, at most [m].
Vec3 bulge(const FlightElement& e, double h) {
  const double across =
      std::min(e.airspeed * std::abs(e.turn_rate) * h * h / 8, e.airspeed * h / 2);
  return {across, across, std::abs(e.climb_acceleration) * h * h / 8};
}

}  // namespace

FlightEnvelope::Box::Box()
    : low(Vec3::Constant(math::kInfinity)), high(Vec3::Constant(-math::kInfinity)) {}

void FlightEnvelope::Box::include(const Box& other) {
  low = low.cwiseMin(other.low);
  high = high.cwiseMax(other.high);
}

FlightEnvelope::FlightEnvelope(double from, double until)
    : from_(from), until_(until), leaves_(1) {
  while (leaves_ < kMaxLeaves && (until - from) / static_cast<double>(leaves_) > kLeaf)
    leaves_ *= 2;
  boxes_.resize(2 * leaves_);
}

// Around the part of a flight within some time; empty where there is none.
FlightEnvelope::Box FlightEnvelope::box_of(const FlightPlan& flight, double from,
                                           double until) {
  Box box;
  for (auto e = from_time(flight, from); e != flight.end() && e->start < until; ++e) {
    const double begin = std::max(from, e->start), end = std::min(until, end_of(*e));
    const Vec3 one = model::position(*e, begin - e->start);
    const Vec3 other = model::position(*e, end - e->start);
    const Vec3 room = bulge(*e, end - begin);
    Box part;
    part.low = one.cwiseMin(other) - room;
    part.high = one.cwiseMax(other) + room;
    box.include(part);
  }
  return box;
}

void FlightEnvelope::add(const FlightPlan& flight) {
  const double step = (until_ - from_) / static_cast<double>(leaves_);
  for (std::size_t k = 0; k < leaves_; ++k) {
    const double from = from_ + step * static_cast<double>(k);
    boxes_[leaves_ + k].include(box_of(flight, from, from + step));
  }
  for (std::size_t k = leaves_ - 1; k > 0; --k) {
    boxes_[k] = boxes_[2 * k];
    boxes_[k].include(boxes_[2 * k + 1]);
  }
}

bool FlightEnvelope::may_meet(const FlightPlan& other,
                              const Separation& separation) const {
  return !other.empty() && may_meet(1, from_, until_, other, separation);
}

bool FlightEnvelope::may_meet(std::size_t node, double from, double until,
                              const FlightPlan& other,
                              const Separation& separation) const {
  const Box& own = boxes_[node];
  if (own.is_empty()) return false;
  const Box theirs = box_of(other, from, until);
  if (theirs.is_empty()) return false;
  const Vec3 gap =
      (theirs.low - own.high).cwiseMax(own.low - theirs.high).cwiseMax(Vec3::Zero());
  if (gap.head<2>().norm() > separation.horizontal + kRoom ||
      gap.z() > separation.vertical + kRoom)
    return false;
  if (node >= leaves_) return true;
  const double middle = from + (until - from) / 2;
  return may_meet(2 * node, from, middle, other, separation) ||
         may_meet(2 * node + 1, middle, until, other, separation);
}

}  // namespace skein::reasoning
