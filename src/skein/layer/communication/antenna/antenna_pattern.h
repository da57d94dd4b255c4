// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "skein/layer/communication/antenna/antenna_profile.h"
#include "skein/role/antenna.h"

namespace skein::communication {

/// Alike in all directions.
class Isotropic final : public Antenna {
 public:
  double gain(const Vec3&) const override { return 1; }
};

/// A half-wave dipole whose rod stands upright in the body.
///
///   gain = (cos(pi/2 cos a) / sin a)^2,   a = angle between rod and direction
///
/// 0 dB to all sides, at least `min_gain_db` along the rod.
/// Reference: [Balanis16] Eq. (4-84).
class VerticalDipole final : public Antenna {
 public:
  explicit VerticalDipole(double min_gain_db);
  double gain(const Vec3& direction_B) const override;

 private:
  double min_gain_;
};

/// An antenna that part of its own body covers: a cone about one direction, in which the
/// gain is lower by some decibels, with an edge like half a period of a cosine.
///
///   loss [dB] = depth (1 + cos(pi x)) / 2,   x = (angle - half width) / edge + 1/2
///
/// with x kept to [0, 1]; `angle` is that to the middle of the cone.
/// Reference: [Selecky18] fig. 10.7, which shows the effect.
class BodyShadow final : public Antenna {
 public:
  explicit BodyShadow(const AntennaProfile& profile);
  double gain(const Vec3& direction_B) const override;

 private:
  Vec3 middle_B_;
  double half_width_, edge_, depth_db_;
  double cos_inside_, cos_outside_;  // of the angles where the edge begins and ends
  double least_;
};

/// Measured gains over azimuth and elevation: bilinear in decibels, azimuths go round,
/// below the lowest and above the highest elevation the nearest row holds.
class GainTable final : public Antenna {
 public:
  /// Fails: Bug when sizes do not fit or an axis does not grow.
  explicit GainTable(const AntennaProfile& profile);
  double gain(const Vec3& direction_B) const override;

 private:
  std::vector<double> azimuths_, elevations_;
  std::vector<double> gains_db_;  // row by row
};

}  // namespace skein::communication
