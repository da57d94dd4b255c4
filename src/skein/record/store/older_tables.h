// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "skein/base/result.h"
#include "skein/record/store/sqlite.h"

namespace skein::record {

/// The oldest version of the tables that is read: that of Skein 0.1.
inline constexpr int kOldestSchema = 15;

/// Whether a database of that version may lack a table, or a column of it (empty: the
/// table).
bool may_lack(int version, std::string_view table, std::string_view column = {});

/// Lets a database of an older version be read like one of this: tables that it lacks are
/// empty, columns null; numbers of events that stood in their texts alone are taken out
/// of them. Nothing in the file changes.
/// @param tables  of this version, with their columns.
/// Fails: what SQLite says.
Result<void> show_as_present(
    Sqlite& database, int version,
    const std::map<std::string, std::vector<std::string>>& tables);

}  // namespace skein::record
