// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "skein/data/describe/strict_json.h"
#include "skein/geo/vec.h"

/// What readers of problem lists share. For source files only.
namespace skein::exchange {

inline constexpr std::size_t kMaxListed = 2000;      // aircraft or tasks of a problem
inline constexpr std::size_t kMaxCases = 1'000'000;  // problems of a file
inline constexpr double kMaxPlace = 1e7;             // from the origin [m]
inline constexpr std::int64_t kMaxId = 1'000'000'000;

/// The point PREFIXnorth_m, PREFIXeast_m.
inline Vec2 read_point(strict_json::Fields& fields, const std::string& prefix) {
  const double north = fields.number((prefix + "north_m"), -kMaxPlace, kMaxPlace);
  const double east = fields.number((prefix + "east_m"), -kMaxPlace, kMaxPlace);
  return {north, east};
}

/// Reads a list of objects, each with an id of its own from 1 on.
template <class Take>
void read_list(strict_json::Fields& fields, const char* key,
               std::vector<std::int64_t>& ids, Take take) {
  std::set<std::int64_t> seen;
  for (const strict_json::Value& item : fields.items(key, kMaxListed)) {
    strict_json::Fields inner(item);
    ids.push_back(inner.whole("id", 1, kMaxId));
    if (!seen.insert(ids.back()).second) inner.problem("id", "stands twice.");
    take(inner);
  }
}

/// Reads a document that is a list of problems, each with an id of its own.
template <class Case, class Read>
Result<std::vector<Case>> read_cases(std::string_view text, const std::string& place,
                                     Read read) {
  strict_json::Problems problems(place);
  std::vector<Case> cases;
  if (const auto json = strict_json::parse(text, problems)) {
    std::set<std::string> seen;
    for (const auto& item : strict_json::Value(*json, "", problems).items(kMaxCases)) {
      cases.push_back(read(item));
      if (!seen.insert(cases.back().id).second)
        item.report("the id is that of another problem.");
      if (problems.full()) break;
    }
  }
  if (problems.any()) return problems.error();
  return cases;
}

}  // namespace skein::exchange
