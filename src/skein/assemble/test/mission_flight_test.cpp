// SPDX-License-Identifier: Apache-2.0
// The shipped scenarios with missions, judged by the truth.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "skein/assemble/test/whole_flight.h"
#include "skein/base/random.h"
#include "skein/record/figures/object_track.h"

namespace skein::assemble::mission_flight_test {
namespace {

// The files that it names are where it is.
std::string shipped(const char* name) {
  const std::string folder = SKEIN_SOURCE_DIR "/scenarios/";
  std::ifstream in(folder + name);
  std::ostringstream content;
  content << in.rdbuf();
  std::string text = content.str();
  for (const char* beside : {"plans/", "maps/"})
    for (std::size_t at = text.find(beside); at != std::string::npos;
         at = text.find(beside, at + folder.size() + 1))
      text.insert(at, folder);
  return text;
}

// Share of the cells of a rectangle that were within `reach` of an aircraft's path.
double seen(const FlightLog& log, const Vec2& low, const Vec2& high, double reach,
            const std::function<bool(const Vec2&)>& counts) {
  constexpr double kCell = 20;
  const auto rows = static_cast<std::size_t>((high.x() - low.x()) / kCell);
  const auto columns = static_cast<std::size_t>((high.y() - low.y()) / kCell);
  std::vector<bool> cells(rows * columns, false);
  const auto around = static_cast<int>(reach / kCell) + 1;
  for (const auto& [id, flight] : log.rows)
    for (const FlightRow& row : flight) {
      const Vec2 at = geo::horizontal(row.truth.p_N) - low;
      const int r0 = static_cast<int>(at.x() / kCell),
                c0 = static_cast<int>(at.y() / kCell);
      for (int r = r0 - around; r <= r0 + around; ++r)
        for (int c = c0 - around; c <= c0 + around; ++c) {
          if (r < 0 || c < 0 || r >= static_cast<int>(rows) ||
              c >= static_cast<int>(columns))
            continue;
          const Vec2 middle = kCell * Vec2(r + 0.5, c + 0.5);
          if ((middle - at).norm() <= reach)
            cells[static_cast<std::size_t>(r) * columns + static_cast<std::size_t>(c)] =
                true;
        }
    }
  double sum = 0, all = 0;
  for (std::size_t r = 0; r < rows; ++r)
    for (std::size_t c = 0; c < columns; ++c) {
      const Vec2 middle =
          low + kCell * Vec2(static_cast<double>(r) + 0.5, static_cast<double>(c) + 0.5);
      if (!counts(middle)) continue;
      ++all;
      sum += cells[r * columns + c];
    }
  return sum / all;
}

std::ptrdiff_t count(const FlightLog& log, EventKind kind) {
  return std::count_if(log.events.begin(), log.events.end(),
                       [&](const Event& e) { return e.kind == kind; });
}

TEST(MissionFlight, SearchAndRescueSeesTheAreaAndStaysWithWhoIsFound) {
  const FlightLog log = fly(shipped("search-and-rescue.yaml"));
  EXPECT_EQ(count(log, EventKind::kObjectFound), 2) << log.story();
  EXPECT_EQ(count(log, EventKind::kObjectLost), 0) << log.story();
  EXPECT_NE(log.find(EventKind::kSurveyed), nullptr) << log.story();
  // Half a swath to either side, but for the zone with what turns beside it need.
  const Vec2 masts(500, 500);
  EXPECT_EQ(seen(log, {0, 0}, {2000, 2000}, 76,
                 [&](const Vec2& p) { return (p - masts).norm() > 150 + 35 + 75; }),
            1.0);
  for (const auto& [id, flight] : log.rows)
    for (const FlightRow& row : flight)
      ASSERT_GT((geo::horizontal(row.truth.p_N) - masts).norm(), 150);
  // Within 120 m of an aircraft, as a camera sees that far to each side, 95 % of the time
  // since it was found.
  EXPECT_GT(log.figure("mission_track_in_view_worst"), 0.95);
  for (std::uint32_t walker = 0; walker < 2; ++walker) {
    record::ObjectTrack track;
    for (const ObjectMotion& motion : log.motions)
      if (motion.object == walker) track.add(motion);
    const auto found =
        std::find_if(log.detections.begin(), log.detections.end(),
                     [&](const Detection& d) { return d.object == walker; });
    ASSERT_NE(found, log.detections.end());
    ASSERT_LT(found->time.seconds(), 1000);
    std::map<Time, bool> in_view;
    for (const auto& [id, flight] : log.rows)
      for (const FlightRow& row : flight) {
        if (row.time < found->time) continue;
        const Vec2 at = track.at(row.time).value();
        const bool near = (geo::horizontal(row.truth.p_N) - at).norm() < 120;
        in_view[row.time] = in_view[row.time] || near;
      }
    const auto there = std::count_if(in_view.begin(), in_view.end(),
                                     [](const auto& each) { return each.second; });
    EXPECT_GT(static_cast<double>(there) / static_cast<double>(in_view.size()), 0.95);
  }
}

// Wind from any side. The picture of 115 m is smaller than most of their circles: the
// gimbal has to look at who is followed.
TEST(MissionFlight, AnEvadingWalkerStaysInViewOfEveryKindOfAircraft) {
  RandomStream random(41, 0, Purpose::kTest);
  int watched = 0;
  for (const char* aircraft :
       {"plant: kinematic\n    sensors: [gnss, air-data",
        "plant: {kind: fixed-wing, aircraft: bixler}\n    autopilot: skein\n"
        "    sensors: [flight",
        "plant: {kind: fixed-wing, aircraft: aerosonde}\n    autopilot: skein\n"
        "    sensors: [flight",
        "plant: multirotor\n    autopilot: skein\n    sensors: [flight"})
    for (int k = 0; k < 2; ++k) {
      const double speed = random.uniform(0, 7), from = random.uniform(0, 360);
      SCOPED_TRACE(fmt::format("{}, {:.1f} m/s from {:.0f}", aircraft, speed, from));
      const FlightLog log = fly(fmt::format(R"(
seed: {}
duration_s: 900
environment:
  terrain: flat
  wind: {{kind: uniform, speed_mps: {}, from_deg: {}}}
  phenomena: []
  objects: [{{name: walker, position_m: [30, 20], movement: evading}}]
aircraft:
  - name: a
    {}, {{kind: camera, gimbal: true, width_deg: 60, length_deg: 60}}]
    altitude_agl_m: 100
    start: {{placement: list, positions_m: [[0, 0]], heading_deg: 30}}
missions:
  - {{kind: track}}
  - {{kind: survey, area_m: [[-400, -400], [500, -400], [500, 500], [-400, 500]], swath_m: 180}}
)",
                                            500 + k, speed, from, aircraft));
      const Event* seen = log.find(EventKind::kObjectFound);
      if (!seen || seen->time.seconds() > 500) continue;  // it ran away in time
      ++watched;
      EXPECT_GT(log.figure("mission_track_in_view_worst"), 0.95) << log.story();
      EXPECT_LT(log.figure("mission_track_error_rms_m"), 15) << log.story();
    }
  EXPECT_GE(watched, 7);
}

