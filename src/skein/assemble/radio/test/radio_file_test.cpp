#include "skein/assemble/radio/radio_file.h"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <filesystem>

namespace skein::assemble {
namespace {

std::string problems_with(const std::string& text) {
  const auto file = read_radio(text, "x.yaml");
  return file.ok() ? "" : file.error().text();
}

TEST(BuiltInRadios, AreGoodAndNamedLikeTheirFiles) {
  EXPECT_GE(built_in_radios().size(), 5u);
  for (const BuiltInRadio& each : built_in_radios()) {
    const auto file = load_radio(std::string(each.name), {});
    ASSERT_TRUE(file.ok()) << file.error().text();
    EXPECT_EQ(file.value().name, each.name);
    EXPECT_FALSE(file.value().description.empty()) << each.name;
  }
}

TEST(RadioFile, ReadsWhatItWrites) {
  for (const BuiltInRadio& each : built_in_radios()) {
    const auto file = load_radio(std::string(each.name), {});
    ASSERT_TRUE(file.ok());
    const std::string written = write_radio(file.value());
    const auto again = read_radio(written, "written");
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
    const auto file = load_radio(each.path().string(), {});
    ASSERT_TRUE(file.ok()) << file.error().text();
    EXPECT_EQ(file.value().name, each.path().stem());
    ++count;
  }
  EXPECT_GT(count, 20);
  const auto k7 = load_radio((folder / "nn4_rts_k7.yaml").string(), {});
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
  const auto missing = load_radio("wifi-dsss", {});
  ASSERT_FALSE(missing.ok());
  EXPECT_NE(missing.error().text().find("Did you mean \"wifi-dsss-2\"?"),
            std::string::npos);
}

}  // namespace
}  // namespace skein::assemble
