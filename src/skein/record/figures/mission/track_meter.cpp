// SPDX-License-Identifier: Apache-2.0
#include "skein/record/figures/mission/track_meter.h"

#include <algorithm>
#include <cmath>

#include "skein/geo/polygon.h"

namespace skein::record {
namespace {

constexpr double kInView = 2;  // after a picture [s]

}  // namespace

bool TrackMeter::counts(std::uint32_t object) const {
  return goal_.objects.empty() ||
         std::count(goal_.objects.begin(), goal_.objects.end(), object) > 0;
}

void TrackMeter::detected(const Detection& detection) {
  if (counts(detection.object)) targets_[detection.object].found = true;
}

void TrackMeter::object_moves(const ObjectMotion& motion) {
  if (counts(motion.object)) targets_[motion.object].track.add(motion);
}

void TrackMeter::pictured(const Footprint& picture) {
  for (auto& [object, target] : targets_) {
    const auto place = target.track.at(picture.time);
    if (place && geo::contains(picture.corners, *place))
      target.pictured = std::max(target.pictured.value_or(Time()), picture.time);
  }
}

void TrackMeter::believed(Time time, const ObjectBelief& belief) {
  const auto target = targets_.find(belief.object);
  if (target == targets_.end()) return;
  const auto truth = target->second.track.at(time);
  if (!truth) return;
  const double error = (belief.at(time) - *truth).norm();
  squared_errors_ += error * error;
  largest_error_ = std::max(largest_error_, error);
  ++errors_;
}

void TrackMeter::tick(Time now) {
  for (auto& [object, target] : targets_) {
    if (!target.found) continue;
    ++target.seconds;
    if (target.pictured && (now - *target.pictured).seconds() <= kInView)
      ++target.in_view;
  }
}

std::vector<MissionFigure> TrackMeter::figures(Time /*now*/) const {
  int found = 0, watched = 0;
  double sum = 0, worst = 1;
  for (const auto& [object, target] : targets_) {
    if (target.found) ++found;
    if (target.seconds == 0) continue;
    const double share = static_cast<double>(target.in_view) / target.seconds;
    sum += share;
    worst = std::min(worst, share);
    ++watched;
  }
  std::vector<MissionFigure> all{{"found", static_cast<double>(found)}};
  if (watched > 0) {
    all.push_back({"in_view", sum / watched});
    all.push_back({"in_view_worst", worst});
  }
  if (errors_ > 0) {
    all.push_back({"error_rms_m", std::sqrt(squared_errors_ / errors_)});
    all.push_back({"error_max_m", largest_error_});
  }
  return all;
}

}  // namespace skein::record
