// SPDX-License-Identifier: Apache-2.0
#include "skein/link/autopilot_client/identity_watch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "skein/base/math.h"
#include "skein/geo/rotation.h"

namespace skein::autopilot_client {
namespace {

constexpr int kMaxMissing = 8;      // frames lost in between, of one numbering
constexpr int kMaxOvertaking = 64;  // frames that one may overtake
constexpr int kMinSwitches = 6;     // that make two senders
const Time kSwitchWindow = Time::from_seconds(10);
const Time kCountKept = Time::from_seconds(3);  // of a numbering that does not go on
const Time kAmbiguous = Time::from_seconds(10);
constexpr double kMaxPlausibleSpeed = 200;  // of what has a link of this kind [m/s]
constexpr double kFoundAgain = 300;  // of a receiver that finds its place again [m]
constexpr int kMinJumps = 3;         // there and back again, that make two senders
const Time kThereAndBack = Time::from_seconds(10);
constexpr double kMaxLatitudeE7 = 900'000'000;  // [1e-7 deg]
constexpr double kMetresPerE7 = 0.0111319491;   // of latitude

double metres_between(std::int32_t latitude_a, std::int32_t longitude_a,
                      std::int32_t latitude_b, std::int32_t longitude_b) {
  const double north = kMetresPerE7 * (static_cast<double>(latitude_b) - latitude_a);
  double turned = static_cast<double>(longitude_b) - longitude_a;
  if (std::abs(turned) > 1.8e9) turned -= std::copysign(3.6e9, turned);
  const double east = kMetresPerE7 * turned * math::cos(geo::radians(1e-7 * latitude_a));
  return std::sqrt(north * north + east * east);
}

}  // namespace

void IdentityWatch::forget() {
  *this = IdentityWatch();
}

void IdentityWatch::note_switch(Time now) {
  if (switches_ == 0 || now - first_switch_ > kSwitchWindow) {
    switches_ = 0;
    first_switch_ = now;
  }
  ++switches_;
}

std::optional<std::string> IdentityWatch::take_sequence(std::uint8_t sequence, Time now) {
  const auto step = [&](const Count& count) {
    return static_cast<std::uint8_t>(sequence - count.last);
  };
  const auto goes_on = [&](const std::optional<Count>& count) {
    return count && now - count->at < kCountKept && step(*count) >= 1 &&
           step(*count) <= 1 + kMaxMissing;
  };
  if (!present_ || goes_on(present_)) {
    present_ = Count{sequence, now};
    return std::nullopt;
  }
  // Repeated, or overtaken.
  if (step(*present_) == 0 || step(*present_) >= 256 - kMaxOvertaking)
    return std::nullopt;
  const bool continued = goes_on(other_);
  other_ = std::exchange(present_, Count{sequence, now});
  // There and back: a single frame that is far too late only leads back.
  if (!std::exchange(switch_continued_, continued) || !continued) return std::nullopt;
  note_switch(now);
  if (switches_ < kMinSwitches) return std::nullopt;
  const bool known = is_ambiguous(now);
  ambiguous_until_ = now + kAmbiguous;
  if (known) return std::nullopt;
  return "its frames have two counts that go on side by side";
}

std::optional<std::string> IdentityWatch::take_position(std::int32_t latitude_e7,
                                                        std::int32_t longitude_e7,
                                                        Time boot, Time now) {
  const bool is_place = std::abs(static_cast<double>(latitude_e7)) <= kMaxLatitudeE7 &&
                        std::abs(static_cast<double>(longitude_e7)) <= 2 * kMaxLatitudeE7;
  if (!is_place || (latitude_e7 == 0 && longitude_e7 == 0)) return std::nullopt;
  const auto before = std::exchange(where_, Where{latitude_e7, longitude_e7, boot, now});
  if (!before) return std::nullopt;
  // Of the two clocks the one that went further: what waited on the way comes at once.
  const double passed =
      std::max({(now - before->at).seconds(), (boot - before->boot).seconds(), 0.0});
  const double moved = metres_between(before->latitude_e7, before->longitude_e7,
                                      latitude_e7, longitude_e7);
  if (moved <= kFoundAgain + kMaxPlausibleSpeed * passed) return std::nullopt;
  if (jumps_ == 0 || now - first_jump_ > kThereAndBack) {
    jumps_ = 0;
    first_jump_ = now;
  }
  if (++jumps_ < kMinJumps) return std::nullopt;
  const bool known = is_ambiguous(now);
  ambiguous_until_ = now + kAmbiguous;
  if (known) return std::nullopt;
  return fmt::format("its position jumps there and back, by {:.0f} m", moved);
}

}  // namespace skein::autopilot_client
