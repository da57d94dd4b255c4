// SPDX-License-Identifier: Apache-2.0
#include "skein/model/well_clear/recovery.h"

#include <algorithm>
#include <cmath>

#include "skein/base/math.h"

namespace skein::model {

void RecoverySearch::start(std::size_t options) {
  members_.clear();
  clear_after_.assign(options, -math::kInfinity);
  kept_until_.assign(options, math::kInfinity);
  spans_.resize(options);
}

void RecoverySearch::add(const IntruderMotion& intruder, double horizontal_margin,
                         double vertical_margin, double window,
                         const ManoeuvreOptions& options,
                         std::span<const OptionSpan> spans) {
  members_.push_back({intruder, horizontal_margin, vertical_margin, window});
  const double lookahead = configuration_->lookahead;
  // An intruder that is no conflict now counts until its window ends, but for turns and
  // changes of speed that last longer.
  const bool level_changes = options.kind() == ManoeuvreKind::kAltitude;
  const double counts_until = window < lookahead ? window : math::kInfinity;
  for (std::size_t i = 0; i < spans.size(); ++i) {
    const OptionSpan& span = spans[i];
    double after = level_changes ? span.last_step : -math::kInfinity;
    if (begins_within(span.straight, options.times()[i], window, lookahead))
      after = std::max(after, span.straight.out);
    if (begins_within(span.steady, options.steady_times()[i], window, lookahead))
      after = std::max(after, span.steady.out);
    after = std::min(after, counts_until);
    if (!level_changes) after = std::max(after, span.last_step);
    clear_after_[i] = std::max(clear_after_[i], after);
  }
}

void RecoverySearch::keep(double horizontal, double vertical,
                          const ManoeuvreOptions& options) {
  const double lookahead = configuration_->lookahead;
  std::fill(kept_until_.begin(), kept_until_.end(), math::kInfinity);
  for (const Member& member : members_) {
    const WellClearVolume volume{horizontal + member.horizontal_margin,
                                 vertical + member.vertical_margin, 0, 0};
    options.survey(volume, member.motion, lookahead, StepRule::kUntilNext, spans_);
    // Beyond its window, what begins later within the window after the manoeuvre counts
    // from there on.
    const double latest = member.window < lookahead ? member.window : math::kInfinity;
    for (std::size_t i = 0; i < spans_.size(); ++i) {
      const OptionSpan& span = spans_[i];
      double until = kept_until_[i];
      if (span.first_step < math::kInfinity)
        until =
            std::min({until, std::nextafter(span.first_step, -math::kInfinity), latest});
      if (begins_within(span.straight, options.times()[i], member.window, lookahead))
        until = std::min({until, span.straight.in, latest});
      if (begins_within(span.steady, options.steady_times()[i], member.window, lookahead))
        until = std::min({until, span.steady.in, latest});
      kept_until_[i] = until;
    }
  }
}

bool RecoverySearch::some_regain_at(double time, const ManoeuvreOptions& options) const {
  for (std::size_t i = options.first_range(); i < options.end_of_ranges(); ++i)
    if (regains_at(i, time) && regains_at(i + 1, time)) return true;
  return false;
}

double RecoverySearch::earliest(const ManoeuvreOptions& options) const {
  constexpr double kPrecision = 0.5;  // [s]
  double no = 0, yes = configuration_->lookahead;
  while (yes - no > kPrecision) {
    const double between = (no + yes) / 2;
    (some_regain_at(between, options) ? yes : no) = between;
  }
  return yes;
}

// What is regained at the earliest time may be lost again within the stability time: of
// an intruder in no conflict now, distances count beyond its window.
std::optional<double> RecoverySearch::time_of_recovery(
    const ManoeuvreOptions& options) const {
  const double lookahead = configuration_->lookahead;
  if (!some_regain_at(lookahead, options)) return std::nullopt;
  const double time =
      std::min(lookahead, earliest(options) + configuration_->recovery.stability);
  if (!some_regain_at(time, options)) return std::nullopt;
  return time;
}

BandRecovery RecoverySearch::search(const ManoeuvreOptions& options) {
  using Outcome = BandRecovery::Outcome;
  const auto& rule = configuration_->recovery;
  const double lookahead = configuration_->lookahead;
  BandRecovery result;
  keep(rule.nmac_horizontal, rule.nmac_vertical, options);
  bool kept = false;
  for (std::size_t i = options.first_range(); i < options.end_of_ranges(); ++i)
    kept = kept || (kept_until_[i] >= lookahead && kept_until_[i + 1] >= lookahead);
  if (!kept) {
    result.outcome = Outcome::kNotKept;
    return result;
  }
  list_distances();
  result.outcome = Outcome::kNoneFound;
  for (std::size_t tried = first_regained(options); tried <= distances_.size(); ++tried) {
    result.shrunk = static_cast<int>(tried);
    if (tried == distances_.size()) break;
    keep(distances_[tried].horizontal, distances_[tried].vertical, options);
    const std::optional<double> time = time_of_recovery(options);
    if (!time) continue;
    recovery_time_ = *time;
    result.outcome = Outcome::kFound;
    result.time = *time;
    result.horizontal = distances_[tried].horizontal;
    result.vertical = distances_[tried].vertical;
    break;
  }
  return result;
}

void RecoverySearch::list_distances() {
  const auto& rule = configuration_->recovery;
  distances_.clear();
  double horizontal = rule.horizontal, vertical = rule.vertical;
  while (horizontal > rule.nmac_horizontal || vertical > rule.nmac_vertical) {
    distances_.push_back({horizontal, vertical});
    horizontal = std::max(rule.nmac_horizontal, horizontal * (1 - rule.ca_factor));
    vertical = std::max(rule.nmac_vertical, vertical * (1 - rule.ca_factor));
  }
}

// The first distances with which well clear is regained within the lookahead, or their
// number: what is regained with some is regained with all that are smaller.
std::size_t RecoverySearch::first_regained(const ManoeuvreOptions& options) {
  std::size_t from = 0, to = distances_.size();
  std::size_t tried = 0;  // most often the first will do
  while (from < to) {
    keep(distances_[tried].horizontal, distances_[tried].vertical, options);
    if (some_regain_at(configuration_->lookahead, options))
      to = tried;
    else
      from = tried + 1;
    tried = (from + to) / 2;
  }
  return from;
}

}  // namespace skein::model
