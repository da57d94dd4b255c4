#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "skein/data/flight_plan.h"

namespace skein::model {

/// A flight in few bytes, for slow modems: blocks of elements that join, each of 25 bytes
/// and 10 for every element. All numbers are fixed-point, little-endian.
///
/// | block | bytes | unit |
/// |---|---|---|
/// | start | 4 | ms of the run's clock |
/// | position: north, east, down | 3 x 4 | mm |
/// | heading | 3 | 2 pi / 2^24 |
/// | wind: north, east | 2 x 2 | 2 mm/s |
/// | elements | 2 | |
///
/// | element | bytes | unit |
/// |---|---|---|
/// | duration; uppermost bit: a vertical turn | 3 | ms |
/// | heading turned | 3 | 5 urad |
/// | airspeed | 2 | 5 mm/s |
/// | climb rate at the start | 2 | 2 mm/s |
///
/// A vertical turn ends with the climb rate of the next element of its block, or level.
/// Who sends a flight flies decoded_flight() of it, so that all know the same one.
///
/// @returns  nothing for an empty plan, one of more than 65,535 elements, or one whose
///           numbers do not fit.
std::optional<std::vector<std::uint8_t>> coded_flight(const FlightPlan& plan);

/// The flight that the bytes mean.
/// @returns  nothing where they mean none.
std::optional<FlightPlan> decoded_flight(std::span<const std::uint8_t> bytes);

/// The flight that others know when this one is sent: decoded_flight() of coded_flight().
/// One that cannot be sent stays as it is.
FlightPlan as_sent(FlightPlan plan);

}  // namespace skein::model
