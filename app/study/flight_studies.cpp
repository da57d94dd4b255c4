// SPDX-License-Identifier: Apache-2.0
// Studies of single aircraft that are held against the truth as they fly.

#include "app/common/common.h"
#include "app/study/parts.h"
#include "skein/campaign/ground_starts/ground_starts_study.h"
#include "skein/campaign/keeping/keeping_study.h"
#include "skein/campaign/robustness/robustness_study.h"

namespace skein::app {

int robustness_study(const StudyArguments& arguments, assemble::KindRegistry& kinds,
                     const std::filesystem::path& folder, const std::atomic<bool>& stop) {
  campaign::RobustnessStudy study;
  take_arguments(arguments, "robustness.yaml", study);
  study.aircraft = arguments.cases;
  const auto plan =
      campaign::plan_robustness_study(study, reader_of(kinds, arguments.plugins, stop));
  if (!plan) return say_error(plan.error());
  const auto outcomes = run_plan(plan.value(), arguments.threads, kinds, folder, stop,
                                 [&](const campaign::BatchItem& item) {
                                   campaign::FlightWatch watch = campaign::watch_of(item);
                                   auto summary = run_item(item, kinds, stop, &watch);
                                   if (summary)
                                     watch.add_figures(summary.value().numbers);
                                   return summary;
                                 });
  if (!outcomes) return say_error(outcomes.error());
  return finish("robustness", plan.value(), outcomes.value(),
                campaign::robustness_report(plan.value(), outcomes.value()), folder,
                stop);
}

int ground_starts_study(const StudyArguments& arguments, assemble::KindRegistry& kinds,
                        const std::filesystem::path& folder,
                        const std::atomic<bool>& stop) {
  campaign::GroundStartsStudy study;
  take_arguments(arguments, "ground-starts.yaml", study);
  study.aircraft = arguments.cases;
  const auto plan = campaign::plan_ground_starts_study(
      study, reader_of(kinds, arguments.plugins, stop));
  if (!plan) return say_error(plan.error());
  const auto outcomes = run_plan(plan.value(), arguments.threads, kinds, folder, stop,
                                 [&](const campaign::BatchItem& item) {
                                   campaign::StartWatch watch =
                                       campaign::start_watch_of(item);
                                   auto summary = run_item(item, kinds, stop, &watch);
                                   if (summary)
                                     watch.add_figures(summary.value().numbers);
                                   return summary;
                                 });
  if (!outcomes) return say_error(outcomes.error());
  return finish("ground-starts", plan.value(), outcomes.value(),
                campaign::ground_starts_report(plan.value(), outcomes.value()), folder,
                stop);
}

int keeping_study(const StudyArguments& arguments, assemble::KindRegistry& kinds,
                  const std::filesystem::path& folder, const std::atomic<bool>& stop) {
  campaign::KeepingStudy study;
  take_arguments(arguments, "keeping.yaml", study);
  study.aircraft = arguments.cases;
  const auto plan =
      campaign::plan_keeping_study(study, reader_of(kinds, arguments.plugins, stop));
  if (!plan) return say_error(plan.error());
  const auto outcomes = run_plan(plan.value(), arguments.threads, kinds, folder, stop,
                                 [&](const campaign::BatchItem& item) {
                                   campaign::KeepingWatch watch =
                                       campaign::keeping_watch_of(item);
                                   auto summary = run_item(item, kinds, stop, &watch);
                                   if (summary)
                                     watch.add_figures(summary.value().numbers);
                                   return summary;
                                 });
  if (!outcomes) return say_error(outcomes.error());
  return finish("keeping", plan.value(), outcomes.value(),
                campaign::keeping_report(plan.value(), outcomes.value()), folder, stop,
                campaign::keeping_figures(plan.value(), outcomes.value()));
}

}  // namespace skein::app
