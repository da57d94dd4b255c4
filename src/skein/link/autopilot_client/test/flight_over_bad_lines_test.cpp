// A whole flight as the near end of a link commands it, over lines from good to hardly
// usable.
#include <gtest/gtest.h>

#include "skein/link/autopilot_client/autopilot_client.h"
#include "skein/link/vehicle_services/test/bad_line.h"
#include "skein/link/vehicle_services/test/paper_vehicle.h"
#include "skein/link/vehicle_services/test/station.h"

namespace skein::autopilot_client {
namespace {

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

class Flight {
 public:
  Flight(const Identity& identity, const Trouble& trouble, unsigned seed)
      : server_(vehicle_services::test_options(identity.make, identity.hovers), frame_),
        client_({.system = 7, .hovers = identity.hovers}, frame_),
        line(trouble, seed) {
    line.at_vehicle = [this](const mavlink::Frame& heard) {
      server_.receive(heard, 1, clocks(), line.vehicle);
    };
    line.at_station = [this](const mavlink::Frame& heard) {
      client_.receive(heard, 1, line.now, line.station);
    };
    server_.open(1, clocks());
    client_.open(1);
  }

  template <class Until>
  bool wait(double seconds, Until until) {
    const Time end = line.now + Time::from_seconds(seconds);
    while (!until() && line.now < end) step();
    return until();
  }

  /// As a director does: asks again while there is no answer.
  Outcome request(const VehicleRequest& what) {
    for (int tries = 0; tries < 4; ++tries) {
      const std::uint32_t number = ++asked_;
      answer_.reset();
      client_.request(number, what, line.now, line.station);
      wait(60, [&] { return answer_ && answer_->number == number; });
      if (answer_ && answer_->outcome != Outcome::kNoAnswer) return answer_->outcome;
    }
    return Outcome::kNoAnswer;
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
  vehicle_services::Clocks clocks() const { return {line.now, line.now}; }

  void step() {
    line.step();
    if (++steps_ % 2 != 0) return;
    paper.step(0.02);
    paper.snapshot.motion.time = line.now;
    server_.update(paper.snapshot);
    server_.step(clocks(), line.vehicle);
    for (const VehicleRequest& request : server_.take_requests()) paper.obey(request);
    client_.step(line.now, line.station);
    for (VehicleReport& report : client_.take_reports()) take(report);
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
  VehicleServer server_;
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

MissionUpload square(double altitude_msl) {
  MissionUpload upload;
  for (const auto& [north, east] : {std::pair(300, 0), {300, 300}, {0, 300}, {0, 0}}) {
    MissionItem item;
    item.p_N = {double(north), double(east), -altitude_msl};
    upload.items.push_back(item);
  }
  return upload;
}

void fly(const Identity& identity, const Trouble& trouble, unsigned seed) {
  Flight f(identity, trouble, seed);
  ASSERT_TRUE(f.wait(20, [&] { return f.changes[LinkChange::Kind::kUp] == 1; }));
  const double ground = f.paper.snapshot.ground_msl;

  ASSERT_EQ(f.request(ModeRequest{VehicleMode::kGuided}), Outcome::kAccepted);
  ASSERT_EQ(f.request(ArmRequest{true, false}), Outcome::kAccepted);
  ASSERT_EQ(f.request(TakeOffRequest{ground + 60, 0.0}), Outcome::kAccepted);
  ASSERT_TRUE(f.wait(30, [&] { return -f.seen.p_N.z() > ground + 55; }));
  ASSERT_EQ(f.request(ModeRequest{VehicleMode::kGuided}), Outcome::kAccepted);

  const Vec3 place(400, -200, -ground - 80);
  f.steer(TrackSetpoint{place, Vec3::Zero(), Vec3::Zero(), 0.0}, 5);
  f.steer(BankSetpoint{0.2, ground + 80, 0, 20}, 5);
  EXPECT_GT(f.paper.obeyed["track"] + f.paper.obeyed["bank"], 20);

  ASSERT_EQ(f.request(square(ground + 60)), Outcome::kAccepted);
  ASSERT_EQ(f.paper.mission.size(), 4u);
  EXPECT_NEAR(f.paper.mission[1].p_N.y(), 300, 0.1);
  ASSERT_EQ(f.request(MissionStart{0}), Outcome::kAccepted);
  EXPECT_TRUE(f.wait(200, [&] { return f.finished; })) << "its progress is told";

  ASSERT_EQ(f.request(ModeRequest{VehicleMode::kLand}), Outcome::kAccepted);
  EXPECT_TRUE(f.wait(60, [&] { return f.told.on_ground && !f.told.armed; }));
  EXPECT_EQ(f.changes[LinkChange::Kind::kUp], 1);
  EXPECT_EQ(f.changes[LinkChange::Kind::kRebooted], 0);
  EXPECT_EQ(f.changes[LinkChange::Kind::kDuplicate], 0);
  EXPECT_EQ(f.changes[LinkChange::Kind::kMismatch], 0);
  EXPECT_LT(f.oldest, 2 * (trouble.delay + trouble.jitter) + 0.2)
      << "telemetry is given the time when it was true";
}

TEST(AutopilotClient, FliesEveryVehicleOverEveryLine) {
  unsigned seed = 1;
  for (const Identity& identity :
       {Identity{Make::kArduPilot, false}, Identity{Make::kArduPilot, true},
        Identity{Make::kPx4, false}, Identity{Make::kPx4, true}})
    for (const Trouble& trouble : vehicle_services::troubles()) {
      SCOPED_TRACE(testing::Message()
                   << (identity.make == Make::kPx4 ? "PX4" : "ArduPilot")
                   << (identity.hovers ? ", hovers" : ", wing") << ", loss "
                   << trouble.loss << ", delay " << trouble.delay);
      fly(identity, trouble, seed++);
      if (testing::Test::HasFatalFailure()) return;
    }
}

}  // namespace
}  // namespace skein::autopilot_client
