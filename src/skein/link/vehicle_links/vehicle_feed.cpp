// SPDX-License-Identifier: Apache-2.0
#include "skein/link/vehicle_links/vehicle_feed.h"

#include <fmt/format.h>

#include <utility>

namespace skein::vehicle_links {
namespace {

constexpr double kKnowsItsPlace = 50;  // a larger deviation is no position [m]
constexpr const char* kSender = "ground station";

double throttle_of(const VehicleState& state, bool hovers) {
  if (!hovers) return state.actuators[channel::kThrottle];
  double sum = 0;
  int motors = 0;
  for (const double motor : state.actuators)
    if (motor != 0) {
      sum += motor;
      ++motors;
    }
  return motors > 0 ? sum / motors : 0;
}

}  // namespace

VehicleFeed::VehicleFeed(VehicleLinks& links, std::vector<ShownAircraft> aircraft,
                         const std::vector<std::string>& traffic)
    : links_(links), traffic_(links, traffic) {
  for (ShownAircraft& each : aircraft) {
    const ShownMode mode(each.commanded, each.ardupilot && each.hovers);
    shown_.push_back({std::move(each), {}, mode, {}, {}, false});
  }
}

// What each record says about an aircraft that is shown.
struct VehicleFeed::Listener {
  VehicleFeed& feed;

