// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "skein/base/time.h"

namespace skein::vehicle_services {

/// A state that was asked for: it counts as there until the vehicle shows it, or for
/// three seconds in which the simulation moves.
template <class T>
class Expected {
 public:
  void expect(const T& value, Time wall) {
    value_ = value;
    until_ = wall + Time::from_seconds(3);
  }
  void forget() { value_.reset(); }

  /// What the vehicle shows now.
  void see(const T& shown, Time wall, bool paused) {
    if (paused && value_) until_ = wall + Time::from_seconds(3);
    if (value_ == shown || wall >= until_) value_.reset();
  }

  const T& value_or(const T& shown) const { return value_ ? *value_ : shown; }
  bool pending() const { return value_.has_value(); }

 private:
  std::optional<T> value_;
  Time until_;
};

}  // namespace skein::vehicle_services
