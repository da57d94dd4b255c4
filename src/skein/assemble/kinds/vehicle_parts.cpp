// SPDX-License-Identifier: Apache-2.0
// What vehicles that are here, or whose body is, have in common.
#include <memory>
#include <utility>
#include <vector>

#include "skein/assemble/kinds/kind_registry.h"
#include "skein/assemble/kinds/vehicle_context.h"
#include "skein/layer/environment/turbulence/discrete_gusts.h"
#include "skein/layer/environment/turbulence/gusts.h"

namespace skein::assemble {
namespace {

// What a scenario has of turbulence and single gusts.
Result<std::unique_ptr<Turbulence>> gusty_air(const VehicleContext& c) {
  auto turbulence =
      c.kinds.turbulence.make(c.scenario.environment.turbulence, c.aircraft);
  if (!turbulence || c.scenario.environment.gusts.empty()) return turbulence;
  environment::DiscreteGustsOptions single;
  for (const scenario::GustEvent& gust : c.scenario.environment.gusts)
    single.gusts.push_back(
        {gust.at.seconds(),
         {gust.velocity.x(), gust.velocity.y(), -gust.up},
         gust.in_body ? environment::GustFrame::kBody : environment::GustFrame::kLocal,
         gust.length,
         gust.hold});
  std::vector<std::unique_ptr<Turbulence>> parts;
  if (turbulence.value()) parts.push_back(std::move(turbulence).value());
  parts.push_back(std::make_unique<environment::DiscreteGusts>(single));
  return std::unique_ptr<Turbulence>(
      std::make_unique<environment::Gusts>(std::move(parts)));
}

}  // namespace

Result<void> add_autopilot(const VehicleContext& c) {
  auto autopilot = c.kinds.autopilot.make(c.group.autopilot, c.aircraft);
  if (!autopilot) return autopilot.error();
  c.parts.autopilot = std::move(autopilot).value();
  return {};
}

Result<void> add_body(const VehicleContext& c) {
  auto turbulence = gusty_air(c);
  if (!turbulence) return turbulence.error();
  c.parts.turbulence = std::move(turbulence).value();
  auto faults = vehicle_faults(c.group, c.index, c.mounted, c.scenario.duration,
                               c.aircraft.seed, c.aircraft.self);
  if (!faults) return faults.error();
  c.parts.faults = std::move(faults).value();
  c.parts.breakable = breakable_parts(c.mounted);
  return {};
}

}  // namespace skein::assemble
