// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/environment/recorded/recorded_fire.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>

#include "skein/base/alike_lines.h"
#include "skein/geo/gdal/vector_files.h"
#include "skein/geo/unit_words.h"
#include "skein/layer/environment/raster/raster_file.h"
#include "skein/layer/environment/recorded/arrival_fire.h"
#include "skein/layer/environment/recorded/perimeter_fire.h"

namespace skein::environment {
namespace {

constexpr double kLastArrival = 1e9;  // some 30 years [s]
constexpr double kWantedNodes = 200e3;
constexpr double kFinest = 5;       // spacing chosen by default [m]
constexpr double kMaxNodes = 20e6;  // times perimeters: 160 MB

Error error(const RecordedFireOptions& options, const std::string& message,
            const std::string& hint = "") {
  return {ErrorCode::kBadInput, options.path, message, hint};
}

struct Box {
  Vec2 low = Vec2::Constant(std::numeric_limits<double>::infinity());
  Vec2 high = -low;
  void add(const Vec2& p) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
};

Box box_of(const geo::Region& region) {
  Box box;
  for (const geo::Ring& ring : region)
    for (const Vec2& p : ring) box.add(p);
  return box;
}

Vec2 centroid(const geo::Region& region) {
  const Vec2 base = region.front().front();
  Vec2 moment = Vec2::Zero();
  double twice = 0;
  for (const geo::Ring& ring : region)
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vec2 a = ring[i] - base, b = ring[(i + 1) % ring.size()] - base;
      twice += geo::cross(a, b);
      moment += geo::cross(a, b) * (a + b) / 3;
    }
  return base + moment / twice;
}

Result<GridShape> grid_for(const RecordedFireOptions& options, const Box& box,
                           std::size_t layers) {
  const Vec2 size = box.high - box.low;
  double spacing = options.spacing;
  if (spacing == 0)
    spacing = std::max(kFinest, std::sqrt((size.x() * size.y() + 1) / kWantedNodes));
  const Vec2 margin = 4 * spacing * Vec2(1, 1);
  const Vec2 cells = (size + 2 * margin) / spacing;
  const double numbers = cells.x() * cells.y() * static_cast<double>(layers);
  if (numbers > kMaxNodes)
    return error(
        options,
        fmt::format("a spacing of {} m over {:.0f} m by {:.0f} m with {} perimeters "
                    "takes {:.0f} numbers; {:.0f} are allowed",
                    spacing, size.x(), size.y(), layers, numbers, kMaxNodes),
        "use a larger spacing");
  return grid_covering(box.low - margin, box.high + margin, spacing);
}

Result<void> check_options(const RecordedFireOptions& options) {
  if (!(options.spacing >= 0 && std::isfinite(options.spacing)))
    return error(options,
                 fmt::format("spacing {} m must not be below 0", options.spacing));
  if (!(options.start >= 0 && options.start <= 1e9))
    return error(options, fmt::format("start {} s: 0 to 1e9 is allowed", options.start));
  if (options.arrival_unit &&
      !(*options.arrival_unit > 0 && *options.arrival_unit <= 1e6))
    return error(options,
                 fmt::format("arrival_unit {} s: above 0 and up to 1e6 is allowed",
                             *options.arrival_unit));
  if (!(options.repair.outlier_share > 0 && options.repair.outlier_share <= 1))
    return error(options, fmt::format("outlier_share {}: above 0 and up to 1 is allowed",
                                      options.repair.outlier_share));
  if (!(options.repair.min_part >= 0))
    return error(options, fmt::format("min_part {} m2 must not be below 0",
                                      options.repair.min_part));
  return {};
}

bool is_arrival(const RecordedFireOptions& options) {
  if (options.kind != RecordedKind::kAuto) return options.kind == RecordedKind::kArrival;
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(options.path, ignored)) return false;
  return geo::small_ending(options.path) != ".csv" && RasterFile::open(options.path).ok();
}

