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
constexpr double kTrackMargin = 20;  // that positions of one track may be apart [m]
constexpr double kTrackGain = 1.5;   // and what it flies meanwhile, by its speed
constexpr double kTrackSpeed = 10;   // and so much more for each second [m/s]
// So often no receiver changes its mind.
constexpr int kMinTrackSwitches = 30;  // in 10 s
constexpr int kMinAlternations = 3;    // of what a vehicle is
const Time kKindWindow = Time::from_seconds(10);
const Time kHardwareWindow = Time::from_seconds(60);
const Time kHardwareAmbiguous = Time::from_seconds(30);  // it is asked for each 10 s
const Time kMaxAhead = Time::from_seconds(3);  // of one clock, heard by two links
const Time kMaxBehind = Time::from_seconds(10);
const Time kDiffersFor = kMaxBehind;  // after a reboot the slower link is behind
constexpr double kMaxLatitudeE7 = 900'000'000;  // [1e-7 deg]
constexpr double kMetresPerE7 = 0.0111319491;   // of latitude

double metres_between(const ReportedPlace& a, const ReportedPlace& b) {
  const double north =
      kMetresPerE7 * (static_cast<double>(b.latitude_e7) - a.latitude_e7);
  double turned = static_cast<double>(b.longitude_e7) - a.longitude_e7;
  if (std::abs(turned) > 1.8e9) turned -= std::copysign(3.6e9, turned);
  const double east =
      kMetresPerE7 * turned * math::cos(geo::radians(1e-7 * a.latitude_e7));
  return std::sqrt(north * north + east * east);
}

bool is_known(const ReportedPlace& place) {
  return std::abs(static_cast<double>(place.latitude_e7)) <= kMaxLatitudeE7 &&
         std::abs(static_cast<double>(place.longitude_e7)) <= 2 * kMaxLatitudeE7 &&
         (place.latitude_e7 != 0 || place.longitude_e7 != 0);
}

std::uint64_t number_of(const ReportedKind& kind) {
  return std::uint64_t{kind.type} << 8 | kind.autopilot;
}

}  // namespace

void IdentityWatch::forget() {
  *this = IdentityWatch();
}

std::optional<std::string> IdentityWatch::found(std::string what, Time now, Time lasts) {
  const bool known = is_ambiguous(now);
  if (!ambiguous_until_ || *ambiguous_until_ < now + lasts)
    ambiguous_until_ = now + lasts;
  if (known) return std::nullopt;
  return what;
}

// How many there have been of late.
int IdentityWatch::Switches::add(Time now) {
  if (count == 0 || now - first > kSwitchWindow) {
    count = 0;
    first = now;
  }
  return ++count;
}

bool IdentityWatch::Alternation::take(std::uint64_t value, Time window, Time now) {
  const auto before = std::exchange(last, value);
  if (!before || *before == value) return false;
  if (switches == 0 || now - first > window) {
    switches = 0;
    first = now;
  }
  return ++switches >= kMinAlternations;
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
  if (switches_.add(now) < kMinSwitches) return std::nullopt;
  return found("its frames have two counts that go on side by side", now, kAmbiguous);
}

bool IdentityWatch::note_jump(const Where& before, const Where& place, double moved) {
  // Of the two clocks the one that went further: what waited on the way comes at once.
  const double passed = std::max(
      {(place.at - before.at).seconds(), (place.boot - before.boot).seconds(), 0.0});
  if (moved <= kFoundAgain + kMaxPlausibleSpeed * passed) return false;
  if (jumps_ == 0 || place.at - first_jump_ > kThereAndBack) {
    jumps_ = 0;
    first_jump_ = place.at;
  }
  return ++jumps_ >= kMinJumps;
}

bool IdentityWatch::note_track(const Where& place) {
  // A copy of an earlier one, by another route.
  if (std::ranges::find(boots_, place.boot) != boots_.end()) return false;
  boots_[next_boot_] = place.boot;
  next_boot_ = (next_boot_ + 1) % boots_.size();
  const auto goes_on = [&](const std::optional<Where>& track) {
    if (!track || place.at - track->at >= kCountKept) return false;
    const double passed = std::abs((place.boot - track->boot).seconds());
    const double speed = std::max(place.speed, track->speed);
    return metres_between(*track, place) <=
           kTrackMargin + (kTrackGain * speed + kTrackSpeed) * passed;
  };
  if (!track_ || goes_on(track_)) {
    track_ = place;
    return false;
  }
  const bool continued = goes_on(other_track_);
  other_track_ = std::exchange(track_, place);
  if (!std::exchange(track_continued_, continued) || !continued) return false;
  return track_switches_.add(place.at) >= kMinTrackSwitches;
}

std::optional<std::string> IdentityWatch::take_place(const ReportedPlace& reported,
                                                     Time now) {
  const Where place{reported, now};
  if (!is_known(place)) return std::nullopt;
  const auto before = std::exchange(where_, place);
  const bool two_tracks = note_track(place);
  const double moved = before ? metres_between(*before, place) : 0;
  if (before && note_jump(*before, place, moved))
    return found(fmt::format("its position jumps there and back, by {:.0f} m", moved),
                 now, kAmbiguous);
  if (!two_tracks) return std::nullopt;
  return found(fmt::format("its positions are on two tracks, {:.0f} m apart",
                           metres_between(*track_, *other_track_)),
               now, kAmbiguous);
}

std::optional<std::string> IdentityWatch::take_kind(const ReportedKind& kind, Time now) {
  if (!kinds_.take(number_of(kind), kKindWindow, now)) return std::nullopt;
  return found("its type changes to and fro", now, kAmbiguous);
}

std::optional<std::string> IdentityWatch::take_hardware(std::uint64_t number, Time now) {
  if (number == 0 || !hardware_.take(number, kHardwareWindow, now)) return std::nullopt;
  return found("the numbers of its board change to and fro", now, kHardwareAmbiguous);
}

std::string IdentityWatch::difference(const ReportedKind& kind) const {
  if (!kinds_.last || *kinds_.last == number_of(kind)) return {};
  return "of another type";
}

std::string IdentityWatch::difference(const ReportedPlace& place, Time now) {
  if (!where_) return {};
  const Time ahead = place.boot - (where_->boot + (now - where_->at));
  const double passed = std::abs((place.boot - where_->boot).seconds());
  const double away = is_known(place) ? metres_between(*where_, place) : 0;
  const bool is_away = away > kFoundAgain + kMaxPlausibleSpeed * passed;
  const bool differs = is_away || ahead > kMaxAhead || ahead < Time() - kMaxBehind;
  if (!differs) {
    differs_since_.reset();
    return {};
  }
  if (!differs_since_) differs_since_ = now;
  if (now - *differs_since_ < kDiffersFor) return {};
  return is_away ? fmt::format("{:.0f} m away", away)
                 : fmt::format("with a clock that differs by {:.0f} s",
                               std::abs(ahead.seconds()));
}

}  // namespace skein::autopilot_client
