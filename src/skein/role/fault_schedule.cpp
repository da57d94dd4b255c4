// SPDX-License-Identifier: Apache-2.0
#include "skein/role/fault_schedule.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace skein {

void FaultSchedule::apply(const VehicleFault& fault) {
  const auto bit = std::uint64_t{1} << fault.part;
  switch (fault.kind) {
    case VehicleFault::Kind::kMotor:
    case VehicleFault::Kind::kServoLoose:
      in_force_.plant.dead |= static_cast<std::uint8_t>(bit);
      return;
    case VehicleFault::Kind::kServoStuck:
      in_force_.plant.stuck |= static_cast<std::uint8_t>(bit);
      return;
    case VehicleFault::Kind::kSensor:
      in_force_.sensors |= bit;
      return;
    case VehicleFault::Kind::kPayload:
      in_force_.payload |= bit;
      return;
    case VehicleFault::Kind::kBattery:
      in_force_.plant.battery = true;
      return;
    case VehicleFault::Kind::kLink:
      in_force_.link = true;
      return;
  }
}

bool FaultSchedule::update(Time now, std::vector<VehicleEvent>& events) {
  active_.resize(faults_.size(), false);
  bool changed = false;
  for (std::size_t k = 0; k < faults_.size(); ++k) {
    const bool active = faults_[k].active(now);
    if (active == active_[k]) continue;
    changed = true;
    active_[k] = active;
    events.push_back({active ? EventKind::kFailure : EventKind::kRepaired,
                      active ? text_of(faults_[k]) : text_of_end(faults_[k])});
  }
  if (!changed) return false;
  // Anew, because faults of one part may overlap.
  in_force_ = {};
  for (std::size_t k = 0; k < faults_.size(); ++k)
    if (active_[k]) apply(faults_[k]);
  return true;
}

Result<void> FaultSchedule::set(const std::string& vehicle, const std::string& part,
                                bool fails, Time now) {
  const auto named = [&](const VehicleFault& fault) { return fault.name == part; };
  const auto found = std::find_if(breakable_.begin(), breakable_.end(), named);
  if (found == breakable_.end()) {
    std::string all;
    for (const VehicleFault& one : breakable_)
      all += (all.empty() ? "" : ", ") + one.name;
    return Error{ErrorCode::kBadInput, "",
                 fmt::format("{} has no part \"{}\"; it has: {}.", vehicle, part, all),
                 ""};
  }
  for (VehicleFault& fault : faults_)
    if (named(fault) && fault.active(now)) fault.until = now;
  if (!fails) return {};
  VehicleFault fault = *found;
  fault.at = now;
  fault.until = Time::from_ns(std::numeric_limits<std::int64_t>::max());
  faults_.push_back(std::move(fault));
  return {};
}

}  // namespace skein
