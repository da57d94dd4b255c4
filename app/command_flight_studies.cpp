// Studies of single aircraft that are held against the truth as they fly.

#include <algorithm>

#include "app/common.h"
#include "app/study_parts.h"
#include "skein/campaign/ground_starts_study.h"
#include "skein/campaign/keeping_study.h"

namespace skein::app {
namespace {

bool given(const StudyArguments& arguments, const char* option) {
  return std::count(arguments.given.begin(), arguments.given.end(), option) > 0;
}

// Aircraft, overrides and seeds as the command line has them; a study's own number of
// seeds where it names none.
template <class Study>
void take_arguments(const StudyArguments& arguments, const char* scenario, Study& study) {
  study.base = shipped_scenario(scenario);
  study.aircraft = arguments.cases;
  study.overrides = arguments.overrides;
  study.first_seed = arguments.first_seed;
  if (given(arguments, "--seeds")) study.seeds = arguments.seeds;
}

}  // namespace

int ground_starts_study(const StudyArguments& arguments,
                        const assemble::KindRegistry& kinds,
                        const std::filesystem::path& folder,
                        const std::atomic<bool>& stop) {
  campaign::GroundStartsStudy study;
  take_arguments(arguments, "ground-starts.yaml", study);
  const auto plan = campaign::plan_ground_starts_study(study, kinds.table());
  if (!plan) return say_error(plan.error());
  const auto outcomes = run_plan(
      plan.value(), arguments, kinds, folder, stop, [&](const campaign::BatchItem& item) {
        campaign::StartWatch watch = campaign::start_watch_of(item);
        auto summary = run_item(item, kinds, stop, &watch);
        if (summary) watch.add_figures(summary.value().numbers);
        return summary;
      });
  if (!outcomes) return say_error(outcomes.error());
  return finish("ground-starts", plan.value(), outcomes.value(),
                campaign::ground_starts_report(plan.value(), outcomes.value()), folder,
                stop);
}

int keeping_study(const StudyArguments& arguments, const assemble::KindRegistry& kinds,
                  const std::filesystem::path& folder, const std::atomic<bool>& stop) {
  campaign::KeepingStudy study;
  take_arguments(arguments, "keeping.yaml", study);
  const auto plan = campaign::plan_keeping_study(study, kinds.table());
  if (!plan) return say_error(plan.error());
  const auto outcomes = run_plan(
      plan.value(), arguments, kinds, folder, stop, [&](const campaign::BatchItem& item) {
        campaign::KeepingWatch watch = campaign::keeping_watch_of(item);
        auto summary = run_item(item, kinds, stop, &watch);
        if (summary) watch.add_figures(summary.value().numbers);
        return summary;
      });
  if (!outcomes) return say_error(outcomes.error());
  return finish("keeping", plan.value(), outcomes.value(),
                campaign::keeping_report(plan.value(), outcomes.value()), folder, stop,
                campaign::keeping_figures(plan.value(), outcomes.value()));
}

}  // namespace skein::app
