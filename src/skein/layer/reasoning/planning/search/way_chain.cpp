#include "skein/layer/reasoning/planning/search/way_chain.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "skein/model/path/wind_triangle.h"

namespace skein::planning {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Arcs longer than this have more than one place [rad]; shorter than the second, none.
constexpr double kPerPlace = 1.0, kNoPlace = 0.01;

// A state that may be flown through, with the earliest known arrival.
struct Offer {
  FlightState state;
  double time = kInfinity;
  std::size_t layer_before = 0, before = 0;
};
using Layer = std::vector<Offer>;

// The states beside a place on an arc: further out and turned.
void offer(const Way::Arc& arc, double turned, const PathQuery& query, double altitude,
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
      const Vec2 p = arc.round.centre + (arc.round.radius + o * rho) * out;
      layer.push_back({{Vec3(p.x(), p.y(), -altitude), *heading + turn}});
    }
}

std::vector<Layer> layers_of(const Way& way, const PathQuery& query, Detail detail) {
  std::vector<Layer> layers;
  layers.push_back({{query.start, query.start_time}});
  const double a = -query.start.p_N.z(), b = -query.goal.p_N.z();
  const std::size_t n = way.arcs.size();
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const Way::Arc& arc = way.arcs[i];
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
            const AirspaceMap& map, Effort& effort) {
  struct Trial {
    double time;
    std::size_t layer, index;
    Link link;
  };
  std::vector<Trial> trials;
  for (std::size_t back = 1; back <= std::min<std::size_t>(2, layer); ++back) {
    const Layer& from = layers[layer - back];
    for (std::size_t i = 0; i < from.size(); ++i) {
      if (from[i].time == kInfinity || !effort.spend()) continue;
      const Link l = link(from[i].state, to.state, map.query());
      trials.push_back({from[i].time + l.duration, layer - back, i, l});
    }
  }
  std::sort(trials.begin(), trials.end(), [](const Trial& a, const Trial& b) {
    if (a.time != b.time) return a.time < b.time;
    return a.layer != b.layer ? a.layer < b.layer : a.index < b.index;
  });
  for (const Trial& t : trials) {
    if (t.time == kInfinity) break;
    const Offer& from = layers[t.layer][t.index];
    if (!map.is_free(to_flight_plan(t.link, from.state, from.time, map.query())))
      continue;
    to.time = t.time;
    to.layer_before = t.layer;
    to.before = t.index;
    return;
  }
}

}  // namespace

std::optional<Chain> follow_way(const Way& way, const AirspaceMap& map, Effort& effort,
                                Detail detail) {
  std::vector<Layer> layers = layers_of(way, map.query(), detail);
  for (std::size_t i = 1; i < layers.size(); ++i)
    for (Offer& to : layers[i]) arrive(layers, i, to, map, effort);
  if (layers.back().front().time == kInfinity) return std::nullopt;
  std::vector<Via> states;
  std::size_t layer = layers.size() - 1, index = 0;
  while (true) {
    const Offer& o = layers[layer][index];
    states.push_back({o.state});
    if (layer == 0) break;
    layer = o.layer_before;
    index = o.before;
  }
  std::reverse(states.begin(), states.end());
  return make_chain(std::move(states), map.query());
}

}  // namespace skein::planning
