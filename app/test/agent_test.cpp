// SPDX-License-Identifier: Apache-2.0
// A world and an agent of it in another program, as users start them.
#include <csignal>

#include "app/test/null_modem.h"
#include "app/test/program.h"

namespace skein::app {
namespace {

// The fire is under the aircraft, so that their sensors have something to say.
constexpr const char* kPair =
    "name: pair\n"
    "duration_s: 120\n"
    "environment:\n"
    "  wind: {kind: uniform, speed_mps: 3, from_deg: 270}\n"
    "  phenomena: [{kind: front, ignitions: [{point_m: [0, 0], radius_m: 400}]}]\n"
    "aircraft:\n"
    "  - {name: far, start: {placement: list, positions_m: [[0, 100]]},\n"
    "     vehicle: {kind: remote, listen: 'udpin:0'}}\n"
    "  - {name: near, start: {placement: list, positions_m: [[0, -100]]}}\n"
    "commands:\n"
    "  - {at_s: 4, do: 'task far-1 fly_to 800,0'}\n";

class Agents : public Program {
 protected:
  // Starts the world; at the port that it had before, if it had one.
  pid_t start_world(const std::string& out, std::vector<std::string> more = {}) {
    const auto scenario = write("pair.yaml", kPair);
    prefix_ = "world-";
    fs::remove(folder_ / "world-err.txt");
    std::vector<std::string> arguments = {
        "run",   scenario.string(),
        "--out", out,
        "--set", "aircraft[0].vehicle.listen='udpin:" + std::to_string(port_) + "'"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const pid_t world = start(arguments);
    for (int k = 0; k < 1000; ++k) {
      const std::string said = read_file(folder_ / "world-err.txt");
      const std::string place = "waiting at udpin:127.0.0.1:";
      const std::size_t at = said.find(place);
      if (at != std::string::npos && said.find('\n', at) != std::string::npos) {
        port_ = std::atoi(said.c_str() + at + place.size());
        return world;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    ADD_FAILURE() << "the world says no place: " << read_file(folder_ / "world-err.txt");
    return world;
  }
  pid_t start_agent(std::vector<std::string> more = {}) {
    prefix_ = "agent-";
    std::vector<std::string> arguments = {
        "agent", "pair.yaml", "--entity",
        "far-1", "--world",   "udpout:127.0.0.1:" + std::to_string(port_)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return start(arguments);
  }
  Finished stop(pid_t program, const std::string& prefix) {
    kill(program, SIGINT);
    prefix_ = prefix;
    return finish(program);
  }
  void kill_at_once(pid_t program) {
    kill(program, SIGKILL);
    waitpid(program, nullptr, 0);
  }

  // The number that a query of a running program's records gives, once it is as many.
  bool comes_to(const std::string& run, const std::string& sql, double count,
                int seconds = 40) {
    const fs::path database = folder_ / run / "run.sqlite";
    for (int k = 0; k < 10 * seconds; ++k) {
      if (fs::exists(database) && query(database, sql) >= count) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    return false;
  }
  static std::string events(const std::string& kind) {
    return "SELECT count(*) FROM events WHERE kind = '" + kind + "'";
  }

  int port_ = 0;
};

TEST_F(Agents, AreOrderedReportAndReplay) {
  const pid_t world = start_world("world");
  const pid_t agent = start_agent();
  // Its readings are of the world's fire, its reports say that the order has come.
  EXPECT_TRUE(comes_to("world", "SELECT count(*) FROM readings WHERE entity_id = 1", 3));
  EXPECT_TRUE(comes_to("world",
                       "SELECT count(*) FROM messages WHERE from_id = 1 AND lost = 0 AND "
                       "content_kind = 'report'",
                       3));
  // It flies north, where it is told to.
  EXPECT_TRUE(
      comes_to("world", "SELECT max(north_m) FROM truth WHERE entity_id = 1", 250, 25))
      << query(folder_ / "world/run.sqlite",
               "SELECT max(north_m) FROM truth WHERE entity_id = 1");
  EXPECT_EQ(query(folder_ / "world/run.sqlite", events("link-up")), 1);
  EXPECT_EQ(stop(agent, "agent-").status, 0) << read_file(folder_ / "agent-err.txt");
  EXPECT_TRUE(comes_to("world", events("link-lost"), 1));
  EXPECT_EQ(stop(world, "world-").status, 130);
  const Finished again = run({"run", "--replay", "world", "--out", "again"});
  EXPECT_EQ(again.status, 0) << again.err;
  EXPECT_NE(again.err.find("The same content hash"), std::string::npos) << again.err;
}

TEST_F(Agents, MayBeKilledAndComeBack) {
  const pid_t world = start_world("world");
  pid_t agent = start_agent();
  ASSERT_TRUE(comes_to("world", events("link-up"), 1));
  kill_at_once(agent);
  ASSERT_TRUE(comes_to("world", events("link-lost"), 1));
  // The world goes on without it.
  const fs::path database = folder_ / "world/run.sqlite";
  const std::string steps = "SELECT count(*) FROM truth WHERE entity_id = 2";
  EXPECT_TRUE(comes_to("world", steps, query(database, steps) + 20));
  agent = start_agent();
  ASSERT_TRUE(comes_to("world", events("link-up"), 2));
  EXPECT_TRUE(comes_to("world",
                       "SELECT count(*) FROM messages WHERE from_id = 1 AND lost = 0 AND "
                       "sent_s > (SELECT max(time_s) FROM events WHERE kind = 'link-up')",
                       2))
      << "it speaks again";
  EXPECT_EQ(query(database, events("link-lost")), 1) << "said once";
  EXPECT_EQ(stop(agent, "agent-").status, 0);
  EXPECT_EQ(stop(world, "world-").status, 130);
  const Finished again = run({"run", "--replay", "world", "--out", "again"});
  EXPECT_EQ(again.status, 0) << again.err;
}

TEST_F(Agents, GoOnAloneAndJoinTheNextWorld) {
  pid_t world = start_world("first");
  const pid_t agent = start_agent({"--out", "agent"});
  ASSERT_TRUE(comes_to("agent", events("world-joined"), 1));
  kill_at_once(world);
  ASSERT_TRUE(comes_to("agent", events("world-lost"), 1));
  const fs::path database = folder_ / "agent/run.sqlite";
  const std::string steps = "SELECT count(*) FROM truth WHERE entity_id = 1";
  EXPECT_TRUE(comes_to("agent", steps, query(database, steps) + 20)) << "it flies on";
  world = start_world("second");
  EXPECT_TRUE(comes_to("agent", events("world-back"), 1));
  EXPECT_TRUE(comes_to("second", events("link-up"), 1));
  EXPECT_TRUE(comes_to("second", "SELECT count(*) FROM truth WHERE entity_id = 1", 10))
      << "the new world knows where it is";
  EXPECT_EQ(query(database, events("world-lost")), 1) << "said once";
  EXPECT_EQ(stop(agent, "agent-").status, 130);
  EXPECT_EQ(stop(world, "world-").status, 130);
}

// A world whose aircraft far-1 has a modem of its own.
class ModemAgents : public Agents {
 protected:
  // Starts the world, with a modem at any free port.
  pid_t start_modem_world(const std::string& out, const std::string& more,
                          const std::string& of_radio = "") {
    const pid_t world =
        start_world(out, {"--set", "stations=[{heartbeat_s: 1}]", "--set",
                          "radio={kind: medium, profile: wifi-dsss-2, modem: {endpoint: "
                          "'udpin:0', entities: [far-1]" +
                              more + "}" + of_radio + "}"});
    const std::string place = "waiting at udpin:127.0.0.1:";
    for (int k = 0; k < 1000 && modem_port_ == 0; ++k) {
      const std::string said = read_file(folder_ / "world-err.txt");
      const std::size_t at = said.rfind(place);
      if (at != said.find(place) && said.find('\n', at) != std::string::npos)
        modem_port_ = std::atoi(said.c_str() + at + place.size());
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    EXPECT_NE(modem_port_, 0) << "its modem's place comes after that of its agents";
    return world;
  }
  pid_t start_modem_agent(const std::vector<std::string>& more = {}) {
    std::vector<std::string> all = {"--modem",
                                    "udpout:127.0.0.1:" + std::to_string(modem_port_)};
    all.insert(all.end(), more.begin(), more.end());
    return start_agent(all);
  }
  double figure(const std::string& run, const std::string& name) {
    return nlohmann::json::parse(read_file(folder_ / run / "summary.json"))[name];
  }

  // By the ground station's modem; what the agent's own one hears is said too.
  static std::string by_modem(const std::string& kind) {
    return events(kind) + " AND text LIKE 'by the modem%'";
  }

  int modem_port_ = 0;
};

TEST_F(ModemAgents, AreReachedAndReplayed) {
  const pid_t world = start_modem_world("world", ", inject: true, rate_bps: 50000");
  pid_t agent = start_modem_agent();
  ASSERT_TRUE(comes_to("world", by_modem("neighbour-found"), 1));
  // Its reports are on the air of the medium, the order goes to it by the modem.
  EXPECT_TRUE(comes_to("world",
                       "SELECT count(*) FROM messages WHERE from_id = 1 AND lost = 0 AND "
                       "transmissions > 0",
                       3));
  EXPECT_TRUE(
      comes_to("world", "SELECT max(north_m) FROM truth WHERE entity_id = 1", 200, 25));
  // It is gone, and comes back.
  kill_at_once(agent);
  ASSERT_TRUE(comes_to("world", by_modem("neighbour-lost"), 1));
  agent = start_modem_agent();
  ASSERT_TRUE(comes_to("world", by_modem("neighbour-found"), 2));
  EXPECT_TRUE(comes_to("world",
                       "SELECT count(*) FROM messages WHERE to_id = 1 AND lost = 0 AND "
                       "sent_s > (SELECT max(time_s) FROM events WHERE kind = "
                       "'neighbour-found' AND text LIKE 'by the modem%')",
                       1))
      << "it is reached again";
  EXPECT_EQ(stop(agent, "agent-").status, 0) << read_file(folder_ / "agent-err.txt");
  EXPECT_EQ(stop(world, "world-").status, 130);
  EXPECT_GT(figure("world", "modem_sent"), 10) << "advertisements among them";
  EXPECT_GT(figure("world", "modem_heard"), 10);
  EXPECT_GT(figure("world", "modem_injected"), 0);
  const Finished again = run({"run", "--replay", "world", "--out", "again"});
  EXPECT_EQ(again.status, 0) << again.err;
  EXPECT_NE(again.err.find("The same content hash"), std::string::npos) << again.err;
}

TEST_F(ModemAgents, AreHeardByRangeAloneWhereTheMediumDoesNotHearThem) {
  const pid_t world = start_modem_world("world", ", receive: false");
  const pid_t agent = start_modem_agent();
  EXPECT_TRUE(comes_to("world",
                       "SELECT count(*) FROM messages WHERE from_id = 1 AND lost = 0 AND "
                       "transmissions = 0",
                       3));
  EXPECT_EQ(stop(agent, "agent-").status, 0);
  EXPECT_EQ(stop(world, "world-").status, 130);
  EXPECT_EQ(
      query(folder_ / "world/run.sqlite",
            "SELECT count(*) FROM messages WHERE from_id = 1 AND transmissions > 0"),
      0);
}

TEST_F(ModemAgents, AreWhereTheGroundStationIsWhenItGivesItsAddress) {
  const pid_t world = start_modem_world("world", ", gateway: altering");
  const pid_t agent = start_modem_agent();
  ASSERT_TRUE(comes_to("world", by_modem("neighbour-found"), 1));
  // What it says to the station has come by the modem alone; the other aircraft hears it
  // from the station. The order needs no medium.
  EXPECT_TRUE(comes_to("world",
                       "SELECT count(*) FROM messages WHERE from_id = 1 AND to_id = 0 "
                       "AND lost = 0 AND transmissions = 0",
                       3));
  EXPECT_TRUE(
      comes_to("world", "SELECT max(north_m) FROM truth WHERE entity_id = 1", 200, 25));
  EXPECT_EQ(stop(agent, "agent-").status, 0) << read_file(folder_ / "agent-err.txt");
  EXPECT_EQ(stop(world, "world-").status, 130);
  const fs::path database = folder_ / "world/run.sqlite";
  EXPECT_EQ(query(database, "SELECT sum(frames) FROM radios WHERE entity_id = 1"), 0);
  EXPECT_GT(query(database, "SELECT sum(frames) FROM radios WHERE entity_id = 0"), 3);
  const Finished again = run({"run", "--replay", "world", "--out", "again"});
  EXPECT_EQ(again.status, 0) << again.err;
  EXPECT_NE(again.err.find("The same content hash"), std::string::npos) << again.err;
}

TEST_F(ModemAgents, AreReachedOverSerialLinesThatLoseBytes) {
  NullModem line;
  if (line.name(1).empty()) GTEST_SKIP() << "this machine has no pseudo-terminals";
  line.spoil_each(700);
  const pid_t world = start_world(
      "world", {"--set", "stations=[{heartbeat_s: 1}]", "--set",
                "radio={kind: medium, profile: n920, modem: {endpoint: 'serial:" +
                    line.name(0) + ":57600', entities: [far-1], rate_bps: 40000}}"});
  const pid_t agent = start_agent({"--modem", "serial:" + line.name(1) + ":57600"});
  ASSERT_TRUE(comes_to("world", by_modem("neighbour-found"), 1));
  EXPECT_TRUE(
      comes_to("world", "SELECT max(north_m) FROM truth WHERE entity_id = 1", 200, 30))
      << "its order came by the line";
  EXPECT_EQ(stop(agent, "agent-").status, 0) << read_file(folder_ / "agent-err.txt");
  EXPECT_EQ(stop(world, "world-").status, 130);
  EXPECT_GT(figure("world", "modem_damaged"), 0);
  EXPECT_GT(figure("world", "modem_heard"), 10);
}

TEST_F(ModemAgents, AreHeardByTheirKeyWhereMessagesAreAuthenticated) {
  for (const char* name : {"team.key", "other.key"}) {
    const fs::path key = write(name, std::string(32, name[0]));
    fs::permissions(key, fs::perms::owner_read | fs::perms::owner_write);
  }
  const pid_t world =
      start_modem_world("world", "", ", authentication: {key_file: team.key}");
  for (const char* key : {"", "other.key"}) {
    const pid_t agent =
        start_modem_agent(*key ? std::vector<std::string>{"--key", key, "--for", "3"}
                               : std::vector<std::string>{"--for", "3"});
    prefix_ = "agent-";
    EXPECT_EQ(finish(agent).status, 0);
    EXPECT_EQ(query(folder_ / "world/run.sqlite", by_modem("neighbour-found")), 0);
  }
  const pid_t agent = start_modem_agent({"--key", "team.key"});
  EXPECT_TRUE(comes_to("world", by_modem("neighbour-found"), 1));
  EXPECT_TRUE(comes_to(
      "world", "SELECT count(*) FROM messages WHERE from_id = 1 AND lost = 0", 3));
  EXPECT_EQ(stop(agent, "agent-").status, 0);
  EXPECT_EQ(stop(world, "world-").status, 130);
  EXPECT_GT(figure("world", "modem_unauthentic"), 5) << "their advertisements";
  EXPECT_EQ(query(folder_ / "world/run.sqlite",
                  "SELECT entity_id FROM events WHERE kind = 'modem-refused'"),
            1)
      << "at most once a minute";
}

TEST_F(Agents, SayWhatIsWrong) {
  write("pair.yaml", kPair);
  prefix_ = "agent-";
  const Finished nobody = run({"agent", "pair.yaml", "--entity", "far-7"});
  EXPECT_EQ(nobody.status, 2);
  EXPECT_NE(nobody.err.find("it has: far-1, near-1"), std::string::npos) << nobody.err;
  const Finished nowhere =
      run({"agent", "pair.yaml", "--entity", "far-1", "--world", "udpout:14"});
  EXPECT_EQ(nowhere.status, 2);
  const Finished serial = run({"agent", "pair.yaml", "--entity", "far-1", "--world",
                               "serial:/dev/ttyS0", "--for", "1"});
  EXPECT_EQ(serial.status, 2);
  EXPECT_NE(serial.err.find("UDP or TCP only"), std::string::npos) << serial.err;
  EXPECT_EQ(run({"agent", "pair.yaml", "--entity", "far-1", "--for", "1"}).status, 0)
      << "it may be alone";
}

}  // namespace
}  // namespace skein::app
