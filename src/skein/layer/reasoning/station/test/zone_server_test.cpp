// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/station/zone_server.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "skein/base/random.h"

namespace skein::reasoning::zone_server_test {
namespace {

Zone square(const std::string& name) {
  Zone zone{.area = geo::Ring{{0, 0}, {100, 0}, {100, 100}, {0, 100}}};
  zone.name = name;
  return zone;
}

ZoneChange requested(bool on, const Zone& zone) {
  return {0, on, zone};
}

ZoneChange by_name(bool on, const std::string& name) {
  Zone zone;
  zone.name = name;
  return {0, on, zone};
}

struct Server {
  explicit Server(ZoneServerOptions options = {})
      : server(with_team(std::move(options))) {}

  static ZoneServerOptions with_team(ZoneServerOptions options) {
    options.team = {EntityId{1}, EntityId{2}};
    return options;
  }
  AgentOutput at(double time, const std::vector<ZoneChange>& requests = {}) {
    const std::vector<Command> commands(requests.begin(), requests.end());
    AgentInput in;
    in.commands = commands;
    in.now = Time::from_seconds(time);
    in.inbox = inbox;
    AgentOutput out;
    server.step(in, heard, out);
    inbox.clear();
    return out;
  }
  void report(std::uint32_t who, std::uint32_t knows) {
    AircraftReport report;
    report.zone_changes = knows;
    inbox.emplace_back().from = EntityId{who};
    inbox.back().content = report;
  }
  std::vector<Message> heard, inbox;
  ZoneServer server;
};

// "number>to" of all zone messages.
std::string sent(const AgentOutput& out) {
  std::string all;
  for (const Message& message : out.outbox)
    all += std::to_string(std::get<ZoneChange>(message.content).number) + ">" +
           std::to_string(message.to.value) + " ";
  return all;
}

std::vector<ZoneChange> recorded(const AgentOutput& out) {
  std::vector<ZoneChange> all;
  for (const AgentRecord& record : out.records)
    all.push_back(std::get<ZoneChange>(record));
  return all;
}

std::string kinds(const AgentOutput& out) {
  std::string all;
  for (const Event& event : out.events) all.append(event.kind.name()).append(" ");
  return all;
}

TEST(ZoneServer, NumbersRequestsAndSendsThemToAll) {
  Server server;
  const AgentOutput out =
      server.at(1, {requested(true, square("a")), requested(true, square("b"))});
  EXPECT_EQ(sent(out), "1>1 1>2 2>1 2>2 ");
  EXPECT_EQ(kinds(out), "zone-on zone-on ");
  ASSERT_EQ(recorded(out).size(), 2u);
  EXPECT_EQ(recorded(out)[1].number, 2u);
  // The station's own agent receives the numbered ones in the same step, and no request.
  ASSERT_EQ(server.heard.size(), 2u);
  EXPECT_EQ(std::get<ZoneChange>(server.heard[0].content).number, 1u);
  const AgentOutput off = server.at(2, {by_name(false, "a")});
  EXPECT_EQ(sent(off), "3>1 3>2 ");
  EXPECT_FALSE(recorded(off).at(0).on);
}

TEST(ZoneServer, SendsAgainWhatIsNotAcknowledged) {
  Server server;
  server.at(0, {requested(true, square("a"))});
  server.report(1, 0);
  server.report(2, 1);
  EXPECT_EQ(sent(server.at(1)), "");
  server.report(1, 0);
  EXPECT_EQ(sent(server.at(2)), "1>1 ");
  server.at(2.5, {requested(true, square("b"))});
  server.report(1, 0);
  server.report(2, 2);
  EXPECT_EQ(sent(server.at(4.5)), "1>1 2>1 ");
  server.report(1, 2);
  const AgentOutput all = server.at(5);
  EXPECT_EQ(sent(all), "");
  EXPECT_EQ(kinds(all), "zones-known ");
  for (double t = 6; t < 60; ++t) EXPECT_EQ(sent(server.at(t)), "");
}

TEST(ZoneServer, TriesThoseWhoseLinkIsDownNowAndThen) {
  Server server;
  server.at(0, {requested(true, square("a"))});
  int tries = 0;
  for (double t = 1; t <= 60; ++t) tries += sent(server.at(t)) == "1>1 1>2 ";
  EXPECT_EQ(tries, 6);
}

TEST(ZoneServer, RefusesWhatCannotBeUsed) {
  Server server;
  Zone bad = square("bad");
  bad.area = geo::Ring{{0, 0}, {10, 10}, {10, 0}, {0, 10}};
  Zone nan = square("nan");
  nan.floor_msl = std::numeric_limits<double>::quiet_NaN();
  for (const ZoneChange& change :
       {requested(true, square("")), requested(true, bad), requested(true, nan),
        by_name(true, "never drawn"), by_name(false, "never drawn")}) {
    const AgentOutput out = server.at(1, {change});
    EXPECT_EQ(kinds(out), "zone-refused ") << change.zone.name;
    EXPECT_EQ(sent(out), "");
  }
}

TEST(ZoneServer, KnowsZonesByName) {
  ZoneServerOptions options;
  options.known = {square("first")};
  options.drawn = {square("first"), square("later")};
  Server server(options);
  EXPECT_EQ(kinds(server.at(1, {by_name(false, "first")})), "zone-off ");
  const AgentOutput on = server.at(2, {by_name(true, "later")});
  ASSERT_EQ(recorded(on).size(), 1u);
  EXPECT_EQ(std::get<geo::Ring>(recorded(on)[0].zone.area).size(), 4u);
  // Turned: rings are sent positive.
  Zone turned = square("turned");
  std::reverse(std::get<geo::Ring>(turned.area).begin(),
               std::get<geo::Ring>(turned.area).end());
  const AgentOutput out = server.at(3, {requested(true, turned)});
  EXPECT_GT(geo::signed_area(std::get<geo::Ring>(recorded(out)[0].zone.area)), 0);
}

// Whatever is lost, in the end both know the same zones as the server.
TEST(ZoneServer, ALinkThatLosesMostLeavesNobodyBehind) {
  Server server;
  ZoneSet books[2];
  RandomStream random(1, 1, Purpose::kTest);
  for (int step = 0; step < 400; ++step) {
    std::vector<ZoneChange> requests;
    if (step % 40 == 0 && step < 200)
      requests.push_back(
          requested(true, square(std::string(1, static_cast<char>('a' + step / 40)))));
    for (std::uint32_t who : {0u, 1u})
      if (random.uniform() < 0.2) server.report(who + 1, books[who].complete_to());
    for (const Message& message : server.at(step, requests).outbox)
      if (random.uniform() < 0.2)
        books[message.to.value - 1].take(std::get<ZoneChange>(message.content));
  }
  for (const ZoneSet& known : books) {
    EXPECT_EQ(known.complete_to(), 5u);
    EXPECT_EQ(known.zones().size(), 5u);
  }
}

}  // namespace
}  // namespace skein::reasoning::zone_server_test
