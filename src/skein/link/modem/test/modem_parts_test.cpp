// SPDX-License-Identifier: Apache-2.0
#include "skein/link/modem/modem_parts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <thread>

namespace skein::modem::modem_parts_test {
namespace {

constexpr EntityId kStation{0}, kReal{1}, kSimulated{2};

struct Said {
  std::vector<Message> sent;
  std::vector<EntityInput> inputs;
};

struct Notes final : Radio {
  explicit Notes(Said& into) : said(into) {}
  void send(const Message& message) override { said.sent.push_back(message); }
  void deliver(Time, RadioNews& news) override {
    for (const Message& message : said.sent) news.ended.push_back({message});
  }
  Said& said;
};

struct Desk final : EntityPort {
  explicit Desk(Said& into) : said(into) {}
  void receive(Time, std::vector<VehicleReport>& out) override {
    out.emplace_back(LinkChange{LinkChange::Kind::kUp, ""});
    out.emplace_back(
        EntityReport{Message{EntityId{1}, EntityId{0}, 0, Time(), Heartbeat{}}});
  }
  void send(Time, EntityInput input) override { said.inputs.push_back(std::move(input)); }
  Said& said;
};

ModemLinkOptions options_of() {
  ModemLinkOptions options;
  options.endpoint = transport::parse_endpoint("udpin:0").value();
  options.peer.identities = {kStation, kSimulated};
  options.peer.entities = 3;
  return options;
}

Message from(EntityId who) {
  return {who, kStation, 0, Time(), Heartbeat{}};
}

TEST(ModemRadio, PutsWhatIsHeardOnTheMedium) {
  Said medium;
  ModemLink link(options_of());
  ModemRadio radio({std::make_unique<Notes>(medium), nullptr, false}, link);
  radio.send(from(kReal));
  radio.send(from(kSimulated));
  EXPECT_EQ(medium.sent.size(), 2u);
}

TEST(ModemRadio, CarriesRealOnesByRangeWhereItDoesNotHear) {
  Said medium, range;
  ModemLink link(options_of());
  ModemRadio radio(
      {std::make_unique<Notes>(medium), std::make_unique<Notes>(range), false}, link);
  radio.send(from(kReal));
  radio.send(from(kSimulated));
  ASSERT_TRUE(medium.sent.size() == 1 && range.sent.size() == 1);
  EXPECT_EQ(range.sent[0].from, kReal);
  RadioNews news;
  radio.deliver(Time(), news);
  EXPECT_EQ(news.ended.size(), 2u);
}

TEST(ModemPort, SendsMessagesByTheModemAndTheRestByTheLink) {
  Said link_said;
  ModemLink link(options_of());
  ModemPort port(std::make_unique<Desk>(link_said), link, kReal);
  port.send(Time(), from(kSimulated));
  port.send(Time(), PayloadReadings{});
  EXPECT_EQ(link_said.inputs.size(), 1u);
  std::vector<VehicleReport> reports;
  port.receive(Time(), reports);
  ASSERT_EQ(reports.size(), 1u) << "a message that the modem has not heard is none";
  EXPECT_TRUE(std::holds_alternative<LinkChange>(reports[0]));
}

TEST(AgentModemRadio, HasALoadWhereItsRateIsKnown) {
  for (const double rate : {0.0, 5000.0}) {
    auto options = options_of();
    ModemLink station(options);
    const auto places = station.start();
    ASSERT_TRUE(places.ok());
    options.endpoint =
        *transport::counterpart(transport::parse_endpoint(places.value().at(0)).value());
    options.peer.hw = 2;
    options.peer.identities = {kReal};
    options.peer.advertisement_period = Time::from_seconds(0.1);
    options.peer.queue.rate = rate;
    ModemLink link(options);
    AgentModemRadio radio(link, kReal, {"station", "real", "simulated"});
    ASSERT_TRUE(link.start().ok());
    EXPECT_EQ(radio.status(kReal).shared, rate > 0);
    double load = 0;
    for (int k = 0; k < 200 && load == 0; ++k) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
      load = radio.status(kReal).load;
    }
    EXPECT_EQ(load > 0, rate > 0) << "its own advertisements are a load";
  }
}

TEST(ModemParts, SayThatTwoModemsHaveOneAddress) {
  Said said;
  auto options = options_of();
  ModemLink station(options);
  const auto places = station.start();
  ASSERT_TRUE(places.ok());
  options.endpoint =
      *transport::counterpart(transport::parse_endpoint(places.value().at(0)).value());
  options.peer.session = 2;
  options.peer.identities = {kReal};
  ModemLink link(options);
  ModemPort port(std::make_unique<Desk>(said), station, kReal);
  AgentModemRadio radio(link, kReal, {"station", "real", "simulated"});
  ASSERT_TRUE(link.start().ok());
  std::vector<VehicleReport> reports;
  RadioNews news;
  const auto clashes = [](const VehicleReport& report) {
    const auto* event = std::get_if<OutsideEvent>(&report);
    return event && event->kind == EventKind::kModemClash;
  };
  for (int k = 0; k < 500; ++k) {
    port.receive(Time(), reports);
    radio.deliver(Time(), news);
    if (std::ranges::any_of(reports, clashes) && !news.events.empty()) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  EXPECT_EQ(std::ranges::count_if(reports, clashes), 1);
  ASSERT_EQ(news.events.size(), 1u);
  EXPECT_EQ(news.events[0].kind, EventKind::kModemClash);
  EXPECT_EQ(news.events[0].text, "another modem has the address of its own, hw 1");
}

TEST(ModemParts, SayThatNoLineIsOpen) {
  Said said;
  auto options = options_of();
  options.endpoint = transport::parse_endpoint("serial:/nowhere/modem").value();
  ModemLink station(options);
  options.peer.identities = {kReal};
  ModemLink link(options);
  ModemPort port(std::make_unique<Desk>(said), station, kReal);
  AgentModemRadio radio(link, kReal, {"station", "real", "simulated"});
  ASSERT_TRUE(station.start().ok() && link.start().ok());
  std::vector<VehicleReport> reports;
  port.receive(Time(), reports);
  ASSERT_EQ(reports.size(), 2u);
  EXPECT_EQ(std::get<OutsideEvent>(reports[1]).kind, EventKind::kModemClosed);
  EXPECT_EQ(std::get<OutsideEvent>(reports[1]).text,
            "no line to the ground station's is open, hw 1");
  RadioNews news;
  radio.deliver(Time(), news);
  ASSERT_EQ(news.events.size(), 1u);
  EXPECT_EQ(news.events[0].kind, EventKind::kModemClosed);
}

}  // namespace
}  // namespace skein::modem::modem_parts_test
