#include "skein/layer/reasoning/planning/search/chain.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "skein/model/path/flight_plan.h"

namespace skein::planning {
namespace {

// The budget's stop is asked once in so many states.
constexpr std::int64_t kBetweenAsking = 64;
// Gains below this are none [s].
constexpr double kGain = 1e-6;
constexpr int kMaxSweeps = 400;

// A new piece of a chain in place of what is between states `first` and `last`.
struct Change {
  std::size_t first, last;
  double wait;  // at the first
  std::vector<Via> between;
};

class Improver {
 public:
  Improver(Chain& chain, const AirspaceMap& map, Effort& effort)
      : chain_(chain), map_(map), query_(map.query()), effort_(effort) {}

  bool leave_out();
  bool move(double step);

 private:
  bool try_change(const Change& change);
  bool rest_free(std::size_t from, double later) const;

  Chain& chain_;
  const AirspaceMap& map_;
  const PathQuery& query_;
  Effort& effort_;
};

// Where something depends on time, what follows a change has to be looked at anew.
bool Improver::rest_free(std::size_t from, double later) const {
  if (!map_.is_timed()) return true;
  for (std::size_t i = from; i + 1 < chain_.states.size(); ++i) {
    const Via& via = chain_.states[i];
    const Link l = link(via.at, chain_.states[i + 1].at, query_, via.wait);
    if (!map_.is_free(to_flight_plan(l, via.at, chain_.times[i] + later, query_)))
      return false;
  }
  return true;
}

bool Improver::try_change(const Change& change) {
  std::vector<Via> states = {chain_.states[change.first]};
  states.front().wait = change.wait;
  states.insert(states.end(), change.between.begin(), change.between.end());
  states.push_back(chain_.states[change.last]);
  std::vector<double> times = {chain_.times[change.first]};
  std::vector<Link> links;
  for (std::size_t i = 0; i + 1 < states.size(); ++i) {
    effort_.spend();
    links.push_back(link(states[i].at, states[i + 1].at, query_, states[i].wait));
    times.push_back(times.back() + links.back().duration);
    if (!(times.back() < chain_.times[change.last] - kGain)) return false;
  }
  for (std::size_t i = 0; i < links.size(); ++i)
    if (!map_.is_free(to_flight_plan(links[i], states[i].at, times[i], query_)))
      return false;
  const double later = times.back() - chain_.times[change.last];
  if (!rest_free(change.last, later)) return false;
  for (std::size_t i = change.last; i < chain_.times.size(); ++i)
    chain_.times[i] += later;
  const auto replace = [&](auto& list, const auto& with) {
    const auto at = [&](std::size_t i) {
      return list.begin() + static_cast<std::ptrdiff_t>(i);
    };
    list.insert(list.erase(at(change.first), at(change.last)), with.begin(),
                with.end() - 1);
  };
  replace(chain_.states, states);
  replace(chain_.times, times);
  return true;
}

bool Improver::leave_out() {
  bool any = false;
  for (std::size_t i = 1; i + 1 < chain_.states.size() && !effort_.ended();) {
    const bool gone = try_change({i - 1, i + 1, chain_.states[i - 1].wait, {}});
    any |= gone;
    if (!gone) ++i;
  }
  for (std::size_t i = 0; i + 1 < chain_.states.size() && !effort_.ended(); ++i)
    any |= chain_.states[i].wait > 0 && try_change({i, i + 1, 0, {}});
  return any;
}

bool Improver::move(double step) {
  const double turn = step / query_.limits.turn_radius;
  const bool level = std::all_of(
      chain_.states.begin(), chain_.states.end(),
      [&](const Via& v) { return v.at.p_N.z() == chain_.states.front().at.p_N.z(); });
  bool any = false;
  for (std::size_t i = 0; i + 1 < chain_.states.size() && !effort_.ended(); ++i) {
    const double wait = chain_.states[i].wait - step / query_.limits.airspeed;
    if (wait >= full_turn(query_)) any |= try_change({i, i + 1, wait, {}});
  }
  for (std::size_t i = 1; i + 1 < chain_.states.size(); ++i) {
    const auto shifted = [&](double along, double across, double up, double heading) {
      Via via = chain_.states[i];
      const Vec2 u = geo::unit(via.at.heading);
      via.at.p_N.head<2>() += along * u + across * geo::turned_right(u);
      via.at.p_N.z() -= up;
      via.at.heading += heading;
      return try_change({i - 1, i + 1, chain_.states[i - 1].wait, {via}});
    };
    for (const double a : {step, -step}) {
      if (effort_.ended()) return any;
      const double h = a > 0 ? turn : -turn;
      any |= shifted(0, a, 0, 0) || shifted(0, 0, 0, h) || shifted(a, 0, 0, 0) ||
             shifted(step, 0, 0, h) || shifted(-step, 0, 0, h) || shifted(0, a, 0, h) ||
             shifted(0, a, 0, -h) || (!level && shifted(0, 0, a, 0));
    }
  }
  return any;
}

}  // namespace

bool Effort::spend(std::int64_t states) {
  states_ += states;
  if (states_ >= budget_->states) ended_ = true;
  if (!ended_ && states_ >= asked_) {
    asked_ = states_ + kBetweenAsking;
    ended_ = budget_->ends_at(has_path_ ? budget_->first_states : states_);
  }
  return !ended_;
}

PlanningBudget Effort::part(std::int64_t share) const {
  PlanningBudget part = *budget_;
  part.states = left() / share;
  part.first_states = has_path_ ? 0 : budget_->first_states - states_;
  return part;
}

std::optional<Chain> make_chain(std::vector<Via> states, const PathQuery& query) {
  Chain chain;
  chain.states = std::move(states);
  double time = query.start_time;
  chain.times.push_back(time);
  for (std::size_t i = 0; i + 1 < chain.states.size(); ++i) {
    time += link(chain.states[i].at, chain.states[i + 1].at, query, chain.states[i].wait)
                .duration;
    chain.times.push_back(time);
  }
  if (!std::isfinite(time)) return std::nullopt;
  return chain;
}

FlightPlan to_flight_plan(const Chain& chain, const PathQuery& query) {
  FlightPlan plan;
  for (std::size_t i = 0; i + 1 < chain.states.size(); ++i) {
    const FlightPlan part = to_flight_plan(
        link(chain.states[i].at, chain.states[i + 1].at, query, chain.states[i].wait),
        chain.states[i].at, chain.times[i], query);
    plan.insert(plan.end(), part.begin(), part.end());
  }
  return plan;
}

void improve(Chain& chain, const AirspaceMap& map, Effort& effort, double finest) {
  Improver improver(chain, map, effort);
  improver.leave_out();
  double step = 4 * map.query().limits.turn_radius;
  for (int i = 0; i < kMaxSweeps && step >= finest && !effort.ended(); ++i) {
    const double before = chain.duration();
    const bool moved = improver.move(step);
    if (!moved || before - chain.duration() < 1e-5 * before) {
      step /= 2;
      improver.leave_out();
    }
  }
}

}  // namespace skein::planning
