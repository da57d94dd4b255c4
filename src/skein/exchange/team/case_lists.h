// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "skein/exchange/team/strict_json.h"
#include "skein/geo/vec.h"

/// What readers of problem lists share. For source files only.
namespace skein::exchange {

inline constexpr std::size_t kMaxListed = 2000;  // aircraft or tasks of a problem
inline constexpr double kMaxPlace = 1e7;         // from the origin [m]
inline constexpr std::int64_t kMaxId = 1'000'000'000;

/// The point PREFIXnorth_m, PREFIXeast_m.
inline Vec2 read_point(JsonFields& fields, const std::string& prefix) {
  const double north = fields.number((prefix + "north_m").c_str(), -kMaxPlace, kMaxPlace);
  const double east = fields.number((prefix + "east_m").c_str(), -kMaxPlace, kMaxPlace);
  return {north, east};
}

/// Reads a list of objects, each with an id of its own from 1 on.
template <class Take>
void read_list(JsonFields& fields, const char* key, JsonProblems& problems,
               std::vector<std::int64_t>& ids, Take take) {
  const StrictJson* list = fields.list(key);
  if (!list) return;
  if (list->size() > kMaxListed) {
    fields.problem(key, fmt::format("at most {} are allowed.", kMaxListed));
    return;
  }
  std::set<std::int64_t> seen;
  for (std::size_t k = 0; k < list->size(); ++k) {
    JsonFields inner((*list)[k], fmt::format("{}.{}[{}]", fields.place(), key, k),
                     problems);
    ids.push_back(inner.whole("id", 1, kMaxId));
    if (!seen.insert(ids.back()).second) inner.problem("id", "stands twice.");
    take(inner);
  }
}

/// Reads a document that is a list of problems, each with an id of its own.
template <class Case, class Read>
Result<std::vector<Case>> read_cases(std::string_view text, const std::string& place,
                                     Read read) {
  const auto parsed = parse_strictly(text, place);
  if (!parsed) return parsed.error();
  if (!parsed.value().is_array())
    return Error{ErrorCode::kBadInput, place, "must be a list of problems.", ""};
  JsonProblems problems;
  std::vector<Case> cases;
  std::set<std::string> seen;
  for (std::size_t k = 0; k < parsed.value().size(); ++k) {
    const std::string at = fmt::format("{}: [{}]", place, k);
    cases.push_back(read(parsed.value()[k], at, problems));
    if (!seen.insert(cases.back().id).second)
      problems.add(at + ".id", "another problem has it too.");
  }
  if (!problems.none()) return problems.error();
  return cases;
}

}  // namespace skein::exchange
