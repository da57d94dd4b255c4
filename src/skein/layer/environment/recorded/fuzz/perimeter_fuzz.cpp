// SPDX-License-Identifier: Apache-2.0
// Perimeters from intruders: any text as GeoJSON, and any geometry past the reader, must
// give a growing series of clean regions or an error, never a crash.

#include <cpl_vsi.h>

#include <cmath>
#include <cstdlib>

#include "skein/geo/clip.h"
#include "skein/layer/environment/recorded/perimeter_file.h"
#include "skein/layer/environment/recorded/perimeter_fire.h"
#include "skein/layer/environment/recorded/perimeter_repair.h"

namespace {

using namespace skein;
using namespace skein::environment;

void require(bool good) {
  if (!good) std::abort();
}

std::vector<RawPerimeter> from_text(const std::uint8_t* data, std::size_t size) {
  const char* name = "/vsimem/fuzz.geojson";
  // The library only reads from the buffer.
  VSILFILE* file =
      VSIFileFromMemBuffer(name, const_cast<std::uint8_t*>(data), size, FALSE);
  VSIFCloseL(file);
  std::vector<std::string> warnings;
  auto series = read_vector(name, {}, warnings);
  VSIUnlink(name);
  return series.ok() ? std::move(series.value().perimeters) : std::vector<RawPerimeter>();
}

// Points on a coarse lattice, so that coincidences of all kinds are frequent.
std::vector<RawPerimeter> from_bytes(const std::uint8_t* data, std::size_t size) {
  std::vector<RawPerimeter> series;
  std::vector<Vec2>* line = nullptr;
  for (std::size_t i = 0; i + 2 < size; i += 3) {
    const int what = data[i] & 15;
    if (series.empty() || what == 0)
      series.push_back({static_cast<double>(data[i] >> 4), "f", {}, {}});
    if (line == nullptr || what == 1 || series.back().polygons.empty()) {
      series.back().polygons.push_back({});
      line = &series.back().polygons.back().outer;
    } else if (what == 2) {
      line = &series.back().polygons.back().holes.emplace_back();
    } else if (what == 3) {
      line = &series.back().lines.emplace_back();
    }
    const double step = what == 4 ? 1e-7 : 1e-4;
    line->emplace_back(38.9 + step * data[i + 1], -121 + step * data[i + 2]);
  }
  return series;
}

void run(std::vector<RawPerimeter> raw, Outliers outliers) {
  const auto frame = geo::LocalFrame::at({38.9, -121, 0}).value();
  for (RawPerimeter& perimeter : raw) {
    auto local = projected(perimeter, frame);
    if (!local) return;
    perimeter = std::move(local).value();
  }
  RepairOptions options;
  options.outliers = outliers;
  std::vector<std::string> warnings;
  double first = 0;
  const auto series = growing_series(std::move(raw), options, "fuzz", first, warnings);
  if (!series) return;
  Vec2 low = Vec2::Constant(1e9), high = -low;
  double before = 0;
  for (const Perimeter& perimeter : series.value()) {
    const double area = geo::area(perimeter.region);
    require(std::isfinite(area) && area > 0);
    // Each rounding to 0.1 mm may take away as much along the boundary.
    require(area >= before - 1e-3 * geo::length(perimeter.region) - 1);
    before = area;
    for (const geo::Ring& ring : perimeter.region)
      for (const Vec2& p : ring) {
        require(p.allFinite());
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
      }
  }
  const double spacing = (high - low).maxCoeff() / 12 + 0.1;
  PerimeterFire fire(series.value(), grid_covering(low, high, spacing), 0);
  double burnt = 0;
  for (int i = 0; i <= 4; ++i) {
    fire.advance(Time::from_seconds(series.value().back().time * i / 4));
    const double area = geo::area(fire.region());
    // The nodes' growth is exact; the contour between them rounds at 1e-6 of a spacing.
    require(area >= burnt - 1e-5 * spacing * geo::length(fire.region()) - 1e-6);
    burnt = area;
  }
}

}  // namespace

// Input that starts with a brace is text, anything else geometry.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 2 || size > 20000) return 0;
  const auto outliers = (data[0] & 1) != 0 ? Outliers::kDrop : Outliers::kUnite;
  run(data[0] == '{' ? from_text(data, size) : from_bytes(data + 1, size - 1), outliers);
  return 0;
}
