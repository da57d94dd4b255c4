// SPDX-License-Identifier: Apache-2.0
#include "skein/assemble/kinds/routine_periods.h"

#include <algorithm>

namespace skein::assemble {
namespace {

constexpr double kSaid = 223;                    // by an aircraft [byte/s]
constexpr double kShare = 0.2;                   // of the air
constexpr double kMaxQuery = 20, kMaxPlace = 5;  // [s]

}  // namespace

RoutinePeriods routine_periods(const scenario::Scenario& scenario,
                               const RadioParts& parts) {
  const double rate = shared_rate(scenario.radio, parts);
  if (rate <= 0) return {};
  double aircraft = 0;
  for (const scenario::AircraftGroup& group : scenario.aircraft) aircraft += group.count;
  const double period = std::max(1.0, 8 * kSaid * aircraft / (kShare * rate));
  return {std::min(period, kMaxQuery), std::min(period, kMaxPlace)};
}

}  // namespace skein::assemble
