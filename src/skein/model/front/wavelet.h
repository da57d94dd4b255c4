// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <span>

#include "skein/base/result.h"
#include "skein/geo/vec.h"

namespace skein::model {

/// The ellipse that a fire lit at one point would burn in one second (Huygens's
/// principle: the front a moment later is the envelope of the wavelets of all its
/// points).
///
/// The point stands on the long axis, `drift` behind the centre:
///   head rate = length + drift, back rate = length - drift, flank rate = width.
struct Wavelet {
  Vec2 heading = {1, 0};  ///< unit vector of the fastest spread
  double length = 0;      ///< half the long axis [m/s], >= width
  double width = 0;       ///< half the short axis [m/s]
  double drift = 0;       ///< of the centre along the heading [m/s], <= length
};

/// Velocity of a front's point whose outward direction is `normal` (any length): the
/// point of the wavelet whose own normal that is.
///
///   v = drift h + (length^2 (n.h) h + width^2 (n.t) t) / |(length n.h, width n.t)|
///
/// with t across the heading h. Zero when the wavelet or the normal is.
/// Reference: [Richards90], with the tangent written as a normal.
inline Vec2 spread_velocity(const Wavelet& w, const Vec2& normal) {
  const Vec2 across = geo::turned_right(w.heading);
  const double nh = w.length * normal.dot(w.heading);
  const double nt = w.width * normal.dot(across);
  const double size = std::sqrt(nh * nh + nt * nt);
  if (!(size > 0)) return Vec2::Zero();
  return (w.drift + w.length * nh / size) * w.heading + (w.width * nt / size) * across;
}

/// How fuel, wind and slope make a wavelet. Rates are horizontal (as on the map).
struct SpreadLaw {
  double rate = 0.05;  ///< over level ground, in still air, with fuel factor 1 [m/s]
  double wind_reduction = 0.4;  ///< wind at the flames over wind of the field
  double wind_response =
      0.8;  ///< gain of the head rate per wind at the flames [s/m], > 0
  double slope_doubling =
      geo::radians(10);  ///< slope that doubles the rate [rad]; 0: none
};

/// Fails: kBadInput when a value is not finite, negative, or (wind_response) zero.
Result<void> check(const SpreadLaw& law);

/// Length over breadth of a wind-driven fire.
///
///   LB = 0.936 exp(0.2566 U) + 0.461 exp(-0.1548 U) - 0.397, at most 8
///
/// @param wind  speed at the flames [m/s], >= 0.
/// Reference: [Anderson83], whose exponents are per mile per hour; [Finney98] subtracts
/// 0.397, which makes it 1 in still air, and sets the bound.
double length_to_breadth(double wind);

/// The wavelet under a wind and on a slope.
///
///   phi   = k u + (2^(theta / theta_2) - 1) e_up      both effects added as vectors
///   head  = rate fuel (1 + |phi|),   back = head / HB
///   HB    = (LB + sqrt(LB^2 - 1)) / (LB - sqrt(LB^2 - 1)),   LB at U = |phi| / k
///   length = (head + back) / 2,  width = length / LB,  drift = (head - back) / 2
///
/// @param wind      of the field over ground [m/s], towards where it blows; u =
///                  wind_reduction wind.
/// @param gradient  of the ground, d elevation / d(north, east); theta its angle, at most
///                  45 deg.
/// @param fuel      factor of the rate, >= 0; 0 does not burn.
/// @returns         finite for finite arguments; wind and |phi| / k count up to 60 m/s.
/// Reference: [McArthur67] for slope, [Rothermel72] for the sum 1 + phi, [Finney98] for
/// the ellipse and for adding wind and slope as vectors.
Wavelet spread_wavelet(const SpreadLaw& law, const Vec2& wind, const Vec2& gradient,
                       double fuel);

/// The wavelets over the plane: how fast a fire spreads at a place and time.
class WaveletField {
 public:
  virtual ~WaveletField() = default;

  /// Fills `out[i]` for `points[i]` at `time` [s]. Many at once: a front asks for all its
  /// markers.
  virtual void wavelets(std::span<const Vec2> points, double time,
                        std::span<Wavelet> out) const = 0;
};

}  // namespace skein::model
