// SPDX-License-Identifier: Apache-2.0
#pragma once

// A world of gliders that fly straight on and write to each other, and a recorder that
// notes everything as text.

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "skein/role/agent.h"
#include "skein/role/moving_object.h"
#include "skein/role/operator_console.h"
#include "skein/role/radio.h"
#include "skein/role/recorder.h"
#include "skein/simulation/commanded_wind.h"
#include "skein/simulation/run.h"
#include "skein/simulation/simulated_vehicle.h"
#include "skein/simulation/world.h"

namespace skein::simulation::test {

// What a glider says of a message that arrived.
inline const EventLabel kHeard = EventLabel::named("heard");

class Ground : public Terrain {
 public:
  double elevation_msl(const Vec2&) const override { return 0; }
  Vec2 gradient(const Vec2&) const override { return Vec2::Zero(); }
};

class Calm : public WindField {
 public:
  Vec3 wind(const Vec3&, Time) const override { return Vec3::Zero(); }
};

class NoFire : public Phenomenon {
 public:
  void advance(Time) override {}
  bool inside(const Vec2&) const override { return false; }
  const geo::Region& region() const override { return region_; }

 private:
  geo::Region region_;
};

// Delivers every message `delay` after it was sent.
class Post : public Radio {
 public:
  explicit Post(Time delay) : delay_(delay) {}
  void send(const Message& message) override { mail_.push_back(message); }
  void deliver(Time now, RadioNews& news) override {
    std::erase_if(mail_, [&](const Message& m) {
      if (m.sent + delay_ > now) return false;
      news.ended.push_back({m});
      return true;
    });
  }

 private:
  Time delay_;
  std::vector<Message> mail_;
};

// Flies straight on at the commanded climb rate.
class Glider : public Plant {
 public:
  explicit Glider(double break_after = std::numeric_limits<double>::infinity())
      : break_after_(break_after) {}
  FlightLimits limits() const override { return {}; }
  Airframe airframe() const override { return SelfStabilised{}; }
  VehicleState start(const VehicleStart&) const override { return {}; }
  void step(VehicleState& s, const Control& c, const Air&, double dt) const override {
    s.v_N = {20, 0, -std::get<FlightCommand>(c).climb_rate};
    s.p_N += dt * s.v_N;
    if (s.p_N.x() > break_after_) s.p_N.x() = std::nan("");
  }
  Contact touch(VehicleState&, double, double) const override { return Contact::kCrash; }

 private:
  double break_after_;
};

class Hands : public Autopilot {
 public:
  explicit Hands(double climb) : climb_(climb) {}
  void begin(const NavEstimate&, bool) override {}
  void sense(const SensorSample&) override {}
  void command(const AutopilotCommand&) override {}
  void set_return(const ReturnRoute&) override {}
  Control control(Time, double) override { return FlightCommand{0, 20, climb_}; }
  NavEstimate estimate() const override { return estimate_; }
  AutopilotStatus status() const override { return {}; }

 private:
  double climb_;
  NavEstimate estimate_;
};

// Sends one message a step to `to`, and notes what it receives.
class Talker : public Agent {
 public:
  explicit Talker(EntityId to) : to_(to) {}
  void step(const AgentInput& in, AgentOutput& out) override {
    for (const Message& message : in.inbox)
      out.events.push_back(
          {in.now, message.from, kHeard, std::to_string(message.number)});
    if (in.now == Time::from_seconds(4)) out.records.emplace_back(Crossing{in.now, to_});
    Message message;
    message.to = to_;
    message.content = AircraftReport{};
    out.outbox.push_back(message);
  }

 private:
  EntityId to_;
};

// Everything as text, in order.
class Notes : public Recorder {
 public:
  void record(const Record& record) override {
    std::visit([this](const auto& one) { note(one); }, record);
  }
  Result<void> step_done(Time now) override {
    if (full_at && now >= *full_at)
      return Error{ErrorCode::kUnavailable, "disk", "it is full.", ""};
    return {};
  }
  std::string text, kinds, objects;
  std::vector<RangeScan> scans;
  std::vector<ObjectMotion> motions;
  std::vector<CommandRecord> commands;
  int truths = 0, messages = 0, crossings = 0;
  std::optional<Time> full_at;

 private:
  template <class Other>
  void note(const Other&) {}
  void note(const EntityRecord& e) { text += fmt::format("{}={};", e.id.value, e.name); }
  void note(const TruthRecord& t) {
    text += fmt::format("T{} {} {};", t.time.ns(), t.id.value, t.state.p_N.x());
    ++truths;
  }
  void note(const MessageRecord& m) {
    text +=
        fmt::format("M{} {} {};", m.arrived.ns(), m.message.from.value, m.message.number);
    ++messages;
  }
  void note(const Event& e) {
    text +=
        fmt::format("E{} {} {} {};", e.time.ns(), e.entity.value, e.kind.name(), e.text);
    // These gliders fly through each other.
    const bool counts = e.kind != kHeard && e.kind != EventKind::kSeparationLost &&
                        e.kind != EventKind::kSeparationRestored &&
                        e.kind != EventKind::kSeparationNotRestored;
    if (counts) kinds.append(e.kind.name()).append(" ");
  }
  void note(const Crossing& c) {
    text += fmt::format("C{} {};", c.time.ns(), c.aircraft.value);
    ++crossings;
  }
  void note(const GroundObject& o) { objects += o.name + ";"; }
  void note(const ObjectMotion& m) { motions.push_back(m); }
  void note(const RangeScan& scan) { scans.push_back(scan); }
  void note(const CommandRecord& command) { commands.push_back(command); }
};

class Silent : public OperatorConsole {
 public:
  void show(const RunProgress&) override {}
  bool stop_requested() const override { return asked++ >= stop_after; }
  mutable int asked = 0;
  int stop_after = std::numeric_limits<int>::max();
};

using Change = std::function<void(std::size_t index, VehicleParts& parts)>;

inline World make_world(int count, Time delay = Time(), double climb = 0,
                        const Change& change = {}) {
  World world;
  world.terrain = std::make_unique<Ground>();
  world.wind = std::make_unique<CommandedWind>(std::make_unique<Calm>());
  world.phenomena.push_back(std::make_unique<NoFire>());
  world.radio = std::make_unique<Post>(delay);
  const auto plant = std::make_shared<Glider>();
  for (int i = 0; i < count; ++i) {
    Entity entity;
    entity.name = fmt::format("a{}", i);
    entity.kind = "aircraft";
    entity.agent =
        std::make_unique<Talker>(EntityId{static_cast<std::uint32_t>((i + 1) % count)});
    entity.agent_period = Time::from_seconds(0.5);
    VehicleParts parts;
    parts.name = entity.name;
    parts.plant = plant;
    parts.autopilot = std::make_unique<Hands>(climb);
    parts.step = Time::from_seconds(0.1);
    parts.state.p_N = {0, 0, -50};
    if (change) change(static_cast<std::size_t>(i), parts);
    entity.vehicle = std::make_unique<SimulatedVehicle>(std::move(parts));
    entity.active = {{Time(), Time::from_seconds(1e6)}};
    world.entities.push_back(std::move(entity));
  }
  return world;
}

/// From the first step to the last.
inline Result<void> run_to_end(World& world, const RunOptions& options,
                               Recorder& recorder) {
  return Run(world, options, recorder).run_to_end();
}

inline RunOptions seconds(double duration, int threads = 1) {
  RunOptions options;
  options.duration = Time::from_seconds(duration);
  options.threads = threads;
  return options;
}

}  // namespace skein::simulation::test
