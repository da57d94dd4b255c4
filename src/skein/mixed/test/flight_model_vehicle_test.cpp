// SPDX-License-Identifier: Apache-2.0
#include "skein/mixed/flight_model_vehicle.h"

#include <gtest/gtest.h>

#include <utility>

#include "skein/mixed/recorded_flight_model.h"

namespace skein::mixed::flight_model_vehicle_test {
namespace {

// A model whose reports and controls are the test's.
struct ModelScript {
  std::vector<VehicleReport> says;
  std::vector<Actuators> told;
  Vec3 wind_N = Vec3::Zero();
};
class ScriptedModel final : public FlightModel {
 public:
  explicit ScriptedModel(ModelScript& script) : script_(script) {}
  void receive(Time, std::vector<VehicleReport>& out) override {
    for (VehicleReport& report : script_.says) out.push_back(std::move(report));
    script_.says.clear();
  }
  void send(const Actuators& actuators, const Vec3& wind_N) override {
    script_.told.push_back(actuators);
    script_.wind_N = wind_N;
  }

 private:
  ModelScript& script_;
};

// Aileron by the northing that its sensor has measured last; what it was told is the
// test's to see.
struct PilotLog {
  std::vector<NavEstimate> begins;
  std::vector<AutopilotCommand> commands;
  int samples = 0;
};
struct NorthPilot final : Autopilot {
  explicit NorthPilot(PilotLog& kept) : log(kept) {}
  void begin(const NavEstimate& start, bool) override { log.begins.push_back(start); }
  void sense(const SensorSample& sample) override {
    if (const auto* truth = std::get_if<TruthSample>(&sample)) {
      north = truth->p_N.x();
      ++log.samples;
    }
  }
  void command(const AutopilotCommand& command) override {
    log.commands.push_back(command);
  }
  void set_return(const ReturnRoute&) override {}
  Control control(Time, double) override {
    Actuators actuators;
    actuators[channel::kAileron] = north / 1000;
    return actuators;
  }
  NavEstimate estimate() const override { return {}; }
  AutopilotStatus status() const override { return {}; }
  PilotLog& log;
  double north = 0;
};

struct Truth final : Sensor {
  void sample(const SensorView& view, std::vector<SensorSample>& out) override {
    TruthSample sample;
    sample.time = view.now;
    sample.p_N = view.vehicle.p_N;
    sample.wind_N = view.air.wind_N;
    out.emplace_back(sample);
  }
};
struct Altimeter final : Sensor {
  bool payload() const override { return true; }
  void sample(const SensorView& view, std::vector<SensorSample>& out) override {
    out.emplace_back(HeightSample{view.now, -view.vehicle.p_N.z()});
  }
};
struct Flat final : Terrain {
  double elevation_msl(const Vec2&) const override { return 0; }
  Vec2 gradient(const Vec2&) const override { return Vec2::Zero(); }
};
struct Westerly final : WindField {
  Vec3 wind(const Vec3&, Time) const override { return {0, 7, 0}; }
};

struct ModelFlight {
  explicit ModelFlight(std::unique_ptr<FlightModel> model = nullptr) {
    FlightModelVehicleParts parts;
    parts.name = "a1";
    parts.model = model ? std::move(model) : std::make_unique<ScriptedModel>(script);
    parts.autopilot = std::make_unique<NorthPilot>(log);
    parts.sensors.push_back(std::make_unique<Truth>());
    parts.payload.push_back(std::make_unique<Altimeter>());
    parts.breakable = {{VehicleFault::Kind::kSensor, 0, {}, {}, "sensor truth"}};
    parts.state.p_N = {0, 0, -100};
    vehicle = std::make_unique<FlightModelVehicle>(std::move(parts));
    vehicle->begin(world, now);
  }
  // One step of the run; what the payload has measured.
  std::vector<SensorSample> step() {
    vehicle->begin_step(now);
    vehicle->take_reports(reports);
    for (; stamped < reports.size(); ++stamped) times.push_back(now);
    PayloadSamples seen;
    vehicle->look(world, now, seen);
    EXPECT_EQ(seen.ends.size(), 1U);
    const Time until = now + Time::from_seconds(0.02);
    vehicle->advance(world, now, until, nullptr);
    vehicle->take_events(events);
    now = until;
    return seen.samples;
  }
  void say(double north, double age = 0) {
    VehicleMotion motion;
    motion.time = now - Time::from_seconds(age);
    motion.p_N = {north, 0, -300};
    motion.v_N = {50, 0, 0};
    motion.wind_N = {1, 2};
    script.says.emplace_back(motion);
  }
  std::vector<EventLabel> kinds() const {
    std::vector<EventLabel> all;
    for (const VehicleEvent& event : events) all.push_back(event.kind);
    return all;
  }

