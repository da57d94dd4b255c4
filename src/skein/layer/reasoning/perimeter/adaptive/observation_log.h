// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <variant>
#include <vector>

#include "skein/data/perimeter/fire.h"

namespace skein::perimeter {

/// What an estimator learned from: a reading, or the crossing that its later reading
/// completed.
using Observation = std::variant<FireReading, Crossing>;

/// All observations so far, in order. Copies share what is old, so that they stay cheap.
class ObservationLog {
 public:
  void add(const Observation& observation);
  std::size_t size() const { return kChunk * full_.size() + open_.size(); }
  /// Number `index`, below size().
  const Observation& at(std::size_t index) const;

 private:
  static constexpr std::size_t kChunk = 512;
  std::vector<std::shared_ptr<const std::vector<Observation>>> full_;
  std::vector<Observation> open_;
};

}  // namespace skein::perimeter
