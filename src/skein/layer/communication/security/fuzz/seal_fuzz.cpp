// SPDX-License-Identifier: Apache-2.0
// Any bytes are refused by a receiver, but for those that were sealed with its key; these
// are accepted once.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "skein/base/check.h"
#include "skein/layer/communication/security/authenticity.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace skein::communication;
  AuthenticationOptions options;
  options.key.fill(std::byte{0x5A});
  Authenticity authenticity(options, 2);
  const skein::EntityId sender{0}, receiver{1};
  const auto bytes = std::as_bytes(std::span(data, size));
  SKEIN_CHECK(authenticity.judge(receiver, sender, bytes) == Verdict::kNoTag);
  std::vector<std::byte> sealed(bytes.begin(), bytes.end());
  authenticity.seal(sender, sealed);
  SKEIN_CHECK(sealed.size() == size + Seal::kBytes);
  SKEIN_CHECK(authenticity.judge(receiver, sender, sealed) == Verdict::kAuthentic);
  SKEIN_CHECK(authenticity.judge(receiver, sender, sealed) == Verdict::kRepeated);
  const std::size_t place = size > 0 ? data[0] % sealed.size() : 0;
  sealed[place] ^= std::byte{1};
  SKEIN_CHECK(authenticity.judge(receiver, sender, sealed) == Verdict::kNoTag);
  return 0;
}
