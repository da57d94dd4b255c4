// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "skein/model/well_clear/bands.h"

namespace skein::model::test {

/// A table of the reference data, one map from column to cell for each row. Empty where
/// the file is missing.
using Row = std::map<std::string, std::string>;

inline std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream in(line);
  for (std::string cell; std::getline(in, cell, ',');) cells.push_back(cell);
  if (line.ends_with(',')) cells.emplace_back();
  return cells;
}

inline std::vector<Row> reference_table(const std::string& name) {
  std::vector<Row> rows;
  std::ifstream in(std::string(SKEIN_SHARED_DATA) + "/team/detect/" + name);
  std::string line;
  if (!std::getline(in, line)) return rows;
  const std::vector<std::string> header = cells_of(line);
  while (std::getline(in, line)) {
    const std::vector<std::string> cells = cells_of(line);
    Row& row = rows.emplace_back();
    for (std::size_t i = 0; i < header.size(); ++i) row[header[i]] = cells.at(i);
  }
  return rows;
}

/// NaN for an empty cell.
inline double number(const std::string& cell) {
  return cell.empty() ? std::numeric_limits<double>::quiet_NaN()
                      : std::strtod(cell.c_str(), nullptr);
}

struct ReferenceEncounter {
  AircraftMotion own;
  std::vector<Intruder> intruders;
};

/// Those of one configuration, by case; its files begin with `prefix`.
struct ReferenceSet {
  std::string prefix;
  WellClearConfiguration configuration;
  std::map<std::string, ReferenceEncounter> encounters;
};

inline std::vector<ReferenceSet> reference_sets() {
  std::vector<ReferenceSet> sets;
  for (const auto& [prefix, name] :
       {std::pair{"do365", "DO_365B_no_SUM"}, std::pair{"suas", "skein_suas"}}) {
    ReferenceSet set{prefix, *well_clear_configuration(name), {}};
    for (Row& row : reference_table(set.prefix + "_encounters.csv")) {
      ReferenceEncounter& encounter = set.encounters[row["case"]];
      const auto at = [&](const char* column) { return number(row[column]); };
      const AircraftMotion motion{Vec3(at("north_m"), at("east_m"), at("down_m")),
                                  Vec3(at("vn_mps"), at("ve_mps"), at("vd_mps"))};
      if (row["aircraft"] == "0") {
        encounter.own = motion;
      } else {
        Intruder& intruder = encounter.intruders.emplace_back();
        intruder.motion = motion;
        intruder.alerter = *alerter_named(set.configuration, row["alerter"]);
      }
    }
    if (!set.encounters.empty()) sets.push_back(std::move(set));
  }
  return sets;
}

/// The name of a kind in the tables, and what their values are multiples of.
struct KindName {
  ManoeuvreKind kind;
  const char* name;
  double unit;
};

inline const KindName kKindNames[] = {
    {ManoeuvreKind::kTrack, "track_deg", geo::radians(1)},
    {ManoeuvreKind::kSpeed, "speed_mps", 1},
    {ManoeuvreKind::kVerticalSpeed, "vs_mps", 1},
    {ManoeuvreKind::kAltitude, "alt_m", 1}};

}  // namespace skein::model::test
