// SPDX-License-Identifier: Apache-2.0
#include "skein/link/autopilot_client/request_steps.h"

#include <cmath>
#include <limits>

namespace skein::autopilot_client {
namespace {

using mavlink::CommandInt;
using mavlink::CommandLong;
using mavlink::Make;
using mavlink::MissionItemInt;
using Steps = std::vector<RequestStep>;

constexpr std::uint8_t kFrameGlobal = 0;  // MAV_FRAME
constexpr std::uint8_t kFrameMission = 2;
constexpr std::uint8_t kFrameGlobalInt = 5;
constexpr float kForce = 21196;
constexpr float kNotANumber = std::numeric_limits<float>::quiet_NaN();
constexpr double kApproachLength = 500;  // of a fixed wing's landing [m]
constexpr double kApproachHeight = 45;   // where it begins [m]
constexpr std::size_t kMaxFenceItems = 10'000;

class StepMaker {
 public:
  StepMaker(const RequestTarget& target, const geo::LocalFrame& frame)
      : target_(target), frame_(frame) {}

  Steps operator()(const ModeRequest& request) const { return mode(request.mode); }

  Steps operator()(const ArmRequest& request) const {
    return {command(kArmDisarm, request.arm ? 1 : 0, request.force ? kForce : 0)};
  }

  Steps operator()(const TakeOffRequest& request) const {
    const auto height = static_cast<float>(request.altitude_msl - target_.home_msl);
    if (target_.make == Make::kArduPilot && !target_.hovers) {
      Steps steps = {SetParameter{"TKOFF_ALT", height, 9}};
      append(steps, mode(VehicleMode::kTakeOff));
      append(steps, (*this)(ArmRequest{}));
      return steps;
    }
    CommandLong climb = command(kNavTakeOff);
    climb.param4 =
        request.course ? static_cast<float>(geo::degrees(*request.course)) : kNotANumber;
    Steps steps;
    if (target_.make == Make::kArduPilot) {
      append(steps, mode(VehicleMode::kGuided));
      climb.param7 = height;
    } else {
      climb.param5 = climb.param6 = kNotANumber;
      climb.param7 = static_cast<float>(request.altitude_msl);
    }
    append(steps, (*this)(ArmRequest{}));
    steps.emplace_back(AwaitArmed{});
    steps.emplace_back(climb);
    return steps;
  }

  Steps operator()(const LandRequest& request) const {
    if (!request.point || target_.hovers) return mode(VehicleMode::kLand);
    if (target_.make == Make::kArduPilot) return landing_mission(request);
    CommandInt land;
    land.command = kNavLand;
    land.frame = kFrameGlobalInt;
    put_place(land, *request.point, request.ground_msl);
    land.param4 = kNotANumber;
    return {land};
  }

  Steps operator()(const FlyToRequest& request) const {
    CommandInt go;
    go.command = kDoReposition;
    go.frame = kFrameGlobalInt;
    go.param1 = request.airspeed ? static_cast<float>(*request.airspeed) : -1.0F;
    go.param2 = 1;  // changes to the guided mode
    go.param3 = static_cast<float>(request.radius);
    // Of ArduPilot's fixed wings the sense of the circle, of others the heading.
    go.param4 = target_.make == Make::kArduPilot && !target_.hovers
                    ? (request.clockwise ? 0.0F : 1.0F)
                    : kNotANumber;
    put_place(go, request.p_N.head<2>(), -request.p_N.z());
    return {go};
  }

  Steps operator()(const SpeedRequest& request) const {
    return {command(kDoChangeSpeed, target_.hovers ? 1.0F : 0.0F,
                    static_cast<float>(request.airspeed), -1)};
  }

  Steps operator()(const MissionUpload& upload) const {
    SendMission mission;
    if (target_.make == Make::kArduPilot) mission.items.push_back(home());
    for (const MissionItem& item : upload.items) mission.items.push_back(coded(item));
    return {mission};
  }

  Steps operator()(const MissionStart& start) const {
    const int first = target_.make == Make::kArduPilot ? 1 : 0;  // after home
    Steps steps = {command(kDoSetMissionCurrent, static_cast<float>(start.item + first))};
    append(steps, mode(VehicleMode::kMission));
    return steps;
  }

  Steps operator()(const FenceUpload& upload) const {
    SendMission fence;
    fence.type = mavlink::MissionType::kFence;
    for (const Zone& zone : upload.zones) add_zone(zone, fence.items);
    if (fence.items.size() > kMaxFenceItems) return {};
    return {fence};
  }

  Steps operator()(const BankSetpoint&) const { return {}; }
  Steps operator()(const TrackSetpoint&) const { return {}; }
  Steps operator()(const PilotRequest&) const { return {}; }
  Steps operator()(const ObstacleDistances&) const { return {}; }
  Steps operator()(const PositionFix&) const { return {}; }

 private:
  static void append(Steps& steps, const Steps& more) {
    steps.insert(steps.end(), more.begin(), more.end());
  }

