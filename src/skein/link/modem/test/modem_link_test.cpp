// SPDX-License-Identifier: Apache-2.0
#include "skein/link/modem/modem_link.h"

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <optional>

namespace skein::modem::modem_link_test {
namespace {

constexpr EntityId kStation{0}, kReal{1}, kSimulated{2};

ModemLinkOptions options_of(const std::string& endpoint, std::uint32_t hw,
                            std::vector<EntityId> identities) {
  ModemLinkOptions options;
  options.endpoint = transport::parse_endpoint(endpoint).value();
  options.peer.hw = hw;
  options.peer.identities = std::move(identities);
  options.peer.entities = 3;
  options.peer.overhears = hw == 1;
  options.peer.advertisement_period = Time::from_seconds(0.1);
  return options;
}

bool comes(const std::function<bool()>& true_at_last) {
  for (int k = 0; k < 1000; ++k) {
    if (true_at_last()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

class Transports : public testing::TestWithParam<std::pair<const char*, const char*>> {};

TEST_P(Transports, CarryMessagesBothWays) {
  const auto [server, client] = GetParam();
  ModemLink station(options_of(std::string(server) + ":0", 1, {kStation, kSimulated}));
  EXPECT_TRUE(station.is_beyond(kReal));
  EXPECT_FALSE(station.is_beyond(kSimulated) || station.is_beyond(EntityId{3}));
  const auto places = station.start();
  ASSERT_TRUE(places.ok());
  const std::string place = places.value().at(0);
  const std::string port = place.substr(place.rfind(':'));
  ModemLink real(options_of(std::string(client) + ":127.0.0.1" + port, 2, {kReal}));
  ASSERT_TRUE(real.start().ok());
  const Time now = Time::from_seconds(5);
  std::vector<Heard> at_station, at_real;
  const auto collect = [now](ModemLink& link, std::vector<Heard>& to) {
    for (Heard& heard : link.take(now)) to.push_back(std::move(heard));
    return !to.empty();
  };
  ASSERT_TRUE(comes([&] { return collect(station, at_station); }));
  EXPECT_TRUE(std::get<NeighbourChange>(at_station[0]).found);
  ASSERT_TRUE(comes([&] { return collect(real, at_real) && at_real.size() == 2; }));
  at_station.clear();
  at_real.clear();
  station.send(now, {kSimulated, kReal, 3, now, Heartbeat{}});
  real.send(now, {kReal, kSimulated, 4, now, Heartbeat{}});
  station.flush();
  real.flush();
  ASSERT_TRUE(comes([&] { return collect(real, at_real); }));
  EXPECT_EQ(std::get<Message>(at_real[0]).number, 3u);
  ASSERT_TRUE(comes([&] {
    for (Heard& heard : station.take(now, kReal)) at_station.push_back(std::move(heard));
    return !at_station.empty();
  }));
  EXPECT_EQ(std::get<Message>(at_station[0]).number, 4u);
  EXPECT_TRUE(comes([&] { return station.statistics().heard >= 2; }));
}

INSTANTIATE_TEST_SUITE_P(Ways, Transports,
                         testing::Values(std::pair("udpin", "udpout"),
                                         std::pair("tcpin", "tcp")));

TEST(ModemLink, SaysNothingBeforeItIsStarted) {
  ModemLink link(options_of("udpin:0", 1, {kStation, kSimulated}));
  link.send(Time(), {kSimulated, kReal, 3, Time(), Heartbeat{}});
  EXPECT_TRUE(link.take(Time()).empty());
  EXPECT_EQ(link.statistics().unreachable, 0u);
}

// A station at any UDP port and two real ones, who have met and say nothing by themselves
// from then on.
class Trio : public testing::Test {
 protected:
  void SetUp() override {
    const auto options = [](const std::string& endpoint, std::uint32_t hw,
                            std::vector<EntityId> identities) {
      auto all = options_of(endpoint, hw, std::move(identities));
      all.peer.entities = 4;
      all.peer.advertisement_period = Time::from_seconds(60);
      return all;
    };
    station = std::make_unique<ModemLink>(options("udpin:0", 1, {kStation, kSimulated}));
    const auto places = station->start();
    ASSERT_TRUE(places.ok());
    const std::string port = places.value().at(0).substr(places.value().at(0).rfind(':'));
    for (const EntityId each : {kReal, kOther}) {
      real.push_back(std::make_unique<ModemLink>(
          options("udpout:127.0.0.1" + port, each.value + 10, {each})));
      ASSERT_TRUE(real.back()->start().ok());
      // The station's answer tells each that it is heard.
      ASSERT_TRUE(comes([&] { return !real.back()->take(now).empty(); }));
    }
  }

  static constexpr EntityId kOther{3};
  const Time now = Time::from_seconds(5);
  std::unique_ptr<ModemLink> station;
  std::vector<std::unique_ptr<ModemLink>> real;
};

TEST_F(Trio, SendsWhatAStepSaysToSeveralOnceHoweverTheThreadsRun) {
  station->send(now, {kSimulated, kReal, 3, now, Heartbeat{}});
  // Time for its thread to send it, if it would.
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  station->send(now, {kSimulated, kOther, 4, now, Heartbeat{}});
  station->flush();
  for (const auto& each : real)
    EXPECT_TRUE(comes([&] {
      for (const Heard& heard : each->take(now))
        if (std::holds_alternative<Message>(heard)) return true;
      return false;
    }));
  ASSERT_TRUE(comes([&] { return station->statistics().delayed > 0; }));
  EXPECT_EQ(station->statistics().delayed, 1u) << "one datagram for both";
}

TEST_F(Trio, CountsWhatIsMoreThanItHolds) {
  for (std::uint64_t k = 0; k < 5003; ++k)
    station->send(now, {kSimulated, kReal, k, now, Heartbeat{}});
  EXPECT_EQ(station->statistics().put_full, 3u);
}

TEST(ModemLink, SaysWhoseModemHasItsAddressToo) {
  ModemLink station(options_of("udpin:0", 1, {kStation, kSimulated}));
  const auto places = station.start();
  ASSERT_TRUE(places.ok());
  auto options = options_of(
      "udpout:127.0.0.1" + places.value().at(0).substr(places.value().at(0).rfind(':')),
      1, {kReal});
  options.peer.session = 2;
  ModemLink real(options);
  ASSERT_TRUE(real.start().ok());
  const auto clashes = [](ModemLink& link, EntityId who) {
    for (const Heard& heard : link.take(Time(), who))
      if (const auto* alert = std::get_if<ModemAlert>(&heard))
        return alert->kind == AlertKind::kSameAddress && alert->hw == 1;
    return false;
  };
  EXPECT_TRUE(comes([&] { return clashes(station, kReal); }));
  EXPECT_TRUE(comes([&] { return clashes(real, kStation); }));
}

std::vector<AlertKind> alerts_of(ModemLink& link) {
  std::vector<AlertKind> kinds;
  for (const Heard& heard : link.take(Time()))
    if (const auto* alert = std::get_if<ModemAlert>(&heard)) kinds.push_back(alert->kind);
  return kinds;
}

using AlertKinds = std::vector<AlertKind>;

TEST(ModemLink, SaysAtOnceThatItsDeviceIsNotThere) {
  ModemLink link(options_of("serial:/nowhere/modem", 2, {kReal}));
  ASSERT_TRUE(link.start().ok());
  EXPECT_EQ(alerts_of(link), AlertKinds{AlertKind::kNoLine});
}

TEST(ModemLink, SaysThatALineIsLostAndIsBack) {
  auto station = std::make_unique<ModemLink>(options_of("tcpin:0", 1, {kStation}));
  const std::string place = station->start().value().at(0);
  ModemLink real(
      options_of("tcp:127.0.0.1" + place.substr(place.rfind(':')), 2, {kReal}));
  ASSERT_TRUE(real.start().ok());
  ASSERT_TRUE(comes([&] { return real.statistics().sent > 0; }));
  EXPECT_EQ(alerts_of(real), AlertKinds{});
  EXPECT_EQ(alerts_of(*station), AlertKinds{}) << "a server waits";
  station.reset();
  AlertKinds lost;
  EXPECT_TRUE(comes([&] { return !(lost = alerts_of(real)).empty(); }));
  EXPECT_EQ(lost, AlertKinds{AlertKind::kNoLine});
  station = std::make_unique<ModemLink>(options_of(place, 1, {kStation}));
  ASSERT_TRUE(station->start().ok());
  AlertKinds back;
  EXPECT_TRUE(comes([&] { return !(back = alerts_of(real)).empty(); }));
  EXPECT_EQ(back, AlertKinds{AlertKind::kLineOpen});
}

TEST(LineAlerts, AreOneAMinuteAtMost) {
  LineAlerts lines;
  const auto look = [&](bool open, double time) {
    return lines.look(open, Time::from_seconds(time));
  };
  EXPECT_FALSE(look(true, 0));
  EXPECT_EQ(look(false, 1), AlertKind::kNoLine);
  EXPECT_FALSE(look(false, 2));
  EXPECT_EQ(look(true, 3), AlertKind::kLineOpen);
  EXPECT_FALSE(look(false, 4) || look(true, 5) || look(false, 6));
  EXPECT_EQ(look(false, 61), AlertKind::kNoLine) << "still, or again";
  EXPECT_EQ(look(true, 62), AlertKind::kLineOpen);
}

// Somebody at the same server, who sends what a test wants.
class Sender final : public transport::ChannelListener {
 public:
  explicit Sender(const std::string& endpoint) {
    EXPECT_TRUE(endpoints_.open(transport::parse_endpoint(endpoint).value()).ok());
    for (int k = 0; k < 200 && !channel_; ++k)
      endpoints_.run_for(std::chrono::milliseconds(10));
    EXPECT_TRUE(channel_);
  }
  void send(std::span<const std::byte> bytes) {
    endpoints_.send(*channel_, bytes);
    endpoints_.run_for(std::chrono::milliseconds(0));
  }
  void opened(transport::ChannelId channel, transport::EndpointId,
              const std::string&) override {
    channel_ = channel;
  }
  void received(transport::ChannelId, std::span<const std::byte>) override {}
  void closed(transport::ChannelId, const std::string&) override {}

 private:
  std::optional<transport::ChannelId> channel_;
  transport::Endpoints endpoints_{*this};
};

// What the real one says with a modem of its own.
std::vector<std::byte> said_by_real(std::uint64_t session, std::uint64_t number,
                                    const Payload& payload) {
  Datagram datagram;
  datagram.session = session;
  datagram.origin = {2, kReal.value};
  datagram.to = {1, kSimulated.value};
  datagram.number = number;
  datagram.payload = payload;
  std::vector<std::byte> bytes;
  encode(datagram, bytes);
  return bytes;
}

std::string place_of(ModemLink& link, const char* client) {
  const std::string place = link.start().value().at(0);
  return client + (":127.0.0.1" + place.substr(place.rfind(':')));
}

// Its modem begins anew, again and again, and nobody looks.
TEST(ModemLink, KeepsOfWhoComesAndGoesWhatIs) {
  auto options = options_of("udpin:0", 1, {kStation, kSimulated});
  options.peer.advertisement_period = Time::from_seconds(0.2);
  ModemLink station(options);
  Sender sender(place_of(station, "udpout"));
  for (std::uint64_t session = 1; session <= 3; ++session) {
    // Until it is lost again: three periods.
    if (session > 1) std::this_thread::sleep_for(std::chrono::milliseconds(800));
    sender.send(said_by_real(session, 1, Advertisement{0, {kReal.value}}));
    ASSERT_TRUE(comes([&] { return station.statistics().heard == session; }));
  }
  const auto taken = station.take(Time());
  ASSERT_EQ(taken.size(), 1u);
  EXPECT_TRUE(std::get<NeighbourChange>(taken[0]).found);
}

TEST(ModemLink, HoldsNoMoreMessagesThanItSays) {
  auto options = options_of("udpin:0", 1, {kStation, kSimulated});
  options.peer.advertisement_period = Time::from_seconds(60);
  ModemLink station(options);
  Sender sender(place_of(station, "udpout"));
  std::uint64_t number = 0;
  const auto say = [&](const Payload& payload) {
    sender.send(said_by_real(1, ++number, payload));
    // No more under way than a socket holds.
    return number % 50 != 1 ||
           comes([&] { return station.statistics().heard == number; });
  };
  ASSERT_TRUE(say(Advertisement{0, {kReal.value}}));
  const Carried message{{kReal, kSimulated, 0, Time(), Heartbeat{}}, {}};
  while (number < 5101) ASSERT_TRUE(say(message));
  ASSERT_TRUE(comes([&] { return station.statistics().heard == number; }));
  EXPECT_EQ(station.statistics().take_full, 100u);
  const auto taken = station.take(Time());
  ASSERT_EQ(taken.size(), 5001u);
  EXPECT_TRUE(std::holds_alternative<NeighbourChange>(taken[0]));
}

TEST(ModemLink, HasSentNothingWhereNobodyIs) {
  ModemLink station(options_of("udpin:0", 1, {kStation, kSimulated}));
  ASSERT_TRUE(station.start().ok());
  EXPECT_TRUE(comes([&] { return station.statistics().unsent > 1; }));
  EXPECT_EQ(station.statistics().sent, 0u);
}

TEST(ModemLink, CountsDamagedFramesOfLinesThatAreGoneToo) {
  ModemLink station(options_of("tcpin:0", 1, {kStation, kSimulated}));
  const std::string place = place_of(station, "tcp");
  auto frame = in_frame(said_by_real(1, 1, Advertisement{0, {kReal.value}}));
  frame[2] ^= std::byte{0x40};
  for (std::uint64_t k = 1; k <= 2; ++k) {
    Sender sender(place);
    sender.send(frame);
    EXPECT_TRUE(comes([&] { return station.statistics().damaged == k; }));
  }
}

}  // namespace
}  // namespace skein::modem::modem_link_test
