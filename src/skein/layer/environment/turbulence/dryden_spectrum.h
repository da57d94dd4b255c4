// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

namespace skein::environment {

/// How rough the air is. Wind at 6 m above ground: 15, 30, 45 kt; higher up the intensity
/// is exceeded with probability 1e-2, 1e-3, 1e-5.
enum class TurbulenceIntensity : std::uint8_t { kLight, kModerate, kSevere };

struct DrydenOptions {
  TurbulenceIntensity intensity = TurbulenceIntensity::kLight;
  /// Wind 6 m above ground, instead of the word [m/s]; 0 = no turbulence. Higher up, the
  /// intensity lies between those of the words, in proportion.
  std::optional<double> wind20 = std::nullopt;
  double span = 2;  ///< wing span (or size) of the vehicle [m]
};

/// Length scales and intensities of the Dryden spectra at one height. Those of the
/// lateral gust v are those of the longitudinal gust u.
struct DrydenSpectrum {
  double length_u = 0;  ///< [m]
  double length_w = 0;  ///< [m]
  double sigma_u = 0;   ///< standard deviation [m/s]
  double sigma_w = 0;   ///< standard deviation, vertical [m/s]
};

/// Dryden turbulence of the standard at `height` above ground [m].
///
///   below 1,000 ft, with h in ft, not below 10:
///     Lw = h,  Lu = h / (0.177 + 0.000823 h)^1.2
///     sigma_w = 0.1 W20,  sigma_u = sigma_w / (0.177 + 0.000823 h)^0.4
///   above 2,000 ft:
///     Lu = Lw = 1,750 ft,  sigma_u = sigma_w from the curves of exceedance probability
///   between them linear in height.
///
/// Reference: [MIL-F-8785C] 3.7.2, 3.7.3, figures 7, 10 and 11.
DrydenSpectrum dryden_spectrum(const DrydenOptions& options, double height);

}  // namespace skein::environment
