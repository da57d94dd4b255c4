// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <type_traits>

#include "skein/data/describe/columns.h"
#include "skein/data/describe/walk.h"
#include "skein/record/store/sql_row.h"
#include "skein/record/store/store_check.h"

namespace skein::record {

/// Calls `take(row)` for each row of a query.
/// @param what  what is read, for messages: "table meta"; empty: a sum of several.
/// Fails: kBadInput for values that make no sense, and what the database says of it.
template <class Take>
Result<void> for_each_row(Sqlite& database, const std::string& sql, Take&& take,
                          const std::string& what = {}) {
  auto prepared = database.prepare(sql);
  if (!prepared) return prepared.error();
  Statement row = std::move(prepared).value();
  while (row.next()) {
    take(row);
    if (!row.problem().empty()) return damaged(database, what, row.problem());
  }
  if (row.failed()) return database.error();
  return {};
}

/// Calls `take(row)` or `take(row, number)` for each row of a table.
/// @param columns  SQL: what of a row.
/// @param rest     SQL behind the table's name; may be empty.
/// Fails: as for_each_row(); kBadInput, too, for rows without an order of their numbers,
///        where `rest` leaves them in that order.
template <class Take>
Result<void> for_each_row_of(Sqlite& database, const std::string& table,
                             const std::string& columns, const std::string& rest,
                             Take&& take) {
  auto prepared = database.prepare("SELECT " + table + ".rowid, " + columns + " FROM " +
                                   table + " " + rest);
  if (!prepared) return prepared.error();
  Statement row = std::move(prepared).value();
  const bool rises = rest.find("ORDER BY") == std::string::npos ||
                     rest.find("ORDER BY rowid") != std::string::npos;
  std::int64_t before = std::numeric_limits<std::int64_t>::min();
  while (row.next()) {
    const std::int64_t number = row.whole(0, 1, kMaxRow);
    if (rises && number <= before)
      row.refuse(0, "a higher number than of the row before");
    before = number;
    if (row.problem().empty()) {
      if constexpr (std::is_invocable_v<Take&, const Statement&, std::int64_t>)
        take(row, number);
      else
        take(row);
    }
    if (!row.problem().empty())
      return damaged(database, "table " + table + ", row " + std::to_string(number),
                     row.problem());
  }
  if (row.failed()) return database.error();
  return {};
}

namespace detail {

// Numbers of a stored value, also of what was coded: none is so large that it cannot be
// computed with. Single numbers may be infinite or not known.
struct LookAtStored {
  bool sound = true;
  void operator()(double& number) {
    sound = sound && !(std::abs(number) > kMaxStored && std::isfinite(number));
  }
  void operator()(Vec2& vector) { look(vector); }
  void operator()(Vec3& vector) { look(vector); }
  void operator()(Quat& turn) { sound = sound && turn.coeffs().allFinite(); }

 private:
  template <class Vector>
  void look(const Vector& vector) {
    sound = sound && vector.allFinite() && vector.cwiseAbs().maxCoeff() <= kMaxStored;
  }
};

}  // namespace detail

/// Calls `take(value)` or `take(value, number)` for each row of a kind's table, as it was
/// recorded.
/// @param order  SQL behind the table's name; may be empty.
/// @param check  of each value and its row, which it may refuse.
/// Fails: as for_each_row_of().
template <Described T, class Take, class Check>
Result<void> for_each_record(Sqlite& database, const std::string& order, Take&& take,
                             Check&& check) {
  const std::string table(kDescription<T>.name.table);
  std::string columns;
  for (const columns::Column& column : columns::columns_of<T>())
    columns += (columns.empty() ? "" : ", ") + table + "." + column.name;
  return for_each_row_of(database, table, columns, order,
                         [&](const Statement& row, std::int64_t number) {
                           T value;
                           RowSource source(row);
                           columns::take(value, source);
                           detail::LookAtStored look;
                           walk::parts(value, look);
                           if (!look.sound)
                             row.refuse(0, "a row of finite numbers up to 1e15");
                           check(std::as_const(value), row);
                           if (!row.problem().empty()) return;
                           if constexpr (std::is_invocable_v<Take&, T, std::int64_t>)
                             take(std::move(value), number);
                           else
                             take(std::move(value));
                         });
}
template <Described T, class Take>
Result<void> for_each_record(Sqlite& database, const std::string& order, Take&& take) {
  return for_each_record<T>(database, order, std::forward<Take>(take),
                            [](const T&, const Statement&) {});
}

}  // namespace skein::record
