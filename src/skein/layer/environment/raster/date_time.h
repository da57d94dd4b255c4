#pragma once

#include <optional>
#include <string_view>

namespace skein::environment {

/// Which number of 5/9/2021 is the month.
enum class DateOrder { kMonthFirst, kDayFirst };

/// A moment as people and programs write it.
struct DateTime {
  double value = 0;         ///< [s]: since 1970 UTC, or from an unknown origin
  bool utc = true;          ///< since 1970; else plain seconds
  bool time_of_day = true;  ///< false: a date alone, value at its 00:00
  bool zone = true;         ///< false: none is given, value as if it were UTC
};

/// A date, and a time of day if it is there: `2021-09-05T14:04:00-07:00`,
/// `2021/09/05 14:04:00+00`, `20210905_1404`, `9/5/2021 2:04:00 PM`, `5.9.2021 14:04`
/// (with points the day is first).
/// @returns  none when the text is anything else.
std::optional<DateTime> parse_date(std::string_view text, DateOrder order);

/// Seconds since 1970-01-01T00:00:00Z of an ISO 8601 date or date and time alone, such as
/// `2021-09-05T14:04:00-07:00`, `2021-09-05 14:04` or `2021-09-05T21:04:00.5Z`. Without a
/// zone it counts as UTC.
std::optional<double> parse_utc(std::string_view text);

/// As parse_date(), or a number: seconds since 1970 from 1e8 on, milliseconds from 1e11
/// on; dates of 8, 12 or 14 digits; below, seconds from an unknown origin.
/// @param plain  a number is seconds from an unknown origin, however large (below 1e12).
std::optional<DateTime> parse_date_or_number(std::string_view text, DateOrder order,
                                             bool plain);

/// The first date within a text, with the time of day that follows it, such as a file's
/// name: `Bridge_IR_20210905_1404.shp`, `Heat Perimeter 2021-09-05 23:00`.
std::optional<DateTime> find_date(std::string_view text);

/// `14:04`, `14:04:30`, `1404`, `2:04 PM` as seconds after 00:00.
std::optional<double> parse_time_of_day(std::string_view text);

/// The order that a date with slashes shows by a number above 12; none where it shows
/// nothing, or where there is no such date.
std::optional<DateOrder> shown_order(std::string_view text);

/// Whether the text begins like a date with slashes, whose order matters.
bool has_slash_date(std::string_view text);

}  // namespace skein::environment
