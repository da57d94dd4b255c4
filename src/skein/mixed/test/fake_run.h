// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "skein/link/autopilot_client/autopilot_client.h"
#include "skein/mixed/real_vehicle.h"
#include "skein/mixed/test/fake_vehicle.h"

namespace skein::mixed::fake {

/// Guidance that leads to where it is commanded, at 6 m/s.
class PlaceGuidance final : public Autopilot {
 public:
  void begin(const NavEstimate& start, bool) override { here_ = start.p_N; }
  void sense(const SensorSample& sample) override {
    if (const auto* truth = std::get_if<TruthSample>(&sample)) here_ = truth->p_N;
  }
  void command(const AutopilotCommand& command) override {
    if (const auto* hold = std::get_if<HoldPosition>(&command.guidance))
      goal_ = Vec3(hold->point.x(), hold->point.y(), -command.altitude_msl);
  }
  void set_return(const ReturnRoute&) override {}
  Control control(Time, double) override {
    constexpr double kAhead = 6;  // [m], at 6 m/s
    TrackSetpoint setpoint;
    const Vec3 way = goal_ - here_;
    setpoint.p_N = way.norm() > kAhead ? Vec3(here_ + kAhead * way.normalized()) : goal_;
    setpoint.v_N = way.norm() > kAhead ? Vec3(kAhead * way.normalized()) : Vec3::Zero();
    return setpoint;
  }
  NavEstimate estimate() const override { return {}; }
  AutopilotStatus status() const override { return {}; }

 private:
  Vec3 here_ = Vec3::Zero(), goal_ = Vec3::Zero();
};

struct FlatGround final : Terrain {
  double elevation_msl(const Vec2&) const override { return 0; }
  Vec2 gradient(const Vec2&) const override { return Vec2::Zero(); }
};
struct NoWind final : WindField {
  Vec3 wind(const Vec3&, Time) const override { return Vec3::Zero(); }
};

/// A run with one real vehicle, which a fake stands for: the vehicle as the run sees it,
/// the near end of its link, a line, the fake. All in simulated time, without sockets.
///
/// Its agent takes off to `kAltitude`, then goes to and fro between two places.
class FakeRun {
 public:
  static constexpr double kAltitude = 30;  // [m]
  static constexpr double kLeg = 60;       // between its places [m]
  static constexpr double kLine = 0.02;    // delay, each way [s]

  struct Happened {
    Time time;
    EventLabel kind;
    std::string text;
  };

  FakeRun(Make make, Faults faults) : fake(make, std::move(faults), frame_) {
    RealVehicleParts parts;
    parts.name = "real-1";
    parts.port = std::make_unique<Port>(*this);
    parts.guidance = std::make_unique<PlaceGuidance>();
    parts.limits.slowest = 0;
    parts.limits.fastest = 8;
    vehicle = std::make_unique<RealVehicle>(std::move(parts));
    client_ =
        std::make_unique<autopilot_client::AutopilotClient>(client_options(), frame_);
    client_->open(kChannel);
    vehicle->begin(world_, s(-0.1));
  }

  FakeVehicle fake;
  std::unique_ptr<RealVehicle> vehicle;
  std::vector<Happened> events;
  Time now;
  /// When the agent commands the take-off [s].
  double take_off_at = 8;

  void run(double seconds) {
    const Time end = now + s(seconds);
    while (now < end) step();
  }

  std::size_t count(EventKind kind, const std::string& text = "") const {
    return static_cast<std::size_t>(
        std::count_if(events.begin(), events.end(), [&](const Happened& e) {
          return e.kind == kind && e.text.find(text) != std::string::npos;
        }));
  }
  std::string log_text() const {
    std::string all;
    for (const Happened& e : events)
      all += std::to_string(e.time.seconds()) + " " + std::string(e.kind.name()) + ": " +
             e.text + "\n";
    return all;
  }

