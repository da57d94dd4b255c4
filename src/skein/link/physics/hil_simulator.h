// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "skein/base/result.h"
#include "skein/link/physics/hil.h"
#include "skein/link/physics/hil_session.h"
#include "skein/link/transport/endpoints.h"

namespace skein::physics {

/// Where instance n of PX4's SITL looks for its simulator: 4560 + n.
constexpr std::uint16_t px4_port(int instance) {
  return static_cast<std::uint16_t>(4560 + instance);
}

struct HilOptions {
  /// `tcpin:` px4_port() for PX4 in SITL, a serial line for autopilot hardware.
  transport::EndpointAddress at;
  /// Each step waits for what the autopilot makes of it; off: real time.
  bool lock_step = true;
  std::uint8_t system = 1, component = 200;  ///< of the simulator in MAVLink
};

/// What became of a step.
enum class HilOutcome : std::uint8_t {
  kNotConnected,  ///< nobody is there; nothing was sent
  kNoControls,    ///< none yet: it boots; in real time: none since the last step
  kControls,      ///< new ones have come
  kTimedOut,      ///< it answered before, but not within the patience
};

struct HilReply {
  HilOutcome outcome = HilOutcome::kNotConnected;
  HilControls controls;  ///< the newest of this connection; all 0 before the first
};

/// What has happened since it was opened.
struct HilCounts {
  std::uint64_t connections = 0;
  std::uint64_t controls = 0;  ///< steps with new ones
  std::uint64_t timeouts = 0;
  std::uint64_t dropped = 0;  ///< frames that could not go out in time
};

/// The simulator's side of an autopilot that has its sensors from outside: PX4 in SITL,
/// or autopilot hardware.
///
/// In lock-step the time of the sensors is PX4's clock. Until its first controls come
/// (its programs start one after the other, by that clock), and after a step without an
/// answer until the next, a step takes as long as it is in simulated time, so that
/// neither side waits for ever and the line does not fill. Otherwise it takes as long as
/// the autopilot does, at most `patience`.
///
/// An autopilot that reboots connects again; nothing of the one before is kept. Of two
/// that are connected the newer one counts.
///
/// Threads: one at a time may call; the calls block that thread only. There is no other.
class HilSimulator final : private transport::ChannelListener {
 public:
  /// Fails: kBadInput where nothing can wait at that place.
  static Result<std::unique_ptr<HilSimulator>> open(const HilOptions& options);

  ~HilSimulator() override = default;
  HilSimulator(const HilSimulator&) = delete;
  HilSimulator& operator=(const HilSimulator&) = delete;

  bool connected() const { return session_.has_value(); }
  /// Where it waits, with the port that it has got; empty for a line.
  std::string place() const;

  /// Sends what belongs to the next step: fixes at their own rate, further sensors (a
  /// unit above 0), the truth (goes out as often as the autopilot has asked).
  void send(const HilFix& fix);
  void send(const HilSensors& more);
  void send(const HilTruth& truth);

  /// Sends what the first unit measures, and waits for the controls that the autopilot
  /// makes of it. In real time it waits for nothing.
  /// @param sensors  of unit 0, later than those of the step before by a microsecond at
  ///                 least, and than 0; Bug otherwise.
  HilReply step(const HilSensors& sensors, std::chrono::milliseconds patience);

  /// Serves the connection while simulated time stands still: connections, requests, a
  /// heartbeat each second (which step() sends too).
  void serve(std::chrono::milliseconds duration);

  const HilCounts& counts() const { return counts_; }

 private:
  using Clock = std::chrono::steady_clock;

  explicit HilSimulator(const HilOptions& options)
      : options_(options), endpoints_(*this) {}

  void opened(transport::ChannelId channel, transport::EndpointId endpoint,
              const std::string& name) override;
  void received(transport::ChannelId channel, std::span<const std::byte> bytes) override;
  void closed(transport::ChannelId channel, const std::string& why) override;

  void send_out(std::span<const std::byte> bytes);
  void send_due_heartbeat();
  // Handles all that has come.
  void handle_waiting();
  bool take_controls();
  // How long a step of some length may wait.
  Clock::time_point deadline(Time length, std::chrono::milliseconds patience);
  // Waits for new controls; false without.
  bool wait_for_controls(Clock::time_point until);

  HilOptions options_;
  std::optional<HilSession> session_;
  transport::ChannelId channel_ = 0;
  HilControls controls_;
  bool answers_ = false;  // it did to the last step
  Time last_time_;
  Clock::time_point pace_;  // when the next step is due that nobody answers
  Clock::time_point heartbeat_due_;
  HilCounts counts_;
  transport::Endpoints endpoints_;
};

}  // namespace skein::physics
