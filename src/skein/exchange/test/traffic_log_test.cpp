// SPDX-License-Identifier: Apache-2.0
#include "skein/exchange/traffic/traffic_log.h"

#include <gtest/gtest.h>

#include <string>

namespace skein::exchange::traffic_log_test {
namespace {

const geo::LocalFrame& frame() {
  static const geo::LocalFrame at = geo::LocalFrame::at({50, 14, 0}).value();
  return at;
}

Result<TrafficLog> parse(const std::string& text) {
  return parse_traffic_log(text, "log.csv", {frame(), 1'750'000'000});
}

std::string error_of(const std::string& text) {
  const auto log = parse(text);
  return log ? "none" : log.error().text();
}

TEST(TrafficLog, ReadsLocalPlacesOfOneAircraft) {
  const auto log = parse(
      "time_s,north_m,east_m,altitude_msl_m\r\n"
      "0,100,200,300\r\n\r\n"
      "1.5,160,200,301.5\r\n");
  ASSERT_TRUE(log) << log.error().text();
  ASSERT_EQ(log.value().flights.size(), 1u);
  const LoggedFlight& flight = log.value().flights.front();
  EXPECT_EQ(flight.id, "");
  ASSERT_EQ(flight.places.size(), 2u);
  EXPECT_EQ(flight.places[1].time, 1.5);
  EXPECT_EQ(flight.places[1].p_N, Vec3(160, 200, -301.5));
  EXPECT_EQ(log.value().rows, 2u);
}

TEST(TrafficLog, ReadsAnAdsBLogAsOpenSkyHasIt) {
  const auto log = parse(
      "time,icao24,lat,lon,velocity,heading,vertrate,callsign,onground,alert,spi,squawk,"
      "baroaltitude,geoaltitude,lastposupdate,lastcontact\n"
      "1750000010,49d1b2,50.01,14.0,40,0,0,OKABC12,False,False,False,7000,300,310,1,1\n"
      "1750000010,3c65aa,50.02,14.1,60,90,0,DEXYZ,False,False,False,7000,400,,1,1\n"
      "1750000011,49d1b2,,,40,0,0,OKABC12,False,False,False,7000,300,310,1,1\n"
      "1750000012,49d1b2,50.0107,14.0,40,0,0,OKABC12,False,False,False,7000,300,310,1,1\n"
      "1750000013,49d1b2,50.0107,14.0,0,0,0,OKABC12,True,False,False,7000,300,310,1,1\n");
  ASSERT_TRUE(log) << log.error().text();
  EXPECT_EQ(log.value().rows, 5u);
  EXPECT_EQ(log.value().left_out, 2u) << "one without a place, one on the ground";
  ASSERT_EQ(log.value().flights.size(), 2u);
  const LoggedFlight& first = log.value().flights[0];
  EXPECT_EQ(first.id, "49d1b2");
  ASSERT_EQ(first.places.size(), 2u);
  EXPECT_EQ(first.places[0].time, 10);
  EXPECT_NEAR(first.places[0].p_N.x(), 1112.3, 1) << "a hundredth of a degree";
  EXPECT_NEAR(first.places[0].p_N.y(), 0, 1e-6);
  EXPECT_EQ(first.places[0].p_N.z(), -310);
  EXPECT_EQ(log.value().flights[1].places[0].p_N.z(), -400) << "the other altitude";
  EXPECT_EQ(log.value().barometric, 1u);
}

TEST(TrafficLog, APositionThatIsRepeatedIsOld) {
  const std::string head = "time,icao24,lat,lon,geoaltitude,velocity,lastposupdate\n";
  const auto updates = parse(head +
                             "1750000000,a,50.00,14,300,60,1750000000\n"
                             "1750000001,a,50.00,14,300,60,1750000000\n"
                             "1750000002,a,50.00,14,305,60,1750000000\n"
                             "1750000003,a,50.01,14,300,60,1750000003\n"
                             "1750000004,a,50.01,14,300,0,1750000004\n");
  ASSERT_TRUE(updates) << updates.error().text();
  EXPECT_EQ(updates.value().repeated, 2u);
  ASSERT_EQ(updates.value().flights[0].places.size(), 3u) << "it hovers at the end";
  const auto speeds = parse(
      "time,lat,lon,geoaltitude,velocity\n"
      "1750000000,50,14,300,60\n1750000001,50,14,300,60\n1750000002,50,14,300,0\n");
  ASSERT_TRUE(speeds) << speeds.error().text();
  EXPECT_EQ(speeds.value().repeated, 1u);
}

// Geometric and barometric altitudes differ by 150 m here.
TEST(TrafficLog, AnAircraftFliesByAltitudesOfOneDatum) {
  const auto log = parse(
      "time,icao24,lat,lon,geoaltitude,baroaltitude\n"
      "1750000000,geometric,50,14,1000,850\n"
      "1750000000,barometric,50,14,,850\n"
      "1750000000,only,50,14,,850\n"
      "1750000010,geometric,50.01,14,,850\n"
      "1750000010,barometric,50.01,14,1000,850\n"
      "1750000020,geometric,50.02,14,1000,850\n"
      "1750000020,barometric,50.02,14,,851\n"
      "1750000030,geometric,50.03,14,1002,\n");
  ASSERT_TRUE(log) << log.error().text();
  const std::vector<LoggedFlight>& flights = log.value().flights;
  ASSERT_EQ(flights.size(), 3u);
  const auto expect = [&](std::size_t i, AltitudeDatum datum,
                          const std::vector<std::pair<double, double>>& places) {
    EXPECT_EQ(flights[i].datum, datum) << flights[i].id;
    ASSERT_EQ(flights[i].places.size(), places.size()) << flights[i].id;
    for (std::size_t k = 0; k < places.size(); ++k) {
      EXPECT_EQ(flights[i].places[k].time, places[k].first) << flights[i].id;
      EXPECT_EQ(flights[i].places[k].p_N.z(), -places[k].second) << flights[i].id;
    }
  };
  expect(0, AltitudeDatum::kGeometric, {{0, 1000}, {20, 1000}, {30, 1002}});
  expect(1, AltitudeDatum::kBarometric, {{0, 850}, {10, 850}, {20, 851}});
  expect(2, AltitudeDatum::kBarometric, {{0, 850}});
  EXPECT_EQ(log.value().other_datum, 1u);
  EXPECT_EQ(log.value().barometric, 4u);
  EXPECT_EQ(log.value().left_out, 0u);
}

TEST(TrafficLog, AltitudesAboveTheSeaComeFirst) {
  const auto log = parse(
      "time_s,north_m,east_m,altitude_ft,geoaltitude\n"
      "0,0,0,1000,400\n"
      "1,50,0,,400\n"
      "2,100,0,1000,\n"
      "3,150,0,,\n");
  ASSERT_TRUE(log) << log.error().text();
  const LoggedFlight& flight = log.value().flights.front();
  EXPECT_EQ(flight.datum, AltitudeDatum::kSeaLevel);
  ASSERT_EQ(flight.places.size(), 2u);
  EXPECT_NEAR(flight.places[1].p_N.z(), -304.8, 1e-9);
  EXPECT_EQ(log.value().other_datum, 1u);
  EXPECT_EQ(log.value().left_out, 1u);
}

TEST(TrafficLog, IsNoFolder) {
  const auto log = read_traffic_log(std::filesystem::temp_directory_path(), {frame(), 0});
  ASSERT_FALSE(log);
  EXPECT_NE(log.error().text().find("is a folder, not a file."), std::string::npos);
}

TEST(TrafficLog, CellsMayMeanNoneAndColumnsNothing) {
  const auto log = parse(
      "time,icao24,lat,lon,baroaltitude,geoaltitude,onground,hour,serials,source\n"
      "1750000000,a,50,14,300,NULL,FALSE,1750000000,[1 2],x\n"
      "1750000001,a,nan,14,300,None,FALSE,1750000000,,x\n");
  ASSERT_TRUE(log) << log.error().text();
  EXPECT_EQ(log.value().flights[0].places.at(0).p_N.z(), -300);
  EXPECT_EQ(log.value().left_out, 1u);
  EXPECT_EQ(log.value().ignored, std::vector<std::string>{"source"});
}

TEST(TrafficLog, WhatIsFarAwayIsLeftOutOrRefused) {
  const std::string head = "id,unix_s,lat,lon,altitude_ft\n";
  const auto log = parse(head + "a,1750000000,50,14,1000\nb,1750000000,-33,151,1000\n");
  ASSERT_TRUE(log) << log.error().text();
  EXPECT_EQ(log.value().far, 1u);
  ASSERT_EQ(log.value().flights.size(), 1u);
  EXPECT_NE(error_of(head + "b,1750000000,-33,151,1000\n").find("km from the origin"),
            std::string::npos);
}

TEST(TrafficLog, ReadsFeetAndLeavesOutWhatIsSaidTwice) {
  const auto log = parse(
      "id,unix_s,latitude_deg,longitude_deg,altitude_ft\n"
      "a,1750000000,50,14,1000\na,1750000000,50,14,1000\n");
  ASSERT_TRUE(log) << log.error().text();
  ASSERT_EQ(log.value().flights.front().places.size(), 1u);
  EXPECT_NEAR(log.value().flights.front().places[0].p_N.z(), -304.8, 1e-9);
}

TEST(TrafficLog, SaysWhatIsWrongAndWhere) {
  const std::string head = "time_s,north_m,east_m,altitude_msl_m\n";
  const auto expect = [](const std::string& text, const std::string& place,
                         const std::string& what) {
    const std::string error = error_of(text);
    EXPECT_NE(error.find(place), std::string::npos) << error;
    EXPECT_NE(error.find(what), std::string::npos) << error;
  };
  expect("", "log.csv:0", "is empty");
  expect("time_s,north_m,east_m\n", "log.csv:1", "altitude");
  expect("time_s,north_m,altitude_msl_m\n", "log.csv:1", "place");
  expect("north_m,east_m,altitude_msl_m\n", "log.csv:1", "time");
  expect("time_s,unix_s,north_m,east_m,altitude_msl_m\n", "log.csv:1", "time");
  expect("time_s,north_m,east_m,lat,lon,altitude_msl_m\n", "log.csv:1", "place");
  expect("time_s,north_m,east_m,height\n", "log.csv:1 height", "no column");
  expect("time_s,time_s,north_m,east_m,altitude_msl_m\n", "log.csv:1 time_s", "twice");
  expect("unix_s,time,north_m,east_m,altitude_msl_m\n", "log.csv:1 time", "the same");
  expect(head + "1,2,3\n", "log.csv:2", "3 cells; the header has 4");
  expect(head + "1,2,3,4,5\n", "log.csv:2", "5 cells");
  expect(head + "1,2,3,4\nx,2,3,4\n", "log.csv:3 time_s", "no number");
  expect(head + ",2,3,4\n", "log.csv:2", "no time");
  expect(head + "1,inf,3,4\n", "log.csv:2 north_m", "no number");
  expect(head + "1,nan,3,4\n", "log.csv", "none of its 1 rows");
  expect(head + "1,1e300,3,4\n", "log.csv:2 north_m", "must be from");
  expect(head + "1,2,3,1e6\n", "log.csv:2 altitude_msl_m", "must be from");
  expect(head + "2,2,3,4\n1,2,3,4\n", "log.csv:3", "does not grow");
  expect(head + "2,2,3,4\n2,2,3,5\n", "log.csv:3", "does not grow");
  expect(head + "2,,,\n", "log.csv", "none of its 1 rows");
  expect("time_s,lat,lon,altitude_msl_m\n1,95,14,300\n", "log.csv:2 lat", "must be from");
  expect("id," + head + ",1,2,3,4\n", "log.csv:2 id", "needs 1 to");
  expect("onground," + head + "maybe,1,2,3,4\n", "log.csv:2 onground", "neither");
  EXPECT_FALSE(read_traffic_log("/nowhere/log.csv", {frame(), 0}));
}

}  // namespace
}  // namespace skein::exchange::traffic_log_test
