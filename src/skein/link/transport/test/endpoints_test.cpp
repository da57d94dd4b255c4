// SPDX-License-Identifier: Apache-2.0
#include "skein/link/transport/endpoints.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <termios.h>
#include <unistd.h>

#include <chrono>
#include <cstddef>
#include <cstdlib>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace skein::transport::endpoints_test {
namespace {

using namespace std::chrono_literals;

std::span<const std::byte> bytes_of(const std::string& text) {
  return std::as_bytes(std::span(text));
}

// What happens at one side.
struct Side final : ChannelListener {
  void opened(ChannelId channel, EndpointId, const std::string& name) override {
    names[channel] = name;
  }
  void received(ChannelId channel, std::span<const std::byte> bytes) override {
    for (const std::byte byte : bytes) heard[channel] += static_cast<char>(byte);
  }
  void closed(ChannelId channel, const std::string&) override {
    names.erase(channel);
    ++closings;
  }

  // Waits for up to 10 s, with other sides.
  bool wait(const std::function<bool()>& until, Side* other = nullptr) {
    for (int k = 0; k < 1000 && !until(); ++k) {
      endpoints->run_for(5ms);
      if (other && other->endpoints) other->endpoints->run_for(5ms);
    }
    return until();
  }
  void open(const std::string& text) {
    const auto result = endpoints->open(parse_endpoint(text).value());
    ASSERT_TRUE(result.ok()) << result.error().text();
  }
  // The place of the only server, to connect to.
  std::string place(const std::string& client) const {
    const std::string at = endpoints->places().at(0);
    return client + at.substr(at.find(':'));
  }
  void send_all(const std::string& text) const {
    for (const auto& [channel, name] : names) endpoints->send(channel, bytes_of(text));
  }
  std::string all_heard() const {
    std::string all;
    for (const auto& [channel, text] : heard) all += text + '|';
    return all;
  }

