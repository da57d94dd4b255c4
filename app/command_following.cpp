// The study `wind-following`: plans for the wind against plans without it.
#include "app/common.h"
#include "app/study_parts.h"
#include "skein/assemble/kinds_of.h"
#include "skein/campaign/following_study.h"

namespace skein::app {
namespace {

// The first seed of each cell again, for its picture.
std::vector<campaign::FollowingFlight> shown_flights(
    const campaign::StudyPlan& plan, const std::vector<campaign::BatchOutcome>& outcomes,
    const std::atomic<bool>& stop) {
  std::vector<campaign::FollowingFlight> shown;
  for (std::size_t k = 0; k < plan.cells.size(); ++k) {
    const std::size_t item = plan.cells[k].items.front();
    campaign::LapRecorder recorder;
    if (outcomes[item].summary && run_item(plan.items[item], stop, &recorder).ok())
      shown.push_back({k, recorder.samples()});
  }
  return shown;
}

}  // namespace

int following_study(const StudyArguments& arguments, const std::filesystem::path& folder,
                    const std::atomic<bool>& stop) {
  campaign::FollowingStudy study;
  study.base = shipped_scenario("wind-following.yaml");
  study.winds = arguments.cases;
  study.overrides = arguments.overrides;
  study.first_seed = arguments.first_seed;
  study.seeds = arguments.seeds;
  const auto plan = campaign::plan_following_study(study, assemble::kind_table());
  if (!plan) return say_error(plan.error());
  const auto outcomes = run_plan(
      plan.value(), arguments, folder, stop, [&stop](const campaign::BatchItem& item) {
        campaign::LapRecorder recorder;
        auto summary = run_item(item, stop, &recorder);
        if (summary)
          campaign::add_following_figures(recorder.samples(), summary.value().numbers);
        return summary;
      });
  if (!outcomes) return say_error(outcomes.error());
  const auto shown = shown_flights(plan.value(), outcomes.value(), stop);
  return finish("wind-following", plan.value(), outcomes.value(),
                campaign::following_report(study, plan.value(), outcomes.value(), shown),
                folder, stop, campaign::following_ratios(plan.value(), outcomes.value()));
}

}  // namespace skein::app
