// SPDX-License-Identifier: Apache-2.0
// Datagrams of any bytes: what is taken for a frame says the same bytes again, and counts
// that follow one another are told apart.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>

#include "skein/base/check.h"
#include "skein/link/physics/ardupilot_json.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace skein::physics;
  ServoFollower follower;
  std::optional<std::uint32_t> before;
  // Pieces that begin with their length.
  for (std::size_t at = 0; at < size;) {
    const std::size_t length = std::min<std::size_t>(data[at], size - at - 1);
    const auto datagram = std::as_bytes(std::span(data + at + 1, length));
    at += 1 + length;
    const auto read = parse_servo_frame(datagram);
    if (!read) {
      SKEIN_CHECK(!read.error().message.empty());
      continue;
    }
    const ServoFrame& frame = read.value();
    SKEIN_CHECK(length == 8 + 2 * frame.channels);
    SKEIN_CHECK(std::memcmp(&frame.frame_count, datagram.data() + 4, 4) == 0);
    SKEIN_CHECK(std::memcmp(frame.pwm_us.data(), datagram.data() + 8, length - 8) == 0);
    const ServoStep step = follower.take(frame.frame_count);
    SKEIN_CHECK((step == ServoStep::kRepeat) == (before == frame.frame_count));
    SKEIN_CHECK(before || step == ServoStep::kBegin);
    before = frame.frame_count;
  }
  return 0;
}
