// SPDX-License-Identifier: Apache-2.0
#include "skein/exchange/table/text_shown.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>

#include "skein/base/math.h"
#include "skein/base/shown_text.h"
#include "skein/geo/vec.h"

namespace skein::exchange {
namespace {

constexpr double kDay = 86400, kInDays = 100 * 3600.0, kLongest = 1e5 * kDay;  // [s]

}  // namespace

std::string escaped(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    const char c = text.front();
    if (length == 0)
      out += '?';
    else if (length > 1)
      out += text.substr(0, length);
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '&')
      out += "&amp;";
    else if (c == '"')
      out += "&quot;";
    else
      out += static_cast<unsigned char>(c) < 0x20 || c == 0x7F ? ' ' : c;
    text.remove_prefix(length == 0 ? 1 : length);
  }
  return out;
}

std::string shown_tenths(double value) {
  // + 0.0: a zero without a minus sign.
  return fmt::format("{:.1f}", std::round(value * 10) / 10 + 0.0);
}

std::string shown_bearing(double angle) {
  const double tenths = std::round(geo::degrees(geo::wrap_2pi(angle)) * 10);
  return shown_tenths(tenths >= 3600 ? 0 : tenths / 10);
}

std::string shown_length(double metres) {
  if (std::abs(metres) < 1000) return fmt::format("{:.0f} m", metres);
  return fmt::format("{:.5g} km", metres / 1000);
}

std::string shown_time(double seconds) {
  if (std::abs(seconds) < 100) return fmt::format("{:.2f} s", seconds);
  const char* const sign = seconds < 0 ? "-" : "";
  const double tenths = std::round(std::abs(seconds) * 10) / 10;
  if (tenths < 3600)
    return fmt::format("{}{:.0f} min {:.1f} s", sign, std::floor(tenths / 60),
                       std::fmod(tenths, 60));
  if (tenths >= kLongest) return fmt::format("{}over {:.0f} days", sign, kLongest / kDay);
  if (tenths >= kInDays) return fmt::format("{}{:.1f} days", sign, tenths / kDay);
  const double whole = std::round(tenths);
  return fmt::format("{}{:.0f} h {:.0f} min {:.0f} s", sign, std::floor(whole / 3600),
                     std::floor(std::fmod(whole, 3600) / 60), std::fmod(whole, 60));
}

std::string shown_time_below(double seconds) {
  double digit = 0.01;
  if (seconds >= 100) digit = 0.1;
  if (seconds >= 3600) digit = 1;
  if (seconds >= kInDays) digit = kDay / 10;
  return shown_time(std::floor(seconds / digit) * digit);
}

std::string shown_clock(double seconds) {
  if (std::abs(seconds) >= kInDays) return shown_time(seconds);
  if (std::abs(seconds) < 59.5) return fmt::format("{:.0f} s", seconds);
  const double whole = std::round(std::abs(seconds));
  const char* const sign = seconds < 0 ? "-" : "";
  const double minutes = std::floor(whole / 60), rest = std::fmod(whole, 60);
  if (whole < 3600) return fmt::format("{}{:.0f}:{:02.0f}", sign, minutes, rest);
  return fmt::format("{}{:.0f}:{:02.0f}:{:02.0f}", sign, std::floor(minutes / 60),
                     std::fmod(minutes, 60), rest);
}

double round_below(double value) {
  const double power = math::pow(10, std::floor(math::log10(value)));
  const double lead = value / power;
  return power * (lead >= 5 ? 5 : lead >= 2 ? 2 : 1);
}

}  // namespace skein::exchange
