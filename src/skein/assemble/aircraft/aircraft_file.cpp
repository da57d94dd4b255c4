// SPDX-License-Identifier: Apache-2.0
#include "skein/assemble/aircraft/aircraft_file.h"

#include <fmt/format.h>

#include <vector>

#include "skein/assemble/aircraft/aircraft_fields.h"
#include "skein/assemble/aircraft/gains_fields.h"
#include "skein/scenario/text.h"

namespace skein::assemble {
namespace {

// The file as it is written.
struct Sections {
  std::string name, description;
  std::optional<FixedWingFile> fixed_wing;
  std::optional<MultirotorFile> multirotor;
  std::optional<PerformanceFile> performance;
  std::optional<autopilot::FixedWingGains> fixed_wing_gains;
  std::optional<autopilot::MultirotorGains> multirotor_gains;
};

std::vector<scenario::RuleViolation> section_errors(const Sections& file) {
  std::vector<scenario::RuleViolation> found;
  if (!file.fixed_wing && !file.multirotor && !file.performance)
    found.push_back({"",
                     "does not say how it flies: needs one of the sections fixed_wing, "
                     "multirotor and performance.",
                     {"fixed_wing", "multirotor", "performance"}});
  if (file.fixed_wing && file.multirotor)
    found.push_back({"multirotor", "stands beside fixed_wing; give one of the two."});
  if (file.fixed_wing_gains && !file.fixed_wing)
    found.push_back({"fixed_wing_gains", "is of no use without fixed_wing."});
  if (file.multirotor_gains && !file.multirotor)
    found.push_back({"multirotor_gains", "is of no use without multirotor."});
  return found;
}

scenario::Fields<Sections> section_fields() {
  using T = Sections;
  return scenario::Fields<T>()
      .text("name", &T::name, "What it is called.")
      .required()
      .text("description", &T::description, "One line about it.")
      .object("fixed_wing", &T::fixed_wing, fixed_wing_fields(),
              "A rigid body with wings: six degrees of freedom.")
      .object("multirotor", &T::multirotor, multirotor_fields(),
              "A rigid body with rotors: six degrees of freedom.")
      .object("performance", &T::performance, performance_fields(),
              "A point mass with the speeds and the energy of an aeroplane.")
      .object("fixed_wing_gains", &T::fixed_wing_gains, fixed_wing_gains_fields(),
              "Of its autopilot; null: the autopilot's own.")
      .object("multirotor_gains", &T::multirotor_gains, multirotor_gains_fields(),
              "Of its autopilot; null: the autopilot's own.")
      .rules(section_errors);
}

AircraftFile to_aircraft(const Sections& file) {
  AircraftFile aircraft;
  aircraft.name = file.name;
  aircraft.description = file.description;
  if (file.fixed_wing) aircraft.fixed_wing = file.fixed_wing->parameters();
  if (file.multirotor) aircraft.multirotor = file.multirotor->parameters();
  if (file.performance) aircraft.performance = file.performance->parameters();
  aircraft.fixed_wing_gains = file.fixed_wing_gains;
  aircraft.multirotor_gains = file.multirotor_gains;
  return aircraft;
}

Result<AircraftFile> outcome(const scenario::Reading& reading, const Sections& file) {
  if (reading.ok()) return to_aircraft(file);
  std::string report = reading.report();
  report.pop_back();  // the last line feed
  return Error{ErrorCode::kBadInput, "", std::move(report), ""};
}

bool is_path(const std::string& name) {
  return name.ends_with(".yaml") || name.ends_with(".yml");
}

}  // namespace

std::string AircraftFile::plants() const {
  std::string text;
  const auto add = [&](bool there, std::string_view plant) {
    if (there) text += fmt::format("{}{}", text.empty() ? "" : ", ", plant);
  };
  add(fixed_wing.has_value(), "fixed-wing");
  add(multirotor.has_value(), "multirotor");
  add(performance.has_value(), "performance");
  return text;
}

const scenario::Document& aircraft_document() {
  static const scenario::Document document = {
      section_fields().description(),
      "an aircraft",
      "Give it a name and a section fixed_wing, multirotor or performance.",
      "the aircraft cannot be used",
      "Skein aircraft",
      "# Keys of an aircraft file\n\n"
      "Written by the program (`skein keys aircraft`) from the description that also "
      "reads "
      "and checks the files. The unit of a number ends its key.\n\n## Aircraft\n\n"};
  return document;
}

Result<AircraftFile> read_aircraft(std::string_view text, const std::string& name) {
  Sections file;
  const auto reading = scenario::read_document_text(text, name, {}, aircraft_document(),
                                                    scenario::KindTable{}, {}, &file);
  return outcome(reading, file);
}

Result<AircraftFile> load_aircraft(const std::string& name_or_path,
                                   const std::filesystem::path& folder) {
  if (is_path(name_or_path)) {
    Sections file;
    const auto reading = scenario::read_document(
        folder / name_or_path, aircraft_document(), scenario::KindTable{}, {}, &file);
    return outcome(reading, file);
  }
  std::vector<std::string> names;
  for (const BuiltInAircraft& each : built_in_aircraft()) {
    if (each.name == name_or_path) return read_aircraft(each.text, name_or_path);
    names.emplace_back(each.name);
  }
  const std::string near = scenario::nearest_name(name_or_path, names);
  return Error{ErrorCode::kNotFound, "",
               fmt::format("there is no aircraft {}.", scenario::quote(name_or_path)),
               fmt::format("{}Built in: {}. A file's name ends in .yaml.",
                           near.empty() ? "" : fmt::format("Did you mean \"{}\"? ", near),
                           scenario::any_of(names))};
}

std::string write_aircraft(const AircraftFile& aircraft) {
  Sections file;
  file.name = aircraft.name;
  file.description = aircraft.description;
  if (aircraft.fixed_wing) file.fixed_wing = FixedWingFile::of(*aircraft.fixed_wing);
  if (aircraft.multirotor) file.multirotor = MultirotorFile::of(*aircraft.multirotor);
  if (aircraft.performance) file.performance = PerformanceFile::of(*aircraft.performance);
  file.fixed_wing_gains = aircraft.fixed_wing_gains;
  file.multirotor_gains = aircraft.multirotor_gains;
  return scenario::write_document(aircraft_document(), &file, scenario::KindTable{});
}

}  // namespace skein::assemble
