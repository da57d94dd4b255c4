#include "skein/layer/reasoning/avoidance/manoeuvre/candidates.h"

#include <algorithm>
#include <cmath>

#include "skein/model/path/flight_plan.h"

namespace skein::reasoning {
namespace {

constexpr double kPerMetre = 0.05;            // up or down [s/m]
constexpr double kEarlier = 1e4;              // meeting a third one [s]
constexpr double kSoon = 60, kSoonTime = 30;  // [s]
constexpr double kLater = 8;                  // [s]

// All metres up and down.
double climbed(const FlightPlan& plan) {
  double sum = 0;
  for (const FlightElement& e : plan) {
    const double end_rate = e.climb_rate + e.climb_acceleration * e.duration;
    if (e.climb_rate * end_rate >= 0) {
      sum += std::abs(e.climb_rate + end_rate) / 2 * e.duration;
      continue;
    }
    // It turns from climbing to sinking, or back, in between.
    const double turned = -e.climb_rate / e.climb_acceleration;
    sum += std::abs(e.climb_rate) * turned / 2 +
           std::abs(end_rate) * (e.duration - turned) / 2;
  }
  return sum;
}

}  // namespace

double cost_of_meeting(const PlanMeeting& meeting, double conflict) {
  if (meeting.begin < conflict) return kEarlier;
  return meeting.begin < conflict + kSoonTime ? kSoon : kLater;
}

std::vector<Candidate> candidates(const ConflictOfFlight& conflict, double strength,
                                  std::span<const KnownFlight> others,
                                  double look_until) {
  const double arrival = model::end_time_of(conflict.plan);
  std::vector<Candidate> all;
  double of_plan = 0;  // up and down
  for (const Manoeuvre& manoeuvre :
       manoeuvres(conflict.limits, conflict.separation, strength)) {
    auto flight = manoeuvred(manoeuvre, conflict);
    if (!flight) continue;
    const double up_and_down = climbed(*flight);
    if (manoeuvre.kind == ManoeuvreKind::kGoOn) of_plan = up_and_down;
    double cost = std::abs(model::end_time_of(*flight) - arrival) +
                  kPerMetre * std::max(0.0, up_and_down - of_plan);
    for (const KnownFlight& other : others)
      if (const auto meeting = first_meeting(*flight, *other.plan, other.separation,
                                             conflict.begin, look_until))
        cost += cost_of_meeting(*meeting, conflict.meets);
    all.push_back({manoeuvre, *std::move(flight), cost});
  }
  return all;
}

}  // namespace skein::reasoning
