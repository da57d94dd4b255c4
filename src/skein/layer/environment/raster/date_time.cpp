// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/environment/raster/date_time.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <string>

#include <fmt/format.h>

#include "skein/base/csv.h"

namespace skein::environment {
namespace {

// Numbers of ten digits that are a date and an hour, 2021090514, rather than seconds
// since 1970, which these would be from September 2032 on.
constexpr double kFirstHourDigits = 1980010100, kLastHourDigits = 2050000000;

// Years of two digits below it are of the century from 2000, as POSIX has it.
constexpr int kFirstShortYear = 69;

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

// Takes text apart from its front; `good()` turns false for good at the first misfit.
class Scanner {
 public:
  explicit Scanner(std::string_view text) : text_(text) {}

  bool good() const { return good_; }
  bool at_end() const { return text_.empty(); }
  char front() const { return text_.empty() ? '\0' : text_.front(); }
  std::size_t digits_ahead() const {
    std::size_t count = 0;
    while (count < text_.size() && is_digit(text_[count])) ++count;
    return count;
  }
  // A number of so many digits.
  int number(std::size_t min, std::size_t max) {
    const std::size_t count = std::min(digits_ahead(), max);
    if (count < min) return fail();
    int value = 0;
    for (std::size_t i = 0; i < count; ++i) value = 10 * value + (text_[i] - '0');
    text_.remove_prefix(count);
    return value;
  }
  double fraction() {
    double value = 0, place = 0.1;
    for (; is_digit(front()); text_.remove_prefix(1), place /= 10)
      value += place * (front() - '0');
    return value;
  }
  bool skip(char c) {
    if (front() != c) return false;
    text_.remove_prefix(1);
    return true;
  }
  // A word in capital letters, however it is written here.
  bool skip_word(std::string_view word) {
    if (text_.size() < word.size()) return false;
    for (std::size_t i = 0; i < word.size(); ++i)
      if (std::toupper(static_cast<unsigned char>(text_[i])) != word[i]) return false;
    text_.remove_prefix(word.size());
    return true;
  }
  void skip_any(std::string_view set) {
    while (!text_.empty() && set.find(text_.front()) != std::string_view::npos)
      text_.remove_prefix(1);
  }
  // All of the rest, if it is one text in round brackets.
  bool skip_brackets() {
    if (text_.size() < 2 || text_.front() != '(' || text_.find(')') != text_.size() - 1)
      return false;
    text_ = {};
    return true;
  }
  int fail() {
    good_ = false;
    return 0;
  }