  Steps mode(VehicleMode wanted) const {
    const auto number = mavlink::custom_mode_of(target_.make, target_.hovers, wanted);
    if (!number) return {};
    const AwaitMode taken{wanted,
                          mavlink::mode_name(target_.make, target_.hovers, *number)};
    if (target_.make == Make::kPx4)
      return {command(kDoSetMode, mavlink::kModeCustom,
                      static_cast<float>(*number >> 16 & 0xff),
                      static_cast<float>(*number >> 24)),
              taken};
    return {command(kDoSetMode, mavlink::kModeCustom, static_cast<float>(*number)),
            taken};
  }

  void put_place(CommandInt& to, const Vec2& p, double altitude_msl) const {
    const ScaledPlace place = scaled_place(p, frame_);
    to.x = place.latitude;
    to.y = place.longitude;
    to.z = static_cast<float>(altitude_msl);
  }

  MissionItemInt item(std::uint16_t what, const Vec2& p, double altitude_msl) const {
    const ScaledPlace place = scaled_place(p, frame_);
    MissionItemInt item;
    item.command = what;
    item.frame = kFrameGlobal;
    item.autocontinue = 1;
    item.x = place.latitude;
    item.y = place.longitude;
    item.z = static_cast<float>(altitude_msl);
    return item;
  }

  // Each corner of a polygon says how many there are.
  void add_zone(const Zone& zone, std::vector<MissionItemInt>& items) const {
    const auto add = [&](mavlink::CommandId what, const Vec2& place, double param1) {
      items.push_back(item(static_cast<std::uint16_t>(what), place, 0));
      items.back().param1 = static_cast<float>(param1);
    };
    if (const auto* disc = std::get_if<Disc>(&zone.area))
      return add(mavlink::CommandId::kFenceExclusionCircle, disc->centre, disc->radius);
    const auto& ring = std::get<geo::Ring>(zone.area);
    for (const Vec2& corner : ring)
      add(mavlink::CommandId::kFenceExclusionVertex, corner,
          static_cast<double>(ring.size()));
  }

  // Item 0 of ArduPilot's missions, which it replaces by its own home.
  MissionItemInt home() const {
    return item(kNavWaypoint, Vec2::Zero(), target_.home_msl);
  }

  MissionItemInt coded(const MissionItem& from) const {
    const auto placed = [&](std::uint16_t what) {
      return item(what, from.p_N.head<2>(), -from.p_N.z());
    };
    const auto placeless = [](std::uint16_t what, float param1, float param2) {
      MissionItemInt item;
      item.command = what;
      item.frame = kFrameMission;
      item.autocontinue = 1;
      item.param1 = param1;
      item.param2 = param2;
      return item;
    };
    switch (from.kind) {
      case MissionItem::Kind::kTakeOff:
        return placed(kNavTakeOff);
      case MissionItem::Kind::kWaypoint:
        return placed(kNavWaypoint);
      case MissionItem::Kind::kHold: {
        MissionItemInt hold =
            placed(from.hold > 0 ? kNavLoiterTime : kNavLoiterUnlimited);
        hold.param1 = static_cast<float>(from.hold);
        return hold;
      }
      case MissionItem::Kind::kSpeed:
        return placeless(kDoChangeSpeed, 0, static_cast<float>(from.airspeed));
      case MissionItem::Kind::kLand:
        return placed(kNavLand);
      case MissionItem::Kind::kReturn:
        return placeless(kNavReturn, 0, 0);
      case MissionItem::Kind::kJump: {
        const int first = target_.make == Make::kArduPilot ? 1 : 0;
        return placeless(kDoJump, static_cast<float>(from.to + first), from.repeats);
      }
    }
    return {};
  }

  Steps landing_mission(const LandRequest& request) const {
    const Vec2 way = geo::unit(request.course.value_or(0));
    const Vec2 entry = *request.point - kApproachLength * way;
    SendMission mission;
    mission.items = {home(),
                     item(kNavWaypoint, entry, request.ground_msl + kApproachHeight),
                     item(kNavLand, *request.point, request.ground_msl)};
    Steps steps = {mission, command(kDoSetMissionCurrent, 1)};
    append(steps, mode(VehicleMode::kMission));
    return steps;
  }

  const RequestTarget& target_;
  const geo::LocalFrame& frame_;
};

}  // namespace

mavlink::CommandLong command(std::uint16_t id, float param1, float param2, float param3) {
  CommandLong command;
  command.command = id;
  command.param1 = param1;
  command.param2 = param2;
  command.param3 = param3;
  return command;
}

ScaledPlace scaled_place(const Vec2& p, const geo::LocalFrame& frame) {
  const geo::Geodetic at = frame.from_plane(p);
  return {static_cast<std::int32_t>(std::lround(at.latitude_deg * 1e7)),
          static_cast<std::int32_t>(std::lround(at.longitude_deg * 1e7))};
}

std::vector<RequestStep> steps_of(const VehicleRequest& request,
                                  const RequestTarget& target,
                                  const geo::LocalFrame& frame) {
  return std::visit(StepMaker(target, frame), request);
}

}  // namespace skein::autopilot_client
