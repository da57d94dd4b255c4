// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/autopilot/skein/skein_setup.h"

namespace skein::autopilot {
namespace {

constexpr double kLandingTime = 60;  // of a fixed wing: approach and touchdown [s]

HomeFlight home_flight_of(const FlightLimits& limits) {
  HomeFlight flight;
  flight.airspeed = limits.airspeed;
  flight.climb_rate = limits.climb_rate;
  flight.sink_rate = limits.sink_rate;
  flight.landing_time = limits.slowest > 0 ? kLandingTime : kLandingTime / 3;
  return flight;
}

EstimatorOptions for_airframe(EstimatorOptions options, const Airframe& airframe) {
  options.fixed_wing = !std::holds_alternative<MultirotorAirframe>(airframe);
  return options;
}

}  // namespace

SkeinSetup::SkeinSetup(const SkeinOptions& all, const FlightLimits& plant_limits,
                       const Airframe& plant_airframe)
    : options(all),
      limits(plant_limits),
      airframe(plant_airframe),
      rules(all.failsafe, kind_of(plant_airframe)),
      fence(all.fence),
      home_flight(home_flight_of(plant_limits)) {
  options.estimator = for_airframe(options.estimator, airframe);
  if (const auto* frame = std::get_if<FixedWingAirframe>(&airframe)) {
    if (!options.lap_gains.empty()) {
      options.wing_gains = options.lap_gains.front().wing;
      options.wing_guidance.lateral = options.lap_gains.front().lateral;
    }
    wing = std::make_shared<FixedWingSetup>(*frame, options.wing_gains);
    for (const LapGains& lap : options.lap_gains)
      lap_wings.push_back(std::make_shared<FixedWingSetup>(*frame, lap.wing));
  }
  if (const auto* frame = std::get_if<MultirotorAirframe>(&airframe))
    rotors = std::make_shared<MultirotorSetup>(*frame, options.rotor_gains);
}

}  // namespace skein::autopilot
