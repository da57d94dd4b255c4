// SPDX-License-Identifier: Apache-2.0
// Files as they come from the field: read rightly, or refused by name. They lie in
// ../shared/data/cases, each with what is right; other tests have inputs of their own of
// the same kinds.
#include <algorithm>
#include <cmath>

#include "app/test/program.h"

namespace skein::app {
namespace {

class Cases : public Program {
 protected:
  // The folder of a case; empty, and the test skipped, where it is not there.
  fs::path find(const std::string& name) {
    const fs::path folder = fs::path(SKEIN_SHARED_DATA) / "cases" / name;
    return fs::exists(folder) ? folder : fs::path();
  }

  std::string fire(const fs::path& file, std::vector<std::string> more = {}) {
    std::vector<std::string> arguments = {"fire", file.string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Finished done = run(arguments);
    return done.out + done.err;
  }

  // Runs a scenario and gives all that was printed.
  std::string fly(const fs::path& scenario,
                  const std::vector<std::string>& settings = {}) {
    std::vector<std::string> arguments = {"run", scenario.string(), "--out", "run",
                                          "--overwrite"};
    for (const std::string& each : settings)
      arguments.insert(arguments.end(), {"--set", each});
    const Finished done = run(arguments);
    status_ = done.status;
    return done.out + done.err;
  }

  double truth(const std::string& expression) {
    return query(folder_ / "run" / "run.sqlite",
                 "select " + expression + " from truth where time_s>=1 limit 1");
  }
  double air_north() {
    return truth("velocity_north_mps-airspeed_mps*cos(heading_deg*3.14159265/180)");
  }
  double air_east() {
    return truth("velocity_east_mps-airspeed_mps*sin(heading_deg*3.14159265/180)");
  }

  static bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  }
  static std::size_t lines_in(const std::string& text) {
    return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
  }

