// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "skein/data/team/task_value.h"
#include "skein/layer/reasoning/agent/task_executor.h"

namespace my_kinds {

/// An expanding square search: legs of 1, 1, 2, 2, 3, 3... spacings around where somebody
/// was last seen, each a quarter turn to the right of the one before.
struct ExpandingSquare {
  skein::Vec2 place = skein::Vec2::Zero();  ///< where it begins [m]
  double spacing = 100;                     ///< between neighbouring legs [m]
  int legs = 12;
  int flown = 0;  ///< of the legs, by whoever had the task before
};

constexpr auto describe(const ExpandingSquare*) {
  using T = ExpandingSquare;
  return skein::described<T>(
      {"expanding_square"}, "Search in growing squares around a point.",
      skein::field("", &T::place, skein::axes::kPlace, "where it begins"),
      skein::field("spacing", &T::spacing, skein::unit::kMetre, "between legs"),
      skein::field("legs", &T::legs, "how many"),
      skein::field("flown", &T::flown, "legs that are flown already"));
}

/// What is wrong with its values; empty: nothing.
std::string check_task(const ExpandingSquare& task);

/// Where it takes place, and how long its flight is.
skein::TaskNeeds needs_of_task(const ExpandingSquare& task);

/// The corners from the begin of the first leg that is left to the end of the last [m].
std::vector<skein::Vec2> corners_of(const ExpandingSquare& task);

/// Flies the legs that are left, then stays at the end of the last.
class ExpandingSquareTask final : public skein::reasoning::TaskExecutor {
 public:
  ExpandingSquareTask(const skein::reasoning::FlightContext& context,
                      const ExpandingSquare& order);

  const skein::reasoning::FlightIntent* plan(const skein::reasoning::TaskStep& step,
                                             skein::AgentOutput& out) override;
  skein::reasoning::TaskProgress progress(const skein::AgentInput& in) const override;
  skein::TaskKind rest() const override { return skein::as_task(left()); }
  std::uint32_t version() const override { return static_cast<std::uint32_t>(passed_); }
  void interrupt() override { intent_.number = 0; }

 private:
  ExpandingSquare left() const;

  ExpandingSquare order_;
  skein::reasoning::Legs legs_;  // of all that was ordered
  skein::reasoning::FlightIntent intent_;
  std::size_t passed_ = 0, begun_at_ = 0;  // corners
  bool done_ = false;
};

}  // namespace my_kinds
