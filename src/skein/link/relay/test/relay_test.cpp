// SPDX-License-Identifier: Apache-2.0
#include "skein/link/relay/relay.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace skein::relay::relay_test {
namespace {

using namespace std::chrono_literals;
using impairment::Direction;
using impairment::Directions;
using impairment::index_of;
using Clock = std::chrono::steady_clock;

sockaddr_in local(std::uint16_t port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  return address;
}

// A socket of this machine that never waits.
class Socket {
 public:
  explicit Socket(int kind) : Socket(kind, ::socket(AF_INET, kind, 0)) {}
  Socket(int kind, int descriptor) : kind_(kind), descriptor_(descriptor) {
    ::fcntl(descriptor_, F_SETFL, O_NONBLOCK);
  }
  Socket(Socket&& other) noexcept
      : kind_(other.kind_), descriptor_(std::exchange(other.descriptor_, -1)) {}
  ~Socket() { close(); }
  void close() {
    if (descriptor_ >= 0) ::close(std::exchange(descriptor_, -1));
  }

  std::uint16_t bind() {
    const sockaddr_in any = local(0);
    EXPECT_EQ(::bind(descriptor_, reinterpret_cast<const sockaddr*>(&any), sizeof any),
              0);
    if (kind_ == SOCK_STREAM) {
      EXPECT_EQ(::listen(descriptor_, 8), 0);
    }
    sockaddr_in address{};
    socklen_t size = sizeof address;
    getsockname(descriptor_, reinterpret_cast<sockaddr*>(&address), &size);
    return ntohs(address.sin_port);
  }
  void connect(std::uint16_t port) {
    const sockaddr_in to = local(port);
    ::connect(descriptor_, reinterpret_cast<const sockaddr*>(&to), sizeof to);
  }
  int accept() { return ::accept(descriptor_, nullptr, nullptr); }
  bool send(const std::string& text) {
    return ::send(descriptor_, text.data(), text.size(), MSG_NOSIGNAL) ==
           static_cast<ssize_t>(text.size());
  }
  void send_to(const std::string& text, const sockaddr_in& to) {
    ::sendto(descriptor_, text.data(), text.size(), 0,
             reinterpret_cast<const sockaddr*>(&to), sizeof to);
  }
  // What has come, "" without; `from` is who sent it.
  std::string receive(sockaddr_in* from = nullptr) {
    std::string text(65'536, '\0');
    socklen_t size = sizeof(sockaddr_in);
    const ssize_t count =
        ::recvfrom(descriptor_, text.data(), text.size(), 0,
                   reinterpret_cast<sockaddr*>(from), from ? &size : nullptr);
    ended = count == 0;
    text.resize(count > 0 ? static_cast<std::size_t>(count) : 0);
    return text;
  }
  void shut() { ::shutdown(descriptor_, SHUT_WR); }

  bool ended = false;  // the other end of a connection has said its last

 private:
  int kind_;
  int descriptor_;
};

// A relay in front of a target.
struct Stand {
  Stand(bool tcp, std::uint16_t target, const impairment::Impairment& impairment,
        Time idle = Time::from_seconds(60)) {
    RelayOptions options;
    if (tcp)
      options.listen = transport::TcpServer{};
    else
      options.listen = transport::UdpServer{};
    options.to = {"127.0.0.1", target};
    options.plan.first = {impairment, impairment};
    options.idle = idle;
    auto opened =
        Relay::open(options, [this](const std::string& text) { news += text + '\n'; });
    EXPECT_TRUE(opened.ok()) << opened.error().text();
    relay = std::move(opened).value();
  }
  std::uint16_t port() const {
    const std::string place = relay->place();
    return static_cast<std::uint16_t>(std::stoi(place.substr(place.rfind(':') + 1)));
  }
  // Waits for up to 20 s: much longer than anything here takes.
  bool wait(const std::function<bool()>& until) const {
    const auto begin = Clock::now();
    while (Clock::now() - begin < 20s) {
      if (until()) return true;
      relay->run_for(2ms);
    }
    return false;
  }
  DirectionReport to_b() const {
    return relay->report().directions[index_of(Direction::kToB)];
  }
  DirectionReport to_a() const {
    return relay->report().directions[index_of(Direction::kToA)];
  }

