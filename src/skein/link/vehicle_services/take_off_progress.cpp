// SPDX-License-Identifier: Apache-2.0
#include "skein/link/vehicle_services/take_off_progress.h"

#include <algorithm>

#include "skein/link/vehicle_services/message_numbers.h"

namespace skein::vehicle_services {
namespace {

const Time kTakeOffPatience = Time::from_seconds(180);
const Time kStillClimbs = Time::from_seconds(10);  // after the vehicle has ended it

// How far below the target is there, of a climb of so much [m].
double nearly_there(double climb) {
  return std::max(1.0, 0.05 * climb);
}
double not_far_below(double climb) {
  return std::max(3.0, 0.2 * climb);
}

bool goes_on_by_itself(VehicleMode mode) {
  return mode == VehicleMode::kHold || mode == VehicleMode::kGuided;
}

}  // namespace

TakeOffProgress::TakeOffProgress(const ServedVehicle& vehicle, double target_msl)
    : start_msl_(vehicle.altitude_msl()),
      target_msl_(target_msl),
      began_(vehicle.now.simulated) {}

TakeOffProgress::State TakeOffProgress::check(const ServedVehicle& vehicle) {
  using enum mavlink::CommandResult;
  const double climb = target_msl_ - start_msl_;
  const double left = target_msl_ - vehicle.altitude_msl();
  const auto percent =
      rounded<std::uint8_t>(std::clamp(1 - left / climb, 0.0, 1.0) * 100);
  if (vehicle.flying() && left <= nearly_there(climb)) return {kAccepted, 100};
  if (vehicle.mode_expected.pending() && vehicle.mode() != VehicleMode::kTakeOff)
    return {kCancelled, percent};
  const Time now = vehicle.now.simulated;
  if (!vehicle.armed() || now - began_ > kTakeOffPatience) return {kFailed, percent};
  const VehicleMode mode = vehicle.snapshot.condition.mode;
  if (mode == VehicleMode::kTakeOff) seen_ = true;
  if (!seen_ || mode == VehicleMode::kTakeOff) return {kInProgress, percent};
  if (!goes_on_by_itself(mode)) return {kFailed, percent};
  if (!ended_) ended_ = now;
  if (now - *ended_ < kStillClimbs) return {kInProgress, percent};
  return {vehicle.flying() && left <= not_far_below(climb) ? kAccepted : kFailed,
          percent};
}

}  // namespace skein::vehicle_services
