// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <variant>
#include <vector>

#include "skein/link/transport/endpoint_address.h"
#include "skein/link/world_link/packet.h"

namespace skein::world_link {

/// Whether an endpoint is a connection: packets need frames there; a datagram is one.
inline bool is_connection(const transport::EndpointAddress& address) {
  return std::holds_alternative<transport::TcpServer>(address) ||
         std::holds_alternative<transport::TcpClient>(address);
}

/// Whether packets can be sent there: a serial line loses bytes.
inline bool carries_packets(const transport::EndpointAddress& address) {
  return !std::holds_alternative<transport::SerialLine>(address);
}

/// Room for a frame: the largest packet has one value, and what stands around it.
inline constexpr std::uint32_t kMaxFrame = 1 << 17;

/// A packet as it goes over a connection: its length, 4 bytes, little-endian, then it.
inline std::vector<std::byte> framed(std::span<const std::byte> packet) {
  const auto length = static_cast<std::uint32_t>(packet.size());
  std::vector<std::byte> frame(sizeof length + packet.size());
  std::memcpy(frame.data(), &length, sizeof length);
  if (!packet.empty())
    std::memcpy(frame.data() + sizeof length, packet.data(), packet.size());
  return frame;
}

/// Takes packets out of what comes over a connection. A length that cannot be is the end:
/// where the next frame begins nobody knows.
class FrameReader {
 public:
  /// Calls handle(bytes) for each packet that is complete.
  template <class Handle>
  void read(std::span<const std::byte> bytes, Handle&& handle) {
    if (broken_) return;
    waiting_.insert(waiting_.end(), bytes.begin(), bytes.end());
    std::size_t at = 0;
    std::uint32_t length = 0;
    while (waiting_.size() - at >= sizeof length) {
      std::memcpy(&length, waiting_.data() + at, sizeof length);
      broken_ = length > kMaxFrame;
      if (broken_ || waiting_.size() - at - sizeof length < length) break;
      handle(std::span<const std::byte>(waiting_).subspan(at + sizeof length, length));
      at += sizeof length + length;
    }
    waiting_.erase(waiting_.begin(), waiting_.begin() + static_cast<std::ptrdiff_t>(at));
    if (broken_) waiting_.clear();
  }

  bool broken() const { return broken_; }

 private:
  std::vector<std::byte> waiting_;
  bool broken_ = false;
};

}  // namespace skein::world_link
