// SPDX-License-Identifier: Apache-2.0
// What lies between two radios of a run, and how aircraft are turned.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "skein/assemble/kinds/kinds_of.h"
#include "skein/assemble/world/run.h"
#include "skein/data/event/record.h"
#include "skein/scenario/scenario_file.h"

namespace skein::assemble::radio_run_test {
namespace {

// What an aircraft says to its station, and where it is then.
class Log final : public Recorder {
 public:
  void record(const Record& value) override {
    if (const auto* truth = std::get_if<TruthRecord>(&value))
      truth_[truth->time.ns()] = truth->state;
    const auto* message = std::get_if<MessageRecord>(&value);
    if (message && message->message.from == EntityId{1} &&
        message->cause != LossCause::kPending)
      said_.emplace_back(message->message.sent, message->lost);
  }

  // Sent and lost by the angle [degrees, 0 to 180] between forward and the station at the
  // origin, as seen from the aircraft, in tens.
  struct Count {
    int sent = 0, lost = 0;
  };
  std::map<int, Count> by_angle() const {
    std::map<int, Count> found;
    for (const auto& [sent, lost] : said_) {
      const auto at = truth_.find(sent.ns());
      if (at == truth_.end()) continue;
      const VehicleState& state = at->second;
      const Vec3 direction_B = state.q_NB.conjugate() * -state.p_N.normalized();
      Count& count = found[static_cast<int>(
          geo::degrees(std::acos(std::clamp(direction_B.x(), -1.0, 1.0))) / 10)];
      ++count.sent;
      count.lost += lost;
    }
    return found;
  }
  Count all() const {
    Count count;
    for (const auto& [sent, lost] : said_) {
      ++count.sent;
      count.lost += lost;
    }
    return count;
  }

 private:
  std::map<std::int64_t, VehicleState> truth_;
  std::vector<std::pair<Time, bool>> said_;
};

// Circles of 200 m, 1.5 km north of the station.
Log fly(const std::string& radio, const std::string& terrain = "flat") {
  const std::string text =
      "duration_s: 190\nrecord: {rate_hz: 10}\n"
      "environment: {wind: {kind: uniform, speed_mps: 0}, terrain: " +
      terrain +
      "}\n"
      "stations: [{position_m: [0, 0], antenna_agl_m: 2}]\n"
      "aircraft: [{altitude_agl_m: 120, start: {placement: list, positions_m: [[1500, "
      "200]], heading_deg: 0}}]\n"
      "missions: [{kind: tasks, tasks: [{task: \"orbit 1500,0 radius 200\"}]}]\n"
      "radio: {kind: medium, " +
      radio + "}\n";
  const auto read = scenario::read_scenario_text(text, "test", ".", kind_table());
  EXPECT_TRUE(read.ok()) << read.report();
  Log log;
  if (!read.ok()) return log;
  QuietRun how;
  how.listener = &log;
  const auto summary = run_quietly(*read.scenario, KindRegistry(), how);
  EXPECT_TRUE(summary.ok()) << summary.error().text();
  EXPECT_GT(log.all().sent, 100);
  return log;
}

TEST(RadioOfARun, LosesWhatTheAirframeShadows) {
  const Log log =
      fly("antenna: {model: shadowed-by-body, shadow_azimuth_deg: 180, "
          "shadow_half_width_deg: 40, shadow_edge_deg: 20, shadow_depth_db: 20}");
  // Signals have 5 to 7.5 dB to spare; a fourth to a third of 20 dB is lost some 43
  // degrees from astern. Messages leave up to 0.2 s, that is 1.2 degrees, after they are
  // written.
  int in_shadow = 0, outside = 0;
  for (const auto& [tens, count] : log.by_angle()) {
    if (tens == 13) continue;  // the edge
    EXPECT_EQ(count.lost, tens > 13 ? count.sent : 0) << 10 * tens << " degrees";
    (tens > 13 ? in_shadow : outside) += count.sent;
  }
  EXPECT_GT(in_shadow, 30);
  EXPECT_GT(outside, 100);
  EXPECT_EQ(fly("antenna: {model: isotropic}").all().lost, 0);
}

TEST(RadioOfARun, AntennasOfStationsAreTheirOwn) {
  // Nothing is heard at the station from the north.
  const std::string deaf =
      "station_antenna: {model: shadowed-by-body, shadow_azimuth_deg: 0, "
      "shadow_half_width_deg: 60, shadow_depth_db: 60}";
  const auto all = fly(deaf).all();
  EXPECT_EQ(all.lost, all.sent);
}

TEST(RadioOfARun, LosesWhatAnObstacleHides) {
  // The line between is some 57 m high at the wall.
  const auto behind = [](const std::string& top) {
    return fly("obstacles: [{centre_m: [700, 0], size_m: [20, 2000], top_msl_m: " + top +
               "}]")
        .all();
  };
  const auto high = behind("100"), low = behind("40");
  EXPECT_EQ(high.lost, high.sent);
  EXPECT_EQ(low.lost, 0);
}

TEST(RadioOfARun, LosesWhatAHillHides) {
  const std::string hill =
      "{kind: hill, height_m: 250, width_m: 150, centre_m: [750, 0]}";
  const auto over = fly("terrain: true", hill).all();
  EXPECT_EQ(over.lost, over.sent);  // some 35 dB
  EXPECT_EQ(fly("terrain: false", hill).all().lost, 0);
  EXPECT_EQ(fly("terrain: true").all().lost, 0);
}

// The limit of what is heard lies on the circle, by the two-ray law; in free space, as
// with heights above sea level on the highland, all would be heard.
TEST(RadioOfARun, CountsHeightsOfTwoRaysFromItsGround) {
  const auto file = std::filesystem::path(testing::TempDir()) / "two-ray.yaml";
  std::ofstream(file) << "phy: {frequency_hz: 30.0e6, transmit_power_dbm: 0, "
                         "decode_threshold_dbm: -75.5}\n"
                         "propagation: {model: two-ray}\n";
  const std::string radio = "file: " + file.string();
  const auto sea = fly(radio).all(),
             highland = fly(radio, "{kind: flat, elevation_m: 500}").all();
  EXPECT_GT(sea.lost, sea.sent / 10);
  EXPECT_LT(sea.lost, sea.sent);
  // The aircraft flies on air that is thinner there.
  EXPECT_EQ(highland.sent, sea.sent);
  EXPECT_NEAR(highland.lost, sea.lost, sea.sent / 20);
}

}  // namespace
}  // namespace skein::assemble::radio_run_test
