// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/communication/neighbours.h"

#include <algorithm>

namespace skein::communication {

void Neighbours::hear(NodeIndex node, NodeIndex other, Time now,
                      std::vector<Change>& changes) {
  auto& entries = heard_[node];
  const auto place = std::lower_bound(
      entries.begin(), entries.end(), other,
      [](const Entry& entry, NodeIndex who) { return entry.other < who; });
  if (place != entries.end() && place->other == other) {
    place->last = now;
    return;
  }
  entries.insert(place, {other, now});
  changes.push_back({node, other, true});
}

void Neighbours::step(Time now, std::vector<Change>& changes) {
  for (NodeIndex node = 0; node < heard_.size(); ++node)
    std::erase_if(heard_[node], [&](const Entry& entry) {
      if (now - entry.last <= patience_) return false;
      changes.push_back({node, entry.other, false});
      return true;
    });
}

bool Neighbours::has(NodeIndex node, NodeIndex other, Time now) const {
  const auto& entries = heard_[node];
  const auto place = std::lower_bound(
      entries.begin(), entries.end(), other,
      [](const Entry& entry, NodeIndex who) { return entry.other < who; });
  return place != entries.end() && place->other == other &&
         now - place->last <= patience_;
}

}  // namespace skein::communication
