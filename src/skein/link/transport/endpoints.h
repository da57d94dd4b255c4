// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "skein/base/result.h"
#include "skein/link/transport/endpoint_address.h"

namespace skein::transport {

/// One peer of an endpoint: a connection, a sender of datagrams, the far end of a line.
/// Numbers are never used again.
using ChannelId = std::uint32_t;

/// Endpoints in the order in which they were opened, from 0.
using EndpointId = std::uint32_t;

/// Whoever is told what happens; called by run_for() and run_one_for() of Endpoints only.
class ChannelListener {
 public:
  virtual ~ChannelListener() = default;
  /// @param name  endpoint and peer, for people.
  virtual void opened(ChannelId channel, EndpointId endpoint,
                      const std::string& name) = 0;
  /// The bytes are gone when the call returns.
  virtual void received(ChannelId channel, std::span<const std::byte> bytes) = 0;
  virtual void closed(ChannelId channel, const std::string& why) = 0;
};

/// Whether only programs of this machine are at the far end of a channel.
/// @param name  as ChannelListener::opened() has it: the peer of a server, or the place
///              of a client. A serial line is a way out of the machine, a pseudo-terminal
///              not.
bool is_local_channel(const std::string& name);

/// Sockets and serial lines, without threads of their own: everything happens in
/// run_for() and run_one_for(), in the thread of their caller.
///
/// Clients and serial lines that fail are tried again each second. Who sends datagrams to
/// a server and then nothing for a minute is forgotten. No peer makes it hold more than a
/// fixed number of bytes: what does not go out in time is dropped whole, and counted.
class Endpoints {
 public:
  explicit Endpoints(ChannelListener& listener);
  ~Endpoints();

  /// Opens another endpoint.
  /// @returns  its number.
  /// Fails: kBadInput where a server cannot wait at its place, or a host has no address.
  Result<EndpointId> open(const EndpointAddress& address);

  /// Where the servers wait, in the order in which they were opened, with the ports that
  /// they have got.
  std::vector<std::string> places() const;

  /// Where a server waits, with the port that it has got; "" for the others.
  std::string place(EndpointId endpoint) const;

  /// Sends bytes to a peer, or drops them; nothing for a channel that is closed.
  /// @returns  false when they were dropped.
  bool send(ChannelId channel, std::span<const std::byte> bytes);

  /// Waits for what comes, and handles it, for this long, or until wake().
  void run_for(std::chrono::milliseconds duration);

  /// Makes run_for() return at once: the one under way, else the next. Any thread may
  /// call it.
  void wake();

  /// Waits up to this long for the next thing that happens, and handles it.
  /// @returns  false when nothing has happened.
  bool run_one_for(std::chrono::nanoseconds patience);

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace skein::transport
