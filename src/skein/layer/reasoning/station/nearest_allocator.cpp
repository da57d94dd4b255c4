// SPDX-License-Identifier: Apache-2.0
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
      : aircraft_(aircraft),
        missions_(missions),
        order_(missions.size()),
        count_(missions.size(), 0) {
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    std::stable_sort(order_.begin(), order_.end(), [&](std::size_t a, std::size_t b) {
      return missions[a].priority > missions[b].priority;
    });
    for (std::size_t m = 0; m < missions.size(); ++m) queues_.push_back(queue_of(m));
    for (std::size_t k = 0; k < aircraft.size(); ++k) {
      owners_.push_back(aircraft[k].owner);
      if (!owners_[k]) continue;
      if (queues_[*owners_[k]].may_fly[k])
        ++count_[*owners_[k]];
      else
        owners_[k].reset();
    }
  }

  Owners share() {
    for (std::size_t m = 0; m < missions_.size(); ++m) release_farthest(m);
    for (const std::size_t m : order_)
      while (count_[m] < missions_[m].demand.min && (take_free(m) || take_owned(m))) {
      }
    // One each, in turn, as long as anybody gets one.
    for (bool given = true; given;) {
      given = false;
      for (const std::size_t m : order_)
        if (count_[m] >= missions_[m].demand.min && count_[m] < missions_[m].demand.max)
          given = take_free(m) || given;
    }
    return owners_;
  }

 private:
  // Who may fly for a mission, the nearest first. Nobody becomes free while missions
  // take, and nobody is given to a mission that is less important: each list is passed
  // through once.
  struct Queue {
    std::vector<bool> may_fly;         // by aircraft
    std::vector<std::size_t> nearest;  // aircraft
    std::size_t next_free = 0, next_owned = 0;
  };

  Queue queue_of(std::size_t mission) const {
    std::vector<EntityId> candidates = missions_[mission].candidates;
    std::sort(candidates.begin(), candidates.end());
    Queue queue;
    std::vector<double> distance(aircraft_.size(), 0);
    for (std::size_t k = 0; k < aircraft_.size(); ++k) {
      queue.may_fly.push_back(
          std::binary_search(candidates.begin(), candidates.end(), aircraft_[k].id));
      if (!queue.may_fly[k]) continue;
      queue.nearest.push_back(k);
      if (const auto& place = missions_[mission].demand.place)
        distance[k] = (aircraft_[k].place - *place).norm();
    }
    std::stable_sort(
        queue.nearest.begin(), queue.nearest.end(),
        [&](std::size_t a, std::size_t b) { return distance[a] < distance[b]; });
    return queue;
  }

  // What a mission has beyond its demand.
  void release_farthest(std::size_t mission) {
    const int max = std::max(missions_[mission].demand.max, 0);
    const auto& nearest = queues_[mission].nearest;
    for (std::size_t k = nearest.size(); k-- > 0 && count_[mission] > max;) {
      if (owners_[nearest[k]] != mission) continue;
      owners_[nearest[k]].reset();
      --count_[mission];
    }
  }

  void give(std::size_t k, std::size_t mission) {
    if (owners_[k]) --count_[*owners_[k]];
    owners_[k] = mission;
    ++count_[mission];
  }

  bool take_free(std::size_t mission) {
    Queue& queue = queues_[mission];
    for (; queue.next_free < queue.nearest.size(); ++queue.next_free) {
      if (owners_[queue.nearest[queue.next_free]]) continue;
      give(queue.nearest[queue.next_free], mission);
      return true;
    }
    return false;
  }

  // The nearest of a mission that is less important.
  bool take_owned(std::size_t mission) {
    Queue& queue = queues_[mission];
    for (; queue.next_owned < queue.nearest.size(); ++queue.next_owned) {
      const std::size_t k = queue.nearest[queue.next_owned];
      if (missions_[*owners_[k]].priority >= missions_[mission].priority) continue;
      give(k, mission);
      return true;
    }
    return false;
  }

  const std::vector<AllocatedAircraft>& aircraft_;
  const std::vector<WantingMission>& missions_;
  std::vector<std::size_t> order_;  // most important first
  std::vector<int> count_;          // aircraft, by mission
  std::vector<Queue> queues_;       // by mission
  Owners owners_;
};

}  // namespace

std::vector<std::optional<std::size_t>> NearestAllocator::allocate(
    const std::vector<AllocatedAircraft>& aircraft,
    const std::vector<WantingMission>& missions) const {
  return Sharing(aircraft, missions).share();
}

}  // namespace skein::reasoning
