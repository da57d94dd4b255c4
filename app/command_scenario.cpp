// Commands about scenario files, aircraft files and kinds: check, list, schema, keys.
#include <fmt/format.h>

#include <filesystem>

#include "app/commands.h"
#include "app/common.h"
#include "app/output.h"
#include "skein/assemble/aircraft/aircraft_file.h"
#include "skein/assemble/build.h"
#include "skein/assemble/verify_kinds.h"
#include "skein/base/check.h"
#include "skein/base/log.h"
#include "skein/record/record_text.h"
#include "skein/scenario/markdown.h"
#include "skein/scenario/scenario_file.h"
#include "skein/scenario/schema.h"

namespace skein::app {

int check_command(const std::string& file, const std::vector<std::string>& overrides,
                  const std::vector<std::string>& plugins, bool filled_in) {
  auto kinds = load_kinds(plugins);
  if (!kinds) return kBadUsage;
  const auto scenario = load_scenario(file, overrides, plugins, *kinds);
  if (!scenario) return kBadUsage;
  const auto built = assemble::build(*scenario, *kinds);  // data files are read here
  if (!built) return say_error(built.error());
  for (const std::string& warning : built.value().warnings) log_warning("{}", warning);
  if (filled_in)
    print("{}", scenario::write_scenario(*scenario, kinds->table()));
  else
    print("{}: good.\n", file);
  return kDone;
}

namespace {

// The aircraft that are part of the program.
void list_aircraft() {
  print("aircraft:\n");
  for (const assemble::BuiltInAircraft& each : assemble::built_in_aircraft()) {
    const auto file = assemble::read_aircraft(each.text, std::string(each.name));
    SKEIN_CHECK(file.ok(), each.name, file.error().text());
    print("  {:<17}{} [{}]\n", each.name, file.value().description,
          file.value().plants());
  }
}

// Where a kind comes from, if it is not part of the program.
std::string origin_of(const assemble::KindRegistry& kinds, const std::string& role,
                      const std::string& kind) {
  const std::filesystem::path plugin = kinds.plugin_of(role, kind);
  return plugin.empty() ? "" : fmt::format(" [{}]", plugin.filename().string());
}

}  // namespace

int list_command(const std::string& role, const std::vector<std::string>& plugins) {
  if (role == "aircraft") {
    list_aircraft();
    return kDone;
  }
  const auto kinds = load_kinds(plugins);
  if (!kinds) return kBadUsage;
  const scenario::KindTable& table = kinds->table();
  bool any = false;
  for (const std::string& each : table.roles()) {
    if (!role.empty() && role != each) continue;
    any = true;
    print("{}:\n", each);
    for (const scenario::Kind& kind : table.of(each))
      print("  {:<16} {}{}\n", kind.name, kind.help, origin_of(*kinds, each, kind.name));
  }
  if (role.empty()) list_aircraft();
  if (any) return kDone;
  complain("There is no role \"{}\". Roles:", role);
  for (const std::string& each : table.roles()) complain(" {}", each);
  complain(" aircraft\n");
  return kBadUsage;
}

int verify_command(const std::string& role, const std::vector<std::string>& plugins) {
  const auto kinds = load_kinds(plugins);
  if (!kinds) return kBadUsage;
  bool good = true;
  for (const auto& verdict : assemble::verify_kinds(*kinds, role, !plugins.empty())) {
    print("{} {}: {}\n", verdict.role, verdict.kind,
          !verdict.not_tested.empty()  ? "not tested: " + verdict.not_tested
          : verdict.violations.empty() ? "keeps its contract."
                                       : "breaks its contract:");
    for (const std::string& violation : verdict.violations) print("  {}.\n", violation);
    good = good && verdict.violations.empty();
  }
  return good ? kDone : kFailed;
}

int schema_command(const std::string& document, const std::vector<std::string>& plugins) {
  if (document == "records") {
    print("{}", record::records_typescript());
    return kDone;
  }
  const auto kinds = load_kinds(plugins);
  if (!kinds) return kBadUsage;
  const bool aircraft = document == "aircraft";
  print("{}\n", aircraft ? scenario::schema_text(assemble::aircraft_document(), {})
                         : scenario::json_schema(kinds->table()));
  return kDone;
}

int keys_command(const std::string& document, const std::vector<std::string>& plugins) {
  if (document == "records") {
    print("{}", record::records_markdown());
    return kDone;
  }
  const auto kinds = load_kinds(plugins);
  if (!kinds) return kBadUsage;
  const bool aircraft = document == "aircraft";
  print("{}", aircraft ? scenario::keys_as_markdown(assemble::aircraft_document(), {})
                       : scenario::markdown_keys(kinds->table()));
  return kDone;
}

}  // namespace skein::app
