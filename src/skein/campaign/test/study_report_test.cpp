// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdlib>
#include <fstream>

#include "skein/campaign/batch/data_fingerprint.h"
#include "skein/campaign/bridge/bridge_study.h"
#include "skein/campaign/monitoring/monitoring_report.h"

namespace skein::campaign::study_report_test {
namespace {

BatchOutcome outcome(double perf) {
  record::RunSummary summary;
  summary.numbers = {{"perf_run_mean_m", perf}, {"iou_mean", 0.9}};
  summary.warnings = {"terrain: a hole was filled"};
  return {summary, ""};
}

// The text of every cell of the first table with this title.
std::string texts_of(const record::StudyReport& report, const std::string& title) {
  std::string all;
  for (const record::StudyTable& table : report.tables)
    if (table.title == title)
      for (const auto& row : table.rows)
        for (const record::TableCell& cell : row)
          if (const auto* text = std::get_if<std::string>(&cell.value))
            all += *text + ";";
  return all;
}

TEST(FigureText, SaysHowManyRunsItIsOf) {
  EXPECT_EQ(figure_text({12.34, 0.4, 6, 6}, 1), "12.3 ± 0.4");
  EXPECT_EQ(figure_text({12.34, 0.4, 3, 6}, 1), "12.3 ± 0.4 (n = 3)");
  EXPECT_EQ(figure_text({12.34, 0, 1, 1}, 1), "12.3") << "no interval of one run";
  EXPECT_EQ(figure_text({12.34, 0, 1, 2}, 1), "12.3 (n = 1)");
  EXPECT_EQ(figure_text({}, 1), "");
}

TEST(PartialText, CountsWhatIsMissing) {
  EXPECT_EQ(partial_text({outcome(1), outcome(2)}), "");
  EXPECT_EQ(partial_text({outcome(1), {}, {}}), "partial: 1 of 3 runs");
  EXPECT_EQ(partial_text({outcome(1), {}, {std::nullopt, "disk full"}}),
            "partial: 1 of 3 runs, 1 failed");
}

TEST(MonitoringReport, AnInterruptedStudySaysSo) {
  StudyPlan plan;
  plan.cells = {{"no-wind", "a-new-one", "sweep", {0, 1, 2}},
                {"no-wind", "qkf", "gus", {3, 4, 5}}};
  const std::vector<BatchOutcome> outcomes = {outcome(4), outcome(5), {},
                                              outcome(8), {},         {}};
  const auto report = monitoring_report({}, plan, outcomes);
  EXPECT_EQ(report.alert, "partial: 3 of 6 runs");
  const std::string cells = texts_of(report, "no-wind: Perf [m]");
  EXPECT_NE(cells.find("4.5 ± 6.4 (n = 2)"), std::string::npos) << cells;
  EXPECT_NE(cells.find("8.0 (n = 1)"), std::string::npos) << cells;
  EXPECT_EQ(report.notes.front(), "terrain: a hole was filled");
}

TEST(MonitoringReport, TakesAnEstimatorThatIsNotTheThesissForItsOwn) {
  StudyPlan plan;
  plan.cells = {{"no-wind", "a-new-one", "sweep", {0}}, {"no-wind", "qkf", "gus", {1}}};
  const auto report = monitoring_report({}, plan, {outcome(4), outcome(8)});
  EXPECT_NE(texts_of(report, "Skein's best against the benchmarks").find("a-new-one"),
            std::string::npos);
  EXPECT_EQ(report.alert, "");
}

TEST(MonitoringReport, PlotsEveryPairOfEveryCase) {
  StudyPlan plan;
  plan.cells = {{"no-wind", "joint", "sweep", {0, 1}}, {"no-wind", "qkf", "gus", {2}}};
  const auto report = monitoring_report({}, plan, {outcome(4), outcome(6), outcome(8)});
  ASSERT_EQ(report.dots.size(), 1u);
  const record::StudyDots& plot = report.dots[0];
  EXPECT_TRUE(plot.log_x);
  ASSERT_EQ(plot.dots.size(), 2u);
  EXPECT_DOUBLE_EQ(plot.dots[0][0].value, 5);
  EXPECT_LT(plot.dots[0][0].low, 5);
  EXPECT_TRUE(std::isnan(plot.dots[0][1].value)) << "not run";
  EXPECT_DOUBLE_EQ(plot.dots[1][1].value, 8);
  EXPECT_TRUE(std::isnan(plot.dots[1][1].low)) << "one run has no interval";
}

TEST(BridgeReport, ShowsNoIntervalOfOneRun) {
  StudyPlan plan;
  plan.cells = {{"recorded fire", "joint", "sweep", {0}}};
  const auto report = bridge_report({}, plan, {outcome(4)});
  EXPECT_EQ(texts_of(report, report.tables[0].title), "sweep;joint;0.900;");
}

TEST(DataFingerprint, ChangesWithTheContentOnly) {
  std::string pattern = (std::filesystem::temp_directory_path() / "data-XXXXXX").string();
  const std::filesystem::path folder = mkdtemp(pattern.data());
  const auto put = [&](const char* name, const char* text) {
    std::ofstream(folder / name) << text;
  };
  put("wind.csv", "t_s\n1\n");
  put("list.csv", "time,file\n1,ring.geojson\n");
  put("ring.geojson", "{}");
  const auto of = [&](const std::filesystem::path& path) {
    return DataFingerprint().of({path.string()}).value();
  };
  const std::string wind = of(folder / "wind.csv"), list = of(folder / "list.csv"),
                    all = of(folder);
  put("wind.csv", "t_s\n1\n");
  EXPECT_EQ(of(folder / "wind.csv"), wind) << "written again with the same content";
  put("ring.geojson", "{ }");
  EXPECT_EQ(of(folder / "wind.csv"), wind);
  EXPECT_NE(of(folder / "list.csv"), list) << "a file that it names has changed";
  EXPECT_NE(of(folder), all);
  put("wind.csv", "t_s\n2\n");
  EXPECT_NE(of(folder / "wind.csv"), wind);
  EXPECT_EQ(DataFingerprint().of({}).value(), "");
  std::filesystem::remove_all(folder);
}

TEST(DataFingerprint, NamesWhatCannotBeRead) {
  std::string pattern = (std::filesystem::temp_directory_path() / "data-XXXXXX").string();
  const std::filesystem::path folder = mkdtemp(pattern.data());
  std::filesystem::create_directory(folder / "deep");
  const auto refused = [&](const char* name, const std::filesystem::path& what) {
    const auto of = DataFingerprint().of({(folder / name).string()});
    ASSERT_FALSE(of.ok()) << name;
    EXPECT_EQ(of.error().place, what.string()) << of.error().text();
  };
  refused("none.csv", folder / "none.csv");
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  refused("pipe", folder / "pipe");
  // Opens, and every read fails, for root too.
  std::filesystem::create_symlink("/proc/self/mem", folder / "deep" / "bad.geojson");
  std::ofstream(folder / "list.csv") << "time,file\n1.5,deep/bad.geojson\n";
  std::ofstream(folder / "deep" / "bad.shp") << "x";
  refused("list.csv", folder / "deep" / "bad.geojson");
  refused("deep/bad.shp", folder / "deep" / "bad.geojson");
  refused("deep", folder / "deep" / "bad.geojson");
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace skein::campaign::study_report_test