  ModelScript script;
  PilotLog log;
  Flat ground;
  Westerly wind;
  Surroundings world{ground, wind};
  std::unique_ptr<FlightModelVehicle> vehicle;
  Time now = Time::from_seconds(10);
  std::vector<VehicleReport> reports;
  std::vector<Time> times;  // at which they were taken in
  std::size_t stamped = 0;
  std::vector<VehicleEvent> events;
};

using Kinds = std::vector<EventLabel>;

TEST(FlightModelVehicle, TheModelIsTheTruthAndTheAutopilotSteersIt) {
  ModelFlight flight;
  EXPECT_TRUE(flight.step().empty()) << "nobody knows where it is yet";
  EXPECT_EQ(flight.log.samples, 0);
  flight.say(500, 0.01);
  const auto seen = flight.step();
  ASSERT_EQ(seen.size(), 1U);
  EXPECT_EQ(std::get<HeightSample>(seen[0]).height_agl, 300);
  EXPECT_NEAR(flight.vehicle->truth()->p_N.x(), 500.5, 1e-9) << "carried on by its age";
  flight.say(501);
  flight.step();
  EXPECT_EQ(flight.log.samples, 1);
  EXPECT_NEAR(flight.script.told.back()[channel::kAileron], 0.501, 1e-9);
  EXPECT_EQ(flight.script.wind_N, Vec3(0, 7, 0)) << "the scenario's wind";
  EXPECT_EQ(flight.kinds(), Kinds{EventKind::kFlightModelHeard});
  ASSERT_EQ(flight.log.begins.size(), 2U);
  EXPECT_NEAR(flight.log.begins[1].p_N.x(), 500.5, 1e-9);
  EXPECT_EQ(flight.log.begins[1].wind_N, Vec2(1, 2)) << "the model's wind";
}

TEST(FlightModelVehicle, ASilentModelIsNotFlownAndGoesOnWhenItIsBack) {
  ModelFlight flight;
  flight.vehicle->command({HoldCourse{1}, 300, {}});
  flight.say(500);
  flight.step();
  flight.say(501);
  flight.step();
  for (int k = 0; k < 30; ++k) flight.step();
  const double held = flight.script.told.back()[channel::kAileron];
  for (int k = 0; k < 20; ++k) flight.step();
  EXPECT_EQ(flight.kinds(),
            (Kinds{EventKind::kFlightModelHeard, EventKind::kFlightModelSilent}));
  const int samples = flight.log.samples;
  EXPECT_TRUE(flight.step().empty()) << "its payload sees nothing";
  EXPECT_EQ(flight.log.samples, samples);
  EXPECT_EQ(flight.script.told.back()[channel::kAileron], held) << "the controls stay";
  flight.say(600);
  flight.step();
  flight.say(601);
  flight.step();
  EXPECT_EQ(flight.kinds(),
            (Kinds{EventKind::kFlightModelHeard, EventKind::kFlightModelSilent,
                   EventKind::kFlightModelBack}));
  EXPECT_NEAR(flight.log.begins.back().p_N.x(), 600, 1e-9);
  EXPECT_EQ(flight.log.commands.size(), 3U) << "its command holds, after each begin";
  EXPECT_NEAR(flight.script.told.back()[channel::kAileron], 0.601, 1e-9);
}

TEST(FlightModelVehicle, AResetBeginsTheFlightAgainThere) {
  ModelFlight flight;
  flight.say(500);
  flight.step();
  flight.script.says.emplace_back(LinkChange{LinkChange::Kind::kRebooted, "it jumped"});
  flight.say(-2000);
  flight.step();
  EXPECT_EQ(flight.kinds(),
            (Kinds{EventKind::kFlightModelHeard, EventKind::kFlightModelReset}));
  EXPECT_NEAR(flight.log.begins.back().p_N.x(), -2000, 1e-9);
}

TEST(FlightModelVehicle, OnlyItsSensorsFail) {
  ModelFlight flight;
  EXPECT_TRUE(flight.vehicle->set_fault("sensor truth", true, flight.now));
  EXPECT_FALSE(flight.vehicle->set_fault("motor", true, flight.now));
  for (int k = 0; k < 5; ++k) {
    flight.say(500 + k);
    flight.step();
  }
  EXPECT_EQ(flight.log.samples, 0);
}

TEST(FlightModelVehicle, WhatWasSaidMakesTheSameFlightAgain) {
  ModelFlight first;
  std::vector<Vec3> places;
  for (int k = 0; k < 100; ++k) {
    if (k % 3 != 1 && (k < 30 || k > 70)) first.say(500 + k, 0.004 * (k % 5));
    if (k == 80)
      first.script.says.emplace_back(OutsideEvent{EventKind::kFlightModelEnded, "so"});
    first.step();
    places.push_back(first.vehicle->truth()->p_N);
  }
  std::vector<TimedReport> recorded;
  for (std::size_t k = 0; k < first.reports.size(); ++k)
    recorded.push_back({first.times[k], first.reports[k]});
  ModelFlight again(std::make_unique<RecordedFlightModel>(std::move(recorded)));
  for (const Vec3& place : places) {
    again.step();
    EXPECT_EQ(again.vehicle->truth()->p_N, place);
  }
  EXPECT_EQ(again.kinds(), first.kinds());
  EXPECT_GT(first.kinds().size(), 3U);
}

}  // namespace
}  // namespace skein::mixed::flight_model_vehicle_test
