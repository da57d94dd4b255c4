// SPDX-License-Identifier: Apache-2.0
#include "skein/link/modem/paced_queue.h"

#include <algorithm>
#include <utility>

#include "skein/base/check.h"

namespace skein::modem {
namespace {

constexpr Time kSlack = Time::from_ns(10'000'000);

}  // namespace

PacedQueue::PacedQueue(const PacedQueueOptions& options) : options_(options) {
  SKEIN_CHECK(options.rate >= 0, options.rate);
  SKEIN_CHECK(options.capacity > 0);
}

std::size_t PacedQueue::rank(const Waiting& waiting) {
  return waiting.injected ? 0 : 1 + static_cast<std::size_t>(waiting.urgency);
}

std::size_t PacedQueue::size() const {
  std::size_t sum = 0;
  for (const auto& each : ranks_) sum += each.size();
  return sum;
}

bool PacedQueue::merge(const Waiting& waiting) {
  if (waiting.key.empty() || waiting.carried.receivers.empty()) return false;
  for (Waiting& other : ranks_[rank(waiting)]) {
    if (other.key != waiting.key || other.carried.receivers.empty()) continue;
    other.carried.receivers.insert(other.carried.receivers.end(),
                                   waiting.carried.receivers.begin(),
                                   waiting.carried.receivers.end());
    other.to = {kAll, kAll};
    return true;
  }
  return false;
}

void PacedQueue::drop_expired(Time now) {
  for (auto& waiting : ranks_)
    losses_.expired += std::erase_if(waiting, [&](const Waiting& each) {
      return now - each.since > options_.lifetime;
    });
}

// The youngest of the least urgent gives way to something more urgent.
bool PacedQueue::make_room(std::size_t rank, Time now) {
  if (size() < options_.capacity) return true;
  drop_expired(now);
  if (size() < options_.capacity) return true;
  ++losses_.full;
  for (std::size_t k = 0; k < rank; ++k) {
    if (ranks_[k].empty()) continue;
    ranks_[k].pop_back();
    return true;
  }
  return false;
}

void PacedQueue::put(Waiting waiting) {
  if (merge(waiting)) return;
  const std::size_t at = rank(waiting);
  if (make_room(at, waiting.since)) ranks_[at].push_back(std::move(waiting));
}

std::optional<Waiting> PacedQueue::take(Time now) {
  if (now < next_) return std::nullopt;
  for (std::size_t k = kRanks; k-- > 0;) {
    auto& waiting = ranks_[k];
    while (!waiting.empty()) {
      Waiting first = std::move(waiting.front());
      waiting.pop_front();
      if (now - first.since <= options_.lifetime) return first;
      ++losses_.expired;
    }
  }
  return std::nullopt;
}

void PacedQueue::went(std::size_t bytes, Time now) {
  if (options_.rate <= 0) return;
  next_ = std::max(next_, now - kSlack) +
          Time::from_seconds(8 * static_cast<double>(bytes) / options_.rate);
}

}  // namespace skein::modem
