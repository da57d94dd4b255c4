// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "skein/base/result.h"

namespace skein::environment {

/// Refuses a file that ends before its own header says it does. Reading such a file
/// may give zeros for what is missing (classic NetCDF), or leave out the last
/// messages (GRIB), without a word.
///
/// Known: NetCDF classic, its 64-bit offset and 64-bit data forms (CDF-1, 2 and 5), GRIB
/// 1 and 2, and ENVI. Other formats pass: their libraries see it (HDF5, and with it
/// NetCDF 4, on opening; TIFF, ESRI's and ASCII grids on reading).
/// @param driver       GDAL's name of the format: "netCDF", "GRIB"...
/// @param pixel_bytes  size of all pixels without compression, with the header in front.
/// Fails: kBadInput: bytes are missing, or the header makes no sense.
/// Reference: [NetCDF-classic]; [WMO-306] section 0 of both editions.
Result<void> check_whole(const std::string& path, std::string_view driver,
                         std::uint64_t pixel_bytes);

}  // namespace skein::environment
