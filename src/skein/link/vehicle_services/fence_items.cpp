// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "skein/link/vehicle_services/mission_items.h"
#include "skein/link/vehicle_services/places.h"

namespace skein::vehicle_services {
namespace {

using mavlink::CommandId;
using mavlink::MissionResult;

bool is_vertex(CommandId command) {
  return command == CommandId::kFenceInclusionVertex ||
         command == CommandId::kFenceExclusionVertex;
}
bool is_inclusion(CommandId command) {
  return command == CommandId::kFenceInclusionVertex ||
         command == CommandId::kFenceInclusionCircle;
}

// Reads one fence, area by area.
struct FenceReader {
  const std::vector<mavlink::MissionItemInt>& list;
  const geo::LocalFrame& frame;
  std::size_t at = 0;  // the next item

  CommandId command() const { return static_cast<CommandId>(list[at].command); }

  ListVerdict refuse(MissionResult result, const char* why) const {
    return {result, fmt::format("Fence item {}: {}", at, why)};
  }

  std::optional<Vec2> point() const {
    const mavlink::MissionItemInt& item = list[at];
    return map_point(frame, coordinate(item.frame, item.x),
                     coordinate(item.frame, item.y));
  }

  ListVerdict read_polygon(Zone& zone) {
    const CommandId kind = command();
    const auto corners = static_cast<double>(list[at].param1);
    if (!(corners >= 3 && corners <= static_cast<double>(list.size() - at)))
      return refuse(MissionResult::kInvalidParam1, "the polygon lacks corners");
    geo::Ring ring;
    for (auto left = static_cast<std::size_t>(corners); left > 0; --left, ++at) {
      if (command() != kind || static_cast<double>(list[at].param1) != corners)
        return refuse(MissionResult::kInvalidParam1, "it is no corner of the polygon");
      const auto corner = point();
      if (!corner) return refuse(MissionResult::kInvalidX, "it is too far away");
      ring.push_back(*corner);
    }
    zone.area = geo::Ring(made_positive(std::move(ring)));
    return checked(zone);
  }

  ListVerdict read_circle(Zone& zone) {
    const auto centre = point();
    if (!centre) return refuse(MissionResult::kInvalidX, "it is too far away");
    zone.area = Disc{*centre, static_cast<double>(list[at].param1)};
    ++at;
    return checked(zone);
  }

  ListVerdict checked(const Zone& zone) const {
    if (const auto error = error_in(zone))
      return {MissionResult::kInvalid, "Fence: " + *error};
    return {};
  }
};

}  // namespace

ListVerdict read_fence(const std::vector<mavlink::MissionItemInt>& list,
                       const geo::LocalFrame& frame, std::vector<Zone>& inclusion,
                       std::vector<Zone>& exclusion) {
  inclusion.clear();
  exclusion.clear();
  FenceReader reader{list, frame};
  while (reader.at < list.size()) {
    const CommandId command = reader.command();
    Zone zone;
    ListVerdict verdict;
    if (is_vertex(command)) {
      verdict = reader.read_polygon(zone);
    } else if (command == CommandId::kFenceInclusionCircle ||
               command == CommandId::kFenceExclusionCircle) {
      verdict = reader.read_circle(zone);
    } else if (command == CommandId::kFenceReturnPoint) {
      ++reader.at;
      continue;
    } else {
      return reader.refuse(MissionResult::kUnsupported, "it is no part of a fence");
    }
    if (!verdict.ok()) return verdict;
    (is_inclusion(command) ? inclusion : exclusion).push_back(std::move(zone));
  }
  return {};
}

}  // namespace skein::vehicle_services
