// SPDX-License-Identifier: Apache-2.0
// The same scenario gives the same content hash on every processor and with any number of
// threads. The system's C library chooses its variants of sin, exp... by the processor;
// its tunable GLIBC_TUNABLES makes it choose as on one without fused multiply-add.
#include <fmt/format.h>

#include "app/test/program.h"
#include "skein/base/random.h"

namespace skein::app {
namespace {

constexpr const char* kTunable = "GLIBC_TUNABLES";
constexpr const char* kWithoutFma = "glibc.cpu.hwcaps=-AVX2,-FMA";

class SameBytes : public Program {
 protected:
  void TearDown() override { unsetenv(kTunable); }

  static void take_fma(bool take) {
    if (take)
      setenv(kTunable, kWithoutFma, 1);
    else
      unsetenv(kTunable);
  }

  // Whether the system's own functions differ with the tunable; without that, comparing
  // shows nothing.
  bool systems_functions_differ() {
    std::string sums[2];
    for (const bool without : {false, true}) {
      take_fma(without);
      const fs::path out = folder_ / "sum.txt";
      const std::string command = SKEIN_SYSTEM_SUM " > " + out.string();
      EXPECT_EQ(std::system(command.c_str()), 0);
      sums[without ? 1 : 0] = read_file(out);
    }
    take_fma(false);
    EXPECT_FALSE(sums[0].empty());
    return sums[0] != sums[1];
  }

