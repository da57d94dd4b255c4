#include "skein/assemble/kind_registry.h"

#include <fmt/format.h>

#include <algorithm>

namespace skein::assemble {
namespace {

// The tables of each role, side by side in two sets of them.
template <class Visit>
void for_each_role(KindsByRole& a, const KindsByRole& b, Visit visit) {
  visit(a.terrain, b.terrain);
  visit(a.wind, b.wind);
  visit(a.turbulence, b.turbulence);
  visit(a.fire, b.fire);
  visit(a.plant, b.plant);
  visit(a.autopilot, b.autopilot);
  visit(a.sensor, b.sensor);
  visit(a.agent, b.agent);
  visit(a.station_agent, b.station_agent);
  visit(a.radio, b.radio);
  visit(a.estimator, b.estimator);
  visit(a.strategy, b.strategy);
  visit(a.planner, b.planner);
}

KindsByRole own_kinds() {
  KindsByRole kinds;
  kinds.terrain = terrain_kinds();
  kinds.wind = wind_kinds();
  kinds.turbulence = turbulence_kinds();
  kinds.fire = fire_kinds();
  kinds.plant = plant_kinds();
  kinds.autopilot = autopilot_kinds();
  kinds.sensor = sensor_kinds();
  kinds.agent = agent_kinds();
  kinds.station_agent = station_agent_kinds();
  kinds.radio = radio_kinds();
  kinds.estimator = estimator_kinds();
  kinds.strategy = strategy_kinds();
  kinds.planner = planner_kinds();
  return kinds;
}

void describe(const KindsByRole& kinds, scenario::KindTable& table) {
  KindsByRole none;
  for_each_role(none, kinds,
                [&table](const auto&, const auto& rows) { rows.describe(table); });
}

bool is_name(const std::string& name) {
  return !name.empty() && std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-';
  });
}

Error refusal(const std::string& plugin, std::string message, std::string hint = {}) {
  return {ErrorCode::kBadInput, plugin, std::move(message), std::move(hint)};
}

}  // namespace

scenario::KindTable KindsByRole::described() const {
  scenario::KindTable table;
  describe(*this, table);
  return table;
}

KindRegistry::KindRegistry() : kinds_(own_kinds()), table_(kinds_.described()) {}

Result<void> KindRegistry::add(const KindsByRole& more, const std::string& plugin) {
  scenario::KindTable theirs;
  try {
    theirs = more.described();
  } catch (const Bug& bug) {
    return refusal(plugin, fmt::format("describes its kinds wrongly: {}", bug.what()));
  }
  for (const std::string& role : theirs.roles())
    for (const std::string& name : theirs.names(role)) {
      if (!is_name(name))
        return refusal(plugin, fmt::format("its {} has the name \"{}\"; lower case "
                                           "letters, digits and - are allowed.",
                                           role, name));
      if (table_.find(role, name) == nullptr) continue;
      const std::string_view other = plugin_of(role, name);
      return refusal(
          plugin,
          fmt::format("its {} \"{}\" has the name of one {}.", role, name,
                      other.empty() ? "of Skein's own" : fmt::format("of {}", other)),
          "Give it another name.");
    }
  for_each_role(kinds_, more,
                [](auto& rows, const auto& others) { rows.append(others); });
  describe(more, table_);
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
