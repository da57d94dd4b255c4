// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/agent/status_report.h"

#include <gtest/gtest.h>

#include <vector>

namespace skein::reasoning::status_report_test {
namespace {

constexpr EntityId kSelf{3}, kStation{0};

struct Said {
  double time;
  AircraftReport report;
};

// What is reported until `end`, in steps of `step`, where the air has room for a share.
std::vector<Said> reports(double end, double step, double (*share)(double time)) {
  StatusReport status(kSelf, kStation, 1);
  FlightContext context;
  context.self = kSelf;
  const TaskPlanner tasks(context, kStation, {});
  std::vector<Said> said;
  for (int k = 0; k * step < end; ++k) {
    const double time = k * step;
    NavEstimate nav;
    AgentInput in;
    in.now = Time::from_seconds(time);
    in.nav = &nav;
    AgentOutput out;
    if (!status.step(in, FlightLimits(), tasks, 0, share(time), out)) continue;
    said.push_back({time, std::get<AircraftReport>(out.outbox.at(0).content)});
  }
  return said;
}

TEST(StatusReport, ComesEachPeriodWhateverTheStep) {
  for (const double step : {0.1, 0.25, 0.7}) {
    const auto all = reports(100, step, [](double) { return 1.0; });
    EXPECT_NEAR(static_cast<double>(all.size()), 100, 1) << step;
    for (const Said& each : all) EXPECT_FALSE(each.report.next_in);
  }
}

TEST(StatusReport, IsRarerWhereThereIsLessRoomAndSaysSo) {
  const auto all = reports(1000, 0.5, [](double) { return 0.1; });
  EXPECT_NEAR(static_cast<double>(all.size()), 100, 1);
  EXPECT_LT(all.front().time, 10);
  for (const Said& each : all) EXPECT_EQ(each.report.next_in, 10);
}

// All of a team begin with the same share, and find that this was too much.
TEST(StatusReport, WaitsLongerAsTheRoomGetsLess) {
  const auto all = reports(1000, 0.5, [](double time) { return time < 2 ? 0.1 : 0.01; });
  EXPECT_NEAR(static_cast<double>(all.size()), 10, 1);
  const auto more =
      reports(1000, 0.5, [](double time) { return time < 2 ? 0.001 : 1.0; });
  EXPECT_LT(more.front().time, 4) << "and is soon back where there is room again";
}

TEST(StatusReport, SaysItsLimitsUntilAnOrderShowsThatTheyArrived) {
  const auto all = reports(100, 0.5, [](double) { return 1.0; });
  for (std::size_t k = 0; k < all.size(); ++k)
    EXPECT_EQ(all[k].report.limits.has_value(), k < 3 || k % 5 == 0) << k;
}

}  // namespace
}  // namespace skein::reasoning::status_report_test
