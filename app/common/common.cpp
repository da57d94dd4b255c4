// SPDX-License-Identifier: Apache-2.0
#include "app/common/common.h"

#include <algorithm>

#include "app/common/commands.h"
#include "app/common/output.h"
#include "app/common/trust.h"
#include "skein/assemble/aircraft/aircraft_file.h"
#include "skein/assemble/kinds/load_plugin.h"
#include "skein/base/input_file.h"
#include "skein/record/store/store_check.h"
#include "skein/scenario/scenario_file.h"

namespace skein::app {

std::optional<assemble::KindRegistry> load_kinds(
    const std::vector<std::string>& plugins, const std::vector<std::string>& trusted) {
  std::optional<assemble::KindRegistry> kinds(std::in_place);
  bool good = true;
  std::vector<std::filesystem::path> folders;
  for (const std::string& folder : trusted) {
    std::error_code error;
    folders.push_back(std::filesystem::canonical(folder, error));
    if (!error && std::filesystem::is_directory(folders.back(), error)) continue;
    say_error(
        {ErrorCode::kNotFound, "--trust " + folder, "there is no such folder.", ""});
    good = false;
  }
  kinds->ask(std::make_shared<Trust>(std::move(folders)));
  for (const std::string& plugin : plugins)
    if (const auto loaded = assemble::load_plugin(plugin, *kinds); !loaded) {
      say_error(loaded.error());
      good = false;
    }
  if (!good) kinds.reset();
  return kinds;
}

std::optional<scenario::Scenario> load_scenario(const std::filesystem::path& file,
                                                const std::vector<std::string>& overrides,
                                                const std::vector<std::string>& plugins,
                                                assemble::KindRegistry& kinds) {
  std::vector<scenario::Override> changes;
  for (const std::string& text : overrides) changes.push_back({text});
  auto outcome = scenario::read_scenario(
      file, kinds.table(), changes,
      [&kinds](const std::string& plugin, const scenario::Source& named_in) {
        return assemble::load_named_plugin(plugin, named_in, kinds);
      });
  if (!outcome.ok()) {
    complain("{}", outcome.report());
    return std::nullopt;
  }
  for (const std::string& plugin : plugins) {
    auto& named = outcome.scenario->plugins;
    const std::string path = std::filesystem::canonical(plugin).string();
    if (std::find(named.begin(), named.end(), path) == named.end()) named.push_back(path);
  }
  return std::move(outcome.scenario);
}

std::optional<scenario::Scenario> load_recorded_scenario(
    const std::filesystem::path& run) {
  const assemble::KindRegistry kinds;
  auto outcome = scenario::read_recorded_scenario(run / "scenario.yaml", kinds.table());
  if (!outcome.ok()) complain("{}", outcome.report());
  return std::move(outcome.scenario);
}

std::string shell_quoted(const std::string& text) {
  if (!text.empty() &&
      text.find_first_of(" \t\n'\"\\$`&|;<>()*?[]#~!{}") == std::string::npos)
    return text;
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

Result<asset::FixedWingParameters> load_fixed_wing(const std::string& aircraft) {
  auto file = assemble::load_aircraft(aircraft, {});
  if (!file) return file.error();
  if (file.value().fixed_wing) return *file.value().fixed_wing;
  return Error{ErrorCode::kBadInput, aircraft,
               fmt::format("has no section fixed_wing, only {}.", file.value().plants()),
               "skein fly takes fixed wings; see skein list aircraft."};
}

Result<void> check_records(const std::filesystem::path& run) {
  std::error_code none;
  if (std::filesystem::exists(run / "run.sqlite", none)) return {};
  return record::state_of_run(
      run, {ErrorCode::kNotFound, (run / "run.sqlite").string(),
            "there is no such database.", "Give the folder of a run."});
}

Result<void> check_run_folder(const std::filesystem::path& run) {
  if (auto records = check_records(run); !records) return records;
  std::error_code none;
  if (std::filesystem::exists(run / "scenario.yaml", none)) return {};
  return record::state_of_run(run, {ErrorCode::kNotFound, run.string(), "holds no run.",
                                    "Give the folder of a run."});
}

std::string folder_name(const std::string& name) {
  constexpr std::size_t kLongest = 100;  // characters; file systems allow 255 bytes
  std::string safe;
  for (const char c : name.substr(0, kLongest)) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                       (c >= '0' && c <= '9') || c == '-' || c == '_' || c == '.';
    if (plain && !(safe.empty() && c == '.'))
      safe += c;
    else if (!safe.empty() && safe.back() != '-')
      safe += '-';
  }
  while (!safe.empty() && safe.back() == '-') safe.pop_back();
  return safe.empty() ? "run" : safe;
}

int say_error(const Error& error) {
  if (error.code == ErrorCode::kInterrupted) {
    complain("{}\n", error.text());
    return kInterrupted;
  }
  complain("error: {}\n", error.text());
  const bool usage =
      error.code == ErrorCode::kBadInput || error.code == ErrorCode::kNotFound;
  return usage ? kBadUsage : kFailed;
}

Result<void> read_text(const std::filesystem::path& file, std::string& text) {
  auto read = read_file(file);
  if (!read) return read.error();
  text = std::move(read).value();
  return {};
}

}  // namespace skein::app
