#include "skein/layer/reasoning/station/nearest_allocator.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace skein::reasoning {
namespace {

using Owners = std::vector<std::optional<std::size_t>>;

class Sharing {
 public:
  Sharing(const std::vector<AllocatedAircraft>& aircraft,
          const std::vector<WantingMission>& missions)
      : aircraft_(aircraft), missions_(missions), order_(missions.size()) {
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    std::stable_sort(order_.begin(), order_.end(), [&](std::size_t a, std::size_t b) {
      return missions[a].priority > missions[b].priority;
    });
    for (const AllocatedAircraft& each : aircraft) owners_.push_back(each.owner);
  }

  Owners share() {
    for (std::size_t k = 0; k < owners_.size(); ++k)
      if (owners_[k] && !may_fly(k, *owners_[k])) owners_[k].reset();
    for (std::size_t m = 0; m < missions_.size(); ++m)
      while (count(m) > std::max(missions_[m].demand.max, 0)) release_farthest(m);
    for (const std::size_t m : order_)
      while (count(m) < missions_[m].demand.min && take_one(m, true)) {
      }
    // One each, in turn, as long as anybody gets one.
    for (bool given = true; given;) {
      given = false;
      for (const std::size_t m : order_)
        if (count(m) >= missions_[m].demand.min && count(m) < missions_[m].demand.max)
          given = take_one(m, false) || given;
    }
    return owners_;
  }

 private:
  bool may_fly(std::size_t k, std::size_t mission) const {
    const auto& candidates = missions_[mission].candidates;
    return std::find(candidates.begin(), candidates.end(), aircraft_[k].id) !=
           candidates.end();
  }

  int count(std::size_t mission) const {
    return static_cast<int>(
        std::count(owners_.begin(), owners_.end(), std::optional(mission)));
  }

  double distance(std::size_t k, std::size_t mission) const {
    const auto& place = missions_[mission].demand.place;
    return place ? (aircraft_[k].place - *place).norm() : 0;
  }

  void release_farthest(std::size_t mission) {
    std::optional<std::size_t> farthest;
    for (std::size_t k = 0; k < owners_.size(); ++k)
      if (owners_[k] == mission &&
          (!farthest || distance(k, mission) >= distance(*farthest, mission)))
        farthest = k;
    owners_[*farthest].reset();
  }

  // Whether an aircraft may be taken for a mission: a free one, or one of a mission that
  // is less important.
  bool may_take(std::size_t k, std::size_t mission, bool from_others) const {
    if (!may_fly(k, mission) || owners_[k] == mission) return false;
    return !owners_[k] ||
           (from_others && missions_[*owners_[k]].priority < missions_[mission].priority);
  }

  // The nearest; a free one before any other.
  bool take_one(std::size_t mission, bool from_others) {
    std::optional<std::size_t> best;
    for (std::size_t k = 0; k < owners_.size(); ++k) {
      if (!may_take(k, mission, from_others)) continue;
      const auto worse = [&](std::size_t a, std::size_t b) {
        if (owners_[a].has_value() != owners_[b].has_value())
          return owners_[a].has_value();
        return distance(a, mission) > distance(b, mission);
      };
      if (!best || worse(*best, k)) best = k;
    }
    if (!best) return false;
    owners_[*best] = mission;
    return true;
  }

  const std::vector<AllocatedAircraft>& aircraft_;
  const std::vector<WantingMission>& missions_;
  std::vector<std::size_t> order_;  // most important first
  Owners owners_;
};

}  // namespace

std::vector<std::optional<std::size_t>> NearestAllocator::allocate(
    const std::vector<AllocatedAircraft>& aircraft,
    const std::vector<WantingMission>& missions) const {
  return Sharing(aircraft, missions).share();
}

}  // namespace skein::reasoning
