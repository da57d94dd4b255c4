// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/autopilot/skein/land_detector.h"

#include <cmath>

namespace skein::autopilot {
namespace {

constexpr double kStill = 0.3;            // of a multirotor, up and down [m/s]
constexpr double kLittleThrust = 0.4;     // of hover
constexpr double kFlyingShare = 1.0 / 3;  // of the minimum airspeed
constexpr double kStillTime = 1;          // [s]
constexpr double kTooSlow = 0.9;   // of the minimum airspeed, for what stands in a wind
constexpr double kStands = 1;      // over ground, of a fixed wing at most [m/s]
constexpr double kStandsTime = 3;  // [s]
constexpr double kClimb = 1;       // that a vehicle on the ground cannot have [m/s]
constexpr double kLift = 3;        // above where it stood [m]
constexpr double kClear = 5;       // above it: no wheel touches any more [m]
constexpr double kIdle = 0.05;     // throttle of what does not take off

// Whether something has been so for a time; `since` keeps when that began.
bool lasts(bool is_so, Time now, double seconds, std::optional<Time>& since) {
  if (!is_so) since.reset();
  if (is_so && !since) since = now;
  return since && (now - *since).seconds() >= seconds;
}

}  // namespace

LandDetector::LandDetector(const FlightLimits& limits, double hover, bool on_ground)
    : slowest_(limits.slowest),
      hover_(hover),
      on_ground_(on_ground),
      clear_(!on_ground) {}

bool LandDetector::slow(const NavState& nav, double throttle) const {
  // With so little thrust it would fall. The horizontal speed does not count: without
  // satellites it is hardly known.
  if (slowest_ <= 0)
    return std::abs(nav.v_N.z()) < kStill && throttle < kLittleThrust * hover_;
  const double speed2 = nav.v_N.squaredNorm();
  const double min = kFlyingShare * slowest_;
  return speed2 < min * min && nav.airspeed < min;
}

bool LandDetector::stands_in_wind(const NavState& nav) const {
  return slowest_ > 0 && nav.v_N.norm() < kStands && nav.airspeed < kTooSlow * slowest_;
}

bool LandDetector::step(const NavState& nav, double throttle) {
  const double altitude = -nav.p_N.z();
  if (on_ground_) {
    // What the first fixes move is the belief, not the aircraft.
    if (!ground_ || throttle < kIdle) ground_ = altitude;
    clear_ = false;
    const bool fast =
        slowest_ > 0 && nav.airspeed > kTooSlow * slowest_ && nav.v_N.norm() > kStands;
    if (-nav.v_N.z() > kClimb || altitude > *ground_ + kLift || fast) on_ground_ = false;
    slow_since_.reset();
    stands_since_.reset();
    return on_ground_;
  }
  clear_ = clear_ || !ground_ || altitude > *ground_ + kClear;
  const bool still = lasts(slow(nav, throttle), nav.time, kStillTime, slow_since_);
  const bool stands = lasts(stands_in_wind(nav), nav.time, kStandsTime, stands_since_);
  if (still || stands) {
    on_ground_ = true;
    ground_ = altitude;
  }
  return on_ground_;
}

}  // namespace skein::autopilot
