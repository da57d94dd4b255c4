// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <vector>

#include "skein/link/mavlink/frame.h"

namespace skein::router {

/// A link that frames come in and go out by.
using Channel = std::uint32_t;

/// Whether a frame carries a key for signing (SETUP_SIGNING), which is for one link only:
/// it is neither handed on nor recorded.
bool carries_key(const mavlink::Frame& frame);

/// Decides where frames go, by the systems that were heard on each channel:
///
///   for all, or of a kind that is not known here    to every other channel
///   for a system, or a component of it              to the other channels on which it
///                                                   was heard; nowhere when on none
///
/// No frame goes back to where it came from, and none with a key goes anywhere. A system
/// whose clock goes back has begun anew: where it was heard before is forgotten.
class FrameRouter {
 public:
  void open(Channel channel) { channels_.insert(channel); }
  void close(Channel channel);

  /// Learns from a frame, and replaces `out` by the channels that it goes to.
  void route(Channel from, const mavlink::Frame& frame, std::vector<Channel>& out);

  /// The systems that were heard on a channel.
  std::vector<std::uint8_t> systems_of(Channel channel) const;

 private:
  struct Component {
    std::uint8_t system, component;
    auto operator<=>(const Component&) const = default;
  };

  void learn(Channel from, const mavlink::Frame& frame);

  std::set<Channel> channels_;
  std::map<Component, std::set<Channel>> heard_;
  std::map<std::uint8_t, std::uint32_t> clocks_;  // time since boot by system [ms]
};

}  // namespace skein::router
