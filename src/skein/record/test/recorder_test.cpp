// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>

#include "sample_run.h"
#include "skein/record/store/replay.h"
#include "skein/record/store/run_recorder.h"
#include "skein/record/store/sqlite.h"
#include "skein/record/store/summary_recorder.h"

namespace skein::record::recorder_test {
namespace {

const RunInfo kInfo{"1.2.3", 18446744073709551615u, "sample", "seed: 1\n", ""};

double ask(const std::filesystem::path& run, const std::string& sql) {
  Sqlite database = Sqlite::open(run / "run.sqlite", Sqlite::Mode::kRead).value();
  Statement statement = database.prepare(sql).value();
  EXPECT_TRUE(statement.next()) << sql;
  return statement.real(0);
}

std::string ask_text(const std::filesystem::path& run, const std::string& sql) {
  Sqlite database = Sqlite::open(run / "run.sqlite", Sqlite::Mode::kRead).value();
  Statement statement = database.prepare(sql).value();
  EXPECT_TRUE(statement.next()) << sql;
  return statement.text(0);
}

TEST(RunRecorder, KeepsEverythingItWasGiven) {
  const TemporaryFolder folder("keeps");
  const auto run = folder.path() / "a" / "b";
  auto recorder = RunRecorder::create(run, kInfo).value();
  const std::vector<float> heights = {1, 2, 3, 4, 5, 6};
  recorder->store_terrain(2, 3, {-10, -20}, 5, heights);
  record_sample(*recorder, 300);
  const RunSummary summary = recorder->close().value();
  recorder.reset();

  EXPECT_EQ(ask(run, "SELECT count(*) FROM entities"), 3);
  EXPECT_EQ(ask(run, "SELECT count(*) FROM truth"), 2 * 3001);
  EXPECT_EQ(ask(run, "SELECT count(*) FROM estimates"), 2 * 3001);
  EXPECT_EQ(ask(run, "SELECT count(*) FROM readings"), 2 * 301);
  EXPECT_EQ(ask(run, "SELECT count(*) FROM tasks"), 2 * 6);
  EXPECT_EQ(ask(run, "SELECT count(*) FROM metrics"), 61);
  // Every 10 s, both ends included.
  EXPECT_EQ(ask(run, "SELECT count(*) FROM perimeters WHERE source = 'truth'"), 31);
  EXPECT_EQ(ask(run, "SELECT count(*) FROM perimeters WHERE source = 'belief'"), 31);
  EXPECT_EQ(ask(run, "SELECT length(data) FROM perimeters WHERE source='belief'"),
            80 * 9 * 4);
  EXPECT_EQ(ask(run, "SELECT length(heights_msl_m) FROM terrain"), 6 * 4);
  EXPECT_EQ(ask(run, "SELECT altitude_msl_m FROM truth"), 400);
  EXPECT_EQ(ask_text(run, "SELECT value FROM meta WHERE name='seed'"),
            "18446744073709551615");
  EXPECT_EQ(ask_text(run, "SELECT content_kind FROM messages WHERE to_id = 1"), "task");
  EXPECT_EQ(ask_text(run, "PRAGMA integrity_check"), "ok");
  EXPECT_FALSE(std::filesystem::exists(run / "run.sqlite-wal"));
  EXPECT_EQ(ask(run, "SELECT count(*) FROM crossings"), summary.numbers.at("crossings"));
  EXPECT_GT(summary.numbers.at("crossings"), 10);
}

TEST(RunRecorder, KeepsWhatThePayloadSaw) {
  const TemporaryFolder folder("payload");
  auto recorder = RunRecorder::create(folder.path(), kInfo).value();
  record_sample(*recorder, 100);
  const RunSummary summary = recorder->close().value();
  recorder.reset();
  const auto& run = folder.path();
  EXPECT_EQ(ask_text(run, "SELECT name FROM objects WHERE object_id = 1"), "person");
  EXPECT_EQ(ask(run, "SELECT north_m FROM detections WHERE time_s = 100"), 40 + 10 + 3);
  EXPECT_EQ(ask(run, "SELECT position_sd_m FROM detections"), 2.5);
  EXPECT_EQ(ask(run, "SELECT count(*) FROM footprints"), 101);
  EXPECT_EQ(ask(run, "SELECT corner_2_east_m - corner_4_east_m FROM footprints"), 18);
  EXPECT_EQ(
      ask(run,
          "SELECT count(*) FROM ranges WHERE sensor = 1 AND length(beams) = 3 * 4 * 4"),
      101);
  EXPECT_EQ(summary.number("objects"), 2);
  EXPECT_EQ(summary.number("objects_found"), 1);
  EXPECT_EQ(summary.number("detections"), 11);
  EXPECT_EQ(summary.number("pictures"), 101);
  EXPECT_EQ(summary.number("range_scans"), 101);
  EXPECT_NEAR(*summary.number("detection_error_rms_m"), 5, 1e-9);
  SummaryRecorder without(kInfo);
  EXPECT_FALSE(without.summary().number("detections")) << "nothing to count";
  EXPECT_FALSE(without.summary().number("range_scans"));
}

TEST(RunRecorder, KeepsChargeReserveAndEndurance) {
  const TemporaryFolder folder("reserve");
  auto recorder = RunRecorder::create(folder.path(), kInfo).value();
  record_sample(*recorder, 100);
  const RunSummary summary = recorder->close().value();
  recorder.reset();
  const auto& run = folder.path();
  const std::string at = " FROM estimates WHERE entity_id = 1 AND time_s = 50";
  EXPECT_DOUBLE_EQ(ask(run, "SELECT charge" + at), 0.95);
  EXPECT_DOUBLE_EQ(ask(run, "SELECT reserve" + at), 0.85);
  EXPECT_DOUBLE_EQ(ask(run, "SELECT endurance_s" + at), 950);
  EXPECT_EQ(ask(run, "SELECT count(endurance_s) FROM estimates WHERE entity_id = 2"), 0)
      << "not known: null";
  EXPECT_DOUBLE_EQ(*summary.number("min_reserve_uav1"), 0.8);
  EXPECT_FALSE(summary.number("min_reserve_uav2")) << "nothing is known of it";
}

TEST(RunRecorder, MessagesThatAreNotStoredCountAllTheSame) {
  const TemporaryFolder folder("unstored");
  const auto summary_of = [&](const char* name, bool messages) {
    RunRecorderOptions options;
    options.messages = messages;
    auto recorder = RunRecorder::create(folder.path() / name, kInfo, options).value();
    record_sample(*recorder, 120);
    return recorder->close().value();
  };
  const RunSummary with = summary_of("with", true),
                   without = summary_of("without", false);
  EXPECT_EQ(without.content_hash, with.content_hash);
  EXPECT_GT(with.numbers.at("messages_sent"), 200);
  EXPECT_GT(with.numbers.at("messages_lost"), 0);
  EXPECT_EQ(without.numbers.at("messages_sent"), with.numbers.at("messages_sent"));
  EXPECT_EQ(without.numbers.at("messages_lost"), with.numbers.at("messages_lost"));
  EXPECT_EQ(ask(folder.path() / "without", "SELECT count(*) FROM messages"), 0);
  EXPECT_EQ(ask(folder.path() / "without", "SELECT count(*) FROM tasks"),
            ask(folder.path() / "with", "SELECT count(*) FROM tasks"));
}

TEST(SummaryRecorder, TheHashIsOfWhatHappenedNotOfTheProgram) {
  const auto hash = [](const std::string& version, const std::string& text) {
    SummaryRecorder recorder({version, 1, "a name", text, ""});
    record_sample(recorder, 20);
    return recorder.summary().content_hash;
  };
  EXPECT_EQ(hash("0.1.0+g1", "seed: 1"), hash("0.1.0+g2.dirty", "seed: 1 # the same"));
}

TEST(SummaryRecorder, AddsUpTheTimeInWhichTheBeliefWasOverConfident) {
  const auto over_confident_s =
      [](const std::vector<std::pair<double, EventKind>>& events) {
        SummaryRecorder recorder(kInfo);
        for (const auto& [time, kind] : events)
          recorder.record(Event{Time::from_seconds(time), EntityId{0}, kind, ""});
        record_sample(recorder, 300);  // the last metrics are of 300 s
        return recorder.summary().number("over_confident_s");
      };
  EXPECT_FALSE(over_confident_s({})) << "never judged";
  EXPECT_EQ(over_confident_s({{50, EventKind::kTrusted}}), 0);
  EXPECT_EQ(over_confident_s({{50, EventKind::kTrusted},
                              {100, EventKind::kOverConfident},
                              {160, EventKind::kTrusted}}),
            60);
  EXPECT_EQ(over_confident_s({{100, EventKind::kOverConfident},
                              {160, EventKind::kTrusted},
                              {250, EventKind::kOverConfident}}),
            110);
}

TEST(RunRecorder, WritesASummaryThatScriptsCanRead) {
  const TemporaryFolder folder("summary");
  auto recorder = RunRecorder::create(folder.path(), kInfo).value();
  record_sample(*recorder, 300);
  recorder->set_figure("deadline_misses", 4);
  const RunSummary summary = recorder->close(true).value();

  std::ifstream file(folder.path() / "summary.json");
  const auto json = nlohmann::json::parse(file);
  for (const char* name : {"content_hash",    "seed",
                           "version",         "simulated_s",
                           "wall_s",          "real_time_factor",
                           "deadline_misses", "aircraft",
                           "observations",    "crossings",
                           "messages_sent",   "messages_lost",
                           "message_copies",  "messages_per_aircraft_s",
                           "perf_mean_m",     "boundary_rms_mean_m",
                           "sigma_mean_m",    "boundary_hausdorff_mean_m",
                           "iou_mean",        "coverage_95_mean",
                           "nees_mean",       "crps_mean_m",
                           "perf_final_m",    "boundary_rms_final_m",
                           "sigma_final_m",   "boundary_hausdorff_final_m",
                           "iou_final",       "coverage_95_final",
                           "nees_final",      "crps_final_m",
                           "perf_run_mean_m", "distance_flown_uav1_m"})
    EXPECT_TRUE(json.contains(name)) << name;
  EXPECT_EQ(json["seed"], 18446744073709551615u);
  EXPECT_EQ(json["interrupted"], true);
  EXPECT_EQ(json["deadline_misses"], 4);
  EXPECT_EQ(json["aircraft"], 2);
  EXPECT_EQ(json["simulated_s"], 300);
  EXPECT_EQ(json["content_hash"], summary.content_hash);
  EXPECT_EQ(json["allocation_start_s"], 60);
  // Before the allocation the belief is worst: the run's mean must be above the phase's.
  EXPECT_GT(json["sigma_run_mean_m"], json["sigma_mean_m"]);
  EXPECT_EQ(ask(folder.path(), "SELECT avg(perf_m) FROM metrics WHERE time_s >= 60"),
            json["perf_mean_m"].get<double>());
}

TEST(RunRecorder, HashesTheContentAndNothingElse) {
  const TemporaryFolder folder("hash");
  SummaryRecorder light(kInfo);
  record_sample(light, 200);
  const RunSummary expected = light.summary();

  RunRecorderOptions options;
  options.perimeter_period = Time::from_seconds(60);
  auto recorder = RunRecorder::create(folder.path(), kInfo, options).value();
  record_sample(*recorder, 200);
  const RunSummary stored = recorder->close().value();
  EXPECT_EQ(stored.content_hash, expected.content_hash);
  for (const auto& [name, value] : expected.numbers)
    if (name != "wall_s" && name != "real_time_factor") {
      EXPECT_EQ(stored.numbers.at(name), value) << name;
    }

  SummaryRecorder longer(kInfo);
  record_sample(longer, 201);
  EXPECT_NE(longer.summary().content_hash, expected.content_hash);
}

std::string hash_of(const Record& record) {
  SummaryRecorder recorder(kInfo);
  recorder.record(record);
  return recorder.summary().content_hash;
}

// That every field of every kind counts is tested beside the descriptions.
TEST(RunRecorder, OrdersAndBeliefsThatDifferHashDifferently) {
  const auto order = [](double angle) {
    FollowEdge edge;
    edge.angle = angle;
    return hash_of(MessageRecord{
        {EntityId{1}, EntityId{2}, 5, Time(), Task{1, edge}}, Time(), 9, false});
  };
  EXPECT_NE(order(0.1), order(0.2));
  const auto belief = [](double axis) {
    BoundaryEstimate one = believed_circle({}, {0, 0}, 100, 5, 8);
    one.rings[0][3].major_axis.x() = axis;
    return hash_of(PerimeterRecord{{}, EntityId{0}, {circle({0, 0}, 90, 8)}, one});
  };
  EXPECT_NE(belief(1), belief(2));
  EXPECT_EQ(belief(0.0), belief(-0.0)) << "numbers count by value";
}

TEST(RunRecorder, HoldsNoInfiniteNumbers) {
  const TemporaryFolder folder("finite");
  auto recorder = RunRecorder::create(folder.path(), kInfo).value();
  recorder->record(EntityRecord{EntityId{1}, "uav", "aircraft"});
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  EstimateRecord estimate{EntityId{1}, {}, {}};
  estimate.status.reserve = -kInfinity;  // the wind lets it get nowhere
  recorder->record(estimate);
  recorder->set_figure("more", kInfinity);
  recorder->set_figure("none", std::nan(""));
  const RunSummary summary = recorder->close().value();
  for (const auto& [name, value] : summary.numbers)
    EXPECT_TRUE(std::isfinite(value)) << name;
  EXPECT_FALSE(summary.number("min_reserve_uav"));
  EXPECT_FALSE(summary.number("more"));
  EXPECT_EQ(
      ask(folder.path(), "SELECT count(*) FROM summary WHERE value IN (9e999, -9e999)"),
      0);
  EXPECT_EQ(ask(folder.path(), "SELECT count(*) FROM estimates WHERE reserve IS NULL"),
            1);
}

TEST(RunRecorder, IsTheOnlyOneInItsFolder) {
  const TemporaryFolder folder("alone");
  RunRecorderOptions overwrite;
  overwrite.overwrite = true;
  auto first = RunRecorder::create(folder.path(), kInfo).value();
  first->record(EntityRecord{EntityId{1}, "uav", "aircraft"});
  const auto second = RunRecorder::create(folder.path(), kInfo, overwrite);
  ASSERT_FALSE(second);
  EXPECT_NE(second.error().text().find("writes there now"), std::string::npos);
  ASSERT_TRUE(first->close());
  first.reset();
  EXPECT_TRUE(RunRecorder::create(folder.path(), kInfo, overwrite));
}

// Whoever reads a run that is replaced has a log of the same name as the new one.
TEST(RunRecorder, AReaderOfTheOldRunTakesNothingFromTheNewOne) {
  const TemporaryFolder folder("replaced");
  {
    auto cut_off = RunRecorder::create(folder.path() / "live", kInfo).value();
    record_sample(*cut_off, 20);
    usleep(500000);  // committed
    std::filesystem::copy(folder.path() / "live", folder.path() / "run");
  }
  auto reader = std::make_unique<Sqlite>(
      Sqlite::open(folder.path() / "run" / "run.sqlite", Sqlite::Mode::kRead).value());
  RunRecorderOptions overwrite;
  overwrite.overwrite = true;
  auto recorder = RunRecorder::create(folder.path() / "run", kInfo, overwrite).value();
  recorder->record(EntityRecord{EntityId{1}, "uav", "aircraft"});
  usleep(500000);
  reader.reset();
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "run" / "run.sqlite-wal"));
  EXPECT_EQ(ask(folder.path() / "run", "SELECT count(*) FROM entities"), 1);
  ASSERT_TRUE(recorder->close());
  EXPECT_EQ(ask(folder.path() / "run", "SELECT count(*) FROM entities"), 1);
}

