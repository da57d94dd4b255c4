// SPDX-License-Identifier: Apache-2.0
#include "skein/scenario/test/fake_kinds.h"

#include "skein/scenario/scenario.h"

namespace skein::scenario::test {

Fields<FakeOptions> fake_fields() {
  using T = FakeOptions;
  const auto layer =
      Fields<Layer>()
          .number("height_m", &Layer::height, "Top of the layer.", {.above = 0})
          .number("speed_mps", &Layer::speed, "Wind in it.");
  return Fields<T>()
      .number("airspeed_mps", &T::airspeed, "Cruise airspeed.",
              {.above = 0, .at_most = 100})
      .angle_deg("bank_deg", &T::bank, "Largest bank.", {.above = 0, .below = 80})
      .duration_s("timeout_s", &T::timeout, "Patience.")
      .duration_s("delay_s", &T::delay, "Delay.", {.at_least = 0, .at_most = 10})
      .integer("harmonics", &T::harmonics, "Harmonics.", {.at_least = 0, .at_most = 30})
      .boolean("robust", &T::robust, "Whether outliers are refused.")
      .text("label", &T::label, "Any text.")
      .text("colour", &T::colour, "A | B.", {"red", "green"})
      .word("method", &T::method, "Integration.",
            {{"euler", Method::kEuler, "first order"},
             {"heun", Method::kHeun, "second order"}})
      .point("drift_mps", &T::drift, "Drift.")
      .file("map", &T::map, "A map.", {.may_be_empty = true})
      .number("gains", &T::gains, "Gains.", {.at_least = 0})
      .items({.at_least = 1, .at_most = 4})
      .point("points_m", &T::points, "Places.")
      .object("layers", &T::layers, layer, "Layers of wind.")
      .number("limit_m", &T::limit, "A limit.", {.above = 0})
      .object("extra", &T::extra, layer, "One more layer.")
      .angle_deg("courses_deg", &T::courses, "Courses.");
}

KindTable fake_kinds() {
  KindTable kinds;
  kinds.add("radio", "joint", "One Gaussian.", fake_fields())
      .add("radio", "qkf", "The thesis's filter.",
           Fields<QkfOptions>().number("gain", &QkfOptions::gain, "Gain.", {.above = 0}))
      .add("radio", "ideal", "By default.", fake_fields())
      .add("terrain", "joint", "One more.", fake_fields())
      .add("plant", "kinematic", "Points.", fake_fields());
  // Whatever else a scenario chooses by default has no options here.
  const Scenario defaults;
  const AircraftGroup group;
  const auto add = [&](const std::string& role, const Choice& choice) {
    if (!kinds.find(role, choice.kind)) kinds.add(role, choice.kind, "By default.");
  };
  add("terrain", defaults.environment.terrain);
  add("wind", defaults.environment.wind);
  add("phenomenon", defaults.environment.phenomena.front());
  add("movement", PlacedObject().movement);
  add("radio", defaults.radio);
  add("turbulence", defaults.environment.turbulence);
  for (const Choice& mission : defaults.missions) add("mission", mission);
  add("plant", group.plant);
  add("autopilot", group.autopilot);
  add("vehicle", group.vehicle);
  add("agent", group.agent);
  for (const Choice& sensor : group.sensors) add("sensor", sensor);
  return kinds;
}

}  // namespace skein::scenario::test
