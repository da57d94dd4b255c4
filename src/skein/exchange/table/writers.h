// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "skein/base/result.h"
#include "skein/exchange/table/document.h"

namespace skein::exchange {

/// How finely plans are written.
struct WritingOptions {
  /// Straight legs between points leave the plan by at most this [m].
  double tolerance = 1;
  /// CSV: longest time from one row to the next [s].
  double step = 1;
};

/// GeoJSON (RFC 7946): a line for each element with its times and headings, a polygon for
/// each zone, points for marks and moving obstacles. The property `what` distinguishes
/// them: element, zone, area, hole, line, start, goal, place, obstacle.
/// Fails: kBadInput without a frame.
Result<std::string> to_geojson(const Document& document, const WritingOptions& options);

/// A table of moments: plan, element, time_s, north_m, east_m, altitude_m, latitude_deg,
/// longitude_deg, heading_deg, course_deg, airspeed_mps, ground_speed_mps, climb_mps.
/// Latitude and longitude are empty without a frame.
std::string to_csv(const Document& document, const WritingOptions& options);

/// KML 2.2 for map programs: plans as lines at their altitudes, zones with floor and
/// ceiling in their extended data, marks.
/// Fails: kBadInput without a frame.
Result<std::string> to_kml(const Document& document, const WritingOptions& options);

/// QGroundControl's plan file: waypoints and the zones as a fence.
/// Fails: kBadInput without a frame or altitudes, or unless there is exactly one plan.
Result<std::string> to_qgc_plan(const Document& document, const WritingOptions& options);

/// The MAVLink mission text file ("QGC WPL 110").
/// Fails: as to_qgc_plan().
Result<std::string> to_waypoints(const Document& document, const WritingOptions& options);

/// A picture to scale: plans, zones, marks, wind, a scale bar and a legend.
std::string to_svg(const Document& document);

/// One page that needs nothing else: the picture to pan and zoom, and tables.
std::string to_html(const Document& document);

}  // namespace skein::exchange
