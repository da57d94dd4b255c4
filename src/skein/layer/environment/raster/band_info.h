// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/layer/environment/raster/raster_facts.h"

namespace skein::environment {

/// What an open GDAL dataset reports about a band: names, unit, and the time and height
/// it belongs to, from GRIB or CF metadata.
/// @param dataset  a GDALDatasetH.
BandInfo describe_band(void* dataset, int number);

}  // namespace skein::environment