TEST(RunRecorder, GivesBackTheCommandsToTheLastBit) {
  const TemporaryFolder folder("commands");
  auto recorder = RunRecorder::create(folder.path(), kInfo).value();
  std::vector<CommandRecord> given;
  for (int k = 0; k < 50; ++k)
    given.push_back({Time::from_ns(123456789LL * k), "terminal",
                     TaskCommand{"uav-1", FlyCourse{0.1 + 1.0 / (3 + k)}}});
  given.push_back({Time::from_seconds(99), "page",
                   ZoneChange{0, true, {.area = Disc{{1, 2}, 3}, .name = "a"}}});
  for (const CommandRecord& command : given) recorder->record(command);
  const RunSummary summary = recorder->close(true).value();
  const RecordedRun recorded = read_recorded(folder.path()).value();
  EXPECT_EQ(recorded.content_hash, summary.content_hash);
  EXPECT_TRUE(recorded.interrupted);
  SummaryRecorder again(kInfo);
  for (const CommandRecord& command : recorded.commands) again.record(command);
  EXPECT_EQ(again.summary().content_hash, summary.content_hash);
  EXPECT_EQ(ask_text(folder.path(), "SELECT sender FROM commands WHERE kind = 'zone'"),
            "page");
  EXPECT_EQ(ask(folder.path(),
                "SELECT json_extract(json, '$.area.radius_m') FROM commands"
                " WHERE kind = 'zone'"),
            3);
}

