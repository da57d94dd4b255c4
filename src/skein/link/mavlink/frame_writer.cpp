// SPDX-License-Identifier: Apache-2.0
#include "skein/link/mavlink/frame_writer.h"

#include <algorithm>

#include "skein/link/mavlink/crc.h"

namespace skein::mavlink {
namespace {

// Without the zeros at its end, but for one byte.
std::span<const std::byte> truncated(std::span<const std::byte> payload) {
  std::size_t length = payload.size();
  while (length > 1 && payload[length - 1] == std::byte{0}) --length;
  return payload.first(length);
}

}  // namespace

std::size_t FrameWriter::end_with_crc(std::size_t length, std::uint8_t crc_extra) {
  Crc crc;
  crc.add(std::span(frame_).subspan(1, length - 1));
  crc.add(crc_extra);
  frame_[length] = static_cast<std::byte>(crc.value() & 0xff);
  frame_[length + 1] = static_cast<std::byte>(crc.value() >> 8);
  ++sequence_;
  return length + kCrcLength;
}

std::size_t FrameWriter::write_second(const Facts& facts,
                                      std::span<const std::byte> payload,
                                      std::uint8_t flags) {
  const auto sent = truncated(payload);
  const std::array<std::uint8_t, kHeader2> header = {
      kMagic2,
      static_cast<std::uint8_t>(sent.size()),
      flags,
      0,
      sequence_,
      system_,
      component_,
      static_cast<std::uint8_t>(facts.id & 0xff),
      static_cast<std::uint8_t>(facts.id >> 8 & 0xff),
      static_cast<std::uint8_t>(facts.id >> 16)};
  std::ranges::transform(header, frame_.begin(),
                         [](std::uint8_t byte) { return std::byte{byte}; });
  std::ranges::copy(sent, frame_.begin() + kHeader2);
  return end_with_crc(kHeader2 + sent.size(), facts.crc_extra);
}

std::span<const std::byte> FrameWriter::write(const Facts& facts, std::size_t base_length,
                                              std::span<const std::byte> payload) {
  if (version_ == 2) return std::span(frame_).first(write_second(facts, payload, 0));
  if (facts.id > 255) return {};
  const std::array<std::uint8_t, kHeader1> header = {
      kMagic1,    static_cast<std::uint8_t>(base_length), sequence_, system_,
      component_, static_cast<std::uint8_t>(facts.id)};
  std::ranges::transform(header, frame_.begin(),
                         [](std::uint8_t byte) { return std::byte{byte}; });
  std::ranges::copy(payload.first(base_length), frame_.begin() + kHeader1);
  return std::span(frame_).first(end_with_crc(kHeader1 + base_length, facts.crc_extra));
}

std::span<const std::byte> FrameWriter::write_signed(const Facts& facts,
                                                     std::span<const std::byte> payload,
                                                     Signer& signer, std::uint64_t now) {
  const std::size_t length = write_second(facts, payload, kSignedFlag);
  const auto signature = signer.sign(std::span(frame_).first(length), now);
  std::ranges::copy(signature, frame_.begin() + static_cast<std::ptrdiff_t>(length));
  return std::span(frame_).first(length + kSignatureLength);
}

}  // namespace skein::mavlink
