// SPDX-License-Identifier: Apache-2.0
#include "skein/assemble/world/run.h"

#include <optional>
#include <utility>

#include "skein/link/vehicle_links/linked_console.h"
#include "skein/link/world_link/agent_parts.h"
#include "skein/link/world_link/entity_links.h"
#include "skein/record/store/fan_out.h"
#include "skein/record/store/summary_recorder.h"

namespace skein::assemble {
namespace {

class QuietConsole : public OperatorConsole {
 public:
  QuietConsole(const std::atomic<bool>* stop, OperatorConsole* source)
      : stop_(stop), source_(source) {}
  void show(const RunProgress&) override {}
  bool stop_requested() const override { return stop_ && *stop_; }
  std::vector<CommandRecord> commands() override {
    return source_ ? source_->commands() : std::vector<CommandRecord>();
  }

 private:
  const std::atomic<bool>* stop_;
  OperatorConsole* source_;
};

}  // namespace

Result<void> check_consent(const Build& ready) {
  if (ready.commands.empty()) return {};
  if (ready.consent) return ready.consent->programs(ready.commands, ready.source);
  return Error{ErrorCode::kUnavailable, ready.source.file.string(),
               "names programs to be started, and nobody consents to that.",
               "Give the table of kinds a CodeConsent."};
}

Result<std::vector<std::string>> open_links(Build& ready) {
  if (auto allowed = check_consent(ready); !allowed) return allowed.error();
  std::vector<std::string> places;
  const auto start = [&places](auto& links) -> Result<void> {
    auto started = links.start();
    if (!started) return started.error();
    places.insert(places.end(), started.value().begin(), started.value().end());
    return {};
  };
  if (auto started = start(*ready.links); !started) return started.error();
  if (auto started = start(*ready.entity_links); !started) return started.error();
  if (ready.modem)
    if (auto started = start(*ready.modem); !started) return started.error();
  if (ready.world_client)
    if (auto started = start(*ready.world_client); !started) return started.error();
  for (simulation::Entity& entity : ready.world.entities)
    if (entity.vehicle)
      if (auto opened = entity.vehicle->open(); !opened) return opened.error();
  return places;
}

Result<simulation::RunOutcome> run_linked(Build& ready, Recorder* recorder,
                                          OperatorConsole& console) {
  std::vector<Recorder*> listeners;
  if (ready.feed) listeners.push_back(ready.feed.get());
  if (ready.world_feed) listeners.push_back(ready.world_feed.get());
  if (listeners.empty())
    return simulation::run(ready.world, ready.options, *recorder, console);
  if (recorder) listeners.push_back(recorder);
  record::FanOut all(std::move(listeners));
  OperatorConsole* source = &console;
  std::optional<vehicle_links::LinkedConsole> stations;
  if (ready.feed) source = &stations.emplace(*source, *ready.feed);
  std::optional<world_link::WorldConsole> world;
  if (ready.world_client) source = &world.emplace(*source, *ready.world_client);
  return simulation::run(ready.world, ready.options, all, *source);
}

Result<record::RunSummary> run_quietly(const scenario::Scenario& scenario,
                                       const KindRegistry& kinds, const QuietRun& how) {
  auto built = build(scenario, kinds);
  if (!built) return built.error();
  Build& ready = built.value();
  ready.options.speed = ready.mixed ? 1 : how.speed;
  ready.options.real_time_only = ready.mixed;
  ready.options.threads = how.threads;
  record::SummaryRecorder recorder(
      {how.version, scenario.seed, scenario.name, how.text, scenario.start_utc});
  QuietConsole console(how.stop, how.console);
  std::vector<Recorder*> listeners = {&recorder};
  if (how.listener) listeners.push_back(how.listener);
  record::FanOut all(std::move(listeners));
  if (auto opened = open_links(ready); !opened) return opened.error();
  if (how.prepare) how.prepare(ready.world);
  const auto outcome = run_linked(ready, &all, console);
  if (!outcome) return outcome.error();
  if (outcome.value().end == simulation::RunOutcome::End::kStopped)
    return Error{ErrorCode::kInterrupted, scenario.name, "stopped before its end.", ""};
  recorder.set_figure("deadline_misses",
                      static_cast<double>(outcome.value().deadline_misses));
  record::RunSummary summary = recorder.summary();
  summary.warnings = ready.warnings;
  return summary;
}

}  // namespace skein::assemble