  std::string news;
  std::unique_ptr<Relay> relay;
};

// The next datagram, waited for.
std::string next_of(Socket& socket, const Stand& stand, sockaddr_in* from = nullptr) {
  std::string text;
  stand.wait([&] {
    text = socket.receive(from);
    return !text.empty();
  });
  return text;
}

TEST(UdpRelay, PassesBothWaysForEachCaller) {
  Socket target(SOCK_DGRAM), one(SOCK_DGRAM), two(SOCK_DGRAM);
  const Stand stand(false, target.bind(), {});
  one.connect(stand.port());
  two.connect(stand.port());
  sockaddr_in first{}, second{};
  one.send("from one");
  EXPECT_EQ(next_of(target, stand, &first), "from one");
  two.send("from two");
  EXPECT_EQ(next_of(target, stand, &second), "from two");
  EXPECT_NE(first.sin_port, second.sin_port) << "a socket for each";
  target.send_to("to two", second);
  target.send_to("to one", first);
  EXPECT_EQ(next_of(one, stand), "to one");
  EXPECT_EQ(next_of(two, stand), "to two");
  EXPECT_EQ(stand.relay->report().open, 2u);
  EXPECT_EQ(stand.to_b().counts.packets_out, 2u);
  EXPECT_EQ(stand.to_a().counts.bytes_out, 12u);
  EXPECT_EQ(stand.relay->sessions().size(), 2u);
}

TEST(UdpRelay, DelaysAndKeepsTheOrder) {
  Socket target(SOCK_DGRAM), caller(SOCK_DGRAM);
  impairment::Impairment impairment;
  impairment.delay = 0.2;
  const Stand stand(false, target.bind(), impairment);
  caller.connect(stand.port());
  const auto begin = Clock::now();
  for (int k = 0; k < 20; ++k) caller.send(std::to_string(k));
  for (int k = 0; k < 20; ++k) EXPECT_EQ(next_of(target, stand), std::to_string(k));
  // Never earlier; how much later depends on the machine.
  EXPECT_GE(Clock::now() - begin, 200ms);
  EXPECT_GE(stand.to_b().counts.delay_mean(), 0.2);
}

TEST(UdpRelay, LosesDoublesAndReorders) {
  Socket target(SOCK_DGRAM), caller(SOCK_DGRAM);
  impairment::Impairment impairment;
  impairment.loss = 0.3;
  impairment.duplicate = 0.2;
  impairment.reorder = 0.2;
  impairment.reorder_delay = 0.02;
  const Stand stand(false, target.bind(), impairment);
  caller.connect(stand.port());
  std::uint64_t came = 0;
  for (int k = 0; k < 1000; ++k) {
    caller.send("x");
    // Not more than a socket's buffer holds.
    if (k % 10 == 0) stand.relay->run_for(1ms);
    while (!target.receive().empty()) ++came;
  }
  EXPECT_TRUE(stand.wait([&] {
    while (!target.receive().empty()) ++came;
    const DirectionReport report = stand.to_b();
    return report.counts.packets_in == 1000 && report.under_way == 0 &&
           came == report.counts.packets_out;
  }));
  const impairment::ChannelCounts counts = stand.to_b().counts;
  EXPECT_EQ(came, counts.packets_out);
  // Four standard deviations of 1000 draws are 0.06 and of 700 draws 0.06.
  EXPECT_NEAR(static_cast<double>(counts.lost_by_chance) / 1000, 0.3, 0.06);
  EXPECT_NEAR(static_cast<double>(counts.duplicated) / 700, 0.2, 0.07);
  EXPECT_GT(counts.reordered, 0u);
}

TEST(UdpRelay, CutsChangesAndResets) {
  Socket target(SOCK_DGRAM), caller(SOCK_DGRAM);
  const Stand stand(false, target.bind(), {});
  caller.connect(stand.port());
  caller.send("1");
  EXPECT_EQ(next_of(target, stand), "1");
  const auto lost = [&] {
    const DirectionReport report = stand.to_b();
    return report.counts.lost_by_chance + report.counts.lost_in_outage;
  };
  stand.relay->cut(Directions::kToB, Time::from_seconds(3600));
  caller.send("2");
  EXPECT_TRUE(stand.wait([&] { return lost() == 1; }));
  stand.relay->reset();
  caller.send("3");
  EXPECT_EQ(next_of(target, stand), "3");
  stand.relay->change(Directions::kBoth, {.loss = 1.0});
  caller.send("4");
  EXPECT_TRUE(stand.wait([&] { return lost() == 2; }));
  stand.relay->reset();
  caller.send("5");
  EXPECT_EQ(next_of(target, stand), "5");
}

TEST(UdpRelay, FollowsItsPlan) {
  Socket target(SOCK_DGRAM), caller(SOCK_DGRAM);
  RelayOptions options;
  options.listen = transport::UdpServer{};
  options.to = {"127.0.0.1", target.bind()};
  options.plan.first[0].cut = true;
  options.plan.changes.push_back(
      {Time::from_seconds(0.3), Directions::kBoth, {.cut = false}});
  auto relay = Relay::open(options, [](const std::string&) {});
  ASSERT_TRUE(relay.ok());
  Relay& open = *relay.value();
  const std::string place = open.place();
  caller.connect(
      static_cast<std::uint16_t>(std::stoi(place.substr(place.rfind(':') + 1))));
  std::string heard;
  // For 20 s at most, much longer than it takes.
  for (int k = 0; k < 2000 && heard.empty(); ++k) {
    caller.send("now");
    open.run_for(10ms);
    heard = target.receive();
  }
  EXPECT_EQ(heard, "now");
  EXPECT_GE(open.now(), Time::from_seconds(0.3));
}

TEST(UdpRelay, GoesOnWhenNobodyIsThere) {
  std::uint16_t port = 0;
  {
    Socket gone(SOCK_DGRAM);
    port = gone.bind();
  }
  Socket caller(SOCK_DGRAM);
  const Stand stand(false, port, {});
  caller.connect(stand.port());
  EXPECT_TRUE(stand.wait([&] {
    caller.send("anybody?");
    return stand.to_b().refused >= 3;
  }));
  EXPECT_EQ(stand.relay->report().open, 1u);
}

TEST(UdpRelay, ForgetsWhoIsSilent) {
  Socket target(SOCK_DGRAM), caller(SOCK_DGRAM);
  Stand stand(false, target.bind(), {}, Time::from_seconds(0.2));
  caller.connect(stand.port());
  caller.send("hello");
  EXPECT_EQ(next_of(target, stand), "hello");
  EXPECT_TRUE(stand.wait([&] { return stand.relay->report().open == 0; }));
  EXPECT_EQ(stand.to_b().counts.packets_out, 1u) << "what it did is kept";
  EXPECT_EQ(stand.relay->take_ended().size(), 1u);
  EXPECT_TRUE(stand.relay->take_ended().empty());
  caller.send("again");
  EXPECT_EQ(next_of(target, stand), "again");
  EXPECT_EQ(stand.relay->report().sessions, 2u);
}

TEST(UdpRelay, TurnsAwayMoreCallersThanItTakes) {
  rlimit files{};
  getrlimit(RLIMIT_NOFILE, &files);
  constexpr rlim_t kEnough = 2 * Relay::kMaxSessions + 100;
  if (files.rlim_max < kEnough) GTEST_SKIP() << "the system has not so many sockets";
  files.rlim_cur = std::max(files.rlim_cur, kEnough);
  setrlimit(RLIMIT_NOFILE, &files);
  Socket target(SOCK_DGRAM);
  const Stand stand(false, target.bind(), {});
  std::vector<Socket> callers;
  for (std::size_t k = 0; k < Relay::kMaxSessions + 3; ++k) {
    callers.emplace_back(SOCK_DGRAM);
    callers.back().connect(stand.port());
    callers.back().send("x");
    if (k % 50 == 0) stand.relay->run_for(5ms);
  }
  EXPECT_TRUE(stand.wait([&] { return stand.relay->report().turned_away == 3; }));
  EXPECT_EQ(stand.relay->report().open, Relay::kMaxSessions);
  EXPECT_EQ(stand.relay->report().sessions, Relay::kMaxSessions);
}

// A connection through a relay: both ends.
struct Connection {
  explicit Connection(const impairment::Impairment& impairment)
      : stand(true, target.bind(), impairment) {
    caller.connect(stand.port());
    int descriptor = -1;
    EXPECT_TRUE(stand.wait([&] { return (descriptor = target.accept()) >= 0; }));
    called = std::make_unique<Socket>(SOCK_STREAM, descriptor);
  }

