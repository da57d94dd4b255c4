// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "skein/base/time.h"
#include "skein/link/mavlink/constants.h"
#include "skein/link/mavlink/messages.h"
#include "skein/link/vehicle_services/outbox.h"

namespace skein::vehicle_services {

/// One list that ground stations load up to a vehicle and down from it: mission, fence or
/// rally points.
///
/// An upload replaces the list whole or not at all: until its last item is there, and
/// found good, the old one counts. Items that are lost on the way are asked for again
/// each half second, for up to ten seconds without any that is new. While one uploads,
/// others are refused. Items are asked for as MISSION_ITEM_INT and taken as MISSION_ITEM
/// too; who asks by MISSION_REQUEST is given MISSION_ITEM.
class MissionService {
 public:
  using Item = mavlink::MissionItemInt;
  using Check = std::function<mavlink::MissionResult(const std::vector<Item>&)>;

  struct Options {
    mavlink::MissionType type = mavlink::MissionType::kMission;
    std::size_t max_items = 2000;
    /// Item 0 of what is sent is home, as with ArduPilot: it is given out, and what comes
    /// as such is left out.
    bool home_is_first = false;
  };

  /// @param check  what is wrong with a whole list, or kAccepted.
  MissionService(const Options& options, Check check);

  void handle(const mavlink::MissionCount& count, const Peer& from, Time now,
              Outbox& out);
  void handle(const Item& item, const Peer& from, Time now, Outbox& out);
  void handle(const mavlink::MissionRequestList& request, const Peer& from, Outbox& out);
  void handle(const mavlink::MissionRequestInt& request, const Peer& from, Outbox& out);
  void handle(const mavlink::MissionRequest& request, const Peer& from, Outbox& out);

  /// Replaces the list by an empty one, for a ground station; who asked is answered by
  /// the caller, once for all lists that it asked for.
  mavlink::MissionResult clear(const Peer& from);

  /// The link is gone: what was being loaded up over it is forgotten.
  void close(Channel channel);

  /// Asks again for what is missing, gives up what has taken too long.
  void step(Time now, Outbox& out);

  /// Home, for what is given out; only with `home_is_first`.
  void set_home(const Item& home) { home_ = home; }

  /// Without home.
  const std::vector<Item>& items() const { return items_; }
  /// Counts how often the list was replaced.
  std::uint32_t version() const { return version_; }
  /// Somebody is loading up.
  bool busy() const { return upload_.has_value(); }
  /// Somebody else is.
  bool busy_for(const Peer& from) const;

 private:
  struct Upload {
    Peer from;
    std::size_t count = 0;
    std::vector<Item> items;
    Time asked;   // when for the next item, last
    Time gained;  // when the last new one came
  };

  bool is_mine(std::uint8_t type) const {
    return type == static_cast<std::uint8_t>(options_.type);
  }
  std::size_t first() const { return options_.home_is_first ? 1 : 0; }
  // The item with this number, for a ground station.
  std::optional<Item> item_for(const Peer& to, std::size_t number) const;
  void ask(Time now, Outbox& out);
  void finish(Outbox& out);
  void answer(const Peer& to, mavlink::MissionResult result, Outbox& out) const;

  Options options_;
  Check check_;
  std::vector<Item> items_;
  Item home_;
  std::uint32_t version_ = 0;
  std::optional<Upload> upload_;
  // Whose upload ended last, with its number of items: the answer may have been lost.
  std::optional<Peer> ended_;
  std::size_t ended_count_ = 0;
  mavlink::MissionResult result_ = mavlink::MissionResult::kAccepted;
};

/// The same item with floats: places in degrees, good to about a metre.
mavlink::MissionItem with_floats(const mavlink::MissionItemInt& item);
/// The same item with integers; a place that is no number becomes kNoCoordinate.
mavlink::MissionItemInt with_integers(const mavlink::MissionItem& item);

}  // namespace skein::vehicle_services
