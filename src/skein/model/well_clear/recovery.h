// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "skein/model/well_clear/manoeuvre_bands.h"
#include "skein/model/well_clear/options.h"

namespace skein::model {

/// Finds the values of one kind of manoeuvre that regain well clear soonest.
///
/// A value regains it at a time B if no volume is entered from B on and the recovery
/// distances are kept before. Of distances from those of the configuration, shrunk again
/// and again, the first are taken with which two neighbouring values regain it within the
/// lookahead; B is the earliest, by bisection to 0.5 s, plus the stability time, at which
/// it must still be regained.
///
/// What may be B for a value is an interval, so that volumes are looked at once and
/// distances some five times, not at every step of the bisection.
class RecoverySearch {
 public:
  explicit RecoverySearch(const WellClearConfiguration& configuration)
      : configuration_(&configuration) {}

  /// Forgets the intruders added.
  void start(std::size_t options);

  /// Adds an intruder to be avoided.
  ///
  /// @param spans   when each option is within the corrective volume.
  /// @param window  how long straight flight is looked at [s]; the lookahead for those in
  ///                conflict now.
  void add(const IntruderMotion& intruder, double horizontal_margin,
           double vertical_margin, double window, const ManoeuvreOptions& options,
           std::span<const OptionSpan> spans);

  BandRecovery search(const ManoeuvreOptions& options);

  /// Whether an option regains well clear, after a search that has found something.
  bool regains(std::size_t option) const { return regains_at(option, recovery_time_); }

 private:
  struct Member {
    IntruderMotion motion;
    double horizontal_margin, vertical_margin, window;
  };
  struct Distances {
    double horizontal, vertical;
  };

  bool regains_at(std::size_t option, double time) const {
    return clear_after_[option] < time && time <= kept_until_[option];
  }
  // Whether the ends of a range regain it.
  bool some_regain_at(double time, const ManoeuvreOptions& options) const;
  // Fills kept_until_ for these distances.
  void keep(double horizontal, double vertical, const ManoeuvreOptions& options);
  double earliest(const ManoeuvreOptions& options) const;
  // The time of recovery with the distances that are kept, or none.
  std::optional<double> time_of_recovery(const ManoeuvreOptions& options) const;
  void list_distances();
  std::size_t first_regained(const ManoeuvreOptions& options);

  const WellClearConfiguration* configuration_;
  std::vector<Member> members_;
  std::vector<Distances> distances_;  // that are tried, largest first
  // What the time of regaining is after, and not after, of each option.
  std::vector<double> clear_after_, kept_until_;
  std::vector<OptionSpan> spans_;
  double recovery_time_ = 0;
};

/// Whether a span that is looked at from `start` begins within `window` and the
/// lookahead.
inline bool begins_within(const ConflictSpan& span, double start, double window,
                          double lookahead) {
  return span.conflict() && span.in < start + window && span.in < lookahead;
}

}  // namespace skein::model
