// SPDX-License-Identifier: Apache-2.0
#include "skein/record/figures/alert_statistics.h"

#include <algorithm>

namespace skein::record {

void AlertStatistics::alert(const AlertRecord& record) {
  tracked_ = true;
  Alerted& alerted = alerted_[{record.id, record.value.track}];
  if (alerted.level == 0 && record.value.level > 0) {
    alerts_ += 1;
    alerted.since = record.time;
  } else if (alerted.level > 0 && record.value.level == 0) {
    lasted_ += (record.time - alerted.since).seconds();
  }
  alerted.level = record.value.level;
  level_max_ = std::max(level_max_, static_cast<double>(record.value.level));
}

void AlertStatistics::recommendation(const RecommendationRecord& record) {
  const std::pair which{record.id, record.value.number};
  switch (record.value.state) {
    case RecommendationState::kShown:
      shown_.insert(which);
      break;
    case RecommendationState::kFollowed:
      if (followed_.insert(which).second) followed_at_[record.id].push_back(record.time);
      break;
    case RecommendationState::kIgnored:
      ignored_.insert(which);
      break;
    case RecommendationState::kOver:
      break;
  }
}

void AlertStatistics::conflict(const ConflictRecord& record) {
  const auto followed = followed_at_.find(record.id);
  if (followed == followed_at_.end()) return;
  // The last path that was taken before the two would have met solved it.
  std::optional<Time> last;
  for (const Time time : followed->second)
    if (time >= record.value.seen && time <= record.value.meets) last = time;
  if (!last) return;
  const double before = (record.value.meets - *last).seconds();
  followed_before_ = std::min(followed_before_.value_or(before), before);
}

void AlertStatistics::add_figures(std::map<std::string, double>& figures) const {
  if (tracked_) {
    figures["traffic_alerts"] = alerts_;
    figures["traffic_alert_level_max"] = level_max_;
    figures["traffic_alert_s"] = lasted_;
  }
  if (!shown_.empty()) {
    figures["recommendations"] = static_cast<double>(shown_.size());
    figures["recommendations_followed"] = static_cast<double>(followed_.size());
    figures["recommendations_ignored"] = static_cast<double>(ignored_.size());
  }
  if (followed_before_)
    figures["recommendation_followed_before_min_s"] = *followed_before_;
}

}  // namespace skein::record
