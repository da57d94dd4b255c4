// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace skein {

/// Which counters of a sender a receiver has seen: each is accepted once, in any order
/// within the last 64, none before these.
/// Reference: RFC 4303, 3.4.3, the sliding window of IPsec.
class ReplayWindow {
 public:
  static constexpr std::uint64_t kSize = 64;

  /// Whether `counter` is new; it is seen from now on. 0 never is.
  bool accept(std::uint64_t counter) {
    if (counter > highest_) {
      const std::uint64_t ahead = counter - highest_;
      seen_ = ahead < kSize ? seen_ << ahead | 1U : 1U;
      highest_ = counter;
      return true;
    }
    const std::uint64_t back = highest_ - counter;
    if (counter == 0 || back >= kSize || (seen_ >> back & 1U) != 0) return false;
    seen_ |= std::uint64_t{1} << back;
    return true;
  }

 private:
  std::uint64_t highest_ = 0;
  std::uint64_t seen_ = 0;  // bit k: highest_ - k
};

}  // namespace skein
