// SPDX-License-Identifier: Apache-2.0
#include "skein/data/airspace/zone_set.h"

#include <algorithm>

namespace skein {

bool ZoneSet::take(const ZoneChange& change) {
  if (change.number == 0 || (change.on && error_in(change.zone))) return false;
  if (change.number > complete_to_) beyond_.insert(change.number);
  while (!beyond_.empty() && *beyond_.begin() == complete_to_ + 1) {
    ++complete_to_;
    beyond_.erase(beyond_.begin());
  }
  std::uint32_t& newest = newest_[change.zone.name];
  if (change.number <= newest) return false;
  newest = change.number;
  const auto known = std::find_if(zones_.begin(), zones_.end(), [&](const Zone& zone) {
    return zone.name == change.zone.name;
  });
  if (change.on && known != zones_.end())
    *known = change.zone;
  else if (change.on)
    zones_.push_back(change.zone);
  else if (known != zones_.end())
    zones_.erase(known);
  else
    return false;
  return true;
}

}  // namespace skein
