#pragma once

#include <fmt/format.h>
#include <CLI/CLI.hpp>
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

}  // namespace skein::app
