// SPDX-License-Identifier: Apache-2.0
// One aircraft's agent in a program of its own.
#include <fmt/format.h>

#include "app/common/commands.h"
#include "app/common/common.h"
#include "app/common/output.h"
#include "app/common/run_order.h"
#include "skein/assemble/world/aircraft_builder.h"

namespace skein::app {
namespace {

constexpr double kEndlessRun = 86400;  // [s]

// The group that an aircraft is of; none: the scenario does not have it.
std::optional<std::size_t> group_of(const scenario::Scenario& scenario,
                                    const std::string& aircraft) {
  const auto names = assemble::aircraft_names(scenario);
  for (std::size_t g = 0; g < names.size(); ++g)
    for (const std::string& name : names[g])
      if (name == aircraft) return g;
  return std::nullopt;
}

// What the aircraft's vehicle is in this program, as an override; empty: as it is there.
std::string own_vehicle(const AgentArguments& arguments,
                        const scenario::Scenario& scenario, std::size_t group) {
  if (!arguments.autopilot.empty())
    return fmt::format(
        "aircraft[{}].vehicle={{kind: mavlink, endpoint: '{}', system: {}, "
        "system_step: 0}}",
        group, arguments.autopilot, arguments.system);
  if (scenario.aircraft[group].vehicle.kind == "remote")
    return fmt::format("aircraft[{}].vehicle=simulated", group);
  return {};
}

Result<assemble::AgentOrder> agent_order(const AgentArguments& arguments) {
  assemble::AgentOrder order;
  order.entity = arguments.entity;
  if (!arguments.world.empty()) {
    auto world = transport::parse_endpoint(arguments.world);
    if (!world) return world.error();
    order.world = std::move(world).value();
  }
  for (const std::string& text : arguments.team) {
    auto team = transport::parse_endpoint(text);
    if (!team) return team.error();
    order.team.push_back(std::move(team).value());
  }
  if (!arguments.modem.empty()) {
    auto modem = transport::parse_endpoint(arguments.modem);
    if (!modem) return modem.error();
    order.modem = {std::move(modem).value(), arguments.hw, arguments.modem_rate,
                   arguments.key_file};
  }
  return order;
}

std::optional<RunOrder> read_order(const AgentArguments& arguments) {
  std::vector<std::string> overrides = arguments.overrides;
  overrides.push_back(fmt::format(
      "duration_s={}", arguments.duration > 0 ? arguments.duration : kEndlessRun));
  for (bool changed = false;; changed = true) {
    auto kinds = load_kinds(arguments.plugins, arguments.trusted);
    if (!kinds) return std::nullopt;
    auto scenario =
        load_scenario(arguments.scenario, overrides, arguments.plugins, *kinds);
    if (!scenario) return std::nullopt;
    const auto group = group_of(*scenario, arguments.entity);
    const std::string vehicle =
        group && !changed ? own_vehicle(arguments, *scenario, *group) : std::string();
    // Without the aircraft it goes on, to say which there are.
    if (vehicle.empty())
      return RunOrder{*std::move(kinds), *std::move(scenario), std::nullopt, {}};
    overrides.push_back(vehicle);
  }
}

}  // namespace

int agent_command(const AgentArguments& arguments, const std::atomic<bool>& stop) {
  auto whom = agent_order(arguments);
  if (!whom) return say_error(whom.error());
  auto order = read_order(arguments);
  if (!order) return kBadUsage;
  order->agent = std::move(whom).value();
  if (!arguments.out.empty()) {
    RunArguments run;
    run.out = arguments.out;
    run.overwrite = arguments.overwrite;
    return run_order(*order, run, stop);
  }
  return run_unrecorded(*order, stop);
}

}  // namespace skein::app
