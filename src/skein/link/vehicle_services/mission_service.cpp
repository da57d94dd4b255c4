// SPDX-License-Identifier: Apache-2.0
#include "skein/link/vehicle_services/mission_service.h"

#include <utility>

#include "skein/link/vehicle_services/places.h"

namespace skein::vehicle_services {
namespace {

using mavlink::MissionResult;

const Time kAgain = Time::from_seconds(0.5);
const Time kPatience = Time::from_seconds(10);

// A ground station stays the same when its link changes.
bool is_same_station(const Peer& a, const Peer& b) {
  return a.system == b.system && a.component == b.component;
}

template <class T>
T addressed(const Peer& to, mavlink::MissionType type) {
  T message;
  message.target_system = to.system;
  message.target_component = to.component;
  message.mission_type = static_cast<std::uint8_t>(type);
  return message;
}

}  // namespace

MissionService::MissionService(const Options& options, Check check)
    : options_(options), check_(std::move(check)) {}

void MissionService::answer(const Peer& to, MissionResult result, Outbox& out) const {
  auto ack = addressed<mavlink::MissionAck>(to, options_.type);
  ack.type = static_cast<std::uint8_t>(result);
  out.send(to.channel, ack);
}

void MissionService::ask(Time now, Outbox& out) {
  auto request = addressed<mavlink::MissionRequestInt>(upload_->from, options_.type);
  request.seq = static_cast<std::uint16_t>(upload_->items.size());
  out.send(upload_->from.channel, request);
  upload_->asked = now;
}

void MissionService::handle(const mavlink::MissionCount& count, const Peer& from,
                            Time now, Outbox& out) {
  if (!is_mine(count.mission_type)) return;
  if (busy_for(from)) return answer(from, MissionResult::kDenied, out);
  if (count.count > options_.max_items + first()) {
    upload_.reset();
    return answer(from, MissionResult::kNoSpace, out);
  }
  // The same again: its answer, a request, was lost; step() asks for that.
  if (upload_ && upload_->from == from && upload_->count == count.count &&
      upload_->items.empty())
    return;
  upload_ = Upload{from, count.count, {}, now, now};
  ended_.reset();
  if (count.count == 0) return finish(out);
  ask(now, out);
}

void MissionService::handle(const Item& item, const Peer& from, Time now, Outbox& out) {
  if (!is_mine(item.mission_type)) return;
  if (!upload_) {
    if (ended_ == from && item.seq + std::size_t{1} == ended_count_)
      answer(from, result_, out);
    return;
  }
  // Others' items, and those that come twice or too early, are passed over: step() asks.
  if (!is_same_station(upload_->from, from) || item.seq != upload_->items.size()) return;
  upload_->from.channel = from.channel;
  upload_->items.push_back(item);
  upload_->gained = now;
  if (upload_->items.size() == upload_->count) return finish(out);
  ask(now, out);
}

void MissionService::finish(Outbox& out) {
  Upload done = std::move(*upload_);
  upload_.reset();
  if (options_.home_is_first && !done.items.empty()) done.items.erase(done.items.begin());
  result_ = check_(done.items);
  ended_ = done.from;
  ended_count_ = done.count;
  if (result_ == MissionResult::kAccepted) {
    items_ = std::move(done.items);
    ++version_;
  }
  answer(done.from, result_, out);
}

void MissionService::handle(const mavlink::MissionRequestList& request, const Peer& from,
                            Outbox& out) {
  if (!is_mine(request.mission_type)) return;
  auto count = addressed<mavlink::MissionCount>(from, options_.type);
  count.count = static_cast<std::uint16_t>(items_.size() + first());
  out.send(from.channel, count);
}

std::optional<MissionService::Item> MissionService::item_for(const Peer& to,
                                                             std::size_t number) const {
  if (number >= items_.size() + first()) return std::nullopt;
  Item item = number < first() ? home_ : items_[number - first()];
  item.seq = static_cast<std::uint16_t>(number);
  item.target_system = to.system;
  item.target_component = to.component;
  item.mission_type = static_cast<std::uint8_t>(options_.type);
  return item;
}

void MissionService::handle(const mavlink::MissionRequestInt& request, const Peer& from,
                            Outbox& out) {
  if (!is_mine(request.mission_type)) return;
  if (const auto item = item_for(from, request.seq)) return out.send(from.channel, *item);
  answer(from, MissionResult::kInvalidSequence, out);
}

void MissionService::handle(const mavlink::MissionRequest& request, const Peer& from,
                            Outbox& out) {
  if (!is_mine(request.mission_type)) return;
  if (const auto item = item_for(from, request.seq))
    return out.send(from.channel, with_floats(*item));
  answer(from, MissionResult::kInvalidSequence, out);
}

bool MissionService::busy_for(const Peer& from) const {
  return upload_ && !is_same_station(upload_->from, from);
}

MissionResult MissionService::clear(const Peer& from) {
  if (busy_for(from)) return MissionResult::kDenied;
  const MissionResult result = check_({});
  if (result != MissionResult::kAccepted) return result;
  upload_.reset();
  items_.clear();
  ++version_;
  return result;
}

void MissionService::close(Channel channel) {
  if (upload_ && upload_->from.channel == channel) upload_.reset();
}

void MissionService::step(Time now, Outbox& out) {
  if (!upload_) return;
  if (now - upload_->gained >= kPatience) {
    answer(upload_->from, MissionResult::kCancelled, out);
    upload_.reset();
  } else if (now - upload_->asked >= kAgain) {
    ask(now, out);
  }
}

mavlink::MissionItem with_floats(const mavlink::MissionItemInt& item) {
  mavlink::MissionItem same;
  same.target_system = item.target_system;
  same.target_component = item.target_component;
  same.seq = item.seq;
  same.frame = item.frame;
  same.command = item.command;
  same.current = item.current;
  same.autocontinue = item.autocontinue;
  same.param1 = item.param1;
  same.param2 = item.param2;
  same.param3 = item.param3;
  same.param4 = item.param4;
  same.x = static_cast<float>(coordinate(item.frame, item.x));
  same.y = static_cast<float>(coordinate(item.frame, item.y));
  same.z = item.z;
  same.mission_type = item.mission_type;
  return same;
}

mavlink::MissionItemInt with_integers(const mavlink::MissionItem& item) {
  mavlink::MissionItemInt same;
  same.target_system = item.target_system;
  same.target_component = item.target_component;
  same.seq = item.seq;
  same.frame = item.frame;
  same.command = item.command;
  same.current = item.current;
  same.autocontinue = item.autocontinue;
  same.param1 = item.param1;
  same.param2 = item.param2;
  same.param3 = item.param3;
  same.param4 = item.param4;
  same.x = integer_coordinate(item.frame, static_cast<double>(item.x));
  same.y = integer_coordinate(item.frame, static_cast<double>(item.y));
  same.z = item.z;
  same.mission_type = item.mission_type;
  return same;
}

}  // namespace skein::vehicle_services
