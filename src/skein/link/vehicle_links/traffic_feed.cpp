// SPDX-License-Identifier: Apache-2.0
#include "skein/link/vehicle_links/traffic_feed.h"

namespace skein::vehicle_links {

TrafficFeed::TrafficFeed(VehicleLinks& links, const std::vector<std::string>& names)
    : links_(links) {
  for (const std::string& name : names) numbers_[name] = links.add_traffic(name);
}

void TrafficFeed::hear(const EntityRecord& record) {
  const auto known = numbers_.find(record.name);
  if (known != numbers_.end()) by_entity_[record.id] = known->second;
}

void TrafficFeed::hear(const EstimateRecord& record) {
  const auto known = by_entity_.find(record.id);
  if (known != by_entity_.end())
    where_.push_back({Time(), known->second, record.nav.p_N, record.nav.v_N});
}

void TrafficFeed::publish(Time time) {
  if (where_.empty()) return;
  for (SimulatedTraffic& each : where_) each.time = time;
  links_.update_traffic(where_);
  where_.clear();
}

}  // namespace skein::vehicle_links
