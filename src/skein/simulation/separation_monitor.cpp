// SPDX-License-Identifier: Apache-2.0
#include "skein/simulation/separation_monitor.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace skein::simulation {
namespace {

constexpr double kApartRatio = 1.1;  // an encounter is over from there on
constexpr double kApartFor = 10;     // when that has lasted [s]
constexpr double kGroundTime = 3;    // off the ground: a jump, landing gear springs [s]
constexpr double kMoves = 1;         // on the ground [m/s]
constexpr int kSearches = 30;        // for the least ratio between two moments
constexpr std::uint32_t kMaxFollowed = 64;  // leaders one after the other

// A cell by its place, so that those of a column of the map follow each other.
std::uint64_t key_of(double north, double east, double width) {
  constexpr double kFarthest = 1e9;  // cells from the origin
  const auto count = [&](double place) {
    const double cell =
        std::clamp(std::floor(place / width), -kFarthest, kFarthest) + 2 * kFarthest;
    return static_cast<std::uint64_t>(cell);
  };
  return count(north) << 32 | count(east);
}

using Pair = std::pair<std::uint32_t, std::uint32_t>;

Pair pair_of(const SeparationLossRecord& loss) {
  return {loss.id.value, loss.other.value};
}

void sort_by_pair(std::vector<SeparationLossRecord>& losses) {
  std::ranges::sort(losses, {}, pair_of);
}

}  // namespace

SeparationMonitor::SeparationMonitor(std::size_t entities) : aircraft_(entities) {
  present_.reserve(entities);
  cells_.reserve(entities);
  encounters_.reserve(entities);
  begun_.reserve(entities);
  over_.reserve(entities);
}

void SeparationMonitor::listen(const Message& message) {
  if (const auto* plan = std::get_if<PlanReport>(&message.content)) {
    if (message.from.value < aircraft_.size() && plan->horizontal > 0 &&
        plan->vertical > 0) {
      aircraft_[message.from.value].kept = {plan->horizontal, plan->vertical};
      aircraft_[message.from.value].keeps_apart = true;
    }
  } else if (const auto* task = std::get_if<Task>(&message.content)) {
    if (message.to.value >= aircraft_.size()) return;
    const auto* follows = std::get_if<FollowLeader>(&task->what);
    aircraft_[message.to.value].leader =
        follows ? std::optional(follows->leader) : std::nullopt;
  }
}

void SeparationMonitor::place(EntityId id, const Vec3& p_N, const Vec3& v_N,
                              bool on_ground) {
  if (id.value >= aircraft_.size() || !p_N.allFinite()) return;
  Aircraft& aircraft = aircraft_[id.value];
  aircraft.p_N = p_N;
  aircraft.speed = v_N.allFinite() ? v_N.norm() : 0;
  aircraft.on_ground = on_ground;
  aircraft.is_there = true;
  present_.push_back(id.value);
}

void SeparationMonitor::look(Time now) {
  begun_.clear();
  over_.clear();
  sort_into_cells(now);
  known_ = encounters_.size();
  for (std::size_t k = 0; k < cells_.size(); ++k) look_at_neighbours(k, now);
  sort_by_pair(begun_);
  end_encounters(now);
  for (const std::uint32_t i : present_) aircraft_[i].before = aircraft_[i].p_N;
  for (Aircraft& each : aircraft_) each.was_there = std::exchange(each.is_there, false);
  present_.clear();
  looked_ = now;
}

