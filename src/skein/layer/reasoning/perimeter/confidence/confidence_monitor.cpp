// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/perimeter/confidence/confidence_monitor.h"

#include <algorithm>
#include <cmath>

#include "skein/base/math.h"

namespace skein::perimeter {
namespace {

constexpr std::size_t kRecent = 20;  // crossings that are judged together
// Of 20 crossings of an honest belief one lies outside; 8 or more once in a million. A
// belief is trusted again well below that, so that the verdict does not flicker.
constexpr double kTooMany = 0.4, kFewEnough = 0.2;
constexpr double kTakenBack = 3;  // two opposite crossings this close are none [s]

}  // namespace

std::optional<ConfidenceMonitor::Verdict> ConfidenceMonitor::take(
    const Crossing& crossing, const BoundaryEstimate& before) {
  Pending next{crossing.time, crossing.entered, crossing_offset(crossing, before)};
  const auto [place, first] = pending_.try_emplace(crossing.aircraft, next);
  if (first) return std::nullopt;
  const Pending last = place->second;
  const bool taken_back = last.offset && last.entered != crossing.entered &&
                          std::abs((crossing.time - last.time).seconds()) <= kTakenBack;
  if (taken_back) next.offset.reset();  // and the last one is not judged either
  place->second = next;
  if (taken_back || !last.offset) return std::nullopt;
  return judge(*last.offset);
}

std::optional<ConfidenceMonitor::Verdict> ConfidenceMonitor::judge(
    const CrossingOffset& offset) {
  ++judged_;
  recent_.push_back(offset);
  if (recent_.size() > kRecent) recent_.pop_front();
  if (recent_.size() < kRecent) return std::nullopt;
  const double share = share_outside();
  Verdict verdict = verdict_.value_or(Verdict::kTrusted);
  if (share >= kTooMany) verdict = Verdict::kOverConfident;
  if (share <= kFewEnough) verdict = Verdict::kTrusted;
  if (verdict_ == verdict) return std::nullopt;
  verdict_ = verdict;
  return verdict;
}

double ConfidenceMonitor::share_outside() const {
  if (recent_.empty()) return 0;
  const auto count =
      std::count_if(recent_.begin(), recent_.end(),
                    [](const CrossingOffset& o) { return o.square() > 4; });
  return static_cast<double>(count) / static_cast<double>(recent_.size());
}

double ConfidenceMonitor::mean_square() const {
  if (recent_.empty()) return 0;
  double sum = 0;
  for (const CrossingOffset& o : recent_) sum += o.square();
  return sum / static_cast<double>(recent_.size());
}

double ConfidenceMonitor::last_log_density() const {
  if (recent_.empty()) return 0;
  const CrossingOffset& last = recent_.back();
  return -0.5 * (last.square() + math::log(2 * geo::kPi * last.variance));
}

}  // namespace skein::perimeter
