#pragma once

#include <string>

#include "skein/data/columns.h"
#include "skein/record/sql_row.h"

namespace skein::record {

/// Calls `take(row)` for each row of a query.
/// Fails: what the database says of it.
template <class Take>
Result<void> for_each_row(Sqlite& database, const std::string& sql, Take&& take) {
  auto prepared = database.prepare(sql);
  if (!prepared) return prepared.error();
  Statement row = std::move(prepared).value();
  while (row.next()) take(row);
  if (row.failed()) return database.error();
  return {};
}

/// Calls `take(value)` for each row of a kind's table, as it was recorded.
/// @param order  SQL behind the table's name; may be empty.
/// Fails: kBadInput for values that make no sense, and what the database says.
template <Described T, class Take>
Result<void> for_each_record(Sqlite& database, const std::string& order, Take&& take) {
  std::string sql;
  for (const columns::Column& column : columns::columns_of<T>())
    sql += (sql.empty() ? "SELECT " : ", ") + column.name;
  const std::string table(kDescription<T>.name.table);
  bool good = true;
  auto done = for_each_row(database, sql + " FROM " + table + " " + order,
                           [&](const Statement& row) {
                             T value;
                             RowSource source(row);
                             columns::take(value, source);
                             good = good && source.good();
                             take(std::move(value));
                           });
  if (done && !good)
    return Error{ErrorCode::kBadInput, "run.sqlite",
                 "the table " + table + " has values that make no sense.", ""};
  return done;
}

/// Fails: kBadInput unless the tables are of the version that this program writes.
Result<void> check_schema(Sqlite& database);

}  // namespace skein::record