  void operator()(const EntityRecord& r) const {
    feed.traffic_.hear(r);
    for (std::size_t k = 0; k < feed.shown_.size(); ++k)
      if (feed.shown_[k].aircraft.name == r.name) feed.by_entity_[r.id] = k;
  }
  void operator()(const EstimateRecord& r) const {
    feed.traffic_.hear(r);
    Shown* shown = feed.find(r.id);
    if (!shown) return;
    shown->known = true;
    shown->mode.hear(r.nav.time, r.status, -r.nav.p_N.z());
    VehicleMotion& motion = shown->snapshot.motion;
    motion.time = r.nav.time;
    motion.p_N = r.nav.p_N;
    motion.v_N = r.nav.v_N;
    motion.q_NB = geo::from_euler({r.nav.roll, r.nav.pitch, r.nav.heading});
    motion.wind_N = r.nav.wind_N;
    motion.position_sd = r.nav.position_sd;
    motion.altitude_sd = r.nav.altitude_sd;
    motion.airspeed = (geo::horizontal(r.nav.v_N) - r.nav.wind_N).norm();
    VehicleCondition& condition = shown->snapshot.condition;
    condition.on_ground = r.status.on_ground;
    condition.charge = r.status.charge;
    condition.emergency = r.status.reaction == FailsafeReaction::kDescend;
    condition.position = r.nav.position_sd < kKnowsItsPlace;
    if (!shown->home_N) shown->home_N = r.nav.p_N;
    if (r.status.on_ground) shown->snapshot.ground_msl = -r.nav.p_N.z();
    std::string& reason = shown->snapshot.not_ready;
    reason.clear();
    if (!condition.position) reason = "no position";
    if (r.status.trigger != FailsafeTrigger::kNone)
      reason = fmt::format("failsafe {}", name_of(r.status.trigger));
    condition.ready = reason.empty();
  }
  void operator()(const TruthRecord& r) const {
    Shown* shown = feed.find(r.id);
    if (!shown) return;
    // Rates, voltage and current, which real vehicles measure well.
    shown->snapshot.motion.w_NB_B = r.state.w_NB_B;
    shown->snapshot.throttle = throttle_of(r.state, shown->aircraft.hovers);
    VehicleCondition& condition = shown->snapshot.condition;
    condition.voltage = r.state.energy.voltage;
    condition.current =
        r.state.energy.voltage > 0 ? r.state.energy.power / r.state.energy.voltage : 0;
  }
  void operator()(const MissionProgressRecord& r) const {
    if (Shown* shown = feed.find(r.id)) {
      shown->snapshot.progress = r.value;
      shown->mode.hear(r.value);
    }
  }
  void operator()(const CommandRecord& r) const {
    if (const auto* pause = std::get_if<PauseCommand>(&r.command)) {
      feed.paused_ = pause->paused;
      feed.links_.set_paused(pause->paused);
    }
  }
  template <class Other>
  void operator()(const Other&) const {}
};

VehicleFeed::Shown* VehicleFeed::find(EntityId id) {
  const auto found = by_entity_.find(id);
  return found == by_entity_.end() ? nullptr : &shown_[found->second];
}

void VehicleFeed::record(const Record& record) {
  std::visit(Listener{*this}, record);
}

Result<void> VehicleFeed::step_done(Time time) {
  now_ = time;
  for (Shown& shown : shown_) {
    if (!shown.known) continue;
    shown.snapshot.condition.mode = shown.mode.mode();
    shown.snapshot.condition.armed = shown.mode.armed();
    shown.snapshot.home_N = *shown.home_N;
    shown.snapshot.paused = paused_;
    links_.update(shown.aircraft.server, shown.snapshot);
  }
  links_.set_simulated(time);
  traffic_.publish(time);
  return {};
}

// What an aircraft with tasks of its own makes of a request; nothing for what its agent
// decides by itself.
std::optional<Command> VehicleFeed::task_for(const Shown& shown,
                                             const VehicleRequest& request) const {
  const std::string& name = shown.aircraft.name;
  if (const auto* go = std::get_if<FlyToRequest>(&request))
    return TaskCommand{name, FlyTo{geo::horizontal(go->p_N)}};
  if (const auto* down = std::get_if<LandRequest>(&request)) {
    const Vec2 here = geo::horizontal(shown.snapshot.motion.p_N);
    return TaskCommand{name, LandAt{false, down->point.value_or(here)}};
  }
  const auto* start = std::get_if<MissionStart>(&request);
  const auto* mode = std::get_if<ModeRequest>(&request);
  if (start || (mode && mode->mode == VehicleMode::kMission)) {
    FlyRoute route;
    for (const MissionItem& item : shown.mission)
      if (item.kind == MissionItem::Kind::kWaypoint)
        route.points.push_back(geo::horizontal(item.p_N));
    if (!route.points.empty()) return TaskCommand{name, route};
    return MissionCommand{MissionAction::kResume, {}};
  }
  if (!mode) return std::nullopt;
  switch (mode->mode) {
    case VehicleMode::kHold:
      return TaskCommand{name, Hold{}};
    case VehicleMode::kReturn:
      return TaskCommand{name, ReturnHome{}};
    case VehicleMode::kLand:
      return TaskCommand{name, LandAt{}};
    default:
      return std::nullopt;
  }
}

void VehicleFeed::hear(Shown& shown, const VehicleRequest& request,
                       std::vector<CommandRecord>& out) {
  shown.mode.hear(request);
  if (const auto* upload = std::get_if<MissionUpload>(&request))
    shown.mission = upload->items;
  const bool sticks = std::holds_alternative<PilotRequest>(request);
  if (shown.aircraft.commanded || sticks) {
    out.push_back({now_, kSender, VehicleCommand{shown.aircraft.name, request}});
  } else if (auto task = task_for(shown, request)) {
    out.push_back({now_, kSender, std::move(*task)});
  }
}

std::string VehicleFeed::aircraft_of(std::size_t server) const {
  for (const Shown& shown : shown_)
    if (shown.aircraft.server == server) return shown.aircraft.name;
  return {};
}

std::vector<CommandRecord> VehicleFeed::commands() {
  std::vector<CommandRecord> all;
  for (Shown& shown : shown_)
    for (const VehicleRequest& request : links_.take_requests(shown.aircraft.server))
      hear(shown, request, all);
  for (RefusedOrder& order : links_.take_refused())
    all.push_back({now_, kSender,
                   RefusedCommand{order.shown ? aircraft_of(*order.shown) : order.vehicle,
                                  std::move(order.text)}});
  return all;
}

}  // namespace skein::vehicle_links
