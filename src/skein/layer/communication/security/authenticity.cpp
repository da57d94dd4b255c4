// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/communication/security/authenticity.h"

#include <fmt/format.h>

#include <utility>

#include "skein/base/check.h"

namespace skein::communication {
namespace {

constexpr Time kSayAgain = Time::from_ns(60'000'000'000);

std::uint64_t pair_of(EntityId receiver, EntityId sender) {
  return std::uint64_t{receiver.value} << 32 | sender.value;
}

const char* reason_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::kAuthentic:
      break;
    case Verdict::kNoTag:
      return "no valid tag";
    case Verdict::kRepeated:
      return "old counter";
  }
  return "authentic";
}

}  // namespace

Authenticity::Authenticity(const AuthenticationOptions& options, std::size_t entities)
    : seal_(options.key), required_(options.required), counters_(entities, 0) {}

void Authenticity::seal(EntityId sender, std::vector<std::byte>& message) {
  SKEIN_CHECK(sender.value < counters_.size());
  seal_.put_on(message, ++counters_[sender.value]);
}

Verdict Authenticity::judge(EntityId receiver, EntityId sender,
                            std::span<const std::byte> sealed) {
  const auto counter = seal_.counter_of(sealed);
  if (!counter) return Verdict::kNoTag;
  return seen_[pair_of(receiver, sender)].accept(*counter) ? Verdict::kAuthentic
                                                           : Verdict::kRepeated;
}

std::optional<Event> RefusalLog::note(Time now, EntityId receiver, EntityId sender,
                                      Verdict verdict, bool refused,
                                      std::string_view sender_name) {
  const auto [place, first] =
      rows_.try_emplace({pair_of(receiver, sender), verdict}, Row{now, 0});
  Row& row = place->second;
  if (!first) ++row.since;
  if (!first && now < row.said + kSayAgain) return std::nullopt;
  row.said = now;
  const std::uint64_t more = std::exchange(row.since, 0);
  std::string text =
      fmt::format("in the name of {}: {}", sender_name, reason_of(verdict));
  if (more > 0) text += fmt::format("; {} since it was last said", more);
  return Event{now,
               receiver,
               refused ? EventKind::kMessageRefused : EventKind::kMessageDoubted,
               std::move(text),
               {.other = sender}};
}

}  // namespace skein::communication
