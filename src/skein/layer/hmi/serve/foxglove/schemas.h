// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace skein::hmi::foxglove {

// JSON schemas of what is sent: of the schemas of github.com/foxglove/foxglove-sdk what
// is filled in here, and of Skein's own values what docs/foxglove.md says.

std::string transforms_schema();  ///< foxglove.FrameTransforms
std::string scene_schema();       ///< foxglove.SceneUpdate
std::string location_schema();    ///< foxglove.LocationFix
std::string geojson_schema();     ///< foxglove.GeoJSON
std::string log_schema();         ///< foxglove.Log
std::string aircraft_schema();    ///< skein.Aircraft
std::string metrics_schema();     ///< skein.Metrics
std::string clock_schema();       ///< skein.RunClock

}  // namespace skein::hmi::foxglove
