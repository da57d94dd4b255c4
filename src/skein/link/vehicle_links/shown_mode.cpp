// SPDX-License-Identifier: Apache-2.0
#include "skein/link/vehicle_links/shown_mode.h"

namespace skein::vehicle_links {
namespace {

const Time kDisarmsAfter = Time::from_seconds(10);  // on the ground, after a flight
constexpr double kArrival = 5;  // below the altitude of a take-off, counted as there [m]

struct Asked {
  VehicleMode operator()(const ModeRequest& r) const { return r.mode; }
  VehicleMode operator()(const TakeOffRequest&) const { return VehicleMode::kTakeOff; }
  VehicleMode operator()(const LandRequest&) const { return VehicleMode::kLand; }
  VehicleMode operator()(const FlyToRequest&) const { return VehicleMode::kGuided; }
  VehicleMode operator()(const BankSetpoint&) const { return VehicleMode::kGuided; }
  VehicleMode operator()(const TrackSetpoint&) const { return VehicleMode::kGuided; }
  VehicleMode operator()(const MissionStart&) const { return VehicleMode::kMission; }
  template <class Other>
  std::optional<VehicleMode> operator()(const Other&) const {
    return std::nullopt;
  }
};

}  // namespace

void ShownMode::hear(const VehicleRequest& request) {
  if (const auto* arm = std::get_if<ArmRequest>(&request)) {
    armed_ = arm->arm;
    flew_ = false;
    return;
  }
  if (const auto* up = std::get_if<TakeOffRequest>(&request))
    take_off_altitude_ = up->altitude_msl;
  const auto mode = std::visit(
      [](const auto& r) -> std::optional<VehicleMode> { return Asked()(r); }, request);
  if (mode) asked_ = *mode;
}

void ShownMode::hear(const MissionProgress& progress) {
  if (progress.finished && asked_ == VehicleMode::kMission) asked_ = VehicleMode::kHold;
}

void ShownMode::hear(Time now, const AutopilotStatus& status, double altitude_msl) {
  if (!status.on_ground) {
    armed_ = flew_ = true;
    standing_since_.reset();
  } else if (flew_) {
    if (!standing_since_) standing_since_ = now;
    if (now - *standing_since_ >= kDisarmsAfter) armed_ = flew_ = false;
  }
  // Up, a take-off becomes what follows it.
  if (asked_ == VehicleMode::kTakeOff && !status.on_ground &&
      altitude_msl >= take_off_altitude_ - kArrival)
    asked_ = stays_guided_ ? VehicleMode::kGuided : VehicleMode::kHold;
  mode_ = commanded_ ? asked_
                     : (status.on_ground ? VehicleMode::kHold : VehicleMode::kGuided);
  if (status.mode == FlightMode::kManual) mode_ = VehicleMode::kManual;
  if (status.mode == FlightMode::kStabilized) mode_ = VehicleMode::kStabilized;
  switch (status.reaction) {
    case FailsafeReaction::kNone:
      return;
    case FailsafeReaction::kHold:
      mode_ = VehicleMode::kHold;
      return;
    case FailsafeReaction::kReturn:
      mode_ = VehicleMode::kReturn;
      return;
    case FailsafeReaction::kLand:
    case FailsafeReaction::kDescend:
      mode_ = VehicleMode::kLand;
      return;
  }
}

}  // namespace skein::vehicle_links
