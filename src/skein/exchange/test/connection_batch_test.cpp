// SPDX-License-Identifier: Apache-2.0
#include "skein/exchange/plan/connection_batch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "skein/base/csv.h"
#include "skein/base/random.h"
#include "skein/geo/vec.h"
#include "skein/model/connection/connection.h"
#include "skein/model/path/flight_plan.h"

namespace skein::exchange::connection_batch_test {
namespace {

constexpr const char* kHeader = "x0,y0,psi0,x1,y1,psi1,airspeed,turn_radius,wx,wy\n";

std::string answers(const std::string& table, std::size_t part = 1 << 20) {
  ConnectionBatch batch("table.csv");
  std::string out;
  for (std::size_t at = 0; at < table.size(); at += part) {
    const auto good = batch.take(std::string_view(table).substr(at, part), out);
    if (!good) return good.error().text();
  }
  const auto good = batch.finish(out);
  return good ? out : good.error().text();
}

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> all;
  CsvCells cells(line);
  while (const auto cell = cells.next()) all.emplace_back(*cell);
  return all;
}

// Without the word: of a straight flight every one with a straight is right.
std::string times_and_lengths(const std::string& out) {
  std::string text;
  const auto lines = lines_of(out);
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const auto cells = cells_of(lines[i]);
    text += cells[0] + "," + cells[2] + "\n";
  }
  return text;
}

std::string random_rows(int count) {
  RandomStream random(7, 0, Purpose::kTest);
  std::string text;
  for (int i = 0; i < count; ++i) {
    const double wind = 12 * random.uniform(), to = 2 * geo::kPi * random.uniform();
    text +=
        fmt::format("{},{},{},{},{},{},15,60,{},{}\n", 1000 * random.uniform(),
                    1000 * random.uniform(), 7 * random.uniform() - 3.5,
                    1000 * random.uniform(), 1000 * random.uniform(),
                    7 * random.uniform() - 3.5, wind * std::cos(to), wind * std::sin(to));
  }
  return text;
}

// The same case asked in the project's own frame: north, east, clockwise.
model::Connection in_own_frame(const std::vector<std::string>& c) {
  const auto n = [&](std::size_t i) { return std::stod(c[i]); };
  return model::connect({{n(1), n(0)}, geo::kPi / 2 - n(2)},
                        {{n(4), n(3)}, geo::kPi / 2 - n(5)}, {n(6), n(7), {n(9), n(8)}});
}

// Where the answered word, flown on a map with x east and y north from the row's start,
// is after the answered time: each turn at V/rho, left is counter-clockwise.
double end_error(const std::vector<std::string>& c, const std::string& word,
                 const std::array<double, 3>& parts) {
  const auto n = [&](std::size_t i) { return std::stod(c[i]); };
  const double speed = n(6), radius = n(7);
  double x = n(0), y = n(1), psi = n(2), time = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double seconds = parts[k] * radius / speed;
    const double rate = word[k] == 'L'   ? speed / radius
                        : word[k] == 'R' ? -speed / radius
                                         : 0;
    if (rate == 0) {
      x += speed * seconds * std::cos(psi);
      y += speed * seconds * std::sin(psi);
    } else {
      x += speed / rate * (std::sin(psi + rate * seconds) - std::sin(psi));
      y -= speed / rate * (std::cos(psi + rate * seconds) - std::cos(psi));
    }
    psi += rate * seconds;
    time += seconds;
  }
  x += n(8) * time - n(3);
  y += n(9) * time - n(4);
  return std::hypot(x, y) + radius * std::abs(geo::wrap_pi(psi - n(5)));
}

