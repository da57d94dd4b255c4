// SPDX-License-Identifier: Apache-2.0
// Attackers and authentication on the medium of a run.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string_view>
#include <utility>

#include "skein/layer/communication/medium_radio.h"
#include "skein/layer/communication/propagation/path_loss.h"
#include "skein/layer/communication/routing/flooding.h"

namespace skein::communication::medium_radio_security_test {
namespace {

// Three entities in a row, half a kilometre apart.
class Team {
 public:
  explicit Team(const MediumRadioOptions& options,
                std::unique_ptr<Routing> routing = nullptr)
      : radio_(options, std::make_unique<FreeSpace>(2.4e9),
               RadioNodes{3,
                          [](EntityId id) -> std::optional<Vec3> {
                            return Vec3(500.0 * id.value, 0, -100);
                          },
                          [](EntityId id) { return "node " + std::to_string(id.value); },
                          {}},
               7, std::move(routing)) {}

  void send(std::uint32_t from, std::uint32_t to, bool copy = false) {
    Message message;
    message.from = EntityId{from};
    message.to = EntityId{to};
    message.number = number_++;
    message.sent = now_;
    message.content = Heartbeat{};
    message.copy = copy;
    radio_.send(message);
  }
  void send_to_all(std::uint32_t from) {
    bool copy = false;
    for (std::uint32_t to = 0; to < 3; ++to)
      if (to != from) send(from, to, std::exchange(copy, true));
  }
  void steps(int count) {
    for (int i = 0; i < count; ++i) {
      radio_.deliver(now_, news);
      now_ += Time::from_seconds(0.1);
    }
  }
  // Messages to 1 and to all, each half second.
  void talk(int seconds) {
    for (int i = 0; i < 2 * seconds; ++i) {
      send(0, 1);
      send_to_all(2);
      steps(5);
    }
    steps(10);
  }
  long count(LossCause cause, bool forged) const {
    return std::ranges::count_if(news.ended, [&](const MessageOutcome& each) {
      return each.cause == cause && each.message.forged == forged;
    });
  }
  long events(EventKind kind) const {
    return std::ranges::count_if(news.events,
                                 [&](const Event& event) { return event.kind == kind; });
  }
  long sent() const { return static_cast<long>(number_); }
  MediumRadio& radio() { return radio_; }

  RadioNews news;

