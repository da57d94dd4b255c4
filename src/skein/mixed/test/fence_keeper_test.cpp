// SPDX-License-Identifier: Apache-2.0
#include "skein/mixed/fence_keeper.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>

namespace skein::mixed::fence_keeper_test {
namespace {

using Outcome = RequestAnswer::Outcome;

Zone disc(const std::string& name, double floor = -1e9, double ceiling = 1e9) {
  Zone zone{.area = Disc{{500, 0}, 100}};
  zone.name = name;
  zone.floor_msl = floor;
  zone.ceiling_msl = ceiling;
  return zone;
}

struct FarEnd final : VehiclePort {
  void receive(Time, std::vector<VehicleReport>&) override {}
  void send(std::uint32_t number, const VehicleRequest& request) override {
    numbers.push_back(number);
    fences.push_back(std::get<FenceUpload>(request).zones);
  }
  std::vector<std::uint32_t> numbers;
  std::vector<std::vector<Zone>> fences;
};

struct Fenced {
  explicit Fenced(std::vector<Zone> zones) : keeper(zones) {
    keeper.hear(LinkChange{LinkChange::Kind::kUp, {}});
  }
  void run(double seconds) {
    for (int k = 0; k < 10 * seconds; ++k) {
      keeper.step(now, altitude, port);
      now = now + Time::from_seconds(0.1);
    }
  }
  void answer(Outcome outcome, const char* text = "") {
    ASSERT_FALSE(port.numbers.empty());
    keeper.hear(RequestAnswer{port.numbers.back(), outcome, text}, now, events);
  }
  std::vector<std::string> last() const {
    std::vector<std::string> names;
    if (!port.fences.empty())
      for (const Zone& zone : port.fences.back()) names.push_back(zone.name);
    return names;
  }

  FenceKeeper keeper;
  FarEnd port;
  std::vector<VehicleEvent> events;
  double altitude = 100;
  Time now;
};

using Names = std::vector<std::string>;

TEST(FenceKeeper, UploadsOnceAndAgainWhenZonesChange) {
  Fenced f({disc("a")});
  f.run(20);
  EXPECT_EQ(f.port.fences.size(), 1u);  // while there is no answer
  f.answer(Outcome::kAccepted);
  f.run(20);
  EXPECT_EQ(f.port.fences.size(), 1u);
  f.keeper.set_zones(std::vector{disc("a"), disc("b")});
  f.run(1);
  ASSERT_EQ(f.port.fences.size(), 2u);
  EXPECT_EQ(f.last(), (Names{"a", "b"}));
  f.answer(Outcome::kAccepted);
  f.keeper.set_zones({});
  f.run(10);
  ASSERT_EQ(f.port.fences.size(), 3u);
  EXPECT_TRUE(f.last().empty());
  EXPECT_EQ(f.events.size(), 2u);
  EXPECT_EQ(f.events.back().kind, EventKind::kFenceUploaded);
}

TEST(FenceKeeper, ChangesInQuickSuccessionBecomeOneUpload) {
  Fenced f({disc("a")});
  f.run(0.1);
  f.answer(Outcome::kAccepted);
  for (int k = 0; k < 20; ++k) {
    f.keeper.set_zones(std::vector{disc("n" + std::to_string(k))});
    f.run(0.2);
  }
  EXPECT_EQ(f.port.fences.size(), 1u);
  f.run(5);
  EXPECT_EQ(f.port.fences.size(), 2u);
  EXPECT_EQ(f.last(), (Names{"n19"}));
}

TEST(FenceKeeper, CountsOnlyZonesNearItsAltitudeAndTime) {
  Zone later = disc("later");
  later.from = 100;
  Fenced f({disc("low", 0, 50), disc("high", 400, 500), later});
  f.run(1);
  f.answer(Outcome::kAccepted);
  EXPECT_EQ(f.last(), (Names{"low"}));
  f.altitude = 350;
  f.run(10);
  f.answer(Outcome::kAccepted);
  EXPECT_EQ(f.last(), (Names{"high"}));
  // Between the heights at which it is taken in and left nothing changes.
  for (int k = 0; k < 20; ++k) {
    f.altitude = k % 2 == 0 ? 295 : 305;
    f.run(1);
  }
  EXPECT_EQ(f.port.fences.size(), 2u);
  f.run(100);
  EXPECT_EQ(f.last(), (Names{"high", "later"}));
}

TEST(FenceKeeper, AsksAgainAfterDenialAndSilenceButNotWhereThereIsNone) {
  Fenced f({disc("a")});
  f.run(1);
  f.answer(Outcome::kNoAnswer, "not answered");
  f.run(6);
  EXPECT_EQ(f.port.fences.size(), 2u);
  f.answer(Outcome::kNoAnswer, "not answered");
  EXPECT_EQ(f.events.size(), 1u);  // said once
  f.run(6);
  f.answer(Outcome::kDenied, "busy");
  f.run(25);
  EXPECT_EQ(f.port.fences.size(), 3u);
  f.run(10);
  EXPECT_EQ(f.port.fences.size(), 4u);
  f.answer(Outcome::kUnsupported, "none");
  f.keeper.set_zones(std::vector{disc("b")});
  f.run(100);
  EXPECT_EQ(f.port.fences.size(), 4u);
  f.keeper.hear(LinkChange{LinkChange::Kind::kRebooted, {}});
  f.run(1);
  EXPECT_EQ(f.port.fences.size(), 5u);
}

TEST(FenceKeeper, PassesOverAnswersToOthers) {
  Fenced f({disc("a")});
  f.run(1);
  f.keeper.hear(RequestAnswer{1, Outcome::kAccepted, {}}, f.now, f.events);
  f.keeper.hear(RequestAnswer{0, Outcome::kAccepted, {}}, f.now, f.events);
  EXPECT_TRUE(f.events.empty());
}

}  // namespace
}  // namespace skein::mixed::fence_keeper_test
