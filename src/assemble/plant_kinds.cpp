// Plants: one row each.

#include <fmt/format.h>

#include "assemble/kinds_of.h"
#include "layer/asset/kinematic_plant.h"

namespace skein::assemble {
namespace {

using scenario::Fields;

Fields<asset::KinematicOptions> kinematic_fields() {
  using T = asset::KinematicOptions;
  return Fields<T>()
      .number("airspeed_mps", &T::airspeed, "Cruise airspeed.",
              {.at_least = 0.1, .at_most = 500})
      .number("airspeed_range", &T::airspeed_range,
              "Slowest and fastest are cruise times (1 -+ this).",
              {.at_least = 0, .below = 1})
      .number("turn_radius_m", &T::turn_radius, "Smallest, in the air mass at cruise.",
              {.above = 0, .at_most = 1e5})
      .number("climb_rate_mps", &T::climb_rate, "Largest, up and down.",
              {.above = 0, .at_most = 200})
      .number("roll_rate_rad_per_s", &T::roll_rate, "Largest; 0: the roll angle jumps.",
              {.at_least = 0, .at_most = 100})
      .duration_s("airspeed_lag_s", &T::airspeed_lag, "Time constant of the airspeed.")
      .rules([](const T& o) {
        std::vector<scenario::RuleFault> faults;
        if (o.climb_rate >= o.slowest())
          faults.push_back(
              {"climb_rate_mps",
               fmt::format("{:.6g} must be below the slowest airspeed, {:.6g} "
                           "(airspeed_mps times 1 - airspeed_range).",
                           o.climb_rate, o.slowest()),
               {"airspeed_mps", "airspeed_range"}});
        return faults;
      });
}

}  // namespace

Kinds<Plant, AircraftContext> plant_kinds() {
  Kinds<Plant, AircraftContext> kinds("plant");
  kinds.add("kinematic", "A point in coordinated flight, carried by the wind.",
            kinematic_fields(),
            [](const asset::KinematicOptions& o, const AircraftContext&) {
              return std::make_unique<asset::KinematicPlant>(o);
            });
  return kinds;
}

}  // namespace skein::assemble
