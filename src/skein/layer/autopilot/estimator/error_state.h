// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

#include "skein/geo/rotation.h"
#include "skein/geo/vec.h"

namespace skein::autopilot {

/// Where each part of the estimator's error stands in its vector and covariance.
///
/// Error = truth less estimate, all in N but the sensors' biases, which are in B. The
/// attitude error is the rotation vector that turns the estimate into the truth, in N:
/// q_true = Exp(theta) q. What only drives others comes first, so that the rows that move
/// in a time step are the last of a lower triangle.
namespace error {
inline constexpr std::size_t kGyroBias = 0;        // 3 [rad/s]
inline constexpr std::size_t kAccelBias = 3;       // 3 [m/s^2]
inline constexpr std::size_t kGyroScale = 6;       // 3, relative
inline constexpr std::size_t kWind = 9;            // 2: mean wind [m/s]
inline constexpr std::size_t kGnssBias = 11;       // 3 [m]
inline constexpr std::size_t kBaroBias = 14;       // 1, of the pressure altitude [m]
inline constexpr std::size_t kMagneticBias = 15;   // 3, of the unit field
inline constexpr std::size_t kAirspeedScale = 18;  // 1, relative
inline constexpr std::size_t kAttitude = 19;       // 3 [rad]
inline constexpr std::size_t kVelocity = 22;       // 3 [m/s]
inline constexpr std::size_t kPosition = 25;       // 3 [m]
inline constexpr std::size_t kSize = 28;
}  // namespace error

using ErrorVector = std::array<double, error::kSize>;

/// What the estimator estimates.
struct Navigated {
  Vec3 p_N = Vec3::Zero();
  Vec3 v_N = Vec3::Zero();
  Quat q_NB = Quat::Identity();
  Vec3 gyro_bias = Vec3::Zero();   ///< in B [rad/s]
  Vec3 accel_bias = Vec3::Zero();  ///< in B, with what a wrong scale makes of the usual
                                   ///< specific force (see add_scale_noise) [m/s^2]
  Vec3 gyro_scale = Vec3::Zero();  ///< measured rate over the true one, less 1
  Vec2 wind_N = Vec2::Zero();      ///< mean wind: gusts are noise to it [m/s]
  Vec3 gnss_bias = Vec3::Zero();   ///< slow part of the receiver's error, in N [m]
  double baro_bias = 0;            ///< pressure altitude less altitude [m]
  Vec3 magnetic_bias = Vec3::Zero();  ///< in B, of the field over its strength
  double airspeed_scale = 0;          ///< measured airspeed over the true one, less 1
};

/// The state that `error` says is the true one: `x` with the error added.
Navigated corrected(const Navigated& x, const ErrorVector& error);

/// The error of `estimate`: corrected(estimate, difference(truth, estimate)) is `truth`.
ErrorVector difference(const Navigated& truth, const Navigated& estimate);

}  // namespace skein::autopilot
