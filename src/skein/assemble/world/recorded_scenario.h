// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "skein/base/result.h"
#include "skein/layer/environment/recorded/recorded_fire.h"

namespace skein::assemble {

/// How long a scenario may last [s]; see scenario::Fields.
inline constexpr double kMaxScenarioDuration = 4e6;

/// A recorded fire and what a scenario about it needs.
struct RecordedScenario {
  environment::RecordedFireOptions source;
  environment::RecordedFireSummary fire;
  std::filesystem::path elevations;   ///< a raster; empty: there is none
  std::vector<std::string> warnings;  ///< what was assumed and repaired
};

/// Reads a recorded fire.
/// @param data  a folder with `perimeters.csv`, or else vector files, or else an
///              arrival-time raster, and elevations in `elevation.tif` or
///              `landscape/elevation.tif` if there are any; or the source file itself.
/// @param file  what the data does not say of itself.
/// Fails: kNotFound when there is no such data; as make_recorded_fire().
Result<RecordedScenario> read_recorded_scenario(
    const std::filesystem::path& data, const environment::PerimeterFileOptions& file);

/// The changes that fit a recorded-fire scenario to other data: source, terrain, origin,
/// start (if the data is dated), duration and a rough prior of place and size (radius of
/// a circle of the first area, 40 % standard deviation).
/// @returns  overrides, KEY=VALUE.
std::vector<std::string> recorded_overrides(const RecordedScenario& recorded);

/// The order of dates by the word that scenarios have for it; none for any other word.
std::optional<environment::DateOrder> date_order_named(std::string_view word);

/// A scenario of two aircraft that watch the fire, as a file that people go on with.
std::string recorded_scenario_text(const RecordedScenario& recorded,
                                   const std::string& name);

}  // namespace skein::assemble
