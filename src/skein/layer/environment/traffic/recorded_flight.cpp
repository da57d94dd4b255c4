// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/environment/traffic/recorded_flight.h"

#include <algorithm>
#include <utility>

#include "skein/base/check.h"

namespace skein::environment {
namespace {

constexpr double kSlow = 50;   // [m/s]
constexpr double kJump = 200;  // [m]
constexpr double kFactor = 2;  // faster than it usually flies

double median_speed(const std::vector<RecordedPlace>& places) {
  std::vector<double> speeds;
  for (std::size_t k = 1; k < places.size(); ++k)
    speeds.push_back((places[k].p_N - places[k - 1].p_N).norm() /
                     (places[k].time - places[k - 1].time));
  if (speeds.empty()) return 0;
  const auto middle = speeds.begin() + static_cast<std::ptrdiff_t>(speeds.size() / 2);
  std::nth_element(speeds.begin(), middle, speeds.end());
  return *middle;
}

}  // namespace

RecordedFlight::RecordedFlight(std::vector<RecordedPlace> places,
                               const RecordedFlightOptions& options)
    : places_(std::move(places)), options_(options) {
  SKEIN_CHECK(!places_.empty());
  for (std::size_t k = 1; k < places_.size(); ++k)
    SKEIN_CHECK(places_[k - 1].time < places_[k].time, k);
  usual_speed_ = std::max(median_speed(places_), kSlow);
  state_ = {places_.front().p_N, Vec3::Zero(), TrafficPhase::kAbsent};
}

RecordedFlight::Leg RecordedFlight::leg_to(std::size_t next) const {
  const RecordedPlace &a = places_[next - 1], &b = places_[next];
  const double dt = b.time - a.time;
  if (dt > options_.gap) return Leg::kGap;
  const double reach = kJump + kFactor * usual_speed_ * dt;
  return (b.p_N - a.p_N).norm() > reach ? Leg::kJump : Leg::kFlown;
}

// On the leg to a place; over a jump that of the leg before, if it was flown.
Vec3 RecordedFlight::velocity_to(std::size_t next) const {
  if (leg_to(next) == Leg::kJump)
    return next > 1 && leg_to(next - 1) == Leg::kFlown ? velocity_to(next - 1)
                                                       : Vec3(Vec3::Zero());
  const RecordedPlace &a = places_[next - 1], &b = places_[next];
  return (b.p_N - a.p_N) / (b.time - a.time);
}

void RecordedFlight::advance(const TrafficView& view) {
  const double now = view.now.seconds();
  bool jumped = false;
  while (next_ < places_.size() && places_[next_].time <= now) {
    jumped = jumped || (next_ > 0 && leg_to(next_) == Leg::kJump);
    ++next_;
  }
  const bool at_end = next_ == places_.size() && places_.back().time == now;
  if (next_ == 0 || (next_ == places_.size() && !at_end)) {
    state_ = {next_ == 0 ? places_.front().p_N : places_.back().p_N, Vec3::Zero(),
              TrafficPhase::kAbsent};
    return;
  }
  const TrafficPhase there = jumped ? TrafficPhase::kJumped : TrafficPhase::kFlies;
  if (at_end) {
    state_ = {places_.back().p_N, state_.v_N, there};
    return;
  }
  const RecordedPlace& last = places_[next_ - 1];
  if (leg_to(next_) == Leg::kGap) {
    state_ = {last.p_N, Vec3::Zero(), TrafficPhase::kGap};
    return;
  }
  const Vec3 velocity = velocity_to(next_);
  state_ = {last.p_N + (now - last.time) * velocity, velocity, there};
}

RecordedFaults RecordedFlight::faults() const {
  RecordedFaults faults;
  for (std::size_t k = 1; k < places_.size(); ++k) {
    const Leg leg = leg_to(k);
    faults.gaps += leg == Leg::kGap ? 1 : 0;
    faults.jumps += leg == Leg::kJump ? 1 : 0;
  }
  return faults;
}

}  // namespace skein::environment
