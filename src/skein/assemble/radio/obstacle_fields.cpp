// SPDX-License-Identifier: Apache-2.0
// The keys of obstacles between radios.
#include "skein/assemble/radio/obstacle_fields.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>
#include <vector>

#include "skein/scenario/numbers.h"
#include "skein/scenario/text.h"

namespace skein::assemble {
namespace {

using scenario::Range;
using scenario::RuleViolation;

constexpr Range kAltitude{.at_least = -1000, .at_most = 100'000};
constexpr Range kExtent{.above = 0, .at_most = 1e6};
constexpr double kMaxAttenuation = 300;  // [dB]
constexpr const char* kOpaque = "opaque";

std::optional<double> attenuation_in(const std::string& text) {
  if (text == kOpaque) return math::kInfinity;
  const auto number = scenario::parse_number(text);
  if (!number || !(*number >= 0)) return std::nullopt;
  if (*number > kMaxAttenuation && !std::isinf(*number)) return std::nullopt;
  return number;
}

std::vector<RuleViolation> obstacle_errors(const ObstacleSection& section) {
  std::vector<RuleViolation> found;
  const bool box = section.centre && section.size && !section.radius;
  const bool cylinder = section.centre && section.radius && !section.size;
  if (section.ring ? section.centre || section.size || section.radius
                   : !box && !cylinder) {
    found.push_back({"ring_m",
                     "needs ring_m, or centre_m with size_m, or centre_m with radius_m, "
                     "and one of these only."});
    return found;
  }
  if (box && !(section.size->minCoeff() > 0))
    found.push_back({"size_m", "both must be above 0."});
  if (section.base_msl >= section.top_msl)
    found.push_back({"top_msl_m", "must be above base_msl_m."});
  if (!attenuation_in(section.attenuation_db))
    found.push_back(
        {"attenuation_db",
         fmt::format("found {}; needs \"opaque\", .inf or a number from 0 to {}.",
                     section.attenuation_db, kMaxAttenuation)});
  if (!found.empty()) return found;
  Zone shape;
  shape.area = obstacle_of(section).area;
  if (section.ring) shape.area = *section.ring;  // corners counted as they are written
  if (const auto error = error_in(shape))
    found.push_back({section.ring ? "ring_m" : "centre_m", *error});
  return found;
}

}  // namespace

scenario::Fields<ObstacleSection> obstacle_fields() {
  using T = ObstacleSection;
  return scenario::Fields<T>()
      .polygon("ring_m", &T::ring, "Its corners. Null: it is a box or a cylinder.")
      .point("centre_m", &T::centre, "Centre of a box or of a cylinder.")
      .vector("size_m", &T::size, "Sides of a box, along north and east.",
              {.at_least = 0, .at_most = 1e6})
      .number("radius_m", &T::radius, "Of a cylinder.", kExtent)
      .number("base_msl_m", &T::base_msl,
              "Where it begins, above mean sea level; above z = 0 in `skein net`.",
              kAltitude)
      .number("top_msl_m", &T::top_msl, "Where it ends; the same.", kAltitude)
      .required()
      .text("attenuation_db", &T::attenuation_db,
            "What it takes from a signal whose straight way goes through it; `opaque`: "
            "everything.")
      .rules(obstacle_errors);
}

communication::Obstacle obstacle_of(const ObstacleSection& section) {
  communication::Obstacle obstacle;
  if (section.ring) {
    obstacle.area = made_positive(*section.ring);
  } else if (section.radius) {
    obstacle.area = Disc{*section.centre, *section.radius};
  } else {
    const Vec2 low = *section.centre - *section.size / 2;
    const Vec2 high = *section.centre + *section.size / 2;
    obstacle.area = geo::Ring{low, {high.x(), low.y()}, high, {low.x(), high.y()}};
  }
  obstacle.base_msl = section.base_msl;
  obstacle.top_msl = section.top_msl;
  obstacle.attenuation_db = attenuation_in(section.attenuation_db).value();
  return obstacle;
}

ObstacleSection section_of(const communication::Obstacle& obstacle) {
  ObstacleSection section;
  if (const auto* disc = std::get_if<Disc>(&obstacle.area)) {
    section.centre = disc->centre;
    section.radius = disc->radius;
  } else {
    section.ring = std::get<geo::Ring>(obstacle.area);
  }
  section.base_msl = obstacle.base_msl;
  section.top_msl = obstacle.top_msl;
  section.attenuation_db = std::isinf(obstacle.attenuation_db)
                               ? kOpaque
                               : scenario::number_text(obstacle.attenuation_db);
  return section;
}

}  // namespace skein::assemble
