// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/avoidance/negotiation/negotiation_batch.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

namespace skein::reasoning::negotiation_batch_test {
namespace {

std::string problem_of(const std::string& text) {
  const auto read = read_bargains(text, "n.json");
  return read ? "none" : read.error().text();
}

TEST(NegotiationBatch, ReadsAndAnswersInOrder) {
  const auto read = read_bargains(
      R"([{"id": "b", "utility_1": [1, 0.5], "utility_2": [1], "free": [[0], [1]]},
          {"id": "a,\"x", "utility_1": [1], "utility_2": [1], "free": [[0]]}])",
      "n.json");
  ASSERT_TRUE(read) << read.error().text();
  EXPECT_EQ(deals_csv(read.value()),
            "id,sum_k,sum_l,product_k,product_l,zeuthen_k,zeuthen_l,rounds\n"
            "b,1,0,1,0,1,0,0\n"
            "\"a,\"\"x\",,,,,,,\n");
}

TEST(NegotiationBatch, SaysWhatIsWrongAndWhere) {
  const auto has = [](const std::string& text, const std::string& part) {
    EXPECT_NE(problem_of(text).find(part), std::string::npos) << problem_of(text);
  };
  has("[", "no JSON");
  has("{}", "must be a list");
  has("[1]", "n.json: [0]: must be an object");
  has(R"([{"id":"a","utility_1":[1],"utility_2":[1]}])", "lacks the key \"free\"");
  has(R"([{"id":"a","utility_1":[1],"utility_2":[1],"free":[[1]],"fre":0}])",
      "unknown key \"fre\"");
  has(R"([{"id":"a","id":"b","utility_1":[1],"utility_2":[1],"free":[[1]]}])",
      "\"id\" stands twice");
  has(R"([{"id":"a","utility_1":[2],"utility_2":[1],"free":[[1]]}])",
      "[0].utility_1[0]: must be a number from 0 to 1");
  has(R"([{"id":"a","utility_1":["x"],"utility_2":[1],"free":[[1]]}])", "a number");
  has(R"([{"id":"a","utility_1":[],"utility_2":[1],"free":[]}])", "an option at least");
  has(R"([{"id":"a","utility_1":[1],"utility_2":[1],"free":[[2]]}])",
      "[0].free[0][0]: must be an integer from 0 to 1");
  has(R"([{"id":"a","utility_1":[1],"utility_2":[1],"free":[]}])", "0 rows for the 1");
  has(R"([{"id":"a","utility_1":[1],"utility_2":[1],"free":[[1,1]]}])", "2 cells");
  has(R"([{"id":"a","utility_1":[1],"utility_2":[1],"free":[[1]]},
          {"id":"a","utility_1":[1],"utility_2":[1],"free":[[1]]}])",
      "\"a\" is there twice");
  has(R"([{"id":"","utility_1":[1],"utility_2":[1],"free":[[1]]}])", "a text of 1 to 64");
}

TEST(NegotiationBatch, AgreesWithTheReferenceData) {
  const std::filesystem::path file =
      SKEIN_SHARED_DATA "/team/negotiation/negotiations.json";
  std::ifstream in(file, std::ios::binary);
  if (!in) GTEST_SKIP() << file << " is not there";
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  const auto read = read_bargains(text, "negotiations.json");
  ASSERT_TRUE(read) << read.error().text();
  const auto expected = nlohmann::json::parse(text);
  ASSERT_EQ(read.value().size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const auto& [id, bargain] = read.value()[i];
    for (const DealRule rule : {DealRule::kSum, DealRule::kProduct, DealRule::kZeuthen}) {
      const auto found = agree(rule, bargain);
      const std::string name(names_of(&rule)[static_cast<std::size_t>(rule)]);
      ASSERT_TRUE(found) << id;
      EXPECT_EQ(found->deal, (Deal{expected[i][name][0], expected[i][name][1]}))
          << id << " " << name;
      if (rule != DealRule::kZeuthen) continue;
      EXPECT_EQ(found->rounds, expected[i]["rounds"]);
    }
  }
}

}  // namespace
}  // namespace skein::reasoning::negotiation_batch_test