TEST(ConnectionBatch, AnswersAsTheSolverDoesInTheOwnFrame) {
  const std::string rows = random_rows(400);
  const auto in = lines_of(rows), out = lines_of(answers(kHeader + rows));
  ASSERT_EQ(out.size(), in.size() + 1);
  EXPECT_EQ(out[0], "time_s,word,length_m,status");
  int same_words = 0;
  for (std::size_t i = 0; i < in.size(); ++i) {
    const auto row = cells_of(in[i]), answer = cells_of(out[i + 1]);
    ASSERT_EQ(answer.size(), 4u) << out[i + 1];
    ASSERT_EQ(answer[3], "found");
    const model::Connection own = in_own_frame(row);
    // Angles turned into the other frame are rounded there.
    EXPECT_NEAR(std::stod(answer[0]), own.time, 1e-9 * own.time);
    EXPECT_GE(std::stod(answer[2]), std::hypot(std::stod(row[3]) - std::stod(row[0]),
                                               std::stod(row[4]) - std::stod(row[1])) -
                                        1e-9);
    if (answer[1] != model::name_of(own.word)) continue;
    ++same_words;
    EXPECT_LT(end_error(row, answer[1], own.parts), 1e-6 * 60) << in[i];
  }
  EXPECT_GE(same_words, 398) << "words differ only where two are equally quick";
}

TEST(ConnectionBatch, LengthIsOverGround) {
  // Straight downwind: 300 m of ground in 300 / (15 + 5) s. Upwind: 30 s.
  EXPECT_EQ(
      times_and_lengths(answers(std::string(kHeader) + "0,0,0,300,0,0,15,60,5,0\n")),
      "15,300\n");
  EXPECT_EQ(times_and_lengths(answers(std::string(kHeader) + "0,0,0,300,0,0,15,60,-5,0")),
            "30,300\n");
}

TEST(ConnectionBatch, ARowThatCannotBeSolvedGivesItsRow) {
  const std::string rows =
      "0,0,0,300,0,0,15,60,0,0\n"      // good
      "nan,0,0,300,0,0,15,60,0,0\n"    // no number at all, as a number
      "0,0,0,300,0,0,15,0,0,0\n"       // no radius
      "0,0,0,300,0,0,15,60,15,0\n"     // wind as fast as the aircraft
      "0,0,0,300,0,0,15,60,0\n"        // a cell too few
      "0,0,0,300,0,0,15,60,0,0,1\n"    // a cell too many
      "0,0,0,300,0,0,15,60,0,\n"       // an empty cell
      "0,0,zero,300,0,0,15,60,0,0\n"   // a word
      "0,0,0x1,300,0,0,15,60,0,0\n"    // other notations
      "0,0,1e999,300,0,0,15,60,0,0\n"  // beyond what a double holds
      "0,0,0,inf,0,0,15,60,0,0\n"
      "\n"  // no row
      "0,0,0,300,0,0,-15,60,0,0\n"
      "0,0,0,300,0,0,15,60,0,0\n";  // good
  const auto out = lines_of(answers(kHeader + rows));
  const std::vector<std::string> expected = {
      "found",      "bad-input",  "bad-input",  "wind-too-strong", "unreadable",
      "unreadable", "unreadable", "unreadable", "unreadable",      "unreadable",
      "bad-input",  "bad-input",  "found"};
  ASSERT_EQ(out.size(), expected.size() + 1);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const auto cells = cells_of(out[i + 1]);
    ASSERT_EQ(cells.size(), 4u);
    EXPECT_EQ(cells[3], expected[i]) << i;
    EXPECT_EQ(cells[0].empty(), cells[3] != "found") << i;
    EXPECT_EQ(cells[2].empty(), cells[3] != "found") << i;
  }
}

TEST(ConnectionBatch, TakesColumnsInAnyOrderAndIgnoresOthers) {
  const std::string table =
      "\xEF\xBB\xBFwy,wx,turn_radius,note,airspeed,psi1,y1,x1,psi0,\"y0\", x0 ,id\r\n"
      "0,5,60,\"a, b\",+15,0,0,300,0,0,0,7\r\n";
  EXPECT_EQ(times_and_lengths(answers(table)), "15,300\n");
}

