// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <vector>

#include "skein/layer/reasoning/task/survey/survey_lines.h"

namespace skein::reasoning::survey_lines_test {
namespace {

const std::vector<Vec2> kEnds = {{0, 0}, {300, 0}, {300, 50}, {0, 50}};

TEST(SurveyLines, AMissedOneIsFlownAtTheEndAndThenGivenUp) {
  SurveyLines lines(kEnds);
  EXPECT_EQ(lines.length(), 600);
  lines.missed();
  ASSERT_EQ(lines.left().size(), 2u);
  EXPECT_EQ(lines.left().front().begin, Vec2(300, 50));
  EXPECT_EQ(lines.length_left(), 600);
  lines.flown();
  EXPECT_EQ(lines.left().front().begin, Vec2(0, 0));
  EXPECT_EQ(lines.length_given_up(), 0);
  lines.missed();
  EXPECT_TRUE(lines.left().empty());
  EXPECT_EQ(lines.length_given_up(), 300);
}

TEST(SurveyLines, WhatHasBeenFlownOfALineIsNotFlownAgain) {
  SurveyLines lines(kEnds);
  lines.flown_to({120, 3});
  EXPECT_EQ(lines.left().front().begin, Vec2(120, 0));
  EXPECT_EQ(lines.length_left(), 480);
  lines.flown_to({299.5, 0});
  EXPECT_EQ(lines.left().size(), 1u);
}

TEST(SurveyLines, ThoseInAZoneComeBackWithItsEnd) {
  SurveyLines lines(kEnds);
  Zone zone;
  zone.area = geo::Ring{{100, -50}, {200, -50}, {200, 100}, {100, 100}};
  lines.regard(std::vector<Zone>{zone}, 0);
  EXPECT_NEAR(lines.length_forbidden(), 200, 5);
  EXPECT_NEAR(lines.length_left() + lines.length_forbidden(), 600, 1e-6);
  lines.regard({}, 0);
  EXPECT_EQ(lines.length_forbidden(), 0);
  EXPECT_NEAR(lines.length_left(), 600, 1e-6);
}

}  // namespace
}  // namespace skein::reasoning::survey_lines_test
