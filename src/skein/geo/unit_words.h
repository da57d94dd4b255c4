// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>

namespace skein::geo {

// Units as files write them: by UDUNITS, GDAL, EPSG and people ("m", "Metre", "US survey
// foot", "ftUS", "m s**-1", "[m/s]", "km/h", "kt", "hours"), in letters of any size. Each
// function gives one of the unit in the unit of the SI; none for any other word.

std::optional<double> length_unit(std::string_view word);  ///< [m]
std::optional<double> time_unit(std::string_view word);    ///< [s]
std::optional<double> speed_unit(std::string_view word);   ///< [m/s]

}  // namespace skein::geo
