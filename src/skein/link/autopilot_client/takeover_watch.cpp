// SPDX-License-Identifier: Apache-2.0
#include "skein/link/autopilot_client/takeover_watch.h"

#include <utility>

namespace skein::autopilot_client {
namespace {

constexpr int kShownLater = 3;  // heartbeats

}  // namespace

void TakeoverWatch::end() {
  if (modes_ == 0) return;
  if (ended_kept_ == 0) ended_ = 0;
  ended_ |= std::exchange(modes_, 0);
  ended_kept_ = kShownLater;
}

bool TakeoverWatch::report(VehicleMode mode, std::uint32_t number) {
  const VehicleMode before = std::exchange(mode_, mode);
  const auto last = std::exchange(number_, number);
  const ModeSet own = modes_ | (ended_kept_ > 0 ? ended_ : 0);
  if (ended_kept_ > 0) --ended_kept_;
  if (!last || *last == number || (own & mode_set(mode)) != 0) return false;
  return !(before == VehicleMode::kTakeOff && mode == VehicleMode::kHold);
}

}  // namespace skein::autopilot_client
