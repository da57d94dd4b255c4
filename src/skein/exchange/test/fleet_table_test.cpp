// SPDX-License-Identifier: Apache-2.0
#include "skein/exchange/plan/fleet_table.h"

#include <gtest/gtest.h>

#include "skein/base/random.h"

namespace skein::exchange::fleet_table_test {
namespace {

const std::string kMetres =
    "name,start_north_m,start_east_m,start_heading_deg,goal_north_m,goal_east_m,"
    "goal_heading_deg";
const std::string kFirst = "a,0,10,90,400,-600,0";

std::string refusal_of(const std::string& text, const FleetDefaults& defaults = {}) {
  const auto read = read_fleet_table(text, "f.csv", defaults);
  if (read) return "accepted";
  return read.error().place + ": " + read.error().message;
}

TEST(FleetTable, ReadsPlacesInMetresWithDefaults) {
  FleetDefaults defaults;
  defaults.altitude = 300;
  defaults.earliest_start = 5;
  const auto read = read_fleet_table(
      "\xEF\xBB\xBF" + kMetres + ",note\r\n" + kFirst + ",x\r\n\r\nb,1,2,-90,3,4,360,\n",
      "f.csv", defaults);
  ASSERT_TRUE(read) << read.error().message;
  ASSERT_EQ(read.value().rows.size(), 2u);
  const FleetRow& a = read.value().rows[0];
  EXPECT_EQ(a.name, "a");
  EXPECT_EQ(a.start.p_N, Vec3(0, 10, -300));
  EXPECT_EQ(a.goal.p_N, Vec3(400, -600, -300));
  EXPECT_NEAR(a.start.heading, geo::kPi / 2, 1e-15);
  EXPECT_EQ(a.earliest_start, 5);
  EXPECT_EQ(a.latest_start, 5) << "it does not wait unless it may";
  EXPECT_TRUE(read.value().has_altitude);
  EXPECT_EQ(read.value().rows[1].name, "b");
}

TEST(FleetTable, ReadsPlacesOnEarthAndTimes) {
  const auto frame = geo::LocalFrame::at({50, 14, 0});
  FleetDefaults defaults;
  defaults.frame = &frame.value();
  defaults.latest_start = 100;
  const auto read = read_fleet_table(
      "goal_heading_deg,goal_longitude_deg,goal_latitude_deg,start_heading_deg,start_"
      "longitude_deg,start_latitude_deg,name,start_altitude_m,goal_altitude_m,earliest_"
      "start_s,latest_start_s\n0,14.01,50.01,0,14,50,a,200,250,20,\n0,14.01,50.01,0,14,"
      "50,b,200,250,,30\n",
      "f.csv", defaults);
  ASSERT_TRUE(read) << read.error().message;
  const FleetRow& a = read.value().rows[0];
  EXPECT_NEAR(a.start.p_N.head<2>().norm(), 0, 1e-6);
  EXPECT_NEAR((a.goal.p_N.head<2>() - frame.value().to_plane(50.01, 14.01)).norm(), 0,
              1e-9);
  EXPECT_EQ(a.start.p_N.z(), -200);
  EXPECT_EQ(a.goal.p_N.z(), -250);
  EXPECT_EQ(a.earliest_start, 20);
  EXPECT_EQ(a.latest_start, 100);
  EXPECT_EQ(read.value().rows[1].earliest_start, 0);
  EXPECT_EQ(read.value().rows[1].latest_start, 30);
}

TEST(FleetTable, SaysWhereAndWhatIsWrong) {
  const std::string head = kMetres + "\n";
  const auto expect = [](const std::string& text, const std::string& part,
                         const FleetDefaults& defaults = {}) {
    const std::string refusal = refusal_of(text, defaults);
    EXPECT_NE(refusal.find(part), std::string::npos) << refusal << "\n" << text;
  };
  expect("", "f.csv: the table is empty");
  expect(head, "f.csv: has no aircraft");
  expect("start_heading_deg,goal_heading_deg\n", "f.csv:1: column \"name\" is missing");
  expect("name," + head, "f.csv:1: column \"name\" occurs twice");
  expect(head + "a,0,10,90,400,-600\n", "f.csv:2: 6 cells, but the header has 7");
  expect(head + kFirst + "\na,0,1,2,3,4,5\n",
         "f.csv:3: column \"name\": a is there twice");
  expect(head + ",0,1,2,3,4,5\n", "f.csv:2: column \"name\": is empty");
  expect(head + "a,x,1,2,3,4,5\n",
         "f.csv:2: column \"start_north_m\": \"x\" is no number from");
  expect(head + "a,0,nan,2,3,4,5\n",
         "f.csv:2: column \"start_east_m\": \"nan\" is no number");
  expect(head + "a,0,1,2,3,2e6,5\n",
         "f.csv:2: column \"goal_east_m\": \"2e6\" is no number");
  expect(head + "a,0,1,2,9e5,9e5,5\n",
         "f.csv:2: column \"goal_north_m\": lies 1272.79 km");
  expect(head + "a,0,1,361,3,4,5\n",
         "f.csv:2: column \"start_heading_deg\": \"361\" is no number");
  expect(head + "a,,,2,3,4,5\n", "f.csv:2: column \"start_north_m\": is needed");
  expect(head + "a,0,,2,3,4,5\n", "f.csv:2: column \"start_east_m\": \"\" is no number");
  expect("start_latitude_deg," + head + "50,a,0,1,2,3,4,5\n",
         "f.csv:2: column \"start_north_m\": given with start_latitude_deg");
  expect("start_latitude_deg,start_longitude_deg," + head + "50,14,a,,,2,3,4,5\n",
         "f.csv:2: column \"start_latitude_deg\": the origin is not known");
  expect("start_altitude_m," + head + "100," + kFirst + "\n",
         "f.csv:2: column \"goal_altitude_m\": some places have an altitude");
  expect("latest_start_s,earliest_start_s," + head + "9,10," + kFirst + "\n",
         "f.csv:2: column \"latest_start_s\": 9 is before the earliest start, 10");
  expect("latest_start_s," + head + "90000," + kFirst + "\n",
         "f.csv:2: column \"latest_start_s\": 90000 is more than a day");
  FleetDefaults early;
  early.earliest_start = 10;
  early.latest_start = 5;
  expect(head + kFirst + "\n", "f.csv:2: column \"latest_start_s\": 5 is before", early);
  std::string many = head;
  for (int i = 0; i <= 10'000; ++i) many += std::to_string(i) + ",0,1,2,3,4,5\n";
  expect(many, "f.csv:10002: more than 10000 aircraft");
}

// Whatever is changed in a table: it is refused in words, or all numbers are finite.
TEST(FleetTable, AnyBytesAreReadOrRefused) {
  RandomStream draw(5, 0, Purpose::kTest);
  const std::string good = kMetres + ",latest_start_s\n" + kFirst + ",9\n";
  int accepted = 0;
  for (int i = 0; i < 2000; ++i) {
    std::string text = good;
    for (int k = 0; k <= i % 3; ++k) {
      const auto at = static_cast<std::size_t>(
          draw.uniform(0, static_cast<double>(text.size()) - 0.01));
      text[at] = static_cast<char>(draw.uniform(0, 255.9));
    }
    const auto read = read_fleet_table(text, "f.csv", {});
    if (!read) {
      EXPECT_FALSE(read.error().message.empty());
      continue;
    }
    ++accepted;
    for (const FleetRow& row : read.value().rows) {
      EXPECT_TRUE(row.start.p_N.allFinite() && row.goal.p_N.allFinite());
      EXPECT_LE(row.earliest_start, row.latest_start);
    }
  }
  EXPECT_GT(accepted, 10);
}

}  // namespace
}  // namespace skein::exchange::fleet_table_test
