// SPDX-License-Identifier: Apache-2.0
// A world and agents that meet over sockets of this machine.
#include "skein/link/world_link/entity_links.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <functional>
#include <stdexcept>

#include "skein/link/world_link/world_client.h"

namespace skein::world_link::entity_links_test {
namespace {

using Kind = LinkChange::Kind;

const Time kRunNow = Time::from_seconds(50), kAgentNow = Time::from_seconds(7);

transport::EndpointAddress address(const std::string& text) {
  return transport::parse_endpoint(text).value();
}

// The world's side, with one entity.
struct World {
  explicit World(const std::string& at, const std::string& scenario = "same")
      : links("test world", scenario) {
    const auto number = links.add({"scout-1", address(at)});
    port = links.port(number.value());
    place = links.start().value().at(0);
  }
  // Where an agent meets it.
  transport::EndpointAddress door() const {
    const bool udp = place.compare(0, 3, "udp") == 0;
    return address((udp ? "udpout" : "tcp") + place.substr(place.find(':')));
  }
  void look() {
    std::vector<VehicleReport> reports;
    port->receive(kRunNow, reports);
    for (VehicleReport& report : reports) {
      if (const auto* change = std::get_if<LinkChange>(&report))
        changes.push_back(change->kind);
      else
        said.push_back(std::get<EntityReport>(report).said);
    }
  }

