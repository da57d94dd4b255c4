// SPDX-License-Identifier: Apache-2.0
#include "skein/link/vehicle_services/stored_lists.h"

#include <utility>

#include "skein/link/vehicle_services/message_numbers.h"
#include "skein/link/vehicle_services/places.h"

namespace skein::vehicle_services {
namespace {

using mavlink::MissionResult;
using mavlink::MissionType;

constexpr std::size_t kMaxMission = 2000, kMaxFence = 500, kMaxRally = 100;

bool home_is_item(const ServedVehicle& vehicle) {
  return vehicle.options.make == Make::kArduPilot;
}

}  // namespace

StoredLists::StoredLists(ServedVehicle& vehicle)
    : vehicle_(vehicle),
      mission_({MissionType::kMission, kMaxMission, home_is_item(vehicle)},
               [this](const auto& list) { return take_mission(list); }),
      fence_({MissionType::kFence, kMaxFence, false},
             [this](const auto& list) { return take_fence(list); }),
      rally_({MissionType::kRally, kMaxRally, false},
             [this](const auto& list) { return take_rally(list); }) {
  vehicle.mission.first = home_is_item(vehicle) ? 1 : 0;
}

MissionResult StoredLists::report(const ListVerdict& verdict) {
  if (!verdict.reason.empty()) vehicle_.say(mavlink::Severity::kError, verdict.reason);
  return verdict.result;
}

MissionResult StoredLists::take_mission(
    const std::vector<mavlink::MissionItemInt>& list) {
  if (!vehicle_.known)
    return report({MissionResult::kDenied, "Mission: the simulation has not begun"});
  MissionContext context;
  context.frame = &vehicle_.frame;
  context.home_N = vehicle_.snapshot.home_N;
  context.limits = vehicle_.options.limits;
  context.hovers = vehicle_.options.hovers;
  context.loiter_radius = vehicle_.settings.loiter_radius;
  context.first = vehicle_.mission.first;
  std::vector<MissionItem> items;
  const ListVerdict verdict = read_mission(list, context, items);
  if (!verdict.ok()) return report(verdict);
  if (!vehicle_.request(MissionUpload{items}))
    return report({MissionResult::kDenied, "Mission: the simulation is busy"});
  vehicle_.mission.items = std::move(items);
  vehicle_.mission.selected.reset();
  vehicle_.mission.started = false;
  vehicle_.mission.expected.expect(0, vehicle_.now.wall);
  return MissionResult::kAccepted;
}

MissionResult StoredLists::take_fence(const std::vector<mavlink::MissionItemInt>& list) {
  std::vector<Zone> inclusion, exclusion;
  const ListVerdict verdict = read_fence(list, vehicle_.frame, inclusion, exclusion);
  if (!verdict.ok()) return report(verdict);
  vehicle_.fence.inclusion = std::move(inclusion);
  vehicle_.fence.exclusion = std::move(exclusion);
  ++vehicle_.fence.version;
  return MissionResult::kAccepted;
}

MissionResult StoredLists::take_rally(const std::vector<mavlink::MissionItemInt>& list) {
  return report(check_rally_points(list, vehicle_.frame));
}

void StoredLists::handle(const mavlink::MissionCount& count, const Peer& from,
                         Outbox& out) {
  for (MissionService* list : {&mission_, &fence_, &rally_})
    list->handle(count, from, vehicle_.now.wall, out);
}

void StoredLists::handle(const mavlink::MissionItemInt& item, const Peer& from,
                         Outbox& out) {
  for (MissionService* list : {&mission_, &fence_, &rally_})
    list->handle(item, from, vehicle_.now.wall, out);
}

void StoredLists::handle(const mavlink::MissionItem& item, const Peer& from,
                         Outbox& out) {
  handle(with_integers(item), from, out);
}

void StoredLists::acknowledge(MissionResult result, std::uint8_t type, const Peer& to,
                              Outbox& out) const {
  mavlink::MissionAck ack;
  ack.target_system = to.system;
  ack.target_component = to.component;
  ack.type = static_cast<std::uint8_t>(result);
  ack.mission_type = type;
  out.send(to.channel, ack);
}

void StoredLists::handle(const mavlink::MissionClearAll& order, const Peer& from,
                         Outbox& out) {
  std::vector<MissionService*> lists;
  const auto type = static_cast<MissionType>(order.mission_type);
  const bool all = type == MissionType::kAll;
  if (all || type == MissionType::kMission) lists.push_back(&mission_);
  if (all || type == MissionType::kFence) lists.push_back(&fence_);
  if (all || type == MissionType::kRally) lists.push_back(&rally_);
  auto result = lists.empty() ? MissionResult::kUnsupported : MissionResult::kAccepted;
  // All or none.
  for (const MissionService* list : lists)
    if (list->busy_for(from)) result = MissionResult::kDenied;
  for (MissionService* list : lists)
    if (result == MissionResult::kAccepted) result = list->clear(from);
  acknowledge(result, order.mission_type, from, out);
}

void StoredLists::handle(const mavlink::MissionWritePartialList& request,
                         const Peer& from, Outbox& out) {
  acknowledge(MissionResult::kUnsupported, request.mission_type, from, out);
}

void StoredLists::step(Outbox& out) {
  for (MissionService* list : {&mission_, &fence_, &rally_})
    list->step(vehicle_.now.wall, out);
}

void StoredLists::close(Channel channel) {
  for (MissionService* list : {&mission_, &fence_, &rally_}) list->close(channel);
}

void StoredLists::update_home() {
  if (!home_is_item(vehicle_) || home_N_ == vehicle_.snapshot.home_N) return;
  home_N_ = vehicle_.snapshot.home_N;
  const geo::Geodetic place = vehicle_.frame.from_plane(geo::horizontal(*home_N_));
  mavlink::MissionItemInt home;
  home.frame = static_cast<std::uint8_t>(mavlink::CoordinateFrame::kGlobal);
  home.command = static_cast<std::uint16_t>(mavlink::CommandId::kWaypoint);
  home.autocontinue = 1;
  home.x = degrees_e7(place.latitude_deg);
  home.y = degrees_e7(place.longitude_deg);
  home.z = as_float(-home_N_->z());
  mission_.set_home(home);
}

}  // namespace skein::vehicle_services
