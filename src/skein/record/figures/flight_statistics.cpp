// SPDX-License-Identifier: Apache-2.0
#include "skein/record/figures/flight_statistics.h"

#include <algorithm>
#include <cmath>

#include "skein/record/store/ground_time.h"

namespace skein::record {

void FlightStatistics::truth(Time time, EntityId id, const VehicleState& state) {
  position_error_.truth(time, id, geo::horizontal(state.p_N), geo::horizontal(state.v_N));
  const double charge = state.energy.charge;
  min_charge_ = std::min(min_charge_.value_or(charge), charge);
  const auto landed = landed_.find(id);
  if (state.on_ground) {
    if (flown_.contains(id)) landed_[id] = time;
  } else if (landed == landed_.end()) {
    flown_.insert(id);
  } else if ((time - landed->second).seconds() >= kGroundTime) {
    landed_.erase(landed);
  }
}

void FlightStatistics::estimate(Time time, EntityId id, const Vec3& p_N,
                                std::optional<double> cross_track) {
  if (cross_track) cross_track_.add(*cross_track * *cross_track);
  position_error_.estimate(time, id, geo::horizontal(p_N));
}

void FlightStatistics::reserve(EntityId id, double reserve) {
  // Below all numbers: the wind lets it get nowhere; then there is no such reserve.
  if (reserve >= 1 || !std::isfinite(reserve)) return;
  const auto [min, first] = min_reserve_.try_emplace(id, reserve);
  if (!first) min->second = std::min(min->second, reserve);
}

void FlightStatistics::event(const Event& event) {
  switch (event.kind.kind()) {
    case EventKind::kAccident:
      ++accidents_;
      broken_.insert(event.entity);
      return;
    case EventKind::kAutopilotEnded:
    case EventKind::kFlightModelEnded:
      ++programs_ended_;
      gone_.insert(event.entity);
      return;
    case EventKind::kAutopilotRestarted:
    case EventKind::kFlightModelRestarted:
      gone_.erase(event.entity);
      return;
    case EventKind::kFailsafe:
      return failsafe(event);
    default:
      return;
  }
}

// It begins to act where nothing acted before.
void FlightStatistics::failsafe(const Event& event) {
  bool& acting = acting_[event.entity];
  const bool acts = event.numbers.value.value_or(0) > 0;
  if (acts && !acting) ++failsafes_;
  acting = acts;
}

void FlightStatistics::add_figures(
    std::map<std::string, double>& figures,
    const std::function<std::string(EntityId)>& name_of) const {
  figures["accidents"] = static_cast<double>(accidents_);
  figures["failsafes"] = static_cast<double>(failsafes_);
  const auto landed = std::ranges::count_if(
      landed_, [this](const auto& each) { return !broken_.contains(each.first); });
  if (landed > 0) figures["aircraft_landed"] = static_cast<double>(landed);
  const auto put = [&](const char* name, const Square& square) {
    if (square.count > 0) figures[name] = std::sqrt(square.sum / square.count);
  };
  put("cross_track_rms_m", cross_track_);
  if (const auto error = position_error_.rms()) figures["position_error_rms_m"] = *error;
  if (programs_ended_ > 0) {
    figures["outside_programs_ended"] = static_cast<double>(programs_ended_);
    figures["outside_programs_gone"] = static_cast<double>(gone_.size());
  }
  if (min_charge_) figures["min_charge"] = *min_charge_;
  for (const auto& [id, reserve] : min_reserve_)
    figures["min_reserve_" + name_of(id)] = reserve;
}

}  // namespace skein::record
