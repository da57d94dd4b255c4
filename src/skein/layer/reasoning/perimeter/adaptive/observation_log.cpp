// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/perimeter/adaptive/observation_log.h"

namespace skein::perimeter {

void ObservationLog::add(const Observation& observation) {
  open_.push_back(observation);
  if (open_.size() < kChunk) return;
  full_.push_back(std::make_shared<const std::vector<Observation>>(std::move(open_)));
  open_.clear();
}

const Observation& ObservationLog::at(std::size_t index) const {
  const std::size_t chunk = index / kChunk;
  return chunk < full_.size() ? (*full_[chunk])[index % kChunk] : open_[index % kChunk];
}

}  // namespace skein::perimeter
