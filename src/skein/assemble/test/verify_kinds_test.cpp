// SPDX-License-Identifier: Apache-2.0
// Every kind keeps the contract of its role.
#include "skein/assemble/world/verify_kinds.h"

#include <gtest/gtest.h>

#include <set>

#include "skein/role/sensor.h"

namespace skein::assemble::verify_kinds_test {
namespace {

TEST(EveryKind, KeepsTheContractOfItsRole) {
  // Without a file, points, or somebody at the far end, there is nothing to test.
  const std::set<std::string> kNotTested = {
      "terrain raster",   "wind series",     "wind grid",      "phenomenon recorded",
      "turbulence none",  "vehicle mavlink", "vehicle remote", "vehicle flight-model",
      "traffic recorded", "antenna table",   "task fly_route", "task fly_tour",
      "task survey",      "task patrol",     "task relay",     "task fly_plan"};
  for (const KindVerdict& verdict : verify_kinds(KindRegistry(), "", false)) {
    const std::string name = verdict.role + " " + verdict.kind;
    for (const std::string& violation : verdict.violations)
      ADD_FAILURE() << name << ": " << violation;
    EXPECT_EQ(verdict.not_tested.empty(), kNotTested.count(name) == 0)
        << name << ": " << verdict.not_tested;
  }
}

struct NoKeys {};

// A sensor that answers from the future, and one that is in order.
class Prophet final : public Sensor {
 public:
  void sample(const SensorView& view, std::vector<SensorSample>& out) override {
    out.emplace_back(HeightSample{view.now + Time::from_seconds(1), 1});
  }
};
class Silent final : public Sensor {
 public:
  void sample(const SensorView&, std::vector<SensorSample>&) override {}
};

template <class S>
void add(KindsByRole& kinds, const char* name) {
  kinds.sensor.add(
      name, "For a test.", scenario::Fields<NoKeys>(),
      [](const NoKeys&, const AircraftContext&) { return std::make_unique<S>(); });
}

TEST(KindsOfAPlugin, AreTestedAlone) {
  KindsByRole more;
  add<Prophet>(more, "prophet");
  add<Silent>(more, "silent");
  KindRegistry kinds;
  ASSERT_TRUE(kinds.add(more, "test").ok());
  const auto verdicts = verify_kinds(kinds, "", true);
  ASSERT_EQ(verdicts.size(), 2u);
  EXPECT_EQ(verdicts[0].kind, "prophet");
  EXPECT_EQ(verdicts[0].violations, contract::Violations{"a sample is from the future"});
  EXPECT_TRUE(verdicts[1].violations.empty());
}

}  // namespace
}  // namespace skein::assemble::verify_kinds_test
