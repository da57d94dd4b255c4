// SPDX-License-Identifier: Apache-2.0
#include "skein/campaign/network/network_study.h"

#include <fmt/format.h>

#include <algorithm>

namespace skein::campaign {
namespace {

constexpr std::uint32_t kMaxNodes = 2500;

const char* name_of(NetworkExperiment experiment) {
  switch (experiment) {
    case NetworkExperiment::kGrid:
      return "grid";
    case NetworkExperiment::kCell:
      return "cell";
    case NetworkExperiment::kHidden:
      return "hidden";
  }
  return "";
}

template <class Value>
const Value* twice(const std::vector<Value>& values) {
  for (auto each = values.begin(); each != values.end(); ++each)
    if (std::find(values.begin(), each, *each) != each) return &*each;
  return nullptr;
}

Result<void> check_study(const NetworkStudy& study) {
  const auto bad = [](std::string place, std::string message, std::string hint = "") {
    return Error{ErrorCode::kBadInput, std::move(place), std::move(message),
                 std::move(hint)};
  };
  for (const std::uint32_t nodes : study.nodes)
    if (nodes < 2 || nodes > kMaxNodes)
      return bad("--nodes",
                 fmt::format("{} is no number of nodes from 2 to {}.", nodes, kMaxNodes));
  if (const auto* nodes = twice(study.nodes))
    return bad("--nodes", fmt::format("{} is named twice.", *nodes));
  if (const auto* profile = twice(study.profiles))
    return bad("--profiles", fmt::format("\"{}\" is named twice.", *profile));
  if (const double warm_up = warm_up_of(study.experiment); study.duration <= warm_up)
    return bad("--duration",
               fmt::format("{} s: the experiment {} lasts longer than {} s.",
                           study.duration, name_of(study.experiment), warm_up),
               warm_up > 0 ? "What happens before that does not count." : "");
  return {};
}

}  // namespace

NetworkStudy default_network_study(NetworkExperiment experiment) {
  NetworkStudy study;
  study.experiment = experiment;
  switch (experiment) {
    case NetworkExperiment::kGrid:
      study.nodes = {2, 4, 9, 16, 25, 36, 49, 64, 81, 100};
      study.profiles = {"nn4", "nn8", "cs91"};
      study.seeds = 3;
      study.duration = 300;
      break;
    case NetworkExperiment::kCell:
      study.nodes = {2, 5, 10, 20, 50};
      study.profiles = {"cell"};
      study.seeds = 5;
      study.duration = 61;
      break;
    case NetworkExperiment::kHidden:
      study.nodes = {3};
      study.profiles = {"nn4", "nn8", "cs91"};
      study.seeds = 5;
      study.duration = 61;
      break;
  }
  return study;
}

double warm_up_of(NetworkExperiment experiment) {
  return experiment == NetworkExperiment::kGrid ? 0 : 1;
}

Result<NetworkStudyPlan> plan_network_study(const NetworkStudy& study) {
  if (auto good = check_study(study); !good) return good.error();
  NetworkStudyPlan planned;
  StudyPlan& plan = planned.plan;
  plan.dimensions = {"profile", "access", "nodes"};
  for (const std::string& profile : study.profiles)
    for (const bool rts : {false, true})
      for (const std::uint32_t nodes : study.nodes) {
        StudyCell cell;
        cell.case_name = profile;
        cell.strategy = rts ? "rts" : "basic";
        cell.estimator = std::to_string(nodes);
        for (int k = 0; k < study.seeds; ++k) {
          cell.items.push_back(plan.items.size());
          BatchItem item;
          item.scenario.seed = static_cast<std::uint64_t>(study.first_seed + k);
          item.name = fmt::format("{}/{}/{}", name_of(study.experiment), cell.path(),
                                  item.scenario.seed);
          planned.cases.push_back({nodes, profile, rts, item.scenario.seed});
          plan.items.push_back(std::move(item));
        }
        plan.cells.push_back(std::move(cell));
      }
  return planned;
}

}  // namespace skein::campaign
