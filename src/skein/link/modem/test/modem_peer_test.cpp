// SPDX-License-Identifier: Apache-2.0
#include "skein/link/modem/modem_peer.h"

#include <gtest/gtest.h>

#include <memory>

#include "skein/data/describe/wire.h"

namespace skein::modem::modem_peer_test {
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
  explicit Air(PacedQueueOptions queue = {}) {
    ModemPeerOptions options;
    options.session = 10;
    options.entities = 5;
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
  ModemStatistics station_statistics() { return station().statistics(clock(0)); }
  Time clock(std::size_t peer) const { return now + shifts[peer]; }

  void run(double duration) {
    for (const Time end = now + seconds(duration); now < end; now += seconds(0.01)) {
      std::vector<std::vector<std::byte>> said;
      for (std::size_t k = 0; k < peers.size(); ++k) {
        peers[k]->step(clock(k), [&](std::span<const std::byte> bytes) {
          if (on_air[k]) said.emplace_back(bytes.begin(), bytes.end());
          return true;
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

TEST(ModemPeer, BringsMessagesToBothSides) {
  Air air;
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
  EXPECT_EQ(air.station_statistics().unreachable, 1u);
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
  EXPECT_GE(air.station_statistics().duplicates, 2u);
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
  const std::uint64_t before = air.station_statistics().sent;
  const Time sent = air.clock(0);
  air.station().send(message_of(kSimulated, kFirst, 1, sent, 7), sent);
  air.station().send(message_of(kSimulated, kSecond, 2, sent, 7), sent);
  air.station().step(sent, [&](std::span<const std::byte> bytes) {
    air.first().receive(bytes, air.clock(1), air.came[1]);
    air.second().receive(bytes, air.clock(2), air.came[2]);
    return true;
  });
  EXPECT_LE(air.station_statistics().sent - before, 2u) << "and an advertisement";
  ASSERT_TRUE(air.came[1].size() == 1 && air.came[2].size() == 1);
  EXPECT_EQ(air.came[2][0].to, kSecond);
}

TEST(ModemPeer, InjectsWhatNobodyTakes) {
  Air air;
  const std::uint64_t heard = air.first().statistics(air.clock(1)).heard_bytes;
  air.station().inject(message_of(kSimulated, kOther, 1, air.clock(0)), air.clock(0));
  air.station().inject(message_of(kSimulated, kEveryone, 2, air.clock(0)), air.clock(0));
  air.run(0.02);
  EXPECT_EQ(air.station_statistics().injected, 2u);
  EXPECT_GT(air.first().statistics(air.clock(1)).heard_bytes, heard)
      << "it feels the load";
  EXPECT_TRUE(air.came[1].empty());
}

TEST(ModemPeer, PacesAdvertisementsToo) {
  // Ten messages of 60 B at least want more than 2 kbit/s in a second.
  Air air({2000, 10, seconds(60)});
  const ModemStatistics before = air.station_statistics();
  for (std::uint8_t k = 0; k < 20; ++k)
    air.station().send(message_of(kSimulated, kFirst, k, air.clock(0), k), air.clock(0));
  air.run(1);
  const ModemStatistics after = air.station_statistics();
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
  const std::uint64_t unknown = air.station_statistics().unknown;
  air.station().receive(bytes, air.clock(0), air.came[0]);
  EXPECT_EQ(air.station_statistics().unknown, unknown + 1) << "of another scenario";
}

std::vector<std::byte> coded(const Datagram& datagram) {
  std::vector<std::byte> bytes;
  encode(datagram, bytes);
  return bytes;
}

Datagram advertisement_of(std::uint32_t hw, std::uint64_t session, EntityId who) {
  Datagram datagram;
  datagram.session = session;
  datagram.origin = {hw, who.value};
  datagram.to = {kAll, kAll};
  datagram.number = 1;
  datagram.payload = Advertisement{0, {who.value}};
  return datagram;
}

TEST(ModemPeer, IsNotFilledOrShutOutByWhomItDoesNotKnow) {
  Air air;
  // Of nobody, and of the first real one in a session that never ends.
  Datagram invented;
  invented.origin = {0, kSecond.value};
  invented.to = {1, kSimulated.value};
  invented.number = 1;
  invented.payload = Carried{message_of(kSecond, kSimulated, 1, air.now), {}};
  for (std::uint32_t hw = 1000; hw < 3000; ++hw) {
    invented.origin.hw = hw;
    air.station().receive(coded(invented), air.clock(0), air.came[0]);
  }
  const Datagram false_session = advertisement_of(11, ~std::uint64_t{0}, kFirst);
  air.station().receive(coded(false_session), air.clock(0), air.came[0]);
  EXPECT_TRUE(air.came[0].empty());
  air.first().send(message_of(kFirst, kSimulated, 1, air.clock(1)), air.clock(1));
  air.run(0.05);
  EXPECT_EQ(air.came[0].size(), 1u) << "its session goes on";
  EXPECT_EQ(air.station_statistics().unknown, 2000u);
}

TEST(ModemPeer, GivesWhatIsForSeveralToEachOfThem) {
  Air air;
  air.clear();
  const Time sent = air.clock(1);
  air.first().send(message_of(kFirst, kSimulated, 1, sent, 7), sent);
  air.first().send(message_of(kFirst, kStation, 2, sent, 7), sent);
  air.run(0.05);
  ASSERT_EQ(air.came[0].size(), 2u) << "and not to all";
  EXPECT_EQ(air.came[0][0].to, kStation);
  EXPECT_EQ(air.came[0][1].to, kSimulated);
  EXPECT_TRUE(air.came[2].empty());
}

TEST(ModemPeer, FindsThatAnotherModemHasItsAddress) {
  Air air;
  const auto other = coded(advertisement_of(1, 77, kFirst));
  air.station().receive(other, air.clock(0), air.came[0]);
  const auto alerts = air.station().take_alerts();
  ASSERT_EQ(alerts.size(), 1u);
  EXPECT_EQ(alerts[0].kind, AlertKind::kSameAddress);
  EXPECT_EQ(alerts[0].identities, std::vector<EntityId>{kFirst});
  air.station().receive(other, air.clock(0), air.came[0]);
  EXPECT_TRUE(air.station().take_alerts().empty()) << "said once a minute";
  EXPECT_EQ(air.station_statistics().clashes, 2u);
  air.run(2);
  EXPECT_EQ(air.station_statistics().clashes, 2u) << "its own echo is none";
}

TEST(AlertLog, SaysEachKindOnceAMinuteAndHowMany) {
  AlertLog log;
  const auto note = [&](AlertKind kind, double seconds) {
    const Time at = Time::from_seconds(seconds);
    const bool says = log.note(kind, at);
    if (says) log.say(kind, {kFirst}, at);
    return says;
  };
  EXPECT_TRUE(note(AlertKind::kRefused, 5));
  EXPECT_TRUE(note(AlertKind::kSameAddress, 6));
  for (int k = 0; k < 10; ++k) EXPECT_FALSE(note(AlertKind::kRefused, 7 + k));
  const auto first = log.take();
  ASSERT_EQ(first.size(), 2u);
  EXPECT_EQ(first[0].kind, AlertKind::kRefused);
  EXPECT_EQ(first[0].count, 1u);
  EXPECT_EQ(first[1].kind, AlertKind::kSameAddress);
  EXPECT_TRUE(note(AlertKind::kRefused, 65));
  const auto second = log.take();
  ASSERT_EQ(second.size(), 1u);
  EXPECT_EQ(second[0].count, 11u);
  EXPECT_TRUE(log.take().empty());
}

TEST(ModemPeer, CountsWhatNobodyTakesAsUnsent) {
  Air air;
  const ModemStatistics before = air.station_statistics();
  air.station().send(message_of(kSimulated, kFirst, 1, air.clock(0)), air.clock(0));
  air.station().step(air.clock(0), [](auto) { return false; });
  const ModemStatistics after = air.station_statistics();
  EXPECT_EQ(after.sent, before.sent);
  EXPECT_GE(after.unsent, 1u);
  Message long_one = message_of(kSimulated, kFirst, 2, air.clock(0));
  long_one.content = PluginPayload{"test", std::vector<std::uint8_t>(kMaxDatagram)};
  air.station().send(long_one, air.clock(0));
  air.run(0.02);
  EXPECT_EQ(air.station_statistics().too_long, 1u);
}

TEST(ModemPeer, KnowsTheLoadByWhatItHearsAndSays) {
  ModemPeerOptions options;
  options.identities = {kFirst};
  options.entities = 2;
  options.queue.rate = 10'000;
  ModemPeer peer(options);
  std::vector<Message> came;
  // 10 x 62.5 bytes in a second are half of it.
  for (int k = 0; k < 10; ++k)
    peer.receive(std::vector<std::byte>(k % 2 == 0 ? 62 : 63), seconds(0.1 * k), came);
  EXPECT_NEAR(peer.statistics(seconds(1)).load, 0.5, 1e-9);
}

// A seal that a test understands: the number of the key, and a sum.
DatagramSeal seal_of(std::uint8_t key, bool required = true) {
  const auto sum = [key](std::span<const std::byte> bytes) {
    unsigned all = key;
    for (const std::byte each : bytes) all += std::to_integer<unsigned>(each) + 1;
    return static_cast<std::byte>(all & 0xFF);
  };
  return {1,
          [sum](std::vector<std::byte>& datagram, std::uint64_t) {
            datagram.push_back(sum(datagram));
          },
          [sum](std::span<const std::byte> sealed) {
            return sealed.back() == sum(sealed.first(sealed.size() - 1));
          },
          required};
}

ModemPeerOptions sealed_options(std::uint32_t hw, EntityId self, DatagramSeal seal) {
  ModemPeerOptions options;
  options.hw = hw;
  options.identities = {self};
  options.entities = 2;
  options.seal = std::move(seal);
  return options;
}

std::vector<std::byte> advertisement_by(ModemPeer& peer) {
  std::vector<std::byte> said;
  peer.step(Time(), [&](std::span<const std::byte> bytes) {
    said.assign(bytes.begin(), bytes.end());
    return true;
  });
  return said;
}

TEST(SealedModemPeer, HearsWhoHasTheKeyAndNobodyElse) {
  std::vector<Message> came;
  ModemPeer station(sealed_options(1, kStation, seal_of(1)));
  ModemPeer real(sealed_options(2, kFirst, seal_of(1)));
  ModemPeer intruder(sealed_options(3, kFirst, seal_of(2)));
  station.receive(coded(advertisement_of(4, 1, kFirst)), Time(), came);
  station.receive(advertisement_by(intruder), Time(), came);
  station.receive({}, Time(), came);
  EXPECT_FALSE(station.hears(kFirst));
  EXPECT_EQ(station.statistics(Time()).unauthentic, 3u);
  EXPECT_EQ(station.statistics(Time()).heard, 0u);
  const auto said = advertisement_by(real);
  station.receive(said, Time(), came);
  EXPECT_TRUE(station.hears(kFirst));
  auto altered = said;
  altered[10] ^= std::byte{1};
  station.receive(altered, Time(), came);
  EXPECT_EQ(station.statistics(Time()).unauthentic, 4u);
  const auto alerts = station.take_alerts();
  ASSERT_EQ(alerts.size(), 1u) << "four within a minute";
  EXPECT_EQ(alerts[0].kind, AlertKind::kRefused);
  EXPECT_EQ(alerts[0].identities, std::vector<EntityId>{kFirst}) << "whom it names";
  station.receive(said, Time(), came);
  EXPECT_EQ(station.statistics(Time()).duplicates, 1u);
  // Long after: nothing of a session that is over counts again.
  station.step(seconds(100), [](auto) { return true; });
  EXPECT_FALSE(station.hears(kFirst));
  station.receive(said, seconds(100), came);
  EXPECT_FALSE(station.hears(kFirst));
}

TEST(SealedModemPeer, OnlyCountsWhereItIsNotRequired) {
  std::vector<Message> came;
  for (const bool sealed : {false, true}) {
    ModemPeer station(sealed_options(1, kStation, seal_of(1, false)));
    ModemPeer intruder(sealed_options(3, kFirst, seal_of(2)));
    station.receive(
        sealed ? advertisement_by(intruder) : coded(advertisement_of(4, 1, kFirst)),
        Time(), came);
    EXPECT_TRUE(station.hears(kFirst)) << sealed;
    EXPECT_EQ(station.statistics(Time()).unauthentic, 1u);
    EXPECT_EQ(station.take_alerts().at(0).kind, AlertKind::kDoubted);
  }
}

}  // namespace
}  // namespace skein::modem::modem_peer_test
