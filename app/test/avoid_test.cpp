// SPDX-License-Identifier: Apache-2.0
// skein avoid: tables in, tables out, and what it refuses.
#include "app/test/program.h"

namespace skein::app {
namespace {

constexpr const char* kTwo =
    "case,aircraft,alerter,north_m,east_m,down_m,vn_mps,ve_mps,vd_mps\n"
    "h,0,1,0,0,-200,20,0,0\n"
    "h,1,1,2000,0,-200,-20,0,0\n";

TEST_F(Program, AvoidDetectAnswersEncounters) {
  write("e.csv", kTwo);
  const Finished done =
      run({"avoid", "detect", "--batch", "e.csv", "--config", "skein_suas", "--out",
           "a.csv", "--bands", "b.csv", "--guidance", "g.csv"});
  EXPECT_EQ(done.status, 0) << done.err;
  EXPECT_EQ(done.out, "1 encounters answered with skein_suas.\n");
  const std::string alerts = read_file(folder_ / "a.csv");
  EXPECT_NE(alerts.find("\nh,1,2,34.760000,65.240000,"), std::string::npos) << alerts;
  const std::string bands = read_file(folder_ / "b.csv");
  EXPECT_TRUE(bands.starts_with("case,kind,lo,hi,region\nh,track_deg,0.000000,"))
      << bands;
  const std::string guidance = read_file(folder_ / "g.csv");
  EXPECT_NE(guidance.find("\nh,alt_m,"), std::string::npos) << guidance;
  const Finished timeline = run({"avoid", "detect", "--batch", "e.csv", "--config",
                                 "skein_suas", "--out", "t.csv", "--hysteresis"});
  EXPECT_EQ(timeline.status, 0) << timeline.err;
  EXPECT_EQ(read_file(folder_ / "t.csv"),
            "case,t_s,alert_level\nh,0,2\nh,16,3\nh,68,0\nh,100,0\n");
}

TEST_F(Program, AvoidDetectSaysWhatIsWrong) {
  write("e.csv", kTwo);
  write("bad.csv", std::string(kTwo) + "h,1,1,0,0,0,0,0,0\n");
  write("bad.json", R"({"name": "x", "lookahead_s": "long"})");
  const auto detect = [&](const std::string& batch, const std::string& configuration,
                          const std::string& out = "a.csv") {
    return run(
        {"avoid", "detect", "--batch", batch, "--config", configuration, "--out", out});
  };
  const auto expect = [](const Finished& finished, const std::string& part) {
    EXPECT_EQ(finished.status, 2);
    EXPECT_NE(finished.err.find(part), std::string::npos) << finished.err;
  };
  expect(detect("none.csv", "skein_suas"), "none.csv");
  expect(detect("bad.csv", "skein_suas"), "bad.csv:4: case h has two aircraft 1.");
  expect(detect("e.csv", "suas"), "By name there are DO_365B_no_SUM, skein_suas");
  expect(detect("e.csv", "bad.json"), "bad.json: lookahead_s: must be a number from");
  expect(detect("e.csv", "skein_suas", "e.csv"), "is what --batch names, too.");
  EXPECT_EQ(read_file(folder_ / "e.csv"), kTwo) << "it is still there";
  EXPECT_FALSE(fs::exists(folder_ / "a.csv"));
  EXPECT_EQ(run({"avoid"}).status, 2);
  EXPECT_EQ(run({"avoid", "detect", "--batch", "e.csv", "--config", "skein_suas", "--out",
                 "a.csv", "--until-s", "10"})
                .status,
            2);
}

}  // namespace
}  // namespace skein::app
