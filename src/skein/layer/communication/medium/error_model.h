#pragma once

#include "skein/layer/communication/medium/radio_profile.h"

namespace skein::communication {

/// How well frames are understood.
struct ErrorRates {
  ErrorModel model = ErrorModel::kDsss2;
  double rate = 2e6;       ///< of payloads [bit/s]
  double least_ratio = 1;  ///< of signal to noise and interference, for kThreshold

  /// Logarithm of the probability that a part of a frame is received without a bit error,
  /// while signal and interference stay the same.
  ///
  /// With s the ratio of the signal's power to noise and interference, bits of a header
  /// (DBPSK, 1 Mbit/s over 11 MHz chips, 22 MHz wide) fail with probability
  ///
  ///   0.5 exp(-22 s)
  ///
  /// and bits of a payload (DQPSK, 2 Mbit/s), with x = 11 s, with
  ///
  ///   (sqrt(2) + 1) / sqrt(8 pi sqrt(2)) / sqrt(x) exp(-(2 - sqrt(2)) x).
  ///
  /// @param duration  of the part [s]; may be 0
  /// @returns at most 0; what is below -700 counts as lost for certain
  /// Reference: [Ferrari04], for the payload; 11 chips a bit are 22 and 11 in s.
  double log_header_success(double signal_to_noise, double duration) const;
  double log_payload_success(double signal_to_noise, double duration) const;
};

}  // namespace skein::communication
