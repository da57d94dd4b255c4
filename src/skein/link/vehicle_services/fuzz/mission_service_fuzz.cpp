// SPDX-License-Identifier: Apache-2.0
// A list of mission items, whatever ground stations say and whenever: it is replaced
// whole, by what one of them has sent, or not at all.
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "skein/link/mavlink/dispatch.h"
#include "skein/link/mavlink/fuzz/message_feed.h"
#include "skein/link/mavlink/messages.h"
#include "skein/link/vehicle_services/mission_service.h"

namespace {

using namespace skein;
using namespace skein::vehicle_services;
using mavlink::Frame;
using mavlink::MissionResult;
using Item = MissionService::Item;
using Feed = mavlink::MessageFeed<mavlink::MissionCount, Item, mavlink::MissionRequestInt,
                                  mavlink::MissionRequest, mavlink::MissionRequestList,
                                  mavlink::MissionClearAll>;

bool is_good(const Item& item) {
  return item.z >= 0;
}

MissionResult check_items(const std::vector<Item>& items) {
  for (const Item& item : items)
    if (!is_good(item)) return MissionResult::kInvalidZ;
  return MissionResult::kAccepted;
}

bool is_same(const Item& a, const Item& b) {
  return mavlink::pack(a) == mavlink::pack(b);
}

MissionService::Options options_of(std::uint8_t byte) {
  return {static_cast<mavlink::MissionType>(byte % 3), std::size_t{byte} / 16,
          byte % 2 == 0};
}

struct Subject {
  explicit Subject(Feed& from) : feed(from) {}

  // What a station has said of an upload.
  struct Said {
    std::size_t count = 0;
    std::vector<Item> items;  // since the count
  };

  void open(Channel) {}
  void close(Channel channel) {
    service.close(channel);
    out.close(channel);
    unchanged();
  }

  void receive(const Frame& frame, Channel channel, Time now) {
    const Peer from{channel, frame.system(), frame.component()};
    accepted = sent = 0;
    bool cleared = false;
    mavlink::dispatch<mavlink::MissionCount>(frame, [&](const auto& m) {
      if (m.mission_type == type()) said[{from.system, from.component}] = {m.count, {}};
      service.handle(m, from, now, out);
    });
    mavlink::dispatch<Item>(frame, [&](const auto& m) {
      said[{from.system, from.component}].items.push_back(m);
      service.handle(m, from, now, out);
    });
    mavlink::dispatch<mavlink::MissionRequestList, mavlink::MissionRequestInt,
                      mavlink::MissionRequest>(
        frame, [&](const auto& m) { service.handle(m, from, out); });
    mavlink::dispatch<mavlink::MissionClearAll>(frame, [&](const auto&) {
      cleared = service.clear(from) == MissionResult::kAccepted;
    });
    SKEIN_CHECK(sent <= 1, sent);
    if (service.version() == version) return unchanged();
    SKEIN_CHECK(service.version() == version + 1 && !service.busy());
    if (cleared)
      SKEIN_CHECK(service.items().empty());
    else
      is_what(said.at({from.system, from.component}));
    version = service.version();
    items = service.items();
  }

  void step(Time now) {
    sent = 0;
    service.step(now, out);
    SKEIN_CHECK(sent <= 1, sent);
    unchanged();
  }

  void end() {
    step(feed.now() + Time::from_seconds(11));
    SKEIN_CHECK(!service.busy());
  }

  // Invariants.
  void unchanged() const {
    SKEIN_CHECK(service.version() == version && service.items().size() == items.size());
    for (std::size_t i = 0; i < items.size(); ++i)
      SKEIN_CHECK(is_same(service.items()[i], items[i]), i);
  }

  // The list is what a station has announced, and sent since, in its order.
  void is_what(const Said& station) const {
    SKEIN_CHECK(accepted == 1);
    const auto& list = service.items();
    const std::size_t homes = station.count > 0 ? first() : 0;
    SKEIN_CHECK(list.size() + homes == station.count, list.size(), station.count);
    SKEIN_CHECK(list.size() <= options.max_items);
    auto said_item = station.items.begin();
    for (std::size_t i = 0; i < list.size(); ++i) {
      SKEIN_CHECK(list[i].seq == i + homes && is_good(list[i]), i);
      while (said_item != station.items.end() && !is_same(*said_item, list[i]))
        ++said_item;
      SKEIN_CHECK(said_item != station.items.end(), i);
      ++said_item;
    }
  }

  void check_sent(Channel channel, std::span<const std::byte> bytes) {
    ++sent;
    SKEIN_CHECK(feed.is_open(channel), channel);
    mavlink::take_sent(bytes, [&](const Frame& frame) {
      const std::size_t all = service.items().size() + first();
      const bool known =
          mavlink::dispatch<mavlink::MissionAck>(
              frame,
              [&](const auto& m) {
                SKEIN_CHECK(m.mission_type == type());
                accepted += m.type == static_cast<std::uint8_t>(MissionResult::kAccepted);
              }) ||
          mavlink::dispatch<mavlink::MissionRequestInt>(
              frame,
              [&](const auto& m) {
                SKEIN_CHECK(m.mission_type == type() && service.busy());
                const auto of = said.find({m.target_system, m.target_component});
                SKEIN_CHECK(of != said.end() && m.seq < of->second.count, m.seq);
                SKEIN_CHECK(of->second.count <= options.max_items + first());
                Item item;
                item.seq = m.seq;
                item.mission_type = m.mission_type;
                feed.expect(item, channel, m.target_system, m.target_component);
              }) ||
          mavlink::dispatch<mavlink::MissionCount>(
              frame,
              [&](const auto& m) {
                SKEIN_CHECK(m.mission_type == type() && m.count == all, m.count);
              }) ||
          mavlink::dispatch<Item, mavlink::MissionItem>(frame, [&](const auto& m) {
            SKEIN_CHECK(m.mission_type == type() && m.seq < all, m.seq);
          });
      SKEIN_CHECK(known, frame.message->name);
    });
  }

  std::uint8_t type() const { return static_cast<std::uint8_t>(options.type); }
  std::size_t first() const { return options.home_is_first ? 1 : 0; }

  Feed& feed;
  MissionService::Options options = options_of(feed.option());
  MissionService service{options, check_items};
  Outbox out{7, 1, [this](Channel to, auto bytes) { check_sent(to, bytes); }};
  // What is there, by what was seen.
  std::vector<Item> items;
  std::uint32_t version = 0;
  std::map<std::pair<std::uint8_t, std::uint8_t>, Said> said;
  int accepted = 0, sent = 0;  // by the last message
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Feed feed({data, size}, 7, 1);
  Subject subject(feed);
  feed.run(subject);
  subject.end();
  return 0;
}
