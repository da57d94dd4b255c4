// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "skein/base/math.h"
#include "skein/geo/unit_words.h"
#include "skein/layer/environment/raster/date_time.h"
#include "skein/layer/environment/raster/raster_file.h"
#include "skein/layer/environment/wind/gridded_wind.h"

namespace skein::environment {
namespace {

constexpr double kFastest = 150;  // [m/s]
constexpr double kMaxNodes = 4e6;

// One quantity: a file and those of its bands that hold it.
struct Quantity {
  RasterFile file;
  std::vector<int> bands;
  const BandInfo& info(std::size_t i) const {
    return file.bands()[static_cast<std::size_t>(bands[i]) - 1];
  }
};

Result<Quantity> open_quantity(const std::string& path, const std::string& name,
                               bool shared_file, int place) {
  auto file = RasterFile::open(path, name);
  if (!file) return file.error();
  Quantity quantity{std::move(file).value(), {}};
  const auto& bands = quantity.file.bands();
  if (!name.empty()) {
    std::set<std::string> names;
    for (const BandInfo& band : bands) {
      names.insert(band.name);
      if (band.name == name) quantity.bands.push_back(band.number);
    }
    if (!quantity.bands.empty()) return quantity;
    std::string all;
    for (const std::string& n : names) all += (all.empty() ? "" : ", ") + n;
    return Error{ErrorCode::kNotFound, path,
                 fmt::format("has no band named \"{}\"", name), "it has: " + all};
  }
  if (!shared_file) {
    for (const BandInfo& band : bands) quantity.bands.push_back(band.number);
    return quantity;
  }
  if (bands.size() != 2)
    return Error{
        ErrorCode::kBadInput, path,
        fmt::format("has {} bands, and nothing says which hold the wind", bands.size()),
        "name the two quantities, or give a file with two bands"};
  quantity.bands.push_back(place);
  return quantity;
}

// Metres per second in one unit of a quantity.
Result<double> unit_of_speed(const GriddedWindOptions& options, const Quantity& quantity,
                             std::size_t i) {
  constexpr const char* kUnits = "m/s, km/h, kt and mph are allowed; unit: mph says it";
  const std::string& unit = options.unit.empty() ? quantity.info(i).unit : options.unit;
  if (const auto speed = geo::speed_unit(unit)) return *speed;
  if (unit.empty())
    return Error{ErrorCode::kBadInput, quantity.file.path(),
                 "has no unit of its wind speed, and none is given (WindNinja writes mph "
                 "unless it is told otherwise)",
                 "give unit: m/s, km/h, kt or mph"};
  return Error{ErrorCode::kBadInput, quantity.file.path(),
               fmt::format("has wind in \"{}\"", unit), kUnits};
}

Result<void> check_direction(const Quantity& quantity, std::size_t i) {
  const std::string& unit = quantity.info(i).unit;
  if (unit.empty() || unit.find("deg") != std::string::npos) return {};
  return Error{ErrorCode::kBadInput, quantity.file.path(),
               fmt::format("has a direction in \"{}\"", unit), "degrees are allowed"};
}

// Which north the two quantities refer to.
Result<WindNorth> north_of(const GriddedWindOptions& options, const Quantity& first,
                           const Quantity& second) {
  if (options.north != WindNorth::kAuto) return options.north;
  // Directions are from true north by the conventions of CF, GRIB and the weather
  // services.
  if (options.kind == WindKind::kSpeedAndFrom || first.file.geographic())
    return WindNorth::kTrue;
  const std::string& u = first.info(0).standard_name;
  const std::string& v = second.info(0).standard_name;
  if (u == "eastward_wind" && v == "northward_wind") return WindNorth::kTrue;
  if ((u == "x_wind" || u == "grid_eastward_wind") &&
      (v == "y_wind" || v == "grid_northward_wind"))
    return WindNorth::kGrid;
  return Error{
      ErrorCode::kBadInput, first.file.path(),
      "has wind components on a projected grid and does not say whether they refer "
      "to true north or to the grid",
      "set north to true or grid"};
}

// Turns the two quantities, pixel by pixel, into components to north and east (of
// whatever north they refer to), in place.
Result<void> to_components(const GriddedWindOptions& options, double unit,
                           const std::string& place, std::vector<double>& first,
                           std::vector<double>& second) {
  for (std::size_t i = 0; i < first.size(); ++i) {
    double& a = first[i];
    double& b = second[i];
    if (std::isnan(a) || std::isnan(b)) {
      a = b = std::nan("");
      continue;
    }
    a *= unit;
    const bool polar = options.kind == WindKind::kSpeedAndFrom;
    const double speed = polar ? a : math::hypot(a, b * unit);
    if (speed < 0 || speed > kFastest)
      return Error{ErrorCode::kBadInput, place,
                   fmt::format("has a wind speed of {:.6g} m/s; 0 to {} are allowed",
                               speed, kFastest),
                   "is its \"no data\" value declared?"};
    if (polar && (b < -360 || b > 720))
      return Error{
          ErrorCode::kBadInput, place,
          fmt::format("has a wind direction of {:.6g} degrees; 0 to 360 are allowed", b),
          "is its \"no data\" value declared?"};
    const double north = polar ? -speed * math::cos(geo::radians(b)) : b * unit;
    const double east = polar ? -speed * math::sin(geo::radians(b)) : a;
    a = north;
    b = east;
  }
  return {};
}

// As resample(), with the key that lets values go on.
Result<GridField> covering(const PixelWindow& pixels, const PixelMap& map,
                           Missing missing, const std::string& place) {
  auto field = resample(pixels, map, missing, place);
  if (field || field.error().hint.find("go on") == std::string::npos) return field;
  Error error = field.error();
  error.hint = "use a smaller area, or let the nearest values go on (extend: true)";
  return error;
}

Result<GriddedWind::Slice> load_slice(const GriddedWindOptions& options,
                                      const Quantity& first, const Quantity& second,
                                      std::size_t i, const PixelMap& map,
                                      WindNorth north) {
  const Missing missing = options.extend ? Missing::kNearest : Missing::kError;
  const std::string& place = first.file.path();
  auto a = first.file.read(first.bands[i], map.window());
  if (!a) return a.error();
  const auto unit = unit_of_speed(options, first, i);
  if (!unit) {
    // A hole in the data is said first: it takes another file, not another key.
    if (const auto whole = covering(a.value(), map, missing, place); !whole)
      return whole.error();
    return unit.error();
  }
  if (options.kind == WindKind::kSpeedAndFrom) {
    if (const auto good = check_direction(second, i); !good) return good.error();
  } else if (options.unit.empty() && second.info(i).unit != first.info(i).unit) {
    return Error{ErrorCode::kBadInput, second.file.path(),
                 "has its two components in different units", ""};
  }
  auto b = second.file.read(second.bands[i], map.window());
  if (!b) return b.error();
  if (const auto good =
          to_components(options, unit.value(), place, a.value().values, b.value().values);
      !good)
    return good.error();
  const auto to_north = covering(a.value(), map, missing, place);
  if (!to_north) return to_north.error();
  const auto to_east = covering(b.value(), map, missing, place);
  if (!to_east) return to_east.error();

  // From the axes of that north to the axes of the local frame.
  const GridShape& shape = map.shape();
  std::vector<double> n(shape.count()), e(shape.count());
  for (int r = 0, k = 0; r < shape.rows; ++r)
    for (int c = 0; c < shape.columns; ++c, ++k) {
      const double axis =
          north == WindNorth::kTrue ? map.true_north(r, c) : map.grid_north(r, c);
      const Vec2 velocity =
          to_north.value().value(r, c) * geo::unit(axis) +
          to_east.value().value(r, c) * geo::turned_right(geo::unit(axis));
      n[static_cast<std::size_t>(k)] = velocity.x();
      e[static_cast<std::size_t>(k)] = velocity.y();
    }
  return GriddedWind::Slice{GridField(shape, std::move(n)),
                            GridField(shape, std::move(e))};
}

// Time [s since the run's start] of every band of the first quantity.
Result<std::vector<double>> band_times(const GriddedWindOptions& options,
                                       const Quantity& quantity) {
  const auto error = [&](const std::string& message, const std::string& hint) {
    return Error{ErrorCode::kBadInput, quantity.file.path(), message, hint};
  };
  const std::size_t count = quantity.bands.size();
  if (!options.times.empty()) {
    if (options.times.size() != count)
      return error(fmt::format("has {} bands of the wind, but {} times are given", count,
                               options.times.size()),
                   "give one time for each band");
    for (const double t : options.times)
      if (!(std::abs(t) <= 1e9))
        return error(fmt::format("time {} s is outside -1e9 to 1e9", t), "");
    return options.times;
  }
  std::vector<double> times(count, 0.0);
  bool timed = true;
  for (std::size_t i = 0; i < count; ++i) timed = timed && quantity.info(i).utc_s;
  if (!timed) {
    if (count == 1 && options.start_utc.empty()) return times;
    return error("does not say the times of its bands", "give them in times_s");
  }
  for (std::size_t i = 0; i < count; ++i) times[i] = *quantity.info(i).utc_s;
  double start = *std::min_element(times.begin(), times.end());
  if (!options.start_utc.empty()) {
    const auto given = parse_utc(options.start_utc);
    if (!given)
      return error(fmt::format("start time \"{}\" is not an ISO 8601 date and time",
                               options.start_utc),
                   "for example 2017-06-03T18:00:00Z");
    start = *given;
  }
  for (double& t : times) t -= start;
  return times;
}

// Whether pixels of two rasters lie at the same places in an area about the origin.
Result<void> check_same_place(const Quantity& first, const Quantity& second,
                              const geo::LocalFrame& frame, double area) {
  constexpr double kSamePixel = 1e-3;
  const GridShape shape{-area * Vec2(1, 1), 2 * area, 2, 2};
  const auto a = first.file.map(frame, shape), b = second.file.map(frame, shape);
  if (!a) return a.error();
  if (!b) return b.error();
  for (const int r : {0, 1})
    for (const int c : {0, 1})
      if ((a.value().pixel(r, c) - b.value().pixel(r, c)).norm() > kSamePixel)
        return Error{ErrorCode::kBadInput, second.file.path(),
                     "the two quantities of the wind differ in place", ""};
  return {};
}

// Times that all lie on one side of the run's start have little to say about it.
void note_times(const GriddedWindOptions& options, const std::vector<double>& times,
                std::vector<std::string>& warnings) {
  const auto [low, high] = std::minmax_element(times.begin(), times.end());
  if (*low > 0)
    warnings.push_back(
        fmt::format("{}: its times begin {:.1f} h after the run's start; "
                    "until then the first wind holds",
                    options.file, *low / 3600));
  else if (*high < 0)
    warnings.push_back(
        fmt::format("{}: its times end {:.1f} h before the run's start; "
                    "the last wind holds throughout",
                    options.file, -*high / 3600));
}

// Height above mean sea level of every band's level.
std::vector<double> band_heights(const GriddedWindOptions& options,
                                 const Quantity& quantity) {
  std::vector<double> heights;
  for (std::size_t i = 0; i < quantity.bands.size(); ++i)
    heights.push_back(options.ground_msl + quantity.info(i).height_m.value_or(0));
  return heights;
}

template <class T>
std::vector<T> sorted_unique(std::vector<T> values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

Result<void> check_alike(const Quantity& first, const Quantity& second) {
  const auto error = [&](const std::string& what) {
    return Error{ErrorCode::kBadInput, second.file.path(),
                 "the two quantities of the wind differ in " + what, ""};
  };
  if (first.file.columns() != second.file.columns() ||
      first.file.rows() != second.file.rows())
    return error("size");
  if (first.bands.size() != second.bands.size())
    return error(fmt::format("number of bands: {} and {}", first.bands.size(),
                             second.bands.size()));
  for (std::size_t i = 0; i < first.bands.size(); ++i)
    if (first.info(i).utc_s != second.info(i).utc_s ||
        first.info(i).height_m != second.info(i).height_m)
      return error(fmt::format("time or level of their band {}", i + 1));
  return {};
}

}  // namespace

Result<std::unique_ptr<WindField>> make_gridded_wind(const GriddedWindOptions& options,
                                                     const geo::LocalFrame& frame,
                                                     std::vector<std::string>& warnings) {
  const auto error = [&](const std::string& message, const std::string& hint = "") {
    return Error{ErrorCode::kBadInput, options.file, message, hint};
  };
  if (!(options.area > 0 && options.area <= 2e6))
    return error(
        fmt::format("area {} m: above 0 and up to 2000 km is allowed", options.area));
  if (!(options.spacing >= 0))
    return error(fmt::format("spacing {} m must not be below 0", options.spacing));
  const bool shared = options.second_file.empty();
  const auto first = open_quantity(options.file, options.first, shared, 1);
  if (!first) return first.error();
  const auto second = open_quantity(shared ? options.file : options.second_file,
                                    options.second, shared, 2);
  if (!second) return second.error();
  if (const auto alike = check_alike(first.value(), second.value()); !alike)
    return alike.error();
  if (const auto same =
          check_same_place(first.value(), second.value(), frame, options.area);
      !same)
    return same.error();
  const auto north = north_of(options, first.value(), second.value());
  if (!north) return north.error();
  const auto times = band_times(options, first.value());
  if (!times) return times.error();
  std::vector<double> heights = band_heights(options, first.value());

  double spacing = options.spacing;
  if (spacing == 0) {
    const auto pixel = first.value().file.pixel_size(frame);
    if (!pixel) return pixel.error();
    spacing = std::max(pixel.value() / 4, options.area / 250);
  }
  spacing = std::min(spacing, options.area);
  // An even number of cells puts a node on the origin.
  const double half = std::ceil(options.area / spacing - 1e-9);
  const Vec2 corner = half * spacing * Vec2(1, 1);
  if ((2 * half + 1) * (2 * half + 1) > kMaxNodes)
    return error(
        fmt::format("an area of {} m at a spacing of {:.3g} m has over {:.0f} points",
                    options.area, spacing, kMaxNodes),
        "use a smaller area or a larger spacing");
  const auto shape_rows = static_cast<int>(2 * half) + 1;
  const auto map =
      first.value().file.map(frame, GridShape{-corner, spacing, shape_rows, shape_rows});
  if (!map) return map.error();
  note_times(options, times.value(), warnings);

  std::vector<double> levels = sorted_unique(heights);
  if (options.height) {
    const double requested = options.ground_msl + *options.height;
    levels = {*std::min_element(levels.begin(), levels.end(), [&](double a, double b) {
      return std::abs(a - requested) < std::abs(b - requested);
    })};
  }
  std::vector<Time> moments;
  for (const double t : times.value()) moments.push_back(Time::from_seconds(t));
  const std::vector<Time> order = sorted_unique(moments);
  std::vector<GriddedWind::Slice> slices;
  for (const Time moment : order)
    for (const double level : levels) {
      std::vector<std::size_t> matches;
      for (std::size_t i = 0; i < moments.size(); ++i)
        if (moments[i] == moment && heights[i] == level) matches.push_back(i);
      if (matches.size() != 1)
        return error(
            fmt::format("has {} bands for the time {} s and the level {} m; there "
                        "must be one for each time and level",
                        matches.size(), moment.seconds(), level));
      auto slice = load_slice(options, first.value(), second.value(), matches[0],
                              map.value(), north.value());
      if (!slice) return slice.error();
      slices.push_back(std::move(slice).value());
    }
  return std::unique_ptr<WindField>(
      std::make_unique<GriddedWind>(order, std::move(levels), std::move(slices)));
}

}  // namespace skein::environment
