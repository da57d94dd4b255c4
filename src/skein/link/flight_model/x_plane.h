// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "skein/link/flight_model/flight_state.h"

/// X-Plane's UDP protocol (11 and 12), at its port 49000: RPOS for place, attitude and
/// velocities, as it alone has them in double precision; RREF for what is in datarefs;
/// DREF to set datarefs. Numbers are little-endian.
namespace skein::flight_model {

/// X-Plane is asked for so many states a second.
inline constexpr int kXPlaneRate = 50;

/// What X-Plane is asked for, a datagram each: RPOS, and RREF for each dataref. It goes
/// on until it ends; to be sent again when nothing comes.
std::vector<std::string> x_plane_requests();

/// What sets the controls, a datagram each: DREF.
/// @param takes_over  those too by which X-Plane leaves its joystick to others.
std::vector<std::string> x_plane_controls(const FlightControls& controls,
                                          bool takes_over);

/// Puts together what X-Plane says.
class XPlaneReader {
 public:
  struct Counts {
    std::uint64_t states = 0;
    std::uint64_t passed_over = 0;  ///< datagrams of other kinds, and broken ones
  };

  /// Takes in a datagram, of any bytes.
  /// @returns  a state with each RPOS, once time and ground contact are known, unless
  ///           X-Plane is paused.
  std::optional<FlightState> read(std::span<const std::byte> datagram);

  const Counts& counts() const { return counts_; }

 private:
  void read_datarefs(std::span<const std::byte> rows);

  std::vector<std::optional<float>> values_;  // of datarefs, by their numbers
  Counts counts_;
};

}  // namespace skein::flight_model
