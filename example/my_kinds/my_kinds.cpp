// One row for each kind: its name, help, keys and how to make one.
#include "my_kinds.h"

#include "circle_estimator.h"
#include "radiometer.h"

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
}

}  // namespace my_kinds
