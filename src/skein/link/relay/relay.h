// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "skein/base/result.h"
#include "skein/base/time.h"
#include "skein/link/impairment/channel_counts.h"
#include "skein/link/impairment/impairment_schedule.h"
#include "skein/link/transport/endpoint_address.h"

namespace skein::relay {

struct RelayOptions {
  transport::EndpointAddress listen;  ///< UdpServer or TcpServer: where end a calls
  transport::NetworkPlace to;         ///< end b, by the same protocol
  impairment::ImpairmentPlan plan;    ///< its time begins with the relay's
  std::uint64_t seed = 1;
  Time idle = Time::from_seconds(60);  ///< silence after which a UDP session ends
};

/// How one direction of a session does.
struct DirectionReport {
  impairment::ChannelCounts counts;
  std::uint64_t waiting_packets = 0, waiting_bytes = 0;  ///< for transmission, now
  std::uint64_t under_way = 0;  ///< packets or pieces, transmitted and not there, now
  std::uint64_t refused = 0;    ///< UDP: times that nobody was there
  std::uint64_t unsent = 0;     ///< UDP: packets that the system did not take

  DirectionReport& operator+=(const DirectionReport& other);
};

/// One who called, and the relay's own connection to the other end for it.
struct SessionReport {
  std::uint32_t number = 0;                   ///< from 1, in order of their begin
  std::string name;                           ///< HOST:PORT of who called
  std::array<DirectionReport, 2> directions;  ///< by index_of(Direction)
};

/// All of them together.
struct RelayReport {
  std::uint32_t sessions = 0;     ///< that there were
  std::uint32_t open = 0;         ///< of these, now
  std::uint64_t failed = 0;       ///< TCP: connections that end b did not take
  std::uint64_t turned_away = 0;  ///< packets (UDP) or connections of callers beyond
                                  ///< kMaxSessions, or for whom the system has no socket
  std::array<DirectionReport, 2> directions;
};

/// What happened to a session, for people.
using RelayNews = std::function<void(const std::string&)>;

/// Stands between the ends of UDP or TCP connections and impairs what passes. Each who
/// calls has a session with channels and a connection of its own; rates and queues are
/// those of a session, outages those of all. Without threads: everything happens in
/// run_for(), by timers.
///
/// Session n draws from streams of (seed, n): what happens to it does not depend on the
/// others.
class Relay {
 public:
  static constexpr std::size_t kMaxSessions = 512;

  /// Fails: kBadInput where `listen` is no server or its place is taken, where a host has
  /// no address, or where the relay would call itself.
  static Result<std::unique_ptr<Relay>> open(const RelayOptions& options, RelayNews news);
  virtual ~Relay() = default;

  /// Where it listens, with the port that it has got: "udpin:127.0.0.1:14560".
  virtual std::string place() const = 0;

  /// Passes on what comes, for this long.
  virtual void run_for(std::chrono::milliseconds duration) = 0;

  /// Since the begin.
  virtual Time now() const = 0;

  /// Changes the impairment from now on, until the plan changes it. For TCP it must not
  /// lose, double or reorder: such changes have no effect there.
  virtual void change(impairment::Directions directions,
                      const impairment::ImpairmentChange& change) = 0;
  /// An outage from now on.
  virtual void cut(impairment::Directions directions, Time length) = 0;
  /// Back to what the plan says; ends outages of cut().
  virtual void reset() = 0;

  virtual RelayReport report() const = 0;
  /// Of sessions that are open, in the order of their begin.
  virtual std::vector<SessionReport> sessions() const = 0;
  /// Of those that have ended since the last call, the last kMaxSessions of them.
  virtual std::vector<SessionReport> take_ended() = 0;
};

}  // namespace skein::relay
