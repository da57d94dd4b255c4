// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <charconv>
#include <cstdint>
#include <string>

namespace skein::app {

/// A finite number within bounds. (CLI::Range takes what is not a number for being
/// within.)
inline CLI::Validator number_in(double low, double high) {
  const std::string range = fmt::format("a number from {:g} to {:g}", low, high);
  return {[low, high, range](std::string& text) {
            double value = 0;
            const bool good =
                CLI::detail::lexical_cast(text, value) && value >= low && value <= high;
            return good ? std::string() : fmt::format("{} is not {}", text, range);
          },
          range};
}

/// A seed. (CLI11 takes -4, and what is too large, for the largest whole number.)
inline CLI::Validator seed_number() {
  return {[](std::string& text) {
            std::uint64_t value = 0;
            const char* end = text.data() + text.size();
            const auto [rest, error] = std::from_chars(text.data(), end, value);
            const bool good = error == std::errc() && rest == end;
            return good ? std::string()
                        : fmt::format("{} is no whole number from 0 on", text);
          },
          "a whole number from 0 on"};
}

}  // namespace skein::app
