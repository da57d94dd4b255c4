// SPDX-License-Identifier: Apache-2.0
#include "skein/link/mavlink/frame_parser.h"

#include <algorithm>
#include <cstring>

#include "skein/link/mavlink/crc.h"

namespace skein::mavlink {
namespace {

constexpr std::uint8_t kKnownFlags = kSignedFlag;  // of the incompatible ones

bool is_magic(std::byte byte) {
  return byte == std::byte{kMagic1} || byte == std::byte{kMagic2};
}

// Bytes of the frame whose header this is.
std::size_t length_of(const Frame& frame) {
  if (frame.version() == 1) return kHeader1 + frame.at(1) + kCrcLength;
  return kHeader2 + frame.at(1) + kCrcLength + (frame.is_signed() ? kSignatureLength : 0);
}

bool has_good_crc(const Frame& frame) {
  const std::size_t end =
      (frame.version() == 1 ? kHeader1 : kHeader2) + std::size_t{frame.at(1)};
  Crc crc;
  crc.add(frame.bytes.subspan(1, end - 1));
  crc.add(frame.message->crc_extra);
  return frame.at(end) == (crc.value() & 0xff) && frame.at(end + 1) == crc.value() >> 8;
}

}  // namespace

std::size_t FrameParser::fill(std::span<const std::byte> bytes) {
  // What is left is a part of a frame, less than the room behind it.
  std::memmove(held_.data(), held_.data() + begin_, end_ - begin_);
  end_ -= begin_;
  begin_ = 0;
  const std::size_t taken = std::min(bytes.size(), held_.size() - end_);
  std::copy_n(bytes.begin(), taken, held_.data() + end_);
  end_ += taken;
  return taken;
}

void FrameParser::skip(std::size_t bytes) {
  begin_ += bytes;
  counts_.skipped_bytes += bytes;
}

std::optional<Frame> FrameParser::next() {
  for (;;) {
    const std::byte* const from = held_.data() + begin_;
    const std::byte* const end = held_.data() + end_;
    skip(static_cast<std::size_t>(std::find_if(from, end, is_magic) - from));
    const std::size_t there = end_ - begin_;
    const std::span<const std::byte> left(held_.data() + begin_, there);
    if (there == 0) return std::nullopt;
    Frame frame{left};
    if (there < (frame.version() == 1 ? kHeader1 : kHeader2)) return std::nullopt;
    const std::size_t length = length_of(frame);
    if (there < length) return std::nullopt;
    frame.bytes = left.first(length);
    frame.message = find_message(frame.id());
    const bool fits = frame.version() == 1 || (frame.at(2) & ~kKnownFlags) == 0;
    // Without a CRC that can be checked, it is taken for a frame when another follows it.
    const bool good = frame.message ? has_good_crc(frame)
                                    : fits && (there == length || is_magic(left[length]));
    if (!good) {
      counts_.bad_crc += frame.message != nullptr;
      skip(1);
      continue;
    }
    begin_ += length;
    if (!fits) {
      ++counts_.incompatible;
      continue;
    }
    ++counts_.frames;
    counts_.unknown += frame.message == nullptr;
    return frame;
  }
}

}  // namespace skein::mavlink
