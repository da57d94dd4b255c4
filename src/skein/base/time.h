// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <compare>
#include <cstdint>

namespace skein {

/// A point on the run's clock, or the span between two: integer nanoseconds since the
/// run's start. Integer, so that adding steps never drifts.
class Time {
 public:
  constexpr Time() = default;
  static constexpr Time from_ns(std::int64_t ns) { return Time(ns); }
  /// Rounds to the nearest nanosecond; |seconds| must stay below 9.2e9.
  static Time from_seconds(double seconds) { return Time(std::llround(seconds * 1e9)); }

  constexpr std::int64_t ns() const { return ns_; }
  constexpr double seconds() const { return static_cast<double>(ns_) / 1e9; }

  friend constexpr auto operator<=>(Time, Time) = default;
  friend constexpr Time operator+(Time a, Time b) { return Time(a.ns_ + b.ns_); }
  friend constexpr Time operator-(Time a, Time b) { return Time(a.ns_ - b.ns_); }
  friend constexpr Time operator*(Time a, std::int64_t n) { return Time(a.ns_ * n); }
  constexpr Time& operator+=(Time other) {
    ns_ += other.ns_;
    return *this;
  }

 private:
  explicit constexpr Time(std::int64_t ns) : ns_(ns) {}
  std::int64_t ns_ = 0;
};

}  // namespace skein
