// SPDX-License-Identifier: Apache-2.0
#include "skein/assemble/world/run_options.h"

#include <algorithm>
#include <cmath>

#include "skein/assemble/kinds/sampling.h"

namespace skein::assemble {

simulation::RunOptions run_options(const scenario::Scenario& scenario,
                                   const scenario::KindTable& kinds) {
  simulation::RunOptions options;
  options.step = scenario.step;
  options.duration = scenario.duration;
  options.environment_period = truth_period(scenario, kinds);
  const double steps_per_row = 1 / (scenario.record.rate_hz * options.step.seconds());
  options.record_period = options.step * std::llround(steps_per_row);
  options.perimeter_period = scenario.record.metrics_period;
  options.radio_period =
      options.step *
      std::max<std::int64_t>(1, std::llround(scenario.record.radio_period.seconds() /
                                             options.step.seconds()));
  return options;
}

}  // namespace skein::assemble