 private:
  std::string_view text_;
  bool good_ = true;
};

// [s since 1970] of 00:00 of a day; none when there is no such day.
std::optional<double> day_start(int year, int month, int day) {
  const std::chrono::year_month_day date{std::chrono::year(year),
                                         std::chrono::month(static_cast<unsigned>(month)),
                                         std::chrono::day(static_cast<unsigned>(day))};
  if (!date.ok()) return std::nullopt;
  return 86400.0 *
         static_cast<double>(std::chrono::sys_days(date).time_since_epoch().count());
}

struct Day {
  double start;  // [s since 1970]
  bool short_year = false;
};

std::optional<Day> day_of(int year, int month, int day, bool short_year = false) {
  if (short_year) year += year < kFirstShortYear ? 2000 : 1900;
  const auto start = day_start(year, month, day);
  return start ? std::optional(Day{*start, short_year}) : std::nullopt;
}

// 1 to 12; 0 when no month begins here. Its first three letters, a full stop, or all.
int scan_month_name(Scanner& scan) {
  constexpr std::array<std::string_view, 12> kMonths = {
      "JANUARY", "FEBRUARY", "MARCH",     "APRIL",   "MAY",      "JUNE",
      "JULY",    "AUGUST",   "SEPTEMBER", "OCTOBER", "NOVEMBER", "DECEMBER"};
  for (std::size_t m = 0; m < kMonths.size(); ++m) {
    if (!scan.skip_word(kMonths[m]) && !scan.skip_word(kMonths[m].substr(0, 3))) continue;
    if (m == 8) scan.skip_word("T");  // "Sept"
    scan.skip('.');
    return static_cast<int>(m) + 1;
  }
  return 0;
}

// "Sunday, " and the like, which say nothing new.
void skip_weekday(Scanner& scan) {
  for (const std::string_view day :
       {"MONDAY", "TUESDAY", "WEDNESDAY", "THURSDAY", "FRIDAY", "SATURDAY", "SUNDAY"})
    if (scan.skip_word(day) || scan.skip_word(day.substr(0, 3))) {
      scan.skip_any(",. ");
      return;
    }
}

// A year of two or four digits.
std::optional<Day> scan_year_of(Scanner& scan, int month, int day) {
  const std::size_t digits = scan.digits_ahead();
  if (digits != 2 && digits != 4) return std::nullopt;
  return day_of(scan.number(2, 4), month, day, digits == 2);
}

// Three numbers with a mark between them.
std::optional<Day> scan_marked_day(Scanner& scan, DateOrder order) {
  const std::size_t digits = scan.digits_ahead();
  const int first = scan.number(1, 4);
  const char mark = scan.front();
  const bool letter = std::isalpha(static_cast<unsigned char>(mark)) != 0;  // 05SEP2021
  if (mark != '-' && mark != '/' && mark != '.' && mark != '_' && mark != ' ' && !letter)
    return std::nullopt;
  if (!letter) scan.skip(mark);
  if (const int month = scan_month_name(scan); month > 0) {
    scan.skip_any("-/., ");
    if (digits == 4) return day_of(first, month, scan.number(1, 2));
    return scan_year_of(scan, month, first);
  }
  if (mark == ' ' || letter) return std::nullopt;
  const int second = scan.number(1, 2);
  if (!scan.skip(mark)) return std::nullopt;
  const std::size_t last = scan.digits_ahead();
  if (digits == 4) {
    const int day = scan.number(1, 2);
    return scan.good() ? day_of(first, second, day) : std::nullopt;
  }
  const bool short_year = last == 2;
  if (digits > 2 || (!short_year && last != 4) || mark == '_') return std::nullopt;
  // 05-09-21 may begin with the year, and nothing would show it.
  if (short_year && mark == '-') return std::nullopt;
  const int third = scan.number(2, 4);
  if (!scan.good()) return std::nullopt;
  if (mark == '.' || order == DateOrder::kDayFirst)
    return day_of(third, second, first, short_year);
  if (order == DateOrder::kMonthFirst) return day_of(third, first, second, short_year);
  if (!short_year) return std::nullopt;
  return digits == 2 ? day_of(first, second, third, true) : std::nullopt;
}

std::optional<Day> scan_day(Scanner& scan, DateOrder order) {
  if (scan.digits_ahead() >= 8) {  // 20210905, and maybe 1404 at once behind it
    const int year = scan.number(4, 4), month = scan.number(2, 2);
    if (year < 1900 || year > 2200) return std::nullopt;  // some other number
    return day_of(year, month, scan.number(2, 2));
  }
  if (scan.digits_ahead() > 0) return scan_marked_day(scan, order);
  skip_weekday(scan);
  if (scan.digits_ahead() > 0) return scan_marked_day(scan, order);
  const int month = scan_month_name(scan);
  if (month == 0) return std::nullopt;
  scan.skip_any(" -");
  const int day = scan.number(1, 2);
  for (const std::string_view ending : {"ST", "ND", "RD", "TH"})
    if (scan.skip_word(ending)) break;
  scan.skip_any(",- ");
  return scan.good() ? scan_year_of(scan, month, day) : std::nullopt;
}

// `14:04:30.5`, `140430`, `1404`, `2:04 PM` [s].
std::optional<double> scan_time_of_day(Scanner& scan) {
  const std::size_t digits = scan.digits_ahead();
  const bool packed = digits == 4 || digits == 6;
  if (!packed && digits > 2) return std::nullopt;
  int hour = scan.number(1, 2), minute = 0;
  double second = 0;
  if (packed) {
    minute = scan.number(2, 2);
    if (digits == 6) second = scan.number(2, 2);
  } else {
    if (!scan.skip(':')) return std::nullopt;
    minute = scan.number(1, 2);
    if (scan.skip(':')) second = scan.number(1, 2);
  }
  if (scan.skip('.')) second += scan.fraction();
  if (!scan.good() || hour > 24 || minute > 59 || second >= 61) return std::nullopt;
  if (hour == 24 && (minute > 0 || second > 0)) return std::nullopt;
  scan.skip_any(" ");
  const bool afternoon = scan.skip_word("PM") || scan.skip_word("P.M.");
  if (afternoon || scan.skip_word("AM") || scan.skip_word("A.M.")) {
    if (hour < 1 || hour > 12) return std::nullopt;
    hour = hour % 12 + (afternoon ? 12 : 0);
  }
  return 3600.0 * hour + 60.0 * minute + second;
}

// Names of zones that mean one offset [h] wherever they are used, and those of North
// America.
struct ZoneName {
  std::string_view name;
  double hours;
};
constexpr ZoneName kZoneNames[] = {
    {"AKST", -9}, {"AKDT", -8}, {"HST", -10}, {"PST", -8},  {"PDT", -7},   {"MST", -7},
    {"MDT", -6},  {"CST", -6},  {"CDT", -5},  {"EST", -5},  {"EDT", -4},   {"WEST", 1},
    {"WET", 0},   {"CEST", 2},  {"CET", 1},   {"EEST", 3},  {"EET", 2},    {"MSK", 3},
    {"JST", 9},   {"AWST", 8},  {"AEST", 10}, {"AEDT", 11}, {"ACST", 9.5}, {"ACDT", 10.5},
    {"NZST", 12}, {"NZDT", 13}, {"SAST", 2},  {"BRT", -3},
};

// The military letter of a zone. A and P may mean morning and afternoon, J any zone.
std::optional<double> zone_of_letter(char letter) {
  if (letter > 'A' && letter <= 'I') return letter - 'A' + 1;
  if (letter >= 'K' && letter <= 'M') return letter - 'K' + 10;
  if (letter >= 'N' && letter <= 'Y' && letter != 'P') return -(letter - 'N' + 1);
  return std::nullopt;
}

// A zone: its offset, east of Greenwich positive, and its name if it has one.
struct Zone {
  double offset;  // [s]
  std::string name{};
};

Zone named_zone(std::string_view name, double hours) {
  const double size = std::abs(hours);
  return {3600 * hours,
          fmt::format("{} is UTC{}{:02.0f}:{:02.0f}", name, hours < 0 ? '-' : '+',
                      std::floor(size), 60 * (size - std::floor(size)))};
}

std::optional<double> scan_offset(Scanner& scan) {
  const bool west = scan.front() == '-';
  if (!west && scan.front() != '+') return std::nullopt;
  scan.skip(scan.front());
  const std::size_t digits = scan.digits_ahead();
  const int hours = scan.number(1, digits == 3 ? 1 : 2);
  scan.skip(':');
  const int minutes = scan.digits_ahead() > 0 ? scan.number(2, 2) : 0;
  if (hours > 14 || minutes > 59) scan.fail();
  return (west ? -60.0 : 60.0) * (60 * hours + minutes);
}

// None when there is none.
std::optional<Zone> scan_zone(Scanner& scan) {
  scan.skip_any(" ");
  if (scan.skip_word("UTC") || scan.skip_word("GMT"))
    return Zone{scan_offset(scan).value_or(0)};
  if (scan.skip_word("Z")) return Zone{0};
  for (const ZoneName& each : kZoneNames)
    if (scan.skip_word(each.name)) return named_zone(each.name, each.hours);
  const char letter =
      static_cast<char>(std::toupper(static_cast<unsigned char>(scan.front())));
  if (const auto hours = zone_of_letter(letter)) {
    scan.skip(scan.front());
    return named_zone(std::string_view(&letter, 1), *hours);
  }
  if (const auto offset = scan_offset(scan)) return Zone{*offset};
  return std::nullopt;
}

}  // namespace

std::string plain_spaces(std::string_view text) {
  std::string plain;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = [&](std::size_t k) {
      return k < text.size() ? static_cast<unsigned char>(text[k]) : 0U;
    };
    if (byte(i) == 0xC2 && byte(i + 1) == 0xA0) {  // no-break
      plain += ' ';
      ++i;
    } else if (byte(i) == 0xE2 && byte(i + 1) == 0x80 &&
               ((byte(i + 2) >= 0x80 && byte(i + 2) <= 0x8A) || byte(i + 2) == 0xAF)) {
      plain += ' ';  // of any width
      i += 2;
    } else if (byte(i) == 0xE2 && byte(i + 1) == 0x80 &&
               (byte(i + 2) == 0x8E || byte(i + 2) == 0x8F)) {
      i += 2;  // marks of direction
    } else {
      plain += text[i] == '\t' || text[i] == '\r' || text[i] == '\n' ? ' ' : text[i];
    }
  }
  const std::size_t first = plain.find_first_not_of(' ');
  if (first == std::string::npos) return {};
  return plain.substr(first, plain.find_last_not_of(' ') - first + 1);
}

