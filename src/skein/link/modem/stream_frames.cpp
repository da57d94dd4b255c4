// SPDX-License-Identifier: Apache-2.0
#include "skein/link/modem/stream_frames.h"

#include <algorithm>

#include "skein/base/check.h"
#include "skein/link/modem/datagram.h"

namespace skein::modem {
namespace {

constexpr std::byte kFirst{'S'}, kSecond{'K'};

std::size_t number_at(std::span<const std::byte> bytes, std::size_t at) {
  return std::to_integer<std::size_t>(bytes[at]) |
         std::to_integer<std::size_t>(bytes[at + 1]) << 8;
}

void put_number(std::size_t number, std::vector<std::byte>& out) {
  out.push_back(static_cast<std::byte>(number & 0xFF));
  out.push_back(static_cast<std::byte>(number >> 8 & 0xFF));
}

}  // namespace

std::uint16_t check_sequence(std::span<const std::byte> bytes) {
  std::uint32_t rest = 0xFFFF;
  for (const std::byte each : bytes) {
    rest ^= std::to_integer<std::uint32_t>(each) << 8;
    for (int bit = 0; bit < 8; ++bit)
      rest = (rest & 0x8000u) != 0 ? (rest << 1 ^ 0x1021u) & 0xFFFFu : rest << 1;
  }
  return static_cast<std::uint16_t>(rest);
}

std::vector<std::byte> in_frame(std::span<const std::byte> datagram) {
  SKEIN_CHECK(datagram.size() <= kMaxDatagram, datagram.size());
  std::vector<std::byte> frame = {kFirst, kSecond};
  put_number(datagram.size(), frame);
  put_number(check_sequence(std::span<const std::byte>(frame).subspan(2)), frame);
  frame.insert(frame.end(), datagram.begin(), datagram.end());
  put_number(check_sequence(std::span<const std::byte>(frame).subspan(2)), frame);
  return frame;
}

// What is taken for the beginning of a frame is none: the next one may be inside.
StreamFrames::Found StreamFrames::damaged_frame() {
  ++damaged_;
  return {1, 0};
}

StreamFrames::Found StreamFrames::look(std::span<const std::byte> bytes) {
  const auto begin = std::find(bytes.begin(), bytes.end(), kFirst);
  if (begin != bytes.begin()) return {static_cast<std::size_t>(begin - bytes.begin()), 0};
  if (bytes.size() > 1 && bytes[1] != kSecond) return {1, 0};
  if (bytes.size() < kHead) return {};
  const std::size_t length = number_at(bytes, 2);
  if (number_at(bytes, 4) != check_sequence(bytes.subspan(2, 2)) || length == 0 ||
      length > kMaxDatagram)
    return damaged_frame();
  if (bytes.size() < kHead + length + kTail) return {};
  if (number_at(bytes, kHead + length) !=
      check_sequence(bytes.subspan(2, kHead - 2 + length)))
    return damaged_frame();
  return {kHead + length + kTail, length};
}

}  // namespace skein::modem