// As wide as the largest separation, and what is flown between two moments.
void SeparationMonitor::sort_into_cells(Time now) {
  double kept = kCollision.horizontal, moved = 0;
  for (const std::uint32_t i : present_) {
    Aircraft& each = aircraft_[i];
    if (!each.was_there) each.before = each.p_N;
    if (each.on_ground) {
      each.touched = now;
      each.has_touched = true;
    }
    each.on_ground = each.has_touched && (now - each.touched).seconds() < kGroundTime;
    kept = std::max(kept, each.kept.horizontal);
    moved = std::max(moved, (each.p_N - each.before).head<2>().norm());
  }
  moved_ = 2 * moved;
  const double width = kApartRatio * kept + moved_;
  cells_.clear();
  for (const std::uint32_t i : present_)
    cells_.push_back({key_of(aircraft_[i].p_N.x(), aircraft_[i].p_N.y(), width), i});
  std::ranges::sort(cells_, [](const Cell& a, const Cell& b) {
    return std::pair(a.key, a.aircraft) < std::pair(b.key, b.aircraft);
  });
}

// Those behind it in its own column of cells, and those of the next column.
void SeparationMonitor::look_at_neighbours(std::size_t k, Time now) {
  constexpr std::uint64_t kColumn = std::uint64_t{1} << 32;
  const Cell& own = cells_[k];
  for (std::size_t j = k + 1; j < cells_.size() && cells_[j].key <= own.key + 1; ++j)
    look(own.aircraft, cells_[j].aircraft, now);
  const std::uint64_t first = own.key + kColumn - 1;
  auto next = std::lower_bound(
      cells_.begin() + static_cast<std::ptrdiff_t>(k), cells_.end(), first,
      [](const Cell& cell, std::uint64_t key) { return cell.key < key; });
  for (; next != cells_.end() && next->key <= first + 2; ++next)
    look(own.aircraft, next->aircraft, now);
}

// The leader at the head of those whom it follows.
EntityId SeparationMonitor::first_leader(EntityId id) const {
  for (std::uint32_t k = 0; k < kMaxFollowed; ++k) {
    const auto& leader = aircraft_[id.value].leader;
    if (!leader || leader->value >= aircraft_.size()) break;
    id = *leader;
  }
  return id;
}

bool SeparationMonitor::in_formation(const Aircraft& a, const Aircraft& b) const {
  if (!a.leader && !b.leader) return false;
  const auto number = [&](const Aircraft& each) {
    return EntityId{static_cast<std::uint32_t>(&each - aircraft_.data())};
  };
  return first_leader(number(a)) == first_leader(number(b));
}

SeparationPhase SeparationMonitor::phase(const Aircraft& a, const Aircraft& b) const {
  if (a.on_ground || b.on_ground) return SeparationPhase::kGround;
  return in_formation(a, b) ? SeparationPhase::kFormation : SeparationPhase::kAir;
}

// Whether two that fly straight from moment to moment are at no time nearer to each other
// on the map than this [m].
bool SeparationMonitor::stays_beside(const Aircraft& a, const Aircraft& b,
                                     double distance) {
  constexpr double kRounding = 1e-6;  // [m]
  const Vec2 from = (b.before - a.before).head<2>();
  const Vec2 motion = (b.p_N - a.p_N).head<2>() - from;
  const double moved2 = motion.squaredNorm();
  const double share = moved2 > 0 ? std::clamp(-from.dot(motion) / moved2, 0.0, 1.0) : 0;
  return (from + share * motion).norm() > distance + kRounding;
}

// Along the straight motion of both the ratio is convex: the larger of two distances to
// a line.
SeparationMonitor::Closest SeparationMonitor::closest(const Aircraft& a,
                                                      const Aircraft& b,
                                                      const Separation& kept) {
  const Vec3 from = b.before - a.before, to = b.p_N - a.p_N;
  const auto at = [&](double share) {
    const Vec3 apart = from + share * (to - from);
    Closest moment;
    moment.share = share;
    moment.horizontal = apart.head<2>().norm();
    moment.vertical = std::abs(apart.z());
    moment.distance = apart.norm();
    moment.ratio = kept.ratio(moment.horizontal, moment.vertical);
    return moment;
  };
  Closest least = at(1);
  const double moved = (to - from).norm();
  if (moved <= 0 || at(1).distance > kept.horizontal + kept.vertical + moved)
    return least;
  double low = 0, high = 1;
  for (int k = 0; k < kSearches; ++k) {
    const double a_third = low + (high - low) / 3, two_thirds = high - (high - low) / 3;
    if (at(a_third).ratio <= at(two_thirds).ratio)
      high = two_thirds;
    else
      low = a_third;
  }
  const Closest between = at((low + high) / 2);
  return between.ratio < least.ratio ? between : least;
}

