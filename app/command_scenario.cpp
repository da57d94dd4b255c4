// Commands about scenario files, aircraft files and kinds: check, list, schema, keys.
#include <algorithm>

#include "app/commands.h"
#include "app/common.h"
#include "app/output.h"
#include "skein/assemble/aircraft/aircraft_file.h"
#include "skein/assemble/build.h"
#include "skein/assemble/kinds_of.h"
#include "skein/base/check.h"
#include "skein/base/log.h"
#include "skein/scenario/markdown.h"
#include "skein/scenario/scenario_file.h"
#include "skein/scenario/schema.h"

namespace skein::app {

int check_command(const std::string& file, const std::vector<std::string>& overrides,
                  bool filled_in) {
  const auto scenario = load_scenario(file, overrides);
  if (!scenario) return kBadUsage;
  const auto built = assemble::build(*scenario);  // data files are read here
  if (!built) return say_error(built.error());
  for (const std::string& warning : built.value().warnings) log_warning("{}", warning);
  if (filled_in)
    put_out(scenario::write_scenario(*scenario, assemble::kind_table()));
  else
    print("{}: good.\n", file);
  return kDone;
}

namespace {

struct Listed {
  std::string name, help;
};

// Names in a column as wide as the longest, at least kColumn, then what they are.
void print_list(const std::string& title, const std::vector<Listed>& all) {
  constexpr std::size_t kColumn = 12;
  std::size_t column = kColumn;
  for (const Listed& each : all) column = std::max(column, each.name.size());
  print("{}:\n", title);
  for (const Listed& each : all) print("  {:<{}}  {}\n", each.name, column, each.help);
}

// The aircraft that are part of the program.
void list_aircraft() {
  std::vector<Listed> all;
  for (const assemble::BuiltInAircraft& each : assemble::built_in_aircraft()) {
    const auto file = assemble::read_aircraft(each.text, std::string(each.name));
    SKEIN_CHECK(file.ok(), each.name, file.error().text());
    all.push_back(
        {std::string(each.name),
         fmt::format("{} [{}]", file.value().description, file.value().plants())});
  }
  print_list("aircraft", all);
}

}  // namespace

int list_command(const std::string& role) {
  if (role == "aircraft") {
    list_aircraft();
    return kDone;
  }
  const scenario::KindTable table = assemble::kind_table();
  bool any = false;
  for (const std::string& each : table.roles()) {
    if (!role.empty() && role != each) continue;
    any = true;
    std::vector<Listed> kinds;
    for (const scenario::Kind& kind : table.of(each))
      kinds.push_back({kind.name, kind.help});
    print_list(each, kinds);
  }
  if (role.empty()) list_aircraft();
  if (any) return kDone;
  complain("There is no role \"{}\". Roles:", role);
  for (const std::string& each : table.roles()) complain(" {}", each);
  complain(" aircraft\n");
  return kBadUsage;
}

int schema_command(const std::string& document) {
  const bool aircraft = document == "aircraft";
  put_out(aircraft ? scenario::schema_text(assemble::aircraft_document(), {})
                   : scenario::json_schema(assemble::kind_table()));
  put_out("\n");
  return kDone;
}

int keys_command(const std::string& document) {
  const bool aircraft = document == "aircraft";
  put_out(aircraft ? scenario::keys_as_markdown(assemble::aircraft_document(), {})
                   : scenario::markdown_keys(assemble::kind_table()));
  return kDone;
}

}  // namespace skein::app
