// SPDX-License-Identifier: Apache-2.0
#include "skein/base/csv.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace skein::csv_test {
namespace {

TEST(CsvTable, ReadsQuotesCommentsAndBothLineEnds) {
  const auto table = CsvTable::parse(
      "\xEF\xBB\xBF"
      "name, t_s\r\n# a comment\r\n\r\n\"a, \"\"b\"\"\" , 1.5e1\nplain,-2",
      "t.csv");
  ASSERT_TRUE(table.ok()) << table.error().text();
  ASSERT_EQ(table.value().size(), 2u);
  EXPECT_EQ(table.value().text(0, 0), "a, \"b\"");
  EXPECT_EQ(table.value().number(0, *table.value().column("t_s")).value(), 15);
  EXPECT_EQ(table.value().number(1, 1).value(), -2);
  EXPECT_EQ(table.value().place(1), "t.csv:5");
  EXPECT_FALSE(table.value().column("x").has_value());
}

TEST(CsvTable, RefusesWithFileAndLine) {
  EXPECT_FALSE(CsvTable::parse("", "t.csv").ok());
  EXPECT_FALSE(CsvTable::parse("\n# only a comment\n", "t.csv").ok());
  EXPECT_FALSE(CsvTable::load("/no/such/file.csv").ok());
  const auto ragged = CsvTable::parse("a,b\n1,2\n1\n", "t.csv");
  ASSERT_FALSE(ragged.ok());
  EXPECT_EQ(ragged.error().place, "t.csv:3");
  const auto open = CsvTable::parse("a,b\n1,2\n\"1,2\n", "t.csv");
  ASSERT_FALSE(open.ok());
  EXPECT_EQ(open.error().place, "t.csv:3");
  for (const char* bad :
       {"a\nx", "a\n1.2.3", "a\nnan", "a\ninf", "a\n1e999", "a\n\"\""}) {
    const auto table = CsvTable::parse(bad, "t.csv");
    ASSERT_TRUE(table.ok()) << bad;
    EXPECT_FALSE(table.value().number(0, 0).ok()) << bad;
  }
}

TEST(CsvTable, OnlyColumnsThatAreUsedMustBeUnique) {
  const auto table = CsvTable::parse("a,b,a\n1,2,3\n", "t.csv");
  ASSERT_TRUE(table.ok());
  const std::array<std::string_view, 2> good = {"b", "c"}, bad = {"b", "a"};
  EXPECT_TRUE(table.value().check_unique(good).ok());
  EXPECT_FALSE(table.value().check_unique(bad).ok());
}

TEST(CsvTable, TextFromOutsideBecomesValid) {
  const auto table = CsvTable::parse("a\nx\xffy\n", "t.csv");
  ASSERT_TRUE(table.ok());
  EXPECT_EQ(table.value().text(0, 0), "x\xEF\xBF\xBDy");
}

constexpr std::array<std::string_view, 2> kRequired = {"a", "b"};
constexpr std::array<std::string_view, 1> kOptional = {"c"};

std::string problems_of(
    const std::string& text, const std::function<void(CsvRow&)>& use = [](CsvRow&) {}) {
  std::string all;
  for (const Error& each : read_csv(text, "t.csv", {kRequired, kOptional}, use))
    all += each.text() + "\n";
  return all;
}

TEST(ReadCsv, GivesEachRowByTheNamesOfItsColumns) {
  double sum = 0;
  std::size_t without = 0;
  EXPECT_EQ(problems_of("b,more,a\n1,x,2\n3,y,4\n",
                        [&](CsvRow& row) {
                          sum += *row.number("a") + 10 * *row.number("b");
                          without += row.text("c").empty();
                        }),
            "");
  EXPECT_EQ(sum, 46);
  EXPECT_EQ(without, 2u);
}

TEST(ReadCsv, ReportsEveryProblemWithLineAndColumn) {
  const auto use = [](CsvRow& row) {
    (void)row.number("a");
    (void)row.number("b", 0, 5);
    (void)row.whole("c", 9);
  };
  EXPECT_EQ(problems_of("a,b,c\n,6,1.5\n1,2\n1e99,inf,10\ninf,5,9\n", use),
            "t.csv:2: column \"a\": a number is missing.\n"
            "t.csv:2: column \"b\": \"6\" is no number from 0 to 5.\n"
            "t.csv:2: column \"c\": \"1.5\" is no whole number from 0 to 9.\n"
            "t.csv:3: 2 cells, but the header has 3 columns.\n"
            "t.csv:4: column \"a\": 1e99 is beyond +-1e+60.\n"
            "t.csv:4: column \"b\": \"inf\" is no number from 0 to 5.\n"
            "t.csv:4: column \"c\": \"10\" is no whole number from 0 to 9.\n");
}

TEST(ReadCsv, RefusesAHeaderThatCannotServe) {
  EXPECT_EQ(problems_of(""),
            "t.csv: the table is empty: it has no header line. Needed: a,b.\n");
  EXPECT_EQ(problems_of("a,c,c\n1,2,3\n"),
            "t.csv:1: column \"b\" is missing. Needed: a,b.\n"
            "t.csv:1: column \"c\" occurs twice in the header.\n");
}

TEST(CsvCells, KeepCommasWithinQuotationMarks) {
  CsvCells cells("a, \"b, c\" ,,\" d \"");
  EXPECT_EQ(cells.next(), "a");
  EXPECT_EQ(cells.next(), "b, c");
  EXPECT_EQ(cells.next(), "");
  EXPECT_EQ(cells.next(), "d");
  EXPECT_FALSE(cells.next());
}

TEST(NumberIn, TakesAllOfACellOrNothing) {
  EXPECT_EQ(number_in("+1.5"), 1.5);
  EXPECT_TRUE(std::isnan(*number_in("nan")));
  for (const char* bad : {"", "+", "+-1", "1 ", "0x1", "1,5", "one"})
    EXPECT_FALSE(number_in(bad)) << bad;
}

}  // namespace
}  // namespace skein::csv_test
