#include "skein/layer/environment/raster/date_time.h"

#include <algorithm>
#include <cctype>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <string>

#include "skein/layer/environment/raster/csv_table.h"

namespace skein::environment {
namespace {

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
  int fail() {
    good_ = false;
    return 0;
  }

 private:
  std::string_view text_;
  bool good_ = true;
};

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.front())) != 0)
    text.remove_prefix(1);
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back())) != 0)
    text.remove_suffix(1);
  return text;
}

// [s since 1970] of 00:00 of a day; none when there is no such day.
std::optional<double> day_start(int year, int month, int day) {
  const std::chrono::year_month_day date{std::chrono::year(year),
                                         std::chrono::month(static_cast<unsigned>(month)),
                                         std::chrono::day(static_cast<unsigned>(day))};
  if (!date.ok()) return std::nullopt;
  return 86400.0 *
         static_cast<double>(std::chrono::sys_days(date).time_since_epoch().count());
}

std::optional<double> scan_day(Scanner& scan, DateOrder order) {
  const std::size_t digits = scan.digits_ahead();
  if (digits >= 8) {  // 20210905, and maybe 1404 at once behind it
    const int year = scan.number(4, 4), month = scan.number(2, 2);
    if (year < 1900 || year > 2200) return std::nullopt;  // some other number
    return day_start(year, month, scan.number(2, 2));
  }
  const int first = scan.number(1, 4);
  const char mark = scan.front();
  if (mark != '-' && mark != '/' && mark != '.' && mark != '_') return std::nullopt;
  scan.skip(mark);
  const int second = scan.number(1, 2);
  if (!scan.skip(mark)) return std::nullopt;
  if (digits == 4) {
    const int day = scan.number(1, 2);
    return scan.good() ? day_start(first, second, day) : std::nullopt;
  }
  const int year = scan.number(4, 4);
  if (!scan.good() || digits > 2 || mark == '-' || mark == '_') return std::nullopt;
  const bool day_first = mark == '.' || order == DateOrder::kDayFirst;
  return day_start(year, day_first ? second : first, day_first ? first : second);
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
    minute = scan.number(2, 2);
    if (scan.skip(':')) second = scan.number(2, 2);
  }
  if (scan.skip('.')) second += scan.fraction();
  if (!scan.good() || hour > 24 || minute > 59 || second >= 61) return std::nullopt;
  scan.skip_any(" ");
  const bool afternoon = scan.skip_word("PM");
  if (afternoon || scan.skip_word("AM")) {
    if (hour < 1 || hour > 12) return std::nullopt;
    hour = hour % 12 + (afternoon ? 12 : 0);
  }
  return 3600.0 * hour + 60.0 * minute + second;
}

// Offset of the zone [s], east of Greenwich positive; none when there is none.
std::optional<double> scan_zone(Scanner& scan) {
  scan.skip_any(" ");
  if (scan.skip_word("UTC") || scan.skip_word("GMT") || scan.skip_word("Z")) return 0.0;
  const bool west = scan.front() == '-';
  if (!west && scan.front() != '+') return std::nullopt;
  scan.skip(scan.front());
  const int hours = scan.number(2, 2);
  scan.skip(':');
  const int minutes = scan.digits_ahead() > 0 ? scan.number(2, 2) : 0;
  return (west ? -60.0 : 60.0) * (60 * hours + minutes);
}

}  // namespace

std::optional<DateTime> parse_date(std::string_view text, DateOrder order) {
  Scanner scan(trimmed(text));
  const auto day = scan_day(scan, order);
  if (!day || !scan.good()) return std::nullopt;
  DateTime result{*day, true, false, false};
  if (scan.at_end()) return result;
  if (scan.skip_word("Z")) {  // of a date alone, as XML writes it
    result.zone = true;
    return scan.at_end() ? std::optional(result) : std::nullopt;
  }
  if (!scan.skip('T')) scan.skip_any(" _,-");
  const auto time = scan_time_of_day(scan);
  if (!time) return std::nullopt;
  const auto zone = scan_zone(scan);
  if (!scan.good() || !scan.at_end()) return std::nullopt;
  return DateTime{*day + *time - zone.value_or(0), true, true, zone.has_value()};
}

std::optional<double> parse_utc(std::string_view text) {
  const std::string_view whole = trimmed(text);
  if (whole.size() < 10 || whole[4] != '-' || whole[7] != '-') return std::nullopt;
  const auto date = parse_date(whole, DateOrder::kMonthFirst);
  return date ? std::optional(date->value) : std::nullopt;
}

std::optional<DateTime> parse_date_or_number(std::string_view text, DateOrder order,
                                             bool plain) {
  const auto number = parse_number(text);
  if (!number) return parse_date(text, order);
  const double size = std::abs(*number);
  if (plain || size < 1e7) {
    if (size >= 1e12) return std::nullopt;
    return DateTime{*number, false, true, true};
  }
  if (*number > 0 && *number == std::floor(*number) && *number < 1e15) {
    const std::string digits = std::to_string(static_cast<std::int64_t>(*number));
    if (digits.size() == 8 || digits.size() == 12 || digits.size() == 14)
      if (const auto date = parse_date(digits, order)) return date;
  }
  if (size < 1e8) return DateTime{*number, false, true, true};
  if (size < 1e11) return DateTime{*number, true, true, true};
  if (size < 1e14) return DateTime{*number / 1000, true, true, true};
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
    DateTime result{*day, true, false, false};
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
  const std::string_view whole = trimmed(text);
  // 904 and 4 as numbers are what is left of 0904 and 0004.
  std::string padded(whole);
  if (!whole.empty() && whole.size() < 4 &&
      whole.find_first_not_of("0123456789") == std::string_view::npos)
    padded.insert(0, 4 - whole.size(), '0');
  Scanner scan(padded);
  const auto time = scan_time_of_day(scan);
  return scan.good() && scan.at_end() ? time : std::nullopt;
}

bool has_slash_date(std::string_view text) {
  Scanner scan(trimmed(text));
  const std::size_t digits = scan.digits_ahead();
  scan.number(1, 2);
  return scan.good() && digits <= 2 && scan.front() == '/';
}

std::optional<DateOrder> shown_order(std::string_view text) {
  if (!has_slash_date(text)) return std::nullopt;
  Scanner scan(trimmed(text));
  const int first = scan.number(1, 2);
  scan.skip('/');
  const int second = scan.number(1, 2);
  if (!scan.good()) return std::nullopt;
  if (first > 12) return DateOrder::kDayFirst;
  if (second > 12) return DateOrder::kMonthFirst;
  return std::nullopt;
}

}  // namespace skein::environment