  std::map<ChannelId, std::string> names, heard;
  int closings = 0;
  std::unique_ptr<Endpoints> endpoints = std::make_unique<Endpoints>(*this);
};

TEST(Endpoints, MeetByIPv6AndByIPv4WhereBothAreHeard) {
  Side probe;
  if (!probe.endpoints->open(parse_endpoint("udpin:[::1]:0").value()))
    GTEST_SKIP() << "this machine has no IPv6";
  for (const char* kind : {"udp", "tcp"}) {
    const bool udp = kind == std::string("udp");
    Side server, six, four, mapped;
    server.open(udp ? "udpin:[::]:0" : "tcpin:[::]:0");
    const std::string at = server.endpoints->places().at(0);
    const std::string port = at.substr(at.rfind(':'));
    const std::string client = udp ? "udpout:" : "tcp:";
    six.open(client + "[::1]" + port);
    four.open(client + "127.0.0.1" + port);
    mapped.open(client + "[::ffff:127.0.0.1]" + port);
    std::size_t met = 0;
    for (Side* side : {&six, &four, &mapped}) {
      ASSERT_TRUE(side->wait([&] { return !side->names.empty(); }, &server));
      side->send_all("x");
      ++met;
      ASSERT_TRUE(server.wait([&] { return server.heard.size() == met; }, side)) << at;
    }
    for (const auto& [channel, name] : server.names)
      EXPECT_TRUE(is_local_channel(name)) << name;
  }
}

TEST(Endpoints, AnswerEachSenderOfDatagrams) {
  Side server, a, b;
  server.open("udpin:0");
  a.open(server.place("udpout"));
  b.open(server.place("udpout"));
  a.send_all("from a");
  ASSERT_TRUE(server.wait([&] { return server.names.size() == 1; }));
  b.send_all("from b");
  ASSERT_TRUE(server.wait([&] { return server.names.size() == 2; }));
  EXPECT_EQ(server.all_heard(), "from a|from b|");
  server.endpoints->send(server.heard.begin()->first, bytes_of("to a"));
  ASSERT_TRUE(a.wait([&] { return a.all_heard() == "to a|"; }));
  b.endpoints->run_for(20ms);
  EXPECT_EQ(b.all_heard(), "");
}

TEST(Endpoints, SendDatagramsToAllOfANetwork) {
  Side server, sender;
  server.open("udpin:0");
  std::string to = server.place("udpbcast");
  sender.open(to.replace(to.find("127.0.0.1"), 9, "127.255.255.255"));
  // Waits at one address: what is for all does not reach it; it must not fail either.
  sender.send_all("hello");
  Side all;
  all.open("udpin:0.0.0.0:0");
  std::string place = all.endpoints->places().at(0);
  Side other;
  other.open("udpbcast:127.255.255.255" + place.substr(place.rfind(':')));
  other.send_all("hello");
  EXPECT_TRUE(all.wait([&] { return all.all_heard() == "hello|"; }));
}

TEST(Endpoints, SendDatagramsToAllOfAMulticastGroup) {
  const std::string port = std::to_string(20'000 + getpid() % 20'000);
  Side a, b, other;
  a.open("udpmulti:239.255.77.1:" + port);
  b.open("udpmulti:239.255.77.1:" + port);
  other.open("udpmulti:239.255.77.2:" + port);
  a.send_all("hello");
  ASSERT_TRUE(b.wait([&] { return b.all_heard() == "hello|"; }, &a));
  EXPECT_TRUE(a.wait([&] { return a.all_heard() == "hello|"; })) << "it hears itself";
  b.send_all("you");
  ASSERT_TRUE(a.wait([&] { return a.all_heard() == "helloyou|"; }, &b));
  other.endpoints->run_for(20ms);
  EXPECT_EQ(other.all_heard(), "");
}

TEST(Endpoints, CarryLongTextsOverConnections) {
  Side server, client;
  server.open("tcpin:0");
  client.open(server.place("tcp"));
  ASSERT_TRUE(client.wait([&] { return client.names.size() == 1; }, &server));
  const std::string text(100'000, 'x');
  client.send_all(text);
  ASSERT_TRUE(
      server.wait([&] { return server.all_heard().size() == text.size() + 1; }, &client));
  server.send_all("thanks");
  EXPECT_TRUE(client.wait([&] { return client.all_heard() == "thanks|"; }, &server));
}

TEST(Endpoints, ConnectAgainWhenAServerIsBack) {
  Side client;
  auto server = std::make_unique<Side>();
  server->open("tcpin:0");
  const std::string at = server->endpoints->places().at(0);
  client.open(server->place("tcp"));
  ASSERT_TRUE(client.wait([&] { return !client.names.empty(); }, server.get()));
  server.reset();
  ASSERT_TRUE(client.wait([&] { return client.closings == 1; }));
  EXPECT_FALSE(client.endpoints->send(1, bytes_of("nobody")));
  server = std::make_unique<Side>();
  server->open(at);
  EXPECT_TRUE(client.wait([&] { return !client.names.empty(); }, server.get()));
}

TEST(Endpoints, HoldNoMoreForAPeerThatDoesNotReadThanTheySay) {
  Side server, client;
  server.open("tcpin:0");
  client.open(server.place("tcp"));
  ASSERT_TRUE(client.wait([&] { return client.names.size() == 1; }, &server));
  const std::string text(10'000, 'x');
  int sent = 0;
  while (sent < 100'000 && client.endpoints->send(1, bytes_of(text))) {
    ++sent;
    client.endpoints->run_for(0ms);
  }
  EXPECT_LT(sent, 10'000);  // 100 MB; the system's own buffers hold a few
  // What did go out arrives whole.
  ASSERT_TRUE(server.wait(
      [&] {
        return server.all_heard().size() == static_cast<std::size_t>(sent) * 10'000 + 1;
      },
      &client));
}

TEST(Endpoints, TakeLinesThatComeLaterAndGoAway) {
  const int master = posix_openpt(O_RDWR | O_NOCTTY);
  ASSERT_GE(master, 0);
  ASSERT_EQ(grantpt(master), 0);
  ASSERT_EQ(unlockpt(master), 0);
  termios raw{};
  ASSERT_EQ(tcgetattr(master, &raw), 0);
  cfmakeraw(&raw);
  ASSERT_EQ(tcsetattr(master, TCSANOW, &raw), 0);
  const std::string link = testing::TempDir() + "line" + std::to_string(getpid());
  Side side;
  side.open("serial:" + link + ":115200");
  side.endpoints->run_for(20ms);
  EXPECT_TRUE(side.names.empty());
  ASSERT_EQ(symlink(ptsname(master), link.c_str()), 0);
  ASSERT_TRUE(side.wait([&] { return side.names.size() == 1; }));
  ASSERT_EQ(write(master, "in", 2), 2);
  EXPECT_TRUE(side.wait([&] { return side.all_heard() == "in|"; }));
  side.send_all("out");
  side.endpoints->run_for(20ms);
  char text[8] = {};
  EXPECT_EQ(read(master, text, sizeof text), 3);
  EXPECT_STREQ(text, "out");
  unlink(link.c_str());
  close(master);
  EXPECT_TRUE(side.wait([&] { return side.closings == 1; }));
}

TEST(Endpoints, HandleOneThingAtATimeAsSoonAsItHappens) {
  Side server, client;
  EXPECT_FALSE(server.endpoints->run_one_for(0ms));
  server.open("udpin:0");
  client.open(server.place("udpout"));
  const auto before = std::chrono::steady_clock::now();
  client.send_all("a");
  client.send_all("b");
  EXPECT_TRUE(server.endpoints->run_one_for(60s));
  EXPECT_EQ(server.all_heard(), "a|");
  EXPECT_TRUE(server.endpoints->run_one_for(0ms));  // what is there needs no patience
  EXPECT_EQ(server.all_heard(), "ab|");
  EXPECT_LT(std::chrono::steady_clock::now() - before, 30s);
  EXPECT_FALSE(server.endpoints->run_one_for(1ms));
}

TEST(Endpoints, SayWhereNothingCanBeOpened) {
  Side side;
  side.open("tcpin:0");
  const auto taken = side.endpoints->open(parse_endpoint(side.place("tcpin")).value());
  ASSERT_FALSE(taken.ok());
  EXPECT_NE(taken.error().text().find("in use"), std::string::npos);
  EXPECT_FALSE(side.endpoints->open(parse_endpoint("udpin:203.0.113.1:0").value()).ok());
}

}  // namespace
}  // namespace skein::transport::endpoints_test
