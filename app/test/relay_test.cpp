// SPDX-License-Identifier: Apache-2.0
// A bad connection between programs, as users start it.
#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/stat.h>

#include <csignal>
#include <cstdint>
#include <sstream>

#include "app/test/program.h"

namespace skein::app {
namespace {

class Relays : public Program {
 protected:
  Relays() {
    // Orders come by a pipe with a name; open both ways, so that nobody waits.
    mkfifo((folder_ / "orders").c_str(), 0600);
    orders_ = ::open((folder_ / "orders").c_str(), O_RDWR | O_CLOEXEC);
  }
  ~Relays() override { ::close(orders_); }

  pid_t start_relay(const std::string& listen, int target,
                    std::vector<std::string> more) {
    prefix_ = "relay-";
    input_ = folder_ / "orders";
    std::vector<std::string> arguments = {"relay", "--listen", listen, "--to",
                                          "127.0.0.1:" + std::to_string(target)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const pid_t relay = start(arguments);
    input_.clear();
    return relay;
  }
  int relay_port() {
    const std::string said = said_by("relay-err.txt", "waiting at ");
    return std::atoi(said.c_str() + said.rfind(':') + 1);
  }
  void order(const std::string& line) const {
    const std::string text = line + '\n';
    EXPECT_EQ(::write(orders_, text.data(), text.size()),
              static_cast<ssize_t>(text.size()));
  }
  // The line that begins with `text`, once a program says it; "" after 20 s.
  std::string said_by(const std::string& file, const std::string& text) const {
    for (int k = 0; k < 2000; ++k) {
      const std::string said = read_file(folder_ / file);
      const std::size_t at = said.find(text);
      const std::size_t end = said.find('\n', at);
      if (at != std::string::npos && end != std::string::npos)
        return said.substr(at, end - at);
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    ADD_FAILURE() << text << " is not said: " << read_file(folder_ / file);
    return "";
  }
  Finished stop(pid_t program, const std::string& prefix) {
    kill(program, SIGINT);
    prefix_ = prefix;
    return finish(program);
  }

  int orders_ = -1;
};

int datagram_socket(int port, bool bound) {
  const int socket = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const auto* generic = reinterpret_cast<const sockaddr*>(&address);
  EXPECT_EQ((bound ? bind : connect)(socket, generic, sizeof address), 0);
  const timeval patience{20, 0};
  setsockopt(socket, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
  return socket;
}

int port_of(int socket) {
  sockaddr_in address{};
  socklen_t size = sizeof address;
  getsockname(socket, reinterpret_cast<sockaddr*>(&address), &size);
  return ntohs(address.sin_port);
}

TEST_F(Relays, ObeyWhileTheyRun) {
  const int target = datagram_socket(0, true);
  const pid_t relay =
      start_relay("udpin:0", port_of(target),
                  {"--set", "loss=1,to_a.delay_s=0.1", "--stats", "s.csv"});
  const int caller = datagram_socket(relay_port(), false);
  EXPECT_EQ(send(caller, "lost", 4, 0), 4);
  said_by("relay-err.txt", "session 1 with 127.0.0.1:");
  order("loss 7");
  EXPECT_NE(said_by("relay-err.txt", "loss: 7").find("from 0 to 1"), std::string::npos);
  order("losss 0");
  said_by("relay-err.txt", "losss: ");
  order("loss 0 to-b");
  said_by("relay-err.txt", "s: loss 0 to-b");
  EXPECT_EQ(send(caller, "here", 4, 0), 4);
  char heard[8] = {};
  EXPECT_EQ(recv(target, heard, sizeof heard, 0), 4);
  EXPECT_STREQ(heard, "here");
  order("stats");
  said_by("relay-out.txt", "to-b ");
  order("outage 1000");
  said_by("relay-err.txt", "s: outage 1000");
  EXPECT_EQ(send(caller, "gone", 4, 0), 4);
  order("reset");
  said_by("relay-err.txt", "s: reset");
  const Finished done = stop(relay, "relay-");
  close(target);
  close(caller);
  EXPECT_EQ(done.status, 0) << done.err;
  EXPECT_NE(done.out.find("1 sessions, 1 open"), std::string::npos) << done.out;
  const std::string csv = read_file(folder_ / "s.csv");
  EXPECT_EQ(csv.find("time_s,session,client,direction,packets_in"), 0u) << csv;
  EXPECT_NE(csv.rfind(",to-b,"), std::string::npos) << csv;
}

TEST_F(Relays, CarryAnAgentAndItsWorld) {
  // The fire is under the aircraft, so that its sensors have something to say.
  const auto scenario = write(
      "far.yaml",
      "name: far\n"
      "duration_s: 120\n"
      "environment:\n"
      "  phenomena: [{kind: front, ignitions: [{point_m: [0, 0], radius_m: 400}]}]\n"
      "aircraft:\n"
      "  - {name: far, start: {placement: list, positions_m: [[0, 100]]},\n"
      "     vehicle: {kind: remote, listen: 'udpin:0'}}\n"
      "commands:\n"
      "  - {at_s: 4, do: 'task far-1 fly_to 800,0'}\n");
  prefix_ = "world-";
  const pid_t world = start({"run", scenario.string(), "--out", "world"});
  const std::string place = said_by("world-err.txt", "waiting at udpin:127.0.0.1:");
  const int world_port = std::atoi(place.c_str() + place.rfind(':') + 1);
  const pid_t relay =
      start_relay("udpin:0", world_port,
                  {"--set", "loss=0.2,delay_s=0.1,jitter_s=0.05,duplicate=0.05"});
  const int port = relay_port();
  prefix_ = "agent-";
  const pid_t agent = start({"agent", "far.yaml", "--entity", "far-1", "--world",
                             "udpout:127.0.0.1:" + std::to_string(port)});
  // What it sees and says comes through, and it flies north where it is told to.
  const fs::path database = folder_ / "world/run.sqlite";
  const auto comes_to = [&](const std::string& sql, double least, int seconds) {
    for (int k = 0; k < 10 * seconds; ++k) {
      if (fs::exists(database) && query(database, sql) >= least) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    return false;
  };
  EXPECT_TRUE(comes_to("SELECT count(*) FROM readings WHERE entity_id = 1", 3, 30));
  EXPECT_TRUE(
      comes_to("SELECT count(*) FROM messages WHERE from_id = 1 AND lost = 0 AND "
               "content_kind = 'report'",
               3, 30));
  EXPECT_TRUE(comes_to("SELECT max(north_m) FROM truth WHERE entity_id = 1", 150, 40));
  const Finished carried = stop(relay, "relay-");
  EXPECT_EQ(stop(agent, "agent-").status, 0) << read_file(folder_ / "agent-err.txt");
  EXPECT_EQ(stop(world, "world-").status, 130);
  // Some of the hundreds of packets were lost.
  EXPECT_NE(carried.out.find("1 sessions"), std::string::npos) << carried.out;
  const std::size_t at = carried.out.find("to-b ");
  std::istringstream row(carried.out.substr(at + 5));
  double in = 0, bytes_in = 0, out = 0, bytes_out = 0, lost = 0;
  row >> in >> bytes_in >> out >> bytes_out >> lost;
  EXPECT_GT(in, 50) << carried.out;
  EXPECT_GT(lost, 0) << carried.out;
}

TEST_F(Relays, SayWhatIsWrong) {
  const auto says = [&](std::vector<std::string> arguments, const std::string& part) {
    arguments.insert(arguments.begin(), "relay");
    const Finished refused = run(arguments);
    EXPECT_EQ(refused.status, 2) << refused.err;
    EXPECT_NE(refused.err.find(part), std::string::npos) << refused.err;
  };
  const std::string to = "127.0.0.1:9";
  says({"--listen", "udpin:0", "--to", "9"}, "a host and a port are wanted");
  says({"--listen", "udpin:0", "--to", "tcp:" + to}, "does not change the protocol");
  says({"--listen", "udpout:" + to, "--to", to}, "cannot listen there");
  says({"--listen", "udpin:0", "--to", to, "--set", "loss=2"}, "--set loss=2");
  says({"--listen", "tcpin:0", "--to", to, "--set", "delay_s=1,loss=0.1"},
       "loss: a TCP connection neither loses");
  write("bad.yaml", "delay_s: 0.1\nchanges: [{at_s: 5, delay: 1}]\n");
  says({"--listen", "udpin:0", "--to", to, "--profile", "bad.yaml"}, "bad.yaml:2:");
  const int taken = datagram_socket(0, true);
  const std::string port = std::to_string(port_of(taken));
  says({"--listen", "udpin:" + port, "--to", to}, "already in use");
  close(taken);
  says({"--listen", "udpin:" + port, "--to", "127.0.0.1:" + port}, "call itself");
}

TEST_F(Relays, HaveTheirKeysDocumented) {
  EXPECT_EQ(run({"keys", "relay"}).out, read_file(SKEIN_SOURCE_DIR "/docs/relay-keys.md"))
      << "Renew it: build/release/skein keys relay > docs/relay-keys.md";
}

}  // namespace
}  // namespace skein::app
