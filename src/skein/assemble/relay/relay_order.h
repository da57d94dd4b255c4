// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "skein/base/result.h"
#include "skein/base/time.h"
#include "skein/link/impairment/impairment.h"

namespace skein::assemble {

/// What somebody asks of a relay while it runs.
struct RelayOrder {
  enum class Kind : std::uint8_t {
    kChange,  ///< of the impairment
    kOutage,  ///< for a while
    kReset,   ///< back to the profile
    kStatistics,
  };
  Kind kind = Kind::kStatistics;
  impairment::Directions directions = impairment::Directions::kBoth;
  impairment::ImpairmentChange change;
  Time length;  ///< of the outage
};

/// Reads a line:
///
///   KEY VALUE [to-a|to-b]        a key of a profile, such as `loss 0.3`
///   outage SECONDS [to-a|to-b]
///   reset
///   stats
///
/// Fails: kBadInput, with what is wrong and what is allowed.
Result<RelayOrder> parse_relay_order(std::string_view line);

}  // namespace skein::assemble
