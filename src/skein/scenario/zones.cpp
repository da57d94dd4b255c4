// SPDX-License-Identifier: Apache-2.0
#include "skein/scenario/zones.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "skein/base/math.h"

namespace skein::scenario {
namespace {

double seconds_or(const std::optional<Time>& time, double otherwise) {
  return time ? time->seconds() : otherwise;
}

// "its ring ...", as a sentence about the key.
std::string sentence(const std::string& error) {
  return "cannot be used: " + error;
}

}  // namespace

Zone to_zone(const NoFlightZone& described) {
  Zone zone;
  if (described.ring)
    zone.area = made_positive(*described.ring);
  else if (described.centre && described.radius)
    zone.area = Disc{*described.centre, *described.radius};
  zone.floor_msl = described.floor_msl.value_or(-math::kInfinity);
  zone.ceiling_msl = described.ceiling_msl.value_or(math::kInfinity);
  zone.from = seconds_or(described.from, -math::kInfinity);
  zone.until = seconds_or(described.until, math::kInfinity);
  zone.name = described.name;
  return zone;
}

Zone ring_zone(const geo::Ring& ring, std::size_t index) {
  Zone zone{.area = made_positive(ring)};
  zone.name = fmt::format("zones_m[{}]", index);
  return zone;
}

std::vector<RuleViolation> zone_errors(const NoFlightZone& zone) {
  std::vector<RuleViolation> found;
  const auto add = [&](const char* key, std::string message) {
    found.push_back({key, std::move(message)});
  };
  if (zone.name.empty()) add("name", "must not be empty.");
  const bool disc = zone.centre && zone.radius;
  if (zone.ring ? zone.centre || zone.radius : !disc) {
    add("ring_m", "needs ring_m, or centre_m and radius_m, and not both.");
    return found;
  }
  if (zone.floor_msl && zone.ceiling_msl && *zone.floor_msl >= *zone.ceiling_msl)
    add("ceiling_msl_m", "must be above floor_msl_m.");
  if (zone.from && zone.until && *zone.from >= *zone.until)
    add("until_s", "must be after from_s.");
  Zone shape = to_zone(zone);
  if (zone.ring) shape.area = *zone.ring;  // corners are counted as they are written
  shape.floor_msl = shape.from = -math::kInfinity;
  shape.ceiling_msl = shape.until = math::kInfinity;
  if (const auto error = error_in(shape))
    add(zone.ring ? "ring_m" : "radius_m", sentence(*error));
  for (std::size_t k = 0; k < zone.switches.size(); ++k) {
    const bool before = k == 0 ? zone.active : zone.switches[k - 1].on;
    if (k > 0 && zone.switches[k].at <= zone.switches[k - 1].at)
      add("switches", "at_s must grow from one to the next.");
    else if (zone.switches[k].on == before)
      add("switches", fmt::format("number {} changes nothing: the zone is {} already.", k,
                                  before ? "in force" : "off"));
  }
  return found;
}

std::vector<RuleViolation> zone_list_errors(const Environment& environment,
                                            const ValidValues& valid) {
  std::vector<RuleViolation> found;
  std::map<std::string, std::size_t> names;
  for (std::size_t i = 0; i < environment.zone_rings.size(); ++i) {
    const std::string key = ring_zone({}, i).name;
    names[key] = i;
    if (!valid(key)) continue;
    if (const auto error = error_in(Zone{.area = environment.zone_rings[i]}))
      found.push_back({key, sentence(*error)});
  }
  for (std::size_t i = 0; i < environment.zones.size(); ++i) {
    const std::string key = fmt::format("zones[{}].name", i);
    if (valid(key) && !names.emplace(environment.zones[i].name, i).second)
      found.push_back({key, fmt::format("another zone is called \"{}\" already.",
                                        environment.zones[i].name)});
  }
  return found;
}

std::vector<std::string> zone_warnings(const Environment& environment) {
  std::vector<std::string> warnings;
  const auto look = [&](const std::string& name, const geo::Ring& ring) {
    if (geo::signed_area(ring) < 0)
      warnings.push_back(
          fmt::format("the no-fly zone {} runs counter-clockwise on the map; it means "
                      "the same area, not what lies around it.",
                      name));
  };
  for (std::size_t i = 0; i < environment.zone_rings.size(); ++i)
    look(ring_zone({}, i).name, environment.zone_rings[i]);
  for (const NoFlightZone& zone : environment.zones)
    if (zone.ring) look(zone.name, *zone.ring);
  return warnings;
}

}  // namespace skein::scenario
