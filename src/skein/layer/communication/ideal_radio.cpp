#include "skein/layer/communication/ideal_radio.h"

#include <algorithm>
#include <utility>

#include "skein/base/check.h"

namespace skein::communication {

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
  in_flight_.push_back({arrival, sent_++, cause, message});
  std::push_heap(in_flight_.begin(), in_flight_.end(), later);
}

void IdealRadio::deliver(Time now, RadioNews& news) {
  while (!in_flight_.empty() && in_flight_.front().arrival <= now) {
    std::pop_heap(in_flight_.begin(), in_flight_.end(), later);
    InFlight& next = in_flight_.back();
    news.ended.push_back({std::move(next.message), next.cause});
    in_flight_.pop_back();
  }
}

void IdealRadio::end(RadioNews& news) {
  std::sort_heap(in_flight_.begin(), in_flight_.end(), later);
  for (auto next = in_flight_.rbegin(); next != in_flight_.rend(); ++next)
    news.ended.push_back({std::move(next->message), LossCause::kPending});
  in_flight_.clear();
}

}  // namespace skein::communication
