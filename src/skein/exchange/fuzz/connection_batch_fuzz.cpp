// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "skein/exchange/plan/connection_batch.h"

// Any bytes: no crash, as many rows as were counted, the same whether cut or not.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using skein::exchange::ConnectionBatch;
  const std::string text(reinterpret_cast<const char*>(data), size);
  ConnectionBatch whole("fuzz"), cut("fuzz");
  std::string out, out_of_parts;
  const bool good = whole.take(text, out).ok() && whole.finish(out).ok();
  bool good_parts = true;
  for (std::size_t at = 0; good_parts && at < size; at += 7)
    good_parts = cut.take(std::string_view(text).substr(at, 7), out_of_parts).ok();
  good_parts = good_parts && cut.finish(out_of_parts).ok();
  if (good != good_parts || out != out_of_parts) std::abort();
  const auto lines = std::count(out.begin(), out.end(), '\n');
  if (good && lines != whole.rows() + 1) std::abort();
  return 0;
}
