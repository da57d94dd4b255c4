// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "skein/base/result.h"
#include "skein/link/flight_model/flight_state.h"

/// FlightGear's generic protocol (2020.3), with lines of our own: FlightGear reads from a
/// file which of its properties they hold. Numbers as text, parted by commas.
namespace skein::flight_model {

/// The protocol file: what FlightGear says in each line and what it is told in each. It
/// belongs into the folder Protocol of its data.
std::string flightgear_protocol();

/// A line that FlightGear has sent, with or without its line feed.
/// Fails: kBadInput for what is no such line, and for numbers that no aircraft can have.
Result<FlightState> parse_flightgear(std::string_view line);

/// The line that FlightGear is sent. Without a wind its own stays as it is.
std::string flightgear_line(const FlightControls& controls);

}  // namespace skein::flight_model
