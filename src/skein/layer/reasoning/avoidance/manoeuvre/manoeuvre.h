// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "skein/data/traffic/separation.h"
#include "skein/data/vehicle/vehicle.h"

namespace skein::reasoning {

/// What an aircraft may do about a conflict.
enum class ManoeuvreKind : std::uint8_t {
  kGoOn,    ///< fly the plan
  kDirect,  ///< the quickest way to the plan's end
  kRight,   ///< pass right of where it would be closest
  kLeft,
  kUp,  ///< pass higher
  kDown,
  kSpeed,  ///< fly slower or faster until the conflict is over
};
constexpr auto names_of(const ManoeuvreKind*) {
  return std::to_array<std::string_view>(
      {"go-on", "direct", "right", "left", "up", "down", "speed"});
}

/// One of them, by numbers that both aircraft make the same flight of.
struct Manoeuvre {
  ManoeuvreKind kind = ManoeuvreKind::kGoOn;
  double amount = 0;  ///< aside, up, down [m]; speed: times the airspeed
  double lead = 0;    ///< aside: the plan is left so long before the conflict; up, down:
                      ///< or earlier [s]

  friend bool operator==(const Manoeuvre&, const Manoeuvre&) = default;
};

/// All that are looked at for a conflict, going on first.
///
/// Aside by 0.6, 1.2, 2, 3.2, 4.8 times the horizontal separation, left 12, 25 or 50 s
/// before; up and down by 1.15, 2.2, 3.3, 4.5, 6 times the vertical one; both times the
/// strength. Speed 0.82, 0.9, 1.1, 1.18 times cruise where that is well within what it
/// can fly. All numbers are ones that a `float` holds, so that they can be sent as they
/// are.
///
/// @param strength  1 at first, more where no pair of flights is free.
std::vector<Manoeuvre> manoeuvres(const FlightLimits& limits,
                                  const Separation& separation, double strength);

}  // namespace skein::reasoning
