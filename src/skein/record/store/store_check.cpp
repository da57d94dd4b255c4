// SPDX-License-Identifier: Apache-2.0
#include "skein/record/store/store_check.h"

#include <algorithm>
#include <map>
#include <vector>

#include "skein/base/folder_lock.h"
#include "skein/record/store/older_tables.h"
#include "skein/record/store/record_table.h"
#include "skein/record/store/run_database.h"

namespace skein::record {
namespace {

// A file of this size is read whole in less than a tenth of a second.
constexpr std::uintmax_t kMaxWholeCheck = 32 << 20;

constexpr const char* kRunAgain = "Run its scenario again; --overwrite replaces it.";

struct StoredTable {
  std::vector<std::string> columns;
  bool has_rows = false;  // numbered ones
};

Result<std::map<std::string, StoredTable>> tables_of(Sqlite& database) {
  std::map<std::string, StoredTable> tables;
  auto done = for_each_row(
      database,
      "SELECT name, sql FROM sqlite_master WHERE type = 'table' AND name NOT LIKE "
      "'sqlite\\_%' ESCAPE '\\'",
      [&](const Statement& row) {
        const std::string sql = row.text(1);
        // A virtual table computes its rows.
        if (sql.starts_with("CREATE TABLE"))
          tables[row.text(0)].has_rows = sql.find("WITHOUT ROWID") == std::string::npos;
      });
  if (!done) return done.error();
  for (auto& [name, table] : tables) {
    done =
        for_each_row(database, "SELECT name FROM pragma_table_info('" + name + "')",
                     [&](const Statement& row) { table.columns.push_back(row.text(0)); });
    if (!done) return done.error();
  }
  return tables;
}

// As this program makes them.
Result<std::map<std::string, StoredTable>> expected_tables() {
  auto made = Sqlite::in_memory(run_schema());
  if (!made) return made.error();
  return tables_of(made.value());
}

// @returns the version.
Result<int> check_version(Sqlite& database, bool empty) {
  std::int64_t schema = 0;
  auto done = for_each_row(database, "PRAGMA user_version",
                           [&](const Statement& row) { schema = row.integer(0); });
  if (!done) return done.error();
  if (empty)
    return Error{ErrorCode::kBadInput, database.file().string(),
                 "holds no run: it was ended before anything was recorded.", kRunAgain};
  if (schema >= kOldestSchema && schema <= kSchemaVersion)
    return static_cast<int>(schema);
  return Error{ErrorCode::kBadInput, database.file().string(),
               "its tables are of version " + std::to_string(schema) +
                   ", this program reads versions " + std::to_string(kOldestSchema) +
                   " to " + std::to_string(kSchemaVersion) + ".",
               "Use the program that recorded it, or run the scenario again."};
}

Result<void> check_rows(Sqlite& database, const std::string& table) {
  return for_each_row(
      database,
      "SELECT (SELECT rowid FROM " + table +
          " ORDER BY rowid LIMIT 1) AS rowid, "
          "(SELECT rowid FROM " +
          table + " ORDER BY rowid DESC LIMIT 1) AS rowid",
      [](const Statement& row) {
        if (!row.is_null(0)) row.whole(0, 1, kMaxRow);
        if (!row.is_null(1)) row.whole(1, 1, kMaxRow);
      },
      "table " + table);
}

Result<void> check_inside(Sqlite& database) {
  std::error_code none;
  const auto bytes = std::filesystem::file_size(database.file(), none);
  if (none || bytes > kMaxWholeCheck) return {};
  std::string found;
  auto done = for_each_row(database, "PRAGMA quick_check(1)",
                           [&](const Statement& row) { found = row.text(0); });
  if (!done || found == "ok") return done;
  std::replace(found.begin(), found.end(), '\n', ' ');
  return damaged(database, "", found + ".");
}

}  // namespace

Error damaged(const Sqlite& database, const std::string& what,
              const std::string& problem) {
  return {ErrorCode::kBadInput, database.file().string(),
          what + (what.empty() ? "" : ", ") + problem,
          "The file is damaged, or something else has written into it."};
}

Result<void> check_store(Sqlite& database) {
  const auto tables = tables_of(database);
  if (!tables) return tables.error();
  const auto expected = expected_tables();
  if (!expected) return expected.error();
  const auto version = check_version(database, tables.value().empty());
  if (!version) return version.error();
  std::map<std::string, std::vector<std::string>> present;
  for (const auto& [name, table] : expected.value()) {
    present[name] = table.columns;
    if (may_lack(version.value(), name)) continue;
    const auto found = tables.value().find(name);
    if (found == tables.value().end())
      return damaged(database, "", "has no table " + name + ".");
    for (const std::string& column : table.columns)
      if (std::ranges::find(found->second.columns, column) ==
              found->second.columns.end() &&
          !may_lack(version.value(), name, column))
        return damaged(database, "table " + name, "has no column " + column + ".");
    if (table.has_rows != found->second.has_rows)
      return damaged(database, "table " + name, "is made otherwise than a run's.");
    if (table.has_rows)
      if (auto done = check_rows(database, name); !done) return done;
  }
  if (auto done = check_inside(database); !done) return done;
  return show_as_present(database, version.value(), present);
}

Error state_of_run(const std::filesystem::path& folder, const Error& otherwise) {
  std::error_code none;
  const auto state = [&](const std::string& what, const std::string& hint) {
    return Error{otherwise.code, folder.string(), what, hint};
  };
  if (!std::filesystem::is_directory(folder, none)) return otherwise;
  const bool has_scenario = std::filesystem::exists(folder / "scenario.yaml", none);
  const bool has_records = std::filesystem::exists(folder / "run.sqlite", none);
  if (has_scenario && has_records) return otherwise;
  if (const auto holder = FolderLock::holder(folder))
    return state(*holder + " has just begun there.", "Try again in a moment.");
  if (!has_scenario && !has_records)
    return state("holds no run: there is neither run.sqlite nor scenario.yaml.",
                 "Give the folder that skein run has written.");
  if (!has_records)
    return state("holds a scenario but no records: the run was ended before it began.",
                 "Run it: skein run FOLDER/scenario.yaml.");
  return state(
      "holds records without their scenario.yaml: the run was ended in its first "
      "moments, or the file was removed.",
      kRunAgain);
}

}  // namespace skein::record
