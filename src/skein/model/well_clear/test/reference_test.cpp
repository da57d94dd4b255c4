// SPDX-License-Identifier: Apache-2.0
// Against answers of another program: the reference data's, where they are stable.
#include "skein/model/well_clear/test/reference_encounters.h"

namespace skein::model::test::reference_test {
namespace {

// The tables have six decimals.
constexpr double kRounding = 6e-7;
constexpr double kInf = std::numeric_limits<double>::infinity();

class WellClearReference : public testing::Test {
 protected:
  void SetUp() override {
    if (sets_.empty()) GTEST_SKIP() << "without ../shared/data/team/detect";
    ASSERT_EQ(sets_.size(), 2U) << "one of the files of encounters is missing";
  }
  const std::vector<ReferenceSet> sets_ = reference_sets();
};

TEST_F(WellClearReference, AlertsAndTimesAreEqual) {
  int compared = 0;
  for (const ReferenceSet& set : sets_)
    for (Row& row : reference_table(set.prefix + "_alerts.csv")) {
      const ReferenceEncounter& encounter = set.encounters.at(row["case"]);
      const Intruder& intruder = encounter.intruders.at(std::stoul(row["intruder"]) - 1);
      const auto& levels = set.configuration.alerters[intruder.alerter].levels;
      for (std::size_t k = 0; k < levels.size(); ++k) {
        const std::string t = "t" + std::to_string(k + 1);
        const ConflictSpan span =
            level_conflict(set.configuration, levels[k], encounter.own, intruder);
        const double in = number(row[t + "_in_s"]), out = number(row[t + "_out_s"]);
        ASSERT_EQ(span.conflict(), !std::isnan(in)) << row["case"];
        if (!span.conflict()) continue;
        EXPECT_NEAR(span.in, in, kRounding) << row["case"];
        EXPECT_NEAR(span.out, out, kRounding) << row["case"];
      }
      if (row["stable"] != "1") continue;
      ++compared;
      EXPECT_EQ(alert_level(set.configuration, encounter.own, intruder),
                std::stoi(row["alert_level"]))
          << row["case"];
    }
  EXPECT_GT(compared, 700);
}

TEST_F(WellClearReference, LastTimesOfManoeuvresAreEqual) {
  int compared = 0;
  for (const ReferenceSet& set : sets_) {
    BandMaker maker(set.configuration);
    for (Row& row : reference_table(set.prefix + "_alerts.csv")) {
      const ReferenceEncounter& encounter = set.encounters.at(row["case"]);
      const Intruder& intruder = encounter.intruders.at(std::stoul(row["intruder"]) - 1);
      if (row["stable"] != "1") continue;
      for (const auto& [kind, column] :
           {std::pair{ManoeuvreKind::kTrack, "last_track_s"},
            std::pair{ManoeuvreKind::kSpeed, "last_speed_s"},
            std::pair{ManoeuvreKind::kVerticalSpeed, "last_vs_s"},
            std::pair{ManoeuvreKind::kAltitude, "last_alt_s"}}) {
        const double mine = maker.last_time(kind, encounter.own, intruder);
        const double theirs = number(row[column]);
        ++compared;
        if (std::isinf(theirs))
          EXPECT_EQ(mine, theirs) << row["case"] << ' ' << column;
        else
          EXPECT_NEAR(mine, theirs, 6e-4) << row["case"] << ' ' << column;
      }
    }
  }
  EXPECT_GT(compared, 2800);
}

std::string text_of(const ManoeuvreBands& bands, double unit) {
  std::ostringstream text;
  for (const BandPiece& piece : bands.pieces)
    text << piece.lo / unit << ' ' << piece.hi / unit << ' ' << name_of(piece.region)
         << '\n';
  return text.str();
}

void expect_pieces(const ManoeuvreBands& bands, double unit, std::vector<Row>& theirs,
                   const std::string& place) {
  ASSERT_EQ(bands.pieces.size(), theirs.size()) << place << '\n' << text_of(bands, unit);
  for (std::size_t i = 0; i < theirs.size(); ++i) {
    EXPECT_EQ(name_of(bands.pieces[i].region), theirs[i]["region"]) << place;
    EXPECT_NEAR(bands.pieces[i].lo / unit, number(theirs[i]["lo"]), kRounding) << place;
    EXPECT_NEAR(bands.pieces[i].hi / unit, number(theirs[i]["hi"]), kRounding) << place;
  }
}

void expect_value(std::optional<double> value, double unit, double theirs, double none,
                  bool track, const std::string& place) {
  if (!value) {
    EXPECT_EQ(theirs, none) << place;
    return;
  }
  const double off = std::abs(*value / unit - theirs);
  EXPECT_LT(track ? std::min(off, std::abs(off - 360)) : off, kRounding)
      << place << ": " << *value / unit << " is not " << theirs;
}

void expect_guidance(const ManoeuvreBands& bands, AlertRegion corrective, double unit,
                     Row& theirs, const std::string& place) {
  const bool track = bands.kind == ManoeuvreKind::kTrack;
  const ManoeuvreResolution mine = resolution(bands, corrective);
  ASSERT_EQ(mine.needed, !theirs["resolution_up"].empty()) << place;
  if (mine.needed) {
    expect_value(mine.up, unit, number(theirs["resolution_up"]), kInf, track, place);
    expect_value(mine.down, unit, number(theirs["resolution_low"]), -kInf, track, place);
  }
  EXPECT_EQ(mine.prefer_up, theirs["prefer_up"] == "1") << place;
  using Outcome = BandRecovery::Outcome;
  const BandRecovery& recovery = bands.recovery;
  const int shrunk = std::stoi(theirs["recovery_n"]);
  EXPECT_EQ(recovery.outcome == Outcome::kNotNeeded, shrunk < 0) << place;
  if (shrunk < 0) return;
  EXPECT_EQ(recovery.shrunk, shrunk) << place;
  const double time = number(theirs["recovery_time_s"]);
  EXPECT_EQ(recovery.outcome == Outcome::kFound, std::isfinite(time)) << place;
  if (!std::isfinite(time)) return;
  EXPECT_NEAR(recovery.time, time, 6e-5) << place;
  EXPECT_NEAR(recovery.horizontal, number(theirs["recovery_horizontal_m"]), 6e-5);
  EXPECT_NEAR(recovery.vertical, number(theirs["recovery_vertical_m"]), 6e-5);
}

TEST_F(WellClearReference, BandsRecoveryAndResolutionsAreEqual) {
  int compared = 0;
  for (const ReferenceSet& set : sets_) {
    BandMaker maker(set.configuration);
    std::map<std::string, std::vector<Row>> pieces;
    for (Row& row : reference_table(set.prefix + "_bands.csv"))
      pieces[row["case"] + ' ' + row["kind"]].push_back(row);
    for (Row& row : reference_table(set.prefix + "_guidance.csv")) {
      if (row["stable"] != "1") continue;
      const ReferenceEncounter& encounter = set.encounters.at(row["case"]);
      const std::string place = row["case"] + ' ' + row["kind"];
      for (const KindName& kind : kKindNames) {
        if (row["kind"] != kind.name) continue;
        const ManoeuvreBands& bands =
            maker.bands(kind.kind, encounter.own, encounter.intruders);
        expect_pieces(bands, kind.unit, pieces.at(place), place);
        expect_guidance(bands, set.configuration.corrective, kind.unit, row, place);
        ++compared;
      }
    }
  }
  EXPECT_GT(compared, 1800);
}

TEST_F(WellClearReference, AlertsWithHysteresisChangeInTheSameSeconds) {
  for (const ReferenceSet& set : sets_) {
    std::map<std::string, std::vector<std::pair<int, int>>> timelines;
    for (Row& row : reference_table(set.prefix + "_timeline.csv"))
      timelines[row["case"]].emplace_back(std::stoi(row["t_s"]),
                                          std::stoi(row["alert_level"]));
    EXPECT_FALSE(timelines.empty());
    for (const auto& [name, timeline] : timelines) {
      AircraftMotion own = set.encounters.at(name).own;
      Intruder intruder = set.encounters.at(name).intruders.at(0);
      AlertHysteresis hysteresis;
      std::vector<std::pair<int, int>> mine;
      for (int t = 0; t <= timeline.back().first; ++t) {
        const int level = hysteresis.level(set.configuration, own, intruder, t);
        if (mine.empty() || mine.back().second != level || t == timeline.back().first)
          mine.emplace_back(t, level);
        own.p_N += own.v_N;
        intruder.motion.p_N += intruder.motion.v_N;
      }
      EXPECT_EQ(mine, timeline) << name;
    }
  }
}

}  // namespace
}  // namespace skein::model::test::reference_test
