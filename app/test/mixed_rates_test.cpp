// SPDX-License-Identifier: Apache-2.0
// Data rates between real and simulated entities, in real time.
#include <algorithm>
#include <cmath>

#include "app/test/program.h"

namespace skein::app {
namespace {

TEST_F(Program, RatesOfMixedAndRealEntitiesAgreeAndWithoutTheMediumDoNot) {
  const Finished done = run({"study", "network", "mixed", "--duration", "4", "--seeds",
                             "2", "--threads", "5", "--out", "mixed"});
  ASSERT_EQ(done.status, 0) << done.err;
  const auto summary = nlohmann::json::parse(read_file(folder_ / "mixed/summary.json"));
  const auto rate = [&](const std::string& set_up, const std::string& pair) -> double {
    return summary.at("n920/" + set_up + "/" + pair + "_byte_s");
  };
  for (const char* pair : {"1_to_2", "1_to_3", "2_to_1", "2_to_3", "3_to_1", "3_to_2"})
    // Two messages of those that are said in 4 s: where they begin and end is by chance,
    // and a busy machine is late.
    EXPECT_NEAR(rate("all-real/15", pair), rate("mixed/15", pair), 500) << pair;
  // Each third slot of 20 ms is its own and holds a part of 250 B; a message is five
  // parts: 3333 B/s, and a message more or less.
  EXPECT_LE(rate("all-real/60", "2_to_3"), 3333 + 250);
  EXPECT_GE(rate("all-real/60", "2_to_3"), 1500);
  for (const char* pair : {"2_to_3", "3_to_2"})
    EXPECT_NEAR(rate("mixed/60", pair), rate("all-real/60", pair), 1000) << pair;
  EXPECT_GE(rate("mixed-without-model/60", "2_to_3"), 7500 * 0.9)
      << "simulated ones hear all that is said";
}

TEST_F(Program, AHouseHidesRealAndSimulatedEntitiesAlike) {
  const Finished done = run({"study", "network", "obstacle", "--seeds", "1", "--threads",
                             "8", "--out", "obstacle"});
  ASSERT_EQ(done.status, 0) << done.err;
  const auto summary =
      nlohmann::json::parse(read_file(folder_ / "obstacle/summary.json"));
  int mixes = 0;
  for (const auto& first : {"simulated", "real"})
    for (const auto& second : {"simulated", "real"})
      for (const auto& third : {"simulated", "real"}) {
        const std::string mix = std::string(first) + ", " + second + ", " + third;
        const auto share = [&](const std::string& pair) -> double {
          return summary.at("nn8/" + mix + "/" + pair + "_percent");
        };
        EXPECT_EQ(share("1_to_2"), 0) << mix;
        EXPECT_EQ(share("2_to_1"), 0) << mix;
        // A message or two of 20 may be lost where a busy machine is late.
        for (const char* pair : {"1_to_3", "3_to_1", "2_to_3", "3_to_2"}) {
          EXPECT_GE(share(pair), 90) << mix << ": " << pair;
          EXPECT_LE(share(pair), 100.1) << mix << ": " << pair;
        }
        ++mixes;
      }
  EXPECT_EQ(mixes, 8);
}

TEST_F(Program, MixedRatesRefuseWhatTheyCannotUse) {
  EXPECT_EQ(run({"study", "network", "mixed", "--nodes", "4"}).status, 2);
  EXPECT_EQ(run({"study", "network", "mixed", "--profiles", "nothing"}).status, 2);
  EXPECT_EQ(run({"study", "network", "obstacle", "--duration", "4"}).status, 2);
}

}  // namespace
}  // namespace skein::app
