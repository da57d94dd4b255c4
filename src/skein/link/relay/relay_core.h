// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>  // before Asio, which lacks it in C++20

#include <array>
#include <boost/asio/io_context.hpp>
#include <boost/asio/steady_timer.hpp>
#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "skein/link/impairment/impaired_channel.h"
#include "skein/link/relay/relay.h"

namespace skein::relay {

/// A session as the core knows it.
class Session {
 public:
  virtual ~Session() = default;
  virtual impairment::ImpairedChannel& channel(impairment::Direction direction) = 0;
  /// Its channels have changed: sends what is due, and waits for the rest.
  virtual void pump() = 0;
  /// Closes its sockets; nothing waits for it any more.
  virtual void stop() = 0;
  virtual SessionReport report() = 0;
};

/// What relays of UDP and of TCP share: the loop, the clock, the plan, the sessions.
class RelayCore {
 public:
  /// @param options  outlives it.
  RelayCore(const RelayOptions& options, RelayNews news);

  boost::asio::io_context& io() { return io_; }
  const RelayOptions& options() const { return options_; }
  std::chrono::steady_clock::time_point begin() const { return begin_; }

  /// The time since the begin. What the plan says up to then is in force in all channels
  /// when this returns.
  Time now();

  void run_for(std::chrono::milliseconds duration);
  void change(impairment::Directions directions,
              const impairment::ImpairmentChange& change);
  void cut(impairment::Directions directions, Time length);
  void reset();

  /// The number of the session that is added next.
  std::uint32_t next_number() const { return report_.sessions + 1; }
  impairment::ImpairedChannel make_channel(impairment::Traffic traffic,
                                           std::uint32_t session,
                                           impairment::Direction direction) const;
  bool full() const { return sessions_.size() >= Relay::kMaxSessions; }
  void add(std::uint32_t number, const std::shared_ptr<Session>& session);
  /// Forgets a session, but for what it has counted.
  void remove(std::uint32_t number, const std::string& why);
  void count_failed() { ++report_.failed; }
  void count_turned_away() { ++report_.turned_away; }

  /// Stops all sessions, before what they refer to goes.
  void stop();

  RelayReport report() const;
  std::vector<SessionReport> sessions() const;
  std::vector<SessionReport> take_ended() { return std::exchange(ended_, {}); }

 private:
  void set_all(Time now);
  void pump_all();
  void wait_for_plan();

  const RelayOptions& options_;
  RelayNews news_;
  boost::asio::io_context io_{1};
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  impairment::ImpairmentSchedule schedule_;
  boost::asio::steady_timer plan_timer_;
  std::array<Time, 2> cut_until_;  // by cut(), for sessions that begin meanwhile
  std::map<std::uint32_t, std::shared_ptr<Session>> sessions_;
  RelayReport report_;  // of sessions that have ended
  std::vector<SessionReport> ended_;
};

}  // namespace skein::relay
