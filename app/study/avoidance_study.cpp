// SPDX-License-Identifier: Apache-2.0
// The study of aircraft that keep apart.

#include <algorithm>
#include <ctime>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/common/common.h"
#include "app/common/output.h"
#include "app/common/version.h"
#include "app/study/parts.h"
#include "skein/assemble/world/run.h"
#include "skein/base/math.h"
#include "skein/base/output_file.h"
#include "skein/campaign/avoidance/avoidance_study.h"
#include "skein/campaign/avoidance/avoidance_watch.h"
#include "skein/record/store/fan_out.h"
#include "skein/record/store/run_recorder.h"
#include "skein/role/agent.h"

namespace skein::app {
namespace {

namespace fs = std::filesystem;

// What the steps of an agent took, of the processor.
struct DecisionTime {
  double longest = 0, sum = 0;  // [s]
  std::optional<Time> first;    // step
  Time last;                    // step
};

// Of this thread: what else the machine does makes no difference [s].
double processor_time() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

// An agent whose steps are measured. Nothing that is simulated sees it.
class TimedAgent final : public Agent {
 public:
  TimedAgent(std::unique_ptr<Agent> agent, DecisionTime& time)
      : agent_(std::move(agent)), time_(time) {}

  void step(const AgentInput& in, AgentOutput& out) override {
    const double begin = processor_time();
    agent_->step(in, out);
    const double took = processor_time() - begin;
    time_.longest = std::max(time_.longest, took);
    time_.sum += took;
    if (!time_.first) time_.first = in.now;
    time_.last = in.now;
  }

 private:
  std::unique_ptr<Agent> agent_;
  DecisionTime& time_;
};

void add_figures(const std::vector<DecisionTime>& times,
                 std::map<std::string, double>& figures) {
  double longest = 0, sum = 0, flown = 0;
  for (const DecisionTime& each : times) {
    longest = std::max(longest, each.longest);
    sum += each.sum;
    if (each.first) flown += (each.last - *each.first).seconds();
  }
  figures["worst_decision_ms"] = 1e3 * longest;
  if (flown > 0) figures["decision_ms_per_s"] = 1e3 * sum / flown;
}

// As `skein run` leaves them.
Result<std::unique_ptr<record::RunRecorder>> open_records(const campaign::BatchItem& item,
                                                          const fs::path& folder) {
  const scenario::Scenario& scenario = item.scenario;
  record::RunRecorderOptions options;
  options.overwrite = true;
  auto created = record::RunRecorder::create(
      folder, {kVersion, scenario.seed, scenario.name, item.text, scenario.start_utc},
      options);
  if (!created) return created;
  if (auto written = write_file(folder / "scenario.yaml", item.text); !written)
    return written.error();
  return created;
}

// @param records  folder for them; none: they are not kept.
Result<record::RunSummary> fly(const campaign::BatchItem& item,
                               const campaign::AvoidanceCase& flown,
                               const campaign::AvoidanceStudy& study,
                               const assemble::KindRegistry& kinds,
                               const std::optional<fs::path>& records,
                               const std::atomic<bool>& stop) {
  campaign::AvoidanceWatch watch(flown, campaign::separation_of(study, flown));
  std::unique_ptr<record::RunRecorder> recorder;
  std::vector<Recorder*> listeners = {&watch};
  if (records) {
    auto opened = open_records(item, *records);
    if (!opened) return opened.error();
    recorder = std::move(opened).value();
    listeners.push_back(recorder.get());
  }
  record::FanOut listener(std::move(listeners));
  std::vector<DecisionTime> times(flown.aircraft.size() + 1);
  assemble::QuietRun how;
  how.version = kVersion;
  how.stop = &stop;
  how.listener = &listener;
  how.console = &watch;
  how.prepare = [&](simulation::World& world) {
    for (std::size_t k = 0; k < world.entities.size() && k < times.size(); ++k)
      if (world.entities[k].vehicle)
        world.entities[k].agent =
            std::make_unique<TimedAgent>(std::move(world.entities[k].agent), times[k]);
  };
  auto summary = assemble::run_quietly(item.scenario, kinds, how);
  if (recorder)
    if (auto closed = recorder->close(!summary); !closed) return closed.error();
  if (!summary) return summary;
  watch.add_figures(summary.value().numbers);
  add_figures(times, summary.value().numbers);
  return summary;
}

// Speed [m/s] and where it comes from [deg].
Vec2 wind_of(const std::vector<double>& given) {
  return -given[0] * geo::unit(given[1] * geo::kPi / 180);
}

Result<campaign::AvoidanceStudy> study_of(const StudyArguments& arguments) {
  campaign::AvoidanceStudy study;
  auto cases = campaign::read_avoidance_cases(arguments.cases_file);
  if (!cases) return cases.error();
  study.cases = std::move(cases.value());
  if (!arguments.cases.empty())
    std::erase_if(study.cases, [&](const campaign::AvoidanceCase& each) {
      return std::none_of(
          arguments.cases.begin(), arguments.cases.end(),
          [&](const std::string& some) { return each.name.starts_with(some); });
    });
  const AvoidanceArguments& how = arguments.avoidance;
  study.method = how.method;
  study.plant = how.plant;
  study.loss = how.loss;
  study.delay = how.delay;
  study.range = how.range;
  study.tracks = how.tracks;
  study.room = how.room;
  study.deal = how.deal;
  study.turbulence = how.turbulence;
  study.seed = arguments.first_seed;
  if (const auto named = separation_named(how.separation)) {
    study.separation = *named;
    if (how.separation == "light") study.horizon = 180;
  }
  if (!how.wind.empty())
    for (campaign::AvoidanceCase& each : study.cases) each.wind = wind_of(how.wind);
  return study;
}

}  // namespace

int avoidance_study(const StudyArguments& arguments, assemble::KindRegistry& kinds,
                    const fs::path& folder, const std::atomic<bool>& stop) {
  if (arguments.cases_file.empty()) {
    complain("error: the study avoidance needs --cases FILE.csv.\n");
    return kBadUsage;
  }
  auto study = study_of(arguments);
  if (!study) return say_error(study.error());
  auto plan = campaign::plan_avoidance_study(
      study.value(), campaign::ScenarioReader(kinds.table(), {}, {}, &stop));
  if (!plan) return say_error(plan.error());
  const bool file = folder.extension() == ".csv";
  const fs::path runs = file ? fs::path(folder).replace_extension(".runs") : folder;
  // One that was flown without records is flown again for them.
  if (arguments.records)
    for (campaign::BatchItem& item : plan.value().items) item.data += " with records";
  const auto outcomes = run_plan(
      plan.value(), arguments.threads, kinds, runs, stop,
      [&](const campaign::BatchItem& item) {
        const auto at = static_cast<std::size_t>(&item - plan.value().items.data());
        std::optional<fs::path> records;
        if (arguments.records) records = runs / folder_name(item.name);
        return fly(item, study.value().cases[at], study.value(), kinds, records, stop);
      });
  if (!outcomes) return say_error(outcomes.error());
  const bool failed = report_failures(plan.value().items, outcomes.value(), runs);
  const std::string csv =
      campaign::avoidance_csv(study.value(), plan.value(), outcomes.value());
  const fs::path to = file ? folder : folder / "avoidance.csv";
  if (auto written = write_file(to, csv); !written) return say_error(written.error());
  print_table(campaign::avoidance_table(plan.value(), outcomes.value()));
  print("\n{}\n", to.string());
  return stop ? kInterrupted : failed ? kFailed : kDone;
}

}  // namespace skein::app
