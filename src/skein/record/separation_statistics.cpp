#include "skein/record/separation_statistics.h"

#include <algorithm>

namespace skein::record {

void SeparationStatistics::message(const Message& message) {
  const auto* plan = std::get_if<PlanReport>(&message.content);
  if (plan && !meter_) meter_.emplace(Separation{plan->horizontal, plan->vertical});
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

void SeparationStatistics::add_figures(std::map<std::string, double>& figures) const {
  if (!meter_) return;
  SeparationMeter meter = *meter_;
  meter.finish();
  if (meter.min_ratio() < 1e9) figures["separation_min_ratio"] = meter.min_ratio();
  figures["violations"] = static_cast<double>(meter.violations());
  figures["near_collisions"] = static_cast<double>(meter.near_collisions());
  figures["conflicts"] = conflicts_;
  figures["conflicts_unsolved"] = unsolved_;
  if (least_fixed_) figures["conflict_fixed_before_min_s"] = *least_fixed_;
}

}  // namespace skein::record
