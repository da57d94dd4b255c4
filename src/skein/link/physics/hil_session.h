// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>

#include "skein/base/time.h"
#include "skein/link/mavlink/frame_parser.h"
#include "skein/link/mavlink/frame_writer.h"
#include "skein/link/physics/hil.h"

namespace skein::physics {

/// One connection of a simulator with an autopilot: messages out, controls and requests
/// in. Without clock and sockets.
///
/// SET_MESSAGE_INTERVAL is obeyed for HIL_STATE_QUATERNION, which nobody gets who has not
/// asked for it; it and other commands are acknowledged.
class HilSession {
 public:
  using Sink = std::function<void(std::span<const std::byte>)>;

  /// @param system, component  the simulator's own.
  /// @param sink  is given each frame; its bytes are gone when the call returns.
  HilSession(std::uint8_t system, std::uint8_t component, Sink sink)
      : writer_(system, component), sink_(std::move(sink)) {}

  /// Bytes that have come, cut anywhere.
  void received(std::span<const std::byte> bytes);

  void send(const HilSensors& sensors) { write(message_of(sensors)); }
  void send(const HilFix& fix) { write(message_of(fix)); }
  /// Sends it when it is due by the interval that the autopilot has asked for.
  void send(const HilTruth& truth);
  void send_heartbeat();

  /// The newest controls, when some have come since the last call.
  std::optional<HilControls> take_controls();

  /// What the autopilot's heartbeat says of its make (MAV_AUTOPILOT); none yet.
  std::optional<std::uint8_t> autopilot() const { return autopilot_; }

  const mavlink::ParserCounts& counts() const { return parser_.counts(); }

 private:
  template <mavlink::Message T>
  void write(const T& message) {
    sink_(writer_.write(message));
  }
  void handle(const mavlink::Frame& frame);
  void obey(const mavlink::CommandLong& command, const mavlink::Frame& frame);

  mavlink::FrameWriter writer_;
  mavlink::FrameParser parser_;
  Sink sink_;
  std::optional<HilControls> controls_;
  std::optional<std::uint8_t> autopilot_;
  std::optional<Time> truth_interval_;  // none: nobody wants it
  std::optional<Time> truth_due_;       // none: now
};

}  // namespace skein::physics
