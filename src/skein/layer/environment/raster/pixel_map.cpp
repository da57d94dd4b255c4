// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/environment/raster/pixel_map.h"

#include <fmt/format.h>
#include <ogr_srs_api.h>

#include <algorithm>
#include <cmath>

#include "skein/geo/gdal/gdal_guard.h"

namespace skein::environment {
namespace {

constexpr double kKnotSpacing = 250;  // [m]

// Coordinates of the knots: longitude and latitude first, then in the raster's system.
struct Coordinates {
  std::vector<double> x, y;
};

// Longitudes of some rasters run from 0 to 360: whole turns are added to fit.
void unwrap(std::vector<double>& longitudes, double raster_middle) {
  const double reference = longitudes[longitudes.size() / 2];
  const double turns = std::round((raster_middle - reference) / 360) * 360;
  for (double& longitude : longitudes)
    longitude += std::round((reference - longitude) / 360) * 360 + turns;
}

// True north at a place, a unit vector in the local frame.
Vec2 north_at(const geo::LocalFrame& frame, const geo::Geodetic& g) {
  // Towards the equator near a pole, so as not to step over it.
  const double sign = g.latitude_deg < 89 ? 1 : -1;
  const Vec2 along = frame.to_plane(g.latitude_deg + sign * 1e-3, g.longitude_deg) -
                     frame.to_plane(g.latitude_deg, g.longitude_deg);
  return sign * along.normalized();
}

// Grid north is where the raster's second coordinate grows: from the change of raster
// coordinates with the place (rows of J), solves J d = (0, 1).
Vec2 grid_north_of(const Vec2& by_north, const Vec2& by_east) {
  const double det = by_north.x() * by_east.y() - by_north.y() * by_east.x();
  const Vec2 direction(-by_east.x() / det, by_north.x() / det);
  return direction.allFinite() && direction.norm() > 0 ? Vec2(direction.normalized())
                                                       : Vec2(Vec2::UnitX());
}

// The pixels, within the raster, around all nodes on the edge of the grid.
PixelWindow window_around(const PixelMap& map, const Georeference& raster) {
  const GridShape& shape = map.shape();
  Vec2 low = map.pixel(0, 0), high = low;
  const auto widen = [&](int r, int c) {
    low = low.cwiseMin(map.pixel(r, c));
    high = high.cwiseMax(map.pixel(r, c));
  };
  for (int r = 0; r < shape.rows; ++r)
    for (const int c : {0, shape.columns - 1}) widen(r, c);
  for (int c = 0; c < shape.columns; ++c)
    for (const int r : {0, shape.rows - 1}) widen(r, c);
  const auto limit = [](double value, int size) {
    return static_cast<int>(std::clamp(value, 0.0, static_cast<double>(size)));
  };
  PixelWindow window;
  window.first_column = limit(std::floor(low.x()) - 1, raster.columns);
  window.first_row = limit(std::floor(low.y()) - 1, raster.rows);
  window.columns = limit(std::ceil(high.x()) + 1, raster.columns) - window.first_column;
  if (raster.around) {
    window.first_column = static_cast<int>(std::floor(low.x())) - 1;
    window.columns = static_cast<int>(std::ceil(high.x())) + 1 - window.first_column;
  }
  window.rows = limit(std::ceil(high.y()) + 1, raster.rows) - window.first_row;
  return window;
}

}  // namespace

Result<PixelMap> map_pixels(const Georeference& raster, const geo::LocalFrame& frame,
                            const GridShape& shape, const std::string& path) {
  const geo::GdalGuard guard;
  PixelMap map;
  map.shape_ = shape;
  map.raster_columns_ = raster.columns;
  map.raster_rows_ = raster.rows;
  map.step_ = std::max(1, static_cast<int>(kKnotSpacing / shape.spacing));
  const int knot_rows = (shape.rows - 2) / map.step_ + 2;
  const int knot_columns = map.knot_columns_ = (shape.columns - 2) / map.step_ + 2;

  Coordinates at;
  std::vector<Vec2> places;
  for (int r = 0; r < knot_rows; ++r)
    for (int c = 0; c < knot_columns; ++c) {
      places.push_back(shape.node(r * map.step_, c * map.step_));
      const geo::Geodetic g = frame.from_plane(places.back());
      at.x.push_back(g.longitude_deg);
      at.y.push_back(g.latitude_deg);
      map.knots_.push_back({Vec2::Zero(), Vec2::UnitX(), north_at(frame, g)});
    }
  std::vector<int> good(at.x.size(), 0);
  OCTTransformEx(static_cast<OGRCoordinateTransformationH>(raster.to_raster.get()),
                 static_cast<int>(at.x.size()), at.x.data(), at.y.data(), nullptr,
                 good.data());
  for (std::size_t i = 0; i < at.x.size(); ++i)
    if (good[i] == 0 || !std::isfinite(at.x[i]) || !std::isfinite(at.y[i]))
      return Error{
          ErrorCode::kBadInput, path,
          fmt::format("its coordinate system does not reach the area (north {:.0f} "
                      "m, east {:.0f} m): {}",
                      places[i].x(), places[i].y(), guard.failure()),
          ""};
  if (raster.geographic) unwrap(at.x, raster.geo[0] + raster.geo[1] * raster.columns / 2);

  const auto knot = [&](int r, int c) {
    return static_cast<std::size_t>(r) * static_cast<std::size_t>(knot_columns) +
           static_cast<std::size_t>(c);
  };
  const auto raster_point = [&](std::size_t k) { return Vec2(at.x[k], at.y[k]); };
  for (int r = 0; r < knot_rows; ++r)
    for (int c = 0; c < knot_columns; ++c) {
      PixelMap::Knot& k = map.knots_[knot(r, c)];
      const Vec2 own = raster_point(knot(r, c));
      k.pixel = affine(raster.inverse, own);
      const int r0 = std::min(r, knot_rows - 2), c0 = std::min(c, knot_columns - 2);
      const Vec2 corner = raster_point(knot(r0, c0));
      k.grid_north = grid_north_of(raster_point(knot(r0 + 1, c0)) - corner,
                                   raster_point(knot(r0, c0 + 1)) - corner);
    }
  if (raster.around) map.count_on();
  map.window_ = window_around(map, raster);
  return map;
}

// Columns of all knots from those of the first turn on, so that none is below 0; the area
// may reach into the second turn.
void PixelMap::count_on() {
  double low = knots_.front().pixel.x();
  for (const Knot& knot : knots_) low = std::min(low, knot.pixel.x());
  const double turns = std::floor(low / raster_columns_) * raster_columns_;
  for (Knot& knot : knots_) knot.pixel.x() -= turns;
  raster_columns_ *= 2;
}

PixelMap::Knot PixelMap::knot_mix(int row, int column) const {
  const int r = row / step_, c = column / step_;
  const int knot_rows = static_cast<int>(knots_.size()) / knot_columns_;
  const int r0 = std::min(r, knot_rows - 2), c0 = std::min(c, knot_columns_ - 2);
  const double north = static_cast<double>(row) / step_ - r0;
  const double east = static_cast<double>(column) / step_ - c0;
  const auto corner =
      static_cast<std::size_t>(r0) * static_cast<std::size_t>(knot_columns_) +
      static_cast<std::size_t>(c0);
  const Knot& sw = knots_[corner];
  const Knot& se = knots_[corner + 1];
  const Knot& nw = knots_[corner + static_cast<std::size_t>(knot_columns_)];
  const Knot& ne = knots_[corner + static_cast<std::size_t>(knot_columns_) + 1];
  const auto mix = [&](Vec2 Knot::*part) -> Vec2 {
    return (1 - north) * ((1 - east) * sw.*part + east * (se.*part)) +
           north * ((1 - east) * nw.*part + east * (ne.*part));
  };
  return {mix(&Knot::pixel), mix(&Knot::grid_north), mix(&Knot::true_north)};
}

Vec2 PixelMap::pixel(int row, int column) const {
  return knot_mix(row, column).pixel;
}
double PixelMap::grid_north(int row, int column) const {
  return geo::bearing(knot_mix(row, column).grid_north);
}
double PixelMap::true_north(int row, int column) const {
  return geo::bearing(knot_mix(row, column).true_north);
}

}  // namespace skein::environment
