// SPDX-License-Identifier: Apache-2.0
#include "skein/campaign/avoidance/avoidance_cases.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <span>

#include "skein/base/csv.h"
#include "skein/base/input_file.h"

namespace skein::campaign {
namespace {

constexpr std::array<std::string_view, 9> kTeamColumns = {
    "case",         "aircraft",    "start_north_m", "start_east_m", "start_down_m",
    "goal_north_m", "goal_east_m", "goal_down_m",   "airspeed_mps"};
constexpr std::array<std::string_view, 17> kEncounterColumns = {
    "case",         "own_north_m", "own_east_m",    "own_down_m",
    "goal_north_m", "goal_east_m", "own_speed_mps", "int_north_m",
    "int_east_m",   "int_down_m",  "int_vn_mps",    "int_ve_mps",
    "int_vd_mps",   "turn_from_s", "turn_for_s",    "turn_rate_radps",
    "climb_vd_mps"};
constexpr double kFastestOwn = 500;      // of an own aircraft [m/s]
constexpr double kFastestTraffic = 400;  // [m/s]
constexpr double kSteepest = 100;        // [m/s]
constexpr double kFastestTurn = 1.5;     // [rad/s]
constexpr double kLongest = 1e7;         // [s]

std::optional<Vec3> vector(CsvRow& row, const char* north, const char* east,
                           const char* down) {
  const auto n = row.number(north), e = row.number(east), d = row.number(down);
  if (!n || !e || !d) return std::nullopt;
  return Vec3(*n, *e, *d);
}

// Reports a number that is not in its range; true where it is.
bool in_range(CsvRow& row, const char* column, const std::optional<double>& value,
              double low, double high) {
  if (!value) return false;
  if (*value >= low && *value <= high) return true;
  row.report(column, fmt::format("must be from {:g} to {:g}.", low, high));
  return false;
}

std::optional<double> airspeed(CsvRow& row, const char* column) {
  const auto value = row.number(column);
  if (value && !(*value > 0 && *value <= kFastestOwn)) {
    row.report(column, fmt::format("must be above 0 and at most {:g}.", kFastestOwn));
    return std::nullopt;
  }
  return value;
}

bool apart(CsvRow& row, const AvoidanceAircraft& aircraft) {
  if ((aircraft.start - aircraft.goal).head<2>().norm() >= 1) return true;
  row.report("goal_north_m", "start and goal are at one place.");
  return false;
}

void read_member(CsvRow& row, std::vector<AvoidanceCase>& cases) {
  const std::string which(row.text("case"));
  const auto start = vector(row, "start_north_m", "start_east_m", "start_down_m");
  const auto goal = vector(row, "goal_north_m", "goal_east_m", "goal_down_m");
  const auto speed = airspeed(row, "airspeed_mps");
  if (which.empty()) row.report("case", "is empty.");
  if (!start || !goal || !speed || which.empty()) return;
  const AvoidanceAircraft aircraft{*start, *goal, *speed};
  if (!apart(row, aircraft)) return;
  if (cases.empty() || cases.back().name != which) cases.push_back({which, {}, {}, {}});
  AvoidanceCase& one = cases.back();
  one.wind = {row.number_if_given("wind_north_mps").value_or(0),
              row.number_if_given("wind_east_mps").value_or(0)};
  one.aircraft.push_back(aircraft);
}

// None where it does not turn, or where something is wrong with the turn.
std::optional<AvoidanceIntruder::Turn> turn_of(CsvRow& row) {
  const auto from = row.number_if_given("turn_from_s");
  if (!from) return std::nullopt;
  const auto duration = row.number("turn_for_s"), rate = row.number("turn_rate_radps"),
             down = row.number("climb_vd_mps");
  // All of them, so that each is reported that is wrong.
  const std::array good = {
      in_range(row, "turn_from_s", from, 0, kLongest),
      in_range(row, "turn_for_s", duration, 1e-3, kLongest),
      in_range(row, "turn_rate_radps", rate, -kFastestTurn, kFastestTurn),
      in_range(row, "climb_vd_mps", down, -kSteepest, kSteepest)};
  if (!std::ranges::all_of(good, std::identity())) return std::nullopt;
  return AvoidanceIntruder::Turn{*from, *duration, *rate, -*down};
}

void read_encounter(CsvRow& row, std::vector<AvoidanceCase>& cases) {
  const std::string which(row.text("case"));
  const auto start = vector(row, "own_north_m", "own_east_m", "own_down_m");
  const auto north = row.number("goal_north_m"), east = row.number("goal_east_m");
  const auto speed = airspeed(row, "own_speed_mps");
  const auto place = vector(row, "int_north_m", "int_east_m", "int_down_m");
  const auto velocity = vector(row, "int_vn_mps", "int_ve_mps", "int_vd_mps");
  const auto turn = turn_of(row);
  if (which.empty()) row.report("case", "is empty.");
  if (velocity && !(velocity->head<2>().norm() > 0.01 &&
                    velocity->head<2>().norm() <= kFastestTraffic))
    return row.report(
        "int_vn_mps",
        fmt::format("the intruder must fly at 0.01 to {:g} m/s.", kFastestTraffic));
  if (velocity && !in_range(row, "int_vd_mps", velocity->z(), -kSteepest, kSteepest))
    return;
  if (which.empty() || !start || !north || !east || !speed || !place || !velocity) return;
  const AvoidanceAircraft own{*start, {*north, *east, start->z()}, *speed};
  if (!apart(row, own)) return;
  cases.push_back({which, {}, {own}, {{*place, *velocity, turn}}});
}

bool is_of_encounters(const std::string& text) {
  return text.substr(0, text.find('\n')).find("int_north_m") != std::string::npos;
}

}  // namespace

Result<std::vector<AvoidanceCase>> read_avoidance_cases(
    const std::filesystem::path& file) {
  const auto text = read_file(file);
  if (!text) return text.error();
  return parse_avoidance_cases(text.value(), file.filename().string());
}

Result<std::vector<AvoidanceCase>> parse_avoidance_cases(const std::string& text,
                                                         const std::string& name) {
  const bool encounters = is_of_encounters(text);
  std::vector<AvoidanceCase> cases;
  const std::vector<Error> problems = read_csv(
      text, name,
      {encounters ? std::span<const std::string_view>(kEncounterColumns) : kTeamColumns},
      [&](CsvRow& row) {
        encounters ? read_encounter(row, cases) : read_member(row, cases);
      });
  if (auto good = first_problem(problems); !good) return good.error();
  if (cases.empty()) return Error{ErrorCode::kBadInput, name, "has no cases.", ""};
  return cases;
}

}  // namespace skein::campaign
