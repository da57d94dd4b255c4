// SPDX-License-Identifier: Apache-2.0
#include "skein/record/store/older_tables.h"

#include <algorithm>

namespace skein::record {
namespace {

// What a version has brought: tables, and columns of tables that were there.
struct Addition {
  int version;
  std::string_view table, column;
  std::string_view before = "NULL";  // SQL: what it is in rows of older versions
};

constexpr Addition kAdditions[] = {
    {16, "separation_losses", ""},
    {17, "events", "other_id"},
    {17, "events", "task"},
    {17, "events", "team_task",
     "CASE kind WHEN 'task-done' THEN "
     "nullif(CAST(CASE WHEN text LIKE 'team task %' THEN substr(text, 11) END"
     " AS INTEGER), 0) WHEN 'team-task' THEN nullif(CAST(text AS INTEGER), 0) END"},
    {17, "events", "value",
     "CASE kind WHEN 'failsafe' THEN"
     " CAST(text <> 'over' AND text NOT LIKE '%: none' AS REAL) END"},
    {17, "events", "threshold"},
};

const Addition* addition_of(std::string_view table, std::string_view column) {
  const auto* found = std::ranges::find_if(kAdditions, [&](const Addition& each) {
    return each.table == table && each.column == column;
  });
  return found == std::end(kAdditions) ? nullptr : found;
}

}  // namespace

bool may_lack(int version, std::string_view table, std::string_view column) {
  const Addition* addition = addition_of(table, column);
  return addition && addition->version > version;
}

Result<void> show_as_present(
    Sqlite& database, int version,
    const std::map<std::string, std::vector<std::string>>& tables) {
  // Temporary ones stand before those of the file that have their name.
  std::string sql = "PRAGMA temp_store=MEMORY;";
  for (const auto& [table, columns] : tables) {
    std::string all;
    bool lacks = false;
    for (const std::string& column : columns) {
      const bool lacking = may_lack(version, table, column);
      lacks = lacks || lacking;
      if (!all.empty()) all += ", ";
      if (lacking) all += std::string(addition_of(table, column)->before) + " AS ";
      all += column;
    }
    if (may_lack(version, table))
      sql += "CREATE TEMP TABLE " + table + " (" + all + ");";
    else if (lacks)
      sql += "CREATE TEMP VIEW " + table + " AS SELECT rowid, " + all + " FROM main." +
             table + ";";
  }
  return database.execute(sql);
}

}  // namespace skein::record
