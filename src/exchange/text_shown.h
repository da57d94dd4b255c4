#pragma once

#include <string>
#include <string_view>

namespace skein::exchange {

/// Text as XML and HTML hold it, in elements and in attributes: markup escaped, control
/// characters as blanks, bytes that are no UTF-8 as question marks.
std::string escaped(std::string_view text);

/// A length for people: "85 m", "1.25 km".
std::string shown_length(double metres);

/// A time for people: "83.21 s", "12 min 5.0 s", "2 h 3 min 10 s".
std::string shown_time(double seconds);

/// A moment on the run's clock for maps: "45 s", "1:05", "1:00:00".
std::string shown_clock(double seconds);

/// The number 1, 2 or 5 times a power of ten that is nearest below `value`, above 0.
double round_below(double value);

}  // namespace skein::exchange
