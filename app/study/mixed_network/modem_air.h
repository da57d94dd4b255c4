// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "skein/assemble/radio/radio_file.h"
#include "skein/base/math.h"
#include "skein/base/result.h"
#include "skein/link/transport/endpoints.h"
#include "skein/role/radio.h"

namespace skein::mixed_network {

/// A radio of nodes that stand still and have no routing: the same medium for what is
/// simulated and for what stands in for the air.
std::unique_ptr<Radio> standing_radio(const assemble::RadioFile& radio,
                                      std::vector<Vec3> places, std::uint64_t seed);

/// Sends a message to all of `nodes` but its sender, as a run does: the first and its
/// copies, with numbers from `number` on.
void send_to_others(Message message, std::size_t nodes, std::uint64_t& number,
                    Radio& radio);

/// A stand-in of the air between real modems, in real time: it hears the datagrams of
/// each at a socket on this machine, and lets a medium decide which of the others hear
/// them.
///
/// The modem with address hw stands at places[hw - 1].
class ModemAir final : public transport::ChannelListener {
 public:
  ModemAir(const assemble::RadioFile& radio, std::vector<Vec3> places,
           std::uint64_t seed);
  /// Ends its thread.
  ~ModemAir() override;

  /// Begins.
  /// @returns  where modems find it.
  /// Fails: kUnavailable without a socket.
  Result<transport::EndpointAddress> start();

 private:
  void run();
  void opened(transport::ChannelId channel, transport::EndpointId endpoint,
              const std::string& name) override;
  void received(transport::ChannelId channel, std::span<const std::byte> bytes) override;
  void closed(transport::ChannelId channel, const std::string& why) override;
  Time now() const;

  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  std::unique_ptr<Radio> medium_;
  std::vector<std::optional<transport::ChannelId>> channels_;  // of the nodes
  std::uint64_t number_ = 0;
  transport::Endpoints endpoints_;
  std::atomic<bool> stop_ = false;
  std::thread thread_;
};

}  // namespace skein::mixed_network
