// SPDX-License-Identifier: Apache-2.0
#include "skein/simulation/simulated_vehicle.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "skein/simulation/test/gliders.h"

namespace skein::simulation::simulated_vehicle_test {
namespace {

using namespace test;

// Says how long ago it last measured, as an inertial unit's interval does.
class Intervals : public Sensor {
 public:
  void sample(const SensorView& view, std::vector<SensorSample>& out) override {
    ImuSample sample;
    sample.time = view.now;
    sample.interval = (view.now - last_).seconds();
    last_ = view.now;
    out.emplace_back(sample);
  }

 private:
  Time last_;
};

// Notes when its flight began and what it sensed.
class Listener : public Hands {
 public:
  Listener() : Hands(0) {}
  void begin(const NavEstimate& start, bool) override { begun.push_back(start); }
  void sense(const SensorSample& sample) override {
    if (const auto* imu = std::get_if<ImuSample>(&sample))
      longest = std::max(longest, imu->interval), ++heard;
  }
  std::vector<NavEstimate> begun;
  double longest = 0;
  int heard = 0;
};

// Puts a listener, which stays its vehicle's, into the first vehicle.
Change listen(Listener** heard, std::vector<VehicleFault> faults = {}) {
  return [heard, faults](std::size_t, VehicleParts& parts) {
    auto listener = std::make_unique<Listener>();
    *heard = listener.get();
    parts.autopilot = std::move(listener);
    parts.sensors.push_back(std::make_unique<Intervals>());
    parts.faults = faults;
  };
}

TEST(Run, AFlightBeginsWhenTheAircraftJoinsAndAgainWhenItReturns) {
  Listener* listener = nullptr;
  World world = make_world(1, Time(), 0, listen(&listener));
  world.entities[0].active = {{Time::from_seconds(1), Time::from_seconds(2)},
                              {Time::from_seconds(5), Time::from_seconds(6)}};
  Notes notes;
  ASSERT_TRUE(run_to_end(world, seconds(8), notes).ok());
  ASSERT_EQ(listener->begun.size(), 2u);
  EXPECT_EQ(listener->begun[0].time, Time::from_seconds(1));
  EXPECT_EQ(listener->begun[1].time, Time::from_seconds(5));
  EXPECT_NEAR(listener->begun[1].p_N.x(), 20 * 1.0, 1e-9) << "where it left";
  EXPECT_LT(listener->longest, 1.01) << "nothing is measured over the time between";
}

TEST(Run, ASensorThatFailsSpeaksOfNowWhenItIsBack) {
  Listener* listener = nullptr;
  World world =
      make_world(1, Time(), 0,
                 listen(&listener, {{VehicleFault::Kind::kSensor, 0,
                                     Time::from_seconds(2), Time::from_seconds(4)}}));
  Notes notes;
  ASSERT_TRUE(run_to_end(world, seconds(8), notes).ok());
  EXPECT_NEAR(listener->heard, 82 - 20, 1);
  EXPECT_LT(listener->longest, 0.11) << "not of the whole time of silence";
  EXPECT_EQ(notes.kinds, "joined failure repaired ");
  EXPECT_NE(notes.text.find(" repaired  works again;"), std::string::npos) << notes.text;
}

// Comes nearer and nearer to the first aircraft, and counts how often it is moved.
class Bystander : public MovingObject {
 public:
  void advance(const ObjectView& view) override {
    ++advanced_;
    if (!view.aircraft.empty()) place_ = geo::horizontal(view.aircraft.front());
  }
  Vec2 position() const override { return place_; }
  Vec2 velocity() const override { return {advanced_, 0}; }

 private:
  int advanced_ = 0;
  Vec2 place_ = Vec2::Zero();
};

// Payload that measures a range of its own in every step.
class Beam : public Sensor {
 public:
  explicit Beam(double range) : range_(range) {}
  bool payload() const override { return true; }
  void sample(const SensorView& view, std::vector<SensorSample>& out) override {
    out.emplace_back(RangeSample{view.now, {0, 0, 1}, range_});
  }

 private:
  double range_;
};

TEST(Run, RecordsEachPayloadSampleOnceAndByWhichSensor) {
  World world = make_world(1, Time(), 0, [](std::size_t, VehicleParts& parts) {
    parts.payload.push_back(std::make_unique<Beam>(10));
    parts.payload.push_back(std::make_unique<Beam>(20));
    parts.faults = {
        {VehicleFault::Kind::kPayload, 0, Time::from_seconds(1), Time::from_seconds(2)}};
  });
  world.objects.emplace_back(GroundObject{4, "car", ObjectClass::kVehicle},
                             std::make_unique<Bystander>());
  Notes notes;
  ASSERT_TRUE(run_to_end(world, seconds(3), notes).ok());
  EXPECT_EQ(notes.objects, "car;");
  // It is moved once a step, to where the aircraft is; a motion that changes in every
  // step is recorded as often as everything else.
  ASSERT_EQ(static_cast<int>(notes.motions.size()), notes.truths);
  for (std::size_t i = 1; i < notes.motions.size(); ++i) {
    EXPECT_EQ(notes.motions[i].object, 4u);
    EXPECT_GT(notes.motions[i].position.x(), notes.motions[i - 1].position.x());
  }
  int first = 0, second = 0;
  Time last = Time::from_ns(-1);
  for (const RangeScan& scan : notes.scans) {
    ASSERT_EQ(scan.beams.size(), 1u);
    EXPECT_EQ(scan.beams[0].range, scan.sensor == 0 ? 10 : 20);
    EXPECT_EQ(scan.aircraft, EntityId{0});
    EXPECT_GE(scan.time, last);
    last = scan.time;
    ++(scan.sensor == 0 ? first : second);
  }
  EXPECT_EQ(second, 31) << "one in each step, though the agent thinks every five";
  EXPECT_EQ(first, 31 - 10);
}

TEST(Run, AFailedLinkLosesMessagesInBothDirections) {
  World world = make_world(2, Time(), 0, [](std::size_t i, VehicleParts& parts) {
    if (i == 0)
      parts.faults = {{VehicleFault::Kind::kLink, 0, Time(), Time::from_seconds(100)}};
  });
  Notes notes;
  ASSERT_TRUE(run_to_end(world, seconds(4), notes).ok());
  EXPECT_EQ(notes.kinds.find("heard"), std::string::npos);
  EXPECT_EQ(notes.text.find("heard"), std::string::npos);
  EXPECT_EQ(notes.messages, 2 * 9) << "lost ones are recorded too";
}

TEST(Run, AMotionThatIsNoLongerFiniteEndsThatAircraftOnly) {
  World world = make_world(2, Time(), 0, [](std::size_t i, VehicleParts& parts) {
    if (i == 1) parts.plant = std::make_shared<Glider>(50);
  });
  Notes notes;
  const auto outcome = run_to_end(world, seconds(10), notes);
  ASSERT_TRUE(outcome.ok());
  EXPECT_NE(notes.text.find("1 accident the motion of a1 is no longer finite; before it "
                            "was at 50.0 m north"),
            std::string::npos)
      << notes.text;
  EXPECT_EQ(notes.text.find("0 accident"), std::string::npos);
}

}  // namespace
}  // namespace skein::simulation::simulated_vehicle_test
