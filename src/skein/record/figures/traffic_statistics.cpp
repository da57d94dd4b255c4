// SPDX-License-Identifier: Apache-2.0
#include "skein/record/figures/traffic_statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace skein::record {
namespace {

constexpr double kAstraySd = 5;
constexpr double kAstray = 100;  // [m]
constexpr double kAnother = 60;  // after it was near last: another encounter [s]

double astray_beyond(const TrafficBelief& belief) {
  return kAstraySd * belief.horizontal_sd + kAstray;
}

}  // namespace

void TrafficStatistics::Encounters::see(Time time, EntityId id, std::uint32_t traffic,
                                        const Vec3& apart) {
  if (kept.ratio(apart.head<2>().norm(), std::abs(apart.z())) >= 1) return;
  const auto [at, first] = last.try_emplace({id, traffic}, time);
  if (first || (time - at->second).seconds() > kAnother) ++count;
  at->second = time;
}

void TrafficStatistics::truth(Time time, EntityId id, const VehicleState& state) {
  if (state.on_ground) return;
  for (const auto& [traffic, flown] : traffic_) {
    const TrafficMotion* motion = flown.path.at(time);
    if (!motion) continue;
    const Vec3 apart = state.p_N - motion->at(time);
    near_.see(time, id, traffic, apart);
    lost_.see(time, id, traffic, apart);
  }
}

TrafficStatistics::Error TrafficStatistics::nearest(const TrafficBeliefRecord& record,
                                                    bool by_address) const {
  constexpr double kNowhere = std::numeric_limits<double>::infinity();
  Error error{kNowhere, kNowhere};
  for (const auto& [id, flown] : traffic_) {
    if (by_address && flown.address != record.value.address) continue;
    const TrafficMotion* motion = flown.path.at(record.time);
    if (!motion) continue;
    const Vec3 off = record.value.position - motion->at(record.time);
    const double horizontal = geo::horizontal(off).norm();
    if (horizontal < error.horizontal) error = {horizontal, std::abs(off.z())};
  }
  return error;
}

void TrafficStatistics::belief(const TrafficBeliefRecord& record) {
  if (!record.value.firm) return;
  firm_.insert({record.id, record.value.track});
  const Error error = nearest(record, record.value.address.has_value());
  if (error.horizontal > astray_beyond(record.value)) {
    ++astray_;
    return;
  }
  squared_ += error.horizontal * error.horizontal;
  squared_vertical_ += error.vertical * error.vertical;
  largest_ = std::max(largest_, error.horizontal);
  ++compared_;
  within_ += error.horizontal < 2 * record.value.horizontal_sd ? 1 : 0;
}

void TrafficStatistics::add_figures(std::map<std::string, double>& figures) const {
  const auto put = [&figures](const char* name, std::uint64_t count) {
    figures[name] = static_cast<double>(count);
  };
  if (traffic_.empty() && firm_.empty()) return;
  put("traffic", traffic_.size());
  put("traffic_tracks", firm_.size());
  put("traffic_near_collisions", near_.count);
  put("traffic_well_clear_lost", lost_.count);
  if (!firm_.empty()) put("traffic_tracks_astray_s", astray_);
  if (compared_ == 0) return;
  const auto count = static_cast<double>(compared_);
  figures["traffic_error_rms_m"] = std::sqrt(squared_ / count);
  figures["traffic_error_max_m"] = largest_;
  figures["traffic_vertical_error_rms_m"] = std::sqrt(squared_vertical_ / count);
  figures["traffic_within_2_sigma"] = static_cast<double>(within_) / count;
}

}  // namespace skein::record
