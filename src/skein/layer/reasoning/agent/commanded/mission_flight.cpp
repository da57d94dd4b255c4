// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/agent/commanded/mission_flight.h"

#include <algorithm>
#include <utility>

namespace skein::reasoning {
namespace {

using Kind = MissionItem::Kind;

constexpr double kAltitudeReached = 8;  // [m]
constexpr double kNearHovering = 2;     // [m]
constexpr double kNearFlying = 1.3;     // turn radii

}  // namespace

void MissionFlight::load(std::vector<MissionItem> items) {
  items_ = std::move(items);
  jumped_.assign(items_.size(), 0);
  current_ = 0;
  flies_ = finished_ = false;
}

void MissionFlight::start(std::uint16_t item) {
  if (item >= items_.size()) return;
  std::fill(jumped_.begin(), jumped_.end(), std::uint16_t{0});
  current_ = item;
  flies_ = true;
  finished_ = begun_ = in_route_ = false;
  there_.reset();
}

bool MissionFlight::near(const Vec3& place, const NavEstimate& nav) const {
  const double distance = (geo::horizontal(place) - geo::horizontal(nav.p_N)).norm();
  return distance <
         (limits_.slowest > 0 ? kNearFlying * limits_.turn_radius : kNearHovering);
}

AutopilotCommand MissionFlight::command_for(const AgentInput& in) const {
  const MissionItem& item = items_[current_];
  AutopilotCommand command;
  command.altitude_msl = -item.p_N.z();
  command.airspeed = airspeed_;
  switch (item.kind) {
    case Kind::kTakeOff:
      command.guidance = TakeOff{in.nav->heading};
      break;
    case Kind::kWaypoint: {
      FlyWaypoints route;
      for (std::size_t k = current_; waypoint(k); ++k)
        route.points.push_back({geo::horizontal(items_[k].p_N), -items_[k].p_N.z()});
      command.guidance = std::move(route);
      break;
    }
    case Kind::kHold:
      command.guidance = HoldPosition{geo::horizontal(item.p_N)};
      break;
    case Kind::kLand:
      command.guidance = Land{geo::horizontal(item.p_N), -item.p_N.z()};
      break;
    case Kind::kReturn:
      command.guidance = Return{};
      command.altitude_msl = -in.nav->p_N.z();
      break;
    case Kind::kSpeed:
    case Kind::kJump:
      break;
  }
  return command;
}

bool MissionFlight::is_done(const AgentInput& in) {
  const MissionItem& item = items_[current_];
  switch (item.kind) {
    case Kind::kTakeOff:
      return !in.autopilot.on_ground &&
             -in.nav->p_N.z() >= -item.p_N.z() - kAltitudeReached;
    case Kind::kWaypoint:
      return near(item.p_N, *in.nav) || (in.autopilot.done && !waypoint(current_ + 1u));
    case Kind::kHold:
      if (!there_ && (near(item.p_N, *in.nav) || in.autopilot.done)) there_ = in.now;
      return there_ && item.hold > 0 && (in.now - *there_).seconds() >= item.hold;
    case Kind::kLand:
      return in.autopilot.on_ground;
    case Kind::kReturn:
      return in.autopilot.done;
    case Kind::kSpeed:
    case Kind::kJump:
      return true;
  }
  return true;
}

void MissionFlight::advance(const AgentInput& in) {
  const MissionItem& item = items_[current_];
  const bool route = item.kind == Kind::kWaypoint;
  std::size_t next = current_ + std::size_t{1};
  if (item.kind == Kind::kSpeed) airspeed_ = item.airspeed;
  if (item.kind == Kind::kJump && item.to < items_.size() &&
      jumped_[current_] < item.repeats) {
    ++jumped_[current_];
    next = item.to;
  }
  there_.reset();
  begun_ = false;
  if (next >= items_.size()) {
    finished_ = true;
    flies_ = false;
    return;
  }
  // The next waypoint of a route is flown to already.
  in_route_ =
      route && next == current_ + std::size_t{1} && waypoint(next) && !in.autopilot.done;
  current_ = static_cast<std::uint16_t>(next);
}

std::optional<AutopilotCommand> MissionFlight::step(const AgentInput& in) {
  // Items that take no time are passed at once, but not for ever.
  for (std::size_t k = 0; flies_ && k <= items_.size(); ++k) {
    const Kind kind = items_[current_].kind;
    if (!begun_) {
      begun_ = true;
      if (kind != Kind::kSpeed && kind != Kind::kJump && !std::exchange(in_route_, false))
        return command_for(in);
    }
    if (!is_done(in)) return std::nullopt;
    advance(in);
  }
  return std::nullopt;
}

}  // namespace skein::reasoning
