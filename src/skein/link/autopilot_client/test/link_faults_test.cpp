// SPDX-License-Identifier: Apache-2.0
// What goes wrong between a vehicle and the near end of its link: each is reported once,
// and afterwards all works again without anybody beginning anew.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "skein/link/autopilot_client/test/flight.h"

namespace skein::autopilot_client::link_faults_test {
namespace {

using Kind = LinkChange::Kind;

constexpr Identity kWing{Make::kArduPilot, false};
const BankSetpoint kBank{0.2, 480, 0, 20};

// In guided flight at the far end of a good line.
class LinkFaults : public testing::Test {
 protected:
  void SetUp() override {
    f.paper.snapshot = vehicle_services::flying();
    ASSERT_TRUE(f.wait(20, [&] { return f.changes[Kind::kUp] == 1; }));
    f.wait(10, [] { return false; });
    ASSERT_TRUE(is_well());
  }

  // Telemetry is young, requests are answered, setpoints arrive.
  bool is_well() {
    f.oldest = 0;
    const Time before = f.seen.time;
    const int banks = f.paper.obeyed["bank"];
    f.steer(kBank, 5);
    return f.request(SpeedRequest{22}) == Outcome::kAccepted &&
           f.seen.time > before + Time::from_seconds(4) && f.oldest < 0.5 &&
           f.paper.obeyed["bank"] > banks + 20;
  }

  void expect_changes(int up, int down, int rebooted, int duplicate) {
    EXPECT_EQ(f.changes[Kind::kUp], up);
    EXPECT_EQ(f.changes[Kind::kDown], down);
    EXPECT_EQ(f.changes[Kind::kRebooted], rebooted);
    EXPECT_EQ(f.changes[Kind::kDuplicate], duplicate);
    EXPECT_EQ(f.changes[Kind::kMismatch], 0);
  }

  Flight f{kWing, {0.02, 0.02, 0.02, 0.02}, 5};
};

TEST_F(LinkFaults, ACablePulledAndPutBack) {
  int times = 0;
  for (const double seconds : {5, 30, 300}) {
    f.line.set_trouble({1, 0, 0, 0});
    // Whoever goes on asking is told that nobody answers, at once.
    f.wait(4, [] { return false; });
    EXPECT_EQ(f.request(ModeRequest{VehicleMode::kGuided}), Outcome::kNoAnswer);
    f.wait(seconds - 4, [] { return false; });
    f.line.set_trouble({0.02, 0.02, 0.02, 0.02});
    ++times;
    ASSERT_TRUE(f.wait(10, [&] { return f.changes[Kind::kUp] == times + 1; })) << seconds;
    EXPECT_TRUE(is_well()) << seconds;
    expect_changes(times + 1, times, 0, 0);
  }
}

TEST_F(LinkFaults, AnAutopilotThatRebootsInFlight) {
  for (int times = 1; times <= 2; ++times) {
    f.reboot();
    ASSERT_TRUE(f.wait(10, [&] { return f.changes[Kind::kRebooted] == times; }));
    // The new one knows no rates and gave no home: it is set up as if it were new.
    f.wait(8, [] { return false; });
    EXPECT_TRUE(is_well());
    expect_changes(1, 0, times, 0);
  }
}

TEST_F(LinkFaults, AnAutopilotThatIsGoneForAWhileAndComesBackRebooted) {
  f.line.set_trouble({1, 0, 0, 0});
  f.wait(20, [] { return false; });
  f.line.set_trouble({});
  f.reboot();
  ASSERT_TRUE(f.wait(10, [&] { return f.changes[Kind::kUp] == 2; }));
  f.wait(8, [] { return false; });
  EXPECT_TRUE(is_well());
  expect_changes(2, 1, 1, 0);
}

// Its clock is set right: telemetry is given the right time again within seconds, and
// nobody takes it for another vehicle.
TEST_F(LinkFaults, AClockThatJumpsAhead) {
  f.jump(Time::from_seconds(3600));
  f.wait(12, [] { return false; });
  EXPECT_TRUE(is_well());
  expect_changes(1, 0, 0, 0);
}

TEST_F(LinkFaults, AnotherVehicleOfItsNumberBehindTheSameRadio) {
  f.jump(Time::from_seconds(500));
  f.wait(3, [] { return false; });
  f.add_double(1);
  f.wait(20, [] { return false; });
  EXPECT_EQ(f.changes[Kind::kDuplicate], 1);
  EXPECT_EQ(f.request(SpeedRequest{25}), Outcome::kDenied) << "both would obey";
  f.remove_double();
  f.wait(15, [] { return false; });
  EXPECT_TRUE(is_well());
}

TEST_F(LinkFaults, TwoBoardsThatAnswerInTurn) {
  mavlink::AutopilotVersion version;
  for (int k = 0; k < 6; ++k) {
    version.uid = k % 2 == 0 ? 11 : 12;
    f.line.vehicle.send(1, version);
    f.wait(1, [] { return false; });
  }
  EXPECT_EQ(f.changes[Kind::kDuplicate], 1);
  EXPECT_EQ(f.changes[Kind::kMismatch], 2) << "once for each that is not its own";
  EXPECT_EQ(f.request(SpeedRequest{25}), Outcome::kDenied) << "both would obey";
  f.wait(30, [] { return false; });
  EXPECT_TRUE(is_well());
}

TEST_F(LinkFaults, OneVehicleThatIsHeardByTwoLinks) {
  f.add_second_link();
  f.wait(30, [] { return false; });
  EXPECT_TRUE(is_well());
  expect_changes(1, 0, 0, 0);
  f.reboot();
  f.wait(30, [] { return false; });
  EXPECT_TRUE(is_well());
  expect_changes(1, 0, 1, 0);
}

TEST_F(LinkFaults, NumbersThatAreNoneAreNoTelemetry) {
  mavlink::Attitude attitude;
  attitude.roll = std::numeric_limits<float>::quiet_NaN();
  mavlink::VfrHud hud;
  hud.airspeed = std::numeric_limits<float>::infinity();
  mavlink::GlobalPositionInt place;
  place.lat = 1'500'000'000;  // beyond the pole
  for (int k = 0; k < 50; ++k) {
    place.time_boot_ms = static_cast<std::uint32_t>(f.line.now.ns() / 1'000'000);
    f.line.vehicle.send(1, place);
    f.line.vehicle.send(1, attitude);
    f.line.vehicle.send(1, hud);
    f.wait(0.02, [] { return false; });
    ASSERT_TRUE(f.seen.p_N.allFinite());
  }
  EXPECT_TRUE(f.seen.q_NB.coeffs().allFinite());
  EXPECT_TRUE(std::isfinite(f.seen.airspeed));
  EXPECT_TRUE(is_well());
}

TEST_F(LinkFaults, AnotherVehicleOfItsNumber) {
  f.add_double();
  f.wait(20, [] { return false; });
  EXPECT_TRUE(is_well()) << "the first one counts";
  expect_changes(1, 0, 0, 1);
  EXPECT_LT(f.seen.p_N.x(), 1000) << "not the other's place";
}

}  // namespace
}  // namespace skein::autopilot_client::link_faults_test
