// SPDX-License-Identifier: Apache-2.0
// Commands about kinds and keys: list, schema, keys.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "app/common/commands.h"
#include "app/common/common.h"
#include "app/common/output.h"
#include "app/scenario/file_format.h"
#include "skein/assemble/aircraft/aircraft_file.h"
#include "skein/assemble/radio/radio_fields.h"
#include "skein/assemble/radio/radio_file.h"
#include "skein/assemble/world/verify_kinds.h"
#include "skein/base/check.h"
#include "skein/record/store/event_text.h"
#include "skein/record/store/record_text.h"
#include "skein/record/store/wire_table_text.h"
#include "skein/scenario/markdown.h"
#include "skein/scenario/scenario_file.h"
#include "skein/scenario/schema.h"

namespace skein::app {

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

// The radios that are part of the program.
void list_radios() {
  std::vector<Listed> all;
  const assemble::RadioParts parts = assemble::own_radio_parts();
  for (const assemble::BuiltInRadio& each : assemble::built_in_radios()) {
    const auto file = assemble::read_radio(each.text, std::string(each.name), parts);
    SKEIN_CHECK(file.ok(), each.name, file.error().text());
    all.push_back({std::string(each.name), file.value().description});
  }
  print_list("radio profile", all);
}

// How nodes share a medium: no kinds, as they are parts of it (docs/extending.md).
void list_access() {
  std::vector<Listed> all;
  for (const assemble::AccessWord& each : assemble::kAccessWords)
    all.push_back({each.name, each.help});
  print_list("access", all);
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
  if (role == "radio-profile") {
    list_radios();
    return kDone;
  }
  if (role == "access") {
    list_access();
    return kDone;
  }
  const auto kinds = load_kinds(plugins);
  if (!kinds) return kBadUsage;
  const scenario::KindTable& table = kinds->table();
  bool any = false;
  for (const std::string& each : table.roles()) {
    if (!role.empty() && role != each) continue;
    any = true;
    std::vector<Listed> kinds_of_role;
    for (const scenario::Kind& kind : table.of(each))
      kinds_of_role.push_back(
          {kind.name, kind.help + origin_of(*kinds, each, kind.name)});
    print_list(each, kinds_of_role);
  }
  if (role.empty()) {
    list_aircraft();
    list_radios();
    list_access();
  }
  if (any) return kDone;
  complain("There is no role \"{}\". Roles:", role);
  for (const std::string& each : table.roles()) complain(" {}", each);
  complain(" aircraft radio-profile access\n");
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
  if (document == "wire") {
    print("{}", record::wire_table_typescript());
    return kDone;
  }
  const auto kinds = load_kinds(plugins);
  if (!kinds) return kBadUsage;
  const scenario::Document* other = document_of(document);
  put_out(other ? scenario::schema_text(*other, table_of(document, *kinds))
                : scenario::json_schema(kinds->table()));
  put_out("\n");
  return kDone;
}

int keys_command(const std::string& document, const std::vector<std::string>& plugins) {
  if (document == "records") {
    print("{}", record::records_markdown());
    return kDone;
  }
  if (document == "events") {
    print("{}", record::events_markdown());
    return kDone;
  }
  const auto kinds = load_kinds(plugins);
  if (!kinds) return kBadUsage;
  if (document == "tasks") {
    print(
        "| as a command, after `task AIRCRAFT` | what the aircraft does |\n|---|---|\n");
    for (const TaskForm& form : kinds->table().task_forms().all())
      print("| `{}` | {} |\n", form.usage, form.help);
    return kDone;
  }
  const scenario::Document* other = document_of(document);
  put_out(other ? scenario::keys_as_markdown(*other, table_of(document, *kinds))
                : scenario::markdown_keys(kinds->table()));
  return kDone;
}

}  // namespace skein::app
