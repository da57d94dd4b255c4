#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "skein/base/result.h"

namespace skein::assemble {

/// The changes that fit a recorded-fire scenario to other data: source, terrain, origin,
/// start (if the data is dated), duration and a rough prior of place and size (radius of
/// a circle of the first area, 40 % standard deviation).
///
/// @param data  a folder with `perimeters.csv` or one vector file or arrival-time raster,
///              and elevations in `elevation.tif` or `landscape/elevation.tif` if there
///              are any (else level ground); or the source file itself.
/// @returns     overrides, KEY=VALUE.
/// Fails:       kNotFound when there is no such data; as make_recorded_fire().
Result<std::vector<std::string>> fit_recorded_scenario(const std::filesystem::path& data);

}  // namespace skein::assemble
