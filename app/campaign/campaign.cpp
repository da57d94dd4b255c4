// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include "app/common/commands.h"
#include "app/common/common.h"
#include "app/common/output.h"
#include "app/common/trust.h"
#include "app/study/parts.h"
#include "skein/base/log.h"
#include "skein/base/output_file.h"
#include "skein/campaign/campaign/campaign.h"
#include "skein/campaign/campaign/campaign_file.h"

namespace skein::app {
namespace {

namespace fs = std::filesystem;

// Each with all keys, as FOLDER/scenarios/NUMBER-VARIANT-VARIANT-SEED.yaml, numbered as
// the rows of runs.csv.
Result<void> write_scenarios(const campaign::StudyPlan& plan, const fs::path& folder,
                             const std::atomic<bool>& stop) {
  if (auto made = make_folder(folder); !made) return made.error();
  std::error_code error;  // is said when the first is written
  fs::create_directory(folder / "scenarios", error);
  for (std::size_t k = 0; k < plan.items.size(); ++k) {
    if (stop)
      return Error{ErrorCode::kInterrupted, "",
                   fmt::format("Stopped after {} of {} scenarios were written.", k,
                               plan.items.size()),
                   ""};
    const campaign::BatchItem& item = plan.items[k];
    const std::string name = fmt::format("{:04}-{}.yaml", k + 1, folder_name(item.name));
    if (auto written = write_file(folder / "scenarios" / name, item.text); !written)
      return written.error();
  }
  return {};
}

}  // namespace

int campaign_command(const CampaignArguments& arguments, const std::atomic<bool>& stop) {
  auto read = campaign::read_campaign(arguments.file);
  if (!read) return say_error(read.error());
  campaign::CampaignFile file = std::move(read).value();
  if (arguments.seeds) file.seeds = *arguments.seeds;
  if (arguments.first_seed) file.first_seed = *arguments.first_seed;
  auto kinds = load_kinds(arguments.plugins, arguments.trusted);
  if (!kinds) return kBadUsage;
  // What the campaign changes in the scenario may be a program.
  std::static_pointer_cast<Trust>(kinds->consent())->add_author(file.source);
  const auto plan = campaign::plan_campaign(file, {arguments.only, arguments.overrides},
                                            reader_of(*kinds, arguments.plugins, stop));
  if (!plan) return say_error(plan.error());
  const fs::path folder = arguments.out.empty()
                              ? fs::path("runs") / ("campaign-" + file.name)
                              : arguments.out;
  if (arguments.scenarios)
    if (auto written = write_scenarios(plan.value(), folder, stop); !written)
      return say_error(written.error());
  const auto outcomes = run_plan(plan.value(), arguments.threads, *kinds, folder, stop);
  if (!outcomes) return say_error(outcomes.error());
  for (const std::string& text :
       campaign::figures_that_nobody_has(file, outcomes.value()))
    log_warning("{}", text);
  return finish(file.name, plan.value(), outcomes.value(),
                campaign::campaign_report(file, plan.value(), outcomes.value()), folder,
                stop);
}

}  // namespace skein::app
