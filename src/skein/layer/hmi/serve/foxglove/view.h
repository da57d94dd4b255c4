// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "skein/data/event/live.h"
#include "skein/layer/hmi/serve/foxglove/messages.h"
#include "skein/layer/hmi/serve/foxglove/protocol.h"

namespace skein::hmi::foxglove {

/// What a live feed has said, as channels with their last messages.
class View {
 public:
  /// A message of a channel.
  struct Said {
    std::uint32_t channel = 0;
    std::uint64_t time_ns = 0;  ///< since 1970
    std::string payload;
  };

  explicit View(Facts facts);

  void take(const std::vector<LiveItem>& items);

  /// The run has ended.
  bool is_over() const { return clock_.over; }

  /// All that there are.
  const std::vector<Channel>& channels() const { return channels_; }
  /// Those that have come since the last call.
  std::vector<Channel> take_new_channels();

  /// What has happened since the last call: events and metrics, each of them.
  std::vector<Said> take_happened();
  /// Channels that show how something is, where that has changed since the last call.
  std::set<std::uint32_t> take_changed();
  /// How it is; none: nothing is known of it.
  std::optional<Said> state(std::uint32_t channel) const;

 private:
  void take_record(const Record& record);
  void add_channel(std::uint32_t id, std::string topic, const char* schema_name,
                   std::string schema);
  void clear();

  Messages messages_;
  std::vector<Channel> channels_;
  std::size_t announced_ = 0;  // of them
  Messages::Names names_;
  FleetFrame fleet_;
  RunClock clock_;
  Messages::Boundaries boundaries_;
  Messages::Zones zones_;
  Messages::Paths paths_;
  std::vector<Said> happened_;
  std::set<std::uint32_t> changed_;
};

}  // namespace skein::hmi::foxglove
