// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "skein/layer/communication/propagation/propagation_profile.h"
#include "skein/role/propagation.h"
#include "skein/role/terrain.h"

namespace skein::communication {

/// Straight through empty space: (wavelength / (4 pi d))^2 of what is radiated, at most
/// all of it.
/// Reference: [Friis46] Eq. (1).
class FreeSpace final : public Propagation {
 public:
  explicit FreeSpace(double frequency);
  double received(double radiated, const Vec3& from, const Vec3& to) const override;

 private:
  double factor_;  // wavelength / (4 pi) [m]
};

/// The same power everywhere, whatever is radiated: a cell in which all hear all.
class FixedPower final : public Propagation {
 public:
  explicit FixedPower(double dbm);
  double received(double radiated, const Vec3& from, const Vec3& to) const override;

 private:
  double power_;
};

/// A direct ray and one that level ground reflects: free space up to the distance
/// where the first Fresnel zone touches the ground, (h h' / d^2)^2 beyond.
///
///   distance of the change  4 pi h h' / wavelength
///
/// Heights are those of the places above the ground below them and the antennas' own, at
/// least 0.1 m.
/// Valid: ground that is about as high at both ends and in between.
/// Reference: [Rappaport02] Eq. (4.52).
class TwoRay final : public Propagation {
 public:
  /// @param ground  outlives this; null: level, at down = 0
  TwoRay(double frequency, double antenna_height, const Terrain* ground = nullptr);
  double received(double radiated, const Vec3& from, const Vec3& to) const override;

 private:
  double height(const Vec3& place) const;

  FreeSpace near_;
  double wavelength_, antenna_height_;
  const Terrain* ground_;
};

/// Free space up to a reference distance, then falling with a power of the distance, with
/// shadowing that is correlated in space.
///
///   loss = FSPL(d0) + 10 n log10(d / d0) + (S(from) + S(to)) / sqrt(2)   [dB]
///
/// S is a Gaussian field over the horizontal plane with standard deviation sigma and
/// correlation exp(-distance / D), made of 64 waves: two links between nearby places are
/// shadowed alike, and a link is in both directions.
/// Reference: [Rappaport02] Eq. (4.68), [Gudmundson91] for the correlation.
class LogDistance final : public Propagation {
 public:
  LogDistance(double frequency, const PropagationProfile& profile, std::uint64_t seed);
  double received(double radiated, const Vec3& from, const Vec3& to) const override;

  /// S at a place [dB].
  double shadowing_db(const Vec3& place) const;

 private:
  struct Wave {
    double north, east, phase;  // [rad/m], [rad/m], [rad]
  };
  FreeSpace near_;
  double exponent_, reference_distance_, sigma_db_;
  std::vector<Wave> waves_;
};

}  // namespace skein::communication