  /// What is wrong with how it ended, by the truth: it is to stand, to be under command,
  /// or to be alarmed about; it was never led further away than its agent leads, nor low.
  /// Empty: nothing.
  std::string verdict() const {
    if (fake.furthest > 2 * kLeg) return "led away";
    if (fake.lowest_led < kAltitude - 10) return "led at a low height";
    const bool commanded = fake.mode() == VehicleMode::kGuided && fake.armed &&
                           now - fake.last_setpoint < s(1);
    if (fake.on_ground() || commanded) return {};
    return count(EventKind::kNotCommandable) == 1 ? "" : "left alone in the air";
  }

 private:
  static constexpr vehicle_services::Channel kChannel = 1;

  struct Port final : VehiclePort {
    explicit Port(FakeRun& owner) : of(owner) {}
    void receive(Time, std::vector<VehicleReport>& out) override {
      for (VehicleReport& report : of.client_->take_reports())
        out.push_back(std::move(report));
    }
    void send(std::uint32_t number, const VehicleRequest& request) override {
      of.client_->request(number, request, of.now, of.out_);
    }
    FakeRun& of;
  };

  static autopilot_client::AutopilotClientOptions client_options() {
    autopilot_client::AutopilotClientOptions options;
    options.system = 1;
    options.hovers = true;
    options.start.emplace();
    return options;
  }

  using Waiting = std::multimap<Time, std::vector<std::byte>>;
  void step() {
    for (int k = 0; k < 5; ++k) {
      now = now + s(0.02);
      step_link();
    }
    vehicle->begin_step(now);
    command();
    vehicle->advance(world_, now, now + s(0.1), nullptr);
    std::vector<VehicleEvent> happened;
    vehicle->take_events(happened);
    for (VehicleEvent& e : happened)
      events.push_back({now, std::move(e.kind), std::move(e.text)});
    reports_.clear();
    vehicle->take_reports(reports_);
  }

  void step_link() {
    fake.step(now, 0.02);
    const Time there = now + s(kLine + fake.faults.late);
    for (auto& bytes : fake.take_sent()) to_client_.emplace(there, std::move(bytes));
    deliver(to_client_, [this](const mavlink::Frame& frame) {
      if (frame.system() == client_->system())
        client_->receive(frame, kChannel, now, out_);
      else
        client_->receive_other(frame, now);
    });
    deliver(to_fake_, [this](const mavlink::Frame& frame) { fake.receive(frame); });
    client_->step(now, out_);
  }

  template <class Receiver>
  void deliver(Waiting& waiting, Receiver&& receiver) {
    while (!waiting.empty() && waiting.begin()->first <= now) {
      const std::vector<std::byte> bytes = std::move(waiting.begin()->second);
      waiting.erase(waiting.begin());
      mavlink::FrameParser().read(bytes, receiver);
    }
  }

  // As agents do: the take-off again while it stands, then places.
  void command() {
    const AutopilotStatus status = vehicle->status();
    if (!up_) {
      up_ = !status.on_ground &&
            (status.done || -vehicle->estimate().p_N.z() >= kAltitude - 8);
      if (!up_ && status.on_ground && now >= s(take_off_at)) {
        AutopilotCommand command;
        command.guidance = TakeOff{};
        command.altitude_msl = kAltitude;
        vehicle->command(command);
        take_off_at = now.seconds() + 20;
      }
      return;
    }
    if (now < leg_until_) return;
    leg_until_ = now + s(15);
    there_ = !there_;
    AutopilotCommand command;
    command.guidance = HoldPosition{Vec2(there_ ? kLeg : 0, 0)};
    command.altitude_msl = kAltitude;
    vehicle->command(command);
  }

  geo::LocalFrame frame_ = geo::LocalFrame::at({36.989, -122.0514, 0}).value();
  FlatGround ground_;
  NoWind wind_;
  Surroundings world_{ground_, wind_};
  Waiting to_client_, to_fake_;
  vehicle_services::Outbox out_{245, 191, [this](auto, auto bytes) {
                                  to_fake_.emplace(
                                      now + s(kLine + fake.faults.late),
                                      std::vector<std::byte>(bytes.begin(), bytes.end()));
                                }};
  std::unique_ptr<autopilot_client::AutopilotClient> client_;
  std::vector<VehicleReport> reports_;
  bool up_ = false, there_ = false;
  Time leg_until_;
};

}  // namespace skein::mixed::fake
