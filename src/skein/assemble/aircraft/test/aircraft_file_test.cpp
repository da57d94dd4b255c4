// SPDX-License-Identifier: Apache-2.0
#include "skein/assemble/aircraft/aircraft_file.h"

#include <gtest/gtest.h>

#include <fmt/format.h>
#include <cstdlib>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "skein/assemble/aircraft/aircraft_fields.h"
#include "skein/assemble/aircraft/gains_fields.h"
#include "skein/scenario/kind_table.h"
#include "skein/scenario/schema.h"

namespace skein::assemble::aircraft_file_test {
namespace {

AircraftFile good(const std::string& name) {
  const auto file = load_aircraft(name, {});
  EXPECT_TRUE(file.ok()) << file.error().text();
  return file.ok() ? file.value() : AircraftFile{};
}

std::string text_of(const std::string& name) {
  for (const BuiltInAircraft& each : built_in_aircraft())
    if (each.name == name) return std::string(each.text);
  return {};
}

// The built-in aircraft with one piece of its text replaced.
std::string problems_with(const std::string& aircraft, const std::string& piece,
                          const std::string& instead) {
  std::string text = text_of(aircraft);
  const std::size_t at = text.find(piece);
  EXPECT_NE(at, std::string::npos) << piece;
  if (at != std::string::npos) text.replace(at, piece.size(), instead);
  const auto file = read_aircraft(text, "x.yaml");
  return file.ok() ? "" : file.error().text();
}

TEST(BuiltInAircraft, AreGoodAndNamedLikeTheirFiles) {
  EXPECT_GE(built_in_aircraft().size(), 5u);
  for (const BuiltInAircraft& each : built_in_aircraft()) {
    const AircraftFile file = good(std::string(each.name));
    EXPECT_EQ(file.name, each.name);
    EXPECT_FALSE(file.description.empty()) << each.name;
    EXPECT_FALSE(file.plants().empty()) << each.name;
  }
  EXPECT_EQ(good("light-sport").plants(), "fixed-wing, performance");
  EXPECT_EQ(good("quad").plants(), "multirotor");
}

TEST(BuiltInAircraft, AerosondeHasThePublishedNumbersAndDoesNotStall) {
  std::ifstream in(SKEIN_SHARED_DATA "/flight/aerosonde.json");
  if (!in) GTEST_SKIP() << "the published numbers are not part of the project";
  const auto json = nlohmann::json::parse(in);
  const AircraftFile file = good("aerosonde");
  ASSERT_TRUE(file.fixed_wing);
  const asset::FixedWingParameters& p = *file.fixed_wing;
  const asset::AeroCoefficients& c = p.aero;
  const std::pair<const char*, double> all[] = {
      {"mass_kg", p.mass},      {"Jx", p.inertia.xx},
      {"Jy", p.inertia.yy},     {"Jz", p.inertia.zz},
      {"Jxz", p.inertia.xz},    {"S_m2", p.geometry.area},
      {"b_m", p.geometry.span}, {"c_m", p.geometry.chord},
      {"K_induced", c.K},       {"CL0", c.CL0},
      {"CLa", c.CLa},           {"CLq", c.CLq},
      {"CLde", c.CLde},         {"CDp", c.CD0},
      {"Cm0", c.Cm0},           {"Cma", c.Cma},
      {"Cmq", c.Cmq},           {"Cmde", c.Cmde},
      {"CYb", c.CYb},           {"CYda", c.CYda},
      {"CYdr", c.CYdr},         {"Clb", c.Clb},
      {"Clp", c.Clp},           {"Clr", c.Clr},
      {"Clda", c.Clda},         {"Cldr", c.Cldr},
      {"Cnb", c.Cnb},           {"Cnp", c.Cnp},
      {"Cnr", c.Cnr},           {"Cnda", c.Cnda},
      {"Cndr", c.Cndr}};
  for (const auto& [key, value] : all) EXPECT_EQ(value, json.at(key)) << key;
  for (const double none : {c.CDq, c.CDde, c.CY0, c.CYp, c.CYr, c.Cl0, c.Cn0})
    EXPECT_EQ(none, 0);
  EXPECT_FALSE(p.stall);
  EXPECT_TRUE(good("aerosonde-stall").fixed_wing->stall);
}

TEST(AircraftFile, IsWrittenAndReadAgainBitByBit) {
  for (const BuiltInAircraft& each : built_in_aircraft()) {
    AircraftFile file = good(std::string(each.name));
    if (file.fixed_wing) file.fixed_wing_gains = autopilot::FixedWingGains{};
    if (file.multirotor) file.multirotor_gains = autopilot::MultirotorGains{};
    const std::string written = write_aircraft(file);
    const auto again = read_aircraft(written, "written.yaml");
    ASSERT_TRUE(again.ok()) << again.error().text();
    EXPECT_EQ(write_aircraft(again.value()), written);
    // Writing goes through the same keys for both, so a member without a key shows only
    // where its value is not the default.
    if (file.fixed_wing) {
      EXPECT_EQ(again.value().fixed_wing->aero.Cndr, file.fixed_wing->aero.Cndr);
      EXPECT_EQ(again.value().fixed_wing->servos.rate, file.fixed_wing->servos.rate);
      EXPECT_EQ(again.value().fixed_wing_gains.has_value(), true);
    }
  }
}

TEST(AircraftFile, EveryMemberHasAKey) {
  // Members are plain doubles, so their number follows from the size.
  const auto doubles = [](std::size_t size) { return size / sizeof(double); };
  const auto keys = [](const auto& fields) {
    return fields.description()->fields.size();
  };
  EXPECT_EQ(keys(fixed_wing_gains_fields()), doubles(sizeof(autopilot::FixedWingGains)));
  EXPECT_EQ(keys(multirotor_gains_fields()), doubles(sizeof(autopilot::MultirotorGains)));
  EXPECT_EQ(keys(ground_fields()), doubles(sizeof(asset::GroundContactParameters)));
  EXPECT_EQ(keys(inertia_fields()), doubles(sizeof(asset::Inertia)));
  EXPECT_EQ(keys(tank_fields()), doubles(sizeof(asset::FuelTankParameters)));
  const auto wing = fixed_wing_fields().description();
  const auto part = [&](std::string_view key) {
    return std::get<scenario::ObjectType>(wing->find(key)->type->what)
        .object->fields.size();
  };
  EXPECT_EQ(part("aero"), doubles(sizeof(asset::AeroCoefficients)));
  EXPECT_EQ(part("geometry"), doubles(sizeof(asset::WingGeometry)));
  EXPECT_EQ(part("servos"), doubles(sizeof(asset::Servos)));
  EXPECT_EQ(part("envelope"), doubles(sizeof(asset::Envelope)));
}

TEST(AircraftFile, DefaultsOfItsKeysAreAllowed) {
  scenario::check_defaults("aircraft", *aircraft_document().keys);
}

TEST(AircraftFile, HasASchema) {
  const auto schema =
      nlohmann::json::parse(scenario::schema_text(aircraft_document(), {}));
  EXPECT_EQ(schema["title"], "Skein aircraft");
  EXPECT_TRUE(schema["properties"].contains("fixed_wing"));
}

TEST(AircraftFile, FilesAreFoundFromTheFolderOfWhoeverNamesThem) {
  std::string pattern =
      (std::filesystem::temp_directory_path() / "aircraft-XXXXXX").string();
  const std::filesystem::path folder = mkdtemp(pattern.data());
  std::ofstream(folder / "mine.yaml") << text_of("quad");
  EXPECT_TRUE(load_aircraft("mine.yaml", folder).ok());
  EXPECT_TRUE(load_aircraft((folder / "mine.yaml").string(), "/").ok());
  const auto missing = load_aircraft("yours.yml", folder);
  ASSERT_FALSE(missing.ok());
  EXPECT_EQ(missing.error().text(), (folder / "yours.yml").string() +
                                        ": there is no such file.\n1 problem; the "
                                        "aircraft cannot be used.");
  std::filesystem::remove_all(folder);
}

TEST(AircraftFile, UnknownNamesAreAnsweredWithTheNearest) {
  const auto none = load_aircraft("aerosond", {});
  ASSERT_FALSE(none.ok());
  EXPECT_EQ(none.error().code, ErrorCode::kNotFound);
  EXPECT_EQ(none.error().text(),
            "there is no aircraft \"aerosond\". Did you mean \"aerosonde\"? Built in: "
            "aerosonde, aerosonde-stall, bixler, light-sport, quad or x8. A file's name "
            "ends in .yaml.");
}

struct Case {
  const char* aircraft;
  const char* piece;
  const char* instead;
  const char* problem;  // that the report holds
  int count = 1;
};

class AircraftFileRefuses : public testing::TestWithParam<Case> {};

TEST_P(AircraftFileRefuses, WithFileKeyAndRule) {
  const Case& c = GetParam();
  const std::string report = problems_with(c.aircraft, c.piece, c.instead);
  EXPECT_NE(report.find(c.problem), std::string::npos) << report;
  EXPECT_NE(report.find("x.yaml:"), std::string::npos) << report;
  EXPECT_NE(report.find(fmt::format("\n{} problem{}; the aircraft cannot be used.",
                                    c.count, c.count == 1 ? "" : "s")),
            std::string::npos)
      << report;
}

INSTANTIATE_TEST_SUITE_P(
    All, AircraftFileRefuses,
    testing::Values(
        Case{"aerosonde", "mass_kg: 11", "mass_kg: -11",
             "x.yaml:9:12 fixed_wing.mass_kg: -11 must be above 0"},
        Case{"aerosonde", "mass_kg: 11", "mass_g: 11000",
             "The unit here is kg, not g: write \"mass_kg: 11\"", 2},
        Case{"aerosonde", "zz_kgm2: 1.759", "zz_kgm2: 3",
             "fixed_wing.inertia: moments 0.8244, 1.135, 3"},
        Case{"aerosonde", "xz_kgm2: 0.1204", "xz_kgm2: 1.3",
             "fixed_wing.inertia: moments"},
        Case{"aerosonde", "    CLa: 5.61\n", "", "fixed_wing.aero.CLa: is missing"},
        Case{"aerosonde", "Cmq: -38.21", "Cmq: 38.21",
             "fixed_wing.aero.Cmq: 38.21 must be within -500 and 0."},
        Case{"aerosonde", "Cmde:", "Cmdee:", "Did you mean \"Cmde\"?", 2},
        Case{"aerosonde-stall", "slowest_mps: 18", "slowest_mps: 9",
             "fixed_wing.envelope.slowest_mps: 9 must be above the stall at"},
        Case{"aerosonde", "slowest_mps: 18", "slowest_mps: 26",
             "fixed_wing.envelope.cruise_mps: 25 must be at least the slowest"},
        Case{"aerosonde", "fastest_mps: 32", "fastest_mps: 80",
             "fixed_wing.envelope.fastest_mps: 80 cannot be flown level: needs"},
        Case{"bixler", "span_m: 1.5", "span_m: 1000",
             "fixed_wing.geometry.chord_m: 0.173 times the span must be the wing's area"},
        Case{"bixler", "bank_limit_deg: 40", "bank_limit_deg: 85",
             "1.4 (in radians; the file has degrees)."},
        Case{"aerosonde", "fastest_mps: 32", "fastest_mps: .nan",
             "fixed_wing.envelope.fastest_mps: "},
        Case{"aerosonde", "CQ0: 0.005230", "CQ0: 1e-12",
             "fixed_wing.electric_motor.CQ0: 1e-12 must be at least"},
        Case{"aerosonde", "capacity_ah: 12", "capacity_ah: 0",
             "fixed_wing.electric_motor.battery.capacity_ah: 0 must be above 0"},
        Case{"aerosonde", "resistance_ohm: 0.06}",
             "resistance_ohm: 0.06, open_circuit_v: [3, 4]}",
             "battery.open_circuit_v: needs 11 voltages"},
        Case{"aerosonde", "lag_s: 0.15", "lag_s: 0",
             "fixed_wing.electric_motor.lag_s: 0 must be at least 0.001"},
        Case{"light-sport", "piston_engine:", "electric_motor:",
             "fixed_wing.electric_motor.diameter_m: is missing", 15},
        Case{"light-sport", "efficiency: 0.85", "efficiency: 1.2",
             "fixed_wing.piston_engine.efficiency: 1.2 must be"},
        Case{"light-sport", "fuel_kg: 72", "fuel_kg: 0",
             "fixed_wing.piston_engine.tank.fuel_kg: 0 must be above 0"},
        Case{"light-sport", "lift_max: 1.45", "lift_max: 0.5",
             "performance.slowest_mps: 30 must be above"},
        Case{"quad", "yaws: clockwise}", "yaws: left}", "multirotor.rotors[0].yaws"},
        Case{"quad", "mass_kg: 1.5", "mass_kg: 15", "multirotor.fastest_rotor_rad_per_s"},
        Case{"quad", "motor_lag_s: 0.04", "motor_lag_s: 50",
             "multirotor.motor_lag_s: 50 must be above 0 and at most"},
        Case{"quad", "multirotor:", "fixed_wing_gains: {}\nmultirotor:",
             "fixed_wing_gains: is of no use without fixed_wing."}));

TEST(AircraftFileReader, NeedsAFlightModel) {
  const auto file = read_aircraft("name: stone", "x.yaml");
  ASSERT_FALSE(file.ok());
  EXPECT_NE(file.error().text().find("does not say how it flies"), std::string::npos);
}

TEST(AircraftFileReader, SpeaksOfAnAircraftNotOfAScenario) {
  for (const std::string text : {"name: \xFF", "name: x\n---\nname: y"}) {
    const auto file = read_aircraft(text, "x.yaml");
    ASSERT_FALSE(file.ok());
    const std::string said = file.error().text();
    EXPECT_NE(said.find("aircraft is"), std::string::npos) << said;
    EXPECT_EQ(said.find("scenario"), std::string::npos) << said;
  }
}

TEST(AircraftFileReader, ReportsAllProblemsAtOnce) {
  std::string text = text_of("aerosonde");
  for (const auto& [piece, instead] :
       {std::pair{"mass_kg: 11", "mass_kg: -1"}, std::pair{"Cmq: -38.21", "Cmq: 1"},
        std::pair{"CT0: 0.09357", "CT0: lots"}, std::pair{"chord_m", "cord_m"}})
    text.replace(text.find(piece), std::string(piece).size(), instead);
  const auto file = read_aircraft(text, "x.yaml");
  ASSERT_FALSE(file.ok());
  for (const char* problem : {"fixed_wing.mass_kg", "fixed_wing.aero.Cmq",
                              "fixed_wing.electric_motor.CT0", "fixed_wing.geometry"})
    EXPECT_NE(file.error().text().find(problem), std::string::npos)
        << problem << "\n"
        << file.error().text();
}

}  // namespace
}  // namespace skein::assemble::aircraft_file_test