std::optional<DateTime> parse_date(std::string_view text, DateOrder order) {
  const std::string whole = plain_spaces(text);
  Scanner scan(whole);
  const auto day = scan_day(scan, order);
  if (!day || !scan.good()) return std::nullopt;
  DateTime result{day->start, true, false, false, day->short_year, {}};
  if (scan.at_end()) return result;
  if (scan.skip_word("Z")) {  // of a date alone, as XML writes it
    result.zone = true;
    return scan.at_end() ? std::optional(result) : std::nullopt;
  }
  if (!scan.skip('T')) scan.skip_any(" _,-");
  const auto time = scan_time_of_day(scan);
  if (!time) return std::nullopt;
  const auto zone = scan_zone(scan);
  if (scan.front() == ' ') {  // "(Pacific Daylight Time)", as JavaScript adds
    scan.skip_any(" ");
    if (!scan.skip_brackets()) return std::nullopt;
  }
  if (!scan.good() || !scan.at_end()) return std::nullopt;
  result.value += *time - (zone ? zone->offset : 0);
  result.time_of_day = true;
  result.zone = zone.has_value();
  if (zone) result.zone_name = zone->name;
  return result;
}

std::optional<double> parse_utc(std::string_view text) {
  const std::string whole = plain_spaces(text);
  if (whole.size() < 10 || whole[4] != '-' || whole[7] != '-') return std::nullopt;
  const auto date = parse_date(whole, DateOrder::kMonthFirst);
  return date ? std::optional(date->value) : std::nullopt;
}

