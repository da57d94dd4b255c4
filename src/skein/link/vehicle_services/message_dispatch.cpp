// SPDX-License-Identifier: Apache-2.0
#include "skein/link/vehicle_services/message_dispatch.h"

#include "skein/link/mavlink/flight_modes.h"
#include "skein/link/mavlink/payload.h"
#include "skein/link/vehicle_services/flight_modes.h"
#include "skein/link/vehicle_services/guided_inputs.h"
#include "skein/link/vehicle_services/small_services.h"
#include "skein/link/vehicle_services/vehicle_commands.h"

namespace skein::vehicle_services {
namespace {

using mavlink::CommandId;
using mavlink::kFacts;
using mavlink::unpack;

// A frame on its way to the part whose business it is.
struct Delivery {
  const mavlink::Frame& frame;
  Peer from;
  MessageTargets& to;
  Outbox& out;

  ServedVehicle& vehicle() const { return to.vehicle; }
  const Clocks& now() const { return to.vehicle.now; }

  // Calls handle(message) where the frame is a T.
  template <class T, class Handle>
  bool on(const Handle& handle) const {
    if (frame.id() != kFacts<T>.id) return false;
    handle(unpack<T>(frame.payload()));
    return true;
  }
};

void command(const Command& command, bool for_all, const Delivery& d) {
  d.to.commands.handle(command, d.from, d.frame.sequence(), for_all, d.to, d.out);
}

bool to_commands(const Delivery& d, bool for_all) {
  // What a place in floats counts from is not said; each make has its habit.
  const auto frame = d.vehicle().options.make == Make::kPx4
                         ? mavlink::CoordinateFrame::kGlobal
                         : mavlink::CoordinateFrame::kGlobalRelative;
  return d.on<mavlink::CommandLong>([&](const auto& m) {
    command(command_of(m, frame), for_all, d);
  }) || d.on<mavlink::CommandInt>([&](const auto& m) {
    command(command_of(m), for_all, d);
  });
}

// Messages that mean the same as a command, from before there were any.
bool to_old_commands(const Delivery& d) {
  return d.on<mavlink::SetMode>([&](const auto& m) {
    const bool custom = (m.base_mode & mavlink::kModeCustom) != 0;
    Answer answer = custom ? set_mode(d.vehicle(), d.to.pilot, m.custom_mode)
                           : Answer(mavlink::CommandResult::kDenied);
    if (!answer.reason.empty())
      d.vehicle().say(mavlink::Severity::kWarning, std::move(answer.reason));
    // ArduPilot answers as if it were the command with the message's number.
    if (d.vehicle().options.make == Make::kArduPilot)
      acknowledge(static_cast<CommandId>(kFacts<mavlink::SetMode>.id), answer.result, 255,
                  d.from, d.out);
  }) || d.on<mavlink::MissionSetCurrent>([&](const auto& m) {
    const std::uint16_t first = d.vehicle().mission.first;
    if (m.seq >= first)
      select_item(d.vehicle(), static_cast<std::uint16_t>(m.seq - first));
    d.out.send(d.from.channel, mission_current(d.vehicle()));
  }) || d.on<mavlink::AutopilotVersionRequest>([&](const auto&) {
    d.out.send(d.from.channel, autopilot_version(d.vehicle()));
  });
}

// An item of an upload, or a place to go to.
void take_item(const mavlink::MissionItemInt& item, const Delivery& d) {
  const auto guided = guided_item(item, d.vehicle());
  if (!guided) return d.to.lists.handle(item, d.from, d.out);
  mavlink::MissionAck ack;
  ack.target_system = d.from.system;
  ack.target_component = d.from.component;
  ack.type = static_cast<std::uint8_t>(*guided);
  ack.mission_type = item.mission_type;
  d.out.send(d.from.channel, ack);
}

bool to_lists(const Delivery& d) {
  const auto handle = [&](const auto& m) { d.to.lists.handle(m, d.from, d.out); };
  return d.on<mavlink::MissionCount>(handle) ||
         d.on<mavlink::MissionItemInt>([&](const auto& m) { take_item(m, d); }) ||
         d.on<mavlink::MissionItem>(
             [&](const auto& m) { take_item(with_integers(m), d); }) ||
         d.on<mavlink::MissionRequestList>(handle) ||
         d.on<mavlink::MissionRequestInt>(handle) ||
         d.on<mavlink::MissionRequest>(handle) ||
         d.on<mavlink::MissionClearAll>(handle) ||
         d.on<mavlink::MissionWritePartialList>(handle);
}

bool to_flight(const Delivery& d) {
  const auto guided = [&](const auto& m) { handle(m, d.vehicle()); };
  return d.on<mavlink::SetPositionTargetGlobalInt>(guided) ||
         d.on<mavlink::SetPositionTargetLocalNed>(guided) ||
         d.on<mavlink::SetAttitudeTarget>(guided) ||
         d.on<mavlink::RcChannelsOverride>(
             [&](const auto& m) { d.to.pilot.handle(m, d.vehicle()); });
}

bool to_parameters(const Delivery& d) {
  return d.on<mavlink::ParamRequestRead>([&](const auto& m) {
    d.to.parameters.handle(m, d.from, d.out);
  }) || d.on<mavlink::ParamSet>([&](const auto& m) {
    d.to.parameters.handle(m, d.from, d.out);
  });
}

// What may be asked of all vehicles at once.
bool to_anybody(const Delivery& d) {
  const auto reply = [&](const auto& m) { answer(m, d.from, d.out); };
  return d.on<mavlink::ParamRequestList>([&](const auto& m) {
    d.to.parameters.handle(m, d.from, d.now().wall);
  }) || d.on<mavlink::RequestDataStream>([&](const auto& m) {
    d.to.streams.set_group(d.from.channel,
                           static_cast<mavlink::StreamGroup>(m.req_stream_id),
                           m.start_stop != 0 ? m.req_message_rate : 0, d.now().simulated);
  }) || d.on<mavlink::ManualControl>([&](const auto& m) {
    if (m.target == d.vehicle().options.system) d.to.pilot.handle(m, d.vehicle());
  }) || d.on<mavlink::Timesync>([&](const auto& m) {
    answer(m, d.from, d.now(), d.out);
  }) || d.on<mavlink::Ping>(reply) ||
         d.on<mavlink::FileTransferProtocol>(reply) ||
         d.on<mavlink::LogRequestList>(reply) || d.on<mavlink::LogRequestData>(reply);
}

}  // namespace

bool concerns(const mavlink::Frame& frame, const VehicleServerOptions& options) {
  if (!frame.message || frame.system() == 0) return false;
  if (frame.system() == options.system && frame.component() == options.component)
    return false;  // its own, come back
  const std::uint8_t system = frame.target_system();
  const std::uint8_t component = frame.target_component();
  return (system == 0 || system == options.system) &&
         (component == 0 || component == options.component);
}

void dispatch(const mavlink::Frame& frame, Channel channel, MessageTargets& to,
              Outbox& out) {
  const Delivery d{frame, {channel, frame.system(), frame.component()}, to, out};
  const bool for_all = frame.target_system() == 0;
  if (to_commands(d, for_all) || to_anybody(d) || for_all) return;
  // The rest is never for all at once.
  to_flight(d) || to_lists(d) || to_parameters(d) || to_old_commands(d);
}

}  // namespace skein::vehicle_services
