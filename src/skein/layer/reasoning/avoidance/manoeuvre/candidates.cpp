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

double cost_of_climbs(const FlightPlan& flight) {
  return kPerMetre * climbed(flight);
}

std::vector<Candidate> candidates(const ConflictOfFlight& conflict, double strength,
                                  std::span<const KnownFlight> others,
                                  double look_until) {
  const auto going_on = manoeuvred({ManoeuvreKind::kGoOn}, conflict);
  if (!going_on) return {};
  std::vector<Candidate> all;
  for (const Manoeuvre& manoeuvre :
       manoeuvres(conflict.limits, conflict.separation, strength)) {
    auto flight = manoeuvred(manoeuvre, conflict);
    if (!flight) continue;
    double cost = std::abs(model::end_time_of(*flight) - model::end_time_of(*going_on)) +
                  std::max(0.0, cost_of_climbs(*flight) - cost_of_climbs(*going_on));
    for (const KnownFlight& other : others)
      if (const auto meeting = first_meeting(*flight, *other.plan, other.separation,
                                             conflict.begin, look_until))
        cost += cost_of_meeting(*meeting, conflict.meets);
    all.push_back({manoeuvre, *std::move(flight), cost});
  }
  return all;
}

}  // namespace skein::reasoning