  std::string hash_with(const std::string& scenario, int threads,
                        const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {
        "run",   scenario, "--json",    "--overwrite",
        "--out", "run",    "--threads", std::to_string(threads)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Finished finished = run(arguments);
    EXPECT_EQ(finished.status, 0) << finished.err;
    const auto summary = nlohmann::json::parse(finished.out, nullptr, false);
    return summary.is_discarded() ? "" : summary.value("content_hash", "");
  }

  // Runs the scenario with 1, 2 and 4 threads on the processor as it is, and as if it had
  // no fused multiply-add.
  void expect_same(const std::string& scenario,
                   const std::vector<std::string>& more = {}) {
    if (!systems_functions_differ())
      GTEST_SKIP() << "the system's library has one variant for this processor";
    const std::string expected = hash_with(scenario, 1, more);
    ASSERT_FALSE(expected.empty());
    for (const int threads : {2, 4})
      EXPECT_EQ(hash_with(scenario, threads, more), expected) << threads << " threads";
    take_fma(true);
    for (const int threads : {1, 4})
      EXPECT_EQ(hash_with(scenario, threads, more), expected)
          << threads << " threads without fused multiply-add";
  }

  void expect_same_of(const std::string& shipped,
                      const std::vector<std::string>& more = {}) {
    expect_same(SKEIN_SOURCE_DIR "/scenarios/" + shipped + ".yaml", more);
  }
};

// Enough aircraft for the simulation to share them out among threads: wings and rotors
// with six degrees of freedom, all sensors, gusts, failures and spread parameters, around
// a fire in a canyon.
constexpr const char* kFleet = R"(
duration_s: 40
environment:
  terrain: canyon
  wind: {kind: uniform, speed_mps: 4, from_deg: 200}
  turbulence: {kind: dryden, intensity: moderate}
  phenomena: [{kind: front, rate_mps: 0.1, age_s: 1800, ignitions: [{point_m: [0, 0], radius_m: 40}]}]
aircraft:
  - name: glider
    count: 12
    plant: {kind: fixed-wing, aircraft: bixler}
    parameter_spread: 0.1
    autopilot: skein
    sensors: [flight, fire]
    start: {placement: ring, distance_m: 600}
  - name: quad
    count: 12
    plant: {kind: multirotor, aircraft: quad}
    autopilot: skein
    sensors: [flight, fire]
    start: {placement: ring, distance_m: 400}
  - {name: wing, count: 8, plant: {kind: fixed-wing, aircraft: aerosonde}, autopilot: skein, sensors: [flight, fire]}
  - {name: simple, count: 4, plant: performance}
  - {name: point, count: 4}
radio: {kind: ideal, loss: 0.1}
missions: [{kind: perimeter, estimator: joint, strategy: sweep}]
)";

TEST_F(SameBytes, OfAFleetWithSixDegreesOfFreedom) {
  expect_same(write("fleet.yaml", kFleet).string());
}

// Shadowing, diffraction at the ground, antennas that turn, routes that are learned,
// noise.
TEST_F(SameBytes, OfMessagesThatFightForTheAir) {
  write("shadowed.yaml",
        "phy: {transmit_power_dbm: 27, decode_threshold_dbm: -100,\n"
        "      carrier_sense_threshold_dbm: -100, interference_floor_dbm: -115}\n"
        "propagation: {model: log-distance, exponent: 2.4, shadowing_db: 4}\n");
  const auto file = write("fleet.yaml", kFleet).string();
  expect_same(
      file,
      {"--set",
       "radio={kind: medium, file: shadowed.yaml, terrain: true, advertisement_period_s: "
       "1,"
       " routing: learned-routes, antenna: {model: dipole},"
       " attacks: [{position_m: [500, 500], jammer: {duty: 0.1, period_s: 0.2}}]}"});
  expect_same(file, {"--set", "radio={kind: medium, profile: n920, routing: flooding}"});
}

TEST_F(SameBytes, OfTheShippedScenarios) {
  expect_same_of("wildfire", {"--set", "duration_s=300"});
  expect_same_of("formation", {"--set", "duration_s=60"});
  expect_same_of("zones", {"--set", "duration_s=120"});
  expect_same_of("wind-following", {"--set", "duration_s=60"});
  expect_same_of("thesis-southwest-wind", {"--set", "duration_s=600"});
}

TEST_F(SameBytes, OfEveryEstimatorAndStrategy) {
  const auto file = write("s.yaml",
                          "duration_s: 240\naircraft: [{count: 2}]\n"
                          "environment: {wind: {kind: uniform, speed_mps: 3}}\n");
  for (const char* estimator : {"ensemble", "qkf", "mle", "map", "ukf", "particle"})
    expect_same(file.string(),
                {"--set", std::string("missions[0].estimator=") + estimator});
  for (const char* strategy : {"gus", "gus-rate", "partition", "ellipse"})
    expect_same(file.string(),
                {"--set", std::string("missions[0].strategy=") + strategy});
}

// Terrain from a raster in Universal Transverse Mercator coordinates, which another
// library projects, and which the test makes itself.
TEST_F(SameBytes, OfAProjectedTerrainRaster) {
  constexpr int kSide = 80;
  RandomStream random(17, 0, Purpose::kTest);
  std::string grid =
      "ncols 80\nnrows 80\nxllcorner 582400\nyllcorner 4092000\ncellsize 50\n";
  for (int i = 0; i < kSide * kSide; ++i)
    grid += std::to_string(100 + random.uniform(0, 40)) +
            (i % kSide < kSide - 1 ? " " : "\n");
  write("ground.asc", grid);
  write("ground.prj",
        R"(PROJCS["WGS 84 / UTM zone 10N",GEOGCS["WGS 84",DATUM["WGS_1984",)"
        R"(SPHEROID["WGS 84",6378137,298.257223563]],PRIMEM["Greenwich",0],)"
        R"(UNIT["degree",0.0174532925199433]],PROJECTION["Transverse_Mercator"],)"
        R"(PARAMETER["latitude_of_origin",0],PARAMETER["central_meridian",-123],)"
        R"(PARAMETER["scale_factor",0.9996],PARAMETER["false_easting",500000],)"
        R"(PARAMETER["false_northing",0],UNIT["metre",1]])");
  expect_same(
      write("fleet.yaml", kFleet).string(),
      {"--set", "environment.terrain={kind: raster, file: ground.asc, area_m: 1500}"});
}

// Terrain in UTM coordinates and a forecast in Lambert's, of one place.
TEST_F(SameBytes, OfATerrainRasterInAGriddedWind) {
  const fs::path data = SKEIN_SHARED_DATA;
  const fs::path ground = data / "terrain/big_butte/big_butte.tif";
  const fs::path wind = data / "wind/ndfd_20170603T1800.nc";
  for (const fs::path& each : {ground, wind})
    if (!fs::exists(each)) GTEST_SKIP() << "no " << each;
  const auto file = write("s.yaml", fmt::format(R"(
duration_s: 60
origin: {{latitude_deg: 43.40, longitude_deg: -113.03}}
environment:
  terrain: {{kind: raster, file: {}, area_m: 4000}}
  wind:
    kind: grid
    file: {}
    first: Wind_speed_height_above_ground
    second: Wind_direction_from_which_blowing_height_above_ground
    area_m: 8000
  turbulence: dryden
  phenomena: [{{kind: front, rate_mps: 0.1, age_s: 1800, ignitions: [{{point_m: [0, 0], radius_m: 40}}]}}]
aircraft:
  - name: plane
    count: 2
    plant: {{kind: fixed-wing, aircraft: aerosonde}}
    autopilot: skein
    sensors: [flight, fire]
missions: [{{kind: perimeter, estimator: ensemble, strategy: sweep}}]
)",
                                                ground.string(), wind.string()));
  expect_same(file.string());
}

TEST_F(SameBytes, OfARecordedFire) {
  const fs::path data = fs::path(SKEIN_SHARED_DATA) / "fires/bridge_2021";
  if (!fs::exists(data)) GTEST_SKIP() << "no " << data;
  expect_same_of(
      "bridge-fire",
      {"--set", "duration_s=300", "--set",
       "environment.phenomena[0].source=" + (data / "perimeters.csv").string(), "--set",
       "environment.terrain.file=" + (data / "landscape/elevation.tif").string()});
}

}  // namespace
}  // namespace skein::app