struct Series {
  std::vector<Perimeter> perimeters;
  std::optional<double> first_utc;
};

Result<Series> load_series(const RecordedFireOptions& options, RawSeries raw,
                           const geo::LocalFrame& frame,
                           std::vector<std::string>& warnings) {
  for (RawPerimeter& perimeter : raw.perimeters) {
    auto local = projected(perimeter, frame);
    if (!local) return local.error();
    perimeter = std::move(local).value();
  }
  double first_time = 0;
  auto series = growing_series(std::move(raw.perimeters), options.repair, options.path,
                               first_time, warnings);
  if (!series) return series.error();
  const double last = series.value().back().time;
  if (options.start > last)
    return error(
        options,
        fmt::format("start {} s lies after the last perimeter, {} s after the first",
                    options.start, last));
  Series result{std::move(series).value(), std::nullopt};
  if (raw.utc) result.first_utc = first_time;
  return result;
}

// An arrival-time raster with the corner pixels of what burns in it.
struct Arrival {
  RasterFile file;
  PixelWindow pixels;  // all of the band, in seconds; NaN: never
  int first_row, last_row, first_column, last_column;
  Vec2 earliest;  // pixel coordinate
  double last_time;
};

// Seconds in one unit of the raster's times.
Result<double> unit_of_times(const RecordedFireOptions& options, const std::string& unit,
                             std::vector<std::string>& warnings) {
  if (options.arrival_unit) return *options.arrival_unit;
  if (const auto seconds = geo::time_unit(unit)) return *seconds;
  if (!unit.empty())
    return error(
        options, fmt::format("has arrival times in \"{}\"", unit),
        "seconds, minutes, hours and days are allowed; arrival_unit_s says them");
  warnings.push_back(options.path +
                     ": assumed: its times are seconds (else give arrival_unit_s)");
  return 1.0;
}

// Two features of one time are parts of one perimeter; said once for all of them.
void note_same_times(const std::string& path, const RawSeries& raw,
                     std::vector<std::string>& warnings) {
  std::map<double, std::size_t> count;
  for (const RawPerimeter& each : raw.perimeters) ++count[each.time];
  constexpr std::size_t kShown = 3;
  std::string shown;
  std::size_t times = 0;
  for (const auto& [time, features] : count) {
    if (features < 2 || ++times > kShown) continue;
    shown += fmt::format("{}{} at {}", times > 1 ? ", " : "", features,
                         raw.utc ? utc_text(time) : fmt::format("{} s", time));
  }
  if (times == 0) return;
  if (times > kShown) shown += fmt::format(" and so on, {} times in all", times);
  warnings.push_back(fmt::format("{}: features of one time are united: {}", path, shown));
}

// Whether a series holds anything is known only once it is read.
Result<RawSeries> read_series(const RecordedFireOptions& options,
                              std::vector<std::string>& warnings) {
  auto raw = read_perimeters(options.path, options.file, warnings);
  if (raw) note_same_times(options.path, raw.value(), warnings);
  return raw;
}

