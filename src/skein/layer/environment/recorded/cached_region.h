// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mutex>

#include "skein/geo/polygon.h"

namespace skein::environment {

/// A region that is worked out when first asked for after a change, by any thread.
class CachedRegion {
 public:
  /// It has changed. Not while others ask.
  void reset() { known_ = false; }

  /// The region; `make()` is called once after each reset.
  template <class Make>
  const geo::Region& get(Make&& make) const {
    const std::scoped_lock lock(mutex_);
    if (!known_) {
      region_ = make();
      known_ = true;
    }
    return region_;
  }

 private:
  mutable std::mutex mutex_;
  mutable bool known_ = false;
  mutable geo::Region region_;
};

}  // namespace skein::environment