  Socket target{SOCK_STREAM}, caller{SOCK_STREAM};
  Stand stand;
  std::unique_ptr<Socket> called;
};

// Some text without a period that a lost or doubled piece would keep.
std::string long_text(std::size_t size) {
  std::string text;
  for (int k = 0; text.size() < size; ++k) text += std::to_string(k) + ' ';
  text.resize(size);
  return text;
}

TEST(TcpRelay, PassesBytesInOrderAtItsRateAndSaysTheEnd) {
  impairment::Impairment impairment;
  impairment.delay = 0.05;
  impairment.jitter = 0.05;
  impairment.rate = 400'000;  // 20 kB take 0.4 s
  impairment.queue_bytes = 4096;
  Connection connection(impairment);
  const std::string all = long_text(20'000);
  const auto begin = Clock::now();
  EXPECT_TRUE(connection.caller.send(all));
  connection.caller.shut();
  std::string came;
  EXPECT_TRUE(connection.stand.wait([&] {
    came += connection.called->receive();
    return connection.called->ended;
  }));
  EXPECT_EQ(came, all);
  EXPECT_GE(Clock::now() - begin, 450ms) << "the rate and the delay";
  // The other way is still open.
  EXPECT_TRUE(connection.called->send("thanks"));
  EXPECT_EQ(next_of(connection.caller, connection.stand), "thanks");
  connection.called->close();
  EXPECT_TRUE(
      connection.stand.wait([&] { return connection.stand.relay->report().open == 0; }));
}

TEST(TcpRelay, CarriesSeveralConnections) {
  Connection first({});
  Socket caller(SOCK_STREAM);
  caller.connect(first.stand.port());
  int descriptor = -1;
  EXPECT_TRUE(
      first.stand.wait([&] { return (descriptor = first.target.accept()) >= 0; }));
  Socket called(SOCK_STREAM, descriptor);
  caller.send("second");
  first.caller.send("first");
  EXPECT_EQ(next_of(called, first.stand), "second");
  EXPECT_EQ(next_of(*first.called, first.stand), "first");
  EXPECT_EQ(first.stand.relay->report().open, 2u);
  caller.close();
  called.close();
  EXPECT_TRUE(first.stand.wait([&] { return first.stand.relay->report().open == 1; }));
  first.caller.send("still there");
  EXPECT_EQ(next_of(*first.called, first.stand), "still there");
}

TEST(TcpRelay, BytesWaitForTheEndOfAnOutage) {
  Connection connection({});
  const auto begin = Clock::now();
  connection.stand.relay->cut(Directions::kBoth, Time::from_seconds(0.3));
  EXPECT_TRUE(connection.caller.send("late"));
  EXPECT_EQ(next_of(*connection.called, connection.stand), "late");
  EXPECT_GE(Clock::now() - begin, 300ms);
}

TEST(TcpRelay, ReadsNoFasterThanItMaySend) {
  impairment::Impairment impairment;
  impairment.rate = 8000;
  impairment.queue_bytes = 10'000;
  Connection connection(impairment);
  connection.caller.send(long_text(100'000));  // as much as the system takes
  connection.stand.wait([&] { return connection.stand.to_b().waiting_bytes >= 10'000; });
  connection.stand.relay->run_for(50ms);
  // A piece of 256 bytes may have gone out just now.
  EXPECT_LE(connection.stand.to_b().waiting_bytes, 10'000u);
  EXPECT_GE(connection.stand.to_b().waiting_bytes, 10'000u - 256);
  EXPECT_EQ(connection.stand.to_b().counts.lost_queue_full, 0u);
}

TEST(TcpRelay, ClosesWhenTheTargetIsGone) {
  std::uint16_t port = 0;
  {
    Socket gone(SOCK_STREAM);
    port = gone.bind();
  }
  const Stand stand(true, port, {});
  Socket caller(SOCK_STREAM);
  caller.connect(stand.port());
  EXPECT_TRUE(stand.wait([&] {
    caller.receive();
    return caller.ended;
  }));
  EXPECT_EQ(stand.relay->report().failed, 1u);
  EXPECT_NE(stand.news.find("Connection refused"), std::string::npos) << stand.news;
}

TEST(Relay, RefusesWhereItCannotBe) {
  Socket taken(SOCK_DGRAM), taken_tcp(SOCK_STREAM);
  const auto error_of = [](const transport::EndpointAddress& listen, std::uint16_t to) {
    RelayOptions options;
    options.listen = listen;
    options.to = {"127.0.0.1", to};
    const auto relay = Relay::open(options, [](const std::string&) {});
    return relay.ok() ? "" : relay.error().text();
  };
  const std::uint16_t udp = taken.bind(), tcp = taken_tcp.bind();
  EXPECT_NE(error_of(transport::UdpServer{{"127.0.0.1", udp}}, 9).find("already in use"),
            std::string::npos);
  EXPECT_NE(error_of(transport::TcpServer{{"127.0.0.1", tcp}}, 9).find("already in use"),
            std::string::npos);
  taken.close();
  for (const char* host : {"127.0.0.1", "0.0.0.0"})
    EXPECT_NE(error_of(transport::UdpServer{{host, udp}}, udp).find("call itself"),
              std::string::npos);
  EXPECT_NE(error_of(transport::SerialLine{"/dev/null"}, 9).find("udpin:"),
            std::string::npos);
}

}  // namespace
}  // namespace skein::relay::relay_test
