// SPDX-License-Identifier: Apache-2.0
#include "skein/solve/path/tangent_graph.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <queue>

#include "skein/base/math.h"
#include "skein/model/path/flight_plan.h"

namespace skein::solve {
namespace {

// Arcs this near to a full circle are none [rad].
constexpr double kFullCircle = 1e-9;
constexpr std::int64_t kTangentsPerExpansion = 8;

struct Tangent {
  std::size_t obstacle;  // where it ends
  int side;
  double course, time;
  Vec2 begin, end;
};

// A tangent's end: on a circle, with the course of the tangent.
struct Node {
  std::size_t obstacle;
  int side;
  double course, time;
  Vec2 p;
  std::int32_t parent;
  double turned;         // on the parent's circle before the tangent
  double blocked = 1e9;  // an arc of this length from here is not free [rad]
};

struct Open {
  double bound, time;
  std::int32_t parent;   // node
  std::int32_t tangent;  // of the parent's circle and side; -1: along the goal's circle
  double turned;
  bool operator<(const Open& other) const {
    return bound != other.bound ? bound > other.bound : parent > other.parent;
  }
};

enum class Known : std::uint8_t { kNot, kFree, kBlocked };

class Search {
 public:
  Search(const AirspaceMap& map, std::span<const CircularObstacle> obstacles,
         const GroundSpeed& speed, const DetourRequest& request,
         const PlanningBudget& budget);
  Detours run();

 private:
  std::size_t row(std::size_t obstacle, int side) const {
    return 2 * obstacle + (side > 0 ? 1 : 0);
  }
  bool is_start(std::size_t obstacle) const {
    return obstacle >= first_end_ && obstacle < first_goal_;
  }
  bool is_goal(std::size_t obstacle) const { return obstacle >= first_goal_; }
  int own_side(std::size_t obstacle) const {
    return obstacle % 2 == first_end_ % 2 ? 1 : -1;
  }
  std::optional<Tangent> tangent(std::size_t i, int side, std::size_t k, int other) const;
  const std::vector<Tangent>& tangents(std::size_t obstacle, int side);
  double altitude(double time, const Vec2& p) const;
  FlightElement geometry(const Vec2& from, double course, double turn, double radius,
                         double begin, double end, const Vec2& to) const;
  bool arc_free(Node& node, double turned);
  bool straight_free(const Node& from, const Tangent& t, double begin);
  bool dominated(std::size_t obstacle, int side, double course, double time);
  void expand(std::int32_t index);
  void settle(const Open& open, Detours& out);
  Detour detour_to(std::int32_t index, double turned, double time) const;

