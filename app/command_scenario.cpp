// Commands about scenario files and kinds: check, list, schema, keys.
#include <fmt/core.h>

#include "app/commands.h"
#include "app/common.h"
#include "assemble/build.h"
#include "assemble/kinds_of.h"
#include "scenario/scenario_file.h"

namespace skein::app {

int check_command(const std::string& file, const std::vector<std::string>& overrides,
                  bool print) {
  const auto scenario = load_scenario(file, overrides);
  if (!scenario) return kBadUsage;
  const auto built = assemble::build(*scenario);  // data files are read here
  if (!built) return say_error(built.error());
  for (const std::string& warning : built.value().warnings)
    fmt::print(stderr, "warning: {}\n", warning);
  if (print)
    fmt::print("{}", scenario::write_scenario(*scenario, assemble::kind_table()));
  else
    fmt::print("{}: good.\n", file);
  return kDone;
}

int list_command(const std::string& role) {
  const scenario::KindTable table = assemble::kind_table();
  bool any = false;
  for (const std::string& each : table.roles()) {
    if (!role.empty() && role != each) continue;
    any = true;
    fmt::print("{}:\n", each);
    for (const scenario::Kind& kind : table.of(each))
      fmt::print("  {:<14}{}\n", kind.name, kind.help);
  }
  if (any) return kDone;
  fmt::print(stderr, "There is no role \"{}\". Roles:", role);
  for (const std::string& each : table.roles()) fmt::print(stderr, " {}", each);
  fmt::print(stderr, "\n");
  return kBadUsage;
}

int schema_command() {
  fmt::print("{}\n", scenario::json_schema(assemble::kind_table()));
  return kDone;
}

int keys_command() {
  fmt::print("{}", scenario::markdown_keys(assemble::kind_table()));
  return kDone;
}

}  // namespace skein::app
