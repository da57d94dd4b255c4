// SPDX-License-Identifier: Apache-2.0
#include "skein/link/vehicle_services/refused_order.h"

#include <cstdint>

#include "skein/link/mavlink/dispatch.h"
#include "skein/link/vehicle_services/command_service.h"

namespace skein::vehicle_services {
namespace {

constexpr std::uint8_t kMissionDenied = 14;  // MAV_MISSION_RESULT
constexpr std::uint8_t kNotGiven = 255;      // no progress

struct RefuseOrder {
  Peer from;
  Outbox& out;

  void deny(std::uint16_t command) const {
    acknowledge(static_cast<mavlink::CommandId>(command), mavlink::CommandResult::kDenied,
                kNotGiven, from, out);
  }
  void operator()(const mavlink::CommandLong& m) const { deny(m.command); }
  void operator()(const mavlink::CommandInt& m) const { deny(m.command); }
  void operator()(const mavlink::MissionCount& m) const { deny_list(m.mission_type); }
  void operator()(const mavlink::MissionItemInt& m) const { deny_list(m.mission_type); }
  void operator()(const mavlink::MissionClearAll& m) const { deny_list(m.mission_type); }

  void deny_list(std::uint8_t mission_type) const {
    mavlink::MissionAck ack;
    ack.target_system = from.system;
    ack.target_component = from.component;
    ack.type = kMissionDenied;
    ack.mission_type = mission_type;
    out.send(from.channel, ack);
  }
};

}  // namespace

void refuse_order(const mavlink::Frame& frame, Channel channel, Outbox& out) {
  using namespace mavlink;  // NOLINT: a list of messages
  dispatch<CommandLong, CommandInt, MissionCount, MissionItemInt, MissionClearAll>(
      frame, RefuseOrder{{channel, frame.system(), frame.component()}, out});
}

}  // namespace skein::vehicle_services
