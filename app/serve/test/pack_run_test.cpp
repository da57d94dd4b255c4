// SPDX-License-Identifier: Apache-2.0
#include "app/serve/pack_run.h"

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <span>

#include "skein/data/describe/wire.h"
#include "skein/data/event/live.h"
#include "skein/record/store/record_stream.h"
#include "skein/record/store/run_recorder.h"
#include "skein/record/test/sample_run.h"

namespace skein::serve::pack_run_test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kScenario =
    "name: packed\n"
    "origin: {latitude_deg: 37, longitude_deg: -122}\n"
    "aircraft: [{name: uav, count: 2}]\n";

void make_run(const fs::path& folder, int seconds, int aircraft, int rows_per_second,
              const char* scenario = kScenario) {
  auto recorder = record::RunRecorder::create(
                      folder, {"1.2.3", 5, "packed", scenario, "2026-07-01T12:00:00Z"})
                      .value();
  constexpr float kHeights[] = {1, 2.1F, 3, 4};
  recorder->store_terrain(2, 2, {-1200, -1200}, 2400, kHeights);
  record::record_sample(*recorder, seconds, aircraft, rows_per_second);
  recorder->record(RecommendationRecord{
      Time::from_seconds(seconds),
      EntityId{1},
      {1, RecommendationState::kShown, "around", {{15, Vec3(1, 2, -300)}}}});
  ASSERT_TRUE(recorder->close());
}

struct Message {
  double time = 0;
  std::vector<LiveItem> items;
};

template <class T>
T raw(std::span<const std::byte> bytes) {
  T value;
  std::memcpy(&value, bytes.data(), sizeof value);
  return value;
}

std::vector<Message> messages(std::span<const std::byte> bytes) {
  std::vector<Message> all;
  while (!bytes.empty()) {
    const auto length = raw<std::uint32_t>(bytes.subspan(8));
    auto items = wire::decode<std::vector<LiveItem>>(bytes.subspan(12, length));
    EXPECT_TRUE(items);
    all.push_back({raw<double>(bytes), std::move(items).value()});
    bytes = bytes.subspan(12 + length);
  }
  return all;
}

// All records of a kind, from what was packed.
template <class T>
std::vector<T> records_of(const PackedRun& run) {
  std::vector<T> found;
  for (const Message& message : messages(run.records))
    for (const LiveItem& item : message.items)
      if (const auto* record = std::get_if<T>(&std::get<LiveRecord>(item).record))
        found.push_back(*record);
  return found;
}

// And from the run itself.
template <class T>
std::vector<T> recorded(const fs::path& folder) {
  std::vector<T> found;
  auto stream = record::RecordStream::open(folder).value();
  EXPECT_TRUE(stream.advance(stream.end(), {[&](Time, const Record& record) {
                                              if (const auto* one =
                                                      std::get_if<T>(&record))
                                                found.push_back(*one);
                                            },
                                            [](Time, const MetricSample&) {}}));
  return found;
}

TEST(PackRun, SaysWhatTheRecordsOfTheRunSay) {
  const record::TemporaryFolder folder("pack");
  make_run(folder.path(), 120, 2, 10);
  const auto packed = pack_run(folder.path(), 1);
  ASSERT_TRUE(packed) << packed.error().text();
  const PackedRun& run = packed.value();

  EXPECT_EQ(records_of<EntityRecord>(run).size(), 3U);
  EXPECT_EQ(records_of<MessageRecord>(run).size(), 4U)
      << "orders, each minute; those of the last step arrive after the end";
  const auto crossings = records_of<Crossing>(run);
  const auto all_crossings = recorded<Crossing>(folder.path());
  ASSERT_EQ(crossings.size(), all_crossings.size());
  for (std::size_t k = 0; k < crossings.size(); ++k) {
    EXPECT_EQ(crossings[k].time, all_crossings[k].time);
    EXPECT_LE((crossings[k].point - all_crossings[k].point).norm(), 0.05) << "1/16 m";
  }
  const auto perimeters = records_of<PerimeterRecord>(run);
  const auto all_perimeters = recorded<PerimeterRecord>(folder.path());
  ASSERT_EQ(perimeters.size(), all_perimeters.size());
  const auto &last = perimeters.back(), &true_last = all_perimeters.back();
  EXPECT_EQ(last.time, true_last.time);
  ASSERT_EQ(last.belief.rings[0].size(), true_last.belief.rings[0].size());
  for (std::size_t k = 0; k < last.belief.rings[0].size(); ++k) {
    const BoundaryPoint &p = last.belief.rings[0][k], &q = true_last.belief.rings[0][k];
    EXPECT_LE((p.position - q.position).norm(), 0.05);
    EXPECT_NEAR(p.sigma, q.sigma, 1.0 / 32);
  }
  EXPECT_LT(last.truth.at(0).size(), true_last.truth.at(0).size());
  const auto paths = records_of<RecommendationRecord>(run);
  ASSERT_EQ(paths.size(), 1U);
  ASSERT_EQ(paths[0].value.path.size(), 1U);
}

