// SPDX-License-Identifier: Apache-2.0
// The study `wind-following`: plans for the wind against plans without it.
#include "app/common/common.h"
#include "app/study/parts.h"
#include "skein/campaign/following/following_study.h"

namespace skein::app {
namespace {

// The first seed of each cell again, for its picture.
std::vector<campaign::FollowingFlight> shown_flights(
    const campaign::StudyPlan& plan, const std::vector<campaign::BatchOutcome>& outcomes,
    const assemble::KindRegistry& kinds, const std::atomic<bool>& stop) {
  std::vector<campaign::FollowingFlight> shown;
  for (std::size_t k = 0; k < plan.cells.size(); ++k) {
    const std::size_t item = plan.cells[k].items.front();
    campaign::LapRecorder recorder;
    if (outcomes[item].summary && run_item(plan.items[item], kinds, stop, &recorder).ok())
      shown.push_back({k, recorder.samples()});
  }
  return shown;
}

}  // namespace

int following_study(const StudyArguments& arguments, assemble::KindRegistry& kinds,
                    const std::filesystem::path& folder, const std::atomic<bool>& stop) {
  campaign::FollowingStudy study;
  take_arguments(arguments, "wind-following.yaml", study);
  study.winds = arguments.cases;
  const auto plan =
      campaign::plan_following_study(study, reader_of(kinds, arguments.plugins, stop));
  if (!plan) return say_error(plan.error());
  const auto outcomes = run_plan(plan.value(), arguments.threads, kinds, folder, stop,
                                 [&](const campaign::BatchItem& item) {
                                   campaign::LapRecorder recorder;
                                   auto summary = run_item(item, kinds, stop, &recorder);
                                   if (summary)
                                     campaign::add_following_figures(
                                         recorder.samples(), summary.value().numbers);
                                   return summary;
                                 });
  if (!outcomes) return say_error(outcomes.error());
  const auto shown = shown_flights(plan.value(), outcomes.value(), kinds, stop);
  return finish("wind-following", plan.value(), outcomes.value(),
                campaign::following_report(study, plan.value(), outcomes.value(), shown),
                folder, stop, campaign::following_ratios(plan.value(), outcomes.value()));
}

}  // namespace skein::app
