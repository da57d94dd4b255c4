// SPDX-License-Identifier: Apache-2.0
#include "app/serve/record_thinner.h"

#include <gtest/gtest.h>

#include "app/serve/map_record.h"
#include "skein/data/describe/wire.h"

namespace skein::serve::record_thinner_test {
namespace {

FireReading reading(double time, std::uint32_t aircraft) {
  return {Time::from_seconds(time), EntityId{aircraft}, {time, 0}, 1, false};
}

AlertRecord alert(double time, std::uint32_t level) {
  AlertRecord record{Time::from_seconds(time), EntityId{1}, {}};
  record.value.level = level;
  return record;
}

template <class T>
std::vector<T> kept_of(std::vector<RecordThinner::Kept> all) {
  std::vector<T> found;
  for (const auto& each : all)
    if (const auto* record = std::get_if<T>(&each.record)) found.push_back(*record);
  return found;
}

TEST(RecordThinner, KeepsAllWhereThereIsRoom) {
  RecordThinner thinner(1);
  for (int t = 0; t < 100; ++t) {
    thinner.take(Time::from_seconds(t), reading(t, 1));
    thinner.take(Time::from_seconds(t), reading(t, 2));
  }
  const auto all = thinner.finish();
  ASSERT_EQ(all.size(), 200U);
  for (std::size_t k = 1; k < all.size(); ++k) EXPECT_LE(all[k - 1].time, all[k].time);
  EXPECT_EQ(thinner.spacing(FireReading{}), Time());
}

TEST(RecordThinner, ThinsEachSubjectEvenlyAndKeepsItsLast) {
  RecordThinner thinner(0.01);  // 4 kB of readings
  constexpr int kEnd = 1003;
  for (int t = 0; t <= kEnd; ++t)
    for (const std::uint32_t aircraft : {1, 2})
      thinner.take(Time::from_seconds(t), reading(t, aircraft));
  const double spacing = thinner.spacing(FireReading{}).seconds();
  EXPECT_GT(spacing, 1);
  std::map<std::uint32_t, std::vector<double>> times;
  std::size_t bytes = 0;
  for (const FireReading& each : kept_of<FireReading>(thinner.finish())) {
    times[each.aircraft.value].push_back(each.time.seconds());
    bytes += wire::coded_size(Record(each));
  }
  EXPECT_LT(bytes, 4400U) << "and the last two";
  for (const auto& [aircraft, all] : times) {
    EXPECT_EQ(all.front(), 0);
    EXPECT_EQ(all.back(), kEnd);
    for (std::size_t k = 1; k + 1 < all.size(); ++k)
      EXPECT_EQ(all[k] - all[k - 1], spacing);
  }
}

TEST(RecordThinner, KeepsTheEndsOfAlertsAndWhatThereIs) {
  RecordThinner thinner(1e-4);
  thinner.take(Time(), EntityRecord{EntityId{1}, "uav", "aircraft"});
  for (int t = 0; t < 100; ++t)
    thinner.take(Time::from_seconds(t), alert(t, t % 10 == 9 ? 0 : 2));
  const auto all = thinner.finish();
  EXPECT_EQ(kept_of<EntityRecord>(all).size(), 1U);
  int ends = 0;
  for (const AlertRecord& each : kept_of<AlertRecord>(all)) ends += each.value.level == 0;
  EXPECT_EQ(ends, 10);
  EXPECT_LT(all.size(), 30U);
}

TEST(MapRecord, SimplifiedLinesStayWithinTheTolerance) {
  geo::Ring ring;
  for (int k = 0; k < 400; ++k) ring.push_back(300 * geo::unit(2 * geo::kPi * k / 400));
  const geo::Ring coarse = simplified(ring, 1);
  // Arcs are halved until they are short enough: into 64 parts.
  EXPECT_LE(coarse.size(), 64U);
  // A chord of a circle is off by its sagitta: 1 m of 300 m is 9.4 degrees, a 38th.
  EXPECT_GE(coarse.size(), 38U);
  EXPECT_EQ(simplified(ring, 0), ring);
}

TEST(MapRecord, RoundsPathsAhead) {
  const FlightPathRecord path{
      Time::from_seconds(3), EntityId{1}, {{{1.01F, 10.03F, -20.04F, 300.01F}}, true}};
  const auto shown = for_map(path);
  ASSERT_TRUE(shown);
  const auto& record = std::get<FlightPathRecord>(*shown);
  ASSERT_EQ(record.value.points.size(), 1U);
  EXPECT_EQ(record.value.points[0].ahead, 1);
  EXPECT_EQ(record.value.points[0].north, 10);
  EXPECT_EQ(record.value.points[0].east, -20.0625F);
  EXPECT_EQ(record.value.points[0].altitude_msl, 300);
  EXPECT_TRUE(record.value.ends);
}

TEST(MapRecord, LeavesOutWhatNoMapShows) {
  EXPECT_FALSE(for_map(BandRecord{}));
  EXPECT_FALSE(for_map(MessageRecord{})) << "no order";
  MessageRecord lost;
  lost.message.content = Task{};
  EXPECT_TRUE(for_map(lost));
  lost.lost = true;
  EXPECT_FALSE(for_map(lost));
  TrafficBeliefRecord belief;
  EXPECT_FALSE(for_map(belief));
  belief.value.firm = true;
  EXPECT_TRUE(for_map(belief));
}

}  // namespace
}  // namespace skein::serve::record_thinner_test
