// SPDX-License-Identifier: Apache-2.0
#include "skein/assemble/radio/radio_file.h"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cmath>
#include <filesystem>

namespace skein::assemble::radio_file_test {
namespace {

const RadioParts& parts() {
  static const RadioParts all = own_radio_parts();
  return all;
}

std::string problems_with(const std::string& text) {
  const auto file = read_radio(text, "x.yaml", parts());
  return file.ok() ? "" : file.error().text();
}

TEST(BuiltInRadios, AreGoodAndNamedLikeTheirFiles) {
  EXPECT_GE(built_in_radios().size(), 5u);
  for (const BuiltInRadio& each : built_in_radios()) {
    const auto file = load_radio(std::string(each.name), {}, parts());
    ASSERT_TRUE(file.ok()) << file.error().text();
    EXPECT_EQ(file.value().name, each.name);
    EXPECT_FALSE(file.value().description.empty()) << each.name;
  }
}

TEST(RadioFile, ReadsWhatItWrites) {
  for (const BuiltInRadio& each : built_in_radios()) {
    const auto file = load_radio(std::string(each.name), {}, parts());
    ASSERT_TRUE(file.ok());
    const std::string written = write_radio(file.value());
    const auto again = read_radio(written, "written", parts());
    ASSERT_TRUE(again.ok()) << again.error().text();
    EXPECT_EQ(write_radio(again.value()), written);
  }
}

TEST(RadioFile, ReadsAllProfilesOfTheReference) {
  const std::filesystem::path folder = SKEIN_SHARED_DATA "/net/profiles";
  if (!std::filesystem::exists(folder))
    GTEST_SKIP() << "the reference is not part of the project";
  int count = 0;
  for (const auto& each : std::filesystem::directory_iterator(folder)) {
    const auto file = load_radio(each.path().string(), {}, parts());
    ASSERT_TRUE(file.ok()) << file.error().text();
    EXPECT_EQ(file.value().name, each.path().stem());
    ++count;
  }
  EXPECT_GT(count, 20);
  const auto k7 = load_radio((folder / "nn4_rts_k7.yaml").string(), {}, parts());
  EXPECT_EQ(k7.value().radio.mac.backoff_slots, 7u);
  EXPECT_EQ(k7.value().radio.phy.packet_error, communication::PacketError::kHalf);
  EXPECT_EQ(k7.value().radio.mac.rts_threshold_bytes, 500u);
}

TEST(RadioFile, SaysWhatIsWrong) {
  EXPECT_NE(problems_with("phy: {frequency_hz: 0}").find("phy.frequency_hz"),
            std::string::npos);
  EXPECT_NE(problems_with("phy: {transmit_power_dbm: -1e9}").find("-200"),
            std::string::npos);
  EXPECT_NE(
      problems_with("mac: {backoff_slots: many}").find("\"random\" or a whole number"),
      std::string::npos);
  EXPECT_NE(problems_with("mac: {queue_lifetime_s: -1}").find("\"none\" or a number"),
            std::string::npos);
  EXPECT_NE(
      problems_with("mac: {cw_min: 63, cw_max: 31}").find("must not be below cw_min"),
      std::string::npos);
  EXPECT_NE(problems_with("phy: {lock_window_us: 500}").find("shorter than preamble"),
            std::string::npos);
  EXPECT_NE(
      problems_with("phy: {interference_floor_dbm: -50}").find("not be above decode"),
      std::string::npos);
  const auto missing = load_radio("wifi-dsss", {}, parts());
  ASSERT_FALSE(missing.ok());
  EXPECT_NE(missing.error().text().find("Did you mean \"wifi-dsss-2\"?"),
            std::string::npos);
}

// An error model describes one rate; lines have no bit errors.
TEST(RadioFile, RefusesRatesThatItsErrorModelIsNotFor) {
  const std::string fast = problems_with("phy: {rate_bps: 11000000}");
  EXPECT_NE(fast.find("phy.rate_bps: must be 2000000 with error_model dsss-2"),
            std::string::npos)
      << fast;
  EXPECT_NE(fast.find("11000000 cck-11"), std::string::npos);
  for (const char* good :
       {"rate_bps: 1.0e6, error_model: dsss-1", "rate_bps: 2.0e6",
        "rate_bps: 5.5e6, error_model: cck-5-5", "rate_bps: 11.0e6, error_model: cck-11",
        "rate_bps: 11.0e6, error_model: threshold", "rate_bps: 10.0e6, error_model: fsk"})
    EXPECT_EQ(problems_with(std::string("phy: {") + good + "}"), "") << good;
  for (const char* bad :
       {"rate_bps: 2.0e6, error_model: dsss-1", "rate_bps: 11.0e6, error_model: cck-5-5",
        "error_model: cck-11", "rate_bps: 11.0e6, error_model: fsk"})
    EXPECT_NE(problems_with(std::string("phy: {") + bad + "}").find("phy.rate_bps"),
              std::string::npos)
        << bad;
  EXPECT_EQ(problems_with("{phy: {rate_bps: 5.0e6}, mac: {access: direct}}"), "");
  EXPECT_NE(problems_with("phy: {error_model: dsss2}").find("Did you mean \"dsss-2\"?"),
            std::string::npos);
}

TEST(RadioFile, MakesTheErrorModelThatItNames) {
  const auto at = [](const std::string& phy) {
    const auto file = read_radio("phy: {" + phy + "}", "x.yaml", parts());
    EXPECT_TRUE(file.ok()) << file.error().text();
    return file.value().radio.phy.error_model->log_payload_success(1, 1e-3);
  };
  EXPECT_EQ(at("error_model: threshold, lock_sinr_db: 0"), 0);
  EXPECT_LT(at("error_model: threshold, lock_sinr_db: 0.1"), -600);
  // At 0 dB the slower ones are understood better.
  EXPECT_GT(at("rate_bps: 1.0e6, error_model: dsss-1"), at(""));
  EXPECT_GT(at(""), at("rate_bps: 5.5e6, error_model: cck-5-5"));
  EXPECT_GT(at("rate_bps: 5.5e6, error_model: cck-5-5"),
            at("rate_bps: 11.0e6, error_model: cck-11"));
  EXPECT_LT(at("rate_bps: 1.0e6, error_model: fsk"), 0);
}

// So that links need not look at it.
TEST(RadioParts, AnAntennaThatIsAlikeInAllDirectionsIsNone) {
  const auto file = read_radio("antenna: {model: isotropic}", "x.yaml", parts());
  ASSERT_TRUE(file.ok());
  EXPECT_EQ(make_antenna(parts(), file.value().antenna).value(), nullptr);
  const auto dipole = read_radio("antenna: {model: dipole}", "x.yaml", parts());
  EXPECT_NE(make_antenna(parts(), dipole.value().antenna).value(), nullptr);
}

TEST(RadioFile, KeepsObstaclesAndAntennas) {
  const auto file = read_radio(R"(
propagation:
  obstacles:
    - {ring_m: [[0, 0], [0, 10], [10.5, 5]], top_msl_m: 30}
    - {centre_m: [100, 50], size_m: [20, 40], base_msl_m: 5, top_msl_m: 30, attenuation_db: 12.5}
    - {centre_m: [0, 200], radius_m: 7, top_msl_m: 60, attenuation_db: .inf}
antenna: {model: shadowed-by-body, shadow_azimuth_deg: 170, shadow_depth_db: 25}
station_antenna:
  model: table
  azimuths_deg: [0, 90, 180.1, 270]
  elevations_deg: [0, 45]
  gains_db: [[0, -1, -2, -1], [-3, -3, -3, -3]]
)",
                               "x.yaml", parts());
  ASSERT_TRUE(file.ok()) << file.error().text();
  const auto& obstacles = file.value().propagation.section.obstacles;
  ASSERT_EQ(obstacles.size(), 3u);
  EXPECT_TRUE(std::isinf(obstacles[0].attenuation_db));
  const auto& box = std::get<geo::Ring>(obstacles[1].area);
  EXPECT_EQ(box[0], Vec2(90, 30));
  EXPECT_EQ(box[2], Vec2(110, 70));
  EXPECT_EQ(obstacles[1].attenuation_db, 12.5);
  EXPECT_EQ(obstacles[1].base_msl, 5);
  EXPECT_EQ(std::get<Disc>(obstacles[2].area).radius, 7);
  EXPECT_TRUE(std::isinf(obstacles[2].attenuation_db));
  EXPECT_EQ(file.value().station_antenna.section.gains_db[1].size(), 4u);
  const std::string written = write_radio(file.value());
  const auto again = read_radio(written, "written", parts());
  ASSERT_TRUE(again.ok()) << again.error().text();
  EXPECT_EQ(write_radio(again.value()), written);
}

TEST(RadioFile, RefusesTimesThatAreNoNanosecond) {
  EXPECT_NE(problems_with("mac: {sifs_us: 1e-9}").find("mac.sifs_us"), std::string::npos);
  EXPECT_NE(problems_with("mac: {queue_lifetime_s: 1e-12}").find("queue_lifetime_s"),
            std::string::npos);
  EXPECT_EQ(problems_with("mac: {sifs_us: 0.001, queue_lifetime_s: 1e-9}"), "");
}

TEST(RadioFile, AdaptsPowerWithAcknowledgementsOnly) {
  const auto file =
      read_radio("mac: {adaptive_power: true, power_margin_db: 9, min_power_dbm: -5}",
                 "x.yaml", parts());
  ASSERT_TRUE(file.ok()) << file.error().text();
  EXPECT_TRUE(file.value().radio.mac.adaptive_power);
  EXPECT_EQ(file.value().radio.mac.power_margin_db, 9);
  EXPECT_NE(problems_with("mac: {adaptive_power: true, access: direct}")
                .find("mac.adaptive_power: needs access: dcf"),
            std::string::npos);
}

TEST(RadioFile, SaysWhatIsWrongWithObstacles) {
  const auto with = [](const std::string& obstacle) {
    return problems_with("propagation: {obstacles: [{" + obstacle + "}]}");
  };
  EXPECT_EQ(with("centre_m: [0, 0], radius_m: 5, top_msl_m: 10"), "");
  EXPECT_NE(with("centre_m: [0, 0], top_msl_m: 10").find("needs ring_m, or centre_m"),
            std::string::npos);
  EXPECT_NE(with("centre_m: [0, 0], size_m: [1, 1], radius_m: 5, top_msl_m: 10")
                .find("one of these only"),
            std::string::npos);
  EXPECT_NE(with("centre_m: [0, 0], size_m: [1, 0], top_msl_m: 10")
                .find("obstacles[0].size_m: both must be above 0"),
            std::string::npos);
  EXPECT_NE(with("centre_m: [0, 0], radius_m: 5, top_msl_m: 0")
                .find("must be above base_msl_m"),
            std::string::npos);
  EXPECT_NE(with("centre_m: [0, 0], radius_m: 5").find("top_msl_m"), std::string::npos);
  EXPECT_NE(with("centre_m: [0, 0], radius_m: 5, top_msl_m: 9, attenuation_db: -1")
                .find("\"opaque\", .inf or a number from 0 to 300"),
            std::string::npos);
  EXPECT_NE(with("ring_m: [[0, 0], [10, 10], [10, 0], [0, 10]], top_msl_m: 9")
                .find("crosses itself"),
            std::string::npos);
}

TEST(RadioFile, SaysWhatIsWrongWithAntennas) {
  const auto with = [](const std::string& antenna) {
    return problems_with("antenna: {" + antenna + "}");
  };
  EXPECT_EQ(with("model: dipole"), "");
  EXPECT_NE(with("model: table").find("antenna.azimuths_deg: must not be empty"),
            std::string::npos);
  EXPECT_NE(with("azimuths_deg: [90, 0], elevations_deg: [0], gains_db: [[0, 0]]")
                .find("must grow"),
            std::string::npos);
  EXPECT_NE(with("azimuths_deg: [0, 90], elevations_deg: [0], gains_db: [[0]]")
                .find("row 0 has 1 gains; needs one for each of 2 azimuths"),
            std::string::npos);
  EXPECT_NE(with("azimuths_deg: [0], elevations_deg: [0, 1], gains_db: [[0]]")
                .find("has 1 rows; needs one for each of 2 elevations"),
            std::string::npos);
  EXPECT_NE(with("azimuths_deg: [360]").find("below 360"), std::string::npos);
  EXPECT_NE(with("shadow_half_width_deg: 5, shadow_edge_deg: 11").find("at most twice"),
            std::string::npos);
  EXPECT_NE(with("model: dipol").find("Did you mean \"dipole\"?"), std::string::npos);
}

}  // namespace
}  // namespace skein::assemble::radio_file_test
