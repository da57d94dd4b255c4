// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "skein/model/well_clear/manoeuvre.h"

namespace skein::model {

/// When an option of a manoeuvre is within a volume, in s since the manoeuvre began.
///
/// The way there is looked at in steps, of turns and changes of speed those between
/// values, of level changes each second of their first and last part; its steady part and
/// straight flight afterwards exactly.
struct OptionSpan {
  /// First and last step on the way that is within.
  double first_step = std::numeric_limits<double>::infinity();
  double last_step = -std::numeric_limits<double>::infinity();
  ConflictSpan straight;  ///< after the value is reached
  ConflictSpan steady;    ///< while climbing or descending evenly
};

/// What counts of a step of a turn or a change of speed.
enum class StepRule {
  kUntilNext,  ///< going straight on until the next step, too
  kInstant,    ///< being within the volume
};

/// What two values may differ by and still be the same [rad, m/s or m]: 2^-12 of the
/// power of two below the larger, as with DAIDALUS; 1e-5 at least.
double same(double larger);

/// The values that one kind of manoeuvre may lead to, in steps, and how it gets there.
///
/// Track: turns at the turn rate. Speed, vertical speed: change at the acceleration.
/// Steps count from the own value both ways; the last ones may be beyond the limits.
/// Altitude: LevelChange; steps count from the lowest altitude.
///
/// Between two neighbours lies a range. Some may be beyond the limits, and the first and
/// the last within them may be as narrow as rounding: no range is as narrow as `same()`.
class ManoeuvreOptions {
 public:
  /// `configuration` is used as long as this is.
  ManoeuvreOptions(const WellClearConfiguration& configuration, ManoeuvreKind kind);

  /// Lists the options that `own` has. No allocation once it had as many.
  void start(const OwnMotion& own);

  ManoeuvreKind kind() const { return kind_; }
  std::size_t count() const { return values_.size(); }
  /// Ascending [rad, m/s or m]; tracks are not wrapped: own - pi to own + pi.
  std::span<const double> values() const { return values_; }
  /// The own value, from which steps count [rad, m/s or m].
  double own_value() const { return own_value_; }
  /// When straight flight begins, of each option [s].
  std::span<const double> times() const { return times_; }
  /// When the steady part begins, of each option [s]; 0 where there is none.
  std::span<const double> steady_times() const { return steady_times_; }

  /// Ranges go from the option `first_range()` on, each to the next option, and end with
  /// the option `end_of_ranges()`.
  std::size_t first_range() const { return first_range_; }
  std::size_t end_of_ranges() const { return end_of_ranges_; }
  /// Lower and upper end of the range from an option to the next [rad, m/s or m]; those
  /// of the first and the last range are the limits, but for tracks.
  double low_end(std::size_t option) const {
    return option == first_range_ ? lowest_ : values_[option];
  }
  double high_end(std::size_t option) const {
    return option + 1 == end_of_ranges_ ? highest_ : values_[option + 1];
  }
  /// When each option is within `volume` about `intruder`, until `horizon` [s].
  /// @param rule   for steps on the way of all kinds but altitude.
  /// @param spans  one for each option.
  /// Cost: some 30 ns for an option.
  void survey(const WellClearVolume& volume, const IntruderMotion& intruder,
              double horizon, StepRule rule, std::span<OptionSpan> spans) const;

 private:
  void start_track();
  void start_speed();
  void start_vertical_speed();
  void start_altitude();
  void list_steps(double own, double step, double accel, double min, double max);
  void find_ranges(double min, double max);
  void survey_steps(const WellClearVolume& volume, const IntruderMotion& intruder,
                    double horizon, StepRule rule, std::span<OptionSpan> spans) const;
  void survey_altitudes(const WellClearVolume& volume, const IntruderMotion& intruder,
                        double horizon, std::span<OptionSpan> spans) const;

  const WellClearConfiguration* configuration_;
  ManoeuvreKind kind_;
  OwnMotion own_;
  double own_value_ = 0;
  double dt_ = 1;           // between steps [s]
  std::size_t center_ = 0;  // the option that changes nothing
  double lowest_ = 0, highest_ = 0;
  std::size_t first_range_ = 0, end_of_ranges_ = 0;
  std::vector<double> values_, times_, steady_times_;
  std::vector<ManoeuvrePoint> points_;  // where straight flight begins
  std::vector<LevelChange> changes_;    // of altitudes
};

}  // namespace skein::model
