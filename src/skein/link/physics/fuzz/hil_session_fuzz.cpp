// SPDX-License-Identifier: Apache-2.0
// Any bytes from an autopilot, cut anywhere, between steps: controls stay within their
// bounds, and what goes out are whole frames, one for each step and each command.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "skein/base/check.h"
#include "skein/link/physics/hil_session.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace skein;
  using namespace skein::physics;
  std::size_t out = 0;
  mavlink::FrameParser sent;
  HilSession session(1, 200, [&](std::span<const std::byte> bytes) {
    ++out;
    sent.read(bytes, [](const mavlink::Frame& frame) { SKEIN_CHECK(frame.message); });
  });
  const std::size_t piece = size > 0 ? data[0] % 64 + 1U : 1;
  std::size_t steps = 0;
  for (std::size_t at = 1; at < size; at += piece) {
    session.received(std::as_bytes(std::span(data + at, std::min(piece, size - at))));
    HilTruth truth;
    truth.time = Time::from_ns(static_cast<std::int64_t>(++steps) * 4'000'000);
    session.send(truth);
    if (const auto controls = session.take_controls())
      for (const double value : controls->channel) SKEIN_CHECK(value >= -1 && value <= 1);
  }
  SKEIN_CHECK(out <= steps + session.counts().frames);
  SKEIN_CHECK(sent.counts().frames == out && sent.counts().bad_crc == 0);
  return 0;
}
