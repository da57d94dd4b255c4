// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "skein/role/propagation.h"
#include "skein/role/terrain.h"

namespace skein::communication {

/// Another propagation over the ground of a run: edges of the ground that stand in the
/// way, or nearly so, take what diffraction takes.
///
///   loss = J(v) + (1 - exp(-J(v) / 6)) (J(v1) + J(v2))   [dB],  0 for v <= -0.78
///
/// v is the largest Fresnel parameter of the profile; v1 and v2 are the largest ones of
/// the profiles from either end to that edge. Profiles are samples of the ground at equal
/// distances, raised by the bulge of an earth of 4/3 of its radius. Without an obstacle
/// near the line nothing is lost; a line that grazes a single edge loses 6 dB.
///
/// Cost: up to kMaxSamples looks at the terrain, only where the line is not above all of
/// the ground; none when both ends are high above it.
/// Valid: edges are sharp and across the path; rounded tops take some decibels more
/// or less. What goes around hills to the side is left out.
/// Reference: [P526] for J; [Deygout66] for the three edges, with the weight that
/// P.526-11 gives the minor ones of cascaded knife edges.
class TerrainDiffraction final : public Propagation {
 public:
  static constexpr int kMaxSamples = 64;

  /// @param terrain  outlives this
  /// @param step     between samples [m], above 0; longer on paths of more than
  ///                 kMaxSamples
  TerrainDiffraction(std::unique_ptr<Propagation> open, const Terrain& terrain,
                     double frequency, double step);
  double received(double radiated, const Vec3& from, const Vec3& to) const override;

  /// What the ground takes between two places [dB], at least 0; the same in both
  /// directions.
  double loss_db(const Vec3& a, const Vec3& b) const;

 private:
  std::unique_ptr<Propagation> open_;
  const Terrain& terrain_;
  double wavelength_, step_, highest_;
};

}  // namespace skein::communication
