#include "skein/link/mavlink/link_security.h"

#include <algorithm>

#include "skein/base/check.h"
#include "skein/link/mavlink/messages.h"

namespace skein::mavlink {

LinkSecurity::LinkSecurity(const SigningKey& key, std::uint64_t last)
    : key_(key), checker_(key), last_(last) {}

void LinkSecurity::secure(Channel channel, std::uint8_t link_id) {
  SKEIN_CHECK(checker_.has_value());
  signers_.insert_or_assign(channel, Signer(key_, link_id, last_));
}

bool LinkSecurity::admits(Channel channel, const Frame& frame) {
  if (!is_secured(channel)) return true;
  if (frame.id() == kFacts<RadioStatus>.id || frame.id() == kFacts<Radio>.id) return true;
  if (checker_->check(frame, std::max(now_, last_)) != SignatureVerdict::kValid) {
    ++refused_;
    return false;
  }
  last_ = std::max(last_, signing_time(frame));
  return true;
}

}  // namespace skein::mavlink
