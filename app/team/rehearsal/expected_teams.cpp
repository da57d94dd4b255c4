// SPDX-License-Identifier: Apache-2.0
#include "app/team/rehearsal/expected_teams.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <tuple>

#include "skein/base/random.h"

namespace skein::rehearsal {
namespace {

using What = TeamScriptEvent::What;

struct Teams {
  std::vector<TeamGroup> groups;
  std::map<std::pair<EntityId, EntityId>, int> met;

  void crash(EntityId id) {
    for (TeamGroup& group : groups) {
      std::erase(group.members, id);
      if (group.master == id && !group.members.empty())
        group.master = group.members.front();
    }
    std::erase_if(groups, [](const TeamGroup& group) { return group.members.empty(); });
  }

  void join(EntityId id) {
    TeamGroup& group = *std::ranges::min_element(groups, {}, [](const TeamGroup& g) {
      return std::tuple(g.members.size(), g.master);
    });
    group.members.push_back(id);
    std::ranges::sort(group.members);
  }

  void partition(const std::vector<std::vector<EntityId>>& parts) {
    std::vector<TeamGroup> all;
    for (const TeamGroup& group : groups)
      for (const auto& part : parts) {
        TeamGroup left{group.master, {}, group.mission};
        for (const EntityId id : group.members)
          if (std::ranges::find(part, id) != part.end()) left.members.push_back(id);
        if (left.members.empty()) continue;
        if (std::ranges::find(left.members, left.master) == left.members.end())
          left.master = left.members.front();
        all.push_back(std::move(left));
      }
    groups = std::move(all);
  }

  // The two lowest masters of one mission that meet.
  std::optional<std::pair<std::size_t, std::size_t>> rivals() const {
    for (std::size_t a = 0; a < groups.size(); ++a)
      for (std::size_t b = a + 1; b < groups.size(); ++b)
        if (groups[a].mission == groups[b].mission) return std::pair(a, b);
    return std::nullopt;
  }

  void heal() {
    std::ranges::sort(groups);
    while (const auto pair = rivals()) {
      TeamGroup& stays = groups[pair->first];
      TeamGroup& other = groups[pair->second];
      if (met[{stays.master, other.master}]++ == 0) {
        stays.members.insert(stays.members.end(), other.members.begin(),
                             other.members.end());
        std::ranges::sort(stays.members);
        groups.erase(groups.begin() + static_cast<std::ptrdiff_t>(pair->second));
        continue;
      }
      const std::string root = stays.mission.substr(0, stays.mission.find('/'));
      stays.mission = fmt::format("{}/{}", root, stays.master.value);
      other.mission = fmt::format("{}/{}", root, other.master.value);
    }
  }

  TeamExpectation at(double time) const {
    TeamExpectation expectation{time, groups};
    std::ranges::sort(expectation.groups);
    return expectation;
  }
};

// Draws the events of a script, one after the other.
class Drawing {
 public:
  Drawing(std::uint64_t seed, std::uint32_t index, std::uint32_t max_aircraft)
      : random_(seed, index, Purpose::kTeam) {
    script_.id = fmt::format("r{}", index);
    const std::uint32_t count = below(max_aircraft - 1) + 2;
    while (there_.size() < count) there_.insert({below(60)});
    script_.aircraft = {there_.begin(), there_.end()};
    script_.tasks = below(2 * count) + 1;
  }

  TeamScript draw() {
    double time = 60 + below(40);
    const std::uint32_t events = below(5) + 1;
    for (std::uint32_t k = 0; k < events; ++k) {
      if (!draw_event(time)) continue;
      time += 40 + below(50);
    }
    script_.end = time + 10;
    return script_;
  }

 private:
  std::uint32_t below(std::uint32_t n) {
    return static_cast<std::uint32_t>(random_.uniform() * n);
  }

  // As reference scripts do: partitions heal before the next one, newcomers come when
  // all are in contact; once the mission was split there are only crashes and newcomers.
  bool draw_event(double time) {
    TeamScriptEvent event;
    event.time = time;
    const std::uint32_t dice = below(10);
    if (parted_ ? dice < 7 : dice < 4) {
      if (!parted_ && (there_.size() < 2 || heals_ >= 2)) return false;
      event.what = parted_ ? What::kHeal : What::kPartition;
      if (!parted_) event.parts = draw_parts();
      heals_ += parted_ ? 1 : 0;
      parted_ = !parted_;
    } else if (dice < 8) {
      if (there_.size() < 2) return false;
      auto at = there_.begin();
      std::advance(at, below(static_cast<std::uint32_t>(there_.size())));
      event.what = What::kCrash;
      event.aircraft = *at;
      there_.erase(at);
    } else {
      event.what = What::kJoin;
      event.aircraft = {60 + below(40)};
      if (below(3) == 0) event.aircraft = {below(60)};
      if (parted_ || used_.contains(event.aircraft) ||
          !there_.insert(event.aircraft).second)
        return false;
    }
    used_.insert(event.aircraft);
    script_.events.push_back(std::move(event));
    return true;
  }

  std::vector<std::vector<EntityId>> draw_parts() {
    if (!last_parts_.empty() && below(2) == 0) {
      // The same again: the second meeting of the same two.
      std::vector<std::vector<EntityId>> parts = last_parts_;
      std::set<EntityId> left = there_;
      for (auto& part : parts) {
        std::erase_if(part, [&](EntityId id) { return left.erase(id) == 0; });
      }
      parts.front().insert(parts.front().end(), left.begin(), left.end());
      std::erase_if(parts, [](const auto& part) { return part.empty(); });
      if (parts.size() == 2) return parts;
    }
    std::vector<std::vector<EntityId>> parts(2);
    std::vector<EntityId> all(there_.begin(), there_.end());
    for (const EntityId id : all) parts[below(2)].push_back(id);
    if (parts[0].empty() || parts[1].empty()) {
      parts[0] = {all.front()};
      parts[1] = {all.begin() + 1, all.end()};
    }
    last_parts_ = parts;
    return parts;
  }

  RandomStream random_;
  TeamScript script_;
  std::set<EntityId> there_, used_;
  std::vector<std::vector<EntityId>> last_parts_;
  bool parted_ = false;
  int heals_ = 0;
};

}  // namespace

std::vector<TeamExpectation> expected_teams(const TeamScript& script) {
  Teams teams;
  std::vector<EntityId> all = script.aircraft;
  std::ranges::sort(all);
  if (!all.empty()) teams.groups = {{all.front(), all, "M"}};
  std::vector<TeamExpectation> expected = {teams.at(0)};
  for (const TeamScriptEvent& event : script.events) {
    switch (event.what) {
      case What::kCrash:
        teams.crash(event.aircraft);
        break;
      case What::kJoin:
        if (!teams.groups.empty()) teams.join(event.aircraft);
        break;
      case What::kPartition:
        teams.partition(event.parts);
        break;
      case What::kHeal:
        teams.heal();
        break;
    }
    expected.push_back(teams.at(event.time));
  }
  return expected;
}

TeamScript random_team_script(std::uint64_t seed, std::uint32_t index,
                              std::uint32_t max_aircraft) {
  return Drawing(seed, index, max_aircraft).draw();
}

}  // namespace skein::rehearsal
