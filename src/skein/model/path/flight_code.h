// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "skein/data/vehicle/flight_plan.h"

namespace skein::model {

/// A flight in few bytes, for slow modems: blocks of elements that join in one wind, each
/// of 25 bytes, or 6 where it joins the one before, and 3 to 10 for every element. All
/// numbers are fixed-point, little-endian.
///
/// | block | bytes | unit |
/// |---|---|---|
/// | elements; uppermost bit: it joins the block before | 2 | |
/// | wind: north, east | 2 x 2 | 2 mm/s |
/// | start, unless it joins | 4 | ms of the run's clock |
/// | position: north, east, down, unless it joins | 3 x 4 | mm |
/// | heading, unless it joins | 3 | 2 pi / 2^24 |
///
/// | element | bytes | unit |
/// |---|---|---|
/// | duration; the four uppermost bits say what it is | 3 | ms |
/// | heading turned, if it turns (bit 22) | 3 | 5 urad |
/// | airspeed, if other than that of the element before (bit 21) | 2 | 5 mm/s |
/// | climb rate at the start, if it is not level (bit 20) | 2 | 2 mm/s |
///
/// With bit 23 it is a vertical turn. An airspeed before the first is 0.
/// Behind a vertical turn to a climb no block joins. A vertical turn ends with the climb
/// rate of the next element of its block, or level. Who sends a flight flies
/// decoded_flight() of it, so that all know the same one.
///
/// @returns  nothing for an empty plan, one of more than 32,767 elements, or one whose
///           numbers do not fit.
std::optional<std::vector<std::uint8_t>> coded_flight(const FlightPlan& plan);

/// The flight that the bytes mean.
/// @returns  nothing where they mean none.
std::optional<FlightPlan> decoded_flight(std::span<const std::uint8_t> bytes);

/// The flight that others know when this one is sent: decoded_flight() of coded_flight().
/// One that cannot be sent stays as it is.
FlightPlan as_sent(FlightPlan plan);

}  // namespace skein::model
