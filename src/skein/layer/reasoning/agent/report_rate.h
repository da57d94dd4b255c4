// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "skein/base/id.h"
#include "skein/data/radio/radio.h"

namespace skein::reasoning {

struct ReportRateOptions {
  /// Of the air that all use together; 0: the rate does not adapt.
  double target_load = 0.6;
  double gain = 0.3;         ///< share of the error that is taken back each second
  double increase = 0.0005;  ///< of the rate, each second, so that all get the same
  double least = 1.0 / 60;   ///< of the rate wanted
  double start = 0.05;       ///< where others use the same medium
  /// More messages than these in its own queue: the air is full, whatever it hears.
  std::uint32_t most_waiting = 2;
};

/// How much of what it would like to report an aircraft says, so that all are heard.
///
/// Everybody hears the load of the air and steers it to the same target, as cars do:
///
///   r += r g (target - load) / target + a,  once a second, r in [least, 1]
///
/// A radio without a medium has no load: then r = 1. With one r begins low, as all begin
/// at the same time.
/// Reference: [Bansal13] Eq. (1) for linear control, [ChiuJain89] for fairness.
class ReportRate {
 public:
  explicit ReportRate(const ReportRateOptions& options) : options_(options) {}

  /// To be called at each step.
  void step(Time now, const RadioStatus& radio);

  /// Of the rate wanted, above 0 and at most 1.
  double share() const { return share_; }

  /// Where in its period a sender that says less than it wants begins, from 0 to 1: those
  /// of a team that begin together do not report together.
  static double phase(EntityId self);

 private:
  ReportRateOptions options_;
  double share_ = 1;
  std::optional<Time> next_;
};

}  // namespace skein::reasoning
