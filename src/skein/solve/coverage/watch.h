// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

namespace skein::solve {

/// Asked now and then; true ends a search with the best found so far.
using Stop = std::function<bool()>;

/// Somebody who waits for a long search.
struct Watch {
  Stop stop = {};
  /// Given now and then which share of the work is done, 0 to 1, roughly.
  std::function<void(double share)> progress = {};

  bool stopped() const { return stop && stop(); }
  void report(double share) const {
    if (progress) progress(share);
  }
};

}  // namespace skein::solve
