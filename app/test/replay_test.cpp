// SPDX-License-Identifier: Apache-2.0
#include "app/test/program.h"

namespace skein::app {
namespace {

// Wind, turbulence, a lossy radio, aircraft with six degrees of freedom beside points,
// and commands of every kind that a scenario can give.
constexpr const char* kEventful =
    "name: eventful\n"
    "duration_s: 150\n"
    "environment:\n"
    "  wind: {kind: uniform, speed_mps: 4, from_deg: 250}\n"
    "  turbulence: {kind: dryden, intensity: light}\n"
    "  zones: [{name: field, centre_m: [400, 300], radius_m: 80, active: false,\n"
    "           switches: [{at_s: 70, on: true}]}]\n"
    "radio: {kind: ideal, loss: 0.05, delay_s: 0.1}\n"
    "aircraft:\n"
    "  - {name: wing, count: 1, plant: fixed-wing, autopilot: skein, sensors: [flight, "
    "fire]}\n"
    "  - {name: point, count: 2}\n"
    "commands:\n"
    "  - {at_s: 20, do: 'task point-1 fly_to 300.125,-200.375'}\n"
    "  - {at_s: 35, do: 'task wing-1 course 33.3'}\n"
    "  - {at_s: 40, do: 'wind 2.5 133.7'}\n"
    "  - {at_s: 50, do: 'fault point-2 link'}\n"
    "  - {at_s: 60, do: 'repair point-2 link'}\n"
    "  - {at_s: 80, do: 'mission pause'}\n"
    "  - {at_s: 90, do: 'mission resume'}\n"
    "  - {at_s: 100, do: 'remove point-2'}\n"
    "  - {at_s: 120, do: 'add point-2'}\n";

TEST_F(Program, ARunIsDoneAgainWithItsCommandsAndEndsWithTheSameHash) {
  const auto scenario = write("eventful.yaml", kEventful);
  const Finished first = run({"run", scenario.string(), "--out", "first"});
  ASSERT_EQ(first.status, 0) << first.err;
  for (const char* threads : {"1", "3"}) {
    const std::string out = std::string("again-") + threads;
    const Finished again =
        run({"run", "--replay", "first", "--out", out, "--threads", threads});
    EXPECT_EQ(again.status, 0) << again.err;
    EXPECT_NE(again.err.find("The same content hash"), std::string::npos) << again.err;
  }
}

TEST_F(Program, CommandsOfAnOperatorAreGivenAgain) {
  const auto scenario = write("eventful.yaml", kEventful);
  input_ =
      write("words.txt",
            "task point-1 course 12.345\npause\nstep 3\nwind 3 77\nresume\nspeed 5000\n"
            "zone on a circle 10,20 30\nnonsense\n");
  const Finished first = run({"run", scenario.string(), "--out", "first", "--commands"});
  ASSERT_EQ(first.status, 0) << first.err;
  EXPECT_NE(first.err.find("this is no command"), std::string::npos);
  const Finished again = run({"run", "--replay", "first", "--out", "again"});
  EXPECT_EQ(again.status, 0) << again.err;
  const Finished plain = run({"run", scenario.string(), "--out", "plain"});
  EXPECT_NE(
      nlohmann::json::parse(read_file(folder_ / "plain/summary.json"))["content_hash"],
      nlohmann::json::parse(read_file(folder_ / "first/summary.json"))["content_hash"])
      << "the operator's words count";
}

TEST_F(Program, AReplayThatDiffersSaysSo) {
  const auto scenario = write("eventful.yaml", kEventful);
  ASSERT_EQ(run({"run", scenario.string(), "--out", "first"}).status, 0);
  const Finished other =
      run({"run", "--replay", "first", "--out", "other", "--seed", "99"});
  EXPECT_EQ(other.status, 1);
  EXPECT_NE(other.err.find("Not the same content hash"), std::string::npos) << other.err;
  EXPECT_EQ(run({"run", "--replay", "nothing"}).status, 2);
  EXPECT_EQ(run({"run"}).status, 2);
}

}  // namespace
}  // namespace skein::app
