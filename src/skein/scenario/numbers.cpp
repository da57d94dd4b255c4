// SPDX-License-Identifier: Apache-2.0
#include "skein/scenario/numbers.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <limits>

#include "skein/geo/vec.h"

namespace skein::scenario {
namespace {

// The text without a leading plus, which from_chars does not know.
std::string_view without_plus(std::string_view text) {
  const bool plus = text.size() > 1 && text[0] == '+' && text[1] != '-' && text[1] != '+';
  return plus ? text.substr(1) : text;
}

template <class Number>
std::optional<Number> parse_whole(std::string_view text) {
  text = without_plus(text);
  Number number{};
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc{} || stop != end) return std::nullopt;
  return number;
}

}  // namespace

std::optional<double> parse_number(std::string_view text) {
  for (const char* word : {".inf", ".Inf", ".INF", "+.inf", "-.inf", "-.Inf", "-.INF"}) {
    if (text == word) return std::numeric_limits<double>::infinity();
  }
  for (const char* word : {".nan", ".NaN", ".NAN"}) {
    if (text == word) return std::numeric_limits<double>::quiet_NaN();
  }
  return parse_whole<double>(text);
}

std::optional<std::int64_t> parse_integer(std::string_view text) {
  return parse_whole<std::int64_t>(text);
}

std::string number_text(double number) {
  return fmt::format("{}", number);
}

std::string seconds_text(Time time) {
  const bool negative = time.ns() < 0;
  const auto ns = static_cast<std::uint64_t>(negative ? -time.ns() : time.ns());
  constexpr std::uint64_t kSecond = 1'000'000'000;
  std::string text = fmt::format("{}{}", negative ? "-" : "", ns / kSecond);
  if (ns % kSecond != 0) {
    std::string fraction = fmt::format("{:09}", ns % kSecond);
    fraction.erase(fraction.find_last_not_of('0') + 1);
    text += "." + fraction;
  }
  return text;
}

std::string degrees_text(double radians) {
  const double guess = geo::degrees(radians);
  const auto fits = [&](const std::string& text) {
    const auto degrees = parse_number(text);
    return degrees && geo::radians(*degrees) == radians;
  };
  for (int digits = 6; digits <= 17; ++digits) {
    std::string text =
        number_text(std::strtod(fmt::format("{:.{}g}", guess, digits).c_str(), nullptr));
    if (fits(text)) return text;
  }
  for (const double end : {-HUGE_VAL, HUGE_VAL}) {
    const std::string text = number_text(std::nextafter(guess, end));
    if (fits(text)) return text;
  }
  return number_text(guess);
}

}  // namespace skein::scenario
