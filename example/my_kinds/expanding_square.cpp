// SPDX-License-Identifier: Apache-2.0
#include "expanding_square.h"

#include <algorithm>

#include "skein/layer/reasoning/trajectory/altitude.h"

namespace my_kinds {
namespace {

constexpr int kMaxLegs = 200;
constexpr double kMaxSpacing = 1e4;  // [m]

}  // namespace

std::string check_task(const ExpandingSquare& task) {
  if (!(task.spacing >= 1) || !(task.spacing <= kMaxSpacing))
    return "the spacing is from 1 m to 10000 m.";
  if (task.legs < 1 || task.legs > kMaxLegs) return "it has 1 to 200 legs.";
  if (task.flown < 0 || task.flown >= task.legs) return "nothing is left of it.";
  return skein::place_error(task.place);
}

skein::TaskNeeds needs_of_task(const ExpandingSquare& task) {
  const std::vector<skein::Vec2> corners = corners_of(task);
  skein::TaskNeeds needs = skein::needs_at(corners.front());
  needs.centre = task.place;
  needs.end = corners.back();
  for (std::size_t k = 1; k < corners.size(); ++k)
    needs.length += (corners[k] - corners[k - 1]).norm();
  return needs;
}

std::vector<skein::Vec2> corners_of(const ExpandingSquare& task) {
  const skein::Vec2 directions[] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
  std::vector<skein::Vec2> corners;
  skein::Vec2 at = task.place;
  for (int leg = 0; leg < task.legs; ++leg) {
    if (leg >= task.flown) corners.push_back(at);
    at += task.spacing * (leg / 2 + 1) * directions[leg % 4];
  }
  corners.push_back(at);
  return corners;
}

ExpandingSquareTask::ExpandingSquareTask(const skein::reasoning::FlightContext& context,
                                         const ExpandingSquare& order)
    : order_(order) {
  legs_.points = corners_of(order);
  legs_.altitude_msl =
      skein::reasoning::highest_along(*context.map, legs_.points) + context.altitude_agl;
  legs_.ground_clearance = context.altitude_agl / 2;
}

const skein::reasoning::FlightIntent* ExpandingSquareTask::plan(
    const skein::reasoning::TaskStep& step, skein::AgentOutput&) {
  if (intent_.number != 0 && step.flight.number == intent_.number) {
    passed_ = begun_at_ + step.flight.passed;
    done_ = step.flight.done;
  }
  if (intent_.number == 0) {
    intent_.number = step.intents.next();
    begun_at_ = std::min(passed_, legs_.points.size() - 1);
    skein::reasoning::Legs legs = legs_;
    legs.points.erase(legs.points.begin(),
                      legs.points.begin() + static_cast<std::ptrdiff_t>(begun_at_));
    intent_.what = std::move(legs);
  }
  return &intent_;
}

skein::reasoning::TaskProgress ExpandingSquareTask::progress(
    const skein::AgentInput&) const {
  skein::reasoning::TaskProgress progress;
  progress.done = done_;
  progress.share =
      done_ ? 1 : static_cast<double>(passed_) / static_cast<double>(legs_.points.size());
  return progress;
}

// The leg that is being flown is flown again by whoever takes over.
ExpandingSquare ExpandingSquareTask::left() const {
  ExpandingSquare left = order_;
  const int begun = passed_ > 0 ? static_cast<int>(passed_) - 1 : 0;
  left.flown = std::min(order_.flown + begun, order_.legs - 1);
  return left;
}

}  // namespace my_kinds
