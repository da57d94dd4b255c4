// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace skein::exchange {

/// Text as XML and HTML hold it, in elements and in attributes: markup escaped, control
/// characters as blanks, bytes that are no UTF-8 as question marks.
std::string escaped(std::string_view text);

/// A length for people: "85 m", "1.25 km".
std::string shown_length(double metres);

/// A number with one decimal, zero without a minus sign: "12.3", "0.0".
std::string shown_tenths(double value);

/// An angle from north [rad] in degrees, "0.0" to "359.9".
std::string shown_bearing(double angle);

/// A time for people: "83.21 s", "12 min 5.0 s", "2 h 3 min 10 s", from 100 h on "4.2
/// days", at most "over 100000 days".
std::string shown_time(double seconds);

/// The same, rounded down: of a time that nothing is below.
std::string shown_time_below(double seconds);

/// A moment on the run's clock for maps: "45 s", "1:05", "1:00:00".
std::string shown_clock(double seconds);

/// The number 1, 2 or 5 times a power of ten that is nearest below `value`, above 0.
double round_below(double value);

}  // namespace skein::exchange