  EntityLinks links;
  std::unique_ptr<EntityPort> port;
  std::string place;
  std::vector<Kind> changes;
  std::vector<EntitySaying> said;
};

WorldClientOptions scout(const transport::EndpointAddress& world) {
  WorldClientOptions options;
  options.entity = "scout-1";
  options.self = EntityId{1};
  options.entities = 3;
  options.software = "test agent";
  options.scenario = "same";
  options.world = world;
  return options;
}

bool wait(const std::function<bool()>& until) {
  for (int k = 0; k < 1000; ++k) {
    if (until()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

class EntityLinksOver : public testing::TestWithParam<const char*> {};

TEST_P(EntityLinksOver, CarryStatesMessagesAndSamplesWithTheirAges) {
  World world(GetParam());
  WorldClient agent(scout(world.door()));
  ASSERT_TRUE(agent.start().ok());
  ASSERT_TRUE(wait([&] { return world.look(), !world.changes.empty(); }));
  EXPECT_EQ(world.changes, std::vector{Kind::kUp});

  // Half a second old when it is said.
  const Time age = Time::from_seconds(0.5);
  RemoteState state;
  state.nav.time = kAgentNow - age;
  state.nav.p_N = {1, 2, -3};
  agent.say(kAgentNow, state);
  agent.say(kAgentNow, Message{{}, EntityId{0}, 4, kAgentNow, Heartbeat{}});
  ASSERT_TRUE(wait([&] { return world.look(), world.said.size() == 2; }));
  const auto came = [&](auto which) -> const auto& {
    for (const EntitySaying& saying : world.said)
      if (const auto* found = std::get_if<decltype(which)>(&saying)) return *found;
    throw std::runtime_error("it did not come");
  };
  // The way here takes milliseconds; a machine that is busy may take longer.
  EXPECT_EQ(came(RemoteState()).nav.p_N, state.nav.p_N);
  EXPECT_NEAR((kRunNow - came(RemoteState()).nav.time).seconds(), 0.5, 0.4);
  EXPECT_EQ(came(Message()).number, 4u);

  PayloadReadings readings;
  readings.samples.emplace_back(FireSample{kRunNow - age, 0, true});
  const Message order{EntityId{0}, EntityId{1}, 7, kRunNow, Task{3, Hold{}}};
  std::vector<SensorSample> samples;
  std::vector<Message> messages;
  world.port->send(kRunNow, readings);
  world.port->send(kRunNow, order);
  world.port->send(kRunNow, Message{EntityId{0}, EntityId{2}, 8, kRunNow, Heartbeat{}});
  world.port->send(kRunNow, Command{FaultCommand{"scout-1", "motor 1", true}});
  world.port->send(kRunNow, Command{PauseCommand{true}});
  ASSERT_TRUE(wait([&] {
    agent.take_samples(kAgentNow, samples);
    agent.receive(kAgentNow, messages);
    return samples.size() == 1 && messages.size() == 1;
  }));
  EXPECT_NEAR((kAgentNow - std::get<FireSample>(samples[0]).time).seconds(), 0.5, 0.4);
  EXPECT_EQ(std::get<Task>(messages[0].content).number, 3u);
  std::vector<Command> commands;
  ASSERT_TRUE(wait([&] {
    for (Command& command : agent.take_commands()) commands.push_back(command);
    return !commands.empty();
  }));
  ASSERT_EQ(commands.size(), 1u) << "the clock is the world's";
  EXPECT_TRUE(std::holds_alternative<FaultCommand>(commands[0]));
}

INSTANTIATE_TEST_SUITE_P(Sockets, EntityLinksOver, testing::Values("udpin:0", "tcpin:0"));

TEST(EntityLinks, RefuseAnAgentOfAnotherScenarioOrName) {
  World world("udpin:0", "another");
  WorldClient agent(scout(world.door()));
  ASSERT_TRUE(agent.start().ok());
  std::vector<SessionChange> changes;
  ASSERT_TRUE(wait([&] { return changes = agent.take_changes(), !changes.empty(); }));
  EXPECT_EQ(changes[0].kind, SessionChange::Kind::kRefused);
  EXPECT_NE(changes[0].text.find("another scenario"), std::string::npos);
  WorldClientOptions other = scout(world.door());
  other.entity = "scout-2";
  WorldClient intruder(other);
  ASSERT_TRUE(intruder.start().ok());
  ASSERT_TRUE(wait([&] { return changes = intruder.take_changes(), !changes.empty(); }));
  EXPECT_NE(changes[0].text.find("no agent of \"scout-2\""), std::string::npos);
  world.look();
  EXPECT_TRUE(world.changes.empty());
}

// A run that is paused for long takes nothing in: what is lost are the oldest messages.
TEST(EntityLinks, KeepChangesOfTheLinkHoweverMuchWaits) {
  World world("udpin:0");
  WorldClient agent(scout(world.door()));
  ASSERT_TRUE(agent.start().ok());
  ASSERT_TRUE(wait([&] {
    std::vector<SessionChange> changes = agent.take_changes();
    return !changes.empty();
  }));
  for (std::uint32_t k = 0; k < 2500; ++k) {
    agent.say(kAgentNow, Message{{}, EntityId{0}, k, kAgentNow, Heartbeat{}});
    if (k % 50 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  const auto last_came = [&] {
    world.look();
    return !world.said.empty() && std::get<Message>(world.said.back()).number == 2499;
  };
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  ASSERT_TRUE(wait(last_came));
  EXPECT_GT(std::get<Message>(world.said.front()).number, 0u) << "not all had room";
  EXPECT_EQ(world.changes, std::vector{Kind::kUp});
}

TEST(EntityLinks, MeetAnAgentAndAWorldThatBeginAnew) {
  auto world = std::make_unique<World>("udpin:0");
  const transport::EndpointAddress door = world->door();
  const std::string place = world->place;
  auto agent = std::make_unique<WorldClient>(scout(door));
  ASSERT_TRUE(agent->start().ok());
  ASSERT_TRUE(wait([&] { return world->look(), world->changes.size() == 1; }));
  agent = nullptr;  // says bye
  ASSERT_TRUE(wait([&] { return world->look(), world->changes.size() == 2; }));
  agent = std::make_unique<WorldClient>(scout(door));
  ASSERT_TRUE(agent->start().ok());
  ASSERT_TRUE(wait([&] { return world->look(), world->changes.size() == 3; }));
  EXPECT_EQ(world->changes, (std::vector{Kind::kUp, Kind::kDown, Kind::kUp}));
  world = nullptr;
  std::vector<SessionChange::Kind> seen;
  const auto look = [&] {
    for (const SessionChange& change : agent->take_changes()) seen.push_back(change.kind);
    return seen.size();
  };
  ASSERT_TRUE(wait([&] { return look() == 2; }));
  agent->say(kAgentNow, Message{{}, EntityId{0}, 4, kAgentNow, Heartbeat{}});
  world = std::make_unique<World>(place);
  ASSERT_TRUE(wait([&] { return world->look(), world->said.size() == 1; }));
  ASSERT_TRUE(wait([&] { return look() == 3; }));
  using Change = SessionChange::Kind;
  EXPECT_EQ(seen, (std::vector{Change::kUp, Change::kDown, Change::kUp}));
}

TEST(WorldClient, ReachesTheTeamWithoutAWorld) {
  const std::string port = std::to_string(20'000 + getpid() % 20'000);
  WorldClientOptions a, b;
  a.team = b.team = {address("udpmulti:239.255.77.3:" + port)};
  a.entities = b.entities = 3;
  a.self = EntityId{1};
  b.self = EntityId{2};
  WorldClient first(a), second(b);
  ASSERT_TRUE(first.start().ok());
  ASSERT_TRUE(second.start().ok());
  std::vector<Message> came;
  ASSERT_TRUE(wait([&] {
    first.say(kAgentNow, Message{{}, EntityId{2}, 5, kAgentNow, Heartbeat{}});
    second.receive(kAgentNow, came);
    return !came.empty();
  }));
  EXPECT_EQ(came[0].from, EntityId{1});
}

TEST(FrameReader, TakesPacketsHoweverTheyAreCut) {
  const std::vector<std::byte> one(5, std::byte{1}), two(300, std::byte{2});
  std::vector<std::byte> all = framed(one);
  const std::vector<std::byte> more = framed(two);
  all.insert(all.end(), more.begin(), more.end());
  for (const std::size_t piece : {1u, 3u, 7u, 1000u}) {
    FrameReader reader;
    std::vector<std::vector<std::byte>> packets;
    for (std::size_t at = 0; at < all.size(); at += piece)
      reader.read(std::span(all).subspan(at, std::min(piece, all.size() - at)),
                  [&](auto bytes) { packets.emplace_back(bytes.begin(), bytes.end()); });
    EXPECT_EQ(packets, (std::vector{one, two}));
  }
  FrameReader reader;
  int packets = 0;
  const std::vector<std::byte> nonsense(100, std::byte{0xff});
  reader.read(nonsense, [&](auto) { ++packets; });
  reader.read(framed(one), [&](auto) { ++packets; });
  EXPECT_TRUE(reader.broken());
  EXPECT_EQ(packets, 0);
}

}  // namespace
}  // namespace skein::world_link::entity_links_test
