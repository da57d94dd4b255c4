// SPDX-License-Identifier: Apache-2.0
#include "skein/geo/antimeridian.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace skein::geo {
namespace {

constexpr double kOnIt = 1e-9;     // of longitude, 0.1 mm at the equator [deg]
constexpr double kMinPart = 1e-4;  // of an area [m^2]

// A point of the plane, on the Earth, and how far east of 180 degrees; west is negative,
// the other half of the Earth that way [deg].
struct Place {
  Vec2 p = Vec2::Zero();
  Geodetic at;
  double east = 0;

  bool is_east() const { return east >= 0; }
};

Place place_of(const Vec2& p, const LocalFrame& frame) {
  Place place{p, frame.from_plane(p), 0};
  const double longitude = place.at.longitude_deg;
  place.east = longitude > 0 ? longitude - 180 : longitude + 180;
  if (std::abs(place.east) < kOnIt) place.east = 0;
  return place;
}

std::vector<Place> places_of(std::span<const Vec2> points, const LocalFrame& frame) {
  std::vector<Place> places;
  for (const Vec2& p : points) places.push_back(place_of(p, frame));
  return places;
}

// Whether the way from one to the other crosses 0 degrees instead of 180.
bool crosses_zero(const Place& a, const Place& b) {
  return std::abs(a.east - b.east) >= 180;
}

bool crosses(const Place& a, const Place& b) {
  return a.is_east() != b.is_east() && !crosses_zero(a, b);
}

// Where the straight line from a to b crosses, as a share of it.
double crossing(const Place& a, const Place& b, const LocalFrame& frame) {
  if (a.east == 0) return 0;
  if (b.east == 0) return 1;
  double from = 0, to = 1;
  constexpr int kHalvings = 50;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = (from + to) / 2;
    const Place place = place_of(a.p + middle * (b.p - a.p), frame);
    if (place.east == 0) return middle;
    (place.is_east() == a.is_east() ? from : to) = middle;
  }
  return (from + to) / 2;
}

// The point of the straight line at a share of it.
Vec2 between(const Place& a, const Place& b, double share) {
  return share < 1 ? Vec2(a.p + share * (b.p - a.p)) : b.p;
}

// A given point; on 180 degrees it belongs to the east.
Geodetic given(const Place& place) {
  Geodetic at = place.at;
  if (place.east == 0) at.longitude_deg = -180;
  return at;
}

// On 180 degrees, as the side says it.
Geodetic on_it(const Vec2& p, bool east, const LocalFrame& frame) {
  Geodetic at = frame.from_plane(p);
  at.longitude_deg = east ? -180 : 180;
  return at;
}

// --- areas --------------------------------------------------------------------------

struct Corner {
  Vec2 p;
  Geodetic at;
};
using Corners = std::vector<Corner>;

// What of a ring lies on one side, from where it comes over to where it leaves.
using Chain = Corners;

void append(Corners& to, const Corner& corner) {
  if (to.empty() || to.back().p != corner.p) to.push_back(corner);
}

double area_of(const Corners& ring) {
  Ring points;
  for (const Corner& each : ring) points.push_back(each.p);
  return signed_area(points);
}

// Keeps a ring made of chains, if it is one.
void keep(Corners ring, std::vector<Corners>& rings) {
  while (ring.size() > 1 && ring.front().p == ring.back().p) ring.pop_back();
  if (ring.size() > 2 && std::abs(area_of(ring)) > kMinPart)
    rings.push_back(std::move(ring));
}

// What lies on one side of 180 degrees.
struct Side {
  std::vector<Chain> chains;
  std::vector<Corners> rings;

  // Joins the ends of chains along 180 degrees: from the south, every second gap between
  // ends is inside. False where ends do not match, as of rings that touch there.
  bool close() {
    struct End {
      double latitude;
      std::size_t chain;
      bool begins;
    };
    std::vector<End> ends;
    for (std::size_t k = 0; k < chains.size(); ++k) {
      ends.push_back({chains[k].front().at.latitude_deg, k, true});
      ends.push_back({chains[k].back().at.latitude_deg, k, false});
    }
    std::stable_sort(ends.begin(), ends.end(),
                     [](const End& a, const End& b) { return a.latitude < b.latitude; });
    std::vector<std::size_t> next(chains.size());
    for (std::size_t k = 0; k + 1 < ends.size(); k += 2) {
      if (ends[k].begins == ends[k + 1].begins) return false;
      const End& last = ends[k].begins ? ends[k + 1] : ends[k];
      next[last.chain] = (ends[k].begins ? ends[k] : ends[k + 1]).chain;
    }
    std::vector<bool> used(chains.size(), false);
    for (std::size_t first = 0; first < chains.size(); ++first) {
      Corners ring;
      for (std::size_t k = first; !used[k]; k = next[k]) {
        used[k] = true;
        for (const Corner& each : chains[k]) append(ring, each);
      }
      if (!ring.empty()) keep(std::move(ring), rings);
    }
    return true;
  }
};

