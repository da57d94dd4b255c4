// SPDX-License-Identifier: Apache-2.0
#include "skein/exchange/plan/map_view.h"

#include <algorithm>
#include <limits>

#include "skein/exchange/plan/samples.h"

namespace skein::exchange {
namespace {

constexpr double kMinExtent = 50;      // [m]
constexpr double kMargin = 0.07;       // of the extent, on each side
constexpr double kZonesWithin = 0.35;  // of the extent, around the flights
constexpr double kFlattest = 0.42;     // height over width

struct Box {
  Vec2 min = Vec2::Constant(std::numeric_limits<double>::infinity());
  Vec2 max = Vec2::Constant(-std::numeric_limits<double>::infinity());

  void add(const Vec2& p) {
    min = min.cwiseMin(p);
    max = max.cwiseMax(p);
  }
  bool empty() const { return !(min.x() <= max.x()); }
  double extent() const { return std::max((max - min).maxCoeff(), kMinExtent); }
};

Box box_of(const Zone& zone) {
  Box box;
  if (const auto* disc = std::get_if<Disc>(&zone.area)) {
    box.add(disc->centre + Vec2::Constant(disc->radius));
    box.add(disc->centre - Vec2::Constant(disc->radius));
  } else {
    for (const Vec2& p : std::get<geo::Ring>(zone.area)) box.add(p);
  }
  return box;
}

}  // namespace

MapView view_of(const Document& document, double width, double tallest) {
  Box box;
  for (const NamedPlan& plan : document.plans)
    for (const FlightElement& e : plan.plan)
      for (const FlightSample& each : samples(e, std::max(1.0, e.duration)))
        box.add(each.moment.p_N.head<2>());
  for (const Mark& mark : document.marks) box.add(mark.p_N.head<2>());
  for (const Shape& shape : document.shapes)
    for (const Vec2& p : shape.points) box.add(p);
  for (const MovingObstacle& m : document.movers) box.add(m.p_N.head<2>());
  const bool only_zones = box.empty();
  const Box flights = box;
  const double room = only_zones ? 0 : kZonesWithin * flights.extent();
  for (const Zone& zone : document.zones) {
    const Box own = box_of(zone);
    if (only_zones) {
      box.add(own.min);
      box.add(own.max);
      continue;
    }
    const Vec2 min = flights.min.array() - room, max = flights.max.array() + room;
    if ((own.min.array() > max.array()).any() || (own.max.array() < min.array()).any())
      continue;
    box.add(own.min.cwiseMax(min));
    box.add(own.max.cwiseMin(max));
  }
  if (box.empty()) box.add(Vec2::Zero());
  const double margin = kMargin * box.extent();
  const Vec2 size = (box.max - box.min).cwiseMax(kMinExtent).array() + 2 * margin;
  const Vec2 middle = (box.max + box.min) / 2;
  MapView view;
  view.width = width;
  view.height = std::clamp(width * size.x() / size.y(), kFlattest * width, tallest);
  view.metres_per_px = std::max(size.y() / width, size.x() / view.height);
  view.north_west = middle + Vec2(view.height / 2, -view.width / 2) * view.metres_per_px;
  return view;
}

}  // namespace skein::exchange
