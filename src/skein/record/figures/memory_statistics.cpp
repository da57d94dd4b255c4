// SPDX-License-Identifier: Apache-2.0
#include "skein/record/figures/memory_statistics.h"

#include <algorithm>

namespace skein::record {

void MemoryStatistics::entity(const EntityReality& entity) {
  if (entity.interaction == Reality::kNone) return;
  std::string name(class_of(entity));
  std::replace(name.begin(), name.end(), '-', '_');
  ++classes_[name];
}

void MemoryStatistics::event(const Event& event) {
  if (event.kind == EventKind::kNonActualObservation) ++non_actual_;
  if (event.kind == EventKind::kUnknownObjectInteraction) ++interactions_;
}

void MemoryStatistics::add_figures(std::map<std::string, double>& figures) const {
  const auto put = [&figures](const std::string& name, std::uint64_t count) {
    figures[name] = static_cast<double>(count);
  };
  const bool mixed = classes_.size() > 1 || (classes_.size() == 1 &&
                                             classes_.begin()->first != "pure_simulated");
  if (mixed)
    for (const auto& [name, count] : classes_) put("aircraft_" + name, count);
  if (objects_ == 0) return;
  const auto count = [this](ObservationFate fate) {
    return fates_[static_cast<std::size_t>(fate)];
  };
  put("physical_objects", objects_);
  put("memory_observations", count(ObservationFate::kRemembered));
  put("memory_late", count(ObservationFate::kLate));
  put("memory_refused", count(ObservationFate::kRefused));
  put("memory_forgotten",
      count(ObservationFate::kExpired) + count(ObservationFate::kNotFound));
  put("non_actual_observations", non_actual_);
  put("unknown_object_interactions", interactions_);
}

}  // namespace skein::record
