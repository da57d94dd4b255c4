#include "skein/link/vehicle_services/mission_service.h"

#include <utility>

namespace skein::vehicle_services {
namespace {

using mavlink::MissionResult;

const Time kAgain = Time::from_seconds(0.5);
const Time kPatience = Time::from_seconds(10);

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
  if (upload_ && upload_->from != from) return answer(from, MissionResult::kDenied, out);
  if (count.count > options_.max_items + first()) {
    upload_.reset();
    return answer(from, MissionResult::kNoSpace, out);
  }
  // The same again: its answer, a request, was lost; step() asks for that.
  if (upload_ && upload_->count == count.count && upload_->items.empty()) return;
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
  if (upload_->from != from || item.seq != upload_->items.size()) return;
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

void MissionService::handle(const mavlink::MissionRequestInt& request, const Peer& from,
                            Outbox& out) {
  if (!is_mine(request.mission_type)) return;
  if (request.seq >= items_.size() + first())
    return answer(from, MissionResult::kInvalidSequence, out);
  Item item = request.seq < first() ? home_ : items_[request.seq - first()];
  item.seq = request.seq;
  item.target_system = from.system;
  item.target_component = from.component;
  item.mission_type = static_cast<std::uint8_t>(options_.type);
  out.send(from.channel, item);
}

void MissionService::handle(const mavlink::MissionClearAll& order, const Peer& from,
                            Outbox& out) {
  const bool all =
      order.mission_type == static_cast<std::uint8_t>(mavlink::MissionType::kAll);
  if (!all && !is_mine(order.mission_type)) return;
  if (upload_ && upload_->from != from) return answer(from, MissionResult::kDenied, out);
  upload_.reset();
  items_.clear();
  ++version_;
  answer(from, MissionResult::kAccepted, out);
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

}  // namespace skein::vehicle_services
