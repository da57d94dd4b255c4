#include "skein/link/modem/modem_parts.h"

#include <gtest/gtest.h>

namespace skein::modem {
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
  ModemRadio radio({std::make_unique<Notes>(medium), nullptr, nullptr}, link);
  radio.send(from(kReal));
  radio.send(from(kSimulated));
  EXPECT_EQ(medium.sent.size(), 2u);
}

TEST(ModemRadio, CarriesRealOnesByRangeWhereItDoesNotHear) {
  Said medium, range;
  ModemLink link(options_of());
  ModemRadio radio(
      {std::make_unique<Notes>(medium), std::make_unique<Notes>(range), nullptr}, link);
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
  EXPECT_EQ(reports.size(), 1u);
}

}  // namespace
}  // namespace skein::modem
