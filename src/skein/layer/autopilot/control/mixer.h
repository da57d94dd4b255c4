// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "skein/data/vehicle/airframe.h"
#include "skein/data/vehicle/control.h"
#include "skein/geo/vec.h"

namespace skein::autopilot {

/// What the rotors together shall do.
struct Wrench {
  double thrust = 0;           ///< up along the body [N]
  Vec3 torque = Vec3::Zero();  ///< about forward, right, down [N m]
};

/// How the rotors do it.
struct Mix {
  Actuators throttle;         ///< of each rotor, from 0 to 1
  bool tilt_limited = false;  ///< less roll and pitch than asked for
  bool yaw_limited = false;   ///< less yaw than asked for
};

/// Shares a wrench among rotors anywhere around the centre of gravity.
///
/// The least-norm thrusts for thrust, roll and pitch, plus the combination of rotors that
/// yaws and nothing else. Where a rotor would leave [0, most], first the yaw is given up
/// as far as needed, then the thrust is moved, and only then roll and pitch are scaled
/// down. Reference: [Durham17] section 6 on least-norm allocation.
class Mixer {
 public:
  static constexpr std::size_t kMaxRotors = Actuators::kMaxChannels;

  /// @param standing  bit k: rotor k gives nothing.
  Mixer(const MultirotorAirframe& airframe, std::uint8_t standing);

  Mix mix(const Wrench& wrench) const;

  std::size_t rotors() const { return rotors_; }
  /// Whether hover without turning leaves thrust on every rotor that turns. Else tilt can
  /// be steered in one direction only, and the airframe must spin to be steered at all.
  bool holds_still() const;
  /// Of all rotors that turn [N].
  double max_thrust() const { return max_thrust_; }

 private:
  double throttle(double thrust) const;

  std::size_t rotors_;
  double most_;  // thrust of one rotor [N]
  double exponent_;
  double max_thrust_;
  // Thrust of each rotor per newton of thrust and newton metre of roll, pitch and yaw;
  // the first three also yaw, by these ratios.
  std::array<double, kMaxRotors> thrust_{}, roll_{}, pitch_{}, yaw_{};
  std::array<bool, kMaxRotors> turns_{};
  double yaw_of_thrust_ = 0, yaw_of_roll_ = 0, yaw_of_pitch_ = 0;
};

}  // namespace skein::autopilot