TEST(RunRecorder, WaitsForASlowDiskInsteadOfGrowing) {
  // Four times the queue: only passes when rows are written while others are given.
  const TemporaryFolder folder("slow");
  auto recorder = RunRecorder::create(folder.path(), kInfo).value();
  for (int i = 0; i < 4 * 65536; ++i)
    recorder->record(TruthRecord{Time::from_ns(i), EntityId{1}, {}});
  ASSERT_TRUE(recorder->close());
  EXPECT_EQ(ask(folder.path(), "SELECT count(*) FROM truth"), 4 * 65536);
}

TEST(RunRecorder, EndsARunOfNoLength) {
  const TemporaryFolder folder("empty");
  auto recorder = RunRecorder::create(folder.path(), kInfo).value();
  const RunSummary summary = recorder->close().value();
  EXPECT_EQ(summary.numbers.at("aircraft"), 0);
  EXPECT_EQ(summary.numbers.at("simulated_s"), 0);
  EXPECT_FALSE(summary.number("perf_mean_m"));
  for (const auto& [name, value] : summary.numbers)
    EXPECT_TRUE(std::isfinite(value)) << name;
}

TEST(RunRecorder, KeepsZonesAndWhenTheyCameAndWent) {
  const TemporaryFolder folder("zones");
  auto recorder = RunRecorder::create(folder.path() / "run", kInfo).value();
  Zone disc{.area = Disc{{10, 20}, 30}, .name = "disc"};
  disc.ceiling_msl = 120;
  disc.until = 600;
  const Zone ring{.area = geo::Ring{{0, 0}, {9, 0}, {9, 9}}, .name = "ring"};
  recorder->record(ZoneRecord{Time(), {0, true, disc}});
  recorder->record(ZoneRecord{Time::from_seconds(5), {1, true, ring}});
  recorder->record(ZoneRecord{Time::from_seconds(9), {2, false, {.name = "disc"}}});
  ASSERT_TRUE(recorder->close());
  recorder.reset();
  const auto run = folder.path() / "run";
  EXPECT_EQ(ask(run, "SELECT count(*) FROM zones"), 3);
  const std::string of_disc = "FROM zones WHERE name = 'disc' AND in_force = 1";
  EXPECT_EQ(ask(run, "SELECT json_extract(area_json, '$.radius_m') " + of_disc), 30);
  EXPECT_EQ(ask(run, "SELECT json_extract(area_json, '$.centre_east_m') " + of_disc), 20);
  EXPECT_EQ(ask(run, "SELECT ceiling_msl_m " + of_disc), 120);
  EXPECT_EQ(ask(run, "SELECT floor_msl_m IS NULL " + of_disc), 1);
  EXPECT_EQ(ask(run, "SELECT until_s " + of_disc), 600);
  EXPECT_EQ(ask_text(run, "SELECT area_json FROM zones WHERE name = 'ring'"),
            R"({"kind":"ring","points":[[0.0,0.0],[9.0,0.0],[9.0,9.0]]})");
  EXPECT_EQ(ask(run, "SELECT time_s FROM zones WHERE in_force = 0"), 9);
  EXPECT_EQ(ask(run, "SELECT number FROM zones WHERE in_force = 0"), 2);
}

}  // namespace
}  // namespace skein::record::recorder_test
