// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/perimeter/joint/step_likelihood.h"

#include <array>
#include <cmath>

#include "skein/base/math.h"
#include "skein/model/probability/truncated_normal.h"

namespace skein::perimeter {

StepMoments condition(double mean, double variance, const StepLikelihood& reading) {
  const double sd = std::sqrt(variance);
  struct Zone {
    double likelihood;
    model::Interval interval;
  };
  const std::array<Zone, 3> zones{{{reading.below, {.upper = reading.low}},
                                   {reading.between, {reading.low, reading.high}},
                                   {reading.above, {.lower = reading.high}}}};
  std::array<model::TruncatedNormal, 3> cut;
  std::array<double, 3> log_weight;
  double largest = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < zones.size(); ++i) {
    log_weight[i] = -std::numeric_limits<double>::infinity();
    if (!(zones[i].likelihood > 0) ||
        !(zones[i].interval.lower < zones[i].interval.upper)) {
      continue;
    }
    cut[i] = model::truncate_normal(mean, sd, zones[i].interval);
    log_weight[i] = math::log(zones[i].likelihood) + cut[i].log_mass;
    largest = std::max(largest, log_weight[i]);
  }
  double total = 0, first = 0;
  for (std::size_t i = 0; i < zones.size(); ++i) {
    if (std::isinf(log_weight[i])) continue;
    const double weight = math::exp(log_weight[i] - largest);
    const double moved = cut[i].mean - mean;
    total += weight;
    first += weight * moved;
  }
  const double shift = first / total;
  double variance_after = 0;
  for (std::size_t i = 0; i < zones.size(); ++i) {
    if (std::isinf(log_weight[i])) continue;
    const double off = cut[i].mean - mean - shift;
    variance_after +=
        math::exp(log_weight[i] - largest) * (cut[i].variance + off * off) / total;
  }
  return {math::exp(largest) * total, mean + shift, variance_after};
}

}  // namespace skein::perimeter