TEST(PackRun, HasForecastsInTheOrderInWhichTheyWereMade) {
  const record::TemporaryFolder folder("forecasts");
  auto recorder =
      record::RunRecorder::create(folder.path(), {"1", 5, "n", kScenario, ""}).value();
  for (const double made : {0.0, 60.0})
    for (const double ahead : {60.0, 120.0})
      recorder->record(ForecastRecord{
          EntityId{0},
          {Time::from_seconds(made),
           record::believed_circle(Time::from_seconds(made + ahead), {0, 0}, 300, 20), 0,
           "m"}});
  record::record_sample(*recorder, 200, 1);
  ASSERT_TRUE(recorder->close());
  std::vector<std::array<double, 2>> ahead;
  for (const ForecastRecord& each :
       records_of<ForecastRecord>(pack_run(folder.path(), 1).value())) {
    ahead.push_back(
        {each.forecast.made.seconds(), each.forecast.boundary.time.seconds()});
    EXPECT_EQ(each.forecast.mission, "m");
    EXPECT_EQ(each.forecast.boundary.rings.size(), 1U);
  }
  EXPECT_EQ(ahead, (std::vector<std::array<double, 2>>{
                       {0, 60}, {0, 120}, {60, 120}, {60, 180}}));
}

TEST(PackRun, HasTheAircraftEverySecondAndAtTheEnd) {
  const record::TemporaryFolder folder("frames");
  make_run(folder.path(), 120, 2, 10);
  const PackedRun run = pack_run(folder.path(), 1).value();
  EXPECT_EQ(run.step, 1);
  std::map<Time, Vec3> places;
  for (const EstimateRecord& each : recorded<EstimateRecord>(folder.path()))
    if (each.id == EntityId{2}) places[each.nav.time] = each.nav.p_N;
  const auto frames = messages(run.frames);
  ASSERT_EQ(frames.size(), 121U);
  for (std::size_t k = 0; k < frames.size(); ++k) {
    const Time time = Time::from_seconds(static_cast<double>(k));
    EXPECT_EQ(frames[k].time, time.seconds());
    ASSERT_EQ(frames[k].items.size(), 2U);
    const auto& fleet = std::get<FleetFrame>(frames[k].items[0]);
    EXPECT_EQ(fleet.time, time);
    ASSERT_EQ(fleet.vehicles.size(), 2U);
    const VehicleView& uav = fleet.vehicles[1];
    EXPECT_NEAR(uav.north, places.at(time).x(), 0.04) << "1/16 m and single precision";
    EXPECT_EQ(uav.altitude_msl, 400);
    EXPECT_EQ(std::get<TruthFrame>(frames[k].items[1]).places.size(), 2U);
  }
}

TEST(PackRun, DescribesTheRunAsItsPageDoes) {
  const record::TemporaryFolder folder("describe");
  make_run(folder.path(), 20, 2, 1);
  const PackedRun run = pack_run(folder.path(), 1).value();
  const Json about = Json::parse(run.description);
  EXPECT_EQ(about["name"], "packed");
  EXPECT_EQ(about["version"], "1.2.3");
  EXPECT_EQ(about["duration_s"], 20);
  EXPECT_EQ(about["replay"], true);
  EXPECT_EQ(about["origin"]["latitude_deg"], 37);
  EXPECT_EQ(about["aircraft"].size(), 2U);
  EXPECT_GT(about["extent_m"], 600) << "the fire is 600 m wide";
  EXPECT_EQ(run.terrain.size(), 32U + 4 * 4);
}

TEST(PackRun, ARunIsDescribedWithoutThePluginsAndFilesOfItsScenario) {
  const record::TemporaryFolder folder("elsewhere");
  make_run(folder.path(), 20, 2, 1,
           "plugins: [/nowhere/kinds.so]\nradio: {kind: of-the-plugin, power_w: 2}\n"
           "links: {key_file: /nowhere/key}\n"
           "origin: {latitude_deg: 37, longitude_deg: -122}\n");
  const auto run = pack_run(folder.path(), 1);
  ASSERT_TRUE(run);
  EXPECT_EQ(Json::parse(run.value().description)["origin"]["latitude_deg"], 37);
}

TEST(PackRun, ARunWhoseScenarioCannotBeReadHasNoOrigin) {
  const record::TemporaryFolder folder("unread");
  make_run(folder.path(), 20, 2, 1, "no_such_key: 1\n");
  const auto run = pack_run(folder.path(), 1);
  ASSERT_TRUE(run);
  EXPECT_TRUE(Json::parse(run.value().description)["origin"].is_null());
  EXPECT_FALSE(run.value().frames.empty());
}

TEST(PackRun, ARunWithoutPlacesHasNoMap) {
  const record::TemporaryFolder folder("nothing");
  auto recorder =
      record::RunRecorder::create(folder.path(), {"1", 5, "n", "", ""}).value();
  ASSERT_TRUE(recorder->close());
  const auto map = report_map(folder.path(), 1);
  ASSERT_TRUE(map) << map.error().text();
  EXPECT_TRUE(map.value().empty());
  EXPECT_FALSE(report_map(folder.path() / "absent", 1));
}

TEST(PackRun, StaysSmallHoweverLongARunIs) {
  // An hour with ten aircraft and 720 perimeters. Less would be blurred, more is too much
  // for a page.
  const record::TemporaryFolder folder("long");
  make_run(folder.path(), 3600, 10, 1);
  const std::string whole = report_map(folder.path(), 1).value();
  EXPECT_LT(whole.size(), 1'500'000U);
  EXPECT_GT(Json::parse(whole)["step_s"], 1);
  const std::string part = report_map(folder.path(), 0.25).value();
  EXPECT_LT(static_cast<double>(part.size()), 0.4 * static_cast<double>(whole.size()));
}

}  // namespace
}  // namespace skein::serve::pack_run_test
