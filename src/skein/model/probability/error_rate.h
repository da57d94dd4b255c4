// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace skein::model {

/// An unknown probability of error, learned from trials: a Beta distribution.
///
///   mean = (a + errors) / (a + b + trials),   a = 1/2,   b = a (1 - p0) / p0
///
/// with p0 what is believed at first. a = 1/2 makes that belief worth 1 / (2 p0) trials:
/// a small stated rate is soon corrected by errors and never quite forgotten. A p0 of 0
/// says that there are no errors, and stays.
class ErrorRate {
 public:
  /// @param first  probability believed before any trial, in [0, 1).
  explicit ErrorRate(double first)
      : errors_(first > 0 ? kFirstErrors : 0),
        trials_(first > 0 ? kFirstErrors / first : 1) {}

  /// Counts one trial that was right, or wrong.
  void count(bool error) {
    if (!(errors_ > 0)) return;
    trials_ += 1;
    if (error) errors_ += 1;
  }

  /// Mean of the distribution, in [0, 1).
  double mean() const { return errors_ / trials_; }

 private:
  static constexpr double kFirstErrors = 0.5;
  double errors_, trials_;
};

}  // namespace skein::model
