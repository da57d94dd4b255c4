// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "skein/layer/reasoning/avoidance/pairwise/pair_negotiation.h"

// What several parts of the separator count with.

namespace skein::reasoning {

/// Names a negotiation in a PlanReport.
inline std::uint32_t code_of(const NegotiationName& name) {
  return name.opener.value << 16 | (name.number & 0xffffu);
}

inline constexpr double kAgentStep = 1;     ///< agents answer so late at most [s]
inline constexpr double kOpenAgain = 2;     ///< after a failure, or somebody was busy [s]
inline constexpr double kAskAnyway = 5;     ///< whose turn it is not, after that [s]
inline constexpr double kRejoinsAfter = 2;  ///< a conflict, at least [s]
inline constexpr double kClearTime = 5;     ///< that two are apart until it is over [s]

}  // namespace skein::reasoning
