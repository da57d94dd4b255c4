// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/environment/raster/csv_table.h"

#include <gtest/gtest.h>

namespace skein::environment::csv_table_test {
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
  EXPECT_FALSE(CsvTable::load("/no/such/file.csv").ok());
  const auto ragged = CsvTable::parse("a,b\n1,2\n1\n", "t.csv");
  ASSERT_FALSE(ragged.ok());
  EXPECT_EQ(ragged.error().place, "t.csv:3");
  EXPECT_FALSE(CsvTable::parse("a,b\n\"1,2\n", "t.csv").ok());
  for (const char* bad :
       {"a\nx", "a\n1.2.3", "a\nnan", "a\ninf", "a\n1e999", "a\n\"\""}) {
    const auto table = CsvTable::parse(bad, "t.csv");
    ASSERT_TRUE(table.ok()) << bad;
    EXPECT_FALSE(table.value().number(0, 0).ok()) << bad;
  }
}

}  // namespace
}  // namespace skein::environment::csv_table_test
