// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>

#include "skein/base/replay_window.h"
#include "skein/base/time.h"

namespace skein::modem {

/// Which session of an origin counts when it begins another one.
enum class SessionRule : std::uint8_t {
  kFirst,  ///< the present one while it is heard: anybody may have made up the other
  kNewest  ///< the one with the largest number, for good: nobody can make one up
};

/// Tells what has come before from what is new, by origin, its session and number.
///
/// Of each origin the last 64 numbers are known; what is older counts as known. It holds
/// as many origins as it is asked about: ask about known ones only, and forget those that
/// are lost.
class Duplicates {
 public:
  /// @param patience  of kFirst: after so long in silence a session is over
  Duplicates(SessionRule rule, Time patience) : rule_(rule), patience_(patience) {}

  /// Whether this is heard for the first time, in a session that counts.
  bool is_new(std::uint32_t origin, std::uint64_t session, std::uint64_t number,
              Time now);

  /// An origin is not heard any more. Of kNewest its session is remembered: what was
  /// recorded of an older one never counts again.
  void lost(std::uint32_t origin);

 private:
  struct Origin {
    std::uint64_t session = 0;
    ReplayWindow numbers;
    Time heard;
  };

  bool begins(const Origin& known, std::uint64_t session, Time now) const;

  SessionRule rule_;
  Time patience_;
  std::map<std::uint32_t, Origin> origins_;
};

}  // namespace skein::modem
