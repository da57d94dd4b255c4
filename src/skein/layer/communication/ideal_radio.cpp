// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/communication/ideal_radio.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>

#include "skein/base/check.h"

namespace skein::communication {
namespace {

constexpr Time kEver = Time::from_ns(std::numeric_limits<std::int64_t>::max());

}  // namespace

IdealRadio::IdealRadio(const IdealRadioOptions& options, std::uint64_t seed,
                       PositionLookup position)
    : options_(options), seed_(seed), position_(std::move(position)) {
  SKEIN_CHECK(options.range <= 0 || position_);
}

bool IdealRadio::later(const InFlight& a, const InFlight& b) {
  return a.arrival != b.arrival ? a.arrival > b.arrival : a.order > b.order;
}

bool IdealRadio::out_of_range(const Message& message) const {
  if (options_.range <= 0) return false;
  const auto from = position_(message.from);
  const auto to = position_(message.to);
  return from && to && (*from - *to).norm() > options_.range;
}

bool IdealRadio::is_out(EntityId modem, Time now) {
  if (options_.outages_per_hour <= 0) return false;
  auto found = outages_.find(modem);
  if (found == outages_.end())
    found = outages_
                .try_emplace(modem,
                             OutageOptions{.per_hour = options_.outages_per_hour,
                                           .mean_duration = options_.outage_mean},
                             RandomStream(seed_, modem.value, Purpose::kRadioOutage))
                .first;
  return found->second.until(now).has_value();
}

LossCause IdealRadio::cause_of(const Message& message, bool by_chance) {
  if (by_chance) return LossCause::kChance;
  if (out_of_range(message)) return LossCause::kOutOfRange;
  if (is_out(message.from, message.sent) || is_out(message.to, message.sent))
    return LossCause::kOutage;
  return LossCause::kNone;
}

void IdealRadio::send(const Message& message) {
  // One block of the stream per message holds both numbers.
  RandomStream random(seed_, message.from.value, Purpose::kRadio);
  random.seek(message.number);
  const LossCause cause = cause_of(message, random.uniform() < options_.loss);
  const double delay = options_.delay + options_.jitter * random.uniform();
  // A lost message is reported when it is sent: nobody waits for it.
  const Time arrival =
      cause == LossCause::kNone ? message.sent + Time::from_seconds(delay) : message.sent;
  const std::uint64_t order = sent_++;
  if (in_order_.empty() || in_order_.back().arrival <= arrival) {
    in_order_.push_back({arrival, order, cause, message});
  } else {
    overtaking_.push_back({arrival, order, cause, message});
    std::push_heap(overtaking_.begin(), overtaking_.end(), later);
  }
}

// The one that arrives first, if it does until then.
std::optional<IdealRadio::InFlight> IdealRadio::take_first(Time until) {
  const bool queued =
      !in_order_.empty() &&
      (overtaking_.empty() || later(overtaking_.front(), in_order_.front()));
  if (!queued && overtaking_.empty()) return std::nullopt;
  if ((queued ? in_order_.front() : overtaking_.front()).arrival > until)
    return std::nullopt;
  std::optional<InFlight> first;
  if (queued) {
    first = std::move(in_order_.front());
    in_order_.pop_front();
  } else {
    std::pop_heap(overtaking_.begin(), overtaking_.end(), later);
    first = std::move(overtaking_.back());
    overtaking_.pop_back();
  }
  return first;
}

void IdealRadio::deliver(Time now, RadioNews& news) {
  while (auto next = take_first(now))
    news.ended.push_back({std::move(next->message), next->cause});
}

void IdealRadio::end(RadioNews& news) {
  while (auto next = take_first(kEver))
    news.ended.push_back({std::move(next->message), LossCause::kPending});
}

}  // namespace skein::communication
