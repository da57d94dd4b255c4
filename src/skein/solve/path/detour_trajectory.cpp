// SPDX-License-Identifier: Apache-2.0
#include "skein/solve/path/detour_trajectory.h"

#include <algorithm>
#include <cmath>
#include <queue>
#include <tuple>
#include <utility>

#include "skein/base/math.h"
#include "skein/model/path/wind_triangle.h"

namespace skein::solve {
namespace {

// Arcs longer than this have more than one place [rad]; shorter than the second, none.
constexpr double kPerPlace = 1.0, kNoPlace = 0.01;

// A state that may be flown through, with the earliest known arrival.
struct Offer {
  FlightState state;
  double time = math::kInfinity;
  std::size_t layer_before = 0, before = 0;
};
using Layer = std::vector<Offer>;

// The waypoints beside a place on an arc: further out and turned.
void offer(const Detour::Arc& arc, double turned, const PathQuery& query, double altitude,
           Detail detail, Layer& layer) {
  const bool fine = detail == Detail::kFine;
  const double rho = query.limits.turn_radius;
  const std::vector<double> outs =
      fine ? std::vector<double>{0.005, 0.05, 0.15, 0.35, 0.8, 1.6}
           : std::vector<double>{0.005, 0.1, 0.3};
  const std::vector<double> turns = fine ? std::vector<double>{-0.4, -0.2, 0, 0.2, 0.4}
                                         : std::vector<double>{-0.15, 0, 0.15};
  const double course = arc.course + arc.side * turned;
  const auto heading =
      model::heading_for_course(course, query.limits.airspeed, query.wind);
  if (!heading) return;
  const Vec2 out = -arc.side * geo::turned_right(geo::unit(course));
  for (const double o : outs)
    for (const double turn : turns) {
      const Vec2 p = arc.obstacle.centre + (arc.obstacle.radius + o * rho) * out;
      layer.push_back({{Vec3(p.x(), p.y(), -altitude), *heading + turn}});
    }
}

std::vector<Layer> layers_of(const Detour& detour, const PathQuery& query,
                             Detail detail) {
  std::vector<Layer> layers;
  layers.push_back({{query.start, query.start_time}});
  const double a = -query.start.p_N.z(), b = -query.goal.p_N.z();
  const std::size_t n = detour.arcs.size();
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const Detour::Arc& arc = detour.arcs[i];
    if (arc.turned < kNoPlace) continue;
    const int count = static_cast<int>(std::ceil(arc.turned / kPerPlace));
    const double part = static_cast<double>(i) / static_cast<double>(n - 1);
    for (int k = 0; k < count; ++k) {
      layers.emplace_back();
      offer(arc, arc.turned * (k + 0.5) / count, query, a + part * (b - a), detail,
            layers.back());
    }
  }
  layers.push_back({{query.goal}});
  return layers;
}

// The earliest free arrival at an offer from one or two layers before.
void arrive(std::vector<Layer>& layers, std::size_t layer, Offer& to,
            const AirspaceMap& map, SearchBudget& budget) {
  struct Trial {
    double time;
    std::size_t layer, index;
    Link link;
  };
  std::vector<Trial> trials;
  for (std::size_t back = 1; back <= std::min<std::size_t>(2, layer); ++back) {
    const Layer& from = layers[layer - back];
    for (std::size_t i = 0; i < from.size(); ++i) {
      if (from[i].time == math::kInfinity || !budget.spend()) continue;
      const Link l = link(from[i].state, to.state, map.query());
      trials.push_back({from[i].time + l.duration, layer - back, i, l});
    }
  }
  std::sort(trials.begin(), trials.end(), [](const Trial& a, const Trial& b) {
    if (a.time != b.time) return a.time < b.time;
    return a.layer != b.layer ? a.layer < b.layer : a.index < b.index;
  });
  for (const Trial& t : trials) {
    if (t.time == math::kInfinity) break;
    const Offer& from = layers[t.layer][t.index];
    if (!map.is_free(to_flight_plan(t.link, from.state, from.time, map.query())))
      continue;
    to.time = t.time;
    to.layer_before = t.layer;
    to.before = t.index;
    return;
  }
}

void arrive_earliest(std::vector<Layer>& layers, const AirspaceMap& map,
                     SearchBudget& budget) {
  for (std::size_t i = 1; i < layers.size(); ++i)
    for (Offer& to : layers[i]) arrive(layers, i, to, map, budget);
}

// Best-first from offer to offer, each link looked at only when its turn comes: one with
// the minimum time so far and kHeuristicWeight times the time that the route takes from
// there on. That arrives soon, not at the earliest time.
class GreedyArrival {
 public:
  GreedyArrival(std::vector<Layer>& layers, const AirspaceMap& map, SearchBudget& budget)
      : layers_(layers), map_(map), budget_(budget), left_(layers.size(), 0.0) {
    for (std::size_t i = layers.size() - 1; i > 0; --i) {
      left_[i - 1] = left_[i];
      if (layers[i].empty() || layers[i - 1].empty()) continue;
      const Vec3 on = layers[i].front().state.p_N - layers[i - 1].front().state.p_N;
      left_[i - 1] += on.norm() / map.query().limits.airspeed;
    }
  }

