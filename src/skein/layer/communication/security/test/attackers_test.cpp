// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/communication/security/attackers.h"

#include <gtest/gtest.h>

#include "skein/layer/communication/security/seal.h"

namespace skein::communication::attackers_test {
namespace {

constexpr NodeIndex kFirst = 5;
const Vec3 kVictim(100, 200, -50);

Attack attack_of(std::variant<Jammer, Flooder, Spoofer, Replayer> what, double from = 1,
                 double until = 3) {
  Attack attack;
  attack.name = "eve";
  attack.from = Time::from_seconds(from);
  attack.until = Time::from_seconds(until);
  attack.what = std::move(what);
  return attack;
}

// What one attacker does in four seconds, asked every tenth of a second.
class Watched {
 public:
  explicit Watched(Attack attack, bool sealed = false)
      : attackers_(
            {std::move(attack)}, kFirst, [](EntityId) { return std::optional(kVictim); },
            sealed, 3) {}

  Attackers& attackers() { return attackers_; }
  void run(double until) {
    for (; now < Time::from_seconds(until); now += Time::from_seconds(0.1))
      attackers_.step(now, orders, events);
  }

  Time now;
  AttackOrders orders;
  std::vector<Event> events;

 private:
  Attackers attackers_;
};

TEST(Attackers, AJammerSendsNoiseForItsShareOfTheTime) {
  Watched watched(attack_of(Jammer{0.25, Time::from_seconds(0.8)}));
  watched.run(4);
  Time sum;
  for (const auto& noise : watched.orders.noise) {
    EXPECT_EQ(noise.node, kFirst);
    EXPECT_GE(noise.time, Time::from_seconds(1));
    EXPECT_LE(noise.time + noise.duration, Time::from_seconds(3));
    EXPECT_LE(noise.duration, Time::from_seconds(0.1));
    sum += noise.duration;
  }
  // From 1, 1.8 and 2.6 s on for 0.2 s.
  EXPECT_EQ(sum, Time::from_seconds(0.6));
  ASSERT_EQ(watched.events.size(), 2u);
  EXPECT_EQ(watched.events[0].kind, EventKind::kAttackBegins);
  EXPECT_EQ(watched.events[0].time, Time::from_seconds(1));
  EXPECT_EQ(watched.events[1].kind, EventKind::kAttackEnds);
  EXPECT_EQ(watched.events[1].time, Time::from_seconds(3));
}

TEST(Attackers, NoiseOfDutyOneHasNoGaps) {
  Watched watched(attack_of(Jammer{}));
  watched.run(4);
  Time next = Time::from_seconds(1);
  for (const auto& noise : watched.orders.noise) {
    EXPECT_EQ(noise.time, next);
    next = noise.time + noise.duration;
  }
  EXPECT_EQ(next, Time::from_seconds(3));
}

TEST(Attackers, AFlooderOrdersPacketsAtItsRate) {
  Watched watched(attack_of(Flooder{300, 20, EntityId{2}}));
  watched.run(4);
  EXPECT_EQ(watched.orders.packets.size(), 40u);
  EXPECT_EQ(watched.orders.packets[0].to, 2u);
  EXPECT_EQ(watched.orders.packets[0].bytes, 300u);
}

TEST(Attackers, ASpooferLiesAboutItsVictim) {
  Spoofer spoofer{EntityId{1}, EntityId{0}, FalseContent::kReport, Vec3(500, 0, -20)};
  Watched watched(attack_of(spoofer), true);
  watched.run(4);
  ASSERT_EQ(watched.orders.forgeries.size(), 2u);
  const AirMessage& air = watched.orders.forgeries[1].message;
  ASSERT_EQ(air.copies.size(), 1u);
  const Message& message = air.copies[0];
  EXPECT_TRUE(message.forged);
  EXPECT_EQ(message.from, EntityId{1});
  EXPECT_EQ(message.to, EntityId{0});
  const auto& report = std::get<AircraftReport>(message.content);
  EXPECT_EQ(report.nav.p_N, kVictim + Vec3(500, 0, -20));
  EXPECT_EQ(report.nav.v_N, Vec3::Zero());
  EXPECT_EQ(air.sealed.size(), coded_size(message) + Seal::kBytes);
}

TEST(Attackers, AReplayerSendsOnceMoreWhatItHasHeard) {
  Watched watched(attack_of(Replayer{Time::from_seconds(0.55), EntityId{1}}, 1, 2));
  Message message;
  message.from = EntityId{1};
  message.to = EntityId{0};
  message.number = 8;
  message.content = Heartbeat{};
  const std::vector<std::byte> sealed(30, std::byte{9});
  const auto hear = [&](double time) {
    watched.attackers().overhear(kFirst, std::span(&message, 1), sealed,
                                 Time::from_seconds(time));
  };
  hear(0.5);  // before it begins
  hear(1.2);
  hear(1.21);  // a repetition
  message.number = 9;
  hear(1.9);  // would be sent after the end
  message.from = EntityId{2};
  hear(1.3);
  watched.run(4);
  ASSERT_EQ(watched.orders.forgeries.size(), 1u);
  const auto& forgery = watched.orders.forgeries[0];
  EXPECT_EQ(forgery.time, Time::from_seconds(1.75));
  EXPECT_EQ(forgery.message.sealed, sealed);
  EXPECT_TRUE(forgery.message.copies[0].forged);
  EXPECT_EQ(forgery.message.copies[0].number, 8u);
}

}  // namespace
}  // namespace skein::communication::attackers_test
