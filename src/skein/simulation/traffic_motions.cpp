// SPDX-License-Identifier: Apache-2.0
#include "skein/simulation/traffic_motions.h"

namespace skein::simulation {
namespace {

// Beyond these a new row is recorded.
constexpr double kPlaceTolerance = 0.5;     // [m]
constexpr double kVelocityTolerance = 1.5;  // [m/s]

bool goes_on(const TrafficMotion& last, const TrafficMotion& now) {
  if (last.phase != now.phase) return false;
  if (!is_there(now.phase)) return true;
  return (last.at(now.time) - now.position).norm() < kPlaceTolerance &&
         (last.velocity - now.velocity).norm() < kVelocityTolerance;
}

}  // namespace

TrafficMotions::TrafficMotions(std::vector<WorldTraffic>& traffic)
    : traffic_(traffic), states_(traffic.size()), recorded_(traffic.size()) {}

TrafficState TrafficMotions::state_at(Time now, std::size_t k) const {
  const WorldTraffic& each = traffic_[k];
  TrafficState state = each.aircraft->state();
  if (now < each.from || now >= each.until) state.phase = TrafficPhase::kAbsent;
  return state;
}

void TrafficMotions::advance(Time now, std::span<const VisibleAircraft> visible) {
  noticed_.clear();
  for (const VisibleAircraft& each : visible)
    if (each.entity) noticed_.push_back({*each.entity, each.p_N, each.v_N});
  visible_.assign(visible.begin(), visible.end());
  for (std::size_t k = 0; k < traffic_.size(); ++k) {
    const WorldTraffic& each = traffic_[k];
    if (now >= each.from && now < each.until)
      each.aircraft->advance({now - each.from, noticed_});
    states_[k] = state_at(now, k);
    if (!is_there(states_[k].phase)) continue;
    visible_.push_back(
        {states_[k].p_N, states_[k].v_N, each.what.address, each.what.sends, {}});
  }
}

void TrafficMotions::record(Time now, Recorder& recorder) {
  for (std::size_t k = 0; k < traffic_.size(); ++k) {
    const TrafficState& state = states_[k];
    const TrafficMotion motion{now, traffic_[k].what.id, state.p_N, state.v_N,
                               state.phase};
    std::optional<TrafficMotion>& last = recorded_[k];
    if (last && goes_on(*last, motion)) continue;
    last = motion;
    recorder.record(motion);
  }
}

}  // namespace skein::simulation
