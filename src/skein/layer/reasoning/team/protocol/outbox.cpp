// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/team/protocol/outbox.h"

#include <utility>

namespace skein::reasoning {

void TeamOutbox::begin(Time now) {
  time_ = now;
  step_ = {};
}

TeamStep TeamOutbox::take() {
  return std::exchange(step_, {});
}

void TeamOutbox::report(EventKind kind, std::string text, EventNumbers numbers) {
  step_.events.push_back({time_, self_, kind, std::move(text), numbers});
}

void TeamOutbox::report(TeamAllocationReport allocation) {
  step_.allocations.push_back(std::move(allocation));
}

std::uint32_t TeamOutbox::send_all(TeamContent content) {
  step_.send.push_back(
      {std::nullopt, {TeamMessage::kVersion, ++sent_to_all_, std::move(content)}});
  return sent_to_all_;
}

void TeamOutbox::send(EntityId to, TeamContent content) {
  step_.send.push_back({to, {TeamMessage::kVersion, ++sent_to_[to], std::move(content)}});
}

void TeamOutbox::repeat(EntityId to, TeamContent content, int times, double until) {
  repeated_.push_back({to, std::move(content), times, time_.seconds(), until});
}

void TeamOutbox::send_repeated(double interval) {
  const double now = time_.seconds();
  for (Repeated& one : repeated_) {
    if (now < one.next) continue;
    send(one.to, one.content);
    --one.left;
    one.next = now + interval;
  }
  std::erase_if(repeated_, [](const Repeated& one) {
    return one.left <= 0 || one.next > one.until;
  });
}

void TeamOutbox::drop_repeated_to(EntityId id) {
  std::erase_if(repeated_, [id](const Repeated& one) { return one.to == id; });
}

void TeamOutbox::drop_repeated_except_to(EntityId id) {
  std::erase_if(repeated_, [id](const Repeated& one) { return one.to != id; });
}

}  // namespace skein::reasoning
