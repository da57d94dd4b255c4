// SPDX-License-Identifier: Apache-2.0
// skein fly: what it takes, what it refuses, and that it agrees with another engine.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <sstream>

#include "app/test/program.h"

namespace skein::app {
namespace {

constexpr const char* kHeader =
    "t,de_rad,da_rad,dr_rad,thrust_N,wind_n_mps,wind_e_mps,wind_d_mps,north_m,east_m,"
    "down_m,u_mps,v_mps,w_mps,phi_rad,theta_rad,psi_rad,p_rps,q_rps,r_rps";

using Table = std::vector<std::vector<double>>;

// The rows behind the header.
Table rows_of(const std::string& text) {
  Table rows;
  std::istringstream lines(text);
  std::string line, cell;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    rows.emplace_back();
    std::istringstream cells(line);
    while (std::getline(cells, cell, ',')) rows.back().push_back(std::stod(cell));
  }
  return rows;
}

class Fly : public Program {
 protected:
  std::string trimmed(const std::string& airspeed, const std::string& seconds) {
    const Finished table = run({"fly", "--trim", "--aircraft", "aerosonde", "--airspeed",
                                airspeed, "--hold", seconds});
    EXPECT_EQ(table.status, 0) << table.err;
    return table.out;
  }
  Finished fly(const fs::path& input, std::vector<std::string> more = {}) {
    std::vector<std::string> arguments = {"fly", "--aircraft", "aerosonde", "--input",
                                          input.string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
  }
};

TEST_F(Fly, ATrimmedFlightStaysAsItIs) {
  const Finished flown = fly(write("in.csv", trimmed("25", "60")));
  ASSERT_EQ(flown.status, 0) << flown.err;
  EXPECT_TRUE(flown.out.starts_with(
      kHeader +
      std::string(",alpha_rad,beta_rad,Va_mps,fx_over_m,fy_over_m,fz_over_m\n")));
  const Table rows = rows_of(flown.out);
  ASSERT_EQ(rows.size(), 2u);
  ASSERT_EQ(rows[0].size(), 26u);
  EXPECT_EQ(rows[1][0], 60);
  EXPECT_EQ(rows[1][4], rows[0][4]) << "thrust";
  // The trim leaves 1e-9 m/s^2 at most, on an unstable spiral of 11 s.
  EXPECT_NEAR(rows[1][8], 25 * 60, 1e-6) << "north";
  for (const int column : {9, 10, 12, 14, 17, 18, 19})
    EXPECT_NEAR(rows[1][static_cast<std::size_t>(column)], 0, 1e-6) << column;
  EXPECT_NEAR(rows[1][22], 25, 1e-9) << "airspeed";
  EXPECT_NEAR(rows[1][20], rows[1][15], 1e-9) << "level: angle of attack is pitch";
  EXPECT_NEAR(std::hypot(rows[1][23], rows[1][25]), 9.80665, 1e-6)
      << "carries its weight";
}

TEST_F(Fly, ReadsStandardInputAndAircraftFilesAndTakesAnyColumnOrder) {
  write("mine.yaml", read_file(SKEIN_SOURCE_DIR "/aircraft/aerosonde.yaml"));
  const std::string table = trimmed("22", "2");
  std::istringstream lines(table);
  std::string line, turned;
  while (std::getline(lines, line)) {
    std::vector<std::string> cells;
    std::string cell;
    std::istringstream row(line);
    while (std::getline(row, cell, ',')) cells.push_back(cell);
    cells.resize(20);
    cells.push_back("comment");
    for (std::size_t i = cells.size(); i-- > 0;)
      turned += cells[i] + (i > 0 ? "," : "\r\n");
  }
  const Finished plain = fly(write("in.csv", table));
  ASSERT_EQ(plain.status, 0) << plain.err;
  const Finished other =
      run({"fly", "--aircraft", "mine.yaml", "--input",
           write("turned.csv", turned).string(), "--output", "out.csv"});
  EXPECT_EQ(other.status, 0) << other.err;
  EXPECT_EQ(other.out, "");
  EXPECT_EQ(read_file(folder_ / "out.csv"), plain.out);
  const std::string piped =
      fmt::format("{} fly --aircraft aerosonde --input - < {} > {}", SKEIN_PROGRAM,
                  (folder_ / "in.csv").string(), (folder_ / "piped.csv").string());
  EXPECT_EQ(std::system(piped.c_str()), 0);
  EXPECT_EQ(read_file(folder_ / "piped.csv"), plain.out);
}

TEST_F(Fly, RowsBetweenDoNotChangeAFlightThatIsHeld) {
  const std::string few = trimmed("20", "20");
  std::string many = few.substr(0, few.rfind("20,"));
  const std::string inputs = few.substr(few.rfind("20,") + 2);
  for (int i = 1; i <= 3000; ++i) many += fmt::format("{}{}", i / 150.0, inputs);
  const Finished flown = fly(write("many.csv", many));
  ASSERT_EQ(flown.status, 0) << flown.err;
  const Table rows = rows_of(flown.out), ends = rows_of(fly(write("few.csv", few)).out);
  ASSERT_EQ(rows.size(), 3001u) << "more than one part of the table";
  // Steps of 0.005 s in one, 1/300 s in the other; steady, so all that is left is
  // rounding, grown on the spiral.
  for (std::size_t i = 0; i < 26; ++i)
    EXPECT_NEAR(rows.back()[i], ends.back()[i], 1e-7) << i;
}

// sin^4 pulse of length d from t0 on.
double bump(double t, double t0, double d) {
  const double x = (t - t0) / d;
  return x <= 0 || x >= 1 ? 0 : std::pow(std::sin(std::numbers::pi * x), 4);
}
double doublet(double t, double t0, double d) {
  return bump(t, t0, d) - bump(t, t0 + d, d);
}

struct Manoeuvre {
  const char* name;
  const char* start;  // state columns
  double elevator, thrust;
  // Added to de, da, and the wind.
  std::function<std::array<double, 5>(double)> more;
  std::array<double, 12> end;  // after 60 s, by JSBSim 1.3 in steps of 1 ms
};

TEST_F(Fly, AgreesWithAnIndependentEngine) {
  constexpr double kDeg = std::numbers::pi / 180;
  const char* slow =
      "0,0,-100,24.963728680703433,0,1.3461984832204046,0,"
      "0.053873996262030883,{},0,0,0";
  const std::string east = fmt::format(fmt::runtime(slow), 1);
  const std::string north = fmt::format(fmt::runtime(slow), 0);
  const Manoeuvre all[] = {
      {"elevator doublet",
       "0,0,-100,29.99131292515466,0,0.7219065212692124,0,0.02406587366543919,0,0,0,0",
       -0.05297019580131656,
       13.844567316792864,
       [](double t) {
         return std::array{4 * kDeg * doublet(t, 2, 1.5), 0., 0., 0., 0.};
       },
       {1799.52453, 0, -99.9146141, 30.0169812, 0, 0.72181884, 0, 0.0201127119, 0, 0,
        0.000422652562, 0}},
      {"aileron doublet, into the spiral",
       east.c_str(),
       -0.13546944419996426,
       10.352416336310501,
       [](double t) {
         return std::array{0., 5 * kDeg * doublet(t, 2, 1.5), 0., 0., 0.};
       },
       {-155.581267, 517.330777, -11.3465132, 36.1144547, 0.36518513, 1.47446391,
        1.02267042, -0.0834147084, 5.60581871, 0.0425628069, 0.357920629, 0.221734838}},
      {"gusts",
       north.c_str(),
       -0.13546944419996426,
       10.352416336310501,
       [](double t) {
         return std::array{0., 0., 3 * bump(t, 5, 4) - 2 * bump(t, 20, 6),
                           2 * doublet(t, 12, 4), 1.5 * doublet(t, 30, 5)};
       },
       {1471.50347, -165.230467, -97.547711, 25.6574961, -0.0940788126, 1.35490457,
        -0.151823808, 0.0425722498, 5.6434893, -0.0104449906, 0.0213979131,
        -0.0551841559}}};
  for (const Manoeuvre& each : all) {
    std::string table = std::string(kHeader) + "\n";
    for (int i = 0; i <= 1200; ++i) {
      const double t = i * 0.05;
      const auto more = each.more(t);
      table +=
          fmt::format("{},{},{},0,{},{},{},{},{}\n", t, each.elevator + more[0], more[1],
                      each.thrust, more[2], more[3], more[4], i == 0 ? each.start : "");
    }
    const Finished flown = fly(write("in.csv", table));
    ASSERT_EQ(flown.status, 0) << flown.err;
    const Table rows = rows_of(flown.out);
    ASSERT_EQ(rows.size(), 1201u);
    // Measured: 1.5 mm, 12 um/s, 7e-7 rad/s, 1e-5 rad, all from the other engine's
    // pressure and steps (docs/fly.md); the bounds are five to ten times that.
    std::array<double, 4> max{};  // of position, velocity, angles, rates
    for (std::size_t i = 0; i < 12; ++i) {
      const double bound = i < 3 ? 1e-2 : i < 6 ? 1e-4 : i < 9 ? 1e-4 : 1e-5;
      const double off = rows.back()[8 + i] - each.end[i];
      const double wrong =
          std::abs(std::remainder(off, i == 8 ? 2 * std::numbers::pi : 1e9));
      EXPECT_LT(wrong, bound) << each.name << ", column " << 8 + i;
      max[i / 3] = std::max(max[i / 3], wrong);
    }
    fmt::print("{}, at the end: {:.2f} mm, {:.3f} mm/s, {:.1f} urad, {:.2f} urad/s\n",
               each.name, 1e3 * max[0], 1e3 * max[1], 1e6 * max[2], 1e6 * max[3]);
  }
}

TEST_F(Fly, RefusesBadTablesWithTheirPlace) {
  const std::string table = trimmed("25", "60");
  const auto message = [&](const std::string& text) {
    const Finished refused = fly(write("in.csv", text), {"--output", "out.csv"});
    EXPECT_EQ(refused.status, 2);
    return refused.err;
  };
  std::string none = table;
  none.replace(none.find("dr_rad"), 6, "dr_deg");
  EXPECT_NE(message(none).find("in.csv:1: the header lacks: dr_rad."), std::string::npos);
  EXPECT_NE(message(table + "59,0,0,0,0,0,0,0\n")
                .find("in.csv:4:t: found 59; must be above 60, that of the row before."),
            std::string::npos);
  EXPECT_EQ(rows_of(read_file(folder_ / "out.csv")).size(), 2u)
      << "what stands before the error is flown";
  EXPECT_NE(message(table + "61,0,0,0,0,0,0,fresh\n")
                .find("in.csv:4:wind_d_mps: found \"fresh\"; needs a number."),
            std::string::npos);
  EXPECT_NE(message(table + "1e9,0,0,0,0,0,0,0\n").find("in.csv:4:t: found 1000000000; "),
            std::string::npos);
  EXPECT_NE(message("").find("the table is empty"), std::string::npos);
}

TEST_F(Fly, GivesTheStateBeforeNumbersEnd) {
  // An elevator at its end, steps of a second: the integration explodes.
  std::string table = trimmed("25", "1");
  for (int i = 2; i < 200; ++i) table += fmt::format("{},1.5,1.5,0,900,0,0,0\n", i);
  const Finished lost = fly(write("in.csv", table), {"--step", "1"});
  EXPECT_EQ(lost.status, 2);
  EXPECT_NE(lost.err.find("the motion is not finite any more at t = "), std::string::npos)
      << lost.err;
  EXPECT_NE(lost.err.find("with airspeed"), std::string::npos);
  EXPECT_EQ(lost.out.find("nan"), std::string::npos);
  EXPECT_EQ(lost.out.find("inf"), std::string::npos);
  EXPECT_GE(rows_of(lost.out).size(), 2u);
}

TEST_F(Fly, RefusesWhatItCannotFlyOrWrite) {
  const fs::path in = write("in.csv", trimmed("25", "1"));
  const Finished quad = run({"fly", "--aircraft", "quad", "--input", in.string()});
  EXPECT_EQ(quad.status, 2);
  EXPECT_NE(quad.err.find("has no section fixed_wing, only multirotor"),
            std::string::npos);
  EXPECT_EQ(run({"fly", "--aircraft", "kite", "--input", in.string()}).status, 2);
  EXPECT_EQ(run({"fly", "--aircraft", "aerosonde"}).status, 2);
  EXPECT_EQ(run({"fly", "--aircraft", "aerosonde", "--input", "no.csv"}).status, 2);
  EXPECT_EQ(run({"fly", "--aircraft", "aerosonde", "--input", "."}).status, 2);
  EXPECT_EQ(fly(in, {"--output", in.string()}).status, 2) << "would destroy its input";
  EXPECT_EQ(read_file(in), trimmed("25", "1"));
  EXPECT_EQ(fly(in, {"--output", "no/such/folder.csv"}).status, 1);
  EXPECT_EQ(fly(in, {"--step", "0"}).status, 2);
  EXPECT_EQ(fly(in, {"--step", "nan"}).status, 2);
  EXPECT_EQ(run({"fly", "--trim", "--aircraft", "bixler", "--airspeed", "nan"}).status,
            2);
  EXPECT_EQ(fly(in, {"--trim"}).status, 2);
}

TEST_F(Fly, FindsTrimsAndSaysWhyThereIsNone) {
  const Finished table = run({"fly", "--trim", "--aircraft", "bixler"});
  EXPECT_EQ(table.status, 0) << table.err;
  EXPECT_EQ(std::count(table.out.begin(), table.out.end(), '\n'), 11);
  const Finished one = run({"fly", "--trim", "--aircraft", "aerosonde", "--airspeed",
                            "25", "--climb-deg", "3", "--json"});
  const auto json = nlohmann::json::parse(one.out, nullptr, false);
  ASSERT_TRUE(json.is_array() && json.size() == 1) << one.out;
  EXPECT_EQ(json[0]["found"], true);
  EXPECT_NEAR(json[0]["pitch_deg"].get<double>() - json[0]["alpha_deg"].get<double>(), 3,
              1e-3);
  EXPECT_EQ(json[0]["modes"].size(), 6u);
  const Finished turn = run({"fly", "--trim", "--aircraft", "aerosonde", "--airspeed",
                             "25", "--bank-deg", "-30", "--json"});
  const auto left = nlohmann::json::parse(turn.out, nullptr, false);
  EXPECT_NEAR(left[0]["roll_deg"].get<double>(), -30, 0.2);
  const Finished fast =
      run({"fly", "--trim", "--aircraft", "bixler", "--airspeed", "40"});
  EXPECT_NE(fast.out.find("none: needs"), std::string::npos) << fast.out;
}

TEST_F(Fly, BuiltInAircraftAreListedAndTheirKeysDocumented) {
  const Finished list = run({"list", "aircraft"});
  EXPECT_EQ(list.status, 0) << list.err;
  for (const char* name : {"aerosonde", "bixler", "quad", "light-sport", "x8"})
    EXPECT_NE(list.out.find(fmt::format("  {} ", name)), std::string::npos) << list.out;
  EXPECT_EQ(run({"keys", "aircraft"}).out,
            read_file(SKEIN_SOURCE_DIR "/docs/aircraft-keys.md"))
      << "Renew it: build/release/skein keys aircraft > docs/aircraft-keys.md";
  const auto schema =
      nlohmann::json::parse(run({"schema", "aircraft"}).out, nullptr, false);
  ASSERT_FALSE(schema.is_discarded());
  EXPECT_TRUE(schema["properties"].contains("fixed_wing"));
  EXPECT_EQ(run({"keys", "birds"}).status, 2);
}

}  // namespace
}  // namespace skein::app
