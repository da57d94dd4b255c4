// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/environment/raster/date_column.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>

namespace skein::environment {
namespace {

constexpr double kDay = 86400;                                   // [s]
constexpr double kFirstSerial = 36526, kLastSerial = 55153;      // 2000 to 2050
constexpr double kSerialOf1970 = 25569;                          // days from 1899-12-30
constexpr double kEarliest = -2208816000, kLatest = 7258118400;  // 1900-01-03, 2200
constexpr double kLargestZone = 14 * 3600;                       // [s]
constexpr double kQuarter = 900;  // [s], zones differ by it

using Times = std::vector<std::optional<DateTime>>;

// A moment that programs write where they have none.
bool is_null_date(const DateTime& time) {
  if (!time.utc) return false;
  return time.value < kEarliest || time.value >= kLatest ||
         (std::abs(time.value) <= kLargestZone &&
          std::remainder(time.value, kQuarter) == 0);
}

// The texts read in one order.
struct Reading {
  DateOrder order = DateOrder::kMonthFirst;
  Times times;
  std::size_t wrong = 0, null_count = 0;
  std::optional<std::size_t> first_wrong, first_null;
  double low = std::numeric_limits<double>::infinity(), high = -low;

  double span() const { return high >= low ? high - low : 0; }
};

Reading read_in(DateOrder order, std::span<const std::string> texts,
                const DateColumnOptions& options) {
  Reading reading;
  reading.order = order;
  for (std::size_t i = 0; i < texts.size(); ++i) {
    auto& time = reading.times.emplace_back();
    if (means_none(texts[i])) continue;
    time = options.numbers ? parse_date_or_number(texts[i], order, options.plain_seconds)
                           : parse_date(texts[i], order);
    if (!time) {
      if (reading.wrong++ == 0) reading.first_wrong = i;
      continue;
    }
    if (is_null_date(*time)) {
      if (reading.null_count++ == 0) reading.first_null = i;
      time.reset();
    } else if (time->utc) {
      reading.low = std::min(reading.low, time->value);
      reading.high = std::max(reading.high, time->value);
    }
  }
  return reading;
}

bool alike(const Reading& a, const Reading& b) {
  for (std::size_t i = 0; i < a.times.size(); ++i)
    if (a.times[i].has_value() != b.times[i].has_value() ||
        (a.times[i] && a.times[i]->value != b.times[i]->value))
      return false;
  return true;
}

const char* order_text(DateOrder order) {
  switch (order) {
    case DateOrder::kMonthFirst:
      return "the month stands before the day";
    case DateOrder::kDayFirst:
      return "the day stands before the month";
    case DateOrder::kYearFirst:
      break;
  }
  return "the year stands first";
}

// Why `best` was taken of `all`; empty when every order says the same.
std::string reason_for(const Reading& best, const std::vector<Reading>& all,
                       std::span<const std::string> texts, const std::string& name) {
  bool open = false, tied = false;
  std::optional<std::size_t> shown_by;
  for (const Reading& other : all) {
    if (other.order == best.order || alike(best, other)) continue;
    // Years with four digits never stand first: that order shows nothing.
    if (other.wrong > best.wrong) {
      if (other.order != DateOrder::kYearFirst && !shown_by) shown_by = other.first_wrong;
      continue;
    }
    open = true;
    tied = tied || other.span() == best.span();
  }
  const std::string order = fmt::format("in {} {}", name, order_text(best.order));
  if (tied) return order + " (else give date_order)";
  if (open)
    return order +
           ": the order in which all times lie closest together (else give "
           "date_order)";
  if (shown_by) return fmt::format("{}, as \"{}\" shows", order, texts[*shown_by]);
  return {};
}

// Numbers that are days of a spreadsheet, or a year and the day in it.
std::optional<DateTime> serial_day(double number) {
  if (!(number >= kFirstSerial && number < kLastSerial)) return std::nullopt;
  const double seconds = std::round((number - kSerialOf1970) * kDay);
  return DateTime{seconds, true, std::floor(number) != number, false, false, {}};
}

std::optional<DateTime> ordinal_day(double number) {
  const double year = std::floor(number / 1000), day = number - 1000 * year;
  if (number != std::floor(number) || year < 1980 || year > 2100 || day < 1 || day > 366)
    return std::nullopt;
  const auto first = parse_utc(fmt::format("{:04.0f}-01-01", year));
  if (!first) return std::nullopt;
  return DateTime{*first + (day - 1) * kDay, true, false, false, false, {}};
}

// Reads all plain numbers anew if every one of them has a meaning.
bool convert_all(Times& times, std::optional<DateTime> (*meaning)(double)) {
  Times converted = times;
  bool any = false;
  for (auto& time : converted) {
    if (!time) continue;
    if (time->utc) return false;
    time = meaning(time->value);
    if (!time) return false;
    any = true;
  }
  if (any) times = std::move(converted);
  return any;
}

// The numbers 0 and -1 among dates are none.
void drop_numbers_among_dates(Reading& reading) {
  const bool dates = std::any_of(reading.times.begin(), reading.times.end(),
                                 [](const auto& t) { return t && t->utc; });
  if (!dates) return;
  for (std::size_t i = 0; i < reading.times.size(); ++i) {
    auto& time = reading.times[i];
    if (!time || time->utc || (time->value != 0 && time->value != -1)) continue;
    if (reading.null_count++ == 0 || i < *reading.first_null) reading.first_null = i;
    time.reset();
  }
}

}  // namespace

bool means_none(std::string_view text) {
  std::string word = plain_spaces(text);
  std::transform(word.begin(), word.end(), word.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  constexpr std::array<std::string_view, 16> kWords = {
      "",  "null", "<null>", "(null)",  "none", "nan", "nat", "na",
      "-", "n/a",  "#n/a",   "unknown", "--",   "---", "nil", "?"};
  return std::find(kWords.begin(), kWords.end(), word) != kWords.end() ||
         word.starts_with("0000-00-00") || word.starts_with("00/00/0000");
}

void add_once(std::vector<std::string>& lines, const std::vector<std::string>& fresh) {
  for (const std::string& line : fresh)
    if (std::find(lines.begin(), lines.end(), line) == lines.end()) lines.push_back(line);
}

DateColumn read_date_column(std::span<const std::string> texts, const std::string& name,
                            const DateColumnOptions& options) {
  std::vector<Reading> readings;
  if (options.order) {
    readings.push_back(read_in(*options.order, texts, options));
  } else {
    for (const DateOrder order :
         {DateOrder::kMonthFirst, DateOrder::kDayFirst, DateOrder::kYearFirst})
      readings.push_back(read_in(order, texts, options));
  }
  const auto best_at = std::min_element(
      readings.begin(), readings.end(), [](const Reading& a, const Reading& b) {
        return a.wrong != b.wrong ? a.wrong < b.wrong : a.span() < b.span();
      });
  DateColumn column;
  const std::string reason = reason_for(*best_at, readings, texts, name);
  if (!reason.empty()) column.understood.push_back(reason);
  Reading best = std::move(*best_at);
  drop_numbers_among_dates(best);
  if (!options.plain_seconds) {
    if (convert_all(best.times, serial_day))
      column.understood.push_back(fmt::format(
          "numbers in {} are days of a spreadsheet (44444 is 2021-09-05)", name));
    else if (convert_all(best.times, ordinal_day))
      column.understood.push_back(
          fmt::format("numbers in {} are a year and the day in it", name));
  }
  for (const auto& time : best.times) {
    if (!time) continue;
    if (time->short_year)
      add_once(column.understood,
               {fmt::format("years of two digits in {} are 1969 to 2068", name)});
    if (!time->zone_name.empty())
      add_once(column.understood, {"the zone " + time->zone_name});
  }
  column.times = std::move(best.times);
  column.wrong = best.first_wrong;
  column.wrong_count = best.wrong;
  column.null_count = best.null_count;
  if (best.first_null) column.first_null = texts[*best.first_null];
  return column;
}

}  // namespace skein::environment
