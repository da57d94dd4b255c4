// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace skein {

/// How often a modulation is misunderstood: how the share of frames that are lost follows
/// from the ratio of signal to noise and interference. Immutable during a run.
class ErrorModel {
 public:
  virtual ~ErrorModel() = default;

  /// Logarithm of the probability that a part of a frame's header is received without an
  /// error, while signal and interference stay the same: in proportion to the duration.
  ///
  /// @param sinr      of the signal's power to noise and interference, at least 0
  /// @param duration  of the part [s]; may be 0
  /// @returns at most 0, finite, never falling with `sinr`; what is below -700 counts as
  ///          lost for certain
  virtual double log_header_success(double sinr, double duration) const = 0;
  /// The same of its payload.
  virtual double log_payload_success(double sinr, double duration) const = 0;
};

}  // namespace skein
