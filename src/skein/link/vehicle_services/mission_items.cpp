// SPDX-License-Identifier: Apache-2.0
#include "skein/link/vehicle_services/mission_items.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <optional>

#include "skein/link/vehicle_services/message_numbers.h"
#include "skein/link/vehicle_services/places.h"

namespace skein::vehicle_services {
namespace {

using mavlink::CommandId;
using mavlink::MissionResult;
using Kind = MissionItem::Kind;

ListVerdict refuse_item(MissionResult result, std::size_t number, const char* why) {
  return {result, fmt::format("Item {}: {}", number, why)};
}

// Reads one mission, item by item.
class MissionReader {
 public:
  MissionReader(const MissionContext& context, std::size_t count)
      : context_(context), count_(count), place_(context.home_N) {}

  ListVerdict read(const mavlink::MissionItemInt& given, MissionItem& item) {
    const std::size_t number = at_++ + context_.first;
    const auto refuse = [&](MissionResult result, const char* why) {
      return refuse_item(result, number, why);
    };
    item.p_N = place_;
    switch (static_cast<CommandId>(given.command)) {
      case CommandId::kReturn:
        item.kind = Kind::kReturn;
        return {};
      case CommandId::kChangeSpeed:
        return read_speed(given, item, refuse);
      case CommandId::kJump:
        return read_jump(given, item, refuse);
      case CommandId::kTakeOff:
        item.kind = Kind::kTakeOff;
        break;
      case CommandId::kLand:
        item.kind = Kind::kLand;
        break;
      case CommandId::kLoiter:
        item.kind = Kind::kHold;
        break;
      case CommandId::kLoiterTime:
        set_hold(item, static_cast<double>(given.param1));
        break;
      case CommandId::kLoiterTurns:
        if (context_.hovers)
          return refuse(MissionResult::kUnsupported, "circles are for fixed wings");
        set_hold(item, turns_last(given));
        break;
      case CommandId::kWaypoint:
        set_hold(item, context_.hovers ? static_cast<double>(given.param1) : 0);
        break;
      default:
        return {
            MissionResult::kUnsupported,
            fmt::format("Item {}: command {} is not supported", number, given.command)};
    }
    return read_place(given, item, refuse);
  }

 private:
  // A stay without end is not what a hold of no time means.
  static void set_hold(MissionItem& item, double seconds) {
    const bool holds = seconds > 0 && std::isfinite(seconds);
    item.kind = holds ? Kind::kHold : Kind::kWaypoint;
    if (holds) item.hold = seconds;
  }

  double turns_last(const mavlink::MissionItemInt& given) const {
    const double asked = std::abs(static_cast<double>(given.param3));
    const double radius = asked > 0 ? asked : context_.loiter_radius;
    const double around = 2 * geo::kPi * radius;
    return static_cast<double>(given.param1) * around / context_.limits.airspeed;
  }

  template <class Refuse>
  ListVerdict read_place(const mavlink::MissionItemInt& given, MissionItem& item,
                         const Refuse& refuse) {
    const double z = static_cast<double>(given.z);
    const auto altitude = altitude_msl(given.frame, z, -context_.home_N.z());
    if (!altitude)
      return refuse(MissionResult::kUnsupportedFrame, "its frame is not supported");
    if (!is_altitude(*altitude))
      return refuse(MissionResult::kInvalidZ, "its altitude is none");
    if (item.kind == Kind::kTakeOff && *altitude <= -context_.home_N.z())
      return refuse(MissionResult::kInvalidZ, "it is not above home");
    item.p_N.z() = -*altitude;
    const bool none = (given.x == 0 && given.y == 0) || given.x == kNoCoordinate ||
                      given.y == kNoCoordinate;
    if (!none) {
      const auto point = map_point(*context_.frame, coordinate(given.frame, given.x),
                                   coordinate(given.frame, given.y));
      if (!point) return refuse(MissionResult::kInvalidX, "its place is too far away");
      item.p_N.head<2>() = *point;
    }
    place_ = item.p_N;
    return {};
  }

  template <class Refuse>
  ListVerdict read_speed(const mavlink::MissionItemInt& given, MissionItem& item,
                         const Refuse& refuse) const {
    const FlightLimits& limits = context_.limits;
    item.kind = Kind::kSpeed;
    item.airspeed = static_cast<double>(given.param2);
    // Over ground, a multirotor's speed is that through the air but for the wind.
    if (given.param1 != 0 && !(given.param1 == 1 && context_.hovers))
      return refuse(MissionResult::kInvalidParam1, "only airspeeds are supported");
    if (!(item.airspeed > 0 && item.airspeed >= limits.slowest &&
          item.airspeed <= limits.fastest))
      return refuse(MissionResult::kInvalidParam2, "it does not fly at that speed");
    return {};
  }

  template <class Refuse>
  ListVerdict read_jump(const mavlink::MissionItemInt& given, MissionItem& item,
                        const Refuse& refuse) const {
    const double to = static_cast<double>(given.param1);
    const auto first = static_cast<double>(context_.first);
    if (!(to >= first && to < first + static_cast<double>(count_)))
      return refuse(MissionResult::kInvalidParam1, "it jumps to nowhere");
    item.kind = Kind::kJump;
    item.to = rounded<std::uint16_t>(to - first);
    item.repeats = given.param2 < 0
                       ? std::numeric_limits<std::uint16_t>::max()
                       : rounded<std::uint16_t>(static_cast<double>(given.param2));
    return {};
  }

  const MissionContext& context_;
  std::size_t count_;
  std::size_t at_ = 0;
  Vec3 place_;  // of the item before
};

}  // namespace

ListVerdict read_mission(const std::vector<mavlink::MissionItemInt>& list,
                         const MissionContext& context, std::vector<MissionItem>& items) {
  items.clear();
  MissionReader reader(context, list.size());
  for (const mavlink::MissionItemInt& given : list) {
    ListVerdict verdict = reader.read(given, items.emplace_back());
    if (!verdict.ok()) return verdict;
  }
  return {};
}

ListVerdict check_rally_points(const std::vector<mavlink::MissionItemInt>& list,
                               const geo::LocalFrame& frame) {
  for (std::size_t k = 0; k < list.size(); ++k) {
    const mavlink::MissionItemInt& item = list[k];
    if (static_cast<CommandId>(item.command) != CommandId::kRallyPoint)
      return refuse_item(MissionResult::kUnsupported, k, "it is no rally point");
    if (!altitude_msl(item.frame, static_cast<double>(item.z), 0))
      return refuse_item(MissionResult::kUnsupportedFrame, k,
                         "its frame is not supported");
    if (!map_point(frame, coordinate(item.frame, item.x), coordinate(item.frame, item.y)))
      return refuse_item(MissionResult::kInvalidX, k, "its place is too far away");
  }
  return {};
}

}  // namespace skein::vehicle_services
