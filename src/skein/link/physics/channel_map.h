// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "skein/base/result.h"
#include "skein/data/vehicle/airframe.h"

namespace skein::physics {

/// Which of a plant's actuators each output of an outside autopilot moves.
///
/// The autopilot's outputs are surfaces from -1 to 1, positive where they roll right,
/// bring the nose up or the nose right, and motors from 0 to 1. The plant's are those of
/// data/vehicle/control.h, whose elevator and rudder have the other sign.
class ChannelMap {
 public:
  enum class Make : std::uint8_t { kArduPilot, kPx4 };

  /// As the autopilot's own frame has it: a plane's outputs 1 to 4 are aileron, elevator,
  /// throttle, rudder (ArduPilot) or aileron, elevator, rudder, throttle (PX4); a
  /// quadrotor X has its motors in the order front right, rear left, front left, rear
  /// right, the first two of which yaw it clockwise.
  /// Fails: kBadInput for a plant without actuators, and for rotors that are no such X.
  static Result<ChannelMap> usual(Make make, const Airframe& airframe);

  /// By words, one for each output from the first: aileron, elevator, rudder, throttle,
  /// brake, rotor-0, rotor-1..., or none; a "-" before it turns a surface round.
  /// Fails: kBadInput for another word, for an actuator that is there twice or that the
  ///        airframe does not have.
  static Result<ChannelMap> of_words(const std::vector<std::string>& words,
                                     const Airframe& airframe);

  /// Numbers of a row of Actuators that the plant takes.
  std::size_t channels() const { return channels_; }
  /// Outputs of the autopilot that are used, counted from the first.
  std::size_t outputs() const { return uses_.size(); }
  /// Whether output k drives a motor (or a brake): from 0 to 1.
  bool is_motor(std::size_t k) const { return uses_[k].kind == Kind::kMotor; }

  /// What `outputs` do, as the plant has it; bounded, what is not finite counts as 0.
  void apply(std::span<const double> outputs, std::span<float> channels) const;

 private:
  enum class Kind : std::uint8_t { kNone, kSurface, kMotor };
  struct Use {
    Kind kind = Kind::kNone;
    std::size_t channel = 0;
    double sign = 1;
  };

  std::vector<Use> uses_;
  std::size_t channels_ = 0;
};

}  // namespace skein::physics
