// SPDX-License-Identifier: Apache-2.0
#include "skein/exchange/table/formats.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

namespace skein::exchange {
namespace {

struct Ending {
  std::string_view text;
  Format format;
};
constexpr std::array kEndings = {Ending{".geojson", Format::kGeojson},
                                 Ending{".csv", Format::kCsv},
                                 Ending{".kml", Format::kKml},
                                 Ending{".plan", Format::kQgcPlan},
                                 Ending{".waypoints", Format::kWaypoints},
                                 Ending{".svg", Format::kSvg},
                                 Ending{".html", Format::kHtml}};

}  // namespace

Result<Format> format_of(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  std::string known;
  for (const Ending& each : kEndings) {
    if (each.text == ending) return each.format;
    known += fmt::format("{}{}", known.empty() ? "" : ", ", each.text);
  }
  return Error{ErrorCode::kBadInput, file.string(),
               "the ending of the name says no format that plans are written in.",
               fmt::format("Allowed: {}.", known)};
}

Known known_of(const Document& document) {
  return {document.frame.has_value(), document.has_altitude, document.plans.size()};
}

Result<void> check_known(Format format, const Known& known) {
  const bool mission = format == Format::kQgcPlan || format == Format::kWaypoints;
  const bool on_earth = mission || format == Format::kGeojson || format == Format::kKml;
  const std::string_view what = mission                      ? "missions have"
                                : format == Format::kGeojson ? "GeoJSON has"
                                                             : "KML has";
  if (on_earth && !known.place)
    return Error{ErrorCode::kBadInput, "",
                 fmt::format("{} latitudes and longitudes; the place on Earth is not "
                             "known.",
                             what),
                 "Give --origin."};
  if (mission && !known.altitude)
    return Error{ErrorCode::kBadInput, "", "missions have altitudes; none was given.",
                 "Give --altitude-m."};
  if (mission && known.flights != 1)
    return Error{
        ErrorCode::kBadInput, "",
        fmt::format("a mission file holds one flight; there are {}.", known.flights),
        "Plan for one aircraft, or write another format."};
  return {};
}

Result<std::string> to_text(const Document& document, Format format,
                            const WritingOptions& options) {
  switch (format) {
    case Format::kGeojson:
      return to_geojson(document, options);
    case Format::kCsv:
      return to_csv(document, options);
    case Format::kKml:
      return to_kml(document, options);
    case Format::kQgcPlan:
      return to_qgc_plan(document, options);
    case Format::kWaypoints:
      return to_waypoints(document, options);
    case Format::kSvg:
      return to_svg(document);
    case Format::kHtml:
      return to_html(document);
  }
  return Error{};
}

}  // namespace skein::exchange
