// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/team/protocol/timers.h"

#include <algorithm>
#include <cmath>

#include "skein/base/math.h"

namespace skein::reasoning {
namespace {

constexpr double kMemory = 200;  // messages
constexpr double kMinLoss = 0.05, kMaxLoss = 0.9;
constexpr double kFalseAlarm = 1e-4;
constexpr double kSmallTeam = 12;     // members that all say all in each period
constexpr double kRarest = 5;         // query periods
constexpr double kLongestPeriod = 5;  // [s]

}  // namespace

void LossMeter::arrived(std::uint32_t missing) {
  expected_ += 1.0 + missing;
  lost_ += missing;
  if (expected_ <= kMemory) return;
  lost_ *= kMemory / expected_;
  expected_ = kMemory;
}

void LossMeter::arrived_late() {
  lost_ = std::max(0.0, lost_ - 1);
}

double LossMeter::loss() const {
  return std::clamp(lost_ / expected_, kMinLoss, kMaxLoss);
}

double time_until_lost(const TeamTimes& times, double loss) {
  const double p = std::clamp(loss, kMinLoss, kMaxLoss);
  // The quotient of ln 1e-4 and ln 0.1 is 4 but for rounding.
  const double queries = std::ceil(math::log(kFalseAlarm) / math::log(p) - 1e-9);
  const double hops =
      times.radio_range > 0 ? times.mission_diameter / times.radio_range : 1;
  return times.query_period * std::max(4.0, queries) * std::max(1.0, hops);
}

double follower_period(const TeamTimes& times, std::size_t members) {
  const double crowd = static_cast<double>(members) / kSmallTeam;
  const double period = times.query_period * std::clamp(crowd, 1.0, kRarest);
  return std::max(times.query_period, std::min(period, kLongestPeriod));
}

}  // namespace skein::reasoning
