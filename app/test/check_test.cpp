// SPDX-License-Identifier: Apache-2.0
// skein check: files of every kind, and names of former versions.
#include "app/test/program.h"

namespace skein::app {
namespace {

class Check : public Program {
 protected:
  Finished check(const std::vector<std::string>& arguments) {
    std::vector<std::string> all = {"check"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    return run(all);
  }
};

const std::string kOld =
    "# stranger_room: of 0.1\n"
    "aircraft:\n"
    "  - count: 2\n"
    "    agent:\n"
    "      kind: scout   # a \"scout\"\n"
    "      avoidance: {method: rule, stranger_room: static}\n"
    "missions: [{kind: perimeter, estimator: {kind: 'point-reset', 'least_sd_m': 4}}]\n";
const std::string kNew =
    "# stranger_room: of 0.1\n"
    "aircraft:\n"
    "  - count: 2\n"
    "    agent:\n"
    "      kind: scout   # a \"scout\"\n"
    "      avoidance: {method: rule, intruder_room: static}\n"
    "missions: [{kind: perimeter, estimator: {kind: 'point-reset', 'min_sd_m': 4}}]\n";

TEST_F(Check, RewritesFormerNamesAndShowsTheDifference) {
  write("old.yaml", kOld);
  const Finished refused = check({"old.yaml"});
  EXPECT_EQ(refused.status, 2);
  EXPECT_NE(refused.err.find("old.yaml:6:33 aircraft[0].agent.avoidance.stranger_room: "
                             "\"stranger_room\" is called \"intruder_room\" now."),
            std::string::npos)
      << refused.err;
  EXPECT_EQ(read_file(folder_ / "old.yaml"), kOld) << "a check writes nothing";

  const Finished updated = check({"--update", "old.yaml"});
  EXPECT_EQ(updated.status, 0) << updated.err;
  EXPECT_EQ(read_file(folder_ / "old.yaml"), kNew);
  EXPECT_NE(updated.out.find("2 names updated"), std::string::npos) << updated.out;
  EXPECT_NE(updated.out.find("+      avoidance: {method: rule, intruder_room: static}"),
            std::string::npos)
      << updated.out;
  EXPECT_NE(updated.out.find("old.yaml: good."), std::string::npos) << updated.out;

  const Finished again = check({"--update", "old.yaml"});
  EXPECT_EQ(again.status, 0) << again.err;
  EXPECT_NE(again.out.find("nothing to update"), std::string::npos) << again.out;
}

TEST_F(Check, UpdatesWhatElseIsWrongToo) {
  write("old.yaml", kOld + "wind_mps: 3\n");
  const Finished updated = check({"old.yaml", "--update"});
  EXPECT_EQ(updated.status, 2);
  EXPECT_NE(updated.err.find("old.yaml:8:1 wind_mps: unknown key."), std::string::npos)
      << updated.err;
  EXPECT_EQ(read_file(folder_ / "old.yaml"), kNew + "wind_mps: 3\n");

  write("no.yaml", "a: [\n");
  EXPECT_EQ(check({"--update", "no.yaml"}).status, 2);
  EXPECT_EQ(read_file(folder_ / "no.yaml"), "a: [\n");
  EXPECT_EQ(check({"--update", "none.yaml"}).status, 2);
}

TEST_F(Check, KnowsFilesOfEveryKind) {
  const fs::path source(SKEIN_SOURCE_DIR);
  std::vector<std::string> all;
  for (const char* folder : {"aircraft", "radios", "campaigns"})
    for (const auto& entry : fs::directory_iterator(source / folder))
      if (entry.path().extension() == ".yaml") all.push_back(entry.path().string());
  ASSERT_GT(all.size(), 20u);
  const Finished good = check(all);
  EXPECT_EQ(good.status, 0) << good.err;
  std::size_t count = 0;
  for (std::size_t at = 0; (at = good.out.find(": good.", at)) != std::string::npos; ++at)
    ++count;
  EXPECT_EQ(count, all.size()) << good.out;

  write("plane.yaml", "description: x\nfixed_wing: {mass_kgs: 3}\n");
  const Finished bad = check({all[0], "plane.yaml"});
  EXPECT_EQ(bad.status, 2);
  EXPECT_NE(bad.err.find("plane.yaml:2:14"), std::string::npos) << bad.err;
  EXPECT_NE(bad.out.find(": good."), std::string::npos)
      << "the other is good all the same";
  const Finished printed = check({all[0], "--print"});
  EXPECT_EQ(printed.status, 2);
}

TEST_F(Check, ARunOfFormerNamesIsStillDescribed) {
  write("new.yaml", kNew + "duration_s: 5\n");
  const Finished flown = run({"run", "new.yaml", "--out", "r"});
  ASSERT_EQ(flown.status, 0) << flown.err;
  // As a version that had those names would have left it.
  std::string kept = read_file(folder_ / "r" / "scenario.yaml");
  const auto put_back = [&](const std::string& now, const std::string& then) {
    const std::size_t at = kept.find(now);
    ASSERT_NE(at, std::string::npos) << now;
    kept.replace(at, now.size(), then);
  };
  put_back("intruder_room", "stranger_room");
  put_back("min_sd_m", "least_sd_m");
  write("r/scenario.yaml", kept);
  const Finished reported = run({"report", "r"});
  EXPECT_EQ(reported.status, 0) << reported.err;
  const Finished exported =
      run({"export", "r", "--what", "tracks", "--out", "r.geojson"});
  EXPECT_EQ(exported.status, 0) << exported.err;
}

}  // namespace
}  // namespace skein::app
