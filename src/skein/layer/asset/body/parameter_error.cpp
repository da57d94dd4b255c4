// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/asset/body/parameter_error.h"

#include <fmt/format.h>

#include <cmath>

namespace skein::asset {

void ParameterCheck::add(std::string_view key, std::string message) {
  errors_.push_back({std::string(key), std::move(message)});
}

void ParameterCheck::above(std::string_view key, double value, double low) {
  require(value > low, key, value, fmt::format("must be above {}", low));
}

void ParameterCheck::at_least(std::string_view key, double value, double low) {
  require(value >= low, key, value, fmt::format("must be at least {}", low));
}

void ParameterCheck::within(std::string_view key, double value, double low, double high) {
  require(value >= low && value <= high, key, value,
          fmt::format("must be within {} and {}", low, high));
}

void ParameterCheck::require(bool holds, std::string_view key, double value,
                             std::string_view rule) {
  if (!std::isfinite(value))
    add(key, fmt::format("{} is no number to fly with", value));
  else if (!holds)
    add(key, fmt::format("{} {}", value, rule));
}

void ParameterCheck::inertia(std::string_view key, const Inertia& inertia) {
  if (inertia.possible()) return;
  add(key, fmt::format("moments {}, {}, {} and products {}, {}, {} of no body: must be "
                       "positive definite, and no principal moment may be larger than "
                       "the sum of the other two",
                       inertia.xx, inertia.yy, inertia.zz, inertia.xy, inertia.xz,
                       inertia.yz));
}

void ParameterCheck::part(std::string_view key,
                          const std::vector<ParameterError>& errors) {
  for (const ParameterError& error : errors)
    errors_.push_back({fmt::format("{}.{}", key, error.key), error.message});
}

}  // namespace skein::asset
