// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "skein/link/mavlink/constants.h"
#include "skein/link/mavlink/messages.h"

namespace skein::vehicle_services {

/// A command, whichever message brought it.
struct Command {
  mavlink::CommandId id{};
  bool in_integers = false;    ///< COMMAND_INT
  bool is_repeated = false;    ///< its sender says that it was sent before
  std::uint8_t frame = 0;      ///< of the place
  std::array<float, 4> p{};    ///< parameters 1 to 4
  double x = 0, y = 0, z = 0;  ///< parameters 5 to 7; a place in degrees and metres

  /// The same command with the same parameters, bit for bit.
  bool is_same(const Command& other) const;

  float param(std::size_t number) const { return p[number - 1]; }
  /// It says where: neither left out (NaN, the largest integer) nor 0, 0.
  bool has_place() const;
  bool has_altitude() const;
};

/// @param frame  that coordinates of floats are in.
Command command_of(const mavlink::CommandLong& message, mavlink::CoordinateFrame frame);
Command command_of(const mavlink::CommandInt& message);

/// What becomes of a command.
struct Answer {
  Answer(mavlink::CommandResult what = mavlink::CommandResult::kAccepted,  // NOLINT
         std::string why = {})
      : result(what), reason(std::move(why)) {}

  mavlink::CommandResult result;
  std::string reason;                  ///< for people; may be empty
  std::optional<double> take_off_msl;  ///< accepted, and done at this altitude [m]
};

}  // namespace skein::vehicle_services
