// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "skein/geo/local_frame.h"
#include "skein/link/autopilot_client/request_steps.h"
#include "skein/link/mavlink/frame_parser.h"
#include "skein/link/mavlink/messages.h"
#include "skein/link/transport/endpoints.h"
#include "skein/link/vehicle_links/vehicle_links.h"
#include "skein/link/vehicle_services/outbox.h"

namespace skein::vehicle_links {

/// Multirotors at the far ends of a run's links, in one thread: they hover where they
/// were put, say so ten times a second, accept every command, and keep what they receive.
class StandIns final : public transport::ChannelListener {
 public:
  using Clock = std::chrono::steady_clock;

  /// A report about another aircraft that has arrived.
  struct Heard {
    std::size_t by = 0;  ///< number of the receiver
    mavlink::AdsbVehicle what;
    Clock::time_point at;
  };

  /// @param server  where the links wait: "udpin:127.0.0.1:PORT".
  StandIns(const geo::LocalFrame& frame, const std::string& server)
      : frame_(frame), server_("udpout" + server.substr(server.find(':'))) {}

  /// One more, with a connection of its own, or that of the one before.
  void add(std::uint8_t system, const Vec2& place, bool with_last = false) {
    if (!with_last) {
      const auto opened = endpoints_.open(transport::parse_endpoint(server_).value());
      if (!opened) throw std::runtime_error(opened.error().text());
    }
    vehicles_.push_back({autopilot_client::scaled_place(place, frame_), last_channel_,
                         vehicle_services::Outbox(system, 1, sink_)});
  }

  /// Runs for so long. Vehicle k sends at its share of each tenth of a second.
  void run(std::chrono::milliseconds duration) {
    const Clock::time_point end = Clock::now() + duration;
    if (due_.empty())
      for (std::size_t k = 0; k < vehicles_.size(); ++k)
        due_.emplace(Clock::now() + kPeriod * k / vehicles_.size(), k);
    while (Clock::now() < end) {
      while (due_.begin()->first <= Clock::now()) {
        const auto [due, k] = *due_.begin();
        due_.erase(due_.begin());
        due_.emplace(due + kPeriod, k);
        send(k);
      }
      endpoints_.run_one_for(due_.begin()->first - Clock::now());
    }
  }

  /// A tenth of a second of their own clocks: each sends once, and takes what is there.
  void step() {
    for (std::size_t k = 0; k < vehicles_.size(); ++k) send(k);
    for (int k = 0; k < 100 && endpoints_.run_one_for({}); ++k) {
    }
  }

  std::vector<Heard> heard;
  std::size_t obstacles = 0, fixes = 0;  ///< messages received
  /// When vehicle k sent its altitude of 100 m and n millimetres.
  Clock::time_point sent_at(std::size_t k, std::int32_t altitude_mm) const {
    return vehicles_[k].sent.at(static_cast<std::size_t>(altitude_mm - kAltitude));
  }
  std::size_t size() const { return vehicles_.size(); }

 private:
  static constexpr std::chrono::milliseconds kPeriod{100};
  static constexpr std::int32_t kAltitude = 100'000;  // [mm]

  struct Vehicle {
    autopilot_client::ScaledPlace place;
    transport::ChannelId channel;
    vehicle_services::Outbox out;
    std::vector<Clock::time_point> sent = {};
  };

  void send(std::size_t k) {
    Vehicle& vehicle = vehicles_[k];
    if (vehicle.sent.size() % 10 == 0) {
      mavlink::Heartbeat heartbeat;
      heartbeat.type = 2;
      heartbeat.autopilot = 3;
      heartbeat.base_mode = 129;  // armed
      heartbeat.system_status = 4;
      heartbeat.mavlink_version = 3;
      vehicle.out.send(vehicle.channel, heartbeat);
      mavlink::GpsRawInt fix;
      fix.fix_type = 3;
      vehicle.out.send(vehicle.channel, fix);
    }
    vehicle.out.send(vehicle.channel, mavlink::Attitude{});
    mavlink::GlobalPositionInt position;
    position.time_boot_ms = static_cast<std::uint32_t>(100 * vehicle.sent.size());
    position.lat = vehicle.place.latitude;
    position.lon = vehicle.place.longitude;
    position.alt = kAltitude + static_cast<std::int32_t>(vehicle.sent.size());
    vehicle.sent.push_back(Clock::now());
    vehicle.out.send(vehicle.channel, position);
  }

  void opened(transport::ChannelId channel, transport::EndpointId,
              const std::string&) override {
    last_channel_ = channel;
  }
  void closed(transport::ChannelId, const std::string&) override {}
  void received(transport::ChannelId channel, std::span<const std::byte> bytes) override {
    const Clock::time_point now = Clock::now();
    mavlink::FrameParser().read(bytes, [&](const mavlink::Frame& frame) {
      for (std::size_t k = 0; k < vehicles_.size(); ++k)
        if (vehicles_[k].channel == channel) take(k, frame, now);
    });
  }
  void take(std::size_t k, const mavlink::Frame& frame, Clock::time_point now) {
    Vehicle& vehicle = vehicles_[k];
    if (frame.id() == mavlink::kFacts<mavlink::AdsbVehicle>.id)
      heard.push_back({k, mavlink::unpack<mavlink::AdsbVehicle>(frame.payload()), now});
    obstacles += frame.id() == mavlink::kFacts<mavlink::ObstacleDistance>.id ? 1 : 0;
    fixes += frame.id() == mavlink::kFacts<mavlink::GpsInput>.id ? 1 : 0;
    if (frame.id() != mavlink::kFacts<mavlink::CommandLong>.id ||
        frame.target_system() != vehicle.out.system())
      return;
    mavlink::CommandAck ack;
    ack.command = mavlink::unpack<mavlink::CommandLong>(frame.payload()).command;
    ack.target_system = frame.system();
    ack.target_component = frame.component();
    vehicle.out.send(vehicle.channel, ack);
  }

  geo::LocalFrame frame_;
  std::string server_;
  transport::ChannelId last_channel_ = 0;
  transport::Endpoints endpoints_{*this};
  vehicle_services::Outbox::Sink sink_ = [this](auto channel, auto bytes) {
    endpoints_.send(channel, bytes);
  };
  std::vector<Vehicle> vehicles_;
  std::set<std::pair<Clock::time_point, std::size_t>> due_;
};

}  // namespace skein::vehicle_links
