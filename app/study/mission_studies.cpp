// SPDX-License-Identifier: Apache-2.0
// Studies of perimeter missions.

#include "app/common/common.h"
#include "app/study/parts.h"
#include "skein/assemble/world/recorded_scenario.h"
#include "skein/campaign/bridge/bridge_study.h"
#include "skein/campaign/fidelity/fidelity_study.h"
#include "skein/campaign/monitoring/monitoring_report.h"
#include "skein/campaign/monitoring/monitoring_study.h"

namespace skein::app {

namespace fs = std::filesystem;

int monitoring_study(const StudyArguments& arguments, assemble::KindRegistry& kinds,
                     const fs::path& folder, const std::atomic<bool>& stop) {
  campaign::MonitoringStudy study;
  take_arguments(arguments, "thesis-no-wind.yaml", study);
  study.cases = arguments.cases;
  study.estimators = arguments.estimators;
  study.strategies = arguments.strategies;
  const auto plan =
      campaign::plan_monitoring_study(study, reader_of(kinds, arguments.plugins, stop));
  if (!plan) return say_error(plan.error());
  const auto outcomes = run_plan(plan.value(), arguments.threads, kinds, folder, stop);
  if (!outcomes) return say_error(outcomes.error());
  return finish("monitoring", plan.value(), outcomes.value(),
                campaign::monitoring_report(study, plan.value(), outcomes.value()),
                folder, stop);
}

int bridge_study(const StudyArguments& arguments, assemble::KindRegistry& kinds,
                 const fs::path& folder, const std::atomic<bool>& stop) {
  campaign::BridgeStudy study;
  take_arguments(arguments, "bridge-fire.yaml", study);
  study.estimators = arguments.estimators;
  study.strategies = arguments.strategies;
  if (!arguments.data.empty()) {
    const auto recorded = assemble::read_recorded_scenario(arguments.data, {});
    if (!recorded) return say_error(recorded.error());
    const auto fitted = assemble::recorded_overrides(recorded.value());
    // What the command line says comes after what was fitted.
    study.overrides.insert(study.overrides.begin(), fitted.begin(), fitted.end());
  }
  const auto plan =
      campaign::plan_bridge_study(study, reader_of(kinds, arguments.plugins, stop));
  if (!plan) return say_error(plan.error());
  const auto outcomes = run_plan(plan.value(), arguments.threads, kinds, folder, stop);
  if (!outcomes) return say_error(outcomes.error());
  return finish("bridge", plan.value(), outcomes.value(),
                campaign::bridge_report(study, plan.value(), outcomes.value()), folder,
                stop);
}

int fidelity_study(const StudyArguments& arguments, assemble::KindRegistry& kinds,
                   const fs::path& folder, const std::atomic<bool>& stop) {
  campaign::FidelityStudy study;
  take_arguments(arguments, "wildfire.yaml", study);
  study.levels = arguments.cases;
  const auto plan =
      campaign::plan_fidelity_study(study, reader_of(kinds, arguments.plugins, stop));
  if (!plan) return say_error(plan.error());
  const auto outcomes = run_plan(plan.value(), arguments.threads, kinds, folder, stop);
  if (!outcomes) return say_error(outcomes.error());
  return finish("fidelity", plan.value(), outcomes.value(),
                campaign::fidelity_report(study, plan.value(), outcomes.value()), folder,
                stop);
}

}  // namespace skein::app
