// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "skein/layer/asset/body/rigid_body.h"

namespace skein::asset {

/// A parameter that no such aircraft can have.
struct ParameterError {
  std::string key;      ///< the member's name, with dots and [i] for members of members
  std::string message;  ///< what was found and the rule, without the key
};

/// Gathers what is wrong with the parameters of one model: every struct XParameters of
/// this layer has a function `std::vector<ParameterError> faults(const XParameters&)`.
/// No number that is not finite passes any of the rules.
class ParameterCheck {
 public:
  void above(std::string_view key, double value, double low);
  void at_least(std::string_view key, double value, double low);
  void within(std::string_view key, double value, double low, double high);

  /// `rule` says what must hold, as in "must be above the stall speed, 9 m/s".
  void require(bool holds, std::string_view key, double value, std::string_view rule);

  /// An inertia that some body has.
  void inertia(std::string_view key, const Inertia& inertia);

  /// Takes over what is wrong with a part; its keys get `key` and a dot in front.
  void part(std::string_view key, const std::vector<ParameterError>& errors);

  std::vector<ParameterError> take() { return std::move(errors_); }

 private:
  void add(std::string_view key, std::string message);

  std::vector<ParameterError> errors_;
};

/// What checks `void(ParameterCheck&, const Parameters&)` find, one after the other: a
/// check may rely on what those before it have found nothing wrong with.
template <class Parameters, class... Check>
std::vector<ParameterError> found_by(const Parameters& parameters, Check... checks) {
  std::vector<ParameterError> found;
  const auto make = [&](auto check) {
    if (!found.empty()) return;
    ParameterCheck gathered;
    check(gathered, parameters);
    found = gathered.take();
  };
  (make(checks), ...);
  return found;
}

}  // namespace skein::asset
