// SPDX-License-Identifier: Apache-2.0
#include "skein/assemble/world/run.h"

#include <optional>
#include <utility>

#include "skein/assemble/world/scenario_run.h"
#include "skein/link/vehicle_links/linked_console.h"
#include "skein/link/world_link/agent_parts.h"
#include "skein/link/world_link/entity_links.h"
#include "skein/role/vehicle.h"

namespace skein::assemble {
namespace {

// Is asked for an end only, and for the commands of another console.
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

// A console to which the commands of all outside are added.
class OutsideConsole {
 public:
  OutsideConsole(Build& ready, OperatorConsole& console) : all_(&console) {
    if (ready.feed) all_ = &stations_.emplace(*all_, *ready.feed);
    if (ready.world_client) all_ = &world_.emplace(*all_, *ready.world_client);
  }
  OperatorConsole& all() { return *all_; }

 private:
  OperatorConsole* all_;
  std::optional<vehicle_links::LinkedConsole> stations_;
  std::optional<world_link::WorldConsole> world_;
};

std::vector<Recorder*> with_outside(const Build& ready, std::vector<Recorder*> more) {
  std::vector<Recorder*> all;
  if (ready.feed) all.push_back(ready.feed.get());
  if (ready.world_feed) all.push_back(ready.world_feed.get());
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

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

LinkedRun::LinkedRun(Build& ready, std::vector<Recorder*> recorders)
    : ready_(ready),
      listeners_(with_outside(ready, std::move(recorders))),
      run_(ready.world, ready.options, listeners_) {}

Result<void> LinkedRun::take_commands() {
  QuietConsole nobody(nullptr, nullptr);
  OutsideConsole outside(ready_, nobody);
  for (const CommandRecord& given : outside.all().commands()) {
    // What cannot be obeyed is an event.
    const auto obeyed = run_.command(given.sender, given.command);
    if (!obeyed && run_.over()) return obeyed;
  }
  return {};
}

Result<simulation::RunOutcome> LinkedRun::run_paced(OperatorConsole& console) {
  OutsideConsole outside(ready_, console);
  return simulation::run_paced(run_, outside.all());
}

Result<simulation::RunOutcome> run_linked(Build& ready, Recorder* recorder,
                                          OperatorConsole& console) {
  std::vector<Recorder*> recorders;
  if (recorder) recorders.push_back(recorder);
  return LinkedRun(ready, std::move(recorders)).run_paced(console);
}

Result<record::RunSummary> run_quietly(const scenario::Scenario& scenario,
                                       const KindRegistry& kinds, const QuietRun& how) {
  ScenarioRunOptions options;
  options.version = how.version;
  options.threads = how.threads;
  options.speed = how.speed;
  options.keeps_view = false;
  options.listener = how.listener;
  options.prepare = how.prepare;
  auto opened = ScenarioRun::open(scenario, kinds, options);
  if (!opened) return opened.error();
  ScenarioRun& run = *opened.value();
  QuietConsole console(how.stop, how.console);
  const auto outcome = run.run_paced(console);
  if (!outcome) return outcome.error();
  if (outcome.value().end == simulation::RunOutcome::End::kStopped)
    return Error{ErrorCode::kInterrupted, scenario.name, "stopped before its end.", ""};
  return run.summary();
}

}  // namespace skein::assemble