TEST(MissionFlight, TwoFiresAreKnownByTheirOwnMissions) {
  const FlightLog log = fly(shipped("two-fires.yaml"));
  // With all readings given to both, the worse of the two is below 0.5.
  EXPECT_GT(log.figure("iou_mean"), 0.88);
  EXPECT_GT(log.figure("mission_eastern_iou_mean"), 0.88);
}

TEST(MissionFlight, TwoMissionsShareAircraftThroughALossAndAZone) {
  const FlightLog log = fly(shipped("two-missions.yaml"));
  EXPECT_NE(log.find(EventKind::kSurveyed), nullptr) << log.story();
  EXPECT_NE(log.find(EventKind::kShared), nullptr)
      << "what the lost one has left" << log.story();
  const Vec2 helicopter(-1700, 600);
  EXPECT_EQ(seen(log, {-2200, 0}, {-1200, 1200}, 61,
                 [&](const Vec2& p) { return (p - helicopter).norm() > 180 + 35 + 150; }),
            1.0);
  for (const auto& [id, flight] : log.rows)
    for (const FlightRow& row : flight)
      if (row.time.seconds() > 310 && row.time.seconds() < 900) {
        ASSERT_GT((geo::horizontal(row.truth.p_N) - helicopter).norm(), 180)
            << row.time.seconds();
      }
  EXPECT_NE(log.find(EventKind::kAllocation), nullptr);
}

TEST(MissionFlight, TheListOfTasksIsFlownByEachKindOfAircraft) {
  const FlightLog log = fly(shipped("tasks.yaml"));
  EXPECT_EQ(log.find(EventKind::kTaskRefused), nullptr) << log.story();
  EXPECT_EQ(log.find(EventKind::kTaskImpossible), nullptr) << log.story();
  EXPECT_EQ(log.find(EventKind::kCommandRefused), nullptr) << log.story();
  EXPECT_EQ(count(log, EventKind::kTaskOver), 11) << log.story();
  for (const char* kind :
       {"fly_to", "survey", "measure", "fly_route", "fly_tour", "patrol", "orbit",
        "rendezvous", "follow_line", "fly_plan", "follow_edge", "follow_leader", "relay",
        "hold", "fly_course", "loiter", "land", "return"})
    EXPECT_TRUE(std::any_of(log.events.begin(), log.events.end(),
                            [&](const Event& e) {
                              return e.kind == EventKind::kTask && e.text.ends_with(kind);
                            }))
        << kind << log.story();
}

}  // namespace
}  // namespace skein::assemble::mission_flight_test
