// SPDX-License-Identifier: Apache-2.0
// skein avoid: what it answers and what it refuses.
#include "app/test/program.h"

namespace skein::app {
namespace {

constexpr const char* kBargains = R"([
{"id": "a", "utility_1": [1, 0.7], "utility_2": [1, 0.9], "free": [[0, 1], [1, 1]]},
{"id": "b", "utility_1": [1], "utility_2": [1], "free": [[0]]}])";

TEST_F(Program, NegotiatesABatch) {
  const auto file = write("bargains.json", kBargains).string();
  const Finished shown = run({"avoid", "negotiate", "--batch", file});
  EXPECT_EQ(shown.status, 0) << shown.err;
  EXPECT_EQ(shown.out,
            "id,sum_k,sum_l,product_k,product_l,zeuthen_k,zeuthen_l,rounds\n"
            "a,0,1,0,1,0,1,1\nb,,,,,,,\n");
  EXPECT_EQ(run({"avoid", "negotiate", "--batch", file, "--out", "deals.csv"}).status, 0);
  EXPECT_EQ(read_file(folder_ / "deals.csv"), shown.out);
}

TEST_F(Program, RefusesBadBargains) {
  EXPECT_EQ(run({"avoid"}).status, 2);
  EXPECT_EQ(run({"avoid", "negotiate"}).status, 2);
  EXPECT_EQ(run({"avoid", "negotiate", "--batch", "missing.json"}).status, 2);
  const auto bad = write("bad.json", R"([{"id": "a", "utility_1": [3]}])").string();
  const Finished refused = run({"avoid", "negotiate", "--batch", bad, "--out", "x.csv"});
  EXPECT_EQ(refused.status, 2);
  EXPECT_NE(refused.err.find("lacks the key \"free\""), std::string::npos) << refused.err;
  EXPECT_FALSE(fs::exists(folder_ / "x.csv"));
  const auto good = write("good.json", kBargains).string();
  EXPECT_EQ(run({"avoid", "negotiate", "--batch", good, "--out", "none/x.csv"}).status,
            1);
}

}  // namespace
}  // namespace skein::app
