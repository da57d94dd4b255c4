// SPDX-License-Identifier: Apache-2.0
#include "skein/record/report/report.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <numeric>
#include <sstream>

#include "sample_run.h"
#include "skein/record/report/page.h"
#include "skein/record/report/study_report.h"
#include "skein/record/store/run_reader.h"
#include "skein/record/store/run_recorder.h"
#include "skein/record/store/sqlite.h"

namespace skein::record::report_test {
namespace {

namespace fs = std::filesystem;

const RunInfo kInfo{"1.2.3", 5, "sample </script> & <b>", "seed: 5 # </script>\n", ""};

void make_run(const fs::path& directory, int seconds, int aircraft = 2,
              int rows_per_second = 10) {
  auto recorder = RunRecorder::create(directory, kInfo).value();
  std::vector<float> heights;
  for (int r = 0; r < 40; ++r)
    for (int c = 0; c < 40; ++c)
      heights.push_back(
          static_cast<float>(300 + 60 * std::sin(r / 5.0) * std::cos(c / 7.0)));
  recorder->store_terrain(40, 40, {-1200, -1200}, 60, heights);
  record_sample(*recorder, seconds, aircraft, rows_per_second);
  ASSERT_TRUE(recorder->close());
}

std::string text_of(const fs::path& file) {
  std::ifstream in(file);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

nlohmann::json data_of(const fs::path& file) {
  const std::string text = text_of(file), mark = "id=\"data\">";
  const std::size_t begin = text.find(mark) + mark.size();
  return nlohmann::json::parse(text.substr(begin, text.find("</script>", begin) - begin));
}

// What a browser makes of the page; empty when this machine has no browser.
std::string shown(const fs::path& page, const fs::path& scratch) {
  if (std::system("command -v chromium >/dev/null 2>&1") != 0) return "";
  const fs::path out = scratch / "dom.html";
  const std::string command =
      "timeout 60 chromium --headless --no-sandbox --disable-gpu --disable-quic"
      " --no-first-run --disable-background-networking --disable-component-update"
      " --disable-sync --virtual-time-budget=5000 --user-data-dir='" +
      (scratch / "browser").string() + "' --dump-dom 'file://" + page.string() + "' > '" +
      out.string() + "' 2>/dev/null";
  if (std::system(command.c_str()) == 0) return text_of(out);
  ADD_FAILURE() << "chromium is there but fails: " << command;
  return "";
}

// Everything about alerts that a run has, with a row that is older than all others shown.
void record_alerts(RunRecorder& recorder) {
  for (int t = 10; t < 40; ++t) {
    TrafficBeliefRecord belief;
    belief.time = Time::from_seconds(t);
    belief.id = EntityId{1};
    belief.value.track = 6;
    belief.value.firm = true;
    belief.value.position = Vec3(900 - 20 * t, 0, -400);
    belief.value.velocity = Vec3(-20, 0, 1);
    belief.value.horizontal_sd = 12;
    recorder.record(belief);
    BandRecord bands{Time::from_seconds(t), EntityId{1}, {}};
    bands.value.level = t < 39 ? 2 : 0;
    bands.value.track_advised = geo::radians(80);
    bands.value.tracks = {{0, geo::radians(79.96), AlertRegion::kMid},
                          {geo::radians(300), geo::radians(360), AlertRegion::kNear}};
    bands.value.altitudes = {{350, 450, AlertRegion::kMid}};
    recorder.record(bands);
  }
  for (const auto& [time, level] : {std::pair{12.0, 2u}, {39.0, 0u}}) {
    AlertRecord alert{Time::from_seconds(time), EntityId{1}, {}};
    alert.value.track = 6;
    alert.value.level = level;
    alert.value.region = level > 0 ? AlertRegion::kMid : AlertRegion::kNone;
    recorder.record(alert);
  }
  using enum RecommendationState;
  recorder.record(
      RecommendationRecord{Time::from_seconds(15),
                           EntityId{1},
                           {1, kShown, "around an intruder", {{15, Vec3(1, 2, -300)}}}});
  recorder.record(RecommendationRecord{
      Time::from_seconds(22), EntityId{1}, {1, kFollowed, "around an intruder", {}}});
}

TEST(Report, ShowsAlertsBandsAndWhatPilotsWereShown) {
  const TemporaryFolder folder("report_alerts");
  auto recorder = RunRecorder::create(folder.path() / "one", kInfo).value();
  record_sample(*recorder, 60, 2, 10);
  record_alerts(*recorder);
  ASSERT_TRUE(recorder->close());
  const fs::path page = folder.path() / "report.html";
  const fs::path runs[] = {folder.path() / "one"};
  ASSERT_TRUE(write_report(runs, page));
  const nlohmann::json alerting = data_of(page)["runs"][0]["alerting"];
  ASSERT_EQ(alerting["alerts"].size(), 2u);
  EXPECT_EQ(alerting["alerts"][0]["region"], "MID");
  ASSERT_EQ(alerting["bands"].size(), 1u);
  const nlohmann::json& rows = alerting["bands"][0]["rows"];
  ASSERT_EQ(rows.size(), 30u);
  EXPECT_EQ(
      rows[0].dump(),
      "[10.0,2,80.0,null,null,null,[0.0,80.0,2,300.0,360.0,3],[],[],[350.0,450.0,2]]");
  EXPECT_EQ(rows.back()[1], 0) << "the end stays";
  ASSERT_EQ(alerting["recommendations"].size(), 2u);
  EXPECT_EQ(alerting["recommendations"][0]["path"][0]["altitude_msl_m"], 300);
  EXPECT_EQ(alerting["recommendations"][1]["state"], "followed");
  const std::string dom = shown(page, folder.path());
  if (dom.empty()) GTEST_SKIP() << "no browser here";
  EXPECT_NE(dom.find("data-state=\"ready\""), std::string::npos);
}

TEST(Report, HoldsTheRunAndNothingFromTheNetwork) {
  const TemporaryFolder folder("report");
  make_run(folder.path() / "one", 300);
  const fs::path page = folder.path() / "report.html";
  const fs::path runs[] = {folder.path() / "one"};
  ASSERT_TRUE(write_report(runs, page));

  const std::string html = text_of(page);
  EXPECT_EQ(html.find(" src="), std::string::npos);
  EXPECT_EQ(html.find("<link"), std::string::npos);
  const nlohmann::json data = data_of(page);
  const auto& run = data["runs"][0];
  EXPECT_EQ(run["name"], kInfo.name);
  EXPECT_EQ(run["state"], "complete");
  EXPECT_EQ(run["duration_s"], 300);
  EXPECT_EQ(run["allocation_start_s"], 60);
  EXPECT_TRUE(run["map"].is_null()) << "nobody packed one";
  EXPECT_GT(run["summary"]["perf_mean_m"], 0);
}

TEST(Report, HoldsTheMapsThatArePackedForItWhichShareItsRoom) {
  const TemporaryFolder folder("maps");
  make_run(folder.path() / "one", 20);
  make_run(folder.path() / "two", 20);
  const fs::path runs[] = {folder.path() / "one", folder.path() / "two"};
  const fs::path page = folder.path() / "report.html";
  ASSERT_TRUE(write_report(
      runs, page, [](const fs::path& directory, double share) -> Result<std::string> {
        EXPECT_EQ(share, 0.5);
        if (directory.filename() == "two") return std::string();
        return std::string("{\"step_s\": 3}");
      }));
  const nlohmann::json data = data_of(page);
  EXPECT_EQ(data["runs"][0]["map"]["step_s"], 3);
  EXPECT_TRUE(data["runs"][1]["map"].is_null());
  const auto done = write_report(
      runs, page, [](const fs::path& directory, double) -> Result<std::string> {
        return Error{ErrorCode::kBadInput, directory.string(), "cannot be packed", ""};
      });
  ASSERT_FALSE(done);
  EXPECT_NE(done.error().text().find("two"), std::string::npos);
}

TEST(Report, ShowsWhatForecastsWereWorthAndWhenTheFireWasToCome) {
  const TemporaryFolder folder("forecasts");
  const EntityId ground{0};
  auto recorder = RunRecorder::create(folder.path() / "one", kInfo).value();
  for (const double made : {0.0, 60.0}) {
    for (const double ahead : {60.0, 120.0})
      recorder->record(ForecastRecord{
          ground,
          {Time::from_seconds(made),
           believed_circle(Time::from_seconds(made + ahead), {0, 0}, 300, 20), 0, "m"}});
    ArrivalForecast arrival;
    arrival.made = Time::from_seconds(made);
    arrival.place = "hut";
    arrival.mission = "m";
    arrival.early = made + 600;
    arrival.middle = made + 1200;  // no late: it may never come
    recorder->record(ArrivalRecord{ground, arrival});
  }
  record_sample(*recorder, 200, 1);
  ASSERT_TRUE(recorder->close());
  const fs::path page = folder.path() / "report.html";
  const fs::path runs[] = {folder.path() / "one"};
  ASSERT_TRUE(write_report(runs, page));
  const nlohmann::json data = data_of(page);
  std::vector<std::string> lines;
  for (const auto& series : data["runs"][0]["missions"]["series"])
    lines.push_back(series["text"].get<std::string>() + "; " +
                    series["name"].get<std::string>());
  EXPECT_EQ(lines,
            (std::vector<std::string>{"forecasts: intersection over union; m 1 min ahead",
                                      "forecasts: intersection over union; m 2 min ahead",
                                      "forecasts: share in the 95 % band; m 1 min ahead",
                                      "forecasts: share in the 95 % band; m 2 min ahead",
                                      "fire at hut, as forecast [min]; m 10 %",
                                      "fire at hut, as forecast [min]; m 50 %"}));
}

TEST(Report, ShowsInABrowserWithoutErrors) {
  const TemporaryFolder folder("browser");
  make_run(folder.path() / "one", 120);
  make_run(folder.path() / "two", 60);
  const fs::path page = folder.path() / "report.html";
  const fs::path runs[] = {folder.path() / "one", folder.path() / "two"};
  ASSERT_TRUE(write_report(runs, page));
  const std::string dom = shown(page, folder.path());
  if (dom.empty()) GTEST_SKIP() << "no chromium on this machine";
  EXPECT_NE(dom.find("data-state=\"ready\""), std::string::npos);
  EXPECT_EQ(dom.find("role=\"alert\""), std::string::npos);
  EXPECT_NE(dom.find("class=\"uplot"), std::string::npos);
}

TEST(Report, ShowsHowTheAircraftOfOneRunFlew) {
  const TemporaryFolder folder("flights");
  make_run(folder.path() / "one", 300);
  const StoredRun run = read_run(folder.path() / "one", {}).value();
  ASSERT_EQ(run.flights.size(), 2u);
  const FlightSeries& first = run.flights[0];
  ASSERT_EQ(first.time.size(), 301u);  // every second, of ten rows each
  double error2 = 0;
  for (std::size_t k = 0; k < first.time.size(); ++k) {
    const auto t = static_cast<float>(k);
    ASSERT_EQ(first.time[k], t);
    EXPECT_EQ(first.altitude_msl[k], 400);
    EXPECT_EQ(first.airspeed[k], 20);
    EXPECT_NEAR(first.cross_track[k], 0.5 * std::sin(k), 1e-6);
    EXPECT_NEAR(first.reserve[k], 0.9 - static_cast<double>(k) / 1000, 1e-6);
    error2 += static_cast<double>(first.position_error[k] * first.position_error[k]);
    EXPECT_TRUE(std::isnan(run.flights[1].cross_track[k])) << "it follows nothing";
  }
  // Two unit normal errors, 301 of them: a deviation of 2 / sqrt(301), five times that.
  EXPECT_NEAR(error2 / 301, 2, 0.6);
  ReadBudget less;
  less.flights = 1;
  less.flight_samples = 100;
  const StoredRun thin = read_run(folder.path() / "one", less).value();
  ASSERT_EQ(thin.flights.size(), 1u);
  EXPECT_EQ(thin.flights[0].time.size(), 101u);
}

TEST(FlightSeries, HasEvenStepsUntilTheEndOfALongRun) {
  FlightSeriesBuilder builder(7.2, 8);
  for (int k = 0; k <= 36000; ++k)
    builder.truth(EntityId{1}, {0.1 * k, Vec2::Zero(), 100, 20, 1});
  const FlightSeries series = builder.take().at(0);
  ASSERT_EQ(series.time.size(), 501u);
  for (std::size_t k = 0; k < series.time.size(); ++k)
    EXPECT_NEAR(series.time[k], 7.2 * static_cast<double>(k), 1e-3);
}

TEST(Report, LeavesOutWhatAFlightWithoutFireHasNot) {
  const TemporaryFolder folder("no_fire");
  auto recorder = RunRecorder::create(folder.path() / "run", kInfo).value();
  const EntityId id{1};
  recorder->record(EntityRecord{id, "uav", "aircraft"});
  for (int k = 0; k < 60; ++k) {
    VehicleState state;
    state.p_N = Vec3(k, 0, -100 - k);
    NavEstimate estimate;
    estimate.time = Time::from_seconds(k);
    estimate.p_N = state.p_N + Vec3(0.1 * k, 0, 0);
    recorder->record(TruthRecord{estimate.time, id, state});
    recorder->record(EstimateRecord{id, estimate, {}});
    ASSERT_TRUE(recorder->step_done(estimate.time));
  }
  ASSERT_TRUE(recorder->close());
  const fs::path page = folder.path() / "report.html";
  const fs::path runs[] = {folder.path() / "run"};
  ASSERT_TRUE(write_report(runs, page));
  const std::string dom = shown(page, folder.path());
  if (dom.empty()) GTEST_SKIP() << "no chromium on this machine";
  const std::size_t main = dom.find("<main");
  const std::string body = dom.substr(main, dom.find("</main>") - main);
  EXPECT_NE(body.find(">Altitude<"), std::string::npos);
  EXPECT_NE(body.find(">Error of own position<"), std::string::npos);
  EXPECT_EQ(body.find(">Airspeed<"), std::string::npos) << "it does not change";
  EXPECT_EQ(body.find("Intersection over union"), std::string::npos);
  EXPECT_EQ(body.find("The records hold nothing"), std::string::npos);
}

TEST(Report, ReadsARunThatWasCutOff) {
  // As SIGKILL leaves it: the database and its log copied while the run goes on.
  const TemporaryFolder folder("cut");
  const fs::path live = folder.path() / "live", copy = folder.path() / "copy";
  auto recorder = RunRecorder::create(live, kInfo).value();
  record_sample(*recorder, 200);
  usleep(800000);  // several commit periods
  fs::copy(live, copy);
  const fs::path runs[] = {copy};
  ASSERT_TRUE(write_report(runs, folder.path() / "cut.html"));
  const auto cut = data_of(folder.path() / "cut.html")["runs"][0];
  EXPECT_EQ(cut["state"], "cut off");

  // Its figures are those of the full records, computed from the rows.
  const RunSummary whole = recorder->close().value();
  for (const char* name :
       {"perf_mean_m", "iou_final", "crossings", "observations", "messages_sent",
        "aircraft", "objects_found", "detections", "detection_error_rms_m", "pictures",
        "range_scans", "min_reserve_uav1"})
    EXPECT_NEAR(cut["summary"][name].get<double>(), whole.numbers.at(name), 1e-9) << name;
}

TEST(Report, ShowsWhatRadiosDidAndWhoHeardWhom) {
  const TemporaryFolder folder("radios");
  make_run(folder.path() / "run", 200);
  const fs::path runs[] = {folder.path() / "run"};
  ASSERT_TRUE(write_report(runs, folder.path() / "run.html"));
  const auto run = data_of(folder.path() / "run.html")["runs"][0];
  const auto& radio = run["radio"];
  // The station's: sends a tenth of the time, hears others three tenths.
  EXPECT_NEAR(run["summary"]["radio_load_max"].get<double>(), 0.4, 1e-9);
  EXPECT_EQ(run["summary"]["messages_lost"], run["summary"]["messages_lost_retry_limit"]);
  // Every message was sent once, and each counts in the bin in which it was sent.
  const auto& bytes = run["messages"]["bytes"];
  ASSERT_FALSE(bytes.empty());
  for (const auto& [kind, bins] : bytes.items()) {
    EXPECT_EQ(bins.size(), run["messages"]["sent"].size()) << kind;
    const auto all = bins.get<std::vector<double>>();
    EXPECT_GT(std::accumulate(all.begin(), all.end(), 0.0), 0) << kind;
  }
  ASSERT_FALSE(radio["links"].empty());
  const auto& link = radio["links"][0];
  EXPECT_EQ(link["from"], 1);
  EXPECT_EQ(link["to"], 0);
  EXPECT_EQ(link["arrived"].get<int>(), 9 * link["lost"].get<int>());
  EXPECT_NEAR(link["rssi_dbm"].get<double>(), -75, 1e-9);
  EXPECT_EQ(radio["radios"][1]["retry_limit"].get<int>(), 3 * 20) << "each ten seconds";
  EXPECT_EQ(radio["radios"][0]["waiting"], 2) << "the most, not the sum";
}

TEST(Report, SaysWhenARunIsOfAnotherVersion) {
  const TemporaryFolder folder("older");
  make_run(folder.path() / "old", 60);
  auto database =
      Sqlite::open(folder.path() / "old" / "run.sqlite", Sqlite::Mode::kCreate).value();
  ASSERT_TRUE(database.execute("PRAGMA user_version = 4;"));
  const auto run = read_run(folder.path() / "old", {});
  ASSERT_FALSE(run.ok());
  EXPECT_NE(run.error().text().find("version 4"), std::string::npos)
      << run.error().text();
}

TEST(Report, ShowsRunsThatHoldLittle) {
  const TemporaryFolder folder("little");
  const auto make = [&](const char* name, auto&& fill) {
    auto recorder = RunRecorder::create(folder.path() / name, kInfo).value();
    fill(*recorder);
    ASSERT_TRUE(recorder->close());
  };
  make("nothing", [](RunRecorder&) {});
  make("one_row", [](RunRecorder& r) {
    r.record(EntityRecord{EntityId{1}, "uav", "aircraft"});
    r.record(TruthRecord{{}, EntityId{1}, {}});
  });
  make("no_fire", [](RunRecorder& r) {
    r.record(PerimeterRecord{{}, EntityId{0}, {}, believed_circle({}, {0, 0}, 100, 5)});
  });
  make("no_belief", [](RunRecorder& r) {
    r.record(PerimeterRecord{{}, EntityId{0}, {circle({0, 0}, 100, 8)}, {}});
  });
  std::vector<fs::path> runs;
  for (const char* name : {"nothing", "one_row", "no_fire", "no_belief"})
    runs.push_back(folder.path() / name);
  const fs::path page = folder.path() / "little.html";
  ASSERT_TRUE(write_report(runs, page));
  EXPECT_EQ(data_of(page)["runs"].size(), 4u);
  EXPECT_TRUE(data_of(page)["runs"][0]["map"].is_null());
  for (const fs::path& run : runs)
    EXPECT_TRUE(write_report(std::span(&run, 1), folder.path() / "single.html"));

  const std::string dom = shown(page, folder.path());
  if (!dom.empty()) {
    EXPECT_NE(dom.find("data-state=\"ready\""), std::string::npos);
  }
}

TEST(Report, NamesEveryRunThatCannotBeRead) {
  const TemporaryFolder folder("unreadable");
  fs::create_directories(folder.path() / "broken");
  std::ofstream(folder.path() / "broken" / "run.sqlite") << std::string(8192, 'x');
  const fs::path runs[] = {folder.path() / "absent", folder.path() / "broken"};
  const auto done = write_report(runs, folder.path() / "report.html");
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().code, ErrorCode::kNotFound);
  EXPECT_NE(done.error().text().find("absent"), std::string::npos);
  EXPECT_NE(done.error().text().find("broken"), std::string::npos);
  EXPECT_FALSE(fs::exists(folder.path() / "report.html"));
}

// A run with a scenario as the program writes it; `wind` stands for its environment.
fs::path compared_run(const TemporaryFolder& folder, const std::string& estimator,
                      const std::string& wind) {
  const fs::path directory = folder.path() / (estimator + wind);
  const RunInfo info{
      "1", 5, "n",
      "origin:\n  latitude_deg: 1\nenvironment:\n  wind: " + wind +
          "\nmissions:\n  - kind: perimeter\n    estimator:\n      kind: " + estimator +
          "\n    strategy: sweep\n",
      ""};
  auto recorder = RunRecorder::create(directory, info).value();
  record_sample(*recorder, estimator == "joint" ? 120 : 150);
  EXPECT_TRUE(recorder->close());
  return directory;
}

TEST(Report, MarksTheBestOnlyAmongRunsOnTheSameFire) {
  const TemporaryFolder folder("fires");
  const std::vector<fs::path> same = {compared_run(folder, "joint", "calm"),
                                      compared_run(folder, "qkf", "calm")};
  const std::vector<fs::path> different = {same[0], compared_run(folder, "qkf", "storm")};
  ASSERT_TRUE(write_report(same, folder.path() / "same.html"));
  ASSERT_TRUE(write_report(different, folder.path() / "different.html"));
  const std::string fair = shown(folder.path() / "same.html", folder.path());
  if (fair.empty()) GTEST_SKIP() << "no chromium on this machine";
  EXPECT_NE(fair.find("\"> (best)</span>"), std::string::npos);
  for (const char* text : {">joint</td>", ">qkf</td>", ">sweep</td>"})
    EXPECT_NE(fair.find(text), std::string::npos) << text;
  const std::string unfair = shown(folder.path() / "different.html", folder.path());
  EXPECT_EQ(unfair.find("\"> (best)</span>"), std::string::npos);
  EXPECT_NE(unfair.find("their fires differ"), std::string::npos);
}

TEST(Report, SaysWhenThePageCannotBeWritten) {
  const TemporaryFolder folder("page");
  make_run(folder.path() / "one", 10);
  const fs::path runs[] = {folder.path() / "one"};
  const auto done = write_report(runs, folder.path() / "no" / "such" / "place.html");
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().code, ErrorCode::kUnavailable);
}

TEST(Report, StaysSmall) {
  // One hour with ten aircraft and 720 perimeters, without its map.
  const TemporaryFolder folder("small");
  make_run(folder.path() / "hour", 3600, 10, 2);
  const fs::path runs[] = {folder.path() / "hour"};
  const fs::path page = folder.path() / "hour.html";
  ASSERT_TRUE(write_report(runs, page));
  EXPECT_LT(fs::file_size(page), 2u << 20);
}

TEST(StudyReport, KeepsTextNumbersAndGaps) {
  const TemporaryFolder folder("study");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  StudyReport report;
  report.title = "Estimators & strategies";
  report.intro = {"What was done.", "And how."};
  report.tables = {{"Table",
                    "Caption",
                    {"estimator", "Perf [m]"},
                    {{{"qkf"}, {163.0}}, {{"joint"}, {9.6, true}}, {{"none"}, {nan}}}}};
  StudyPlot plot{"Plot", "", "distance [m]", "sd [m]", true, true, {}, {{1, "one"}}};
  plot.series = {{"a", {1, 10, 100}, {1, nan, 2}, {0.5, 0.5, 1}, {2, 2, 3}},
                 {"b", {2, 20}, {3, 4}, {}, {}, true, true}};
  for (int k = 0; k < 10; ++k)
    plot.series.push_back({fmt::format("more {}", k), {1, 2}, {3, 4}, {}, {}});
  report.plots = {plot};
  report.dots = {{"Dots",
                  "",
                  "Perf [m]",
                  true,
                  {"gus", "sweep"},
                  {"qkf", "joint"},
                  {{{163, 150, 180}, {40, nan, nan}}, {{1e6, 1, 1e7}, {nan, nan, nan}}}}};
  report.alert = "partial: 5 of 20 runs";
  report.notes = {"A note."};
  const fs::path page = folder.path() / "study.html";
  ASSERT_TRUE(write_study_report(report, page));

  const nlohmann::json data = data_of(page);
  EXPECT_EQ(data["page"], "study");
  EXPECT_EQ(data["tables"][0]["rows"][1][1]["highlight"], true);
  EXPECT_TRUE(data["tables"][0]["rows"][2][1]["number"].is_null());
  EXPECT_TRUE(data["plots"][0]["series"][0]["y"][1].is_null());
  EXPECT_EQ(data["plots"][0]["lines"][0]["label"], "one");
  const std::string dom = shown(page, folder.path());
  if (dom.empty()) GTEST_SKIP() << "no chromium on this machine";
  EXPECT_NE(dom.find("data-state=\"ready\""), std::string::npos);
  EXPECT_NE(dom.find("Estimators &amp; strategies"), std::string::npos);
  EXPECT_NE(dom.find("partial: 5 of 20 runs</p>"), std::string::npos);
  EXPECT_NE(dom.find("gus, qkf: 163 (150 to 180)"), std::string::npos);
  EXPECT_NE(dom.find("more 9</div>"), std::string::npos) << "legends of many lines stay";
  EXPECT_NE(dom.find("2px dotted"), std::string::npos) << "and show how lines are drawn";
}

TEST(Base64, EncodesEveryLength) {
  const auto encoded = [](std::string_view text) {
    return base64(std::as_bytes(std::span(text)));
  };
  // The test vectors of RFC 4648, section 10.
  EXPECT_EQ(encoded(""), "");
  EXPECT_EQ(encoded("f"), "Zg==");
  EXPECT_EQ(encoded("fo"), "Zm8=");
  EXPECT_EQ(encoded("foo"), "Zm9v");
  EXPECT_EQ(encoded("foobar"), "Zm9vYmFy");
}

}  // namespace
}  // namespace skein::record::report_test
