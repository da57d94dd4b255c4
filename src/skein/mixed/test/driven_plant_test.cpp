// SPDX-License-Identifier: Apache-2.0
#include "skein/mixed/driven_plant.h"

#include <gtest/gtest.h>

#include <functional>
#include <optional>
#include <utility>

#include "skein/mixed/recorded_drive.h"

namespace skein::mixed::driven_plant_test {
namespace {

constexpr double kHardFall = 3;  // [m/s]

// A body that goes up and down as channel 0 says, from rest at 0 to 2 g at 1, and forward
// as channel 1 does.
class Lift final : public Plant {
 public:
  FlightLimits limits() const override { return {}; }
  Airframe airframe() const override { return MultirotorAirframe(); }
  VehicleState start(const VehicleStart& from) const override {
    VehicleState state;
    state.p_N = from.p_N;
    return state;
  }
  void step(VehicleState& state, const Control& control, const Air& air,
            double dt) const override {
    const auto& u = std::get<Actuators>(control);
    const double lift = state.faults.is_dead(0) ? 0 : u[0];
    const Vec3 a_N(u[1] + 0.01 * air.wind_N.x(), 0, kGravity * (1 - 2 * lift));
    state.v_N += dt * a_N;
    state.p_N += dt * state.v_N;
    state.on_ground = false;
  }
  Contact touch(VehicleState& state, double ground_msl, double) const override {
    const bool hard = state.v_N.z() > kHardFall;
    state.p_N.z() = -ground_msl;
    state.v_N.z() = 0;
    state.on_ground = true;
    return hard ? Contact::kCrash : Contact::kRests;
  }
};

struct Plain final : Terrain {
  double elevation_msl(const Vec2&) const override { return 0; }
  Vec2 gradient(const Vec2&) const override { return Vec2::Zero(); }
};
struct Breeze final : WindField {
  Vec3 wind(const Vec3&, Time now) const override {
    return {now.seconds() - 0.1 * static_cast<double>(now.ns() % 7), 0, 0};
  }
};
// Gusts that depend on what was before.
struct Wobble final : Turbulence {
  double last = 0.3;
  Gust advance(const TurbulenceView& view, double dt) override {
    last = 3.7 * last * (1 - last) + 1e-9 * view.vehicle.v_N.x() * dt;
    return {{last, 0, 0}, Vec3::Zero()};
  }
};

// Does as the test says, and keeps what it was given.
struct Scripted final : AutopilotDrive {
  using Script = std::function<std::optional<std::vector<float>>(const SensedMotion&)>;
  Scripted(Script what, std::vector<SensedMotion>& kept)
      : script(std::move(what)), felt(kept) {}
  bool exchange(const SensedMotion& motion, std::span<float> channels) override {
    felt.push_back(motion);
    const auto outputs = script(motion);
    if (!outputs) {
      if (!std::exchange(silent, true))
        events.push_back({EventKind::kAutopilotSilent, "so"});
      return false;
    }
    if (std::exchange(silent, false))
      events.push_back({EventKind::kAutopilotBack, "and so"});
    std::copy(outputs->begin(), outputs->end(), channels.begin());
    return true;
  }
  void take_events(Time, std::vector<OutsideEvent>& out) override {
    out.insert(out.end(), events.begin(), events.end());
    events.clear();
  }
  Script script;
  std::vector<SensedMotion>& felt;
  std::vector<OutsideEvent> events;
  bool silent = false;
};

// What a flight was like.
struct Flown {
  std::vector<VehicleState> states;  // at each step of the run
  std::vector<TimedReport> reports;
  std::vector<std::pair<Time, VehicleEvent>> events;
  std::vector<SensedMotion> felt;
  bool lost = false;
};

DrivenPlantParts parts_with(std::unique_ptr<AutopilotDrive> drive, double height) {
  DrivenPlantParts parts;
  parts.name = "a1";
  parts.plant = std::make_shared<Lift>();
  parts.turbulence = std::make_unique<Wobble>();
  parts.drive = std::move(drive);
  parts.channels = 2;
  parts.breakable = {{VehicleFault::Kind::kMotor, 0, {}, {}, "motor"}};
  parts.step = Time::from_ns(2'500'000);
  parts.state.p_N = {0, 0, -height};
  return parts;
}

Flown flown(std::unique_ptr<AutopilotDrive> drive, double height, int steps = 50,
            int broken_at = 1000) {
  const Plain ground;
  const Breeze wind;
  const Surroundings world{ground, wind};
  DrivenPlant plant(parts_with(std::move(drive), height));
  Flown flown;
  const Time length = Time::from_seconds(0.1);
  plant.begin(world, Time());
  const auto take = [&](Time now) {
    std::vector<VehicleEvent> events;
    plant.take_events(events);
    for (VehicleEvent& event : events) flown.events.emplace_back(now, std::move(event));
    std::vector<VehicleReport> reports;
    plant.take_reports(reports);
    for (VehicleReport& report : reports)
      flown.reports.push_back({now, std::move(report)});
  };
  for (int k = 0; k < steps && !plant.lost(); ++k) {
    const Time now = length * k;
    if (k == broken_at) {
      EXPECT_TRUE(plant.set_fault("motor", true, now));
    }
    plant.begin_step(now);
    take(now);
    plant.advance(world, now, now + length);
    take(now);
    flown.states.push_back(plant.state());
  }
  flown.lost = plant.lost();
  return flown;
}

Flown flown_by(const Scripted::Script& script, double height, int steps = 50,
               int broken_at = 1000) {
  std::vector<SensedMotion> felt;
  Flown all = flown(std::make_unique<Scripted>(script, felt), height, steps, broken_at);
  all.felt = std::move(felt);
  return all;
}

std::vector<float> hover(const SensedMotion& motion) {
  const double error = -motion.p_N.z() - 30;
  return {static_cast<float>(0.5 - 0.02 * error + 0.05 * motion.v_N.z()), 0.25F};
}

void expect_same(const Flown& a, const Flown& b) {
  ASSERT_EQ(a.states.size(), b.states.size());
  for (std::size_t k = 0; k < a.states.size(); ++k) {
    EXPECT_EQ(a.states[k].p_N, b.states[k].p_N) << k;
    EXPECT_EQ(a.states[k].v_N, b.states[k].v_N) << k;
  }
  ASSERT_EQ(a.events.size(), b.events.size());
  for (std::size_t k = 0; k < a.events.size(); ++k) {
    EXPECT_EQ(a.events[k].first, b.events[k].first);
    EXPECT_EQ(a.events[k].second.kind, b.events[k].second.kind);
    EXPECT_EQ(a.events[k].second.text, b.events[k].second.text);
  }
  EXPECT_EQ(a.reports.size(), b.reports.size());
  EXPECT_EQ(a.lost, b.lost);
}

TEST(DrivenPlant, FliesAsItsDriveSays) {
  const Flown flight = flown_by(hover, 28, 200);
  EXPECT_NEAR(flight.states.back().p_N.z(), -30, 0.1);
  EXPECT_GT(flight.states.back().p_N.x(), 10);
  EXPECT_EQ(flight.felt.size(), 200u * 40);
  EXPECT_EQ(flight.felt.front().time, Time::from_ns(2'500'000));
  EXPECT_EQ(flight.felt.back().time, Time::from_seconds(20));
}

// At half lift it hovers: what is felt is one g upwards, and the push forward.
TEST(DrivenPlant, FeelsItsSpecificForce) {
  const Flown flight = flown_by(
      [](const SensedMotion&) {
        return std::vector<float>{0.5F, 0.25F};
      },
      30, 3);
  EXPECT_NEAR(flight.felt[0].f_B.z(), 0, 1e-9) << "no lift yet: it falls";
  for (std::size_t k = 1; k < flight.felt.size(); ++k) {
    EXPECT_NEAR(flight.felt[k].f_B.z(), -kGravity, 1e-9);
    EXPECT_NEAR(flight.felt[k].f_B.x(), 0.25, 0.05);  // and some wind
  }
  EXPECT_NEAR(flight.felt[1].height_agl, 30, 0.01);
}

TEST(DrivenPlant, TheGroundIsFeltWithinBounds) {
  const auto fall = [](const SensedMotion&) { return std::vector<float>{0.4F, 0}; };
  const Flown flight = flown_by(fall, 1.5);
  EXPECT_FALSE(flight.lost);
  EXPECT_TRUE(flight.states.back().on_ground);
  double largest = 0;
  for (const SensedMotion& m : flight.felt)
    largest = std::max(largest, m.f_B.cwiseAbs().maxCoeff());
  EXPECT_GT(largest, 5 * kGravity);
  EXPECT_LE(largest, 16 * kGravity);
}

TEST(DrivenPlant, AHardFallEndsIt) {
  const auto nothing = [](const SensedMotion&) { return std::vector<float>{0, 0}; };
  const Flown flight = flown_by(nothing, 5);
  EXPECT_TRUE(flight.lost);
  EXPECT_EQ(flight.events.back().second.kind, EventKind::kAccident);
  EXPECT_EQ(flight.events.back().second.text, "a1 hit the ground");
}

TEST(DrivenPlant, ABrokenMotorGivesNothing) {
  const Flown flight = flown_by(hover, 30, 100, 20);
  EXPECT_TRUE(flight.lost);
  EXPECT_EQ(flight.events.front().second.kind, EventKind::kFailure);
}

TEST(DrivenPlant, KeepsTheLastOutputsWhileItsDriveIsSilent) {
  const auto script = [](const SensedMotion& m) -> std::optional<std::vector<float>> {
    if (m.time > Time::from_seconds(1) && m.time < Time::from_seconds(2))
      return std::nullopt;
    return std::vector<float>{0.5F, m.time < Time::from_seconds(1.5) ? 0.5F : 0.F};
  };
  const Flown flight = flown_by(script, 30, 40);
  std::vector<EventLabel> kinds;
  for (const auto& [time, event] : flight.events) kinds.push_back(event.kind);
  EXPECT_EQ(kinds, (std::vector<EventLabel>{EventKind::kAutopilotSilent,
                                            EventKind::kAutopilotBack}));
  // It is pushed through the whole silence, and no longer; wind adds up to 0.1 m/s.
  EXPECT_NEAR(flight.states[19].v_N.x() - flight.states[9].v_N.x(), 0.5, 0.1);
  EXPECT_NEAR(flight.states[39].v_N.x() - flight.states[20].v_N.x(), 0, 0.1);
}

// Flights of every kind: even, silent for a while, ended by a crash.
TEST(RecordedDrive, FliesTheSameAgainBitByBit) {
  int calls = 0;
  const auto restless = [&calls](const SensedMotion& m) {
    ++calls;
    auto outputs = hover(m);
    outputs[1] = 0.1F * static_cast<float>(calls / 8 % 5);
    return outputs;
  };
  const auto halting = [](const SensedMotion& m) -> std::optional<std::vector<float>> {
    if (m.time.ns() % 2'000'000'000 > 1'300'000'000) return std::nullopt;
    return hover(m);
  };
  const auto nothing = [](const SensedMotion&) { return std::vector<float>{0.1F, 0}; };
  for (const Scripted::Script& script :
       {Scripted::Script(hover), Scripted::Script(restless), Scripted::Script(halting),
        Scripted::Script(nothing)}) {
    const Flown first = flown_by(script, 29, 100);
    expect_same(first, flown(std::make_unique<RecordedDrive>(first.reports), 29, 100));
  }
}

TEST(RecordedDrive, IsSilentBeyondItsRecords) {
  const Flown first = flown_by(hover, 29, 10);
  const Flown again = flown(std::make_unique<RecordedDrive>(first.reports), 29, 20);
  EXPECT_EQ(again.states[9].p_N, first.states[9].p_N);
  EXPECT_EQ(again.states.size(), 20u);
}

TEST(RecordedDrive, TakesNothingFromRecordsThatMakeNoSense) {
  ActuatorOutputs odd;
  odd.channels = 2;
  odd.values = {1};
  odd.steps = {5, 0, 7};
  RecordedDrive drive({{Time(), odd}});
  float channels[2] = {0.5F, 0.5F};
  EXPECT_FALSE(drive.exchange({}, channels));
  EXPECT_EQ(channels[0], 0.5F);
  float one[1] = {0.5F};
  EXPECT_FALSE(drive.exchange({}, one));
}

}  // namespace
}  // namespace skein::mixed::driven_plant_test
