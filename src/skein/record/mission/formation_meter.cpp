#include "skein/record/mission/formation_meter.h"

#include <algorithm>
#include <cmath>

#include "skein/geo/vec.h"

namespace skein::record {
namespace {

constexpr double kInPlace = 30;  // [m]

}  // namespace

void FormationMeter::goal_changed(const MissionGoal& goal) {
  if (const auto* formation = std::get_if<FormationGoal>(&goal)) goal_ = *formation;
  // Whoever has another place from now on is on its way to it.
  for (auto& [id, flight] : flights_) flight.arrived = false;
}

void FormationMeter::moved(Time /*time*/, EntityId id, const Vec2& from, const Vec2& to) {
  if (id != goal_.leader &&
      std::count(goal_.followers.begin(), goal_.followers.end(), id) == 0)
    return;
  Flight& flight = flights_[id];
  flight.place = to;
  if (from != to) flight.course = (to - from).normalized();
}

void FormationMeter::tick(Time /*now*/) {
  for (auto one = flights_.begin(); one != flights_.end(); ++one)
    for (auto other = std::next(one); other != flights_.end(); ++other) {
      const double distance = (one->second.place - other->second.place).norm();
      apart_ = std::min(apart_.value_or(distance), distance);
    }
  const auto leader = flights_.find(goal_.leader);
  if (leader == flights_.end() || leader->second.course.isZero()) return;
  const Vec2 ahead = leader->second.course;
  for (std::size_t k = 0; k < goal_.followers.size() && k < goal_.slots.size(); ++k) {
    const auto follower = flights_.find(goal_.followers[k]);
    if (follower == flights_.end()) continue;
    const Vec2 slot = leader->second.place + goal_.slots[k].x() * ahead +
                      goal_.slots[k].y() * geo::turned_right(ahead);
    const double error = (follower->second.place - slot).norm();
    Flight& flight = follower->second;
    flight.arrived = flight.arrived || error < kInPlace;
    if (!flight.arrived) continue;
    errors_.push_back(static_cast<float>(error));
    ++flight.seconds;
    if (error < kInPlace) ++flight.in_place;
  }
}

std::vector<MissionFigure> FormationMeter::figures(Time /*now*/) const {
  std::vector<MissionFigure> all;
  if (!errors_.empty()) {
    std::vector<float> sorted = errors_;
    std::sort(sorted.begin(), sorted.end());
    double sum = 0;
    for (const float error : sorted) sum += error;
    const auto last = static_cast<double>(sorted.size() - 1);
    all.push_back({"slot_error_mean_m", sum / (last + 1)});
    all.push_back(
        {"slot_error_95_m", sorted[static_cast<std::size_t>(std::ceil(0.95 * last))]});
    all.push_back({"slot_error_max_m", sorted.back()});
  }
  double shares = 0;
  int counted = 0;
  for (const auto& [id, flight] : flights_) {
    if (flight.seconds == 0) continue;
    shares += static_cast<double>(flight.in_place) / flight.seconds;
    ++counted;
  }
  if (counted > 0) all.push_back({"in_place", shares / counted});
  if (apart_) all.push_back({"apart_min_m", *apart_});
  return all;
}

}  // namespace skein::record
