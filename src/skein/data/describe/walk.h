// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <variant>

#include "skein/base/time.h"
#include "skein/data/airspace/zone.h"
#include "skein/data/describe/describe.h"
#include "skein/data/describe/type_traits.h"
#include "skein/data/vehicle/flight_plan.h"
#include "skein/geo/rotation.h"
#include "skein/geo/vec.h"

/// What is done to all parts of described values, by their descriptions.
namespace skein::walk {

/// Calls `visit(part)` for the parts of a value that it takes by reference, whole ones
/// first, and looks into the others.
template <class T, class Visit>
void parts(T& value, Visit& visit) {
  using namespace type_traits;  // NOLINT: the traits are ours
  if constexpr (std::is_invocable_v<Visit&, T&>) {
    visit(value);
  } else if constexpr (Described<T>) {
    for_each_field<T>([&](const auto& f) { parts(value.*f.member, visit); });
  } else if constexpr (kIsOptional<T>) {
    if (value) parts(*value, visit);
  } else if constexpr (kIsVector<T> || kIsArray<T>) {
    for (auto& item : value) parts(item, visit);
  } else if constexpr (kIsVariant<T>) {
    std::visit([&](auto& chosen) { parts(chosen, visit); }, value);
  }
}

/// The sum, or the nearest time there is.
inline Time saturated_sum(Time a, Time b) {
  std::int64_t sum = 0;
  if (!__builtin_add_overflow(a.ns(), b.ns(), &sum)) return Time::from_ns(sum);
  return Time::from_ns(a.ns() > 0 ? std::numeric_limits<std::int64_t>::max()
                                  : std::numeric_limits<std::int64_t>::min());
}

/// Moves all points in time of a value from one clock to another.
/// @param by  what the other clock shows more.
template <class T>
void shift_times(T& value, Time by) {
  struct Shift {
    Time by;
    void operator()(Time& time) const { time = saturated_sum(time, by); }
    void operator()(Zone& zone) const {
      zone.from += by.seconds();
      zone.until += by.seconds();
    }
    void operator()(FlightElement& element) const { element.start += by.seconds(); }
  } shift{by};
  parts(value, shift);
}

/// Whether a value that came from outside has no number that is none, and no vector that
/// is not finite. Single numbers may be infinite: limits, deviations.
template <class T>
bool has_sound_numbers(T& value) {
  struct Look {
    bool sound = true;
    void operator()(double& number) { sound = sound && !std::isnan(number); }
    void operator()(Vec2& vector) { sound = sound && vector.allFinite(); }
    void operator()(Vec3& vector) { sound = sound && vector.allFinite(); }
    void operator()(Quat& turn) {
      sound =
          sound && turn.coeffs().allFinite() && std::abs(turn.squaredNorm() - 1) < 1e-3;
    }
  } look;
  parts(value, look);
  return look.sound;
}

}  // namespace skein::walk