Result<Arrival> load_arrival(const RecordedFireOptions& options,
                             std::vector<std::string>& warnings) {
  auto file = RasterFile::open(options.path);
  if (!file) return file.error();
  const auto band = file.value().find_band(options.arrival_band, "");
  if (!band) return band.error();
  PixelWindow all;
  all.columns = file.value().columns();
  all.rows = file.value().rows();
  const BandInfo& info = file.value().bands()[static_cast<std::size_t>(band.value()) - 1];
  const auto unit = unit_of_times(options, info.unit, warnings);
  if (!unit) return unit.error();
  auto pixels = file.value().read(band.value(), all);
  if (!pixels) return pixels.error();
  Arrival arrival{std::move(file).value(),
                  std::move(pixels).value(),
                  all.rows,
                  -1,
                  all.columns,
                  -1,
                  Vec2::Zero(),
                  0};
  double earliest = std::numeric_limits<double>::infinity();
  std::size_t negative = 0, endless = 0, i = 0;
  for (int r = 0; r < all.rows; ++r)
    for (int c = 0; c < all.columns; ++c, ++i) {
      double& t = arrival.pixels.values[i];
      if (std::isnan(t)) continue;
      if (t < 0) {
        // Programs that do not declare "no data" write -1 or -9999 for "never".
        ++negative;
        t = std::nan("");
        continue;
      }
      t *= unit.value();
      if (t > kLastArrival) {
        // Others write 1e20 or the largest number there is.
        ++endless;
        t = std::nan("");
        continue;
      }
      arrival.first_row = std::min(arrival.first_row, r);
      arrival.last_row = std::max(arrival.last_row, r);
      arrival.first_column = std::min(arrival.first_column, c);
      arrival.last_column = std::max(arrival.last_column, c);
      arrival.last_time = std::max(arrival.last_time, t);
      if (t < earliest) {
        earliest = t;
        arrival.earliest = Vec2(c + 0.5, r + 0.5);
      }
    }
  if (arrival.last_row < 0) return error(options, "holds no arrival time at all");
  if (negative > 0)
    warnings.push_back(
        fmt::format("{}: {} pixels with a time below 0 count as never burnt",
                    options.path, negative));
  if (endless > 0)
    warnings.push_back(
        fmt::format("{}: {} pixels with a time above {:g} s count as never burnt",
                    options.path, endless, kLastArrival));
  if (options.start > arrival.last_time)
    return error(options, fmt::format("start {} s lies after the last arrival, {} s",
                                      options.start, arrival.last_time));
  return arrival;
}

Result<GridField> arrival_field(const RecordedFireOptions& options,
                                const Arrival& arrival, const geo::LocalFrame& frame) {
  Box box;
  // Along the border of the burning part: its corners alone would cut off a bulge.
  const int steps = 16;
  for (int i = 0; i <= steps; ++i)
    for (const double side : {0.0, 1.0}) {
      const double part = static_cast<double>(i) / steps;
      for (const Vec2& at : {Vec2(part, side), Vec2(side, part)}) {
        const auto g = arrival.file.geodetic(Vec2(
            arrival.first_column +
                at.x() * (arrival.last_column + 1 - arrival.first_column),
            arrival.first_row + at.y() * (arrival.last_row + 1 - arrival.first_row)));
        if (!g) return g.error();
        if (frame.to_local(g.value()).norm() > 500e3)
          return error(options,
                       "lies more than the 500 km allowed from the scenario's origin",
                       "is the origin right?");
        box.add(frame.to_plane(g.value().latitude_deg, g.value().longitude_deg));
      }
    }
  const auto shape = grid_for(options, box, 1);
  if (!shape) return shape.error();
  const auto map = arrival.file.map(frame, shape.value());
  if (!map) return map.error();
  // The window of the map, cut out of what was read.
  PixelWindow window = map.value().window();
  for (int r = 0; r < window.rows; ++r)
    for (int c = 0; c < window.columns; ++c)
      window.values.push_back(
          arrival.pixels.values[static_cast<std::size_t>(window.first_row + r) *
                                    static_cast<std::size_t>(arrival.pixels.columns) +
                                static_cast<std::size_t>(around(
                                    window.first_column + c, arrival.pixels.columns))]);
  return resample(window, map.value(), Missing::kKeep, options.path);
}

}  // namespace

