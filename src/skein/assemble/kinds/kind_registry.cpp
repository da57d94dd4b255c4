// SPDX-License-Identifier: Apache-2.0
#include "skein/assemble/kinds/kind_registry.h"

#include <fmt/format.h>

#include <algorithm>

#include "skein/assemble/kinds/map_places.h"
#include "skein/assemble/radio/radio_file.h"

namespace skein::assemble {
namespace {

// Calls `visit` with the member of KindsByRole for each role.
template <class Visit>
void for_each_role(Visit visit) {
  using K = KindsByRole;
  const auto all = [&visit](auto... role) { (visit(role), ...); };
  all(&K::terrain, &K::wind, &K::turbulence, &K::phenomenon, &K::movement, &K::traffic,
      &K::vehicle, &K::plant, &K::autopilot, &K::sensor, &K::agent, &K::task, &K::mission,
      &K::routing, &K::propagation, &K::antenna, &K::error_model, &K::radio,
      &K::estimator, &K::strategy, &K::planner);
}

KindsByRole own_kinds() {
  KindsByRole kinds;
  static_cast<RadioParts&>(kinds) = own_radio_parts();
  kinds.terrain = terrain_kinds();
  kinds.wind = wind_kinds();
  kinds.turbulence = turbulence_kinds();
  kinds.phenomenon = phenomenon_kinds();
  kinds.movement = movement_kinds();
  kinds.traffic = traffic_kinds();
  kinds.vehicle = vehicle_kinds();
  kinds.plant = plant_kinds();
  kinds.autopilot = autopilot_kinds();
  kinds.sensor = sensor_kinds();
  kinds.agent = agent_kinds();
  kinds.task = task_kinds();
  kinds.mission = mission_kinds();
  kinds.routing = routing_kinds();
  kinds.radio = radio_kinds();
  kinds.estimator = estimator_kinds();
  kinds.strategy = strategy_kinds();
  kinds.planner = planner_kinds();
  return kinds;
}

void describe(const KindsByRole& kinds, scenario::KindTable& table) {
  for_each_role([&](auto role) { (kinds.*role).describe(table); });
}

// What parts words in names: tasks are JSON's and wire's values, others keys of files.
char hyphen_of(std::string_view role) {
  return role == "task" ? '_' : '-';
}

bool is_name(const std::string& name, char hyphen) {
  return !name.empty() && std::all_of(name.begin(), name.end(), [hyphen](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == hyphen;
  });
}

Error refusal(const std::string& plugin, std::string message, std::string hint = {}) {
  return {ErrorCode::kBadInput, plugin, std::move(message), std::move(hint)};
}

// The profile of a radio where its kind belongs.
std::string profile_for_kind(std::string_view role, std::string_view name) {
  for (const BuiltInRadio& each : built_in_radios())
    if (role == "radio" && each.name == name)
      return fmt::format("It is a profile: {{kind: medium, profile: {}}}.", name);
  return "";
}

}  // namespace

scenario::KindTable KindsByRole::described() const {
  scenario::KindTable table;
  describe(*this, table);
  table.set_task_forms(task.forms());
  return table;
}

KindRegistry::KindRegistry() : kinds_(own_kinds()), table_(kinds_.described()) {
  table_.set_feature_reader(feature_points);
  table_.set_name_hint(profile_for_kind);
}

Result<void> KindRegistry::add(const KindsByRole& more, const std::string& plugin) {
  scenario::KindTable theirs;
  try {
    theirs = more.described();
  } catch (const Bug& bug) {
    return refusal(plugin, fmt::format("describes its kinds wrongly: {}", bug.what()));
  }
  for (const std::string& role : theirs.roles())
    for (const std::string& name : theirs.names(role)) {
      if (!is_name(name, hyphen_of(role)))
        return refusal(plugin, fmt::format("its {} has the name \"{}\"; lower case "
                                           "letters, digits and {} are allowed.",
                                           role, name, hyphen_of(role)));
      const bool is_task_word = role == "task" && table_.task_forms().find(name);
      if (!is_task_word && table_.find(role, name) == nullptr) continue;
      const std::string_view other = plugin_of(role, name);
      return refusal(
          plugin,
          fmt::format("its {} \"{}\" has the name of one {}.", role, name,
                      other.empty() ? "of Skein's own" : fmt::format("of {}", other)),
          "Give it another name.");
    }
  for_each_role([&](auto role) { (kinds_.*role).append(more.*role); });
  describe(more, table_);
  table_.set_task_forms(kinds_.task.forms());
  for (const std::string& role : theirs.roles())
    for (const std::string& name : theirs.names(role))
      plugin_of_.emplace(fmt::format("{} {}", role, name), plugin);
  plugins_.insert(plugin);
  return {};
}

bool KindRegistry::has_plugin(std::string_view plugin) const {
  return plugins_.find(plugin) != plugins_.end();
}

std::string_view KindRegistry::plugin_of(std::string_view role,
                                         std::string_view kind) const {
  const auto found = plugin_of_.find(fmt::format("{} {}", role, kind));
  return found == plugin_of_.end() ? std::string_view() : found->second;
}

}  // namespace skein::assemble
