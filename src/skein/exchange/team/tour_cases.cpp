// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <set>

#include "skein/base/csv.h"
#include "skein/exchange/team/team_cases.h"
#include "skein/geo/vec.h"

namespace skein::exchange {
namespace {

constexpr std::size_t kMaxPoints = 3000;  // of a set: all pairs are kept
constexpr double kMaxTours = 1000;
constexpr double kMaxPoint = 1e9;

Error wrong_table(const std::string& place, std::string message) {
  return {ErrorCode::kBadInput, place, std::move(message), ""};
}

std::vector<std::string> cells_of(std::string_view line) {
  std::vector<std::string> all;
  CsvCells cells(line);
  while (const auto cell = cells.next()) all.emplace_back(trimmed(*cell));
  return all;
}

// Calls `take` with the wanted cells of each row and its place.
template <class Take>
Result<void> read_table(std::string_view text, const std::string& place,
                        const std::vector<std::string>& names, bool others_allowed,
                        Take take) {
  std::vector<std::size_t> columns;
  std::size_t width = 0;
  for (int number = 1; !text.empty(); ++number) {
    const std::size_t feed = text.find('\n');
    const std::string_view line = text.substr(0, feed);
    text.remove_prefix(feed == std::string_view::npos ? text.size() : feed + 1);
    if (trimmed(line).empty()) continue;
    const std::vector<std::string> cells = cells_of(line);
    const std::string at = fmt::format("{}:{}", place, number);
    if (columns.empty()) {
      width = cells.size();
      for (const std::string& name : names) {
        if (std::count(cells.begin(), cells.end(), name) != 1)
          return wrong_table(
              at, fmt::format("the first line must have one column {}.", name));
        columns.push_back(static_cast<std::size_t>(
            std::find(cells.begin(), cells.end(), name) - cells.begin()));
      }
      if (!others_allowed && width != names.size())
        return wrong_table(at, fmt::format("only these columns are allowed: {}.",
                                           fmt::join(names, ", ")));
      continue;
    }
    if (cells.size() != width)
      return wrong_table(
          at, fmt::format("has {} cells, the first line {}.", cells.size(), width));
    std::vector<std::string> row;
    for (const std::size_t c : columns) row.push_back(cells[c]);
    if (auto good = take(row, at); !good) return good.error();
  }
  if (columns.empty()) return wrong_table(place, "is empty.");
  return {};
}

Result<double> number_of(const std::string& cell, double min, double max,
                         const std::string& place, const char* column) {
  const auto value = number_in(cell);
  if (value && *value >= min && *value <= max) return *value;
  return wrong_table(
      place, fmt::format("{}: must be a number within {} to {}.", column, min, max));
}

struct PointSet {
  std::vector<std::int64_t> numbers;
  std::vector<Vec2> points;
};
using PointSets = std::vector<std::pair<std::string, std::shared_ptr<PointSet>>>;

Result<PointSets> read_points(std::string_view text, const std::string& place) {
  PointSets sets;
  std::map<std::string, std::size_t> index;
  std::set<std::pair<std::size_t, std::int64_t>> seen;
  const auto take = [&](const std::vector<std::string>& row,
                        const std::string& at) -> Result<void> {
    if (row[0].empty()) return wrong_table(at, "set: must not be empty.");
    const auto number = number_of(row[1], 1, 1e9, at, "point");
    if (!number) return number.error();
    const auto x = number_of(row[2], -kMaxPoint, kMaxPoint, at, "x");
    if (!x) return x.error();
    const auto y = number_of(row[3], -kMaxPoint, kMaxPoint, at, "y");
    if (!y) return y.error();
    const auto whole = static_cast<std::int64_t>(number.value());
    if (static_cast<double>(whole) != number.value())
      return wrong_table(at, "point: must be a whole number.");
    const auto [found, is_new] = index.try_emplace(row[0], sets.size());
    if (is_new) sets.emplace_back(row[0], std::make_shared<PointSet>());
    if (!seen.insert({found->second, whole}).second)
      return wrong_table(at, fmt::format("point: {} stands twice in the set.", whole));
    PointSet& set = *sets[found->second].second;
    if (set.points.size() == kMaxPoints)
      return wrong_table(at, fmt::format("a set has at most {} points.", kMaxPoints));
    set.numbers.push_back(whole);
    set.points.emplace_back(x.value(), y.value());
    return {};
  };
  if (auto good = read_table(text, place, {"set", "point", "x", "y"}, false, take); !good)
    return good.error();
  return sets;
}

TourCase case_of(const std::string& name, const std::shared_ptr<PointSet>& set,
                 std::size_t tours) {
  TourCase found;
  found.id = fmt::format("{}-{}", name, tours);
  found.places = set->numbers;
  found.problem.places = set->points.size();
  found.problem.tours = tours;
  found.problem.cost = [set](std::size_t a, std::size_t b) {
    return (set->points[a] - set->points[b]).norm();
  };
  return found;
}

}  // namespace

bool has_column(std::string_view table, std::string_view name) {
  const auto cells = cells_of(table.substr(0, table.find('\n')));
  return std::find(cells.begin(), cells.end(), name) != cells.end();
}

Result<std::vector<TourCase>> read_tour_cases(std::string_view points,
                                              const std::string& points_place,
                                              std::string_view cases,
                                              const std::string& cases_place) {
  const auto sets = read_points(points, points_place);
  if (!sets) return sets.error();
  std::vector<TourCase> found;
  std::set<std::string> ids;
  const auto take = [&](const std::vector<std::string>& row,
                        const std::string& at) -> Result<void> {
    const auto tours = number_of(row[1], 1, kMaxTours, at, "vehicles");
    if (!tours) return tours.error();
    const auto whole = static_cast<std::size_t>(tours.value());
    if (static_cast<double>(whole) != tours.value())
      return wrong_table(at, "vehicles: must be a whole number.");
    for (const auto& [name, set] : sets.value()) {
      if (name != row[0]) continue;
      found.push_back(case_of(name, set, whole));
      if (!ids.insert(found.back().id).second)
        return wrong_table(at, fmt::format("{} stands twice.", found.back().id));
      return {};
    }
    return wrong_table(at, fmt::format("set: {} has no points.", row[0]));
  };
  if (auto good = read_table(cases, cases_place, {"set", "vehicles"}, true, take); !good)
    return good.error();
  return found;
}

Result<std::vector<TourCase>> read_tour_cases(std::string_view points,
                                              const std::string& points_place,
                                              const std::vector<std::size_t>& tours) {
  const auto sets = read_points(points, points_place);
  if (!sets) return sets.error();
  std::vector<TourCase> found;
  for (const auto& [name, set] : sets.value())
    for (const std::size_t count : tours) found.push_back(case_of(name, set, count));
  return found;
}

}  // namespace skein::exchange
