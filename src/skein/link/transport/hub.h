// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>  // before Asio, which lacks it in C++20

#include <boost/asio/io_context.hpp>
#include <cstddef>
#include <map>
#include <span>
#include <string>

#include "skein/link/transport/endpoints.h"

namespace skein::transport {

/// An endpoint as Endpoints keeps it: its handlers hold on to it while they wait.
class Endpoint {
 public:
  virtual ~Endpoint() = default;
  virtual bool send(ChannelId channel, std::span<const std::byte> bytes) = 0;
  /// Where a server waits; empty for what does not.
  virtual std::string place() const { return {}; }
};

/// What all endpoints share: the loop, and the numbers of their channels.
struct Loop {
  explicit Loop(ChannelListener& to) : listener(to) {}

  boost::asio::io_context io{1};
  ChannelListener& listener;
  ChannelId next = 1;
  std::map<ChannelId, Endpoint*> owners;
};

/// The loop as one endpoint sees it.
struct Hub {
  Hub(Loop& of, EndpointId number)
      : io(of.io), listener(of.listener), loop(of), endpoint(number) {}

  ChannelId open(Endpoint& owner, const std::string& name) {
    const ChannelId channel = loop.next++;
    loop.owners.emplace(channel, &owner);
    listener.opened(channel, endpoint, name);
    return channel;
  }
  void close(ChannelId channel, const std::string& why) {
    if (loop.owners.erase(channel) > 0) listener.closed(channel, why);
  }

  boost::asio::io_context& io;
  ChannelListener& listener;
  Loop& loop;
  EndpointId endpoint;
};

}  // namespace skein::transport
