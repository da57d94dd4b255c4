// SPDX-License-Identifier: Apache-2.0
#include "skein/record/figures/separation_statistics.h"

#include <algorithm>

namespace skein::record {

void SeparationStatistics::message(const Message& message) {
  const auto* plan = std::get_if<PlanReport>(&message.content);
  if (!plan) return;
  const Separation kept{plan->horizontal, plan->vertical};
  if (!meter_) meter_.emplace(Separation{});
  meter_->keeps(message.from, kept);
}

void SeparationStatistics::conflict(const ConflictReport& report) {
  conflicts_ += 1;
  // It may be over because another flight has changed.
  if (report.method == SeparationMethod::kNone && !(report.fixed_before > 0)) {
    unsolved_ += 1;
    return;
  }
  least_fixed_ =
      std::min(least_fixed_.value_or(report.fixed_before), report.fixed_before);
}

void SeparationStatistics::loss(const SeparationLossRecord& loss) {
  losses_.min_ratio = std::min(losses_.min_ratio, loss.ratio);
  losses_.min_distance = std::min(losses_.min_distance, loss.distance);
  switch (loss.phase) {
    case SeparationPhase::kAir:
      losses_.air += 1;
      losses_.min_ratio_in_air = std::min(losses_.min_ratio_in_air, loss.ratio);
      losses_.pairs.emplace(loss.id, loss.other);
      break;
    case SeparationPhase::kFormation:
      losses_.formation += 1;
      break;
    case SeparationPhase::kGround:
      losses_.ground += 1;
      break;
  }
}

void SeparationStatistics::add_losses(std::map<std::string, double>& figures) const {
  const double all = losses_.air + losses_.formation + losses_.ground;
  figures["separation_losses"] = all;
  figures["separation_losses_air"] = losses_.air;
  figures["separation_losses_formation"] = losses_.formation;
  figures["separation_losses_ground"] = losses_.ground;
  figures["violations"] = static_cast<double>(losses_.pairs.size());
  if (all == 0) return;
  figures["separation_loss_min_ratio"] = losses_.min_ratio;
  figures["separation_loss_min_m"] = losses_.min_distance;
}

void SeparationStatistics::add_figures(std::map<std::string, double>& figures,
                                       std::size_t aircraft) const {
  if (aircraft > 1 || meter_) add_losses(figures);
  if (!meter_) return;
  SeparationMeter meter = *meter_;
  meter.finish();
  // Between two rows of the truth it is straight only to a metre or so: whether
  // separation was lost is known from every step.
  if (!losses_.pairs.empty())
    figures["separation_min_ratio"] = losses_.min_ratio_in_air;
  else if (meter.min_ratio() < 1e9)
    figures["separation_min_ratio"] = std::max(1.0, meter.min_ratio());
  figures["near_collisions"] = static_cast<double>(meter.near_collisions());
  figures["conflicts"] = conflicts_;
  figures["conflicts_unsolved"] = unsolved_;
  if (least_fixed_) figures["conflict_fixed_before_min_s"] = *least_fixed_;
}

}  // namespace skein::record
