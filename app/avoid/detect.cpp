// SPDX-License-Identifier: Apache-2.0
// skein avoid detect: alerts and bands of a table of encounters.
#include <fmt/format.h>

#include <memory>

#include "app/avoid/commands.h"
#include "app/common/commands.h"
#include "app/common/common.h"
#include "app/common/output.h"
#include "skein/base/output_file.h"
#include "skein/exchange/traffic/detection_tables.h"
#include "skein/exchange/traffic/well_clear_json.h"

namespace skein::app {
namespace {

constexpr const char* kDetectExamples = R"(
The table of encounters has columns case, aircraft (0: the own one), alerter, north_m,
east_m, down_m, vn_mps, ve_mps, vd_mps. Configurations by name are DO_365B_no_SUM and
skein_suas; docs/well-clear.md has the keys of a file and the columns of what is written.

Examples:
  skein avoid detect --batch encounters.csv --config skein_suas \
      --out alerts.csv --bands bands.csv --guidance guidance.csv
  skein avoid detect --batch encounters.csv --config mine.json --hysteresis \
      --out timeline.csv)";

struct AvoidDetectArguments {
  std::string batch, configuration, out, bands, guidance;
  bool hysteresis = false;
  std::optional<int> until;  // [s]
};

Result<model::WellClearConfiguration> configuration_named(const std::string& name) {
  if (auto built_in = model::well_clear_configuration(name)) return *built_in;
  if (!name.ends_with(".json"))
    return Error{ErrorCode::kBadInput, "--config",
                 fmt::format("{} is no configuration.", name),
                 fmt::format("By name there are {}; a file ends in .json.",
                             model::well_clear_configuration_names())};
  std::string text;
  if (auto good = read_text(name, text); !good) return good.error();
  return exchange::well_clear_configuration_from_json(text, name);
}

// Whether two of the files are one.
Result<void> check_files(const AvoidDetectArguments& given) {
  const std::vector<std::pair<const char*, std::string>> files = {
      {"--batch", given.batch},
      {"--out", given.out},
      {"--bands", given.bands},
      {"--guidance", given.guidance}};
  for (std::size_t i = 0; i < files.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) {
      if (files[i].second.empty() || files[k].second.empty()) continue;
      std::error_code none;
      if (std::filesystem::weakly_canonical(files[i].second, none) !=
          std::filesystem::weakly_canonical(files[k].second, none))
        continue;
      return Error{
          ErrorCode::kBadInput, files[i].first,
          fmt::format("{} is what {} names, too.", files[i].second, files[k].first), ""};
    }
  return {};
}

Result<void> write_answers(const AvoidDetectArguments& given,
                           const std::vector<exchange::Encounter>& encounters,
                           const model::WellClearConfiguration& configuration) {
  using Tables = exchange::DetectionTables;
  Tables tables(configuration);
  const int until = given.until.value_or(tables.usual_timeline());
  std::string out =
      given.hysteresis ? Tables::timeline_header() : Tables::alerts_header();
  std::string bands = Tables::bands_header(), guidance = Tables::guidance_header();
  const bool with_bands = !given.bands.empty() || !given.guidance.empty();
  for (const exchange::Encounter& encounter : encounters) {
    if (given.hysteresis)
      tables.add_timeline(encounter, until, out);
    else
      tables.add_alerts(encounter, out);
    if (with_bands) tables.add_bands(encounter, bands, guidance);
  }
  if (auto good = write_file(given.out, out); !good) return good;
  if (!given.bands.empty())
    if (auto good = write_file(given.bands, bands); !good) return good;
  if (!given.guidance.empty()) return write_file(given.guidance, guidance);
  return {};
}

int avoid_detect_command(const AvoidDetectArguments& given) {
  if (auto good = check_files(given); !good) return say_error(good.error());
  const auto configuration = configuration_named(given.configuration);
  if (!configuration) return say_error(configuration.error());
  std::string text;
  if (auto good = read_text(given.batch, text); !good) return say_error(good.error());
  const auto encounters =
      exchange::read_encounters(text, given.batch, configuration.value());
  if (!encounters) return say_error(encounters.error());
  if (auto good = write_answers(given, encounters.value(), configuration.value()); !good)
    return say_error(good.error());
  print("{} encounters answered with {}.\n", encounters.value().size(),
        configuration.value().name);
  return kDone;
}

}  // namespace

Command add_avoid_detect(CLI::App& avoid) {
  auto* command = avoid.add_subcommand(
      "detect", "Alerts, and which tracks, speeds and altitudes lead into conflict.");
  const auto given = std::make_shared<AvoidDetectArguments>();
  command->add_option("--batch", given->batch, "Table of encounters (CSV).")->required();
  command
      ->add_option("--config", given->configuration,
                   "DO_365B_no_SUM, skein_suas or a file (.json).")
      ->required();
  command->add_option("--out", given->out, "Where alerts are written (CSV).")->required();
  command->add_option("--bands", given->bands, "Where bands are written (CSV).");
  command->add_option("--guidance", given->guidance,
                      "Where resolutions and recovery are written (CSV).");
  auto* hysteresis = command->add_flag(
      "--hysteresis", given->hysteresis,
      "Alerts over time, of straight flight asked each second: when they change.");
  command
      ->add_option("--until-s", given->until,
                   "How long; default: the longest early alerting time and 40 s.")
      ->check(CLI::Range(1, 100000))
      ->needs(hysteresis);
  command->footer(kDetectExamples);
  return {command, [given] { return avoid_detect_command(*given); }};
}

}  // namespace skein::app
