// SPDX-License-Identifier: Apache-2.0
#include <csignal>

#include "app/test/program.h"

namespace skein::app {
namespace {

// One aircraft in another process beside a simulated one.
constexpr const char* kMixed =
    "name: mixed\n"
    "duration_s: 34\n"
    "environment: {terrain: flat, wind: {kind: uniform, speed_mps: 0}}\n"
    "aircraft:\n"
    "  - name: far\n"
    "    vehicle: {kind: mavlink, endpoint: 'udpin:0', system: 5}\n"
    "    sensors: [fire]\n"
    "    start: {placement: list, positions_m: [[0, 0]]}\n"
    "    altitude_agl_m: 100\n"
    "    agent: {kind: route, points_m: [[300, 0], [900, 0], [900, 900]], laps: 9}\n"
    "  - {name: near, count: 1}\n";

class MixedProgram : public Program {
 protected:
  // The stand-in for a real aircraft, in the air.
  pid_t start_vehicle(int port) {
    return start({"vehicle", "--aircraft", "point", "--flying", "--system", "5", "--link",
                  "udpout:127.0.0.1:" + std::to_string(port)});
  }

  // Where the run waits for the aircraft.
  int port() {
    const std::string text = "waiting at udpin:127.0.0.1:";
    for (int k = 0; k < 1000; ++k) {
      const std::string said = read_file(folder_ / "err.txt");
      const std::size_t at = said.find(text);
      if (at != std::string::npos && said.find('\n', at) != std::string::npos)
        return std::atoi(said.c_str() + at + text.size());
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    ADD_FAILURE() << "the run does not wait";
    return 0;
  }

  double events(const std::string& kind) {
    return query(folder_ / "first/run.sqlite",
                 "SELECT count(*) FROM events WHERE kind = '" + kind + "'");
  }
};

// The aircraft is flown along its route, killed, and begun anew: the world goes on, each
// is reported once, and what came from outside makes the same run again.
TEST_F(MixedProgram, FliesAnAircraftInAnotherProcessAndReplaysTheRun) {
  const auto scenario = write("mixed.yaml", kMixed);
  const pid_t world = start({"run", scenario.string(), "--out", "first"});
  const int at = port();
  pid_t vehicle = start_vehicle(at);
  std::this_thread::sleep_for(std::chrono::seconds(18));
  kill(vehicle, SIGKILL);
  finish(vehicle);
  std::this_thread::sleep_for(std::chrono::seconds(6));
  vehicle = start_vehicle(at);
  const Finished done = finish(world);
  kill(vehicle, SIGINT);
  EXPECT_EQ(finish(vehicle).status, 0);
  ASSERT_EQ(done.status, 0);

  EXPECT_EQ(events("link-lost"), 1);
  EXPECT_EQ(events("link-up"), 2);
  EXPECT_EQ(events("accident"), 0);
  // It is on the first leg, which leads north from where it began. Telemetry is 0.1 s
  // old, and its own autopilot flies the banks that it is sent.
  const fs::path database = folder_ / "first/run.sqlite";
  EXPECT_GT(query(database,
                  "SELECT count(*) FROM estimates e JOIN entities n USING (entity_id) "
                  "WHERE n.name = 'far-1' AND e.time_s BETWEEN 10 AND 17 AND follows"),
            30);
  EXPECT_LT(query(database,
                  "SELECT max(abs(cross_track_m)) FROM estimates e JOIN entities n USING "
                  "(entity_id) WHERE n.name = 'far-1' AND e.time_s BETWEEN 10 AND 17"),
            10);
  EXPECT_GT(query(database, "SELECT count(*) FROM vehicle_reports WHERE kind = 'motion'"),
            150);

  const Finished again = run({"run", "--replay", "first", "--out", "again"});
  EXPECT_EQ(again.status, 0) << again.err;
  EXPECT_NE(again.err.find("The same content hash"), std::string::npos) << again.err;
}

TEST_F(MixedProgram, RunsInRealTimeOnly) {
  const auto scenario = write("mixed.yaml", kMixed);
  const Finished fast = run({"run", scenario.string(), "--speed", "5"});
  EXPECT_EQ(fast.status, 2);
  EXPECT_NE(fast.err.find("it flies in real time"), std::string::npos) << fast.err;
}

TEST_F(MixedProgram, RefusesAKeyThatOthersCanRead) {
  const auto key = write("key", "passphrase: open to all\n");
  fs::permissions(key, fs::perms::others_read, fs::perm_options::add);
  const Finished refused = run({"vehicle", "--key", key.string(), "--for", "1"});
  EXPECT_NE(refused.status, 0);
  EXPECT_NE(refused.err.find(key.string()), std::string::npos) << refused.err;
}

}  // namespace
}  // namespace skein::app
