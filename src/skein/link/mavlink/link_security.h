// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>

#include "skein/link/mavlink/frame.h"
#include "skein/link/mavlink/frame_writer.h"
#include "skein/link/mavlink/signing.h"
#include "skein/link/mavlink/unsigned_frames.h"

namespace skein::mavlink {

/// The one key of a program, and on which of its links it is used.
///
/// What goes out over a secured link is signed. What comes in over one counts only when
/// it is signed with the same key, later than what came before in its stream; reports of
/// radios (RADIO_STATUS, RADIO), which cannot sign, are let through. What is not signed
/// may do what allow_unsigned() says; by default nothing over secured links, all over
/// others.
class LinkSecurity {
 public:
  using Channel = std::uint32_t;

  /// Without a key: no link is secured.
  LinkSecurity() = default;

  /// @param last  the last time stamp that was used with this key in an earlier run; 0:
  ///              none is known. See last().
  explicit LinkSecurity(const SigningKey& key, std::uint64_t last = 0);

  /// What time stamps are made of. To be called before links are used, and at least each
  /// second.
  /// @param unix_ns  nanoseconds since 1970-01-01 UTC, of the wall clock.
  void set_time(std::int64_t unix_ns) { now_ = signing_time(unix_ns); }

  /// Secures a link, until it is closed. Only with a key.
  /// @param link_id  distinguishes the links that this program signs on.
  void secure(Channel channel, std::uint8_t link_id);
  void close(Channel channel) {
    signers_.erase(channel);
    unsigned_.erase(channel);
  }
  /// What frames without a signature may do that come in over a link, until it is closed.
  /// After secure().
  void allow_unsigned(Channel channel, UnsignedFrames what) {
    unsigned_.insert_or_assign(channel, what);
  }
  bool is_secured(Channel channel) const { return signers_.contains(channel); }

  /// What becomes of a frame that came in.
  enum class Admission {
    kTaken,
    kRefused,       ///< its signature is missing or wrong
    kOrderRefused,  ///< it is not signed, and would be more than a report or a question
  };
  /// To be asked once for each.
  Admission judge(Channel channel, const Frame& frame);
  /// Whether judge() takes it.
  bool admits(Channel channel, const Frame& frame) {
    return judge(channel, frame) == Admission::kTaken;
  }

  /// A frame as it is to go out, in memory that the writer uses again.
  template <Message T>
  std::span<const std::byte> write(Channel channel, FrameWriter& writer,
                                   const T& message) {
    const auto signer = signers_.find(channel);
    if (signer == signers_.end()) return writer.write(message);
    signer->second.hear(last_);
    const auto frame = writer.write(message, signer->second, now_);
    last_ = signer->second.last();
    return frame;
  }

  /// The last time stamp that was used: to be kept where the clock may go back before the
  /// next run.
  std::uint64_t last() const { return last_; }
  /// Frames that did not count.
  std::uint64_t refused() const { return refused_; }

 private:
  SigningKey key_{};
  std::optional<SignatureChecker> checker_;  // none: there is no key
  std::map<Channel, Signer> signers_;
  std::map<Channel, UnsignedFrames> unsigned_;  // where it was said
  std::uint64_t now_ = 0, last_ = 0, refused_ = 0;
};

}  // namespace skein::mavlink
