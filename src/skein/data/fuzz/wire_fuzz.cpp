// SPDX-License-Identifier: Apache-2.0
// Any bytes are a record or an error; a record is coded as its size says and read back.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "skein/base/check.h"
#include "skein/data/describe/wire.h"
#include "skein/data/event/record.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto record =
      skein::wire::decode<skein::Record>(std::as_bytes(std::span(data, size)));
  if (!record) return 0;
  std::vector<std::byte> coded, again;
  skein::wire::encode(record.value(), coded);
  SKEIN_CHECK(coded.size() == skein::wire::coded_size(record.value()));
  const auto read = skein::wire::decode<skein::Record>(coded);
  SKEIN_CHECK(read.ok());
  skein::wire::encode(read.value(), again);
  SKEIN_CHECK(again == coded);
  return 0;
}
