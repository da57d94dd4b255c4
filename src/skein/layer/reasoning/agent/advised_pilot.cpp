// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/agent/advised_pilot.h"

#include <algorithm>
#include <string>
#include <variant>

#include "skein/model/path/flight_plan.h"

namespace skein::reasoning {
namespace {

constexpr double kShownFor = 180;           // of a path [s]
constexpr double kStep = 5;                 // between its points [s]
constexpr double kStraight = 60;            // of a course without a plan [s]
const Time kSame = Time::from_seconds(30);  // see is_same()

// What the pilot sees of a flight.
class PathMaker {
 public:
  PathMaker(const AgentInput& in) : in_(in) {}

  std::vector<RecommendedPoint> operator()(const Itinerary& itinerary) const {
    std::vector<RecommendedPoint> path;
    if (itinerary.plan.empty()) return path;
    const double now = in_.now.seconds();
    const double end = std::min(now + kShownFor, model::end_time_of(itinerary.plan));
    for (double time = now; time < end + kStep; time += kStep) {
      const double at = std::min(time, end);
      path.push_back({at, model::moment_at(itinerary.plan, at).p_N});
    }
    return path;
  }
  std::vector<RecommendedPoint> operator()(const Steering& steering) const {
    const NavEstimate& nav = *in_.nav;
    const double now = in_.now.seconds();
    Vec3 to = nav.p_N;
    to.head<2>() += kStraight * nav.v_N.head<2>().norm() * geo::unit(steering.course);
    if (steering.altitude_msl) to.z() = -*steering.altitude_msl;
    return {{now, nav.p_N}, {now + kStraight, to}};
  }
  template <class Other>
  std::vector<RecommendedPoint> operator()(const Other&) const {
    return {};
  }

 private:
  const AgentInput& in_;
};

}  // namespace

void AdvisedPilot::note(RecommendationState state, AgentOutput& out) const {
  out.records.emplace_back(Recommendation{count_, state, std::string(reason_), {}});
}

// Another path soon after the last one is the same recommendation: the pilot has it in
// view and does not begin to think anew.
bool AdvisedPilot::is_same(Time now) const {
  return shown_ && now - shown_at_ < kSame;
}

void AdvisedPilot::show(const FlightIntent& advised, std::string_view reason,
                        const AgentInput& in, AgentOutput& out) {
  const bool same = is_same(in.now);
  if (!same) {
    shown_ = true;
    follows_ = false;
    ++count_;
    const double reaction = random_.uniform(options_.reaction_min, options_.reaction_max);
    obeys_ = random_.uniform() < options_.obeys;
    acts_ = in.now + Time::from_seconds(reaction);
    out.events.push_back({in.now, self_, EventKind::kRecommended, std::string(reason)});
  }
  reason_ = reason;
  shown_number_ = advised.number;
  shown_at_ = in.now;
  out.records.emplace_back(Recommendation{count_, RecommendationState::kShown,
                                          std::string(reason),
                                          std::visit(PathMaker(in), advised.what)});
  if (follows_) note(RecommendationState::kFollowed, out);
  if (!same && !obeys_) note(RecommendationState::kIgnored, out);
}

const FlightIntent* AdvisedPilot::fly(const FlightIntent* task,
                                      const FlightIntent* advised,
                                      std::string_view reason, const AgentInput& in,
                                      AgentOutput& out) {
  if (reason.empty()) {
    if (shown_) note(RecommendationState::kOver, out);
    shown_ = false;
    return flown(advised);
  }
  if (!is_shown(*advised, reason)) show(*advised, reason, in, out);
  if (!follows_ && obeys_ && in.now >= acts_) {
    follows_ = true;
    note(RecommendationState::kFollowed, out);
  }
  if (follows_) return flown(advised);
  // The flight of before goes on; what the task steers from moment to moment is its own.
  if (in.now < acts_ && flown_ && flown_->number != 0) return &*flown_;
  return task;
}

const FlightIntent* AdvisedPilot::flown(const FlightIntent* intent) {
  if (!flown_ || intent->number == 0 || flown_->number != intent->number)
    flown_ = *intent;
  return intent;
}

}  // namespace skein::reasoning
