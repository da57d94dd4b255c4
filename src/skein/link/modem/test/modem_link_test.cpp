#include "skein/link/modem/modem_link.h"

#include <gtest/gtest.h>

#include <functional>

namespace skein::modem {
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

}  // namespace
}  // namespace skein::modem
