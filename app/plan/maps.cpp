// SPDX-License-Identifier: Apache-2.0
#include "app/plan/maps.h"

#include <fmt/ranges.h>

#include <cmath>
#include <set>
#include <string>

#include "app/common/output.h"
#include "skein/exchange/gis/zones.h"

namespace skein::app {
namespace {

// The features of a map file, perhaps none; says its oddities.
Result<std::vector<exchange::MapFeature>> read_map(const std::string& file,
                                                   const PlanMaps& given,
                                                   const ReadSetting& setting) {
  std::vector<std::string> warnings;
  const bool in_metres = given.metres || !setting.frame;
  auto features =
      exchange::read_map(file, in_metres ? nullptr : &*setting.frame, warnings);
  for (const std::string& warning : warnings) complain("note: {}\n", warning);
  return features;
}

// What is no error, but perhaps not meant.
void note_zones(const std::string& file,
                const std::vector<exchange::MapFeature>& features,
                const std::vector<Zone>& zones) {
  if (zones.empty()) complain("note: {}: has no zones.\n", file);
  std::set<std::string> others;
  for (const exchange::MapFeature& feature : features)
    if (!feature.purpose.empty() && feature.purpose != "exclusion")
      others.insert(feature.purpose);
  if (!others.empty())
    complain("note: {}: what is for another purpose is no no-fly zone: {}.\n", file,
             fmt::format("{}", fmt::join(others, ", ")));
  if (const int movers = exchange::movers_among_zones(features); movers > 0)
    complain(
        "note: {}: {} of its features {} of a moving obstacle (height_m, "
        "velocity_east_mps ...); as zones they stand still. skein plan path takes "
        "moving obstacles with --obstacles.\n",
        file, movers, movers == 1 ? "has properties" : "have properties");
}

}  // namespace

Result<std::vector<exchange::MapFeature>> read_features(const std::string& file,
                                                        const PlanMaps& given,
                                                        const ReadSetting& setting) {
  auto features = read_map(file, given, setting);
  if (features && features.value().empty())
    return Error{ErrorCode::kBadInput, file, "has no features.", ""};
  return features;
}

std::vector<std::filesystem::path> files_of(const PlanMaps& given,
                                            const std::string& more) {
  std::vector<std::filesystem::path> files(given.zones.begin(), given.zones.end());
  files.insert(files.end(), given.obstacles.begin(), given.obstacles.end());
  if (!more.empty()) files.emplace_back(more);
  return files;
}

Result<Airspace> read_airspace(const PlanMaps& given, const ReadSetting& setting,
                               bool has_altitude) {
  Airspace airspace;
  for (const std::string& file : given.zones) {
    const auto features = read_map(file, given, setting);
    if (!features) return features.error();
    const auto zones = exchange::zones_of(features.value());
    if (!zones) return zones.error();
    note_zones(file, features.value(), zones.value());
    for (const Zone& zone : zones.value()) {
      if (!has_altitude &&
          (std::isfinite(zone.floor_msl) || std::isfinite(zone.ceiling_msl)))
        return Error{ErrorCode::kBadInput, file,
                     "has zones with a floor or a ceiling; the flight has no altitude.",
                     "Give --altitude-m."};
      airspace.zones.push_back(zone);
    }
  }
  for (const std::string& file : given.obstacles) {
    const auto features = read_map(file, given, setting);
    if (!features) return features.error();
    const auto movers = exchange::movers_of(features.value());
    if (!movers) return movers.error();
    if (movers.value().empty()) {
      complain("note: {}: has no moving obstacles.\n", file);
      continue;
    }
    if (!has_altitude)
      return Error{ErrorCode::kBadInput, file,
                   "obstacles have altitudes; the flight has none.",
                   "Give --altitude-m."};
    airspace.movers.insert(airspace.movers.end(), movers.value().begin(),
                           movers.value().end());
  }
  return airspace;
}

}  // namespace skein::app
