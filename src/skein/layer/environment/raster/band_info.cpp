// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/environment/raster/band_info.h"

#include <cpl_string.h>
#include <gdal.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <string_view>

#include "skein/base/valid_text.h"
#include "skein/geo/unit_words.h"
#include "skein/layer/environment/raster/date_time.h"

namespace skein::environment {
namespace {

std::string text_or_empty(const char* text) {
  return valid_text(text);
}

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

// The number a text starts with.
std::optional<double> leading_number(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  double value = 0;
  const auto [end, error] =
      std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc()) return std::nullopt;
  return value;
}

// Whether days of a CF calendar are those of the world.
bool is_real_calendar(const std::string& calendar) {
  const std::string name = lower(calendar);
  return name.empty() || name == "standard" || name == "gregorian" ||
         name == "proleptic_gregorian";
}

// CF: "hours since 2017-05-21T00:00:00Z" and a number.
std::optional<double> cf_time(const std::string& unit, double value) {
  const std::string low = lower(unit);
  const std::size_t since = low.find(" since ");
  if (since == std::string::npos) return std::nullopt;
  std::string start = unit.substr(since + 7);
  if (start.size() >= 4 && lower(start).ends_with(" utc")) start.resize(start.size() - 4);
  // "1970-1-1 0:0:0" is allowed there.
  const auto origin = parse_date(start, DateOrder::kMonthFirst);
  const auto seconds = geo::time_unit(low.substr(0, since));
  if (!origin || !seconds || start.find('-') == std::string::npos) return std::nullopt;
  return origin->value + *seconds * value;
}

// NetCDF: the band's dimensions beside x and y are NETCDF_DIM_<name>=<value>; what they
// mean is in the dataset's <name>#units, <name>#standard_name...
void read_dimensions(GDALDatasetH dataset, char** metadata, BandInfo& info) {
  constexpr std::string_view kPrefix = "NETCDF_DIM_";
  for (int i = 0; metadata != nullptr && metadata[i] != nullptr; ++i) {
    const std::string_view line = metadata[i];
    const std::size_t equals = line.find('=');
    if (!line.starts_with(kPrefix) || equals == std::string_view::npos) continue;
    const std::string name(line.substr(kPrefix.size(), equals - kPrefix.size()));
    const auto value = leading_number(line.substr(equals + 1));
    if (!value) continue;
    const auto about = [&](const char* key) {
      return text_or_empty(
          GDALGetMetadataItem(dataset, (name + "#" + key).c_str(), nullptr));
    };
    const std::string unit = about("units");
    if (unit.find(" since ") != std::string::npos) {
      if (is_real_calendar(about("calendar"))) info.utc_s = cf_time(unit, *value);
    } else if (const auto metres = geo::length_unit(unit)) {
      info.height_m = *metres * *value;
    } else if (unit.empty() && about("standard_name") == "height") {
      info.height_m = *value;
    }
  }
}

// GRIB: "10-HTGL" is 10 m above ground.
std::optional<double> grib_height(const std::string& short_name) {
  const std::size_t dash = short_name.find('-');
  if (dash == std::string::npos) return std::nullopt;
  const std::string level = short_name.substr(dash + 1);
  if (level != "HTGL" && level != "GPML") return std::nullopt;
  return leading_number(short_name);
}

// The unit that the tables of the WMO give an element of wind, for files whose reader
// does not say it. Reference: [WMO-306] code table 4.2-0-2.
std::string wmo_unit(const std::string& element) {
  for (const char* speed : {"UGRD", "VGRD", "WIND", "GUST"})
    if (element == speed) return "m/s";
  return element == "WDIR" ? "degree_true" : "";
}

}  // namespace

BandInfo describe_band(void* dataset, int number) {
  GDALRasterBandH band = GDALGetRasterBand(dataset, number);
  char** metadata = GDALGetMetadata(band, nullptr);
  const auto item = [&](const char* key) {
    return text_or_empty(CSLFetchNameValue(metadata, key));
  };
  BandInfo info;
  info.number = number;
  info.unit = text_or_empty(GDALGetRasterUnitType(band));
  info.standard_name = item("standard_name");
  const std::string element = item("GRIB_ELEMENT");
  if (!element.empty()) {
    info.name = element;
    if (info.unit.empty()) info.unit = item("GRIB_UNIT");
    if (info.unit.empty()) info.unit = wmo_unit(element);
    info.utc_s = leading_number(item("GRIB_VALID_TIME"));
    info.height_m = grib_height(item("GRIB_SHORT_NAME"));
    return info;
  }
  info.name = item("NETCDF_VARNAME");
  if (info.name.empty()) info.name = text_or_empty(GDALGetDescription(band));
  read_dimensions(dataset, metadata, info);
  return info;
}

}  // namespace skein::environment
