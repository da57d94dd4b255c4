// SPDX-License-Identifier: Apache-2.0
#include "skein/link/mavlink/tlog.h"

#include <array>

#include "skein/link/mavlink/crc.h"

namespace skein::mavlink {

std::vector<std::byte> without_signature(const Frame& frame) {
  std::vector<std::byte> bytes(frame.bytes.begin(), frame.bytes.end());
  if (!frame.is_signed() || !frame.message) return bytes;
  bytes.resize(bytes.size() - kSignatureLength);
  bytes[2] &= ~std::byte{kSignedFlag};
  const std::size_t end = bytes.size() - kCrcLength;
  Crc crc;
  crc.add(std::span(bytes).subspan(1, end - 1));
  crc.add(frame.message->crc_extra);
  bytes[end] = static_cast<std::byte>(crc.value() & 0xff);
  bytes[end + 1] = static_cast<std::byte>(crc.value() >> 8);
  return bytes;
}

Result<TlogWriter> TlogWriter::create(const std::filesystem::path& file) {
  auto out = OutputStream::open(file);
  if (!out) return out.error();
  return TlogWriter(std::move(out).value());
}

void TlogWriter::write(std::int64_t unix_us, const Frame& frame) {
  std::array<char, 8> time;
  for (std::size_t i = 0; i < time.size(); ++i)
    time[i] = static_cast<char>(unix_us >> (8 * (time.size() - 1 - i)));
  out_.write({time.data(), time.size()});
  const std::vector<std::byte> bytes = without_signature(frame);
  out_.write({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

Result<void> TlogWriter::flush() {
  return out_.flush();
}

}  // namespace skein::mavlink
