// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <bit>
#include <cmath>

#include "skein/geo/vec.h"
#include "skein/scenario/numbers.h"
#include "skein/scenario/test/fake_kinds.h"
#include "skein/scenario/test/reading.h"

namespace skein::scenario::test::write_test {
namespace {

// Writing is one-to-one on everything that reading gives: numbers are written with the
// shortest text that reads back as the same bits. So equal texts mean equal scenarios.
std::string write(const Scenario& scenario) {
  return write_scenario(scenario, fake_kinds());
}

Scenario with_radio(const FakeOptions& options) {
  Scenario scenario;
  scenario.radio = {"joint", options};
  return scenario;
}

FakeOptions round_trip(const FakeOptions& options) {
  return read_good(write(with_radio(options))).radio.as<FakeOptions>();
}

TEST(Write, GivesAFileThatReadsAsTheSameScenario) {
  const Scenario s = read_good(
      "name: \"yes: # 'odd' \\\"name\\\" \\u2028 \\n end\"\n"
      "seed: 9223372036854775807\n"
      "duration_s: 0.000000001\n"
      "origin: {latitude_deg: -33.123456789012345, longitude_deg: 179.99999999999997}\n"
      "environment:\n  zones_m: [[[0, 0], [0, 1], [1, 1e-300]], [[5, 5], [6, 6], [7, "
      "5]]]\n"
      "aircraft:\n"
      "  - {count: 0, leave_s: 5, start: {heading_deg: 359.9, first_bearing_deg: 0.1}}\n"
      "  - {sensors: [], failures: [{at_s: 1}, {at_s: 2, kind: land, until_s: 3}]}\n"
      "radio: {kind: joint, courses_deg: [10, -20.7]}\n");
  const std::string text = write(s);
  const Scenario again = read_good(text);
  EXPECT_EQ(write(again), text);
  EXPECT_EQ(again.name, s.name);
  EXPECT_EQ(again.seed, s.seed);
  EXPECT_EQ(again.duration, Time::from_ns(1));
  EXPECT_EQ(again.environment.zone_rings, s.environment.zone_rings);
  EXPECT_EQ(again.aircraft.at(0).start.heading, s.aircraft.at(0).start.heading);
  EXPECT_EQ(again.radio.as<FakeOptions>().courses, s.radio.as<FakeOptions>().courses);
}

TEST(Write, FillsInEveryDefault) {
  const std::string text = write(read_good("name: x"));
  EXPECT_NE(text.find("\nduration_s: 3600\nstep_s: 0.1\n"), std::string::npos) << text;
  EXPECT_NE(text.find("\naircraft:\n  - name: scout\n    count: 1\n"), std::string::npos);
  EXPECT_NE(text.find("\nradio:\n  kind: ideal\n  airspeed_mps: 20\n"),
            std::string::npos);
  EXPECT_NE(text.find("    sensors: [gnss, "), std::string::npos) << text;
  EXPECT_NE(text.find("    leave_s: null\n"), std::string::npos);
}

TEST(Write, KeepsAbsoluteFilePaths) {
  const Scenario s = read_good("radio: {kind: joint, map: CMakeLists.txt}");
  const ReadOutcome moved =
      read_scenario_text(write(s), "run.yaml", "/somewhere/else", fake_kinds());
  ASSERT_EQ(moved.report(), "");
  EXPECT_EQ(moved.scenario->radio.as<FakeOptions>().map,
            SKEIN_SOURCE_DIR "/CMakeLists.txt");
}

// Defaults that no number of degrees gives exactly are rounded on reading, so that the
// run and its repetition from the written-out file have the same bits.
TEST(Write, KeepsTheBitsOfDefaultAngles) {
  const Scenario first = read_good("name: x");
  const Scenario second = read_good(write(first));
  const auto& a = first.radio.as<FakeOptions>();
  const auto& b = second.radio.as<FakeOptions>();
  EXPECT_EQ(a, b);
  EXPECT_NEAR(a.bank, FakeOptions{}.bank, 1e-15);  // one rounding
}

TEST(Write, RoundTripsAllOptions) {
  rc::check([] {
    FakeOptions o;
    const auto real = [](double low, double high) {
      const auto share =
          static_cast<double>(*rc::gen::inRange<std::int64_t>(0, 1LL << 53));
      return std::clamp(low + (high - low) * std::ldexp(share, -53), low, high);
    };
    o.airspeed = real(1e-9, 100);
    o.bank = geo::radians(real(1e-3, 79));
    o.timeout = Time::from_ns(*rc::gen::inRange<std::int64_t>(0, 4'000'000'000'000'000));
    o.delay = real(0, 10);
    o.harmonics = *rc::gen::inRange(0, 31);
    o.robust = *rc::gen::arbitrary<bool>();
    o.label = *rc::gen::container<std::string>(rc::gen::inRange(' ', '\x7F'));
    o.method = *rc::gen::element(Method::kEuler, Method::kHeun);
    o.drift = {real(-1e7, 1e7), real(-1, 1)};
    o.gains.assign(*rc::gen::inRange<std::size_t>(1, 5), real(0, 1e300));
    o.points.assign(*rc::gen::inRange<std::size_t>(0, 12), {real(-9, 9), 0});
    o.layers.assign(*rc::gen::inRange<std::size_t>(0, 4), {real(1, 2), real(-5, 5)});
    if (*rc::gen::arbitrary<bool>()) o.limit = real(1e-300, 1);
    if (*rc::gen::arbitrary<bool>()) o.extra = Layer{real(1, 2), 0};
    o.courses.assign(*rc::gen::inRange<std::size_t>(0, 12),
                     geo::radians(real(-360, 360)));
    RC_ASSERT(round_trip(o) == o);
  });
}

TEST(Numbers, AnglesFromDegreesKeepTheirBits) {
  rc::check([] {
    const double degrees =
        std::bit_cast<double>(*rc::gen::inRange<std::int64_t>(0, 0x4076800000000000));
    const double radians = geo::radians(degrees);  // from 0 to 360 degrees
    RC_ASSERT(geo::radians(*parse_number(degrees_text(radians))) == radians);
  });
}

TEST(Numbers, DegreesAreWrittenAsTheyWereGiven) {
  for (int tenth = -3600; tenth <= 3600; ++tenth) {
    const double degrees = tenth / 10.0;
    EXPECT_EQ(degrees_text(geo::radians(degrees)), number_text(degrees));
  }
}

TEST(Numbers, SecondsAreExact) {
  EXPECT_EQ(seconds_text(Time::from_ns(0)), "0");
  EXPECT_EQ(seconds_text(Time::from_ns(100'000'000)), "0.1");
  EXPECT_EQ(seconds_text(Time::from_ns(-1'000'000'001)), "-1.000000001");
  EXPECT_EQ(seconds_text(Time::from_ns(3'600'000'000'000)), "3600");
}

TEST(Numbers, TakesOnlyWholeDecimalNumbers) {
  for (const char* text : {"1", "-1.5", "+2", ".5", "1.", "1e3", "1E-3"}) {
    EXPECT_TRUE(parse_number(text)) << text;
  }
  for (const char* text : {"", "+", "-", "+-1", "++1", "1,5", "0x10", "1_000", " 1", "1 ",
                           "1e", "one", "1e999", "1..2"}) {
    EXPECT_FALSE(parse_number(text)) << text;
  }
}

}  // namespace
}  // namespace skein::scenario::test::write_test
