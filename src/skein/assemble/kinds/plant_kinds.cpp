// SPDX-License-Identifier: Apache-2.0
// Plants: one row each.

#include <fmt/format.h>

#include "skein/assemble/aircraft/aircraft_file.h"
#include "skein/assemble/kinds/aircraft_gains.h"
#include "skein/assemble/kinds/kinds_of.h"
#include "skein/assemble/kinds/parameter_spread.h"
#include "skein/layer/asset/fixed_wing/fixed_wing_plant.h"
#include "skein/layer/asset/kinematic_plant.h"
#include "skein/layer/asset/multirotor/multirotor_plant.h"
#include "skein/layer/asset/performance/performance_plant.h"

namespace skein::assemble {
namespace {

using scenario::Fields;

constexpr std::uint32_t kMaxDraws = 1000;  // of parameters with errors

// A plant whose parameters stand in an aircraft file.
struct FiledPlant {
  std::string aircraft;
  std::string file;
};
// One type for each plant, so that each has a default of its own.
struct FixedWingChoice : FiledPlant {
  FixedWingChoice() : FiledPlant{"aerosonde", ""} {}
};
struct MultirotorChoice : FiledPlant {
  MultirotorChoice() : FiledPlant{"quad", ""} {}
};
struct PerformanceChoice : FiledPlant {
  PerformanceChoice() : FiledPlant{"light-sport", ""} {}
};

template <class T>
Fields<T> filed_fields() {
  return Fields<T>()
      .file(
          "aircraft", &T::aircraft,
          "A built-in aircraft by its name (`skein list aircraft`), or an aircraft file.",
          {.or_name = true})
      .file("file", &T::file, "An aircraft file instead; \"\": none.",
            {.may_be_empty = true});
}

Result<AircraftFile> load(const FiledPlant& choice) {
  return load_aircraft(choice.file.empty() ? choice.aircraft : choice.file, {});
}

template <class Made, class Parameters>
Result<std::unique_ptr<Plant>> make_filed(const FiledPlant& choice,
                                          std::optional<Parameters> AircraftFile::*model,
                                          const AircraftContext& c) {
  auto aircraft = load(choice);
  if (!aircraft) return aircraft.error();
  if (!(aircraft.value().*model))
    return Error{
        ErrorCode::kBadInput, choice.file.empty() ? choice.aircraft : choice.file,
        fmt::format("describes plants of kind {} only.", aircraft.value().plants()),
        "Choose one of these, or another aircraft."};
  const Parameters nominal = *(aircraft.value().*model);
  Parameters parameters = nominal;
  // Errors that leave nothing that flies, such as too much drag for the motor, are drawn
  // again.
  for (std::uint32_t draw = 0; c.parameter_spread > 0; ++draw) {
    parameters = nominal;
    spread(parameters, c.parameter_spread,
           RandomStream(c.seed, c.self.value, Purpose::kAirframe, draw));
    if (errors(parameters).empty()) break;
    if (draw == kMaxDraws)
      return Error{ErrorCode::kBadInput, "parameter_spread",
                   "leaves hardly an aircraft that can fly.", "Make it smaller."};
  }
  return std::unique_ptr<Plant>(std::make_unique<Made>(parameters));
}

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
      .number("power_w", &T::power, "Drawn from the battery all the time.",
              {.at_least = 0, .at_most = 1e6})
      .number("capacity_wh", &T::capacity_Wh, "Of the battery; 0: it never ends.",
              {.at_least = 0, .at_most = 1e6})
      .number("glide_sink_mps", &T::glide_sink, "Sink rate on an empty battery.",
              {.above = 0, .at_most = 100})
      .rules_of_valid([](const T& o, const scenario::ValidValues& valid) {
        std::vector<scenario::RuleViolation> errors;
        if (valid("climb_rate_mps", "airspeed_mps", "airspeed_range") &&
            o.climb_rate >= o.slowest())
          errors.push_back(
              {"climb_rate_mps",
               fmt::format("{:.6g} must be below the slowest airspeed, {:.6g} "
                           "(airspeed_mps times 1 - airspeed_range).",
                           o.climb_rate, o.slowest()),
               {"airspeed_mps", "airspeed_range"}});
        return errors;
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
  kinds.add("performance",
            "A point with a budget of energy: speeds, climb, bank and consumption by "
            "phase; parameters from an aircraft file.",
            filed_fields<PerformanceChoice>(),
            [](const PerformanceChoice& o, const AircraftContext& c) {
              return make_filed<asset::PerformancePlant>(o, &AircraftFile::performance,
                                                         c);
            });
  kinds.add("fixed-wing",
            "Six degrees of freedom, wings; parameters from an aircraft file.",
            filed_fields<FixedWingChoice>(),
            [](const FixedWingChoice& o, const AircraftContext& c) {
              return make_filed<asset::FixedWingPlant>(o, &AircraftFile::fixed_wing, c);
            });
  kinds.add("multirotor",
            "Six degrees of freedom, rotors; parameters from an aircraft file.",
            filed_fields<MultirotorChoice>(),
            [](const MultirotorChoice& o, const AircraftContext& c) {
              return make_filed<asset::MultirotorPlant>(o, &AircraftFile::multirotor, c);
            });
  return kinds;
}

AircraftGains gains_of(const scenario::Choice& plant) {
  const auto take = [](const FiledPlant& choice) -> AircraftGains {
    const auto aircraft = load(choice);
    if (!aircraft) return {};
    return {aircraft.value().fixed_wing_gains, aircraft.value().multirotor_gains};
  };
  if (plant.kind == "fixed-wing") return take(plant.as<FixedWingChoice>());
  if (plant.kind == "multirotor") return take(plant.as<MultirotorChoice>());
  return {};
}

}  // namespace skein::assemble
