// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/hmi/serve/fire_state.h"

namespace skein::hmi {

void FireState::take(const PerimeterRecord& record) {
  const std::lock_guard guard(lock_);
  now_[record.mission] = record.belief;
}

void FireState::take(const ForecastRecord& record) {
  const PerimeterForecast& forecast = record.forecast;
  const std::lock_guard guard(lock_);
  std::vector<Believed>& all = forecasts_[forecast.mission];
  // Those that were made before are out of date.
  std::erase_if(all, [&](const Believed& each) { return each.made != forecast.made; });
  all.push_back({forecast.mission, forecast.boundary, forecast.made});
}

void FireState::clear() {
  const std::lock_guard guard(lock_);
  now_.clear();
  forecasts_.clear();
}

std::vector<FireState::Believed> FireState::all() const {
  const std::lock_guard guard(lock_);
  std::vector<Believed> all;
  for (const auto& [mission, boundary] : now_)
    if (!boundary.rings.empty()) all.push_back({mission, boundary, std::nullopt});
  for (const auto& [mission, forecasts] : forecasts_)
    all.insert(all.end(), forecasts.begin(), forecasts.end());
  return all;
}

}  // namespace skein::hmi