// Divides a ring. False where it cannot be divided: it surrounds a pole.
bool divide(const Ring& ring, const LocalFrame& frame, Side (&sides)[2]) {
  const std::vector<Place> places = places_of(ring, frame);
  const std::size_t count = places.size();
  std::optional<std::size_t> first;  // edge that crosses
  for (std::size_t k = 0; k < count; ++k) {
    const Place &a = places[k], &b = places[(k + 1) % count];
    if (crosses_zero(a, b)) return false;
    if (!first && crosses(a, b)) first = k;
  }
  const auto corner = [](const Place& place) { return Corner{place.p, given(place)}; };
  if (!first) {
    Corners whole;
    for (const Place& each : places) append(whole, corner(each));
    sides[places[0].is_east()].rings.push_back(std::move(whole));
    return true;
  }
  Chain chain;
  for (std::size_t i = 0; i <= count; ++i) {
    const Place &a = places[(*first + i) % count], &b = places[(*first + i + 1) % count];
    if (i > 0) append(chain, corner(a));
    if (!crosses(a, b)) continue;
    const Vec2 p = between(a, b, crossing(a, b, frame));
    if (i > 0) {
      append(chain, {p, on_it(p, a.is_east(), frame)});
      sides[a.is_east()].chains.push_back(std::move(chain));
    }
    chain = {{p, on_it(p, b.is_east(), frame)}};
  }
  return true;
}

// Outer rings with the holes that lie in them.
std::vector<PlacePolygon> polygons_of(const std::vector<Corners>& rings) {
  struct Outer {
    Ring points;
    double area;
  };
  std::vector<Outer> outer;
  std::vector<PlacePolygon> polygons;
  const auto places = [](const Corners& ring) {
    std::vector<Geodetic> made;
    for (const Corner& each : ring) made.push_back(each.at);
    return made;
  };
  for (const Corners& ring : rings) {
    const double area = area_of(ring);
    if (area < 0) continue;
    outer.push_back({{}, area});
    for (const Corner& each : ring) outer.back().points.push_back(each.p);
    polygons.push_back({places(ring)});
  }
  for (const Corners& ring : rings) {
    if (area_of(ring) >= 0) continue;
    std::optional<std::size_t> smallest;
    for (std::size_t k = 0; k < outer.size(); ++k)
      if (contains(outer[k].points, ring.front().p) &&
          (!smallest || outer[k].area < outer[*smallest].area))
        smallest = k;
    if (smallest) polygons[*smallest].push_back(places(ring));
  }
  return polygons;
}

std::vector<Corners> uncut(const Region& region, const LocalFrame& frame) {
  std::vector<Corners> rings;
  for (const Ring& ring : region) {
    Corners whole;
    for (const Vec2& p : ring) append(whole, {p, frame.from_plane(p)});
    if (!whole.empty()) rings.push_back(std::move(whole));
  }
  return rings;
}

}  // namespace

std::vector<std::vector<CutPoint>> cut_line(std::span<const Vec2> points,
                                            const LocalFrame& frame) {
  const std::vector<Place> places = places_of(points, frame);
  std::vector<std::vector<CutPoint>> parts(1);
  for (std::size_t k = 0; k < places.size(); ++k) {
    const Place& to = places[k];
    if (k > 0 && crosses(places[k - 1], to)) {
      const Place& from = places[k - 1];
      const double share = crossing(from, to, frame);
      const std::size_t before = share < 1 ? k - 1 : k;
      const Vec2 p = between(from, to, share);
      const auto end = [&](bool east) {
        return CutPoint{on_it(p, east, frame), before, share < 1 ? share : 0};
      };
      // A point on it belongs to the east already.
      if (share > 0) parts.back().push_back(end(from.is_east()));
      if (parts.back().size() > 1) parts.emplace_back();
      parts.back().clear();
      if (share < 1) parts.back().push_back(end(to.is_east()));
    }
    parts.back().push_back({given(to), k, 0});
  }
  if (parts.size() > 1 && parts.back().size() < 2) parts.pop_back();
  return parts;
}

std::vector<PlacePolygon> cut_region(const Region& region, const LocalFrame& frame) {
  Side sides[2];
  bool good = true;
  for (const Ring& ring : region)
    if (!ring.empty()) good = good && divide(ring, frame, sides);
  for (Side& side : sides) good = good && side.close();
  if (!good) return polygons_of(uncut(region, frame));
  std::vector<PlacePolygon> all;
  for (const Side& side : sides)
    for (PlacePolygon& each : polygons_of(side.rings)) all.push_back(std::move(each));
  return all;
}

}  // namespace skein::geo
