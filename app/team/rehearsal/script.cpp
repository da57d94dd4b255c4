// SPDX-License-Identifier: Apache-2.0
#include "app/team/rehearsal/script.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "skein/data/describe/strict_json.h"

namespace skein::rehearsal {
namespace {

using strict_json::Problems;
using strict_json::Value;
using What = TeamScriptEvent::What;

constexpr std::size_t kMaxScripts = 10'000, kMaxAircraft = 100, kMaxEvents = 100;
constexpr std::int64_t kMaxId = 65'535;
constexpr std::int64_t kMaxTasks = 1000;
constexpr double kMaxTime = 10'000;  // [s]

EntityId id_of(const Value& value) {
  return {static_cast<std::uint32_t>(value.integer(0, kMaxId))};
}

std::vector<EntityId> ids_of(const Value& list) {
  std::vector<EntityId> ids;
  for (const Value& item : list.items(kMaxAircraft)) {
    const EntityId id = id_of(item);
    if (std::ranges::find(ids, id) != ids.end())
      item.report(fmt::format("{} is there twice.", id.value));
    ids.push_back(id);
  }
  return ids;
}

TeamScriptEvent read_event(const Value& value) {
  TeamScriptEvent event;
  if (!value.is_object_of({"t_s", "what"}, {"aircraft", "parts"})) return event;
  event.time = value.at("t_s").number(0, kMaxTime);
  const std::string what = value.at("what").text(20);
  const auto names = names_of(static_cast<const What*>(nullptr));
  const auto found = std::ranges::find(names, what);
  if (found == names.end()) {
    value.at("what").report("must be crash, join, partition or heal.");
    return event;
  }
  event.what = static_cast<What>(found - names.begin());
  const bool of_one = event.what == What::kCrash || event.what == What::kJoin;
  for (const auto& [key, needed] :
       {std::pair{"aircraft", of_one}, {"parts", event.what == What::kPartition}})
    if (value.has(key) != needed)
      value.report(
          fmt::format("{} the key \"{}\".", needed ? "lacks" : "must not have", key));
  if (of_one && value.has("aircraft")) event.aircraft = id_of(value.at("aircraft"));
  if (event.what == What::kPartition && value.has("parts"))
    for (const Value& part : value.at("parts").items(kMaxAircraft))
      event.parts.push_back(ids_of(part));
  return event;
}

// Whether the events fit to those who are there.
void check_event(const Value& value, const TeamScriptEvent& event,
                 std::set<EntityId>& there, bool& parted) {
  if (event.what == What::kCrash && there.erase(event.aircraft) == 0)
    value.report(fmt::format("{} is not there.", event.aircraft.value));
  if (event.what == What::kJoin && !there.insert(event.aircraft).second)
    value.report(fmt::format("{} is there already.", event.aircraft.value));
  if (event.what == What::kHeal && !parted) value.report("there is no partition.");
  if (event.what == What::kPartition) {
    std::set<EntityId> all;
    std::size_t count = 0;
    for (const auto& part : event.parts) {
      all.insert(part.begin(), part.end());
      count += part.size();
    }
    if (all != there || count != all.size())
      value.report("the parts must have every aircraft that is there once.");
  }
  parted = event.what == What::kPartition || (parted && event.what != What::kHeal);
}

TeamExpectation read_expectation(const Value& value) {
  TeamExpectation expectation;
  if (!value.is_object_of({"t_s", "groups"})) return expectation;
  expectation.time = value.at("t_s").number(0, kMaxTime);
  for (const Value& item : value.at("groups").items(kMaxAircraft)) {
    if (!item.is_object_of({"master", "members", "mission"})) continue;
    TeamGroup group{id_of(item.at("master")), ids_of(item.at("members")),
                    item.at("mission").text(64)};
    std::ranges::sort(group.members);
    expectation.groups.push_back(std::move(group));
  }
  std::ranges::sort(expectation.groups);
  return expectation;
}

TeamScript read_script(const Value& value) {
  TeamScript script;
  if (!value.is_object_of({"id", "aircraft", "tasks", "events", "end_s"}, {"expect"}))
    return script;
  script.id = value.at("id").text(64);
  script.aircraft = ids_of(value.at("aircraft"));
  if (value.at("aircraft").json().is_array() && script.aircraft.empty())
    value.at("aircraft").report("must have one at least.");
  script.tasks = static_cast<std::uint32_t>(value.at("tasks").integer(0, kMaxTasks));
  script.end = value.at("end_s").number(0, kMaxTime);
  std::set<EntityId> there(script.aircraft.begin(), script.aircraft.end());
  bool parted = false;
  for (const Value& item : value.at("events").items(kMaxEvents)) {
    const TeamScriptEvent event = read_event(item);
    if (!script.events.empty() && event.time < script.events.back().time)
      item.report("is before the one before it.");
    check_event(item, event, there, parted);
    script.events.push_back(event);
  }
  if (value.has("expect"))
    for (const Value& item : value.at("expect").items(10 * kMaxEvents))
      script.expect.push_back(read_expectation(item));
  return script;
}

}  // namespace

Result<std::vector<TeamScript>> read_team_scripts(std::string_view text,
                                                  const std::string& name) {
  Problems problems(name);
  std::vector<TeamScript> scripts;
  if (const auto json = strict_json::parse(text, problems)) {
    std::set<std::string> ids;
    for (const Value& item : Value(*json, "", problems).items(kMaxScripts)) {
      scripts.push_back(read_script(item));
      if (!scripts.back().id.empty() && !ids.insert(scripts.back().id).second)
        item.report(fmt::format("the id \"{}\" is there twice.", scripts.back().id));
      if (problems.full()) break;
    }
  }
  if (problems.any()) return problems.error();
  return scripts;
}

}  // namespace skein::rehearsal
