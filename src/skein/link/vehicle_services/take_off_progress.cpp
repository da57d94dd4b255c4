#include "skein/link/vehicle_services/take_off_progress.h"

#include <algorithm>

#include "skein/link/vehicle_services/message_numbers.h"

namespace skein::vehicle_services {
namespace {

const Time kTakeOffPatience = Time::from_seconds(180);
constexpr double kNearlyThere = 0.95;  // of the climb
constexpr double kFarEnough = 0.8;     // when the vehicle has ended it

}  // namespace

TakeOffProgress::TakeOffProgress(const ServedVehicle& vehicle, double target_msl)
    : start_msl_(vehicle.altitude_msl()),
      target_msl_(target_msl),
      began_(vehicle.now.simulated) {}

TakeOffProgress::State TakeOffProgress::check(const ServedVehicle& vehicle) {
  using enum mavlink::CommandResult;
  const double climbed =
      (vehicle.altitude_msl() - start_msl_) / (target_msl_ - start_msl_);
  const auto percent = rounded<std::uint8_t>(std::clamp(climbed, 0.0, 1.0) * 100);
  if (vehicle.flying() && climbed >= kNearlyThere) return {kAccepted, 100};
  if (vehicle.mode_expected.pending() && vehicle.mode() != VehicleMode::kTakeOff)
    return {kCancelled, percent};
  const bool shown = vehicle.snapshot.condition.mode == VehicleMode::kTakeOff;
  seen_ = seen_ || shown;
  if (seen_ && !shown)
    return {vehicle.flying() && climbed >= kFarEnough ? kAccepted : kFailed, percent};
  if (!vehicle.armed() || vehicle.now.simulated - began_ > kTakeOffPatience)
    return {kFailed, percent};
  return {kInProgress, percent};
}

}  // namespace skein::vehicle_services
