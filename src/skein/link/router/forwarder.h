// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "skein/link/mavlink/frame_parser.h"
#include "skein/link/mavlink/sequence_watch.h"
#include "skein/link/mavlink/tlog.h"
#include "skein/link/router/frame_router.h"
#include "skein/link/transport/endpoints.h"

namespace skein::router {

/// How a channel does.
struct ChannelHealth {
  std::string name;
  bool open = true;
  mavlink::ParserCounts in;
  std::uint64_t lost = 0;             ///< on the way here, by the senders' counts
  double loss = 0;                    ///< the same as a share of what was sent
  std::uint64_t out = 0;              ///< frames handed on
  std::uint64_t dropped = 0;          ///< that could not go out in time
  std::vector<std::uint8_t> systems;  ///< heard on it
};

/// What happened to a channel: opened, or closed and why.
using ChannelNews = std::function<void(const std::string&)>;

/// Hands MAVLink frames on between endpoints, byte for byte, and records them.
class Forwarder final : public transport::ChannelListener {
 public:
  /// @param clock  microseconds since 1970.
  Forwarder(std::function<std::int64_t()> clock, ChannelNews news)
      : clock_(std::move(clock)), news_(std::move(news)), endpoints_(*this) {}

  transport::Endpoints& endpoints() { return endpoints_; }

  /// Whether commands, parameters and missions without a signature are handed on that
  /// come from beyond this machine (mavlink::changes_nothing()); as they are by default.
  void hand_on_unsigned_orders(bool yes) { unsigned_orders_ = yes; }
  /// Of those, how many were not.
  std::uint64_t refused_orders() const { return refused_orders_; }

  void record_to(mavlink::TlogWriter tlog) { tlog_ = std::move(tlog); }
  /// Fails: as TlogWriter::flush(); never without a record.
  Result<void> flush();

  /// Of the channels that are open, and of those that were, up to 100 of them.
  std::vector<ChannelHealth> health() const;

 private:
  struct Peer {
    ChannelHealth health;
    mavlink::FrameParser parser;
    mavlink::SequenceWatch watch;
    bool is_local = true;
  };

  void opened(transport::ChannelId channel, transport::EndpointId endpoint,
              const std::string& name) override;
  void received(transport::ChannelId channel, std::span<const std::byte> bytes) override;
  void closed(transport::ChannelId channel, const std::string& why) override;
  ChannelHealth health_of(transport::ChannelId channel, const Peer& peer) const;

  std::function<std::int64_t()> clock_;
  ChannelNews news_;
  std::map<transport::ChannelId, Peer> peers_;
  std::vector<ChannelHealth> gone_;
  FrameRouter router_;
  std::vector<Channel> to_;  // used again for each frame
  std::optional<mavlink::TlogWriter> tlog_;
  bool unsigned_orders_ = true;
  std::uint64_t refused_orders_ = 0;
  transport::Endpoints endpoints_;
};

}  // namespace skein::router
