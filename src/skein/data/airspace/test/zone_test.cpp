// SPDX-License-Identifier: Apache-2.0
#include "skein/data/airspace/zone.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "skein/base/math.h"
#include "skein/base/random.h"
#include "skein/data/airspace/zone_set.h"

namespace skein::zone_test {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

Zone square(const std::string& name, double half = 100) {
  Zone zone{.area =
                geo::Ring{{-half, -half}, {half, -half}, {half, half}, {-half, half}}};
  zone.name = name;
  return zone;
}

std::string error_of(const geo::Ring& ring) {
  return error_in(Zone{.area = ring}).value_or("");
}

TEST(Zone, SaysWhatIsWrongWithARing) {
  EXPECT_EQ(error_of({{0, 0}, {10, 0}, {10, 10}}), "");
  EXPECT_EQ(error_of({{0, 0}, {10, 10}, {10, 0}}), "");  // in the opposite sense
  EXPECT_NE(error_of({{0, 0}, {10, 0}}).find("fewer than 3"), std::string::npos);
  EXPECT_NE(error_of({{0, 0}, {10, 0}, {20, 0}}).find("no area"), std::string::npos);
  EXPECT_NE(error_of({{5, 5}, {5, 5}, {5, 5}}).find("no area"), std::string::npos);
  EXPECT_NE(error_of({{0, 0}, {10, 0}, {kNan, 10}}).find("corner 2"), std::string::npos);
  EXPECT_NE(error_of({{0, 0}, {math::kInfinity, 0}, {9, 9}}).find("corner 1"),
            std::string::npos);
  EXPECT_NE(error_of(geo::Ring(kMaxCorners + 1, Vec2(1, 1))).find("2001 corners"),
            std::string::npos);
}

TEST(Zone, SaysWhereARingCrossesItself) {
  const std::string error = error_of({{0, 0}, {10, 10}, {10, 0}, {0, 10}});
  EXPECT_NE(error.find("5.0 m north, 5.0 m east"), std::string::npos) << error;
  EXPECT_NE(error.find("corners 0 and 2"), std::string::npos) << error;
}

TEST(Zone, SaysWhatIsWrongWithDiscsLimitsAndTimes) {
  const auto disc = [](double radius) {
    return error_in(Zone{.area = Disc{{0, 0}, radius}}).has_value();
  };
  EXPECT_FALSE(disc(10));
  for (const double radius : {0.0, -1.0, kNan, math::kInfinity})
    EXPECT_TRUE(disc(radius));
  EXPECT_TRUE(error_in(Zone{.area = Disc{{kNan, 0}, 10}}));
  Zone zone = square("a");
  zone.floor_msl = zone.ceiling_msl = 100;
  EXPECT_NE(error_in(zone)->find("floor"), std::string::npos);
  zone.ceiling_msl = kNan;
  EXPECT_TRUE(error_in(zone));
  zone = square("a");
  zone.from = 20;
  zone.until = 10;
  EXPECT_NE(error_in(zone)->find("end"), std::string::npos);
}

TEST(Zone, ConcernsFlightsThatShareAltitudeAndTime) {
  Zone zone = square("a");
  zone.floor_msl = 200;
  zone.ceiling_msl = 300;
  zone.from = 50;
  zone.until = 60;
  EXPECT_TRUE(concerns(zone, 100, 200, 0, 50));
  EXPECT_TRUE(concerns(zone, 250, 260, 55, 56));
  EXPECT_FALSE(concerns(zone, 100, 199, 0, 100));
  EXPECT_FALSE(concerns(zone, 301, 400, 0, 100));
  EXPECT_FALSE(concerns(zone, 250, 260, 0, 49));
  EXPECT_FALSE(concerns(zone, 250, 260, 61, 90));
}

ZoneChange change(std::uint32_t number, bool on, const std::string& name,
                  double half = 100) {
  return {number, on, square(name, half)};
}

std::string names(const ZoneSet& book) {
  std::string all;
  for (const Zone& zone : book.zones()) all += zone.name;
  return all;
}

TEST(ZoneSet, TakesZonesInAndBack) {
  const std::vector<Zone> known{square("a")};
  ZoneSet book(known);
  EXPECT_EQ(names(book), "a");
  EXPECT_FALSE(book.heard("a"));
  EXPECT_TRUE(book.take(change(1, true, "b")));
  EXPECT_EQ(names(book), "ab");
  EXPECT_TRUE(book.take(change(2, false, "a")));
  EXPECT_EQ(names(book), "b");
  EXPECT_FALSE(book.take(change(2, false, "a")));  // given twice
  EXPECT_TRUE(book.take(change(3, true, "b", 50)));
  ASSERT_EQ(names(book), "b");
  EXPECT_EQ(std::get<geo::Ring>(book.zones()[0].area)[0], Vec2(-50, -50));
  EXPECT_TRUE(book.heard("a"));
  EXPECT_EQ(book.complete_to(), 3u);
}

TEST(ZoneSet, PassesOverWhatCannotBe) {
  ZoneSet book;
  EXPECT_FALSE(book.take(change(0, true, "a")));
  ZoneChange bad = change(1, true, "a");
  bad.zone.area = geo::Ring{{0, 0}, {kNan, 0}, {1, 1}};
  EXPECT_FALSE(book.take(bad));
  EXPECT_TRUE(book.zones().empty());
  EXPECT_EQ(book.complete_to(), 0u);
}

TEST(ZoneSet, ReceivedInAnyOrderAndTwiceTheZonesAreTheSame) {
  for (std::uint32_t run = 0; run < 200; ++run) {
    RandomStream random(1, run, Purpose::kTest);
    std::vector<ZoneChange> reported;
    ZoneSet straight;
    for (std::uint32_t k = 1; k <= 12; ++k) {
      const std::string name(1, static_cast<char>('a' + random.uniform(0, 3)));
      reported.push_back(change(k, random.uniform() < 0.6, name, 10.0 + k));
      straight.take(reported.back());
    }
    ZoneSet shuffled;
    std::vector<ZoneChange> left = reported;
    left.insert(left.end(), reported.begin(), reported.end());
    std::uint32_t heard = 0;  // as bits
    while (!left.empty()) {
      const auto k = static_cast<std::ptrdiff_t>(
          random.uniform(0, static_cast<double>(left.size())));
      heard |= 1u << left[static_cast<std::size_t>(k)].number;
      shuffled.take(left[static_cast<std::size_t>(k)]);
      left.erase(left.begin() + k);
      std::uint32_t complete = 0;
      while ((heard >> (complete + 1) & 1u) != 0) ++complete;
      ASSERT_EQ(shuffled.complete_to(), complete);
    }
    const auto areas = [](const ZoneSet& book) {
      std::vector<std::pair<std::string, double>> all;
      for (const Zone& zone : book.zones())
        all.emplace_back(zone.name, geo::signed_area(std::get<geo::Ring>(zone.area)));
      std::sort(all.begin(), all.end());
      return all;
    };
    ASSERT_EQ(areas(shuffled), areas(straight));
  }
}

}  // namespace
}  // namespace skein::zone_test
