// SPDX-License-Identifier: Apache-2.0
// One row for each kind: its name, help, keys and how to make one.
#include "my_kinds.h"

#include "circle_estimator.h"
#include "expanding_square.h"
#include "radiometer.h"
#include "skein/assemble/kinds/task_row.h"
#include "smoke_watch.h"

namespace my_kinds {
namespace {

using skein::assemble::AircraftContext;
using skein::assemble::EstimatorContext;
using skein::scenario::Fields;

Fields<CircleOptions> circle_fields() {
  using T = CircleOptions;
  return Fields<T>()
      .integer("points", &T::points, "Of the boundary.",
               {.at_least = 3, .at_most = 10000})
      .number("shape_sd_m", &T::shape_sd, "How far a real boundary lies from a circle.",
              {.above = 0, .at_most = 1e4})
      .number("rate_walk_mps", &T::rate_walk, "Change of the rate in a second.",
              {.at_least = 0, .at_most = 10});
}

Fields<RadiometerOptions> radiometer_fields() {
  using T = RadiometerOptions;
  return Fields<T>()
      .number("rate_hz", &T::rate_hz, "Samples per second.",
              {.above = 0, .at_most = 1000})
      .angle_deg("half_angle_deg", &T::half_angle, "Of the cone it looks down through.",
                 {.above = 0, .at_most = 60})
      .number("share", &T::share, "Of the ground in view that must burn.",
              {.above = 0, .below = 1})
      .number("noise", &T::noise, "Standard deviation of the measured share.",
              {.at_least = 0, .at_most = 1});
}

Fields<SmokeWatchOptions> smoke_watch_fields() {
  using T = SmokeWatchOptions;
  return Fields<T>().number("radius_m", &T::radius, "Of the circle that it flies.",
                            {.above = 0, .at_most = 1e4});
}

}  // namespace

void add_kinds(skein::assemble::KindsByRole& kinds) {
  kinds.estimator.add("circle", "A circle that grows: radius and rate.", circle_fields(),
                      [](const CircleOptions& o, const EstimatorContext& c) {
                        return std::make_unique<CircleEstimator>(o, c.prior);
                      });
  kinds.sensor.add("radiometer", "Says \"inside\" where enough of a disc burns.",
                   radiometer_fields(),
                   [](const RadiometerOptions& o, const AircraftContext& c) {
                     return std::make_unique<Radiometer>(o, c.seed, c.self, c.instance);
                   });
  kinds.task.add<ExpandingSquare>(
      [](const ExpandingSquare& o, const skein::assemble::TaskContext& c) {
        return std::make_unique<ExpandingSquareTask>(c.flight, o);
      });
  // Entities are numbered: the station 0, then the aircraft, here in pairs.
  kinds.agent.add(
      "smoke-watch", "One of two that circle and say what they see.",
      smoke_watch_fields(), [](const SmokeWatchOptions& o, const AircraftContext& c) {
        const skein::EntityId other{c.self.value % 2 == 1 ? c.self.value + 1
                                                          : c.self.value - 1};
        return std::make_unique<SmokeWatch>(o, c.self, other, -c.initial.p_N.z());
      });
}

}  // namespace my_kinds
