// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/agent/report_rate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "skein/layer/reasoning/agent/fire_readings.h"

namespace skein::reasoning::report_rate_test {
namespace {

// Aircraft that would all together like to use `demand` times what the air carries.
struct Air {
  std::vector<ReportRate> rates;
  double demand = 1;
  double load() const {
    double sum = 0;
    for (const ReportRate& rate : rates)
      sum += rate.share() * demand / static_cast<double>(rates.size());
    return std::min(1.0, sum);
  }
  void seconds(int from, int to) {
    for (int t = from; t < to; ++t) {
      const RadioStatus radio{load(), 0, true};
      for (ReportRate& rate : rates) rate.step(Time::from_seconds(t), radio);
    }
  }
};

TEST(ReportRate, SaysAllWithoutAMedium) {
  ReportRate rate({});
  for (int t = 0; t < 100; ++t) rate.step(Time::from_seconds(t), {});
  EXPECT_EQ(rate.share(), 1);
}

TEST(ReportRate, KeepsTheLoadOfTheAirNearItsTarget) {
  for (const double demand : {1.5, 5.0, 30.0}) {
    Air air{std::vector<ReportRate>(40, ReportRate({})), demand};
    air.seconds(0, 120);
    // In balance the increase is taken back: at 1/50 of the rate that needs an eighth of
    // the target.
    EXPECT_NEAR(air.load(), 0.6, 0.1) << demand;
  }
}

TEST(ReportRate, WhoComesLateGetsAsMuch) {
  Air air{std::vector<ReportRate>(10, ReportRate({})), 10};
  air.seconds(0, 300);
  for (int k = 0; k < 10; ++k) air.rates.emplace_back(ReportRateOptions{});
  air.demand = 20;
  air.seconds(300, 4000);
  EXPECT_NEAR(air.rates.front().share() / air.rates.back().share(), 1, 0.05);
}

TEST(ReportRate, AFullQueueCountsAsAFullAir) {
  ReportRate rate({});
  for (int t = 0; t < 60; ++t) rate.step(Time::from_seconds(t), {0.1, 10, true});
  EXPECT_LT(rate.share(), 0.1);
}

TEST(ReportRate, BeginsLowWhereOthersUseTheMediumAndRisesWhereItIsIdle) {
  ReportRate rate({});
  rate.step(Time(), {0, 0, true});
  EXPECT_LT(rate.share(), 0.2);
  for (int t = 1; t < 15; ++t) rate.step(Time::from_seconds(t), {0.01, 0, true});
  EXPECT_EQ(rate.share(), 1);
}

TEST(ReportRate, PhasesOfATeamAreSpread) {
  std::vector<double> phases;
  for (std::uint32_t id = 1; id <= 40; ++id)
    phases.push_back(ReportRate::phase(EntityId{id}));
  std::sort(phases.begin(), phases.end());
  for (std::size_t k = 1; k < phases.size(); ++k)
    EXPECT_GT(phases[k] - phases[k - 1], 0.2 / 40);
}

TEST(ReportRate, NoTargetNoAdaptation) {
  ReportRate rate({.target_load = 0});
  for (int t = 0; t < 60; ++t) rate.step(Time::from_seconds(t), {1, 10, true});
  EXPECT_EQ(rate.share(), 1);
}

// Readings that are sent of those of a sensor which is inside from second 50 on.
std::vector<FireReading> sent(double share) {
  FireReadings readings(EntityId{1}, EntityId{0});
  std::vector<FireReading> all;
  for (int t = 0; t < 100; ++t) {
    const Time now = Time::from_seconds(t);
    NavEstimate nav;
    nav.time = now;
    const std::vector<SensorSample> samples = {FireSample{now, 0, t >= 50}};
    AgentInput in;
    in.now = now;
    in.nav = &nav;
    in.samples = samples;
    AgentOutput out;
    readings.step(in, share, out);
    EXPECT_EQ(out.records.size(), 1u) << "all are recorded";
    EXPECT_LE(out.outbox.size(), 1u) << "several go in one message";
    for (const Message& message : out.outbox) {
      if (const auto* one = std::get_if<FireReading>(&message.content))
        all.push_back(*one);
      else
        for (const FireReport& report = std::get<FireReport>(message.content);
             const BriefReading& each : report.readings)
          all.push_back(reading_of(report, each, EntityId{1}));
    }
  }
  return all;
}

TEST(FireReadings, SendsAllWhereThereIsRoom) {
  EXPECT_EQ(sent(1).size(), 100u);
}

TEST(FireReadings, SendsBothSidesOfAChangeWhereThereIsNot) {
  const auto few = sent(0.1);
  EXPECT_NEAR(static_cast<double>(few.size()), 11, 2);
  const auto change = std::adjacent_find(
      few.begin(), few.end(),
      [](const FireReading& a, const FireReading& b) { return a.inside != b.inside; });
  ASSERT_NE(change, few.end());
  EXPECT_EQ(change->time, Time::from_seconds(49));
  EXPECT_EQ((change + 1)->time, Time::from_seconds(50));
}

TEST(FireReadings, SaysWhereItHasSeenFireOnItsWay) {
  FireReadings readings(EntityId{1}, EntityId{0});
  std::vector<FireReport> reports;
  // 20 m a second to the north, over fire from 1 to 3 km.
  for (int t = 0; t < 200; ++t) {
    NavEstimate nav;
    nav.time = Time::from_seconds(t);
    nav.p_N = {20.0 * t, 0, -100};
    const std::vector<SensorSample> samples = {
        FireSample{nav.time, 0, t >= 50 && t < 150}};
    AgentInput in;
    in.now = nav.time;
    in.nav = &nav;
    in.samples = samples;
    AgentOutput out;
    readings.step(in, 1e-4, out);
    for (const Message& message : out.outbox)
      reports.push_back(std::get<FireReport>(message.content));
  }
  ASSERT_EQ(reports.size(), 2u) << "into the fire and out of it";
  EXPECT_TRUE(reports[0].burning.empty());
  ASSERT_EQ(reports[0].readings.size(), 2u);
  EXPECT_FALSE(reports[0].readings[0].adjacent);
  EXPECT_TRUE(reports[0].readings[1].adjacent);
  const auto& burning = reports[1].burning;
  ASSERT_GE(burning.size(), 4u);
  EXPECT_LE(burning.size(), 8u);
  for (const BriefPlace& place : burning) {
    EXPECT_GE(place.north_dm, 10'000);
    EXPECT_LT(place.north_dm, 30'000);
  }
  EXPECT_LT(burning.front().north_dm, 14'000);
  EXPECT_GT(burning.back().north_dm, 24'000);
}

}  // namespace
}  // namespace skein::reasoning::report_rate_test
