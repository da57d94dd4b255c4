// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace skein::model {

/// The room around an intruder that an aircraft stays out of to be well clear of it.
///
/// It is entered when all three hold:
///   vertical:    |z| <= Z, or the altitudes will be equal within TCOA;
///   horizontal:  |s| <= D, or the aircraft converge, their closest approach is within D
///                and (D^2 - s.s) / (s.v) <= tau ("modified tau").
/// s, v: horizontal position and velocity of own minus intruder, z: altitude likewise.
///
/// Reference: [Munoz15] sections II and III; [DO365].
struct WellClearVolume {
  double horizontal = 609.6;  ///< D [m], above 0
  double vertical = 76.2;     ///< Z [m], above 0
  double tau = 0;             ///< [s], not below 0; 0 = an upright cylinder
  double coaltitude = 0;      ///< TCOA [s], not below 0

  bool operator==(const WellClearVolume&) const = default;
};

/// Position and velocity of the own aircraft minus those of an intruder.
struct RelativeMotion {
  double x = 0, y = 0;    ///< horizontal, along any two axes at right angles [m]
  double z = 0;           ///< own above intruder [m]
  double vx = 0, vy = 0;  ///< [m/s]
  double vz = 0;          ///< up [m/s]
};

/// When straight flight is within a volume.
struct ConflictSpan {
  double in = 0, out = 0;  ///< [s]

  /// Touching at one instant is none.
  bool conflict() const { return in < out; }
};

/// The span of [0, horizon] in which straight flight is within the volume.
///
///   vertical entry and exit first; from the entry on horizontally, with a = v.v,
///   b = 2 s.v + tau a, c = s.s + tau s.v - D^2:
///   in = (-b - sqrt(b^2 - 4 a c)) / (2 a),  out = (-s.v + sqrt(D^2 a - (s x v)^2)) / a
///
/// @param horizon  [s]; nothing is a conflict when it is below 0.
/// Cost: some 20 ns; no allocation.
/// Reference: [Munoz15] algorithm 2.
ConflictSpan conflict_span(const WellClearVolume& volume, const RelativeMotion& motion,
                           double horizon);

/// Whether the aircraft is within the volume now.
bool is_within(const WellClearVolume& volume, const RelativeMotion& motion);

}  // namespace skein::model
