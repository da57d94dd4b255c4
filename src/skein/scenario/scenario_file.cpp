// SPDX-License-Identifier: Apache-2.0
#include "skein/scenario/scenario_file.h"

#include "skein/scenario/markdown.h"
#include "skein/scenario/schema.h"

namespace skein::scenario {
namespace {

Document scenario_document() {
  Document document;
  document.keys = scenario_fields().description();
  document.name = "a scenario";
  document.empty_hint = "Give it a key, as in \"name: first-flight\"; all have defaults.";
  document.consequence = "nothing was run";
  document.title = "Skein scenario";
  document.places = [](const Node& root, const KindTable& kinds) {
    return Places{frame_of(root, Scenario().origin), kinds.feature_reader()};
  };
  document.preface =
      "# Keys of a scenario file\n\n"
      "Written by the program from the description that also reads and checks the files. "
      "The unit of a number ends its key. Places are `[north, east]` in metres from the "
      "origin, `{latitude_deg: .., longitude_deg: ..}` or `{feature: NAME, file: FILE}`, "
      "a "
      "point of a GeoJSON, KML or other map file; lists of places and areas may be a "
      "line or "
      "an area of such a file. "
      "An implementation is chosen by its name (`radio: ideal`) or, to set its keys, as "
      "`radio: {kind: ideal, ...}`.\n\n## Scenario\n\n";
  return document;
}

// A scenario whose plugins are loaded by `load`.
Document document_with(const LoadPlugin& load) {
  Document document = scenario_document();
  document.prepare = [&load](const Node& root, const Folders& folders,
                             Problems& problems) {
    return load_plugins(root, folders, load, problems);
  };
  return document;
}

ReadOutcome outcome_of(Reading reading, Scenario& scenario) {
  ReadOutcome outcome{std::move(reading), std::nullopt};
  if (!outcome.Reading::ok()) return outcome;
  scenario.source = outcome.source;
  outcome.scenario = std::move(scenario);
  return outcome;
}

// A scenario that is only described.
Document recorded_document() {
  Document document = scenario_document();
  document.says_only = true;
  document.consequence = "the run cannot be described";
  return document;
}

}  // namespace

ReadOutcome read_scenario(const std::filesystem::path& path, const KindTable& kinds,
                          std::span<const Override> overrides, const LoadPlugin& load) {
  Scenario scenario;
  Reading reading = read_document(path, document_with(load), kinds, overrides, &scenario);
  return outcome_of(std::move(reading), scenario);
}

OpenedDocument open_scenario(const std::filesystem::path& path) {
  OpenedDocument file = open_document(path, scenario_document());
  keep_parsed(file, scenario_document());
  return file;
}

ReadOutcome read_scenario(const OpenedDocument& file, const KindTable& kinds,
                          std::span<const Override> overrides, const LoadPlugin& load) {
  Scenario scenario;
  Reading reading = read_document(file, document_with(load), kinds, overrides, &scenario);
  return outcome_of(std::move(reading), scenario);
}

ReadOutcome read_scenario_text(std::string_view text, const std::string& name,
                               const std::filesystem::path& folder,
                               const KindTable& kinds,
                               std::span<const Override> overrides,
                               const LoadPlugin& load) {
  Scenario scenario;
  Reading reading = read_document_text(text, name, folder, document_with(load), kinds,
                                       overrides, &scenario);
  return outcome_of(std::move(reading), scenario);
}

ReadOutcome read_recorded_scenario(const std::filesystem::path& path,
                                   const KindTable& kinds) {
  Scenario scenario;
  Reading reading = read_document(path, recorded_document(), kinds, {}, &scenario);
  return outcome_of(std::move(reading), scenario);
}

ReadOutcome read_recorded_scenario_text(std::string_view text, const std::string& name,
                                        const std::filesystem::path& folder,
                                        const KindTable& kinds) {
  Scenario scenario;
  Reading reading =
      read_document_text(text, name, folder, recorded_document(), kinds, {}, &scenario);
  return outcome_of(std::move(reading), scenario);
}

std::string write_scenario(const Scenario& scenario, const KindTable& kinds) {
  return write_document(scenario_document(), &scenario, kinds);
}

std::string json_schema(const KindTable& kinds) {
  return schema_text(scenario_document(), kinds);
}

std::string markdown_keys(const KindTable& kinds) {
  return keys_as_markdown(scenario_document(), kinds);
}

}  // namespace skein::scenario
