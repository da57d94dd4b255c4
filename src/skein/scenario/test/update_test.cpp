// SPDX-License-Identifier: Apache-2.0
#include "skein/scenario/update.h"

#include <gtest/gtest.h>

#include "skein/scenario/fields.h"
#include "skein/scenario/scenario_file.h"
#include "skein/scenario/test/fake_kinds.h"

namespace skein::scenario::test::update_test {
namespace {

enum class Colour { kRed, kGreen };

struct Inner {
  double speed = 1;
  Colour colour = Colour::kRed;
};

struct Outer {
  std::string name;
  std::vector<Inner> parts;
};

Document document() {
  Fields<Inner> inner;
  inner.number("speed_mps", &Inner::speed, "How fast.")
      .formerly("pace_mps")
      .word("colour", &Inner::colour, "What it looks like.",
            {{"crimson", Colour::kRed, "red", "red"}, {"green", Colour::kGreen, "green"}})
      .formerly("paint");
  Document made;
  made.keys = Fields<Outer>()
                  .text("name", &Outer::name, "Its name.")
                  .object("parts", &Outer::parts, inner, "What it is made of.")
                  .description();
  made.name = "a list";
  made.consequence = "nothing was done";
  return made;
}

Reading read(const std::string& text, Outer& outer, bool says_only = false) {
  Document made = document();
  made.says_only = says_only;
  return read_document_text(text, "t.yaml", "", made, KindTable(), {}, &outer);
}

const std::string kOld =
    "# pace_mps: a comment stays\n"
    "name: pace_mps\n"
    "parts:\n"
    "  - {pace_mps: 3, \"paint\": 'red'}   # red and pace_mps\n"
    "  - paint: red\n"
    "    speed_mps: 4";
const std::string kNew =
    "# pace_mps: a comment stays\n"
    "name: pace_mps\n"
    "parts:\n"
    "  - {speed_mps: 3, \"colour\": 'crimson'}   # red and pace_mps\n"
    "  - colour: crimson\n"
    "    speed_mps: 4";

TEST(Update, AFormerNameIsRefusedWithTheNewOne) {
  Outer outer;
  const Reading reading = read("parts: [{pace_mps: x, paint: red}]\n", outer);
  EXPECT_EQ(
      reading.report(),
      "t.yaml:1:10 parts[0].pace_mps: \"pace_mps\" is called \"speed_mps\" now. "
      "`skein check --update FILE` rewrites the file.\n"
      "t.yaml:1:20 parts[0].pace_mps: found \"x\", needs a number.\n"
      "t.yaml:1:23 parts[0].paint: \"paint\" is called \"colour\" now. `skein check "
      "--update FILE` rewrites the file.\n"
      "t.yaml:1:30 parts[0].paint: \"red\" is called \"crimson\" now. `skein check "
      "--update FILE` rewrites the file.\n"
      "4 problems; nothing was done.\n");
  EXPECT_EQ(read("parts: [{pace_mps: 1, speed_mps: 2}]\n", outer).problem_count, 2u)
      << "also when it is given by both names";
}

TEST(Update, RewritesNamesAndNothingElse) {
  Outer outer;
  const Reading reading = read(kOld, outer);
  EXPECT_EQ(reading.renames.size(), 5u);
  const auto updated = with_new_names(kOld, "t.yaml", reading.renames);
  ASSERT_TRUE(updated.ok()) << updated.error().text();
  EXPECT_EQ(updated.value(), kNew);
  EXPECT_EQ(read(kNew, outer).report(), "");
  EXPECT_EQ(outer.parts[0].speed, 3);
  EXPECT_EQ(changed_lines(kOld, kNew),
            "@@ line 4 @@\n"
            "-  - {pace_mps: 3, \"paint\": 'red'}   # red and pace_mps\n"
            "+  - {speed_mps: 3, \"colour\": 'crimson'}   # red and pace_mps\n"
            "@@ line 5 @@\n"
            "-  - paint: red\n"
            "+  - colour: crimson\n");
}

TEST(Update, CountsColumnsInTextThatIsNotAscii) {
  const std::string flow = "{name: \"üü\", parts: [&one {paint: red}, *one]}\r\n";
  Outer outer;
  const auto updated = with_new_names(flow, "t.yaml", read(flow, outer).renames);
  ASSERT_TRUE(updated.ok()) << updated.error().text();
  EXPECT_EQ(updated.value(), "{name: \"üü\", parts: [&one {colour: crimson}, *one]}\r\n");
}

TEST(Update, WhatARunHasRecordedIsReadByItsFormerNames) {
  Outer outer;
  EXPECT_EQ(read(kOld, outer, true).report(), "");
  ASSERT_EQ(outer.parts.size(), 2u);
  EXPECT_EQ(outer.parts[0].speed, 3);
}

TEST(Update, RefusesATextThatIsNotTheOneThatWasRead) {
  Outer outer;
  const Reading reading = read(kOld, outer);
  const auto updated = with_new_names("parts:\n", "t.yaml", reading.renames);
  ASSERT_FALSE(updated.ok());
  EXPECT_EQ(updated.error().place, "t.yaml:5:12");
}

}  // namespace
}  // namespace skein::scenario::test::update_test
