// SPDX-License-Identifier: Apache-2.0
#include "skein/assemble/world/traffic.h"

#include <fmt/format.h>

#include <any>
#include <cmath>
#include <map>

#include "skein/base/alike_lines.h"
#include "skein/base/random.h"
#include "skein/role/traffic_aircraft.h"

namespace skein::assemble {
namespace {

using scenario::TrafficGroup;

constexpr std::uint32_t kFirstAddress = 0x800000;  // above those that take part
constexpr std::uint32_t kPlaceStream = 1;          // beside that of its flight

Vec3 begin_of(const TrafficGroup& group, std::uint64_t seed, std::uint32_t id) {
  Vec2 place = group.position;
  if (group.spread > 0) {
    RandomStream random(seed, id, Purpose::kTraffic, kPlaceStream);
    const double away = group.spread * std::sqrt(random.uniform());
    place += away * geo::unit(random.uniform(-geo::kPi, geo::kPi));
  }
  return {place.x(), place.y(), -group.altitude_msl};
}

std::optional<EntityId> find_aircraft(std::span<const simulation::Entity> entities,
                                      const std::string& name) {
  for (std::size_t k = 0; k < entities.size(); ++k)
    if (entities[k].vehicle && (name.empty() || entities[k].name == name))
      return EntityId{static_cast<std::uint32_t>(k)};
  return std::nullopt;
}

}  // namespace

Result<std::vector<simulation::WorldTraffic>> make_traffic(
    const scenario::Scenario& scenario, const KindsByRole& kinds,
    const geo::LocalFrame& frame, std::span<const simulation::Entity> entities,
    std::vector<std::string>& warnings) {
  std::vector<simulation::WorldTraffic> all;
  const std::size_t said = warnings.size();
  std::map<std::string, int> named;  // how many have a group's name
  for (std::size_t g = 0; g < scenario.traffic.size(); ++g) {
    const TrafficGroup& group = scenario.traffic[g];
    if (group.address && group.count > 1)
      return Error{ErrorCode::kBadInput, fmt::format("traffic[{}].address", g),
                   fmt::format("is of one aircraft, and the group has {}.", group.count),
                   "Leave it out, or give each a group of its own."};
    std::any shared;
    for (int i = 0; i < group.count; ++i) {
      const auto id = static_cast<std::uint32_t>(all.size());
      const int number = ++named[group.name];
      AirTraffic what{
          id,
          group.count == 1 && number == 1 ? group.name
                                          : fmt::format("{}-{}", group.name, number),
          group.flight.kind, group.address.value_or((kFirstAddress + id) & 0xFFFFFF),
          transmitters(group.transmits)};
      const TrafficContext context{
          scenario.seed,
          frame,
          scenario.start_utc,
          what.name,
          id,
          static_cast<std::size_t>(i),
          static_cast<std::size_t>(group.count),
          begin_of(group, scenario.seed, id),
          [&](const std::string& name) { return find_aircraft(entities, name); },
          &warnings,
          &shared,
          scenario.duration.seconds()};
      auto made = kinds.traffic.make(group.flight, context);
      if (!made) {
        Error error = made.error();
        error.place = fmt::format("traffic[{}].flight{}{}", g,
                                  error.place.empty() ? "" : ".", error.place);
        return error;
      }
      simulation::WorldTraffic& next =
          all.emplace_back(std::move(what), std::move(made).value());
      next.from = group.join;
      next.until = group.leave.value_or(scenario.duration + Time::from_ns(1));
    }
  }
  join_alike_lines(warnings, said);
  return all;
}

}  // namespace skein::assemble
