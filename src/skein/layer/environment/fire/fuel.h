// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "skein/base/result.h"
#include "skein/geo/vec.h"

namespace skein::environment {

/// How well the ground burns. Immutable during a run; any thread may ask.
class FuelField {
 public:
  virtual ~FuelField() = default;

  /// Factor of the spread rate at `p` in N: finite, 1 for the fuel that the rate is meant
  /// for, 0 for what does not burn.
  virtual double factor(const Vec2& p) const = 0;
};

struct PatchyFuelOptions {
  double patch_size = 150;      ///< distance over which the fuel changes [m]
  double variation = 0.35;      ///< standard deviation of the factor's logarithm
  double unburnable_share = 0;  ///< of the area, in patches, 0 to 0.5
};

/// Synthetic fuel: smooth patches of random factors, log-normal about a median of 1 and
/// between exp(-3 variation) and exp(3 variation). The least `unburnable_share` of it
/// does not burn. Repeats itself after 64 patches.
class PatchyFuel : public FuelField {
 public:
  /// Fails: Bug when the options do not pass check().
  PatchyFuel(const PatchyFuelOptions& options, std::uint64_t seed);

  double factor(const Vec2& p) const override;

 private:
  double noise(const Vec2& p) const;

  PatchyFuelOptions options_;
  std::vector<double> nodes_;  // standard normal, kPeriod x kPeriod
  double bare_below_;          // in units of noise()
};

/// Fails: kBadInput when a value is outside its range.
Result<void> check(const PatchyFuelOptions& options);

}  // namespace skein::environment
