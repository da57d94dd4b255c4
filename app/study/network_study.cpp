// SPDX-License-Identifier: Apache-2.0
// skein study network: experiments with the radio medium alone.
#include <fmt/format.h>
#include <time.h>

#include <algorithm>
#include <array>
#include <map>

#include "app/common/common.h"
#include "app/common/output.h"
#include "app/common/version.h"
#include "app/net/experiment/network_cases.h"
#include "app/net/experiment/network_run.h"
#include "app/net/experiment/saturated_cell.h"
#include "app/study/parts.h"
#include "skein/assemble/radio/radio_file.h"
#include "skein/base/hash.h"
#include "skein/campaign/network/network_report.h"
#include "skein/campaign/network/network_study.h"
#include "skein/exchange/network/network_results.h"
#include "skein/layer/communication/propagation/path_loss.h"

namespace skein::app {
namespace {

namespace fs = std::filesystem;
namespace figure = campaign::network_figure;
using campaign::NetworkExperiment;

constexpr std::uint32_t kBytes = 1000;         // of the payload of a message
constexpr std::uint32_t kRtsThreshold = 500;   // of a frame, where there is RTS/CTS
constexpr std::uint32_t kSaturatedQueue = 50;  // packets: never full
constexpr double kCellPower = -60;             // at every receiver of a cell [dBm]

struct Experiment {
  const char* name;
  NetworkExperiment which;
  bool nodes, profiles;  // whether it takes --nodes, --profiles
};

constexpr Experiment kExperiments[] = {
    {"grid", NetworkExperiment::kGrid, true, true},
    {"cell", NetworkExperiment::kCell, true, false},
    {"hidden", NetworkExperiment::kHidden, false, true},
};

// Those with real ones among the nodes.
constexpr const char *kMixed = "mixed", *kObstacle = "obstacle";

// CPU seconds of this thread.
double thread_cpu() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

// The radio of a profile, as the experiment has it without RTS.
Result<assemble::RadioFile> radio_of(NetworkExperiment experiment,
                                     const std::string& profile,
                                     const assemble::RadioParts& parts) {
  const bool cell = experiment == NetworkExperiment::kCell;
  auto radio = assemble::load_radio(cell ? "nn8" : profile, fs::current_path(), parts);
  if (!radio) return radio;
  if (experiment != NetworkExperiment::kGrid)
    radio.value().radio.mac.queue_packets = kSaturatedQueue;
  if (cell) {
    auto& propagation = radio.value().propagation;
    propagation.model =
        scenario::default_choice(assemble::radio_table(parts), "propagation", "fixed");
    propagation.section.received_power_dbm = kCellPower;
  }
  radio.value().radio.mac.rts_threshold_bytes = 65535;
  return radio;
}

assemble::RadioFile with_rts(assemble::RadioFile radio) {
  radio.radio.mac.rts_threshold_bytes = kRtsThreshold;
  return radio;
}

NetworkCase network_of(NetworkExperiment experiment,
                       const campaign::NetworkStudyCase& given, Time duration) {
  switch (experiment) {
    case NetworkExperiment::kGrid:
      return experiment::grid_network(given.nodes, duration, given.seed);
    case NetworkExperiment::kCell:
      return experiment::cell_network(given.nodes, duration, given.seed);
    case NetworkExperiment::kHidden:
      break;
  }
  return experiment::hidden_network(duration, given.seed);
}

std::string hash_of(const NetworkResult& result) {
  Hasher hasher;
  for (const NetworkMessage& message : result.messages) {
    hasher.add(message.sent.ns());
    hasher.add(message.delivered.value_or(Time::from_ns(-1)).ns());
    hasher.add(static_cast<std::int64_t>(message.fate));
    hasher.add(std::int64_t{message.transmissions});
  }
  return hasher.hex();
}

std::map<std::string, double> numbers_of(const exchange::NetworkSummary& summary,
                                         bool rts) {
  const auto number = [](std::uint64_t count) { return static_cast<double>(count); };
  std::map<std::string, double> numbers = {{"sent", number(summary.sent)},
                                           {"delivered", number(summary.delivered)},
                                           {"queue_full", number(summary.queue_full)},
                                           {"given_up", number(summary.given_up)},
                                           {"pending", number(summary.pending)},
                                           {"data_frames", number(summary.data_frames)},
                                           {"ack_frames", number(summary.ack_frames)},
                                           {"rts_frames", number(summary.rts_frames)},
                                           {"cts_frames", number(summary.cts_frames)},
                                           {figure::kLoss, 100 * summary.loss_ratio},
                                           {figure::kGoodput, summary.goodput_bps / 1e3}};
  if (!summary.delays.empty()) {
    numbers[figure::kDelayMean] = 1e3 * summary.mean_delay;
    numbers["delay_median_ms"] = 1e3 * summary.delay_quantile(0.5);
    numbers[figure::kDelayP95] = 1e3 * summary.delay_quantile(0.95);
    numbers["delay_p99_ms"] = 1e3 * summary.delay_quantile(0.99);
    numbers["delay_max_ms"] = 1e3 * summary.delay_quantile(1);
  }
  // What begins a transmission and is not answered.
  const double begun = number(rts ? summary.rts_frames : summary.data_frames);
  const double answered = number(rts ? summary.cts_frames : summary.ack_frames);
  if (begun > 0) numbers[figure::kCollisions] = 1 - answered / begun;
  return numbers;
}

void add_theory(std::uint32_t stations, const communication::RadioProfile& radio,
                std::map<std::string, double>& numbers) {
  const auto endless = experiment::saturated_cell(stations, radio, kBytes);
  // The retry limits of long and short frames differ; RTS are short ones.
  const auto finite =
      experiment::saturated_cell(stations, radio, kBytes, radio.mac.short_retry_limit);
  numbers[figure::kBianchiGoodput] = endless.throughput / 1e3;
  numbers[figure::kBianchiFiniteGoodput] = finite.throughput / 1e3;
  numbers[figure::kBianchiCollisions] = finite.collision_probability;
}

Result<record::RunSummary> simulate(NetworkExperiment experiment,
                                    const campaign::NetworkStudyCase& given,
                                    double duration, const assemble::RadioFile& radio,
                                    const std::atomic<bool>& stop) {
  const NetworkCase network = network_of(experiment, given, Time::from_seconds(duration));
  const auto propagation = assemble::make_propagation(radio, given.seed);
  if (!propagation) return propagation.error();
  const auto antenna = assemble::make_antenna(radio.parts, radio.antenna);
  if (!antenna) return antenna.error();
  communication::NodeAntennas antennas;
  if (antenna.value()) antennas.of.assign(network.nodes.size(), antenna.value());
  experiment::NetworkRun run(network, radio.radio, *propagation.value(), given.seed,
                             std::move(antennas));
  const double began = thread_cpu();
  constexpr std::int64_t kParts = 1000;
  for (std::int64_t part = 1; part <= kParts; ++part) {
    if (stop) return Error{ErrorCode::kInterrupted, "", "interrupted.", ""};
    run.advance(Time::from_ns(network.duration.ns() / kParts * part));
  }
  run.advance(network.duration);
  const double cpu = thread_cpu() - began;

  const Time warm_up = Time::from_seconds(campaign::warm_up_of(experiment));
  record::RunSummary summary;
  summary.version = kVersion;
  summary.seed = given.seed;
  summary.content_hash = hash_of(run.result());
  summary.numbers =
      numbers_of(exchange::summarize(network, run.result(), warm_up), given.rts);
  summary.numbers[figure::kSimulated] = duration;
  summary.numbers[figure::kCpu] = cpu;
  if (experiment == NetworkExperiment::kCell)
    add_theory(given.nodes, radio.radio, summary.numbers);
  return summary;
}

// The experiment by name; null after saying what is wrong.
const Experiment* experiment_of(const StudyArguments& arguments) {
  std::string names;
  for (const Experiment& each : kExperiments) {
    if (arguments.experiment == each.name) {
      const bool no_nodes = !each.nodes && !arguments.nodes.empty();
      const bool no_profiles = !each.profiles && !arguments.profiles.empty();
      if (!no_nodes && !no_profiles) return &each;
      complain("error: {} has no meaning for the experiment {}.\n",
               no_nodes ? "--nodes" : "--profiles", each.name);
      return nullptr;
    }
    names += fmt::format(" {}", each.name);
  }
  names += fmt::format(" {} {}", kMixed, kObstacle);
  if (arguments.experiment.empty())
    complain("error: the study network needs an experiment. There are:{}.\n", names);
  else
    complain("error: there is no experiment \"{}\" of the study network. There are:{}.\n",
             arguments.experiment, names);
  return nullptr;
}

campaign::NetworkStudy study_of(const StudyArguments& arguments,
                                NetworkExperiment experiment) {
  campaign::NetworkStudy study = campaign::default_network_study(experiment);
  if (!arguments.nodes.empty()) study.nodes = arguments.nodes;
  if (!arguments.profiles.empty()) study.profiles = arguments.profiles;
  if (arguments.seeds) study.seeds = *arguments.seeds;
  if (arguments.duration) study.duration = *arguments.duration;
  study.first_seed = arguments.first_seed;
  return study;
}

}  // namespace

int network_study(const StudyArguments& arguments, assemble::KindRegistry& kinds,
                  const fs::path& folder, const std::atomic<bool>& stop) {
  if (arguments.experiment == kMixed)
    return mixed_rates_study(arguments, kinds, folder, stop);
  if (arguments.experiment == kObstacle)
    return obstacle_study(arguments, kinds, folder, stop);
  const Experiment* experiment = experiment_of(arguments);
  if (!experiment) return kBadUsage;
  const campaign::NetworkStudy study = study_of(arguments, experiment->which);
  auto planned = campaign::plan_network_study(study);
  if (!planned) return say_error(planned.error());

  // By profile: without and with RTS.
  std::map<std::string, std::array<assemble::RadioFile, 2>> radios;
  for (const std::string& profile : study.profiles) {
    const auto radio = radio_of(study.experiment, profile, kinds.kinds());
    if (!radio) return say_error(radio.error());
    radios[profile] = {radio.value(), with_rts(radio.value())};
  }
  campaign::StudyPlan& plan = planned.value().plan;
  const auto& cases = planned.value().cases;
  for (std::size_t i = 0; i < cases.size(); ++i)
    plan.items[i].data =
        fmt::format("# {}, {} s\n{}", plan.items[i].name, study.duration,
                    assemble::write_radio(radios[cases[i].profile][cases[i].rts]));

  const auto outcomes = run_plan(
      plan, arguments.threads, kinds, folder, stop, [&](const campaign::BatchItem& item) {
        const auto& given = cases[static_cast<std::size_t>(&item - plan.items.data())];
        return simulate(study.experiment, given, study.duration,
                        radios.at(given.profile)[given.rts], stop);
      });
  if (!outcomes) return say_error(outcomes.error());
  return finish(
      fmt::format("network {}", experiment->name), plan, outcomes.value(),
      campaign::network_report(study, planned.value(), outcomes.value()), folder, stop,
      campaign::network_comparison(planned.value(), study.experiment, outcomes.value()));
}

}  // namespace skein::app
