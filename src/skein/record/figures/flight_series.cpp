// SPDX-License-Identifier: Apache-2.0
#include "skein/record/figures/flight_series.h"

#include <cmath>
#include <limits>

namespace skein::record {
namespace {

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
constexpr double kSameTime = 1e-6;  // [s]

}  // namespace

void FlightSeriesBuilder::truth(EntityId id, const Truth& row) {
  auto at = by_id_.find(id);
  if (at == by_id_.end()) {
    if (by_id_.size() >= static_cast<std::size_t>(flights_)) return;
    at = by_id_.emplace(id, Flight{}).first;
    at->second.series.id = id;
  }
  FlightSeries& s = at->second.series;
  if (!s.time.empty() && row.time < at->second.due - kSameTime) return;
  at->second.due = row.time + step_;
  s.time.push_back(static_cast<float>(row.time));
  s.altitude_msl.push_back(static_cast<float>(row.altitude_msl));
  s.airspeed.push_back(static_cast<float>(row.airspeed));
  s.charge.push_back(static_cast<float>(row.charge));
  s.cross_track.push_back(kUnknown);
  s.position_error.push_back(kUnknown);
  s.reserve.push_back(kUnknown);
  at->second.places.push_back(row.p);
}

void FlightSeriesBuilder::estimate(EntityId id, const Estimate& row) {
  const auto at = by_id_.find(id);
  if (at == by_id_.end()) return;
  Flight& flight = at->second;
  FlightSeries& s = flight.series;
  // The float of the time is as near as both are stored.
  const auto time = static_cast<float>(row.time);
  while (flight.next < s.time.size() && s.time[flight.next] < time) ++flight.next;
  const std::size_t k = flight.next;
  if (k == s.time.size() || s.time[k] != time) return;
  s.cross_track[k] = static_cast<float>(row.cross_track);
  s.position_error[k] = static_cast<float>((row.p - flight.places[k]).norm());
  s.reserve[k] = static_cast<float>(row.reserve);
}

std::vector<FlightSeries> FlightSeriesBuilder::take() {
  std::vector<FlightSeries> all;
  all.reserve(by_id_.size());
  for (auto& [id, flight] : by_id_) all.push_back(std::move(flight.series));
  by_id_.clear();
  return all;
}

}  // namespace skein::record
