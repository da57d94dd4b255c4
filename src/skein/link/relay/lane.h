// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>  // before Asio, which lacks it in C++20

#include <boost/asio/steady_timer.hpp>
#include <chrono>
#include <functional>
#include <optional>

#include "skein/link/relay/relay_core.h"

namespace skein::relay {

/// One direction of a session: its channel, and the timer that wakes it when something
/// goes out next.
class Lane {
 public:
  Lane(RelayCore& core, impairment::ImpairedChannel channel)
      : core_(core), channel_(std::move(channel)), timer_(core.io()) {}

  impairment::ImpairedChannel& channel() { return channel_; }

  /// Calls `wake` when the channel has something next; a call that is waited for already
  /// and comes no later is left as it is. `wake` keeps alive what this belongs to.
  template <class Wake>
  void wait(Wake wake) {
    const auto next = channel_.next();
    if (!next || (waits_for_ && *waits_for_ <= *next)) return;
    waits_for_ = next;
    timer_.expires_at(core_.begin() + std::chrono::nanoseconds(next->ns()));
    timer_.async_wait([this, wake](boost::system::error_code error) {
      if (error) return;
      waits_for_.reset();
      wake();
    });
  }

  void stop() { timer_.cancel(); }

  /// What the channel counts, and what it holds.
  DirectionReport report() const {
    DirectionReport report;
    report.counts = channel_.counts();
    report.waiting_packets = channel_.waiting_packets();
    report.waiting_bytes = channel_.waiting_bytes();
    report.under_way = channel_.under_way();
    return report;
  }

 private:
  RelayCore& core_;
  impairment::ImpairedChannel channel_;
  boost::asio::steady_timer timer_;
  std::optional<Time> waits_for_;
};

}  // namespace skein::relay
