// Vehicles whose flight model is in another program, as scenarios have them.
#include <arpa/inet.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <charconv>
#include <chrono>
#include <memory>
#include <string>
#include <thread>

#include "skein/assemble/aircraft/aircraft_file.h"
#include "skein/assemble/build.h"
#include "skein/data/air.h"
#include "skein/geo/local_frame.h"
#include "skein/layer/asset/fixed_wing/fixed_wing_plant.h"
#include "skein/record/metrics.h"
#include "skein/scenario/scenario_file.h"
#include "skein/simulation/run.h"

namespace skein::assemble {
namespace {

Result<Build> outside_build(const std::string& vehicle, const std::string& more = "",
                            const std::string& step = "0.02") {
  const KindRegistry kinds;
  const auto read =
      scenario::read_scenario_text(fmt::format(R"(
duration_s: 60
step_s: {}
origin: {{latitude_deg: 36.989, longitude_deg: -122.0514}}
environment: {{terrain: flat, wind: {{kind: uniform, speed_mps: 0}}, phenomena: []}}
missions: []
aircraft:
  - count: 1
    vehicle: {{kind: flight-model, contact_s: 0, {}}}
    plant: {{kind: fixed-wing, aircraft: aerosonde}}
    autopilot: skein
    agent: scout
    sensors: [ideal-navigation, fire]
    altitude_agl_m: 200
    start: {{placement: list, positions_m: [[100, 0]], heading_deg: 0}}
    {}
)",
                                               step, vehicle, more),
                                   "outside", SKEIN_SOURCE_DIR, kinds.table());
  if (!read.ok()) return Error{ErrorCode::kBadInput, "", read.report(), ""};
  return build(*read.scenario, kinds);
}

std::string outside_error(const std::string& vehicle, const std::string& more = "",
                          const std::string& step = "0.02") {
  const auto built = outside_build(vehicle, more, step);
  return built ? std::string() : built.error().text();
}

TEST(FlightModelKind, IsVirtualAndInRealTime) {
  const auto built = outside_build("in: 'udpin:0'");
  ASSERT_TRUE(built) << built.error().text();
  EXPECT_TRUE(built.value().mixed);
  const simulation::Entity& entity = built.value().world.entities[1];
  EXPECT_EQ(entity.reality.presence, Reality::kVirtual);
  ASSERT_TRUE(entity.vehicle->truth());
  EXPECT_NEAR(entity.vehicle->truth()->p_N.x(), 100, 1e-9) << "where it is to begin";
}

TEST(FlightModelKind, SaysWhatDoesNotFit) {
  const auto has = [](const std::string& text, const char* part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  has(outside_error("in: 'tcpin:5'"), "udpin:PORT");
  has(outside_error("out: 'udpin:5'"), "udpout:HOST:PORT");
  has(outside_error("program: sextant"), "flightgear");
  has(outside_error("in: 'udpin:0'", "", "0.1"), "step_s: 0.02");
  has(outside_error("in: 'udpin:0'", "failures: [{kind: motor, at_s: 5}]"),
      "flight model's");
  EXPECT_EQ(
      outside_error("in: 'udpin:0'", "failures: [{kind: sensor, part: fire, at_s: 5}]"),
      "");
  EXPECT_EQ(outside_error("program: x-plane, in: '', out: 'udpout:127.0.0.1:49000'"), "");
}

}  // namespace
}  // namespace skein::assemble
