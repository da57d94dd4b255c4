// SPDX-License-Identifier: Apache-2.0
#include "skein/link/modem/duplicates.h"

namespace skein::modem {
// Whether another session takes the place of the present one.
bool Duplicates::begins(const Origin& known, std::uint64_t session, Time now) const {
  if (rule_ == SessionRule::kNewest) return session > known.session;
  return now - known.heard > patience_;
}

bool Duplicates::is_new(std::uint32_t origin, std::uint64_t session, std::uint64_t number,
                        Time now) {
  const auto [place, first] = origins_.try_emplace(origin, Origin{session, {}, now});
  Origin& known = place->second;
  if (session != known.session) {
    if (!begins(known, session, now)) return false;
    known = {session, {}, now};
  }
  if (!known.numbers.accept(number)) return false;
  known.heard = now;
  return true;
}

void Duplicates::lost(std::uint32_t origin) {
  if (rule_ == SessionRule::kFirst) origins_.erase(origin);
}

}  // namespace skein::modem
