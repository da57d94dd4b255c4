#pragma once

// Times that several parts of the separator count with.

namespace skein::reasoning {

inline constexpr double kAgentStep = 1;     ///< agents answer so late at most [s]
inline constexpr double kRejoinsAfter = 2;  ///< a conflict, at least [s]
inline constexpr double kClearTime = 5;     ///< that two are apart until it is over [s]

}  // namespace skein::reasoning
