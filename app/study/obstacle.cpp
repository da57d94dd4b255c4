// SPDX-License-Identifier: Apache-2.0
// skein study network obstacle: who hears whom around a house, for all mixes of real and
// simulated entities.
#include <fmt/format.h>

#include <algorithm>

#include "app/common/common.h"
#include "app/common/output.h"
#include "app/common/version.h"
#include "app/study/mixed_delivery.h"
#include "app/study/parts.h"

namespace skein::app {
namespace {

namespace fs = std::filesystem;

using RealOnes = std::array<bool, kDeliveryEntities>;

constexpr const char* kObstacleProfile = "nn8";
constexpr int kObstacleRepetitions = 3;
constexpr std::size_t kMixes = 1u << kDeliveryEntities;

RealOnes real_ones(std::size_t mix) {
  RealOnes real = {};
  for (std::size_t k = 0; k < kDeliveryEntities; ++k) real[k] = (mix >> k & 1) != 0;
  return real;
}

std::string share_name(std::size_t from, std::size_t to) {
  return fmt::format("{}_to_{}_percent", from + 1, to + 1);
}

// All pairs of different entities, in the order of columns.
std::vector<std::pair<std::size_t, std::size_t>> delivery_pairs() {
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t from = 0; from < kDeliveryEntities; ++from)
    for (std::size_t to = 0; to < kDeliveryEntities; ++to)
      if (from != to) pairs.emplace_back(from, to);
  return pairs;
}

campaign::StudyPlan obstacle_plan(const StudyArguments& arguments,
                                  const std::string& profile,
                                  std::vector<RealOnes>& cases) {
  campaign::StudyPlan plan;
  plan.dimensions = {"profile", "entities"};
  for (std::size_t mix = 0; mix < kMixes; ++mix) {
    campaign::StudyCell cell;
    cell.case_name = profile;
    cell.strategy = name_of(real_ones(mix));
    for (int k = 0; k < arguments.seeds.value_or(kObstacleRepetitions); ++k) {
      cell.items.push_back(plan.items.size());
      campaign::BatchItem item;
      item.scenario.seed = static_cast<std::uint64_t>(arguments.first_seed + k);
      item.name = fmt::format("obstacle/{}/{}", cell.path(), item.scenario.seed);
      item.data = fmt::format("# {}", item.name);
      plan.items.push_back(std::move(item));
      cases.push_back(real_ones(mix));
    }
    plan.cells.push_back(std::move(cell));
  }
  return plan;
}

Result<record::RunSummary> summary_of_delivery(const MixedDeliveryCase& given,
                                               const std::atomic<bool>& stop) {
  const auto measured = measure_mixed_delivery(given, stop);
  if (!measured) return measured.error();
  record::RunSummary summary;
  summary.version = kVersion;
  summary.seed = given.seed;
  for (const auto& [from, to] : delivery_pairs())
    summary.numbers[share_name(from, to)] = 100 * measured.value()[from][to];
  return summary;
}

// Least and most over all mixes and repetitions.
struct Range {
  double least = 0, most = 0;
  bool any = false;
};

Range range_of(const std::vector<campaign::BatchOutcome>& outcomes,
               const std::vector<std::size_t>& items, const std::string& name) {
  Range range;
  for (const std::size_t item : items) {
    if (!outcomes[item].summary) continue;
    const double value = outcomes[item].summary->numbers.at(name);
    range.least = range.any ? std::min(range.least, value) : value;
    range.most = range.any ? std::max(range.most, value) : value;
    range.any = true;
  }
  return range;
}

std::string text_of(const Range& range) {
  if (!range.any) return "-";
  if (range.most - range.least < 0.5) return fmt::format("{:.0f}", range.least);
  return fmt::format("{:.0f} to {:.0f}", range.least, range.most);
}

// By how much a pair's shares differ at most between mixes and repetitions.
double most_apart(const campaign::StudyPlan& plan,
                  const std::vector<campaign::BatchOutcome>& outcomes) {
  std::vector<std::size_t> all;
  for (std::size_t item = 0; item < plan.items.size(); ++item) all.push_back(item);
  double most = 0;
  for (const auto& [from, to] : delivery_pairs()) {
    const Range range = range_of(outcomes, all, share_name(from, to));
    most = std::max(most, range.most - range.least);
  }
  return most;
}

record::StudyReport obstacle_report(const campaign::StudyPlan& plan,
                                    const std::vector<campaign::BatchOutcome>& outcomes,
                                    bool interrupted) {
  record::StudyReport report;
  report.title = "Real and simulated entities around a house";
  if (interrupted) report.alert = "Interrupted: not all measurements were made.";
  report.intro.push_back(
      "Three entities in reach of each other, a house between 1 and 2 that no signal "
      "passes. Each says things to all. Real ones are behind sockets of their own, at a "
      "stand-in of the air; the others are simulated in a ground station with one modem. "
      "[Selecky18] 6.4.2.");
  report.intro.push_back(
      fmt::format("Between mixes and repetitions no pair differs by more than {:.1f} "
                  "percentage points.",
                  most_apart(plan, outcomes)));
  record::StudyTable table;
  table.title = "Received of what was said [%]";
  table.columns = {"entities 1, 2, 3"};
  for (const auto& [from, to] : delivery_pairs())
    table.columns.push_back(fmt::format("{} to {}", from + 1, to + 1));
  for (const campaign::StudyCell& cell : plan.cells) {
    std::vector<record::TableCell> row = {{cell.strategy}};
    for (const auto& [from, to] : delivery_pairs())
      row.push_back({text_of(range_of(outcomes, cell.items, share_name(from, to)))});
    table.rows.push_back(std::move(row));
  }
  report.tables.push_back(std::move(table));
  return report;
}

}  // namespace

int obstacle_study(const StudyArguments& arguments, assemble::KindRegistry& kinds,
                   const fs::path& folder, const std::atomic<bool>& stop) {
  if (arguments.profiles.size() > 1 || !arguments.nodes.empty() || arguments.duration) {
    complain(
        "error: the experiment obstacle has three entities, one profile and a fixed "
        "number of messages.\n");
    return kBadUsage;
  }
  const std::string profile =
      arguments.profiles.empty() ? kObstacleProfile : arguments.profiles.front();
  const auto radio = assemble::load_radio(profile, fs::current_path(), kinds.kinds());
  if (!radio) return say_error(radio.error());
  std::vector<RealOnes> cases;
  const campaign::StudyPlan plan = obstacle_plan(arguments, profile, cases);
  const auto outcomes = run_plan(
      plan, arguments.threads, kinds, folder, stop, [&](const campaign::BatchItem& item) {
        MixedDeliveryCase given;
        given.real = cases[static_cast<std::size_t>(&item - plan.items.data())];
        given.radio = radio.value();
        given.seed = item.scenario.seed;
        return summary_of_delivery(given, stop);
      });
  if (!outcomes) return say_error(outcomes.error());
  return finish("network obstacle", plan, outcomes.value(),
                obstacle_report(plan, outcomes.value(), stop), folder, stop,
                {{"most_apart_percent", most_apart(plan, outcomes.value())}});
}

}  // namespace skein::app
