// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/plan/arguments.h"
#include "app/plan/input.h"
#include "skein/base/result.h"
#include "skein/data/airspace/airspace.h"
#include "skein/exchange/gis/map_features.h"

namespace skein::app {

/// The files of zones and moving obstacles, and one more if its name is not empty.
std::vector<std::filesystem::path> files_of(const PlanMaps& given,
                                            const std::string& more = "");

/// Zones and moving obstacles of map files; says the files' oddities on standard error. A
/// file may have none.
/// Fails: as exchange::read_map(), zones_of(), movers_of(); for limits of altitude when
///        no altitude was given.
Result<Airspace> read_airspace(const PlanMaps& given, const ReadSetting& setting,
                               bool has_altitude);

/// The features of one map file; says its oddities on standard error.
/// Fails: as exchange::read_map(); kBadInput when there are none.
Result<std::vector<exchange::MapFeature>> read_features(const std::string& file,
                                                        const PlanMaps& given,
                                                        const ReadSetting& setting);

}  // namespace skein::app