void SeparationMonitor::look(std::uint32_t a, std::uint32_t b, Time now) {
  if (a > b) std::swap(a, b);
  const Aircraft& one = aircraft_[a];
  const Aircraft& other = aircraft_[b];
  SeparationLossRecord moment;
  moment.phase = phase(one, other);
  const Separation kept =
      moment.phase == SeparationPhase::kAir ? larger(one.kept, other.kept) : kCollision;
  const Vec3 apart = other.p_N - one.p_N;
  // Most neighbours are far from what is kept.
  const double beside = kApartRatio * kept.horizontal + moved_;
  if (std::abs(apart.x()) > beside || std::abs(apart.y()) > beside) return;
  if (stays_beside(one, other, kApartRatio * kept.horizontal)) return;
  const Closest closest = SeparationMonitor::closest(one, other, kept);
  if (closest.ratio >= kApartRatio) return;
  const bool moves = moment.phase != SeparationPhase::kGround || one.speed > kMoves ||
                     other.speed > kMoves;
  if (!moves) return;
  moment.id = EntityId{a};
  moment.other = EntityId{b};
  moment.closest =
      Time::from_seconds(looked_.seconds() + closest.share * (now - looked_).seconds());
  moment.begun = moment.closest;
  moment.time = now;
  moment.ratio = closest.ratio;
  moment.horizontal = closest.horizontal;
  moment.vertical = closest.vertical;
  moment.distance = closest.distance;
  moment.required_horizontal = kept.horizontal;
  moment.required_vertical = kept.vertical;
  take(moment, now);
}

// What a pair that is near has done since the last moment.
void SeparationMonitor::take(const SeparationLossRecord& moment, Time now) {
  const auto known = std::span(encounters_).first(known_);
  const auto found =
      std::ranges::lower_bound(known, pair_of(moment), {},
                               [](const Encounter& each) { return pair_of(each.loss); });
  if (found == known.end() || pair_of(found->loss) != pair_of(moment)) {
    if (moment.ratio >= 1) return;
    encounters_.push_back({moment, now});
    begun_.push_back(moment);
    return;
  }
  found->is_apart = false;
  SeparationLossRecord& loss = found->loss;
  loss.distance = std::min(loss.distance, moment.distance);
  if (moment.ratio >= loss.ratio) return;
  const SeparationLossRecord before = loss;
  loss = moment;
  loss.begun = before.begun;
  loss.distance = std::min(before.distance, moment.distance);
}

void SeparationMonitor::end_encounters(Time now) {
  for (Encounter& each : encounters_) {
    const bool present = aircraft_[each.loss.id.value].is_there &&
                         aircraft_[each.loss.other.value].is_there;
    if (!present || (each.is_apart && (now - each.apart_since).seconds() >= kApartFor)) {
      each.loss.time = now;
      each.loss.over = present;
      each.is_over = true;
      over_.push_back(each.loss);
    } else if (!each.is_apart) {
      // Until the next moment says otherwise.
      each.is_apart = true;
      each.apart_since = now;
    }
  }
  std::erase_if(encounters_, [](const Encounter& each) { return each.is_over; });
  std::ranges::sort(encounters_, {},
                    [](const Encounter& each) { return pair_of(each.loss); });
  sort_by_pair(over_);
}

void SeparationMonitor::finish(Time now) {
  begun_.clear();
  over_.clear();
  for (Encounter& each : encounters_) {
    each.loss.time = now;
    each.loss.over = false;
    over_.push_back(each.loss);
  }
  encounters_.clear();
}

}  // namespace skein::simulation
