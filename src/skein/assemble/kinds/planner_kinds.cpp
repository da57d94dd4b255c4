// SPDX-License-Identifier: Apache-2.0
// Planners of paths: one row each.
#include "skein/assemble/kinds/planner_kinds.h"

#include <fmt/format.h>

#include "skein/solve/path/aa_star.h"

namespace skein::assemble {
namespace {

using scenario::Fields;
using solve::AaStar;

struct TangentKind {};

Fields<AaStar::Options> aa_star_fields() {
  using T = AaStar::Options;
  return Fields<T>()
      .boolean("detours", &T::detours, "Begin with routes of tangents around zones.")
      .formerly("ways")
      .boolean("manoeuvres", &T::manoeuvres, "Search over manoeuvres.")
      .number("gap", &T::gap, "Nothing better is looked for within so much of the bound.",
              {.at_least = 0, .at_most = 10});
}

}  // namespace

Kinds<PathPlanner, PlannerContext> planner_kinds() {
  Kinds<PathPlanner, PlannerContext> kinds("planner");
  kinds.add("aastar", "Accelerated A* over manoeuvres, begun with routes around zones.",
            aa_star_fields(), [](const AaStar::Options& o, const PlannerContext&) {
              return std::make_unique<AaStar>(o);
            });
  kinds.add("tangent", "Straights and arcs around zones that stand still.",
            Fields<TangentKind>(), [](const TangentKind&, const PlannerContext&) {
              return std::make_unique<solve::TangentGraph>();
            });
  return kinds;
}

Result<std::unique_ptr<PathPlanner>> make_planner(const std::string& name) {
  scenario::Choice choice{name, {}};
  if (name == "aastar")
    choice.options = AaStar::Options();
  else if (name == "tangent")
    choice.options = TangentKind();
  else
    return Error{ErrorCode::kBadInput, "planner",
                 fmt::format("\"{}\" is none; aastar and tangent are allowed.", name),
                 ""};
  return planner_kinds().make(choice, PlannerContext());
}

}  // namespace skein::assemble
