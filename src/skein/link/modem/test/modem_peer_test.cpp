#include "skein/link/modem/modem_peer.h"

#include <gtest/gtest.h>

#include <memory>

#include "skein/data/wire.h"

namespace skein::modem {
namespace {

constexpr EntityId kStation{0}, kFirst{1}, kSecond{2}, kSimulated{3}, kOther{4};

Time seconds(double s) {
  return Time::from_seconds(s);
}

Message message_of(EntityId from, EntityId to, std::uint64_t number, Time sent,
                   std::uint8_t word = 0) {
  return {from, to, number, sent, PluginPayload{"test", {word}}};
}

// A ground station with two simulated aircraft, and two real ones, whose modems share
// the air: everybody in range hears all, itself too.
class Air {
 public:
  explicit Air(GatewayMethod method = GatewayMethod::kFixed,
               PacedQueueOptions queue = {}) {
    ModemPeerOptions options;
    options.session = 10;
    options.entities = 5;
    options.method = method;
    options.overhears = true;
    options.queue = queue;
    options.identities = {kStation, kSimulated, kOther};
    add(options, Time());
    options.overhears = false;
    options.queue = {};
    for (const EntityId each : {kFirst, kSecond}) {
      options.hw = each.value + 10;
      options.identities = {each};
      // Clocks of others show more.
      add(options, seconds(1000.0 * each.value));
    }
    run(3);
  }

  ModemPeer& station() { return *peers[0]; }
  ModemPeer& first() { return *peers[1]; }
  ModemPeer& second() { return *peers[2]; }
  Time clock(std::size_t peer) const { return now + shifts[peer]; }

  void run(double duration) {
    for (const Time end = now + seconds(duration); now < end; now += seconds(0.01)) {
      std::vector<std::vector<std::byte>> said;
      for (std::size_t k = 0; k < peers.size(); ++k) {
        peers[k]->step(clock(k), [&](std::span<const std::byte> bytes) {
          if (on_air[k]) said.emplace_back(bytes.begin(), bytes.end());
        });
        const auto found = peers[k]->take_changes();
        changes[k].insert(changes[k].end(), found.begin(), found.end());
      }
      for (std::size_t k = 0; k < peers.size(); ++k)
        for (const auto& bytes : said)
          if (on_air[k])
            for (int copy = 0; copy < copies; ++copy)
              peers[k]->receive(bytes, clock(k), came[k]);
      datagrams += said.size();
    }
  }
  void clear() {
    for (auto& each : came) each.clear();
    datagrams = 0;
  }

  std::vector<std::unique_ptr<ModemPeer>> peers;
  std::vector<Time> shifts;
  std::vector<std::vector<Message>> came;
  std::vector<std::vector<NeighbourChange>> changes;
  std::vector<bool> on_air;
  int copies = 1;
  std::size_t datagrams = 0;
  Time now;

