// SPDX-License-Identifier: Apache-2.0
// Real vehicles are told of one another over real sockets.
#include "skein/link/vehicle_links/vehicle_links.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <map>
#include <memory>

#include "skein/link/mavlink/constants.h"
#include "skein/link/mavlink/payload.h"
#include "skein/link/vehicle_links/mailbox.h"
#include "skein/link/vehicle_links/test/stand_ins.h"
#include "skein/link/vehicle_links/traffic_feed.h"
#include "skein/link/vehicle_links/vehicle_feed.h"

namespace skein::vehicle_links::vehicle_links_test {
namespace {

using namespace std::chrono_literals;

LinkedVehicle linked(std::uint8_t system, const std::string& name) {
  LinkedVehicle vehicle;
  vehicle.endpoint.address = transport::UdpServer{};
  vehicle.client.system = system;
  vehicle.client.hovers = true;
  vehicle.name = name;
  vehicle.traffic = TrafficOptions{};
  return vehicle;
}

// How often each was told of each address.
std::map<std::pair<std::size_t, std::uint32_t>, int> told(const StandIns& stand_ins) {
  std::map<std::pair<std::size_t, std::uint32_t>, int> counts;
  for (const StandIns::Heard& each : stand_ins.heard)
    ++counts[{each.by, each.what.ICAO_address}];
  return counts;
}

TEST(VehicleLinks, VehiclesAreToldOfOneAnotherAndOfSimulatedAircraft) {
  const auto frame = geo::LocalFrame::at({47.0, 8.0, 0}).value();
  VehicleLinks links(frame);
  ASSERT_TRUE(links.add(linked(1, "a")).ok());
  ASSERT_TRUE(links.add(linked(2, "b")).ok());
  LinkedVehicle alone = linked(3, "c");
  alone.traffic.reset();
  ASSERT_TRUE(links.add(alone).ok());
  EXPECT_TRUE(links.needs_traffic());
  TrafficFeed feed(links, {"wing-1", "wing-2"});
  auto port = links.port(0);
  const auto places = links.start();
  ASSERT_TRUE(places.ok());
  StandIns vehicles(frame, places.value().front());
  vehicles.add(1, {0, 0});
  vehicles.add(2, {500, 0});
  vehicles.add(3, {0, 500});
  feed.hear(EntityRecord{EntityId{4}, "wing-1", "aircraft"});
  feed.hear(EntityRecord{EntityId{5}, "wing-2", "aircraft"});
  EstimateRecord near{EntityId{4}, {}, {}}, far{EntityId{5}, {}, {}};
  near.nav.p_N = {100, 100, -50};
  far.nav.p_N = {20'000, 0, -50};
  for (int k = 0; k < 20; ++k) {
    vehicles.run(100ms);
    feed.hear(near);
    feed.hear(far);
    feed.publish(Time::from_seconds(0.1 * k));
  }
  const auto counts = told(vehicles);
  const auto count = [&](std::size_t who, const char* of) {
    const auto found = counts.find({who, icao_address(of)});
    return found == counts.end() ? 0 : found->second;
  };
  for (const std::size_t k : {std::size_t{0}, std::size_t{1}}) {
    EXPECT_GE(count(k, k == 0 ? "b" : "a"), 2);
    EXPECT_LE(count(k, k == 0 ? "b" : "a"), 5);  // twice a second
    EXPECT_EQ(count(k, k == 0 ? "a" : "b"), 0);  // of itself
    EXPECT_GE(count(k, "c"), 2);
    EXPECT_GE(count(k, "wing-1"), 2);
    EXPECT_EQ(count(k, "wing-2"), 0);
  }
  for (const char* of : {"a", "b", "c", "wing-1"}) EXPECT_EQ(count(2, of), 0) << of;

  std::vector<VehicleReport> reports;
  port->receive(Time(), reports);
  EXPECT_TRUE(std::any_of(reports.begin(), reports.end(), [](const VehicleReport& r) {
    return std::holds_alternative<VehicleMotion>(r);
  }));
}

// A minute of simulated time in far less: reports are counted by that time.
TEST(VehicleLinks, InLockStepTrafficGoesByTheClockOfTheRun) {
  const auto frame = geo::LocalFrame::at({47.0, 8.0, 0}).value();
  VehicleLinks links(frame);
  const auto clock = std::make_shared<std::atomic<std::int64_t>>(0);
  LinkedVehicle vehicle = linked(1, "a");
  vehicle.clock_ns = clock;
  ASSERT_TRUE(links.add(vehicle).ok());
  TrafficFeed feed(links, {"wing-1"});
  auto port = links.port(0);
  const auto places = links.start();
  ASSERT_TRUE(places.ok());
  StandIns vehicles(frame, places.value().front());
  vehicles.add(1, {0, 0});
  feed.hear(EntityRecord{EntityId{4}, "wing-1", "aircraft"});
  EstimateRecord near{EntityId{4}, {}, {}};
  near.nav.p_N = {100, 100, -50};
  std::vector<VehicleReport> reports;
  constexpr int kSteps = 600;
  for (int k = 0; k < kSteps; ++k) {
    const Time now = Time::from_seconds(0.1 * k);
    *clock = now.ns();
    links.set_simulated(now);
    vehicles.step();
    port->receive(now, reports);
    feed.hear(near);
    feed.publish(now);
  }
  vehicles.run(200ms);
  const auto counts = told(vehicles);
  const auto found = counts.find({0, icao_address("wing-1")});
  ASSERT_NE(found, counts.end());
  // Twice a second of a minute; a few may come before it is heard, or be lost by UDP.
  EXPECT_GE(found->second, 110);
  EXPECT_LE(found->second, 121);
}

TEST(VehicleLinks, OfWhatIsGoodForAMomentOnlyTheNewestGoesOutAndAllIsCounted) {
  const auto frame = geo::LocalFrame::at({47.0, 8.0, 0}).value();
  VehicleLinks links(frame);
  ASSERT_TRUE(links.add(linked(1, "a")).ok());
  auto port = links.port(0);
  const auto places = links.start();
  ASSERT_TRUE(places.ok());
  StandIns vehicles(frame, places.value().front());
  vehicles.add(1, {0, 0});
  vehicles.run(500ms);
  constexpr std::uint64_t kSent = 100;
  for (std::uint64_t k = 0; k < kSent; ++k) {
    port->send(0, ObstacleDistances{});
    port->send(0, PositionFix{});
  }
  vehicles.run(6s);  // figures come each 5 s
  std::vector<VehicleReport> reports;
  port->receive(Time(), reports);
  FeedHealth last;
  for (const VehicleReport& report : reports)
    if (const auto* health = std::get_if<FeedHealth>(&report)) last = *health;
  EXPECT_EQ(last.obstacles + last.obstacles_limited, kSent);
  EXPECT_EQ(last.fixes + last.fixes_limited, kSent);
  EXPECT_EQ(vehicles.obstacles, last.obstacles);
  EXPECT_EQ(vehicles.fixes, last.fixes);
  EXPECT_GE(last.obstacles, 1u);
}

TEST(VehicleLinks, WhoSharesAConnectionDoesNotSeeItselfThere) {
  const auto frame = geo::LocalFrame::at({47.0, 8.0, 0}).value();
  VehicleLinks links(frame);
  const std::array<const char*, 3> names = {"a", "b", "c"};
  for (std::uint8_t k = 0; k < 3; ++k)
    ASSERT_TRUE(links.add(linked(static_cast<std::uint8_t>(k + 1), names[k])).ok());
  const auto places = links.start();
  ASSERT_TRUE(places.ok());
  StandIns vehicles(frame, places.value().front());
  vehicles.add(1, {0, 0});
  vehicles.add(2, {500, 0}, true);
  vehicles.add(3, {0, 500});
  vehicles.run(2s);
  for (const StandIns::Heard& each : vehicles.heard) {
    const bool alone = each.by == 2;
    EXPECT_EQ(each.what.ICAO_address == icao_address("c"), !alone);
  }
  EXPECT_GE(vehicles.heard.size(), 6u);
}

TEST(VehicleLinks, TwoOfOneNumberAtOneEndpointAreRefused) {
  VehicleLinks links(geo::LocalFrame::at({47.0, 8.0, 0}).value());
  EXPECT_TRUE(links.add(linked(1, "a")).ok());
  EXPECT_FALSE(links.add(linked(1, "b")).ok());
}

TEST(VehicleLinks, AnEndpointIsSignedOrNotAndOfVehiclesOrStations) {
  VehicleLinks links(geo::LocalFrame::at({47.0, 8.0, 0}).value());
  ASSERT_TRUE(links.add(linked(1, "a")).ok());
  LinkedVehicle other = linked(2, "b");
  other.endpoint.is_signed = true;
  EXPECT_FALSE(links.add(other).ok());
  links.add_station(linked(1, "a").endpoint);
  EXPECT_FALSE(links.start().ok());
}

TEST(VehicleLinks, ASimulatedAircraftWithTheNumberOfARealOneIsRefused) {
  VehicleLinks links(geo::LocalFrame::at({47.0, 8.0, 0}).value());
  ASSERT_TRUE(links.add(linked(2, "real")).ok());
  vehicle_services::VehicleServerOptions shown;
  shown.system = 1;
  links.show(shown);
  links.show(shown);  // has the next number
  links.add_station({transport::parse_endpoint("udpin:0").value()});
  const auto started = links.start();
  ASSERT_FALSE(started.ok());
  EXPECT_NE(started.error().text().find("real has system id 2"), std::string::npos)
      << started.error().text();
}

// A ground station at the far end of a socket, which does not sign.
class PlainStation final : public transport::ChannelListener {
 public:
  explicit PlainStation(const std::string& server) {
    const std::string at = "udpout" + server.substr(server.find(':'));
    EXPECT_TRUE(endpoints_.open(transport::parse_endpoint(at).value()).ok());
  }

  template <class T>
  void send(const T& message) {
    out_.send(channel_, message);
  }
  void run(std::chrono::milliseconds duration) { endpoints_.run_for(duration); }

  std::vector<mavlink::CommandAck> acks;
  int texts = 0, heartbeats = 0;

 private:
  void opened(transport::ChannelId channel, transport::EndpointId,
              const std::string&) override {
    channel_ = channel;
  }
  void closed(transport::ChannelId, const std::string&) override {}
  void received(transport::ChannelId, std::span<const std::byte> bytes) override {
    parser_.read(bytes, [&](const mavlink::Frame& frame) { take(frame); });
  }
  void take(const mavlink::Frame& frame) {
    if (frame.id() == mavlink::kFacts<mavlink::CommandAck>.id)
      acks.push_back(mavlink::unpack<mavlink::CommandAck>(frame.payload()));
    heartbeats += frame.id() == mavlink::kFacts<mavlink::Heartbeat>.id;
    if (frame.id() != mavlink::kFacts<mavlink::Statustext>.id) return;
    const auto text = mavlink::unpack<mavlink::Statustext>(frame.payload());
    texts += mavlink::text_of(text.text).find("must be signed") != std::string::npos;
  }

  transport::ChannelId channel_ = 0;
  mavlink::FrameParser parser_;
  transport::Endpoints endpoints_{*this};
  vehicle_services::Outbox out_{
      255, 190, [this](transport::ChannelId channel, std::span<const std::byte> bytes) {
        endpoints_.send(channel, bytes);
      }};
};

// By default a station on this machine may do all; where it may only watch, its orders
// are denied, it is told why once, and what it reads comes as before.
TEST(VehicleLinks, UnsignedOrdersAreDeniedWhereOnlyTelemetryIsAllowed) {
  for (const bool limited : {false, true}) {
    VehicleLinks links(geo::LocalFrame::at({47.0, 8.0, 0}).value());
    LinkEndpoint at{transport::UdpServer{}};
    if (limited) at.unsigned_frames = mavlink::UnsignedFrames::kTelemetry;
    links.add_station(at);
    vehicle_services::VehicleServerOptions vehicle;
    vehicle.system = 7;
    vehicle.hovers = true;
    const std::size_t shown = links.show(vehicle);
    LinkedVehicle real = linked(9, "real-1");
    real.endpoint.address = transport::parse_endpoint("tcpin:127.0.0.1:0").value();
    ASSERT_TRUE(links.add(real).ok());
    ShownAircraft aircraft;
    aircraft.name = "scout-1";
    aircraft.server = shown;
    VehicleFeed feed(links, {aircraft});
    const auto places = links.start();
    ASSERT_TRUE(places.ok());
    vehicle_services::VehicleSnapshot snapshot;
    snapshot.condition.on_ground = true;
    links.update(shown, snapshot);
    PlainStation station(places.value().back());
    station.send(mavlink::Heartbeat{});
    mavlink::CommandLong arm;
    arm.target_system = 7;
    arm.target_component = 1;
    arm.command = static_cast<std::uint16_t>(mavlink::CommandId::kArm);
    arm.param1 = 1;
    std::size_t requests = 0;
    for (int k = 0; k < 100 && (station.acks.size() < 3 || station.heartbeats == 0);
         ++k) {
      station.send(arm);
      mavlink::CommandLong to_real = arm;
      to_real.target_system = 9;
      station.send(to_real);
      station.run(50ms);
      requests += links.take_requests(shown).size();
    }
    ASSERT_GE(station.acks.size(), 3U);
    EXPECT_GT(station.heartbeats, 0);
    for (const auto& ack : station.acks)
      EXPECT_EQ(ack.result == static_cast<std::uint8_t>(mavlink::CommandResult::kDenied),
                limited);
    EXPECT_EQ(requests > 0, !limited);
    for (int k = 0; k < 40 && limited && station.texts == 0; ++k) station.run(50ms);
    EXPECT_EQ(station.texts, limited ? 1 : 0);
    // An event of the aircraft, simulated or real, once.
    std::map<std::string, int> refused;
    for (const CommandRecord& each : feed.commands())
      if (const auto* order = std::get_if<RefusedCommand>(&each.command))
        ++refused[order->aircraft];
    const std::map<std::string, int> both = {{"scout-1", 1}, {"real-1", 1}};
    EXPECT_EQ(refused, limited ? both : decltype(both)());
  }
}

// Nobody takes them for a quarter of an hour: the run is paused.
TEST(Mailbox, KeepsWhatSomebodyWaitsForHoweverMuchElseComes) {
  Mailbox mailbox;
  mailbox.put({LinkChange{LinkChange::Kind::kUp, "heard"}, RequestAnswer{7, {}, {}}});
  for (int k = 0; k < 20'000; ++k)
    mailbox.put({VehicleMotion(), VehicleCondition(), MissionProgress()});
  const std::vector<VehicleReport> kept = mailbox.take_reports();
  EXPECT_LE(kept.size(), 2000u);
  ASSERT_GE(kept.size(), 500u);
  EXPECT_TRUE(std::holds_alternative<LinkChange>(kept[0]));
  EXPECT_TRUE(std::holds_alternative<RequestAnswer>(kept[1]));
  for (int k = 0; k < 20'000; ++k)
    mailbox.put({LinkChange{LinkChange::Kind::kDuplicate, ""}});
  EXPECT_LE(mailbox.take_reports().size(), 2000u) << "a flood of these is bounded too";
}

}  // namespace
}  // namespace skein::vehicle_links::vehicle_links_test
