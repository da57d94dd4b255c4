// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "skein/data/perimeter/observation.h"

namespace skein::mixed {

/// The newest observation of each physical object.
///
/// Only physical sensors refresh it. It is by the time of the picture that one is newer
/// than another, not by when it comes in. What is forgotten is as if it had never been
/// seen, but by a picture that is newer than the one which made it be forgotten.
/// Reference: [Selecky18] section 5.2, models of non-actual observations.
class ObservationMemory {
 public:
  struct Entry {
    Observation observation;
    Time since;             ///< when it came in
    int looks_in_vain = 0;  ///< one after the other
  };

  explicit ObservationMemory(ForgettingRules rules) : rules_(std::move(rules)) {}

  /// @param now  when it comes in.
  /// @returns kRemembered, kLate or kRefused.
  ObservationFate add(const Observation& observation, Time now);

  /// A physical sensor looked at the remembered place at `time` and did not find the
  /// object. Nothing when it is not remembered, or was seen then or later.
  /// @returns whether it is not there any more as of this look: the last of as many as
  ///          its class needs. The logical model has forgotten it then.
  bool look_in_vain(std::uint32_t object, Time time);

  /// Temporal model: forgets what is older at `now` than its class may be.
  /// @returns what it was, in order of objects.
  std::vector<Observation> expire(Time now);

  /// What is remembered of an object; null: nothing.
  const Entry* find(std::uint32_t object) const;

  /// All that is remembered, by object.
  const std::map<std::uint32_t, Entry>& entries() const { return entries_; }

  const ForgettingRules& rules() const { return rules_; }

 private:
  void forget(std::uint32_t object, Time time);

  ForgettingRules rules_;
  std::map<std::uint32_t, Entry> entries_;
  std::map<std::uint32_t, Time> forgotten_;  // older pictures say nothing any more
};

}  // namespace skein::mixed