 private:
  void add(const ModemPeerOptions& options, Time shift) {
    peers.push_back(std::make_unique<ModemPeer>(options));
    shifts.push_back(shift);
    came.emplace_back();
    changes.emplace_back();
    on_air.push_back(true);
  }
};

class Methods : public testing::TestWithParam<GatewayMethod> {};

TEST_P(Methods, BringMessagesToBothSides) {
  Air air(GetParam());
  air.station().send(message_of(kSimulated, kFirst, 1, air.clock(0)), air.clock(0));
  air.first().send(message_of(kFirst, kOther, 2, air.clock(1)), air.clock(1));
  air.run(0.05);
  ASSERT_EQ(air.came[1].size(), 1u);
  EXPECT_EQ(air.came[1][0].from, kSimulated);
  EXPECT_EQ(air.came[1][0].to, kFirst);
  EXPECT_TRUE(air.came[2].empty()) << "it is for another";
  ASSERT_EQ(air.came[0].size(), 1u);
  EXPECT_EQ(air.came[0][0].from, kFirst);
  EXPECT_EQ(air.came[0][0].to, kOther);
  // Sent 10 ms before it came at most, by the receiver's clock.
  EXPECT_NEAR(air.came[0][0].sent.seconds(), air.clock(0).seconds() - 0.05, 0.011);
}

INSTANTIATE_TEST_SUITE_P(Gateways, Methods,
                         testing::Values(GatewayMethod::kFixed,
                                         GatewayMethod::kAltering));

TEST(ModemPeer, FindsAllWhoAreReachedThroughOthers) {
  Air air;
  EXPECT_TRUE(air.station().hears(kFirst) && air.station().hears(kSecond));
  for (const EntityId each : {kStation, kSimulated, kOther, kSecond})
    EXPECT_TRUE(air.first().hears(each)) << each.value;
  EXPECT_FALSE(air.first().hears(kFirst));
  EXPECT_EQ(air.changes[0].size(), 2u) << "each once";
}

TEST(ModemPeer, SpeaksToOthersWithoutTheGroundStation) {
  Air air;
  air.on_air[0] = false;
  air.first().send(message_of(kFirst, kSecond, 1, air.clock(1)), air.clock(1));
  air.run(0.05);
  EXPECT_EQ(air.came[2].size(), 1u);
}

TEST(ModemPeer, KeepsItsOwnKnowledgeWhileItIsAwayAndIsReachedAgain) {
  Air air;
  air.on_air[1] = false;
  air.run(4);
  EXPECT_FALSE(air.station().hears(kFirst));
  EXPECT_TRUE(air.station().hears(kSecond));
  air.clear();
  air.station().send(message_of(kSimulated, kFirst, 1, air.clock(0)), air.clock(0));
  EXPECT_EQ(air.station().statistics().unreachable, 1u);
  air.on_air[1] = true;
  // An advertisement comes each 1.1 s at most.
  air.run(1.2);
  EXPECT_TRUE(air.station().hears(kFirst) && air.first().hears(kSimulated));
  air.station().send(message_of(kSimulated, kFirst, 2, air.clock(0)), air.clock(0));
  air.first().send(message_of(kFirst, kSimulated, 3, air.clock(1)), air.clock(1));
  air.run(0.05);
  ASSERT_EQ(air.came[1].size(), 1u);
  EXPECT_EQ(air.came[1][0].number, 2u);
  ASSERT_EQ(air.came[0].size(), 1u);
  const std::vector<NeighbourChange>& seen = air.changes[0];
  ASSERT_EQ(seen.size(), 4u);
  EXPECT_FALSE(seen[2].found);
  EXPECT_TRUE(seen[3].found);
}

TEST(ModemPeer, TakesWhatComesTwiceOnce) {
  Air air;
  air.copies = 3;
  air.first().send(message_of(kFirst, kSimulated, 1, air.clock(1)), air.clock(1));
  air.run(0.05);
  EXPECT_EQ(air.came[0].size(), 1u);
  EXPECT_GE(air.station().statistics().duplicates, 2u);
}

TEST(ModemPeer, NeverSendsWhatCameByTheModem) {
  Air air;
  air.first().send(message_of(kFirst, kEveryone, 1, air.clock(1)), air.clock(1));
  air.run(0.05);
  ASSERT_EQ(air.came[0].size(), 1u);
  EXPECT_EQ(air.came[0][0].to, kEveryone);
  ASSERT_EQ(air.came[2].size(), 1u);
  EXPECT_EQ(air.came[2][0].to, kSecond);
  air.clear();
  // The medium brings it to the other real one's node too.
  Message copy =
      air.station().hears(kSecond) ? message_of(kFirst, kSecond, 2, air.now) : Message();
  air.station().send(copy, air.clock(0));
  air.run(0.05);
  EXPECT_TRUE(air.came[2].empty());
}

TEST(ModemPeer, SendsAMessageToSeveralOnce) {
  Air air;
  air.run(0.5);
  air.clear();
  const std::uint64_t before = air.station().statistics().sent;
  const Time sent = air.clock(0);
  air.station().send(message_of(kSimulated, kFirst, 1, sent, 7), sent);
  air.station().send(message_of(kSimulated, kSecond, 2, sent, 7), sent);
  air.station().step(sent, [&](std::span<const std::byte> bytes) {
    air.first().receive(bytes, air.clock(1), air.came[1]);
    air.second().receive(bytes, air.clock(2), air.came[2]);
  });
  EXPECT_LE(air.station().statistics().sent - before, 2u) << "and an advertisement";
  ASSERT_TRUE(air.came[1].size() == 1 && air.came[2].size() == 1);
  EXPECT_EQ(air.came[2][0].to, kSecond);
}

TEST(ModemPeer, InjectsWhatNobodyTakes) {
  Air air;
  const std::uint64_t heard = air.first().statistics().heard_bytes;
  air.station().inject(message_of(kSimulated, kOther, 1, air.clock(0)), air.clock(0));
  air.station().inject(message_of(kSimulated, kEveryone, 2, air.clock(0)), air.clock(0));
  air.run(0.02);
  EXPECT_EQ(air.station().statistics().injected, 2u);
  EXPECT_GT(air.first().statistics().heard_bytes, heard) << "it feels the load";
  EXPECT_TRUE(air.came[1].empty());
}

TEST(ModemPeer, PacesAdvertisementsToo) {
  // Ten messages of 60 B at least want more than 2 kbit/s in a second.
  Air air(GatewayMethod::kFixed, {2000, 10, seconds(60)});
  const ModemStatistics before = air.station().statistics();
  for (std::uint8_t k = 0; k < 20; ++k)
    air.station().send(message_of(kSimulated, kFirst, k, air.clock(0), k), air.clock(0));
  air.run(1);
  const ModemStatistics after = air.station().statistics();
  const double bits = 8 * static_cast<double>(after.sent_bytes - before.sent_bytes);
  // One datagram more than the rate allows, of at most 120 B.
  EXPECT_LE(bits, 2000 * (1 + 0.02) + 8 * 120);
  EXPECT_GE(bits, 2000 * 0.9);
  EXPECT_EQ(after.dropped.full, 10u);
  EXPECT_GT(after.mean_delay(), 0.1);
}

TEST(ModemPeer, DoesNotBelieveWhomItDoesNotKnow) {
  Air air;
  Datagram forged;
  forged.session = 99;
  forged.origin = {77, kSecond.value};
  forged.to = {1, kSimulated.value};
  forged.number = 1;
  forged.payload = Carried{message_of(kSecond, kSimulated, 1, air.now), {}};
  std::vector<std::byte> bytes;
  encode(forged, bytes);
  air.station().receive(bytes, air.clock(0), air.came[0]);
  EXPECT_TRUE(air.came[0].empty()) << "it is heard through another modem";
  forged.number = 2;
  forged.payload = Advertisement{12345, {kSecond.value}};
  bytes.clear();
  encode(forged, bytes);
  const std::uint64_t unknown = air.station().statistics().unknown;
  air.station().receive(bytes, air.clock(0), air.came[0]);
  EXPECT_EQ(air.station().statistics().unknown, unknown + 1) << "of another scenario";
}

}  // namespace
}  // namespace skein::modem