  int status_ = 0;
};

// Skips a test whose case is not there.
#define SKEIN_CASE(folder, name)      \
  const fs::path folder = find(name); \
  if (folder.empty()) GTEST_SKIP() << "no " << SKEIN_SHARED_DATA << "/cases/" << name

void expect_all(const std::string& text, const std::vector<std::string>& parts) {
  for (const std::string& part : parts)
    EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
}

TEST_F(Cases, TablesWithoutGeometryArePassedOver) {
  SKEIN_CASE(folder, "01-gpkg-layer-styles");
  expect_all(fire(folder / "fire.gpkg"), {"6.9", "19.1", "37.5", "61.9"});
  expect_all(fire(folder / "event.gdb"), {"7.0", "19.4", "38.0", "62.8"});
  const Finished path =
      run({"plan", "path", "--from-geo", "38.92,-121.03,0", "--to-geo",
           "38.932,-121.03,0", "--airspeed", "15", "--turn-radius", "40", "--altitude-m",
           "100", "--zones", (folder / "zone.gpkg").string()});
  expect_all(path.out + path.err, {"91.2"});
  const Finished check = run({"check", (folder / "s.yaml").string()});
  EXPECT_EQ(check.status, 0) << check.out << check.err;
}

TEST_F(Cases, YearsOfTwoDigitsAreOfThisCentury) {
  SKEIN_CASE(folder, "06-two-digit-years");
  expect_all(fire(folder / "a.geojson"),
             {"2021-09-05T22:00:00Z", "2021-09-06T04:00:00Z", "2021-09-07T04:00:00Z",
              "2021-09-08T04:00:00Z", "the month stands before the day"});
  expect_all(fire(folder / "b.geojson"),
             {"2021-08-14T22:00:00Z", "2021-08-17T04:00:00Z"});
}

TEST_F(Cases, DatesThatMeanNoneAreNone) {
  SKEIN_CASE(folder, "08-null-dates");
  for (const char* name : {"n1899", "n1970", "n9999"}) {
    const std::string scenario = std::string(name) + ".yaml";
    const std::string text =
        fire(folder / (std::string(name) + ".geojson"), {"--scenario", scenario});
    expect_all(text, {"  2      2.00", "mean that there is no time", "left out"});
    EXPECT_FALSE(has(text, "  3 ")) << text;
    EXPECT_EQ(run({"check", scenario}).status, 0) << name;
  }
}

TEST_F(Cases, AFireLongerThanAnyRunGivesAScenarioThatIsGood) {
  SKEIN_CASE(folder, "10-long-fire");
  expect_all(fire(folder / "long.geojson", {"--scenario", "l.yaml"}),
             {"ends after 4000000 s of"});
  const Finished check = run({"check", "l.yaml"});
  EXPECT_EQ(check.status, 0) << check.out << check.err;
}

TEST_F(Cases, EmptyTimesComeFromTheNextAttribute) {
  SKEIN_CASE(folder, "11-half-filled-dates");
  expect_all(fire(folder / "p.geojson"), {"T10:00:00Z", "T11:00:00Z", "T12:00:00Z",
                                          "T13:00:00Z", "poly_DateCurrent"});
}

TEST_F(Cases, TheDayMayStandFirst) {
  SKEIN_CASE(folder, "13-day-first");
  for (const std::vector<std::string>& options :
       {std::vector<std::string>{},
        std::vector<std::string>{"--date-order", "day-first"}})
    expect_all(fire(folder / "d.geojson", options),
               {"2021-09-05T10:00:00Z", "2021-09-08T10:00:00Z", " 72.00 "});
  expect_all(fire(folder / "d.geojson", {"--date-order", "month-first"}),
             {"2021-05-09T10:00:00Z", "2021-08-09T10:00:00Z"});
}

TEST_F(Cases, ArchivesSpacesAndWarningsOfFires) {
  SKEIN_CASE(zip, "04-zip-with-folder");
  for (const char* file : {"flat.zip", "folder.zip", "deep.zip", "mac.zip"})
    expect_all(fire(zip / file), {"6.9", "19.1", "37.5", "61.9"});
  SKEIN_CASE(space, "14-narrow-space");
  expect_all(fire(space / "n.geojson"), {"2021-09-05T10:00:00Z", "2021-09-05T13:00:00Z"});
  SKEIN_CASE(same, "15-same-times");
  expect_all(fire(same / "dst.geojson"), {"2 at 2021-11-07T01:30:00Z"});
  SKEIN_CASE(limit, "16-transfer-limit");
  for (const char* file : {"lim.geojson", "lim2.geojson"})
    expect_all(fire(limit / file), {"2021-09-05T13:00:00Z", "not complete"});
  SKEIN_CASE(points, "61-warnings-by-the-hundred");
  const std::string text = fire(points / "p.kml");
  EXPECT_LT(lines_in(text), 11u) << text;
  EXPECT_TRUE(has(text, "300 point")) << text;
}

TEST_F(Cases, ArrivalTimesWithoutEndAreNever) {
  SKEIN_CASE(folder, "17-arrival-huge");
  for (const char* file : {"ok.tif", "e20.tif", "e38.tif"})
    expect_all(fire(folder / file), {"Arrival times over 0.4 h", "174.7 ha"});
}

TEST_F(Cases, ElevationsMayBeInFeetAndHaveASeaFloor) {
  SKEIN_CASE(feet, "20-dem-feet");
  const auto altitude = [&](const fs::path& folder, const char* file) {
    const std::string text =
        fly(folder / "s.yaml", {"environment.terrain.file=" + (folder / file).string()});
    EXPECT_EQ(status_, 0) << text;
    return query(folder_ / "run" / "run.sqlite",
                 "select altitude_msl_m from truth order by time_s limit 1");
  };
  for (const char* file : {"m.tif", "ft_unit.tif", "ft_crs.tif"})
    EXPECT_NEAR(altitude(feet, file), 595.7, 0.06) << file;
  SKEIN_CASE(sea, "21-dem-sea-floor");
  const double expected = altitude(sea, "coast.tif");
  EXPECT_GT(expected, 100);
}

TEST_F(Cases, WindsOfReanalysesAndModelsAreRead) {
  SKEIN_CASE(era5, "25-era5-no-crs");
  for (const char* file : {"era5.nc", "with_crs.nc"}) {
    const std::string text =
        fly(era5 / "s.yaml", {"environment.wind.file=" + (era5 / file).string()});
    ASSERT_EQ(status_, 0) << text;
    EXPECT_NEAR(air_north(), 4, 0.01) << file;
    EXPECT_NEAR(air_east(), 3, 0.01) << file;
  }
  SKEIN_CASE(world, "26-world-grid");
  for (const std::string& setting :
       {"environment.wind={kind: grid, holds: components, first: UGRD, second: VGRD, "
        "area_m: 1500, file: '" +
            (world / "gfs.grb2").string() + "'}",
        "environment.wind.file=" + (world / "era5_world.nc").string()}) {
    const std::string text = fly(world / "s.yaml", {setting});
    ASSERT_EQ(status_, 0) << text;
    EXPECT_NEAR(air_north(), 4, 0.01) << setting;
    EXPECT_NEAR(air_east(), 3, 0.01) << setting;
  }
}

TEST_F(Cases, AWindWithoutAUnitIsAskedForIt) {
  SKEIN_CASE(folder, "27-windninja-mph");
  expect_all(fly(folder / "s.yaml"), {"error", "no unit"});
  EXPECT_NE(status_, 0);
  const std::string text = fly(folder / "s.yaml", {"environment.wind.unit=mph"});
  ASSERT_EQ(status_, 0) << text;
  EXPECT_NEAR(air_north(), 7.07, 0.01);
  EXPECT_NEAR(air_east(), 7.07, 0.01);
  SKEIN_CASE(hints, "28-hints-of-elsewhere");
  expect_all(fly(hints / "s.yaml"), {"times_s"});
  expect_all(
      fly(hints / "s.yaml", {"environment.wind.times_s=[0]",
                             "environment.wind.file=" + (hints / "hole.asc").string()}),
      {"extend: true"});
}

TEST_F(Cases, OldPositionsAndLogsOfAnotherDayAreSaid) {
  SKEIN_CASE(held, "30-held-positions");
  const fs::path database = folder_ / "run" / "run.sqlite";
  const std::string a = fly(held / "s.yaml");
  ASSERT_EQ(status_, 0) << a;
  expect_all(a, {"0 jumps and 1 gaps"});
  EXPECT_LT(query(database, "select max(abs(velocity_east_mps)) from traffic_motions"),
            61);
  const std::string b =
      fly(held / "s.yaml", {"traffic[0].flight.file=" + (held / "b.csv").string()});
  ASSERT_EQ(status_, 0) << b;
  EXPECT_NEAR(
      query(database,
            "select min(velocity_east_mps) from traffic_motions where phase='flies'"),
      60, 1);
  EXPECT_NEAR(query(database, "select max(velocity_east_mps) from traffic_motions"), 60,
              1);
  SKEIN_CASE(hour, "33-opensky-hour");
  for (const char* file : {"a.csv", "b.csv", "c.csv"}) {
    const std::string text =
        fly(hour / "s.yaml", {"traffic[0].flight.file=" + (hour / file).string()});
    ASSERT_EQ(status_, 0) << text;
    EXPECT_NEAR(query(database, "select max(velocity_east_mps) from traffic_motions"), 60,
                1)
        << file;
  }
  SKEIN_CASE(day, "32-log-of-another-day");
  expect_all(fly(day / "s.yaml"), {"2021-09-05T12:00:00Z", "never there"});
}

TEST_F(Cases, PlacesFarFromTheOriginAreRefused) {
  SKEIN_CASE(folder, "60-no-origin");
  const Finished check = run({"check", (folder / "s.yaml").string()});
  EXPECT_EQ(check.status, 2) << check.out;
  expect_all(check.out + check.err, {"km from the origin", "at most 1000 km"});
}

TEST_F(Cases, AnAreaThatIsCutAtTheDateLineIsOne) {
  SKEIN_CASE(folder, "46-date-line-area");
  for (const char* file : {"split.geojson", "ring.geojson"}) {
    const Finished done =
        run({"plan", "coverage", "--area", (folder / file).string(), "--swath-m", "100",
             "--from-geo=-16.8,179.998,90", "--airspeed", "15", "--turn-radius", "40",
             "--altitude-m", "100"});
    EXPECT_EQ(done.status, 0) << done.err;
    expect_all(done.out, {"1.18", "11"});
  }
}

}  // namespace
}  // namespace skein::app
