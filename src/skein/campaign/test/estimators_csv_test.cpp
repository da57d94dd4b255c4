// SPDX-License-Identifier: Apache-2.0
#include "skein/campaign/estimators/estimators_csv.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "skein/base/input_file.h"

namespace skein::campaign::estimators_csv_test {
namespace {

using Row = std::map<std::string, std::string>;

std::vector<Row> read_rows(std::istream& in) {
  const auto cells_of = [](const std::string& line) {
    std::vector<std::string> cells;
    std::stringstream stream(line);
    for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
    return cells;
  };
  std::string line;
  std::getline(in, line);
  const auto columns = cells_of(line);
  std::vector<Row> rows;
  while (std::getline(in, line)) {
    const auto cells = cells_of(line);
    Row row;
    for (std::size_t i = 0; i < columns.size(); ++i)
      row[columns[i]] = i < cells.size() ? cells[i] : "";
    rows.push_back(row);
  }
  return rows;
}

std::string cases(const std::string& text, std::vector<Error>* problems = nullptr) {
  std::ostringstream out;
  const auto found = evaluate_cases(text, "cases.csv", out);
  if (problems)
    *problems = found;
  else
    EXPECT_TRUE(found.empty()) << found.front().text();
  return out.str();
}

const std::string kHeader = "kind,mu,sigma,lower,upper,sigma_v\n";

// Every v column of the file is reproduced. `digits` of the file limit a value near 0
// only.
void compare(const std::vector<Row>& want, const std::vector<Row>& got,
             const std::vector<std::string>& columns) {
  ASSERT_EQ(want.size(), got.size());
  for (std::size_t i = 0; i < want.size(); ++i)
    for (const std::string& column : columns) {
      const std::string& a = want[i].at(column);
      if (a.empty()) continue;
      const double x = std::stod(a), y = std::stod(got[i].at(column));
      if (std::isinf(x)) {
        EXPECT_EQ(x, y) << "row " << i + 2 << " " << column;
      } else {
        EXPECT_NEAR(x, y, 1e-9 * std::abs(x) + (x == 0 ? 1e-15 : 0))
            << "row " << i + 2 << " " << column;
      }
    }
}

TEST(EstimatorsCsv, ReproducesTheReferenceValues) {
  const std::filesystem::path file =
      std::filesystem::path(SKEIN_SHARED_DATA) / "qkf/values.csv";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not there";
  const std::string in = read_file(file).value();
  std::istringstream again(in);
  std::stringstream out;
  const auto problems = evaluate_cases(in, file.string(), out);
  ASSERT_TRUE(problems.empty()) << problems.front().text();
  compare(read_rows(again), read_rows(out), {"v1", "v2", "v3", "v4"});
}

TEST(EstimatorsCsv, ReproducesTheReferenceValuesFromTheGivenColumnsAlone) {
  const std::filesystem::path file =
      std::filesystem::path(SKEIN_SHARED_DATA) / "qkf/values.csv";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not there";
  std::ifstream in(file);
  const std::vector<Row> want = read_rows(in);
  std::stringstream given, out;
  given << kHeader;
  for (const Row& row : want)
    given << row.at("kind") << ',' << row.at("mu") << ',' << row.at("sigma") << ','
          << row.at("lower") << ',' << row.at("upper") << ',' << row.at("sigma_v")
          << '\n';
  const auto problems = evaluate_cases(given.str(), "given", out);
  ASSERT_TRUE(problems.empty()) << problems.front().text();
  compare(want, read_rows(out), {"v1", "v2", "v3", "v4"});
}

TEST(EstimatorsCsv, ReproducesTheReferenceUpdates) {
  const std::filesystem::path file =
      std::filesystem::path(SKEIN_SHARED_DATA) / "qkf/update_cases.csv";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not there";
  const std::string in = read_file(file).value();
  std::istringstream again(in);
  std::stringstream out;
  const auto problems = evaluate_updates(in, file.string(), out);
  ASSERT_TRUE(problems.empty()) << problems.front().text();
  const auto want = read_rows(again);
  std::vector<std::string> columns;
  for (const auto& [name, value] : want.at(0)) columns.push_back(name);
  ASSERT_EQ(columns.size(), 39u);
  compare(want, read_rows(out), columns);
}

TEST(EstimatorsCsv, EvaluatesEveryKind) {
  std::istringstream out(cases(kHeader + "TN,0,1,0,inf,\n"
                                         "MAP,0,1,0,inf,0.1\n"
                                         "UKF,0,2,-1,1.5,\n"
                                         "COV_MLE,0,1,0,inf,\n"
                                         "COV_MAP,0,1,0,inf,0.1\n"
                                         "COV_UKF,0,1,0,inf,\n"));
  const auto rows = read_rows(out);
  ASSERT_EQ(rows.size(), 6u);
  EXPECT_NEAR(std::stod(rows[0].at("v2")), 0.7978845608029, 1e-12);
  EXPECT_NEAR(std::stod(rows[1].at("v1")), 0.2378450438078, 1e-12);
  EXPECT_EQ(rows[2].at("v1"), "-1");
  EXPECT_EQ(rows[2].at("v2"), "1.5");
  EXPECT_EQ(rows[2].at("v3"), "0.25");
  EXPECT_NEAR(std::stod(rows[3].at("v2")), 0.7208461756789, 1e-12)
      << "sigma_v from above";
  EXPECT_EQ(rows[4].at("v1"), rows[1].at("v1"));
  EXPECT_NEAR(std::stod(rows[5].at("v2")), 0.4521154391971, 1e-12);
}

TEST(EstimatorsCsv, ASecondMomentTakesAGivenValue) {
  std::istringstream out(
      cases("kind,mu,sigma,lower,upper,sigma_v,v1\nCOV_MLE,0,1,1,inf,,1.2\n"));
  EXPECT_NEAR(std::stod(read_rows(out).at(0).at("v2")), 0.3048106133746, 1e-12);
}

TEST(EstimatorsCsv, ToleratesOtherColumnsOrderBlanksAndLineEnds) {
  const std::string text = cases(
      "\xef\xbb\xbfsigma, mu,kind,upper,lower,note\r\n\r\n 1 ,+0,TN,inf,0,hello\r\n");
  std::istringstream out(text);
  EXPECT_NEAR(std::stod(read_rows(out).at(0).at("v1")), 0.5, 1e-15);
}

TEST(EstimatorsCsv, ReportsEveryProblemWithRowAndColumn) {
  std::vector<Error> problems;
  const std::string out = cases(kHeader +
                                    "TN,0,1,0,inf,\n"
                                    "TN,0,-1,0,inf,\n"
                                    "TN,zero,1,0,inf,\n"
                                    "TN,0,1,2,1,\n"
                                    "XX,0,1,0,inf,\n"
                                    "MAP,0,1,0,inf,\n"
                                    "MAP,0,1,0,1,0.1\n"
                                    "TN,0,1,0\n"
                                    "TN,0,,nan,1e99,\n",
                                &problems);
  EXPECT_EQ(out, "") << "nothing is written when anything is wrong";
  std::string text;
  for (const Error& problem : problems) text += problem.text() + "\n";
  EXPECT_EQ(
      text,
      "cases.csv:3: column \"sigma\": -1 must be above 0 and finite.\n"
      "cases.csv:4: column \"mu\": \"zero\" is not a number.\n"
      "cases.csv:5: column \"lower\": 2 must be below upper, 1.\n"
      "cases.csv:6: column \"kind\": \"XX\" is none of TN, MAP, UKF, COV_MLE, COV_MAP, "
      "COV_UKF.\n"
      "cases.csv:7: column \"sigma_v\": MAP needs a number here.\n"
      "cases.csv:8: column \"upper\": MAP needs one infinite and one finite bound.\n"
      "cases.csv:9: 4 cells, but the header has 6 columns.\n"
      "cases.csv:10: column \"sigma\": a number is missing.\n"
      "cases.csv:10: column \"lower\": \"nan\" is not a number.\n"
      "cases.csv:10: column \"upper\": 1e99 is beyond +-1e+60.\n");
}

TEST(EstimatorsCsv, ReportsAMissingHeaderAndColumns) {
  std::vector<Error> problems;
  cases("", &problems);
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_NE(problems[0].text().find("no header line"), std::string::npos);
  cases("kind,mu,sigma,lower,lower\n", &problems);
  ASSERT_EQ(problems.size(), 2u);
  EXPECT_NE(problems[0].text().find("column \"lower\" occurs twice"), std::string::npos);
  EXPECT_NE(problems[1].text().find("column \"upper\" is missing"), std::string::npos);
}

TEST(EstimatorsCsv, StopsAfterManyProblems) {
  std::string text = kHeader;
  for (int i = 0; i < 100000; ++i) text += "XX,0,1,0,inf,\n";
  std::vector<Error> problems;
  cases(text, &problems);
  EXPECT_EQ(problems.size(), 101u);
}

TEST(EstimatorsCsv, RefusesUpdatesThatMeanNothing) {
  const std::string header =
      "px,py,vx,vy,P00,P01,P02,P03,P11,P12,P13,P22,P23,P33,ux,uy,R,observed_in,expected_"
      "in\n";
  const std::string good = "500,0,3,0,100,0,0,0,100,0,0,1,0,1,450,0,1,0,1\n";
  const auto problem = [&](const std::string& row) {
    std::ostringstream out;
    const auto problems = evaluate_updates(header + row, "u", out);
    return problems.empty() ? std::string() : problems.front().text();
  };
  EXPECT_EQ(problem(good), "");
  EXPECT_EQ(
      problem("500,0,3,0,100,200,0,0,100,0,0,1,0,1,450,0,1,0,1\n"),
      "u:2: column \"P00\": P00..P33 is not a covariance: it has a negative eigenvalue.");
  EXPECT_EQ(
      problem("500,0,3,0,100,0,0,0,100,0,0,1,0,1,500,0,1,0,1\n"),
      "u:2: column \"ux\": the aircraft is at the control point: there is no line of "
      "sight.");
  EXPECT_EQ(problem("500,0,3,0,100,0,0,0,100,0,0,1,0,1,450,0,-1,0,1\n"),
            "u:2: column \"R\": -1 must not be negative.");
  EXPECT_EQ(problem("500,0,3,0,100,0,0,0,100,0,0,1,0,1,450,0,1,2,1\n"),
            "u:2: column \"observed_in\": 2 must be 0 or 1.");
  EXPECT_EQ(problem("500,0,3,0,inf,0,0,0,100,0,0,1,0,1,450,0,1,0,1\n"),
            "u:2: column \"P00\": must be finite.");
}

}  // namespace
}  // namespace skein::campaign::estimators_csv_test
