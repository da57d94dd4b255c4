// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "skein/base/result.h"
#include "skein/base/time.h"
#include "skein/geo/rotation.h"
#include "skein/geo/vec.h"

/// What ArduPilot's simulator (SITL, model "JSON") exchanges with the program that moves
/// the aircraft: datagrams with pulse widths come, lines of text go back. One step of the
/// autopilot each; it waits for the answer.
namespace skein::physics {

/// What the autopilot commands its servos and motors.
struct ServoFrame {
  static constexpr std::size_t kMaxChannels = 32;

  std::uint16_t frame_rate_hz = 0;  ///< steps per second that it requests
  std::uint32_t frame_count = 0;    ///< rises by one with each answer that it has taken
  std::size_t channels = 0;         ///< 16 or 32
  std::array<std::uint16_t, kMaxChannels> pwm_us{};  ///< pulse widths; 0: no output
};

/// Reads a datagram: little-endian, packed; the magic number 18458 for 16 channels, 29569
/// for 32.
/// Fails: kBadInput for another magic number, or a length that does not go with it.
Result<ServoFrame> parse_servo_frame(std::span<const std::byte> datagram);

/// What a battery monitor shows; SITL 4.5 makes its own and passes this over.
struct PhysicsBattery {
  double voltage = 0;  ///< [V]
  double current = 0;  ///< [A]
};

/// The motion of the aircraft, from which SITL makes what its sensors measure. N begins
/// at SITL's home; its altitude is that of home less p_N.z().
struct PhysicsFrame {
  /// Of the simulation, absolute. SITL's clock goes on by the difference to the frame
  /// before; the first difference is that to 0.
  Time time;
  Vec3 w_NB_B = Vec3::Zero();    ///< rate of turn [rad/s]
  Vec3 f_B = Vec3::Zero();       ///< specific force: acceleration less gravity [m/s^2]
  Vec3 p_N = Vec3::Zero();       ///< [m]
  Vec3 v_N = Vec3::Zero();       ///< over ground [m/s]
  Quat q_NB = Quat::Identity();  ///< attitude
  double airspeed = 0;           ///< [m/s]
  std::optional<double> range;   ///< that the first rangefinder measures [m]
  std::optional<PhysicsBattery> battery;
  /// Steps come as fast as they are answered. Otherwise SITL sleeps between them, as its
  /// own speed-up says.
  bool paced_by_sender = true;
};

/// Writes the frame as the line that SITL reads, in place of what `text` holds. Numbers
/// have the digits that give them back exactly.
///
/// SITL's parser looks for names, not for structure: a value follows the colon at once,
/// and no name stands where another one would be found first.
/// Fails: kBadInput for a number that is not finite, naming it.
Result<void> write_json(const PhysicsFrame& frame, std::string& text);

/// What a frame is, by its count and that of the one before.
enum class ServoStep : std::uint8_t {
  kBegin,   ///< the first one, or a smaller count: the program has (re)started
  kNext,    ///< it has taken the last answer and waits for the next
  kRepeat,  ///< the last answer has not reached it
};

/// Follows the counts of one program.
class ServoFollower {
 public:
  ServoStep take(std::uint32_t frame_count);

  /// Frames between two that have come, by their counts.
  std::uint64_t missed() const { return missed_; }

 private:
  std::optional<std::uint32_t> last_;
  std::uint64_t missed_ = 0;
};

}  // namespace skein::physics
