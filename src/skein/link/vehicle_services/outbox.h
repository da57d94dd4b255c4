// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <span>

#include "skein/link/mavlink/frame_writer.h"
#include "skein/link/mavlink/link_security.h"

namespace skein::vehicle_services {

using Channel = mavlink::LinkSecurity::Channel;

/// Who has sent a message, and by which link.
struct Peer {
  Channel channel = 0;
  std::uint8_t system = 0, component = 0;
  bool operator==(const Peer&) const = default;
};

/// Frames of one component on their way out, counted for each link.
class Outbox {
 public:
  using Sink = std::function<void(Channel, std::span<const std::byte>)>;

  /// @param sink      is given each frame; its bytes are gone when the call returns.
  /// @param security  signs what goes out over secured links; null: nothing is signed. It
  ///                  is shared by all whose frames go out over the same links, and
  ///                  outlives them.
  Outbox(std::uint8_t system, std::uint8_t component, Sink sink,
         mavlink::LinkSecurity* security = nullptr)
      : system_(system),
        component_(component),
        sink_(std::move(sink)),
        security_(security) {}

  std::uint8_t system() const { return system_; }
  std::uint8_t component() const { return component_; }

  template <mavlink::Message T>
  void send(Channel channel, const T& message) {
    auto& writer =
        writers_.try_emplace(channel, mavlink::FrameWriter(system_, component_))
            .first->second;
    sink_(channel, security_ != nullptr ? security_->write(channel, writer, message)
                                        : writer.write(message));
  }

  /// The link is gone.
  void close(Channel channel) { writers_.erase(channel); }

 private:
  std::uint8_t system_, component_;
  Sink sink_;
  mavlink::LinkSecurity* security_;
  std::map<Channel, mavlink::FrameWriter> writers_;
};

}  // namespace skein::vehicle_services
