// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/communication/security/seal.h"

#include <sodium.h>

#include <algorithm>

#include "skein/base/check.h"

namespace skein::communication {
namespace {

using CounterBytes = std::array<unsigned char, Seal::kCounterBytes>;

CounterBytes bytes_of(std::uint64_t counter) {
  CounterBytes bytes;
  for (std::size_t k = 0; k < bytes.size(); ++k)
    bytes[k] = static_cast<unsigned char>(counter >> (8 * k));
  return bytes;
}

}  // namespace

Seal::Seal(const TeamKey& key) : key_(key) {
  static_assert(kTagBytes == crypto_generichash_BYTES_MIN &&
                sizeof(TeamKey) == crypto_generichash_KEYBYTES);
  SKEIN_CHECK(sodium_init() >= 0);  // picks the fastest code for this processor
}

Seal::~Seal() {
  sodium_memzero(key_.data(), key_.size());
}

Seal::Tag Seal::tag_of(std::uint64_t counter, std::span<const std::byte> content) const {
  crypto_generichash_state state;
  const CounterBytes number = bytes_of(counter);
  Tag tag;
  crypto_generichash_init(&state, reinterpret_cast<const unsigned char*>(key_.data()),
                          key_.size(), tag.size());
  crypto_generichash_update(&state, number.data(), number.size());
  crypto_generichash_update(
      &state, reinterpret_cast<const unsigned char*>(content.data()), content.size());
  crypto_generichash_final(&state, tag.data(), tag.size());
  return tag;
}

void Seal::put_on(std::vector<std::byte>& message, std::uint64_t counter) const {
  const Tag tag = tag_of(counter, message);
  const CounterBytes number = bytes_of(counter);
  message.reserve(message.size() + kBytes);
  for (const unsigned char byte : number) message.push_back(std::byte{byte});
  for (const unsigned char byte : tag) message.push_back(std::byte{byte});
}

std::optional<std::uint64_t> Seal::counter_of(std::span<const std::byte> sealed) const {
  if (sealed.size() < kBytes) return std::nullopt;
  const auto content = sealed.first(sealed.size() - kBytes);
  const auto seal = sealed.last(kBytes);
  std::uint64_t counter = 0;
  for (std::size_t k = 0; k < kCounterBytes; ++k)
    counter |= std::to_integer<std::uint64_t>(seal[k]) << (8 * k);
  const Tag tag = tag_of(counter, content);
  // In a time that does not depend on where they differ.
  if (sodium_memcmp(tag.data(), seal.data() + kCounterBytes, tag.size()) != 0)
    return std::nullopt;
  return counter;
}

}  // namespace skein::communication
