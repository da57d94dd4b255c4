// SPDX-License-Identifier: Apache-2.0
#include "skein/link/vehicle_services/served_vehicle.h"

#include <utility>

namespace skein::vehicle_services {
namespace {

constexpr std::size_t kMaxTexts = 32;    // waiting to be sent
constexpr std::size_t kMaxReached = 32;  // the same of items

bool is_flown_to(const MissionItem& item) {
  return item.kind != MissionItem::Kind::kSpeed && item.kind != MissionItem::Kind::kJump;
}

}  // namespace

ServedVehicle::ServedVehicle(const VehicleServerOptions& given,
                             const geo::LocalFrame& local)
    : options(given), frame(local) {}

void ServedVehicle::update(const VehicleSnapshot& next) {
  const Before before{snapshot.condition.mode, snapshot.progress,
                      mission.expected.pending()};
  const bool first = !known, was_paused = snapshot.paused;
  // Of a mode that it has left, how it was asked for no longer counts.
  if (asked_ && before.mode == asked_->mode && next.condition.mode != asked_->mode)
    asked_ = nullptr;
  snapshot = next;
  known = true;
  armed_expected.see(snapshot.condition.armed, now.wall, was_paused);
  mode_expected.see(snapshot.condition.mode, now.wall, was_paused);
  mission.expected.see(snapshot.progress.current, now.wall, was_paused);
  if (mode() != VehicleMode::kGuided) forget_guided();
  if (take_off_when_armed) follow_take_off();
  if (first) {
    origin_N = snapshot.home_N;
    return;
  }
  follow_mission(before);
  if (was_paused != snapshot.paused)
    say(mavlink::Severity::kNotice,
        snapshot.paused ? "Simulation paused" : "Simulation goes on");
}

void ServedVehicle::follow_take_off() {
  if (snapshot.condition.armed) {
    if (request_mode(*take_off_when_armed,
                     row_of(VehicleMode::kTakeOff, options.make, options.hovers)))
      take_off_when_armed.reset();
  } else if (mode() != VehicleMode::kTakeOff && now.wall >= take_off_waits_until) {
    take_off_when_armed.reset();
  }
}

void ServedVehicle::follow_mission(const Before& before) {
  if (snapshot.condition.mode == VehicleMode::kMission && snapshot.condition.armed) {
    mission.started = true;
    if (!mission.expected.pending()) mission.selected.reset();
  }
  if (before.mode != VehicleMode::kMission || before.jumped) return;
  if (before.progress.current >= mission.items.size()) return;
  const bool moved_on = snapshot.progress.current != before.progress.current;
  const bool ended = snapshot.progress.finished && !before.progress.finished;
  if ((moved_on || ended) && is_flown_to(mission.items[before.progress.current]) &&
      reached.size() < kMaxReached)
    reached.push_back(before.progress.current);
}

const ModeRow& ServedVehicle::shown_mode() const {
  if (asked_ && asked_->mode == snapshot.condition.mode) return *asked_;
  return row_of(snapshot.condition.mode, options.make, options.hovers);
}

std::uint16_t ServedVehicle::present_item() const {
  if (mission.selected && snapshot.condition.mode != VehicleMode::kMission)
    return *mission.selected;
  return mission.expected.value_or(snapshot.progress.current);
}

bool ServedVehicle::request_mode(VehicleRequest what, const ModeRow& row) {
  if (!request(std::move(what))) return false;
  asked_ = &row;
  mode_expected.expect(row.mode, now.wall);
  return true;
}

void ServedVehicle::forget_guided() {
  guided.place.reset();
  guided.altitude_msl.reset();
  guided.climb_rate = 0;
  guided.heading.reset();
  guided.last_bank.reset();
}

void ServedVehicle::say(mavlink::Severity severity, std::string text) {
  if (texts.size() < kMaxTexts)
    texts.push_back({static_cast<std::uint8_t>(severity), std::move(text)});
}

}  // namespace skein::vehicle_services
