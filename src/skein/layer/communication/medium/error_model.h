// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/role/error_model.h"

namespace skein::communication {

/// No bit fails at a ratio and above, all below.
class ThresholdErrors final : public ErrorModel {
 public:
  explicit ThresholdErrors(double least_ratio) : least_ratio_(least_ratio) {}
  double log_header_success(double sinr, double duration) const override;
  double log_payload_success(double sinr, double duration) const override;

 private:
  double least_ratio_;
};

/// IEEE 802.11 DSSS at 1 Mbit/s: header and payload DBPSK, 11 MHz chips, 22 MHz wide.
/// With s the ratio of the signal's power to noise and interference a bit fails with
///
///   0.5 exp(-22 s)
///
/// Reference: [Proakis01] 5.2, binary DPSK.
class Dsss1 final : public ErrorModel {
 public:
  double log_header_success(double sinr, double duration) const override;
  double log_payload_success(double sinr, double duration) const override;
};

/// IEEE 802.11 DSSS at 2 Mbit/s: the header as Dsss1, the payload DQPSK, whose bits fail,
/// with x = 11 s, with
///
///   (sqrt(2) + 1) / sqrt(8 pi sqrt(2)) / sqrt(x) exp(-(2 - sqrt(2)) x)
///
/// Reference: [Ferrari04].
class Dsss2 final : public ErrorModel {
 public:
  /// @param rate  of payloads [bit/s]
  explicit Dsss2(double rate = 2e6) : rate_(rate) {}
  double log_header_success(double sinr, double duration) const override;
  double log_payload_success(double sinr, double duration) const override;

 private:
  double rate_;
};

/// IEEE 802.11b CCK: the header as Dsss1, the payload code words of 8 chips, 1.375
/// million a second. With 4 bits each (5.5 Mbit/s) they are taken for 16 biorthogonal
/// signals, of which one is misunderstood with
///
///   P(e) = 1 - integral from -b on of (2 Phi(x + b) - 1)^7 phi(x) dx,  b = sqrt(2 e)
///
/// e = 8 s: half of a code word's energy over the noise's density, as its phase is that
/// against the one before. With 8 bits (11 Mbit/s) they are two such sets that share the
/// energy: 1 - (1 - P(e / 2))^2.
/// Reference: [Pursley09] Eqs. (17), (18); [Proakis01] 5.2, biorthogonal signals.
class Cck final : public ErrorModel {
 public:
  enum class Bits { kFour, kEight };  ///< of a code word

  explicit Cck(Bits bits) : bits_(bits) {}
  double log_header_success(double sinr, double duration) const override;
  double log_payload_success(double sinr, double duration) const override;

  /// P(e), from a table over b; 0 where b is above 10.
  static double word_error(double e);

 private:
  Bits bits_;
};

/// Binary frequency shift keying, detected without the carrier's phase, as simple modems
/// do it; header and payload alike. With E / N0 = s B / R a bit fails with
///
///   0.5 exp(-E / (2 N0))
///
/// Reference: [Proakis01] 5.4.
class NoncoherentFsk final : public ErrorModel {
 public:
  /// @param rate, bandwidth  R [bit/s] and B of the noise [Hz]
  NoncoherentFsk(double rate, double bandwidth)
      : rate_(rate), spread_(bandwidth / rate) {}
  double log_header_success(double sinr, double duration) const override;
  double log_payload_success(double sinr, double duration) const override;

 private:
  double rate_, spread_;
};

}  // namespace skein::communication
