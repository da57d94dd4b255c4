#include "scenario/test/fake_kinds.h"

#include <gtest/gtest.h>

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
  kinds.add("estimator", "joint", "One Gaussian.", fake_fields())
      .add("estimator", "qkf", "The thesis's filter.",
           Fields<QkfOptions>().number("gain", &QkfOptions::gain, "Gain.", {.above = 0}))
      .add("plant", "kinematic", "Points.", fake_fields());
  kinds.add("terrain", "flat", "Flat.").add("wind", "uniform", "Uniform.");
  kinds.add("fire", "front", "Front.").add("autopilot", "path", "Paths.");
  kinds.add("sensor", "gnss", "GNSS.").add("sensor", "fire", "In/out.");
  kinds.add("radio", "ideal", "Ideal.").add("agent", "scout", "Scout.");
  kinds.add("strategy", "gus-rate", "GUS per second.");
  return kinds;
}

ReadOutcome read_text(std::string_view text, const std::vector<std::string>& sets) {
  std::vector<Override> overrides;
  for (const std::string& set : sets) overrides.push_back({set});
  return read_scenario_text(text, "test.yaml", SKEIN_SOURCE_DIR, fake_kinds(), overrides);
}

Scenario read_good(std::string_view text, const std::vector<std::string>& sets) {
  const ReadOutcome outcome = read_text(text, sets);
  EXPECT_EQ(outcome.report(), "");
  if (!outcome.ok()) return {};
  return *outcome.scenario;
}

std::string problems_of(std::string_view text, const std::vector<std::string>& sets) {
  const ReadOutcome outcome = read_text(text, sets);
  EXPECT_EQ(outcome.ok(), outcome.problem_count == 0);
  std::string lines;
  for (const Problem& problem : outcome.problems) lines += problem.text() + "\n";
  return lines;
}

}  // namespace skein::scenario::test
