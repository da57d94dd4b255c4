// SPDX-License-Identifier: Apache-2.0
#include "skein/link/modem/alerts.h"

#include <utility>

namespace skein::modem {
namespace {

constexpr Time kSayAgain = Time::from_ns(60'000'000'000);

}  // namespace

bool AlertLog::note(AlertKind kind, Time now) {
  OfKind& known = kinds_.at(static_cast<std::size_t>(kind));
  ++known.count;
  return !known.next || now >= *known.next;
}

void AlertLog::say(AlertKind kind, std::vector<EntityId> identities, Time now) {
  OfKind& known = kinds_.at(static_cast<std::size_t>(kind));
  known.next = now + kSayAgain;
  due_.push_back({kind, std::move(identities), std::exchange(known.count, 0)});
}

std::vector<Alert> AlertLog::take() {
  return std::exchange(due_, {});
}

std::optional<AlertKind> LineAlerts::look(bool open, Time now) {
  if (open == known_open_ || (!open && next_ && now < *next_)) return std::nullopt;
  known_open_ = open;
  if (open) return AlertKind::kLineOpen;
  next_ = now + kSayAgain;
  return AlertKind::kNoLine;
}

}  // namespace skein::modem
