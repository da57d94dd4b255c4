// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace skein::environment {

/// What the numbers of 5/9/2021 and 21/9/5 are.
enum class DateOrder { kMonthFirst, kDayFirst, kYearFirst };

/// A moment as people and programs write it.
struct DateTime {
  double value = 0;         ///< [s]: since 1970 UTC, or from an unknown origin
  bool utc = true;          ///< since 1970; else plain seconds
  bool time_of_day = true;  ///< false: a date alone, value at its 00:00
  bool zone = true;         ///< false: none is given, value as if it were UTC
  bool short_year = false;  ///< its year has two digits: 69 to 99 are 1969 to 1999
  std::string zone_name{};  ///< of a zone given by name or letter: "PDT is UTC-07:00"
};

/// A date, and a time of day if it is there: `2021-09-05T14:04:00-07:00`,
/// `2021/09/05 14:04:00+00`, `20210905_1404`, `9/5/2021 2:04:00 PM`, `9/5/21 14:04`,
/// `5.9.2021 14:04` (with points the day is first), `5 Sep 2021 14:04 PDT`,
/// `Sep 5, 2021`. Zones: `+hh:mm`, UTC, GMT, Z, the military letters but A, J and P
/// (which may mean morning and afternoon), and the names of zones that mean one offset
/// only; CST, MST, PST, EST and their summer times are those of North America. Spaces of
/// any kind count as one.
/// @returns  none when the text is anything else.
std::optional<DateTime> parse_date(std::string_view text, DateOrder order);

/// Seconds since 1970-01-01T00:00:00Z of an ISO 8601 date or date and time alone, such as
/// `2021-09-05T14:04:00-07:00`, `2021-09-05 14:04` or `2021-09-05T21:04:00.5Z`. Without a
/// zone it counts as UTC.
std::optional<double> parse_utc(std::string_view text);

/// As parse_date(), or a number: seconds since 1970 from 1e8 on, milliseconds from 1e11
/// on; dates of 8, 10 (with the hour), 12 or 14 digits; below, seconds from an unknown
/// origin.
/// @param plain  a number is seconds from an unknown origin, however large (below 1e12).
std::optional<DateTime> parse_date_or_number(std::string_view text, DateOrder order,
                                             bool plain);

/// The first date within a text, with the time of day that follows it, such as a file's
/// name: `Bridge_IR_20210905_1404.shp`, `Heat Perimeter 2021-09-05 23:00`.
std::optional<DateTime> find_date(std::string_view text);

/// `14:04`, `14:04:30`, `1404`, `2:04 PM` as seconds after 00:00.
std::optional<double> parse_time_of_day(std::string_view text);

/// The moment as `2021-09-05T14:04:00Z`, whole seconds.
std::string utc_text(double seconds);

/// `text` without spaces at its ends, and with plain spaces for the others that Unicode
/// has (browsers write a narrow no-break space before AM); marks of direction are left
/// out.
std::string plain_spaces(std::string_view text);

}  // namespace skein::environment