TEST(ConnectionBatch, PartsMayBeCutAnywhere) {
  const std::string table = kHeader + random_rows(30) + "0,0,0,300,0,0,15,60,5,0";
  const std::string whole = answers(table);
  for (const std::size_t part : {1u, 2u, 7u, 64u, 1000u})
    EXPECT_EQ(answers(table, part), whole) << part;
}

TEST(ConnectionBatch, NumbersReadBackAsTheSameDoubles) {
  const std::string rows = random_rows(50);
  const auto in = lines_of(rows), out = lines_of(answers(kHeader + rows));
  for (std::size_t i = 0; i < in.size(); ++i) {
    const auto c = cells_of(in[i]);
    const auto n = [&](std::size_t k) { return std::stod(c[k]); };
    const model::Pose from{{n(0), n(1)}, n(2)}, to{{n(3), n(4)}, n(5)};
    const model::AirMotion air{n(6), n(7), {n(8), n(9)}};
    const model::Connection found = model::connect(from, to, air);
    const auto answer = cells_of(out[i + 1]);
    EXPECT_EQ(std::stod(answer[0]), found.time);
    EXPECT_EQ(std::stod(answer[2]),
              model::ground_length(model::to_flight_plan(found, from, air)));
  }
}

TEST(ConnectionBatch, RefusesAHeaderThatDoesNotSayAll) {
  EXPECT_NE(answers("x0,y0,psi0,x1,y1,psi1,airspeed,turn_radius,wx\n1\n")
                .find("table.csv:1: the header lacks: wy."),
            std::string::npos);
  EXPECT_NE(answers("x0,x0,y0,psi0,x1,y1,psi1,airspeed,turn_radius,wx,wy\n")
                .find("given twice: x0."),
            std::string::npos);
  EXPECT_NE(answers("").find("the table is empty"), std::string::npos);
  EXPECT_NE(answers("\n \r\n").find("the table is empty"), std::string::npos);
  EXPECT_EQ(answers(kHeader), "time_s,word,length_m,status\n");
}

TEST(ConnectionBatch, HoldsNoLineOfAnyLength) {
  const std::string good = "0,0,0,300,0,0,15,60,5,0\n";
  const std::string table =
      kHeader + good + "1" + std::string(5'000'000, '0') + "\n" + good;
  const auto out = lines_of(answers(table, 4096));
  ASSERT_EQ(out.size(), 4u);
  EXPECT_EQ(out[2], ",,,unreadable");
  EXPECT_EQ(out[3], out[1]);
  EXPECT_NE(answers(std::string(5'000'000, 'x'), 4096).find("a header of more than"),
            std::string::npos);
}

TEST(ConnectionBatch, ExtremeNumbersAreAnswered) {
  std::string rows;
  for (const char* size :
       {"1e-320", "1e-300", "1e-30", "1e30", "1e150", "1e200", "1e308"})
    for (const char* other : {"0,0,0,{},0,1,15,60,0,0", "0,0,0,{},0,1,15,60,3,2",
                              "0,0,{},9,0,1,15,60,0,0", "0,0,0,9,0,1,{},60,0,1e-5",
                              "0,0,0,9,0,1,15,{},2,0", "{0},0,0,-{0},0,1,15,60,0,0"})
      rows += fmt::format(fmt::runtime(other), size) + "\n";
  const auto out = lines_of(answers(kHeader + rows));
  ASSERT_EQ(out.size(), 43u);
  for (std::size_t i = 1; i < out.size(); ++i) {
    const auto cells = cells_of(out[i]);
    ASSERT_EQ(cells.size(), 4u) << out[i];
    if (cells[3] == "found") {
      EXPECT_TRUE(std::isfinite(std::stod(cells[0]))) << out[i];
      EXPECT_TRUE(std::isfinite(std::stod(cells[2]))) << out[i];
    }
  }
}

}  // namespace
}  // namespace skein::exchange::connection_batch_test
