// SPDX-License-Identifier: Apache-2.0
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

LinkSecurity::Admission LinkSecurity::judge(Channel channel, const Frame& frame) {
  const bool secured = is_secured(channel);
  if (frame.id() == kFacts<RadioStatus>.id || frame.id() == kFacts<Radio>.id)
    return Admission::kTaken;
  if (secured && frame.is_signed()) {
    if (checker_->check(frame, std::max(now_, last_)) != SignatureVerdict::kValid) {
      ++refused_;
      return Admission::kRefused;
    }
    last_ = std::max(last_, signing_time(frame));
    return Admission::kTaken;
  }
  const auto said = unsigned_.find(channel);
  const UnsignedFrames allowed = said != unsigned_.end() ? said->second
                                 : secured               ? UnsignedFrames::kNothing
                                                         : UnsignedFrames::kAll;
  if (allowed == UnsignedFrames::kAll) return Admission::kTaken;
  if (allowed == UnsignedFrames::kTelemetry && changes_nothing(frame))
    return Admission::kTaken;
  ++refused_;
  return allowed == UnsignedFrames::kTelemetry ? Admission::kOrderRefused
                                               : Admission::kRefused;
}

}  // namespace skein::mavlink
