// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string_view>
#include <tuple>

#include "skein/link/mavlink/frame.h"

/// Signatures of frames of version 2: the first 48 bits of
///
///   SHA-256(key | frame from its magic to its CRC | link id | time stamp)
///
/// Time stamps count 10 us since 2015-01-01, rise in each stream (link id, system,
/// component), and are of the wall clock, however fast a run goes.
namespace skein::mavlink {

using SigningKey = std::array<std::byte, 32>;

/// The key that ground stations make of a passphrase: its SHA-256.
SigningKey key_of(std::string_view passphrase);

/// @param unix_ns  nanoseconds since 1970-01-01 UTC.
std::uint64_t signing_time(std::int64_t unix_ns);

/// Signs what goes out over one link.
class Signer {
 public:
  /// @param last  the last time stamp that was used with this key; 0: none.
  Signer(const SigningKey& key, std::uint8_t link_id, std::uint64_t last)
      : key_(key), link_id_(link_id), last_(last) {}

  /// What follows the CRC of a frame whose flag says that it is signed.
  /// @param frame  from its magic to its CRC.
  /// @param now    signing_time() of the clock.
  std::array<std::byte, kSignatureLength> sign(std::span<const std::byte> frame,
                                               std::uint64_t now);

  /// Somebody else's valid frame had this time stamp: own ones are later.
  void hear(std::uint64_t stamp);

  std::uint64_t last() const { return last_; }

 private:
  SigningKey key_;
  std::uint8_t link_id_;
  std::uint64_t last_;
};

enum class SignatureVerdict : std::uint8_t {
  kValid,
  kUnsigned,
  kWrong,     ///< of another key, or the frame was changed
  kRepeated,  ///< not later than the last of its stream
  kOld,       ///< the first of its stream, more than a minute behind
  kTooMany,   ///< the first of a stream for which there is no room
};

/// Judges what comes in.
class SignatureChecker {
 public:
  explicit SignatureChecker(const SigningKey& key) : key_(key) {}

  /// Only a valid frame changes what the next ones are judged by.
  /// @param now  signing_time() of the clock, or Signer::last() where that is later.
  SignatureVerdict check(const Frame& frame, std::uint64_t now);

 private:
  // Time stamp of the last frame by link id, system and component.
  using Stream = std::tuple<std::uint8_t, std::uint8_t, std::uint8_t>;

  SigningKey key_;
  std::map<Stream, std::uint64_t> last_;
};

/// The time stamp of a signed frame.
std::uint64_t signing_time(const Frame& frame);

}  // namespace skein::mavlink