  const AirspaceMap& map_;
  const GroundSpeed& speed_;
  const DetourRequest& request_;
  const PlanningBudget& budget_;
  std::vector<CircularObstacle> obstacles_;
  std::size_t first_end_, first_goal_;
  bool curved_;
  std::vector<Node> nodes_;
  std::vector<std::vector<Tangent>> tangents_;       // by row
  std::vector<bool> has_tangents_;                   // by row
  std::vector<std::vector<Known>> straights_;        // by rows, unless timed
  std::vector<std::vector<std::int32_t>> arrivals_;  // by row
  std::priority_queue<Open> open_;
  std::int64_t tangents_seen_ = 0;
};

Search::Search(const AirspaceMap& map, std::span<const CircularObstacle> obstacles,
               const GroundSpeed& speed, const DetourRequest& request,
               const PlanningBudget& budget)
    : map_(map),
      speed_(speed),
      request_(request),
      budget_(budget),
      obstacles_(obstacles.begin(), obstacles.end()),
      first_end_(obstacles.size()),
      curved_(request.turn_radius > 0) {
  const double r = request.turn_radius;
  const auto circles = [&](const Vec2& p, double course) {
    const Vec2 right = r * geo::turned_right(geo::unit(course));
    obstacles_.push_back({p + right, r});
    if (curved_) obstacles_.push_back({p - right, r});
  };
  circles(request.start, request.start_course);
  first_goal_ = obstacles_.size();
  circles(request.goal, request.goal_course);
  const std::size_t rows = 2 * obstacles_.size();
  tangents_.resize(rows);
  has_tangents_.resize(rows);
  arrivals_.resize(rows);
  straights_.resize(rows);
}

std::optional<Tangent> Search::tangent(std::size_t i, int side, std::size_t k,
                                       int other) const {
  const CircularObstacle &from = obstacles_[i], &to = obstacles_[k];
  const Vec2 apart = to.centre - from.centre;
  const double d = apart.norm();
  const double q = other * to.radius - side * from.radius;
  if (d <= std::abs(q)) return std::nullopt;
  Tangent t{k, other, geo::bearing(apart) - math::asin(q / d), 0, {}, {}};
  const Vec2 out = geo::turned_right(geo::unit(t.course));
  t.begin = from.centre - side * from.radius * out;
  t.end = to.centre - other * to.radius * out;
  t.time = speed_.straight(t.end - t.begin);
  return t;
}

const std::vector<Tangent>& Search::tangents(std::size_t obstacle, int side) {
  const std::size_t r = row(obstacle, side);
  if (has_tangents_[r]) return tangents_[r];
  has_tangents_[r] = true;
  for (std::size_t k = 0; k < obstacles_.size(); ++k) {
    if (k == obstacle || is_start(k)) continue;
    for (const int other : {1, -1}) {
      if (is_goal(k) && other != own_side(k) && curved_) continue;
      if (is_goal(k) && other != 1 && !curved_) continue;
      if (const auto t = tangent(obstacle, side, k, other)) tangents_[r].push_back(*t);
    }
  }
  return tangents_[r];
}

// Evenly from the start's altitude to the goal's, as far as is known how long it takes.
double Search::altitude(double time, const Vec2& p) const {
  const double left = speed_.straight(request_.goal - p);
  const double part = time + left > 0 ? time / (time + left) : 0;
  return request_.start_altitude +
         part * (request_.goal_altitude - request_.start_altitude);
}

// A piece of the route, as if flown without wind.
FlightElement Search::geometry(const Vec2& from, double course, double turn,
                               double length, double begin, double end,
                               const Vec2& to) const {
  FlightElement e;
  e.start = request_.start_time + begin;
  e.duration = end - begin;
  const double z = altitude(begin, from);
  e.p_N = {from.x(), from.y(), -z};
  e.heading = course;
  if (e.duration <= 0) return e;
  e.airspeed = length / e.duration;
  e.turn_rate = turn / e.duration;
  e.climb_rate = (altitude(end, to) - z) / e.duration;
  return e;
}

bool Search::arc_free(Node& node, double turned) {
  if (turned >= node.blocked) return false;
  const CircularObstacle& obstacle = obstacles_[node.obstacle];
  if (turned * obstacle.radius < 1e-6) return true;
  const double turn = node.side * turned;
  const double time = speed_.arc(obstacle.radius, node.course, turn);
  const Vec2 to = obstacle.centre - node.side * obstacle.radius *
                                        geo::turned_right(geo::unit(node.course + turn));
  const bool free =
      map_.is_free(geometry(node.p, node.course, turn, turned * obstacle.radius,
                            node.time, node.time + time, to));
  if (!free) node.blocked = turned;
  return free;
}

bool Search::straight_free(const Node& from, const Tangent& t, double begin) {
  auto& of_row = straights_[row(from.obstacle, from.side)];
  if (of_row.empty()) of_row.resize(2 * obstacles_.size(), Known::kNot);
  Known& known = of_row[row(t.obstacle, t.side)];
  if (!map_.is_timed() && known != Known::kNot) return known == Known::kFree;
  const bool free = map_.is_free(geometry(t.begin, t.course, 0, (t.end - t.begin).norm(),
                                          begin, begin + t.time, t.end));
  known = free ? Known::kFree : Known::kBlocked;
  return free;
}

// Whether one gets there no later along the circle from where one has been on it.
bool Search::dominated(std::size_t obstacle, int side, double course, double time) {
  if (map_.is_timed()) return false;
  for (const std::int32_t index : arrivals_[row(obstacle, side)]) {
    Node& node = nodes_[static_cast<std::size_t>(index)];
    double turned = geo::wrap_2pi(side * (course - node.course));
    if (turned > 2 * geo::kPi - kFullCircle) turned = 0;
    const double arc =
        speed_.arc(obstacles_[obstacle].radius, node.course, side * turned);
    if (node.time + arc <= time + 1e-9 && arc_free(node, turned)) return true;
  }
  return false;
}

void Search::expand(std::int32_t index) {
  const Node node = nodes_[static_cast<std::size_t>(index)];
  const CircularObstacle& obstacle = obstacles_[node.obstacle];
  const bool free_course = !curved_ && is_start(node.obstacle);
  // Turning more than half around a corner leads back.
  const double max = obstacle.corner ? geo::kPi : 2 * geo::kPi - kFullCircle;
  const auto push = [&](double course, double straight, const Vec2& end,
                        std::int32_t tangent) {
    ++tangents_seen_;
    double turned = geo::wrap_2pi(node.side * (course - node.course));
    if (turned > 2 * geo::kPi - kFullCircle || free_course) turned = 0;
    if (turned > max) return;
    const double time = node.time + straight +
                        speed_.arc(obstacle.radius, node.course, node.side * turned);
    const double left = speed_.straight(request_.goal - end);
    if (time + left <= request_.max_time)
      open_.push({time + request_.heuristic_weight * left, time, index, tangent, turned});
  };
  if (is_goal(node.obstacle)) {
    if (curved_)
      push(request_.goal_course, 0, request_.goal, -1);
    else
      open_.push({node.time, node.time, index, -1, 0});
    return;
  }
  const std::vector<Tangent>& all = tangents(node.obstacle, node.side);
  for (std::size_t i = 0; i < all.size(); ++i)
    push(all[i].course, all[i].time, all[i].end, static_cast<std::int32_t>(i));
}

void Search::settle(const Open& open, Detours& out) {
  // Copied: the list of nodes grows.
  const Node parent = nodes_[static_cast<std::size_t>(open.parent)];
  if (!arc_free(nodes_[static_cast<std::size_t>(open.parent)], open.turned)) return;
  if (open.tangent < 0) {
    out.detours.push_back(detour_to(open.parent, open.turned, open.time));
    return;
  }
  const Tangent t =
      tangents(parent.obstacle, parent.side)[static_cast<std::size_t>(open.tangent)];
  if (!straight_free(parent, t, open.time - t.time)) return;
  if (dominated(t.obstacle, t.side, t.course, open.time)) return;
  const auto index = static_cast<std::int32_t>(nodes_.size());
  nodes_.push_back(
      {t.obstacle, t.side, t.course, open.time, t.end, open.parent, open.turned});
  arrivals_[row(t.obstacle, t.side)].push_back(index);
  expand(index);
}

Detours Search::run() {
  Detours out;
  for (std::size_t k = first_end_; k < first_goal_; ++k) {
    const int side = own_side(k);
    nodes_.push_back({k, side, request_.start_course, 0, request_.start, -1, 0});
    expand(static_cast<std::int32_t>(nodes_.size()) - 1);
  }
  const auto enough = [&] {
    return static_cast<int>(out.detours.size()) >= request_.detours;
  };
  std::int64_t settled = 0;
  while (!open_.empty() && !enough() &&
         tangents_seen_ / kTangentsPerExpansion < budget_.expansions) {
    if ((++settled & 63) == 0 && budget_.ends_at(tangents_seen_ / kTangentsPerExpansion))
      break;
    const Open next = open_.top();
    open_.pop();
    settle(next, out);
  }
  out.complete = open_.empty();
  out.expansions = tangents_seen_ / kTangentsPerExpansion + 1;
  return out;
}

Detour Search::detour_to(std::int32_t index, double turned, double time) const {
  Detour detour;
  detour.time = time;
  while (index >= 0) {
    const Node& node = nodes_[static_cast<std::size_t>(index)];
    detour.arcs.push_back({obstacles_[node.obstacle], node.side, node.course, turned});
    turned = node.turned;
    index = node.parent;
  }
  std::reverse(detour.arcs.begin(), detour.arcs.end());
  return detour;
}

}  // namespace

Detours find_tangent_paths(const AirspaceMap& map,
                           std::span<const CircularObstacle> obstacles,
                           const GroundSpeed& speed, const DetourRequest& request,
                           const PlanningBudget& budget) {
  return Search(map, obstacles, speed, request, budget).run();
}

}  // namespace skein::solve
