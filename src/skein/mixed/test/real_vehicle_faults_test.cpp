// SPDX-License-Identifier: Apache-2.0
// A real vehicle with something wrong, flown by a run: what is said, and where it ends.
#include <gtest/gtest.h>

#include <optional>
#include <random>
#include <string>
#include <vector>

#include "skein/mixed/test/fake_run.h"

namespace skein::mixed::fake {
namespace {

class RealVehicleFaults : public testing::TestWithParam<Make> {
 protected:
  bool ardupilot() const { return GetParam() == Make::kArduPilot; }

  // Flies one with these faults; it never leaves the ground, and one event says why.
  void expect_refused(const Faults& faults, const std::string& why) {
    FakeRun run(GetParam(), faults);
    run.run(70);
    EXPECT_FALSE(run.fake.flew) << run.log_text();
    EXPECT_FALSE(run.fake.armed);
    EXPECT_EQ(run.count(EventKind::kTakeOffDenied, why), 1u) << run.log_text();
    EXPECT_EQ(run.count(EventKind::kTakeOffDenied), 1u) << run.log_text();
    EXPECT_EQ(run.verdict(), "") << run.log_text();
  }
  // The same, and it is not even asked.
  void expect_not_asked(const Faults& faults, const std::string& why) {
    expect_refused(faults, why);
    FakeRun run(GetParam(), faults);
    run.run(40);
    EXPECT_EQ(run.fake.commands[400], 0);
    EXPECT_EQ(run.fake.commands[22], 0);
  }
  void expect_flown(const Faults& faults) {
    FakeRun run(GetParam(), faults);
    run.run(90);
    EXPECT_GT(run.fake.setpoints, 300) << run.log_text();
    EXPECT_GT(run.fake.furthest, 50) << run.log_text();
    EXPECT_NEAR(run.fake.height(), FakeRun::kAltitude, 2) << run.log_text();
    EXPECT_EQ(run.fake.take_offs, 1);
    EXPECT_EQ(run.verdict(), "") << run.log_text();
    EXPECT_EQ(
        run.count(EventKind::kTakeOffDenied) + run.count(EventKind::kRequestDenied) +
            run.count(EventKind::kNotCommandable) + run.count(EventKind::kPositionOld),
        0u)
        << run.log_text();
  }
};

INSTANTIATE_TEST_SUITE_P(Makes, RealVehicleFaults,
                         testing::Values(Make::kArduPilot, Make::kPx4),
                         [](const auto& each) {
                           return each.param == Make::kPx4 ? "px4" : "ardupilot";
                         });

TEST_P(RealVehicleFaults, WithoutAnyIsFlown) {
  expect_flown({});
}

TEST_P(RealVehicleFaults, WithTheTimeOfDayInItsAnswersIsFlown) {
  expect_flown({.time_of_day = true});
  FakeRun run(GetParam(), {.time_of_day = true});
  run.run(60);
  EXPECT_EQ(run.count(EventKind::kOtherClock), 1u) << run.log_text();
}

TEST_P(RealVehicleFaults, WithoutAnswersAboutTimeIsFlown) {
  expect_flown({.no_timesync = true});
}

TEST_P(RealVehicleFaults, WhoseClockIsSetIsFlownOn) {
  for (const double at : {4.0, 15.0, 40.0}) {
    const Faults faults{.clock_jump_at = at, .clock_jump = 3600};
    FakeRun run(GetParam(), faults);
    run.run(100);
    EXPECT_EQ(run.verdict(), "") << run.log_text();
    EXPECT_EQ(run.count(EventKind::kClockSet), 1u) << run.log_text();
    EXPECT_EQ(run.count(EventKind::kPositionOld), 0u) << run.log_text();
    EXPECT_GT(run.fake.setpoints, 200) << run.log_text();
  }
}

TEST_P(RealVehicleFaults, PositionedIndoorsIsFlownByItsEstimator) {
  expect_flown({.no_gps_message = true});
  expect_not_asked({.no_gps_message = true, .no_estimator_message = true},
                   "position: nothing says how good it is");
  expect_not_asked({.no_gps_message = true, .no_fix = true},
                   "position: its estimator has no absolute position");
}

TEST_P(RealVehicleFaults, EachRefusalNamesTheCommandAndTheReason) {
  expect_refused({.refuses = {22}, .refusal = "Takeoff blocked"},
                 "take-off: denied: Takeoff blocked");
  expect_refused({.refuses = {400}, .refusal = "Arm: Hardware safety switch"},
                 "arm: denied: Arm: Hardware safety switch");
  if (!ardupilot()) return;
  expect_refused({.refuses = {176}, .refusal = "Mode change failed"},
                 "mode GUIDED: denied: Mode change failed");
}

TEST_P(RealVehicleFaults, DeafOnesAreReported) {
  expect_refused({.deaf = true}, "not answered in");
}

TEST_P(RealVehicleFaults, AnotherNumberIsReportedOnce) {
  FakeRun run(GetParam(), {.system = 9});
  run.run(60);
  EXPECT_EQ(run.count(EventKind::kWrongVehicle, "system id 9 is heard, 1 is expected"),
            1u)
      << run.log_text();
  EXPECT_FALSE(run.fake.armed);
}

TEST_P(RealVehicleFaults, NobodyThereIsReportedOnce) {
  FakeRun run(GetParam(), {.silent_at = 0, .silent_for = 1000});
  run.run(60);
  EXPECT_EQ(run.count(EventKind::kNotHeard), 1u) << run.log_text();
}

TEST_P(RealVehicleFaults, SomewhereElseIsNotTakenOff) {
  expect_not_asked({.displaced = {111'000, 0, 0}}, "place: it is 11");
  expect_not_asked({.displaced = {0, 800, 0}}, "place: it is 800 m from its start");
  expect_not_asked({.displaced = {0, 0, -250}},
                   "place: its altitude is 250 m above that of its start");
  expect_not_asked({.home_displaced = {4000, 0, 0}}, "home: it is 4000 m away");
  expect_not_asked({.home_displaced = {0, 0, -200}}, "home: it is 200 m above or below");
  expect_not_asked({.no_home = true}, "home: not known");
}

TEST_P(RealVehicleFaults, SomewhereElseInTheAirIsNotCommanded) {
  for (const double north : {20'000.0, 900.0}) {
    const bool far = north > 10'000;
    FakeRun run(GetParam(), {.displaced = {north, 0, 0}});
    run.fake.p_N.z() -= 40;
    run.fake.armed = true;
    run.fake.change_mode(VehicleMode::kHold);
    run.run(60);
    EXPECT_EQ(run.count(EventKind::kWrongPlace, "it is 20.0 km from its start"),
              far ? 1u : 0u)
        << run.log_text();
    EXPECT_EQ(run.fake.commands[176] == 0, far) << run.log_text();
    EXPECT_EQ(run.fake.setpoints == 0, far) << run.log_text();
  }
}

TEST_P(RealVehicleFaults, WhatIsNotReadyIsNotTakenOff) {
  expect_not_asked({.no_fix = true}, "position: it has no 3D fix");
  expect_not_asked({.charge = 0.1}, "energy: its battery has 10 %");
  expect_not_asked({.position_rate = 0.3}, "telemetry: ");
  expect_not_asked({.position_rate = 0}, "telemetry: 0.0 positions");
  expect_not_asked({.late = 2.5}, "link: a round trip takes 5.");
}

TEST_P(RealVehicleFaults, AnotherKindOfVehicleIsNotCommanded) {
  for (const std::uint8_t type : {std::uint8_t{1}, std::uint8_t{10}}) {
    FakeRun run(GetParam(), {.type = type});
    run.run(60);
    EXPECT_EQ(run.count(EventKind::kWrongVehicle), 1u) << run.log_text();
    EXPECT_EQ(run.count(EventKind::kTakeOffDenied), 0u) << run.log_text();
    EXPECT_FALSE(run.fake.armed);
  }
}

TEST_P(RealVehicleFaults, AModeThatIsAcceptedAndNotTakenIsReported) {
  if (ardupilot())
    return expect_refused({.keeps_mode = true},
                          "mode GUIDED: accepted, but it stays in STABILIZE");
  FakeRun run(GetParam(), {.keeps_mode = true});
  run.run(120);
  EXPECT_EQ(run.count(EventKind::kRequestDenied,
                      "mode OFFBOARD: accepted, but it stays in AUTO.LOITER"),
            1u)
      << run.log_text();
  EXPECT_EQ(run.count(EventKind::kNotCommandable), 1u) << run.log_text();
  EXPECT_EQ(run.count(EventKind::kNotBroughtBack), 1u) << run.log_text();
}

TEST_P(RealVehicleFaults, WhatCannotBeCommandedInTheAirIsBroughtBack) {
  const std::vector<Faults> all = {
      {.ignores_setpoints = true},
      {.climb_limit = 12},
      {.position_jump_at = 30, .position_jump = {400, 0, 0}}};
  for (const Faults& faults : all) {
    FakeRun run(GetParam(), faults);
    run.run(150);
    EXPECT_TRUE(run.fake.flew) << run.log_text();
    EXPECT_TRUE(run.fake.on_ground()) << run.log_text();
    EXPECT_FALSE(run.fake.armed) << run.log_text();
    EXPECT_EQ(run.count(EventKind::kNotCommandable), 1u) << run.log_text();
    EXPECT_EQ(run.count(EventKind::kNotBroughtBack), 0u) << run.log_text();
    EXPECT_EQ(run.verdict(), "") << run.log_text();
  }
}

TEST_P(RealVehicleFaults, OneThatIsDeafInTheAirIsAlarmedAbout) {
  FakeRun run(GetParam(), {.deaf_at = 35});
  run.run(150);
  EXPECT_EQ(run.count(EventKind::kNotCommandable), 1u) << run.log_text();
  EXPECT_EQ(run.count(EventKind::kNotBroughtBack, "mode RTL: not answered") +
                run.count(EventKind::kNotBroughtBack, "mode AUTO.RTL: not answered"),
            1u)
      << run.log_text();
}

// A fault at random, and the event that names it: its kind, and a part of its text.
struct Drawn {
  std::string what;
  Faults faults;
  std::optional<EventKind> kind;
  std::string text;
};

class Draw {
 public:
  Draw(Make make, unsigned seed) : ardupilot_(make == Make::kArduPilot), random_(seed) {}

  Drawn operator()() {
    Drawn d;
    Faults& f = d.faults;
    const auto named = [&](std::string what, std::optional<EventKind> kind,
                           std::string text) {
      d.what = std::move(what);
      d.kind = kind;
      d.text = std::move(text);
    };
    switch (std::uniform_int_distribution<int>(0, 23)(random_)) {
      case 0:
        f.late = between(1.5, 4);
        named("late", EventKind::kTakeOffDenied, "link: a round trip");
        break;
      case 1:
        f.late = between(0, 0.4);
        named("a little late", std::nullopt, "");
        break;
      case 2:
        f.time_of_day = true;
        named("time of day", EventKind::kOtherClock, "");
        break;
      case 3:
        f.clock_jump_at = between(3, 90);
        f.clock_jump = between(60, 100'000);
        named("clock set ahead", EventKind::kClockSet, "");
        break;
      case 4:
        f.clock_jump_at = between(3, 90);
        f.clock_jump = -between(5, 30);
        named("clock set back", EventKind::kVehicleRebooted, "");
        break;
      case 5:
        f.displaced.head<2>() = between(600, 200'000) * geo::unit(between(0, 6.28));
        named("far", EventKind::kTakeOffDenied, "place: ");
        break;
      case 6:
        f.displaced.z() = (chance() ? 1 : -1) * between(40, 400);
        named("too high or low", EventKind::kTakeOffDenied, "place: its altitude");
        break;
      case 7:
        f.home_displaced.head<2>() = between(600, 20'000) * geo::unit(between(0, 6.28));
        named("home elsewhere", EventKind::kTakeOffDenied, "home: ");
        break;
      case 8:
        f.no_home = true;
        named("no home", EventKind::kTakeOffDenied, "home: not known");
        break;
      case 9:
        f.deaf = true;
        named("deaf", EventKind::kTakeOffDenied, "not answered");
        break;
      case 10:
        f.deaf_at = between(25, 90);
        named("deaf in the air", EventKind::kNotCommandable, "");
        break;
      case 11:
        f.refuses = {400};
        named("refuses to arm", EventKind::kTakeOffDenied, "arm: denied");
        break;
      case 12:
        f.refuses = {22};
        named("refuses to take off", EventKind::kTakeOffDenied, "take-off: denied");
        break;
      case 13:
        f.refuses = {176};
        named("refuses modes",
              ardupilot_ ? EventKind::kTakeOffDenied : EventKind::kRequestDenied,
              ardupilot_ ? "mode GUIDED: denied" : "mode OFFBOARD: denied");
        break;
      case 14:
        f.keeps_mode = true;
        named("does not take modes",
              ardupilot_ ? EventKind::kTakeOffDenied : EventKind::kRequestDenied,
              "accepted, but it stays in");
        break;
      case 15:
        f.position_jump_at = between(2, 7);
        f.position_jump.head<2>() = between(1000, 9000) * geo::unit(between(0, 6.28));
        named("position jumps on the ground", EventKind::kPositionJumped, "");
        break;
      case 16:
        f.position_jump_at = between(30, 90);
        f.position_jump.head<2>() = between(150, 9000) * geo::unit(between(0, 6.28));
        named("position jumps in the air", EventKind::kPositionJumped, "");
        break;
      case 17:
        f.silent_at = between(3, 90);
        f.silent_for = between(4.5, 30);
        named("silent for a time", EventKind::kLinkLost, "");
        break;
      case 18:
        f.silent_at = 0;
        f.silent_for = 1000;
        named("never heard", EventKind::kNotHeard, "");
        break;
      case 19:
        f.system = static_cast<std::uint8_t>(between(2, 200));
        named("another number", EventKind::kWrongVehicle, "is expected");
        break;
      case 20:
        f.position_rate = between(0, 0.4);
        named("few positions", EventKind::kTakeOffDenied, "telemetry: ");
        break;
      case 21:
        f.no_fix = true;
        named("no fix", EventKind::kTakeOffDenied, "position: ");
        break;
      case 22:
        f.ignores_setpoints = true;
        named("ignores setpoints", EventKind::kNotCommandable, "setpoints");
        break;
      default:
        f.climb_limit = between(3, 20);
        named("does not climb", EventKind::kNotCommandable, "climbing");
        break;
    }
    return d;
  }

 private:
  double between(double least, double greatest) {
    return std::uniform_real_distribution<double>(least, greatest)(random_);
  }
  bool chance() { return between(0, 1) < 0.5; }

  bool ardupilot_;
  std::mt19937 random_;
};

// 100 of each make: none is left alone in the air or led away, each fault is named once.
TEST_P(RealVehicleFaults, AtRandomLeaveNoneAloneAndAreNamedOnce) {
  for (unsigned seed = 1; seed <= 100; ++seed) {
    const Drawn drawn = Draw(GetParam(), seed)();
    FakeRun run(GetParam(), drawn.faults);
    run.run(180);
    SCOPED_TRACE(drawn.what + ", seed " + std::to_string(seed) + "\n" + run.log_text());
    EXPECT_EQ(run.verdict(), "");
    if (drawn.kind) {
      EXPECT_EQ(run.count(*drawn.kind, drawn.text), 1u);
    }
    for (const EventKind kind : {EventKind::kTakeOffDenied, EventKind::kRequestDenied,
                                 EventKind::kNotCommandable, EventKind::kNotBroughtBack,
                                 EventKind::kWrongVehicle, EventKind::kWrongPlace})
      EXPECT_LE(run.count(kind), 1u) << row_of(kind).name;
  }
}

}  // namespace
}  // namespace skein::mixed::fake
