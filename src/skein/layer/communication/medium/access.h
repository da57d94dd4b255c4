// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "skein/layer/communication/medium/channel.h"
#include "skein/layer/communication/medium/packet_queue.h"
#include "skein/layer/communication/medium/schedule.h"

namespace skein::communication {

/// Who sends when: an access method of all nodes of a medium.
class Access : public ChannelListener {
 public:
  /// The transceivers, which tell this what they hear; once, before anything else.
  virtual void use(Channel& channel) = 0;

  /// The packets of a node that wait or are in service.
  virtual PacketQueue& queue(NodeIndex node) = 0;

  /// A packet waits to be sent; it goes into the queue, whatever there is already.
  virtual void enqueue(std::uint32_t packet, Time now) = 0;

  /// An event of a station, of the kinds from kAccess on, that this has scheduled.
  virtual void handle(const Schedule::Event& event) = 0;
};

}  // namespace skein::communication
