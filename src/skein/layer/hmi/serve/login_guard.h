// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>

namespace skein::hmi {

/// Counts wrong tokens, and says how long each is to wait for its answer: the more
/// of an address, the longer. Who has a right token never waits.
///
/// Not safe for several threads.
class LoginGuard {
 public:
  using Moment = std::chrono::steady_clock::time_point;
  using Duration = std::chrono::milliseconds;

  static constexpr int kFreeTries = 5;        ///< that are answered at once
  static constexpr Duration kFirstWait{250};  ///< doubled with each further one
  static constexpr Duration kMaxWait{8000};
  /// After so long one wrong token of an address is forgotten.
  static constexpr std::chrono::seconds kForgetAfter{30};
  static constexpr std::size_t kMaxAddresses = 4096;  ///< that are remembered

  /// One more from an address group (connection_table.h). @returns how long its answer
  /// waits.
  Duration wrong(const std::string& group, Moment now);

  /// All that there have been.
  std::uint64_t count() const { return count_; }
  /// Of an address, as far as they are remembered.
  int remembered(const std::string& group, Moment now) const;

 private:
  struct Tries {
    int count = 0;
    Moment last{};
  };
  static int left_of(const Tries& tries, Moment now);
  void make_room(Moment now);

  std::map<std::string, Tries> tries_;
  std::uint64_t count_ = 0;
};

}  // namespace skein::hmi
