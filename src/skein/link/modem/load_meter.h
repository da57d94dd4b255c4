// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "skein/base/time.h"

namespace skein::modem {

/// How full the air of a modem is, by what it has heard and sent in the last second:
///
///   load = bits in the last ten whole tenths of a second / (rate 1 s), at most 1
///
/// Valid: one sends at a time, at the same rate; what the modem does not hand on (heads,
/// acknowledgements, what it could not read) is not counted.
class LoadMeter {
 public:
  /// @param rate  that the modem can carry [bit/s]; 0: not known, and no load
  explicit LoadMeter(double rate) : rate_(rate) {}

  void add(std::size_t bytes, Time now);

  /// 0 to 1.
  double load(Time now) const;

 private:
  struct Tenth {
    std::int64_t number = -1;  // since the beginning of time
    double bits = 0;
  };

  double rate_;
  std::array<Tenth, 11> tenths_;  // the present one, and those that count
};

}  // namespace skein::modem
