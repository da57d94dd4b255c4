// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>
#include <cmath>

#include <memory>
#include <string>
#include <vector>

#include "skein/link/mavlink/frame_parser.h"
#include "skein/link/mavlink/frame_writer.h"
#include "skein/link/mavlink/messages.h"
#include "skein/link/vehicle_services/places.h"
#include "skein/link/vehicle_services/vehicle_server.h"

namespace skein::vehicle_services {

inline geo::LocalFrame test_frame() {
  return geo::LocalFrame::at({47.0, 8.0, 0}).value();
}

inline VehicleServerOptions test_options(Make make, bool hovers) {
  VehicleServerOptions options;
  options.system = 7;
  options.make = make;
  options.hovers = hovers;
  options.name = "kestrel";
  options.software = "Skein 0.1.0";
  if (hovers) options.limits = {8, 5, 3, 0, 12, 2};
  return options;
}

/// On the ground at home, 400 m above mean sea level, ready.
inline VehicleSnapshot standing() {
  VehicleSnapshot snapshot;
  snapshot.motion.p_N = {100, 200, -400};
  snapshot.motion.position_sd = 1.5;
  snapshot.motion.altitude_sd = 2.5;
  snapshot.condition.position = true;
  snapshot.condition.mode = VehicleMode::kHold;
  snapshot.condition.charge = 0.8;
  snapshot.home_N = snapshot.motion.p_N;
  snapshot.ground_msl = 400;
  return snapshot;
}

/// In guided flight 100 m above home.
inline VehicleSnapshot flying() {
  VehicleSnapshot snapshot = standing();
  snapshot.motion.p_N = {300, 250, -500};
  snapshot.motion.v_N = {20, 0, 0};
  snapshot.motion.airspeed = 20;
  snapshot.condition.armed = true;
  snapshot.condition.on_ground = false;
  snapshot.condition.mode = VehicleMode::kGuided;
  return snapshot;
}

/// A vehicle and a ground station (255/190) that sees all that it says, without a line
/// between them.
class Station {
 public:
  static constexpr Channel kChannel = 1;

  explicit Station(const VehicleServerOptions& options)
      : server(options, test_frame()),
        out(options.system, options.component,
            [this](Channel channel, std::span<const std::byte> bytes) {
              frames.push_back({channel, {bytes.begin(), bytes.end()}});
            }) {
    server.open(kChannel, now);
  }
  explicit Station(Make make = Make::kArduPilot, bool hovers = false)
      : Station(test_options(make, hovers)) {}

  /// The simulation says how it is, and the vehicle takes note.
  void show(const VehicleSnapshot& next) {
    snapshot = next;
    server.update(snapshot);
    step();
  }
  /// Both clocks run for so long, in hundredths of a second.
  void run(double seconds, bool simulation_too = true) {
    for (long k = 0; k < std::lround(seconds * 100); ++k) {
      now.wall += Time::from_seconds(0.01);
      if (simulation_too) now.simulated += Time::from_seconds(0.01);
      snapshot.motion.time = now.simulated;
      if (simulation_too) server.update(snapshot);
      step();
    }
  }
  void step() { server.step(now, out); }

  template <class T>
  void send(const T& message, Channel channel = kChannel) {
    mavlink::FrameParser().read(writer.write(message), [&](const mavlink::Frame& frame) {
      server.receive(frame, channel, now, out);
    });
  }
  /// The same frame once more.
  template <class T>
  void send_twice(const T& message) {
    const auto bytes = writer.write(message);
    for (int k = 0; k < 2; ++k)
      mavlink::FrameParser().read(bytes, [&](const mavlink::Frame& frame) {
        server.receive(frame, kChannel, now, out);
      });
  }

  /// All messages of a kind that came since the last call of clear().
  template <class T>
  std::vector<T> heard(Channel channel = kChannel) const {
    std::vector<T> all;
    for (const Heard& h : frames)
      if (h.channel == channel)
        mavlink::FrameParser().read(h.bytes, [&](const mavlink::Frame& frame) {
          if (frame.message && frame.id() == mavlink::kFacts<T>.id)
            all.push_back(mavlink::unpack<T>(frame.payload()));
        });
    return all;
  }
  /// The newest; the test fails without one.
  template <class T>
  T last() const {
    const auto all = heard<T>();
    EXPECT_FALSE(all.empty()) << mavlink::kFacts<T>.name;
    return all.empty() ? T() : all.back();
  }
  std::vector<std::string> texts() const {
    std::vector<std::string> all;
    for (const auto& m : heard<mavlink::Statustext>())
      all.emplace_back(mavlink::text_of(m.text));
    return all;
  }
  void clear() { frames.clear(); }

  /// Sends a command and gives its answer back; the test fails unless there is one.
  mavlink::CommandAck command(mavlink::CommandId id, std::vector<float> p = {},
                              std::uint8_t confirmation = 0) {
    p.resize(7);
    mavlink::CommandLong m;
    m.target_system = 7;
    m.target_component = 1;
    m.command = static_cast<std::uint16_t>(id);
    m.confirmation = confirmation;
    m.param1 = p[0];
    m.param2 = p[1];
    m.param3 = p[2];
    m.param4 = p[3];
    m.param5 = p[4];
    m.param6 = p[5];
    m.param7 = p[6];
    return answer_to(m);
  }
  /// @param p  parameters 1 to 4.
  mavlink::CommandAck command_int(mavlink::CommandId id, std::vector<float> p,
                                  mavlink::CoordinateFrame frame, double latitude_deg,
                                  double longitude_deg, float z) {
    p.resize(4);
    mavlink::CommandInt m;
    m.target_system = 7;
    m.target_component = 1;
    m.command = static_cast<std::uint16_t>(id);
    m.frame = static_cast<std::uint8_t>(frame);
    m.param1 = p[0];
    m.param2 = p[1];
    m.param3 = p[2];
    m.param4 = p[3];
    m.x = degrees_e7(latitude_deg);
    m.y = degrees_e7(longitude_deg);
    m.z = z;
    return answer_to(m);
  }
  template <class T>
  mavlink::CommandAck answer_to(const T& m) {
    clear();
    send(m);
    const auto acks = heard<mavlink::CommandAck>();
    EXPECT_EQ(acks.size(), 1U);
    if (acks.empty()) return {};
    EXPECT_EQ(acks[0].command, m.command);
    EXPECT_EQ(acks[0].target_system, 255);
    EXPECT_EQ(acks[0].target_component, 190);
    return acks[0];
  }
  int result(mavlink::CommandId id, std::vector<float> p = {}) {
    return command(id, std::move(p)).result;
  }

  /// What was asked of the simulation, of one kind; the test fails where there is more.
  template <class T>
  T only_request() {
    const auto all = server.take_requests();
    EXPECT_EQ(all.size(), 1U);
    if (all.size() != 1 || !std::holds_alternative<T>(all[0])) {
      ADD_FAILURE() << "another request";
      return {};
    }
    return std::get<T>(all[0]);
  }

  struct Heard {
    Channel channel;
    std::vector<std::byte> bytes;
  };

  Clocks now;
  VehicleSnapshot snapshot;
  VehicleServer server;
  std::vector<Heard> frames;
  Outbox out;
  mavlink::FrameWriter writer{255, 190};
};

inline int number(mavlink::CommandResult result) {
  return static_cast<int>(result);
}

}  // namespace skein::vehicle_services
