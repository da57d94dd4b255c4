// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "skein/data/event/record.h"

namespace skein::record {

/// Alerts about other traffic, and paths that pilots were shown: the part of a run's key
/// figures that is there as soon as an aircraft tracks intruders, or has a pilot who is
/// shown something.
class AlertStatistics {
 public:
  void belief(const TrafficBelief& belief) { tracked_ |= belief.firm; }
  void alert(const AlertRecord& record);
  void recommendation(const RecommendationRecord& record);
  /// After the recommendations about it.
  void conflict(const ConflictRecord& record);

  /// Adds `traffic_alerts` (that began), `traffic_alert_level_max`, `traffic_alert_s`
  /// (how long each lasted, all of all aircraft together); `recommendations`,
  /// `recommendations_followed`, `recommendations_ignored`, and
  /// `recommendation_followed_before_min_s`: of conflicts with others of the team, the
  /// shortest time between a pilot's following and when the two would have come too near.
  void add_figures(std::map<std::string, double>& figures) const;

 private:
  struct Alerted {
    Time since;
    std::uint32_t level = 0;
  };
  bool tracked_ = false;
  std::map<std::pair<EntityId, std::uint32_t>, Alerted> alerted_;
  double alerts_ = 0, lasted_ = 0, level_max_ = 0;
  std::set<std::pair<EntityId, std::uint32_t>> shown_, followed_, ignored_;
  std::map<EntityId, std::vector<Time>> followed_at_;
  std::optional<double> followed_before_;
};

}  // namespace skein::record
