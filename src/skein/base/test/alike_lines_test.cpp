// SPDX-License-Identifier: Apache-2.0
#include "skein/base/alike_lines.h"

#include <gtest/gtest.h>

namespace skein::alike_lines_test {
namespace {

TEST(AlikeLines, ManyThatDifferInNumbersOnlyAreOne) {
  std::vector<std::string> lines = {"a: feature 0: 1.5 ha", "other"};
  for (int i = 1; i < 300; ++i)
    lines.push_back("a: feature " + std::to_string(i) + ": " + std::to_string(i) + " ha");
  join_alike_lines(lines);
  EXPECT_EQ(lines, (std::vector<std::string>{
                       "a: feature 0: 1.5 ha (and 299 more like it)", "other"}));
}

TEST(AlikeLines, FewStayAsTheyAre) {
  const std::vector<std::string> few = {"1", "2", "3"};
  std::vector<std::string> lines = few;
  join_alike_lines(lines);
  EXPECT_EQ(lines, few);
  std::vector<std::string> before = {"1", "2", "3", "4", "5"};
  join_alike_lines(before, 3);
  EXPECT_EQ(before.size(), 5u);
}

}  // namespace
}  // namespace skein::alike_lines_test
