// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace skein::physics {

/// A datagram as SITL sends it.
inline std::string servo_datagram(std::uint32_t frame_count, std::size_t channels = 16,
                                  std::uint16_t first_pwm_us = 1000,
                                  std::uint16_t frame_rate_hz = 1200) {
  std::string text;
  const auto put = [&](auto value) {
    char bytes[sizeof value];
    std::memcpy(bytes, &value, sizeof value);
    text.append(bytes, sizeof value);
  };
  put(static_cast<std::uint16_t>(channels == 32 ? 29'569 : 18'458));
  put(frame_rate_hz);
  put(frame_count);
  for (std::size_t k = 0; k < channels; ++k)
    put(static_cast<std::uint16_t>(first_pwm_us + k));
  return text;
}

}  // namespace skein::physics