 private:
  MediumRadio radio_;
  Time now_;
  std::uint64_t number_ = 0;
};

Attack attack_of(std::variant<Jammer, Flooder, Spoofer, Replayer> what,
                 double power_dbm = 20) {
  Attack attack;
  attack.name = "eve";
  attack.place = Vec3(500, 500, -10);
  attack.power_dbm = power_dbm;
  attack.what = std::move(what);
  return attack;
}

Spoofer order_home() {
  return {EntityId{0}, EntityId{1}, FalseContent::kReturnHome, Vec3::Zero(),
          Time::from_seconds(1)};
}

AuthenticationOptions key() {
  AuthenticationOptions made;
  made.key.fill(std::byte{3});
  return made;
}

MediumRadioOptions attacked_by(Attack attack) {
  MediumRadioOptions options;
  options.attacks.push_back(std::move(attack));
  return options;
}

TEST(MediumRadioSecurity, NoiseKeepsAllFromSendingWhoSenseIt) {
  Team team(attacked_by(attack_of(Jammer{})));
  team.talk(10);
  EXPECT_EQ(team.count(LossCause::kNone, false), 0);
  EXPECT_GT(team.count(LossCause::kQueueFull, false), 10);
  EXPECT_GT(team.radio().status(EntityId{1}).load, 0.99);
  EXPECT_EQ(team.radio().take_statistics().radios.size(), 3u) << "of entities only";
}

TEST(MediumRadioSecurity, NoiseThatIsNotSensedDisturbsReceptions) {
  MediumRadioOptions options = attacked_by(attack_of(Jammer{}));
  // 20 dBm over 0.5 km arrive with -74 dBm, signals of 15 dBm over 0.5 km with -79 dBm.
  options.profile.phy.carrier_sense_threshold_dbm = -60;
  Team team(options);
  team.talk(10);
  EXPECT_EQ(team.count(LossCause::kNone, false), 0);
  EXPECT_GT(team.count(LossCause::kRetryLimit, false), 10);
  EXPECT_GT(team.count(LossCause::kNotReceived, false), 10);
}

TEST(MediumRadioSecurity, NoiseForHalfOfTheTimeLeavesTheOtherHalf) {
  Team team(attacked_by(attack_of(Jammer{0.5, Time::from_seconds(1)})));
  team.talk(20);
  // What waits is sent in the pauses: nothing is lost but what meets a burst's begin.
  EXPECT_GT(team.count(LossCause::kNone, false), team.sent() * 8 / 10);
}

TEST(MediumRadioSecurity, FloodsTakeAirtimeAndAreNoMessages) {
  Team quiet({}), flooded(attacked_by(attack_of(Flooder{1400, 200, std::nullopt})));
  quiet.talk(5);
  flooded.talk(5);
  EXPECT_EQ(static_cast<long>(flooded.news.ended.size()), flooded.sent());
  // A packet of 1436 bytes takes 5.9 ms: more than the air has room for.
  EXPECT_GT(flooded.radio().status(EntityId{1}).load, 0.8);
  EXPECT_LT(quiet.radio().status(EntityId{1}).load, 0.1);
}

TEST(MediumRadioSecurity, AFalseOrderArrivesAndIsRecordedAsForged) {
  Team team(attacked_by(attack_of(order_home())));
  team.steps(50);
  EXPECT_GE(team.count(LossCause::kNone, true), 4);
  EXPECT_EQ(team.news.ended[0].message.from, EntityId{0});
  EXPECT_TRUE(std::holds_alternative<Task>(team.news.ended[0].message.content));
  EXPECT_EQ(team.events(EventKind::kAttackBegins), 1);
  EXPECT_TRUE(team.radio().take_statistics().links.empty())
      << "0 and 1 have not said a word";
}

TEST(MediumRadioSecurity, AFalseOrderIsRefusedWithAuthentication) {
  MediumRadioOptions options = attacked_by(attack_of(order_home()));
  options.authentication = key();
  Team team(options);
  team.talk(10);
  EXPECT_EQ(team.count(LossCause::kNone, true), 0);
  EXPECT_GE(team.count(LossCause::kRefused, true), 9);
  EXPECT_EQ(team.count(LossCause::kNone, false), team.sent()) << "nothing else is";
  EXPECT_EQ(team.events(EventKind::kMessageRefused), 1) << "said once";
}

TEST(MediumRadioSecurity, DoubtsAreReportedWhereAuthenticationIsNotRequired) {
  MediumRadioOptions options = attacked_by(attack_of(order_home()));
  options.authentication = key();
  options.authentication->required = false;
  Team team(options);
  team.talk(10);
  EXPECT_GE(team.count(LossCause::kNone, true), 9);
  EXPECT_EQ(team.count(LossCause::kRefused, true), 0);
  EXPECT_EQ(team.events(EventKind::kMessageDoubted), 1);
}

TEST(MediumRadioSecurity, ReplayedMessagesArriveAgainButForTheirCounters) {
  for (const double delay : {2.0, 30.0}) {
    SCOPED_TRACE(delay);
    MediumRadioOptions options =
        attacked_by(attack_of(Replayer{Time::from_seconds(delay), std::nullopt}));
    Team open(options);
    open.talk(40);
    // To 1 and to all: three for each half second.
    EXPECT_GT(open.count(LossCause::kNone, true), 50);
    options.authentication = key();
    Team closed(options);
    closed.talk(40);
    EXPECT_EQ(closed.count(LossCause::kNone, true), 0);
    EXPECT_GT(closed.count(LossCause::kRefused, true), 50);
    EXPECT_EQ(closed.count(LossCause::kRefused, false), 0);
    // 1 and 0 of 2, 1 of 0.
    EXPECT_EQ(closed.events(EventKind::kMessageRefused), 3);
  }
}

TEST(MediumRadioSecurity, TagsTakeBytesOnTheAir) {
  const auto sending = [](bool sealed) {
    MediumRadioOptions options;
    if (sealed) options.authentication = key();
    Team team(options);
    for (int i = 0; i < 100; ++i) {
      team.send(0, 1);
      team.steps(1);
    }
    return team.radio().take_statistics().radios[0].sending_share;
  };
  // 10 a second with 24 bytes more at 2 Mbit/s; one of a hundred is not over.
  EXPECT_NEAR(sending(true) - sending(false), 10 * 24 * 8 / 2e6,
              10 * 24 * 8 / 2e6 * 0.03);
}

std::unique_ptr<Routing> flooding() {
  return std::make_unique<Flooding>(FloodingOptions{}, 3, 7);
}

TEST(MediumRadioSecurity, FloodingPassesNothingForgedOn) {
  MediumRadioOptions options;
  // Out of the reach of 1; 0 would pass it on.
  Attack attack = attack_of(order_home(), 0);
  attack.place = Vec3(-900, 0, -100);
  options.attacks.push_back(attack);
  options.profile.phy.decode_threshold_dbm = -90;
  Team open(options, flooding());
  open.steps(50);
  EXPECT_EQ(open.count(LossCause::kNone, true), 0) << "0 dBm over 900 m are -99 dBm";
  options.attacks[0].power_dbm = 10;
  Team passed(options, flooding());
  passed.steps(50);
  EXPECT_GE(passed.count(LossCause::kNone, true), 4);
  options.authentication = key();
  Team closed(options, flooding());
  closed.steps(50);
  EXPECT_EQ(closed.count(LossCause::kNone, true), 0);
  EXPECT_EQ(closed.count(LossCause::kRefused, true), 0) << "it never reaches 1";
  EXPECT_EQ(closed.events(EventKind::kMessageRefused), 1) << "0 refuses to pass it on";
}

// The last piece of noise before its end, and each of a quick one, are shorter than it
// takes to detect a frame.
TEST(MediumRadioSecurity, ShortNoiseDisturbsAndHarmsNothingElse) {
  for (const double duty : {0.0005, 0.5}) {
    Jammer jammer;
    jammer.duty = duty;
    jammer.period = Time::from_seconds(0.001);
    MediumRadioOptions options = attacked_by(attack_of(jammer));
    options.profile.phy.lock_window = Time::from_ns(150'000);
    Team team(options);
    team.talk(20);
    EXPECT_EQ(team.count(LossCause::kNone, false) +
                  team.count(LossCause::kNotReceived, false) +
                  team.count(LossCause::kRetryLimit, false) +
                  team.count(LossCause::kQueueFull, false),
              static_cast<long>(team.news.ended.size()));
    EXPECT_GT(team.news.ended.size(), 20u) << duty;
  }
}

// Outsiders send in slots of members: they collide and do not slow the others down.
TEST(MediumRadioSecurity, FloodersDisturbSlots) {
  MediumRadioOptions options;
  options.profile.mac.access = AccessMethod::kTdma;
  options.profile.mac.slot = Time::from_seconds(0.02);
  Team quiet(options);
  quiet.talk(20);
  EXPECT_EQ(quiet.count(LossCause::kNone, false), quiet.sent());
  options.attacks.push_back(attack_of(Flooder{1400, 100, std::nullopt}));
  Team flooded(options);
  flooded.talk(20);
  EXPECT_GT(flooded.count(LossCause::kNotReceived, false), 20);
}

}  // namespace
}  // namespace skein::communication::medium_radio_security_test
