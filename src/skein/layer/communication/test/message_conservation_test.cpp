// SPDX-License-Identifier: Apache-2.0
// Whatever the radio of a run is: each message arrives, is lost by a cause, or is pending
// in the end; once.
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <array>
#include <map>
#include <memory>
#include <utility>

#include "skein/layer/communication/medium_radio.h"
#include "skein/layer/communication/propagation/path_loss.h"
#include "skein/layer/communication/routing/flooding.h"
#include "skein/layer/communication/routing/learned_routes.h"

namespace skein::communication::message_conservation_test {
namespace {

constexpr std::uint32_t kEntities = 5;

struct Given {
  MediumRadioOptions options;
  int routing = 0;  // none, flooding, learned routes
  std::uint64_t seed = 0;
  int steps = 0;
  double rate = 0;  // messages in a step
};

Attack any_attack(std::uint32_t number) {
  Attack attack;
  attack.name = "eve " + std::to_string(number);
  attack.place = Vec3(*rc::gen::inRange(0, 3000), 100, -50);
  attack.power_dbm = *rc::gen::element(0.0, 20.0, 40.0);
  attack.from = Time::from_seconds(*rc::gen::inRange(0, 3));
  if (*rc::gen::arbitrary<bool>())
    attack.until = attack.from + Time::from_ns(*rc::gen::inRange(1, 900'000'000));
  switch (*rc::gen::inRange(0, 4)) {
    case 0:
      attack.what = Jammer{*rc::gen::element(0.0001, 0.3, 1.0),
                           Time::from_ns(*rc::gen::inRange(100'000, 300'000'000))};
      break;
    case 1:
      attack.what = Flooder{*rc::gen::inRange<std::uint32_t>(1, 1500), 200, EntityId{1}};
      break;
    case 2:
      attack.what = Spoofer{EntityId{0}, EntityId{2}, FalseContent::kReport, Vec3::Zero(),
                            Time::from_seconds(0.5)};
      break;
    default:
      attack.what = Replayer{Time::from_seconds(0.5), std::nullopt};
  }
  return attack;
}

Given any_given() {
  Given given;
  MediumRadioOptions& options = given.options;
  options.profile.mac.access =
      *rc::gen::element(AccessMethod::kDcf, AccessMethod::kTdma, AccessMethod::kDirect);
  options.profile.mac.slot = options.profile.mac.access == AccessMethod::kTdma
                                 ? Time::from_ns(20'000'000)
                                 : options.profile.mac.slot;
  options.profile.phy.rate = *rc::gen::element(2e6, 2e5);
  options.profile.mac.part_bytes = *rc::gen::element<std::uint32_t>(60, 400);
  options.profile.mac.queue_packets = *rc::gen::inRange<std::uint32_t>(1, 40);
  if (*rc::gen::arbitrary<bool>())
    options.profile.mac.queue_lifetime = Time::from_seconds(*rc::gen::element(0.05, 1.0));
  options.profile.mac.latency = Time::from_seconds(*rc::gen::element(0.0, 0.7));
  options.profile.mac.loss = *rc::gen::element(0.0, 0.3);
  options.advertisement_period = *rc::gen::element(0.0, 1.0);
  if (*rc::gen::arbitrary<bool>()) {
    options.authentication.emplace();
    options.authentication->key.fill(std::byte{7});
  }
  if (options.profile.mac.access != AccessMethod::kDirect)
    for (int k = *rc::gen::inRange(0, 3); k > 0; --k)
      options.attacks.push_back(any_attack(static_cast<std::uint32_t>(k)));
  given.routing = *rc::gen::inRange(0, 3);
  given.seed = *rc::gen::arbitrary<std::uint32_t>();
  given.steps = *rc::gen::inRange(1, 60);
  given.rate = *rc::gen::element(0.3, 2.0, 10.0);
  return given;
}

std::unique_ptr<Routing> routing_of(const Given& given) {
  if (given.routing == 1)
    return std::make_unique<Flooding>(FloodingOptions{}, kEntities, given.seed);
  if (given.routing == 2)
    return std::make_unique<LearnedRoutes>(LearnedRoutesOptions{}, kEntities, given.seed);
  return nullptr;
}

TEST(MessageConservation, EachEndsOnceWhateverTheRadioIs) {
  EXPECT_TRUE(rc::check([] {
    const Given given = any_given();
    MediumRadio radio(given.options, std::make_unique<FreeSpace>(2.4e9),
                      {kEntities,
                       [](EntityId id) -> std::optional<Vec3> {
                         return Vec3(700.0 * id.value, 0, -100);
                       },
                       [](EntityId id) { return std::to_string(id.value); }},
                      given.seed, routing_of(given));
    RandomStream random(given.seed, 0, Purpose::kTest);
    std::map<std::uint64_t, int> open;
    std::uint64_t number = 0;
    RadioNews news;
    Time now;
    for (int step = 0; step < given.steps; ++step) {
      now += Time::from_seconds(0.1);
      radio.turn(EntityId{4}, random.uniform() < 0.9);
      for (double left = given.rate; random.uniform() < left; left -= 1) {
        Message message;
        message.from = EntityId{static_cast<std::uint32_t>(random.uniform(0, kEntities))};
        message.sent = now;
        message.content = PluginPayload{
            "test", std::vector<std::uint8_t>(random.uniform() < 0.1 ? 900 : 30)};
        const auto first = static_cast<std::uint32_t>(random.uniform(0, kEntities));
        const bool to_all = random.uniform() < 0.3;
        for (std::uint32_t k = 0; k < (to_all ? kEntities : 1); ++k) {
          message.to = EntityId{(first + k) % kEntities};
          if (message.to == message.from) continue;
          message.number = number++;
          radio.send(message);
          ++open[message.number];
          message.copy = true;
        }
      }
      radio.deliver(now, news);
    }
    radio.end(news);
    std::uint64_t arrived = 0;
    for (const MessageOutcome& each : news.ended) {
      if (each.message.forged) continue;
      RC_ASSERT(--open.at(each.message.number) == 0);
      arrived += each.cause == LossCause::kNone ? 1 : 0;
    }
    for (const auto& [which, left] : open) RC_ASSERT(left == 0);
    RC_CLASSIFY(arrived > number / 2, "most arrive");
  }));
}

}  // namespace
}  // namespace skein::communication::message_conservation_test
