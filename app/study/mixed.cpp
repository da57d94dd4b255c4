// SPDX-License-Identifier: Apache-2.0
// skein study network mixed: data rates between real and simulated entities.
#include <fmt/format.h>

#include <cmath>

#include "app/common/common.h"
#include "app/common/output.h"
#include "app/common/version.h"
#include "app/study/mixed_rates.h"
#include "app/study/parts.h"

namespace skein::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* kMixedProfile = "n920";
constexpr double kMixedRate = 15'000;      // [bit/s]
constexpr double kMixedOverload = 60'000;  // more than three such modems carry
constexpr int kMixedRepetitions = 10;
constexpr double kMixedDuration = 30;  // [s]

struct ComparedRates {
  const char* name;
  MixedSetUp set_up;
  double rate;
};

constexpr ComparedRates kMixedCompared[] = {
    {"all-real", MixedSetUp::kAllReal, kMixedRate},
    {"mixed", MixedSetUp::kMixed, kMixedRate},
    {"all-real", MixedSetUp::kAllReal, kMixedOverload},
    {"mixed", MixedSetUp::kMixed, kMixedOverload},
    {"mixed-without-model", MixedSetUp::kWithoutModel, kMixedOverload},
};

std::string pair_name(std::size_t from, std::size_t to) {
  return fmt::format("{}_to_{}_byte_s", from + 1, to + 1);
}

campaign::StudyPlan mixed_plan(const StudyArguments& arguments,
                               const std::string& profile, double duration,
                               std::vector<ComparedRates>& cases) {
  campaign::StudyPlan plan;
  plan.dimensions = {"profile", "set-up", "rate_kbps"};
  for (const ComparedRates& each : kMixedCompared) {
    campaign::StudyCell cell;
    cell.case_name = profile;
    cell.strategy = each.name;
    cell.estimator = fmt::format("{}", each.rate / 1e3);
    for (int k = 0; k < arguments.seeds.value_or(kMixedRepetitions); ++k) {
      cell.items.push_back(plan.items.size());
      campaign::BatchItem item;
      item.scenario.seed = static_cast<std::uint64_t>(arguments.first_seed + k);
      item.name = fmt::format("mixed/{}/{}", cell.path(), item.scenario.seed);
      item.data = fmt::format("# {}, {} s", item.name, duration);
      plan.items.push_back(std::move(item));
      cases.push_back(each);
    }
    plan.cells.push_back(std::move(cell));
  }
  return plan;
}

Result<record::RunSummary> summary_of_rates(const MixedRatesCase& given,
                                            const std::atomic<bool>& stop) {
  const auto measured = measure_mixed_rates(given, stop);
  if (!measured) return measured.error();
  record::RunSummary summary;
  summary.version = kVersion;
  summary.seed = given.seed;
  for (std::size_t from = 0; from < kMixedEntities; ++from)
    for (std::size_t to = 0; to < kMixedEntities; ++to)
      if (from != to)
        summary.numbers[pair_name(from, to)] = measured.value().received[from][to];
  const modem::ModemStatistics& station = measured.value().station;
  summary.numbers["station_sent"] = static_cast<double>(station.sent);
  summary.numbers["station_heard"] = static_cast<double>(station.heard);
  summary.numbers["station_dropped"] =
      static_cast<double>(station.dropped.full + station.dropped.expired);
  summary.numbers["station_delay_mean_s"] = station.mean_delay();
  return summary;
}

// Mean and standard deviation over the repetitions.
std::string spread_of(const campaign::StudyCell& cell,
                      const std::vector<campaign::BatchOutcome>& outcomes,
                      const std::string& name) {
  double count = 0, sum = 0, squares = 0;
  for (const std::size_t item : cell.items) {
    if (!outcomes[item].summary) continue;
    const double value = outcomes[item].summary->numbers.at(name);
    ++count;
    sum += value;
    squares += value * value;
  }
  if (count == 0) return "-";
  const double mean = sum / count;
  const double variance =
      count > 1 ? std::max(0.0, (squares - count * mean * mean) / (count - 1)) : 0;
  return fmt::format("{:.0f} ± {:.0f}", mean, std::sqrt(variance));
}

record::StudyReport mixed_report(const campaign::StudyPlan& plan,
                                 const std::vector<campaign::BatchOutcome>& outcomes,
                                 double duration, bool interrupted) {
  record::StudyReport report;
  report.title = "Data rates between real and simulated entities";
  if (interrupted) report.alert = "Interrupted: not all measurements were made.";
  report.intro.push_back(fmt::format(
      "Three entities at equal distances say {} bytes to the others again and again, for "
      "{} s. All real: each behind a socket with its own modem, at a stand-in of the "
      "air. "
      "Mixed: the first one so, the others simulated in the ground station. Without the "
      "model what is simulated reaches all at once. [Selecky18] 6.4.1.",
      kMixedBytes, duration));
  record::StudyTable table;
  table.title =
      "Received of each by each [B/s], mean and standard deviation of the repetitions";
  table.columns = {"set-up", "kbit/s"};
  for (std::size_t from = 0; from < kMixedEntities; ++from)
    for (std::size_t to = 0; to < kMixedEntities; ++to)
      if (from != to) table.columns.push_back(fmt::format("{} to {}", from + 1, to + 1));
  for (const campaign::StudyCell& cell : plan.cells) {
    std::vector<record::TableCell> row = {{cell.strategy}, {cell.estimator}};
    for (std::size_t from = 0; from < kMixedEntities; ++from)
      for (std::size_t to = 0; to < kMixedEntities; ++to)
        if (from != to) row.push_back({spread_of(cell, outcomes, pair_name(from, to))});
    table.rows.push_back(std::move(row));
  }
  report.tables.push_back(std::move(table));
  return report;
}

}  // namespace

int mixed_rates_study(const StudyArguments& arguments, assemble::KindRegistry& kinds,
                      const fs::path& folder, const std::atomic<bool>& stop) {
  if (arguments.profiles.size() > 1 || !arguments.nodes.empty()) {
    complain("error: the experiment mixed has three entities and one profile.\n");
    return kBadUsage;
  }
  const std::string profile =
      arguments.profiles.empty() ? kMixedProfile : arguments.profiles.front();
  const auto radio = assemble::load_radio(profile, fs::current_path(), kinds.kinds());
  if (!radio) return say_error(radio.error());
  const double duration = arguments.duration.value_or(kMixedDuration);
  std::vector<ComparedRates> cases;
  const campaign::StudyPlan plan = mixed_plan(arguments, profile, duration, cases);
  const auto outcomes = run_plan(
      plan, arguments.threads, kinds, folder, stop, [&](const campaign::BatchItem& item) {
        const ComparedRates& each =
            cases[static_cast<std::size_t>(&item - plan.items.data())];
        return summary_of_rates(
            {each.set_up, radio.value(), each.rate, duration, item.scenario.seed}, stop);
      });
  if (!outcomes) return say_error(outcomes.error());
  return finish("network mixed", plan, outcomes.value(),
                mixed_report(plan, outcomes.value(), duration, stop), folder, stop);
}

}  // namespace skein::app
