// SPDX-License-Identifier: Apache-2.0
#include "skein/link/flight_model/flightgear.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <fstream>
#include <sstream>

namespace skein::flight_model::flightgear_test {
namespace {

// Numbers of one line, in its order.
std::string line_of(const std::string& numbers) {
  return "skein-1," + numbers + "\n";
}

constexpr const char* kTurn =
    "12.5,36.989,-122.0514,1000,30,5,270,0.01,0.02,-0.03,10,-100,5,20,-10,0.75,0,0,0";

TEST(FlightGear, ReadsALineInSi) {
  const auto read = parse_flightgear(line_of(kTurn));
  ASSERT_TRUE(read) << read.error().text();
  const FlightState& state = read.value();
  EXPECT_EQ(state.time, 12.5);
  EXPECT_EQ(state.place.latitude_deg, 36.989);
  EXPECT_EQ(state.place.longitude_deg, -122.0514);
  EXPECT_NEAR(state.place.height_m, 304.8, 1e-9);
  const geo::Euler attitude = geo::to_euler(state.q_NB);
  EXPECT_NEAR(geo::degrees(attitude.roll), 30, 1e-9);
  EXPECT_NEAR(geo::degrees(attitude.pitch), 5, 1e-9);
  EXPECT_NEAR(geo::degrees(attitude.yaw), -90, 1e-9);
  EXPECT_EQ(state.w_NB_B, Vec3(0.01, 0.02, -0.03));
  EXPECT_LT((state.v_N - Vec3(3.048, -30.48, 1.524)).norm(), 1e-9);
  EXPECT_LT((state.wind_N - Vec3(-6.096, 3.048, 0)).norm(), 1e-9)
      << "FlightGear says where it comes from";
  EXPECT_EQ(state.fuel, 0.75);
  EXPECT_FALSE(state.on_ground);
  const auto rolling =
      parse_flightgear(line_of("1,36,-122,10,0,0,0,0,0,0,0,0,0,0,0,1,0,1,0"));
  ASSERT_TRUE(rolling);
  EXPECT_TRUE(rolling.value().on_ground);
}

TEST(FlightGear, RefusesWhatIsNoLine) {
  const auto error = [](const std::string& line) {
    const auto read = parse_flightgear(line);
    return read ? std::string() : read.error().message;
  };
  const std::string good = kTurn;
  EXPECT_EQ(error(line_of(good)), "");
  EXPECT_EQ(error("skein-1," + good + "\r\n"), "");
  EXPECT_NE(error("skein-2," + good), "") << "of another form";
  EXPECT_NE(error(good), "");
  EXPECT_NE(error(""), "");
  EXPECT_NE(error(line_of(good + ",1")), "");
  EXPECT_NE(error(line_of(good.substr(0, good.rfind(',')))), "");
  EXPECT_NE(error(line_of("x" + good)), "");
  for (const char* bad : {"nan", "inf", "1e999", "", " 1"}) {
    std::string line = good;
    line.replace(0, 4, bad);
    EXPECT_NE(error(line_of(line)), "") << bad;
  }
}

TEST(FlightGear, RefusesStatesThatNoAircraftHas) {
  const std::string good = kTurn;
  const auto refused = [&](const std::string& from, const std::string& to) {
    std::string line = good;
    line.replace(line.find(from), from.size(), to);
    return !parse_flightgear(line_of(line)).ok();
  };
  EXPECT_TRUE(refused("36.989", "91"));
  EXPECT_TRUE(refused("-122.0514", "-181"));
  EXPECT_TRUE(refused("1000", "1e6"));
  EXPECT_TRUE(refused("-0.03", "700"));
  EXPECT_TRUE(refused("-100", "-20000"));
  EXPECT_TRUE(refused("0.75", "1.5"));
  EXPECT_TRUE(refused("12.5", "-1"));
}

TEST(FlightGear, TellsItTheControlsInItsSigns) {
  Actuators actuators;
  actuators[channel::kAileron] = 0.5;    // rolls right
  actuators[channel::kElevator] = 0.25;  // pitches down
  actuators[channel::kRudder] = -1;      // yaws right
  actuators[channel::kThrottle] = 0.75;
  actuators[channel::kBrake] = 0;
  FlightControls controls = controls_of(actuators);
  // Its elevator pitches down, its rudder yaws right.
  EXPECT_EQ(flightgear_line(controls),
            "0.500000,0.250000,1.000000,0.750000,0.750000,0.000000,0.000000\n");
  controls.wind_N = Vec3(-3.048, 6.096, 0);
  EXPECT_EQ(flightgear_line(controls),
            "0.500000,0.250000,1.000000,0.750000,0.750000,0.000000,0.000000,"
            "10.0000,-20.0000\n");
}

RC_GTEST_PROP(FlightGear, ControlsStayWithinTheirBounds, ()) {
  Actuators actuators;
  for (double& each : actuators.channel) each = *rc::gen::arbitrary<double>();
  actuators[channel::kAileron] =
      *rc::gen::element(1.0, -7.0, std::numeric_limits<double>::quiet_NaN(), 1e300);
  const FlightControls c = controls_of(actuators);
  for (const double surface : {c.aileron, c.elevator, c.rudder})
    RC_ASSERT(surface >= -1 && surface <= 1);
  for (const double share : {c.throttle, c.brake}) RC_ASSERT(share >= 0 && share <= 1);
}

TEST(FlightGear, TheProtocolFileHasANumberForEachPlaceOfTheLine) {
  const std::string text = flightgear_protocol();
  const auto count = [&](const std::string& what, const std::string& in) {
    int found = 0;
    for (std::size_t at = in.find(what); at != std::string::npos;
         at = in.find(what, at + 1))
      ++found;
    return found;
  };
  const std::size_t input = text.find("<input>");
  ASSERT_NE(input, std::string::npos);
  EXPECT_EQ(count("<chunk>", text.substr(0, input)), 1 + count(",", kTurn));
  FlightControls controls;
  controls.wind_N = Vec3::Zero();
  EXPECT_EQ(count("<chunk>", text.substr(input)),
            1 + count(",", flightgear_line(controls)));
  EXPECT_NE(text.find("skein-1,%.6f"), std::string::npos);
  // FlightGear refuses what is not well-formed: "--" belongs to the ends of comments.
  EXPECT_EQ(count("--", text), count("<!--", text) + count("-->", text));
}

// For who starts FlightGear by hand.
TEST(FlightGear, TheProtocolFileLiesWithTheScenarios) {
  std::ifstream in(SKEIN_SOURCE_DIR "/scenarios/flightgear/Protocol/skein.xml");
  std::ostringstream text;
  text << in.rdbuf();
  EXPECT_EQ(text.str(), flightgear_protocol());
}

}  // namespace
}  // namespace skein::flight_model::flightgear_test
