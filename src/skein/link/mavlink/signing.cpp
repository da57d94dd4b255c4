// SPDX-License-Identifier: Apache-2.0
#include "skein/link/mavlink/signing.h"

#include <openssl/crypto.h>
#include <openssl/sha.h>

#include <algorithm>

namespace skein::mavlink {
namespace {

constexpr std::int64_t kEpoch = 1'420'070'400;   // 2015-01-01 UTC [s since 1970]
constexpr std::int64_t kUnit = 10'000;           // of a time stamp [ns]
constexpr std::uint64_t kMaxBehind = 6'000'000;  // of a stream's first frame: a minute
constexpr std::uint64_t kMaxStamp = (std::uint64_t{1} << 48) - 1;
constexpr std::size_t kMaxStreams = 4096;
constexpr std::size_t kStampLength = 6, kHashLength = 6;

using Hash = std::array<unsigned char, SHA256_DIGEST_LENGTH>;

// Of the key, and the frame up to the signature's hash.
Hash hash_of(const SigningKey& key, std::span<const std::byte> frame,
             std::span<const std::byte> link_and_stamp) {
  std::array<std::byte, sizeof(SigningKey) + kMaxFrame> text;
  auto end = std::copy(key.begin(), key.end(), text.begin());
  end = std::copy(frame.begin(), frame.end(), end);
  end = std::copy(link_and_stamp.begin(), link_and_stamp.end(), end);
  Hash hash;
  SHA256(reinterpret_cast<const unsigned char*>(text.data()),
         static_cast<std::size_t>(end - text.begin()), hash.data());
  return hash;
}

}  // namespace

SigningKey key_of(std::string_view passphrase) {
  SigningKey key;
  SHA256(reinterpret_cast<const unsigned char*>(passphrase.data()), passphrase.size(),
         reinterpret_cast<unsigned char*>(key.data()));
  return key;
}

std::uint64_t signing_time(std::int64_t unix_ns) {
  const std::int64_t since = unix_ns / kUnit - kEpoch * (1'000'000'000 / kUnit);
  return static_cast<std::uint64_t>(std::max<std::int64_t>(since, 0));
}

std::array<std::byte, kSignatureLength> Signer::sign(std::span<const std::byte> frame,
                                                     std::uint64_t now) {
  last_ = std::min(std::max(last_ + 1, now), kMaxStamp);
  std::array<std::byte, kSignatureLength> signature;
  signature[0] = std::byte{link_id_};
  for (std::size_t i = 0; i < kStampLength; ++i)
    signature[1 + i] = static_cast<std::byte>(last_ >> (8 * i));
  const Hash hash = hash_of(key_, frame, std::span(signature).first(1 + kStampLength));
  std::transform(hash.begin(), hash.begin() + kHashLength,
                 signature.begin() + 1 + kStampLength,
                 [](unsigned char byte) { return std::byte{byte}; });
  return signature;
}

void Signer::hear(std::uint64_t stamp) {
  last_ = std::max(last_, stamp);
}

std::uint64_t signing_time(const Frame& frame) {
  const auto signature = frame.bytes.last(kSignatureLength);
  std::uint64_t stamp = 0;
  for (std::size_t i = kStampLength; i > 0; --i)
    stamp = stamp << 8 | static_cast<std::uint64_t>(signature[i]);
  return stamp;
}

SignatureVerdict SignatureChecker::check(const Frame& frame, std::uint64_t now) {
  using enum SignatureVerdict;
  if (!frame.is_signed()) return kUnsigned;
  const auto signature = frame.bytes.last(kSignatureLength);
  const Hash hash =
      hash_of(key_, frame.bytes.first(frame.bytes.size() - kSignatureLength),
              signature.first(1 + kStampLength));
  if (CRYPTO_memcmp(hash.data(), signature.data() + 1 + kStampLength, kHashLength) != 0)
    return kWrong;
  const std::uint64_t stamp = signing_time(frame);
  const Stream stream{static_cast<std::uint8_t>(signature[0]), frame.system(),
                      frame.component()};
  const auto known = last_.find(stream);
  if (known != last_.end()) {
    if (stamp <= known->second) return kRepeated;
    known->second = stamp;
    return kValid;
  }
  if (stamp + kMaxBehind < now) return kOld;
  if (last_.size() >= kMaxStreams) return kTooMany;
  last_.emplace(stream, stamp);
  return kValid;
}

}  // namespace skein::mavlink
