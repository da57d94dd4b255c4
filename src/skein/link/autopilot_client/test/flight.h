// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "skein/link/autopilot_client/autopilot_client.h"
#include "skein/link/vehicle_services/test/bad_line.h"
#include "skein/link/vehicle_services/test/paper_vehicle.h"
#include "skein/link/vehicle_services/test/station.h"

namespace skein::autopilot_client {

using vehicle_services::BadLine;
using vehicle_services::Make;
using vehicle_services::PaperVehicle;
using vehicle_services::Trouble;
using vehicle_services::VehicleServer;
using Outcome = RequestAnswer::Outcome;

struct Identity {
  Make make;
  bool hovers;
};

/// The near end of a link, a line, and a vehicle at its other end, in simulated time.
class Flight {
 public:
  Flight(const Identity& identity, const Trouble& trouble, unsigned seed)
      : options_(vehicle_services::test_options(identity.make, identity.hovers)),
        client_({.system = 7, .hovers = identity.hovers}, frame_),
        line(trouble, seed) {
    line.at_vehicle = [this](const mavlink::Frame& heard) {
      server_->receive(heard, 1, clocks(), line.vehicle);
    };
    line.at_station = [this](const mavlink::Frame& heard) {
      client_.receive(heard, 1, line.now, line.station);
      if (second_link_)
        late_.emplace(line.now + Time::from_seconds(0.5),
                      std::vector<std::byte>(heard.bytes.begin(), heard.bytes.end()));
    };
    reboot();
    client_.open(1);
  }

  /// The vehicle's autopilot begins anew, wherever the vehicle is.
  void reboot() {
    begun_ = line.now;
    server_ = std::make_unique<VehicleServer>(options_, frame_);
    server_->open(1, clocks());
    server_->update(paper.snapshot);
  }

  /// The vehicle's clock jumps.
  void jump(const Time& by) { begun_ = begun_ - by; }

  /// From now on another vehicle with the same number is heard, by another channel or by
  /// the same; its clock has just begun.
  void add_double(vehicle_services::Channel channel = 2) {
    double_channel_ = channel;
    double_begun_ = line.now;
    client_.open(channel);
    double_ = std::make_unique<VehicleServer>(options_, frame_);
    double_->open(1, double_clocks());
  }
  void remove_double() { double_.reset(); }

  /// From now on it is heard by channel 2 too, half a second later.
  void add_second_link() {
    client_.open(2);
    second_link_ = true;
  }

  template <class Until>
  bool wait(double seconds, Until until) {
    const Time end = line.now + Time::from_seconds(seconds);
    while (!until() && line.now < end) step();
    return until();
  }

  /// As a director does: asks again while there is no answer, or it is denied.
  Outcome request(const VehicleRequest& what) {
    Outcome outcome = Outcome::kNoAnswer;
    for (int tries = 0; tries < 6 && outcome != Outcome::kAccepted; ++tries) {
      if (tries > 0) wait(3, [] { return false; });
      const std::uint32_t number = ++asked_;
      answer_.reset();
      client_.request(number, what, line.now, line.station);
      wait(60, [&] { return answer_ && answer_->number == number; });
      if (answer_) outcome = answer_->outcome;
    }
    return outcome;
  }

  /// As a director does: setpoints, and the mode until it is told.
  bool guide(const VehicleRequest& setpoint) {
    for (int tries = 0; tries < 20 && told.mode != VehicleMode::kGuided; ++tries) {
      client_.request(0, ModeRequest{VehicleMode::kGuided}, line.now, line.station);
      steer(setpoint, 3);
    }
    return told.mode == VehicleMode::kGuided;
  }

  /// Asks for a setpoint ten times a second.
  void steer(const VehicleRequest& setpoint, double seconds) {
    const Time end = line.now + Time::from_seconds(seconds);
    while (line.now < end) {
      client_.request(0, setpoint, line.now, line.station);
      for (int k = 0; k < 10; ++k) step();
    }
  }

 private:
  vehicle_services::Clocks clocks() const { return {line.now, line.now - begun_}; }
  vehicle_services::Clocks double_clocks() const {
    return {line.now, line.now - double_begun_};
  }

  void step() {
    line.step();
    if (++steps_ % 2 != 0) return;
    paper.step(0.02);
    paper.snapshot.motion.time = clocks().simulated;
    server_->update(paper.snapshot);
    server_->step(clocks(), line.vehicle);
    for (const VehicleRequest& request : server_->take_requests()) paper.obey(request);
    step_double();
    step_second_link();
    client_.step(line.now, line.station);
    for (VehicleReport& report : client_.take_reports()) take(report);
  }

  void step_double() {
    if (!double_) return;
    vehicle_services::VehicleSnapshot elsewhere = paper.snapshot;
    elsewhere.motion.p_N = {5000, 5000, -900};
    elsewhere.motion.time = double_clocks().simulated;
    double_->update(elsewhere);
    double_->step(double_clocks(), doubles_);
  }

  void step_second_link() {
    while (!late_.empty() && late_.begin()->first <= line.now) {
      mavlink::FrameParser().read(late_.begin()->second, [this](const auto& heard) {
        client_.receive(heard, 2, line.now, line.station);
      });
      late_.erase(late_.begin());
    }
  }

  void take(const VehicleReport& report) {
    if (const auto* answer = std::get_if<RequestAnswer>(&report)) answer_ = *answer;
    if (const auto* motion = std::get_if<VehicleMotion>(&report)) {
      seen = *motion;
      // Where it was at that time, not where it is: the line may take half a second.
      oldest = std::max(oldest, (line.now - motion->time).seconds());
    }
    if (const auto* progress = std::get_if<MissionProgress>(&report))
      finished = progress->finished;
    if (const auto* condition = std::get_if<VehicleCondition>(&report)) told = *condition;
    if (const auto* change = std::get_if<LinkChange>(&report)) ++changes[change->kind];
  }

  geo::LocalFrame frame_ = vehicle_services::test_frame();
  vehicle_services::VehicleServerOptions options_;
  std::unique_ptr<VehicleServer> server_;
  Time begun_;  // of the vehicle's clock
  std::unique_ptr<VehicleServer> double_;
  Time double_begun_;
  vehicle_services::Channel double_channel_ = 2;
  vehicle_services::Outbox doubles_{
      7, 1, [this](auto, auto bytes) {
        mavlink::FrameParser().read(bytes, [this](const mavlink::Frame& heard) {
          client_.receive(heard, double_channel_, line.now, line.station);
        });
      }};
  bool second_link_ = false;
  std::multimap<Time, std::vector<std::byte>> late_;  // on their way by it
  AutopilotClient client_;
  std::uint32_t asked_ = 0;
  std::optional<RequestAnswer> answer_;
  int steps_ = 0;

 public:
  BadLine line;
  PaperVehicle paper{vehicle_services::standing()};
  VehicleMotion seen;
  VehicleCondition told;
  double oldest = 0;
  bool finished = false;
  std::map<LinkChange::Kind, int> changes;
};

}  // namespace skein::autopilot_client
