// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/agent/report_rate.h"

#include <algorithm>
#include <cmath>

namespace skein::reasoning {
namespace {

constexpr Time kPeriod = Time::from_ns(1'000'000'000);

}  // namespace

void ReportRate::step(Time now, const RadioStatus& radio) {
  if (options_.target_load <= 0 || (next_ && now < *next_)) return;
  if (!next_ && radio.shared) share_ = options_.start;
  next_ = now + kPeriod;
  const double load = radio.waiting > options_.most_waiting ? 1 : radio.load;
  const double error = (options_.target_load - load) / options_.target_load;
  share_ += share_ * options_.gain * error + options_.increase;
  share_ = std::clamp(share_, options_.least, 1.0);
}

double ReportRate::phase(EntityId self) {
  constexpr double kGolden = 0.6180339887498949;  // multiples of it are spread evenly
  const double turns = kGolden * self.value;
  return turns - std::floor(turns);
}

}  // namespace skein::reasoning
