// SPDX-License-Identifier: Apache-2.0
#include "app/plan/options.h"

#include <CLI/CLI.hpp>

#include "app/plan/arguments.h"
#include "app/plan/commands.h"

namespace skein::app {

struct PlanOptions::Parts {
  PlanConnectArguments connect;
  PlanPathArguments path;
  PlanCoverageArguments coverage;
  PlanPatrolArguments patrol;
  PlanOrbitArguments orbit;
  PlanRendezvousArguments rendezvous;
  PlanFleetArguments fleet;
  CLI::App* plan = nullptr;
  CLI::App* path_command = nullptr;
  CLI::App* coverage_command = nullptr;
  CLI::App* patrol_command = nullptr;
  CLI::App* orbit_command = nullptr;
  CLI::App* rendezvous_command = nullptr;
  CLI::App* fleet_command = nullptr;
};

PlanOptions::PlanOptions(CLI::App& program) : parts_(std::make_unique<Parts>()) {
  Parts& p = *parts_;
  p.plan = program.add_subcommand("plan", "Plan flights in wind, and write them.");
  p.plan->require_subcommand(1);
  add_connect(*p.plan, p.connect);
  p.path_command = add_path(*p.plan, p.path);
  p.coverage_command = add_coverage(*p.plan, p.coverage);
  p.patrol_command = add_patrol(*p.plan, p.patrol);
  p.orbit_command = add_orbit(*p.plan, p.orbit);
  p.rendezvous_command = add_rendezvous(*p.plan, p.rendezvous);
  p.fleet_command = add_fleet(*p.plan, p.fleet);
  p.plan->footer("\nExamples:\n  skein plan connect --help\n  skein plan path --help");
}

PlanOptions::~PlanOptions() = default;

bool PlanOptions::chosen() const {
  return parts_->plan->parsed();
}

int PlanOptions::run(const std::atomic<bool>& stop) const {
  const Parts& p = *parts_;
  if (*p.path_command) return plan_path_command(p.path, stop);
  if (*p.coverage_command) return plan_coverage_command(p.coverage, stop);
  if (*p.patrol_command) return plan_patrol_command(p.patrol);
  if (*p.orbit_command) return plan_orbit_command(p.orbit);
  if (*p.rendezvous_command) return plan_rendezvous_command(p.rendezvous);
  if (*p.fleet_command) return plan_fleet_command(p.fleet, stop);
  if (!parts_->connect.batch.empty()) return plan_batch_command(parts_->connect, stop);
  return plan_connect_command(parts_->connect);
}

}  // namespace skein::app
