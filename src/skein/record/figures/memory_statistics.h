// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>

#include "skein/data/event/event.h"
#include "skein/data/perimeter/observation.h"

namespace skein::record {

/// Who takes part, and what the server knew of the physical world: the part of a run's
/// key figures that is about mixed reality. A purely simulated run has none.
class MemoryStatistics {
 public:
  void entity(const EntityReality& entity);
  void physical_object() { ++objects_; }
  void observation(ObservationFate fate) { ++fates_[static_cast<std::size_t>(fate)]; }
  void event(const Event& event);

  /// Adds, where somebody is not purely simulated, how many aircraft there are of each
  /// class: `aircraft_pure_real`, `aircraft_real_mixed`...; where objects are physical
  /// `physical_objects`, `memory_observations` (that were taken in), `memory_late`,
  /// `memory_refused`, `memory_forgotten`, `non_actual_observations` and
  /// `unknown_object_interactions`.
  void add_figures(std::map<std::string, double>& figures) const;

 private:
  std::map<std::string, std::uint64_t> classes_;
  std::uint64_t objects_ = 0, non_actual_ = 0, interactions_ = 0;
  std::array<std::uint64_t, kObservationFates> fates_{};
};

}  // namespace skein::record
