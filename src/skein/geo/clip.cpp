// SPDX-License-Identifier: Apache-2.0
#include "skein/geo/clip.h"

#include <polyclipping/clipper.hpp>

#include "skein/base/check.h"

namespace skein::geo {
namespace {

using ClipperLib::Path;
using ClipperLib::Paths;

constexpr double kScale = 1e4;  // units per metre

Paths to_paths(const Region& region) {
  Paths paths;
  paths.reserve(region.size());
  for (const Ring& ring : region) {
    Path path;
    path.reserve(ring.size());
    for (const Vec2& p : ring) {
      SKEIN_CHECK(p.allFinite() && p.cwiseAbs().maxCoeff() < 4e7, p.x(), p.y());
      path.emplace_back(std::llround(p.x() * kScale), std::llround(p.y() * kScale));
    }
    paths.push_back(std::move(path));
  }
  return paths;
}

Region to_region(const Paths& paths) {
  Region region;
  region.reserve(paths.size());
  for (const Path& path : paths) {
    Ring ring;
    ring.reserve(path.size());
    for (const auto& p : path)
      ring.emplace_back(static_cast<double>(p.X) / kScale,
                        static_cast<double>(p.Y) / kScale);
    region.push_back(std::move(ring));
  }
  return region;
}

ClipperLib::PolyFillType fill_type(FillRule rule) {
  return rule == FillRule::kEvenOdd    ? ClipperLib::pftEvenOdd
         : rule == FillRule::kPositive ? ClipperLib::pftPositive
                                       : ClipperLib::pftNonZero;
}

Region execute(ClipperLib::ClipType type, const Region& a, const Region& b,
               ClipperLib::PolyFillType fill,
               int options = ClipperLib::ioStrictlySimple) {
  ClipperLib::Clipper clipper(options);
  clipper.AddPaths(to_paths(a), ClipperLib::ptSubject, true);
  clipper.AddPaths(to_paths(b), ClipperLib::ptClip, true);
  Paths solution;
  clipper.Execute(type, solution, fill, fill);
  return to_region(solution);
}

}  // namespace

Region clean(const Region& rings, FillRule rule) {
  return execute(ClipperLib::ctUnion, rings, {}, fill_type(rule));
}

Region clean_touching(const Region& rings, FillRule rule) {
  return execute(ClipperLib::ctUnion, rings, {}, fill_type(rule), 0);
}

Region unite(const Region& a, const Region& b) {
  return execute(ClipperLib::ctUnion, a, b, ClipperLib::pftNonZero);
}

Region intersect(const Region& a, const Region& b) {
  return execute(ClipperLib::ctIntersection, a, b, ClipperLib::pftNonZero);
}

Region subtract(const Region& a, const Region& b) {
  return execute(ClipperLib::ctDifference, a, b, ClipperLib::pftNonZero);
}

Region grown(const Region& rings, double distance, double tolerance) {
  // The chords of an arc lie inside of it, by which the distance grows. The library
  // rounds their number: by up to 2.3 times what it is asked for, at one and a half
  // chords.
  constexpr double kRounding = 2.5;
  ClipperLib::ClipperOffset offset(2, tolerance / kRounding * kScale);
  offset.AddPaths(to_paths(clean(rings, FillRule::kNonZero)), ClipperLib::jtRound,
                  ClipperLib::etClosedPolygon);
  Paths solution;
  offset.Execute(solution, (distance + tolerance) * kScale);
  return to_region(solution);
}

double shared_area(const Region& a, const Region& b, FillRule rule) {
  // Rings that touch themselves do not change an area: the costly splitting is left out.
  return area(execute(ClipperLib::ctIntersection, a, b, fill_type(rule), 0));
}

double iou(const Region& a, const Region& b) {
  const double both = shared_area(a, b, FillRule::kNonZero);
  const double either =
      area(execute(ClipperLib::ctUnion, a, b, ClipperLib::pftNonZero, 0));
  return either > 0 ? both / either : 1.0;
}

}  // namespace skein::geo
