// SPDX-License-Identifier: Apache-2.0
// skein check: all problems of a file at once; names of former versions rewritten.
#include <fmt/format.h>

#include <any>
#include <filesystem>

#include "app/common/commands.h"
#include "app/common/common.h"
#include "app/common/output.h"
#include "app/scenario/file_format.h"
#include "skein/assemble/aircraft/aircraft_file.h"
#include "skein/assemble/radio/radio_file.h"
#include "skein/assemble/relay/relay_profile.h"
#include "skein/assemble/world/build.h"
#include "skein/base/input_file.h"
#include "skein/base/log.h"
#include "skein/base/output_file.h"
#include "skein/campaign/campaign/campaign_file.h"
#include "skein/scenario/parse.h"
#include "skein/scenario/scenario_file.h"
#include "skein/scenario/update.h"

namespace skein::app {
namespace {

namespace fs = std::filesystem;

// What is wrong with a file that is no scenario, as those who use it read it.
Result<void> check_other(std::string_view format, const fs::path& file,
                         const assemble::KindRegistry& kinds) {
  const auto outcome = [](const auto& read) -> Result<void> {
    if (read.ok()) return {};
    return read.error();
  };
  const fs::path path = fs::absolute(file);
  if (format == "aircraft")
    return outcome(assemble::load_aircraft(path.string(), path.parent_path()));
  if (format == "radio")
    return outcome(
        assemble::load_radio(path.string(), path.parent_path(), kinds.kinds()));
  if (format == "relay") return outcome(assemble::load_relay_profile(file, {}));
  return outcome(campaign::read_campaign(file));
}

int check_scenario(const CheckArguments& arguments, const std::string& file,
                   assemble::KindRegistry& kinds) {
  const auto scenario =
      load_scenario(file, arguments.overrides, arguments.plugins, kinds);
  if (!scenario) return kBadUsage;
  const auto built = assemble::build(*scenario, kinds);  // data files are read here
  if (!built) return say_error(built.error());
  for (const std::string& warning : built.value().warnings) log_warning("{}", warning);
  if (arguments.filled_in)
    put_out(scenario::write_scenario(*scenario, kinds.table()));
  else
    print("{}: good.\n", file);
  return kDone;
}

// The names of former versions that a file has. What else is wrong with it is left to
// the check: no file that it names is looked for, no code loaded.
scenario::Reading read_names(std::string_view format, const std::string& text,
                             const std::string& file,
                             const assemble::KindRegistry& kinds) {
  const fs::path folder = fs::absolute(file).parent_path();
  if (format == "scenario")
    return scenario::read_recorded_scenario_text(text, file, folder, kinds.table());
  scenario::Document document = *document_of(format);
  document.says_only = true;
  document.prepare = {};
  std::any value = document.keys->prototype;
  return scenario::read_document_text(text, file, folder, document,
                                      table_of(format, kinds), {},
                                      document.keys->content(value));
}

// Rewrites a file where it has names of former versions, and shows the difference.
int update(const std::string& file, const assemble::KindRegistry& kinds) {
  const auto text = read_file(file, scenario::ParseLimits::kBytes);
  if (!text) return say_error(text.error());
  const std::string_view format = format_of(text.value());
  const auto renames = read_names(format, text.value(), file, kinds).renames;
  if (renames.empty()) {
    print("{}: nothing to update.\n", file);
    return kDone;
  }
  const auto updated = scenario::with_new_names(text.value(), file, renames);
  if (!updated) return say_error(updated.error());
  if (auto written = write_file(file, updated.value()); !written)
    return say_error(written.error());
  print("{}: {} {} updated.\n", file, renames.size(),
        renames.size() == 1 ? "name" : "names");
  put_out(scenario::changed_lines(text.value(), updated.value()));
  return kDone;
}

int check(const CheckArguments& arguments, const std::string& file,
          assemble::KindRegistry& kinds) {
  if (arguments.update)
    if (const int status = update(file, kinds); status != kDone) return status;
  const auto text = read_file(file, scenario::ParseLimits::kBytes);
  const std::string_view format = text ? format_of(text.value()) : "scenario";
  if (format == "scenario") return check_scenario(arguments, file, kinds);
  if (arguments.filled_in || !arguments.overrides.empty())
    return say_error({ErrorCode::kBadInput, file,
                      fmt::format("this is {}; --print and --set are for scenarios.",
                                  document_of(format)->name),
                      ""});
  if (auto good = check_other(format, file, kinds); !good) return say_error(good.error());
  print("{}: good.\n", file);
  return kDone;
}

}  // namespace

int check_command(const CheckArguments& arguments) {
  auto kinds = load_kinds(arguments.plugins, arguments.trusted);
  if (!kinds) return kBadUsage;
  int status = kDone;
  for (const std::string& file : arguments.files)
    if (const int one = check(arguments, file, *kinds); status == kDone) status = one;
  return status;
}

}  // namespace skein::app