Result<std::unique_ptr<Phenomenon>> make_recorded_fire(
    const RecordedFireOptions& options, const geo::LocalFrame& frame,
    std::vector<std::string>& warnings) {
  if (const auto good = check_options(options); !good) return good.error();
  const std::size_t before = warnings.size();
  if (is_arrival(options)) {
    const auto arrival = load_arrival(options, warnings);
    if (!arrival) return arrival.error();
    auto field = arrival_field(options, arrival.value(), frame);
    if (!field) return field.error();
    return std::unique_ptr<Phenomenon>(
        std::make_unique<ArrivalFire>(std::move(field).value(), options.start));
  }
  auto raw = read_series(options, warnings);
  if (!raw) return raw.error();
  const auto series = load_series(options, std::move(raw).value(), frame, warnings);
  if (!series) return series.error();
  join_alike_lines(warnings, before);
  const auto& perimeters = series.value().perimeters;
  const auto shape =
      grid_for(options, box_of(perimeters.back().region), perimeters.size());
  if (!shape) return shape.error();
  return std::unique_ptr<Phenomenon>(
      std::make_unique<PerimeterFire>(perimeters, shape.value(), options.start));
}

Result<RecordedFireSummary> summarise_recorded_fire(const RecordedFireOptions& options,
                                                    std::vector<std::string>& warnings) {
  if (const auto good = check_options(options); !good) return good.error();
  RecordedFireSummary summary;
  const std::size_t before = warnings.size();
  if (is_arrival(options)) {
    const auto arrival = load_arrival(options, warnings);
    if (!arrival) return arrival.error();
    const auto origin = arrival.value().file.geodetic(arrival.value().earliest);
    if (!origin) return origin.error();
    summary.origin = origin.value();
    const auto frame = geo::LocalFrame::at(summary.origin);
    if (!frame) return frame.error();
    const auto field = arrival_field(options, arrival.value(), frame.value());
    if (!field) return field.error();
    summary.duration = arrival.value().last_time - options.start;
    ArrivalFire fire(field.value(), options.start);
    summary.first_area = geo::area(fire.region());
    fire.advance(Time::from_seconds(summary.duration + 1));
    summary.last_area = geo::area(fire.region());
    const Box box = box_of(fire.region());
    summary.low = box.low;
    summary.high = box.high;
    return summary;
  }
  auto raw = read_series(options, warnings);
  if (!raw) return raw.error();
  // Any point of the fire serves as a first origin.
  const Vec2* any = nullptr;
  for (const RawPerimeter& perimeter : raw.value().perimeters) {
    for (const RawPolygon& polygon : perimeter.polygons)
      if (!polygon.outer.empty()) any = &polygon.outer.front();
    for (const auto& line : perimeter.lines)
      if (!line.empty()) any = &line.front();
    if (any != nullptr) break;
  }
  if (any == nullptr) return error(options, "has no perimeter that encloses anything");
  const auto first_frame = geo::LocalFrame::at({any->x(), any->y(), 0});
  if (!first_frame) return first_frame.error();
  const auto series =
      load_series(options, std::move(raw).value(), first_frame.value(), warnings);
  if (!series) return series.error();
  join_alike_lines(warnings, before);
  const auto& perimeters = series.value().perimeters;
  summary.origin = first_frame.value().from_plane(centroid(perimeters.front().region));
  summary.origin.height_m = 0;
  const auto frame = geo::LocalFrame::at(summary.origin);
  if (!frame) return frame.error();
  summary.series = perimeters;
  for (Perimeter& perimeter : summary.series)
    for (geo::Ring& ring : perimeter.region)
      for (Vec2& p : ring) {
        const geo::Geodetic g = first_frame.value().from_plane(p);
        p = frame.value().to_plane(g.latitude_deg, g.longitude_deg);
      }
  const Box box = box_of(summary.series.back().region);
  summary.low = box.low;
  summary.high = box.high;
  summary.duration = perimeters.back().time - options.start;
  if (series.value().first_utc)
    summary.start_utc = *series.value().first_utc + options.start;
  summary.perimeters = static_cast<int>(perimeters.size());
  summary.first_area = geo::area(perimeters.front().region);
  summary.last_area = geo::area(perimeters.back().region);
  return summary;
}

}  // namespace skein::environment
