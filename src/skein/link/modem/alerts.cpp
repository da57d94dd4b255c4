#include "skein/link/modem/alerts.h"

#include <utility>

namespace skein::modem {
namespace {

constexpr Time kSayAgain = Time::from_ns(60'000'000'000);

}  // namespace

void AlertLog::note(AlertKind kind, std::vector<EntityId> identities, Time now) {
  OfKind& known = kinds_.at(static_cast<std::size_t>(kind));
  ++known.count;
  if (known.next && now < *known.next) return;
  known.next = now + kSayAgain;
  due_.push_back({kind, std::move(identities), std::exchange(known.count, 0)});
}

std::vector<Alert> AlertLog::take() {
  return std::exchange(due_, {});
}

}  // namespace skein::modem
