// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "skein/base/time.h"

namespace skein::simulation {

/// What an autopilot refuses may come again at every order: each reason is reported at
/// once, then once a minute at most, with how often it came meanwhile. Reasons that
/// differ in their numbers only count as one.
class Refusals {
 public:
  /// @param count   refusals since the last call, at least one.
  /// @param reason  of the last of them.
  /// @returns       what to report now, if anything.
  std::optional<std::string> report(Time now, int count, std::string_view reason);

 private:
  struct Said {
    Time at;
    int since = 0;  // refusals that were not reported
  };
  std::map<std::string, Said> said_;  // by the reason without its numbers
};

}  // namespace skein::simulation
