// Commands about scenario files and kinds: check, list, schema, keys.
#include "app/commands.h"
#include "app/common.h"
#include "app/output.h"
#include "assemble/build.h"
#include "assemble/kinds_of.h"
#include "base/log.h"
#include "scenario/scenario_file.h"

namespace skein::app {

int check_command(const std::string& file, const std::vector<std::string>& overrides,
                  bool filled_in) {
  const auto scenario = load_scenario(file, overrides);
  if (!scenario) return kBadUsage;
  const auto built = assemble::build(*scenario);  // data files are read here
  if (!built) return say_error(built.error());
  for (const std::string& warning : built.value().warnings) log_warning("{}", warning);
  if (filled_in)
    print("{}", scenario::write_scenario(*scenario, assemble::kind_table()));
  else
    print("{}: good.\n", file);
  return kDone;
}

int list_command(const std::string& role) {
  const scenario::KindTable table = assemble::kind_table();
  bool any = false;
  for (const std::string& each : table.roles()) {
    if (!role.empty() && role != each) continue;
    any = true;
    print("{}:\n", each);
    for (const scenario::Kind& kind : table.of(each))
      print("  {:<14}{}\n", kind.name, kind.help);
  }
  if (any) return kDone;
  complain("There is no role \"{}\". Roles:", role);
  for (const std::string& each : table.roles()) complain(" {}", each);
  complain("\n");
  return kBadUsage;
}

int schema_command() {
  print("{}\n", scenario::json_schema(assemble::kind_table()));
  return kDone;
}

int keys_command() {
  print("{}", scenario::markdown_keys(assemble::kind_table()));
  return kDone;
}

}  // namespace skein::app