std::string utc_text(double seconds) {
  const auto whole = static_cast<std::int64_t>(std::floor(seconds));
  const std::int64_t day = (whole >= 0 ? whole : whole - 86399) / 86400;
  const std::chrono::year_month_day date{std::chrono::sys_days(std::chrono::days(day))};
  const std::int64_t rest = whole - 86400 * day;
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}Z",
                     static_cast<int>(date.year()), static_cast<unsigned>(date.month()),
                     static_cast<unsigned>(date.day()), rest / 3600, rest / 60 % 60,
                     rest % 60);
}

std::optional<DateTime> parse_date_or_number(std::string_view text, DateOrder order,
                                             bool plain) {
  const auto number = number_in(text);
  if (!number || !std::isfinite(*number)) return parse_date(text, order);
  const double size = std::abs(*number);
  if (plain || size < 1e7) {
    if (size >= 1e12) return std::nullopt;
    return DateTime{*number, false, true, true};
  }
  if (*number > 0 && *number == std::floor(*number) && *number < 1e15) {
    const std::string digits = std::to_string(static_cast<std::int64_t>(*number));
    if (digits.size() == 8 || digits.size() == 12 || digits.size() == 14)
      if (const auto date = parse_date(digits, order)) return date;
    if (digits.size() == 10 && *number >= kFirstHourDigits && *number < kLastHourDigits)
      if (const auto date = parse_date(digits + "00", order)) return date;
  }
  if (size < 1e8) return DateTime{*number, false, true, true};
  if (size < 1e11) return DateTime{*number, true, true, true};
  if (size < 1e15) return DateTime{*number / 1000, true, true, true};
  return std::nullopt;
}

std::optional<DateTime> find_date(std::string_view text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (!is_digit(text[i]) || (i > 0 && is_digit(text[i - 1]))) continue;
    Scanner scan(text.substr(i));
    const std::size_t digits = scan.digits_ahead();
    if (digits != 4 && digits != 8 && digits != 12 && digits != 14) continue;
    const auto day = scan_day(scan, DateOrder::kMonthFirst);
    if (!day || !scan.good()) continue;
    if (digits == 4 && scan.digits_ahead() > 0) continue;
    DateTime result{day->start, true, false, false, false, {}};
    Scanner behind = scan;
    behind.skip_any("T _,-");
    if (const auto time = scan_time_of_day(behind); time && behind.digits_ahead() == 0) {
      result.value += *time;
      result.time_of_day = true;
      if (behind.skip_word("Z") || behind.skip_word("UTC")) result.zone = true;
    }
    return result;
  }
  return std::nullopt;
}

std::optional<double> parse_time_of_day(std::string_view text) {
  const std::string whole = plain_spaces(text);
  // 904 and 4 as numbers are what is left of 0904 and 0004.
  std::string padded = whole;
  if (!whole.empty() && whole.size() < 4 &&
      whole.find_first_not_of("0123456789") == std::string_view::npos)
    padded.insert(0, 4 - whole.size(), '0');
  Scanner scan(padded);
  const auto time = scan_time_of_day(scan);
  return scan.good() && scan.at_end() ? time : std::nullopt;
}

}  // namespace skein::environment