  void run() {
    expand(0, 0);
    while (!open_.empty() && !budget_.ended()) {
      const Trial t = open_.top();
      open_.pop();
      Offer& to = layers_[t.layer][t.index];
      const Offer& from = layers_[t.layer_before][t.before];
      if (to.time < math::kInfinity) continue;
      if (!map_.is_free(to_flight_plan(t.link, from.state, from.time, map_.query())))
        continue;
      to.time = from.time + t.link.duration;
      to.layer_before = t.layer_before;
      to.before = t.before;
      if (t.layer + 1 == layers_.size()) return;
      expand(t.layer, t.index);
    }
  }

 private:
  static constexpr double kHeuristicWeight = 3;
  struct Trial {
    double worth;
    std::size_t layer, index, layer_before, before;
    Link link;
    bool operator<(const Trial& other) const {
      if (worth != other.worth) return worth > other.worth;
      return std::tie(layer, index, layer_before, before) >
             std::tie(other.layer, other.index, other.layer_before, other.before);
    }
  };

  void expand(std::size_t layer, std::size_t index) {
    const Offer& from = layers_[layer][index];
    const std::size_t last = std::min(layer + 2, layers_.size() - 1);
    for (std::size_t next = layer + 1; next <= last; ++next)
      for (std::size_t i = 0; i < layers_[next].size(); ++i) {
        if (layers_[next][i].time < math::kInfinity || !budget_.spend()) continue;
        const Link l = link(from.state, layers_[next][i].state, map_.query());
        const double arrival = from.time + l.duration;
        if (arrival < math::kInfinity)
          open_.push(
              {arrival + kHeuristicWeight * left_[next], next, i, layer, index, l});
      }
  }

  std::vector<Layer>& layers_;
  const AirspaceMap& map_;
  SearchBudget& budget_;
  std::vector<double> left_;  // from each layer to the goal along the route [s]
  std::priority_queue<Trial> open_;
};

}  // namespace

std::optional<Trajectory> follow_detour(const Detour& detour, const AirspaceMap& map,
                                        SearchBudget& budget, Detail detail) {
  std::vector<Layer> layers = layers_of(detour, map.query(), detail);
  if (detail == Detail::kFine)
    GreedyArrival(layers, map, budget).run();
  else
    arrive_earliest(layers, map, budget);
  if (layers.back().front().time == math::kInfinity) return std::nullopt;
  std::vector<Waypoint> waypoints;
  std::size_t layer = layers.size() - 1, index = 0;
  while (true) {
    const Offer& o = layers[layer][index];
    waypoints.push_back({o.state});
    if (layer == 0) break;
    layer = o.layer_before;
    index = o.before;
  }
  std::reverse(waypoints.begin(), waypoints.end());
  return make_trajectory(std::move(waypoints), map.query());
}

}  // namespace skein::solve
