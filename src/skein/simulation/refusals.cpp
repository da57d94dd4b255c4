// SPDX-License-Identifier: Apache-2.0
#include "skein/simulation/refusals.h"

#include <fmt/format.h>

namespace skein::simulation {
namespace {

constexpr double kQuiet = 60;  // between two reports of one reason [s]

std::string without_numbers(std::string_view reason) {
  std::string words;
  for (const char c : reason)
    if ((c < '0' || c > '9') && c != '.' && c != '-') words += c;
  return words;
}

}  // namespace

std::optional<std::string> Refusals::report(Time now, int count,
                                            std::string_view reason) {
  const auto [at, first] = said_.try_emplace(without_numbers(reason), Said{now, 0});
  Said& said = at->second;
  const int others = said.since + count - 1;
  if (!first && (now - said.at).seconds() < kQuiet) {
    said.since += count;
    return {};
  }
  said = {now, 0};
  if (others == 0) return std::string(reason);
  return fmt::format("{} (and {} times before)", reason, others);
}

}  // namespace skein::simulation
