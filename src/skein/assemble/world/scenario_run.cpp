// SPDX-License-Identifier: Apache-2.0
#include "skein/assemble/world/scenario_run.h"

#include <fmt/format.h>

#include <utility>

#include "skein/assemble/kinds/load_plugin.h"
#include "skein/assemble/world/read_command.h"
#include "skein/scenario/scenario_file.h"

namespace skein::assemble {
namespace {

std::vector<scenario::Override> overrides_of(const std::vector<std::string>& set) {
  std::vector<scenario::Override> all;
  for (const std::string& text : set) all.push_back({text});
  return all;
}

scenario::LoadPlugin load_into(KindRegistry& kinds) {
  return [&kinds](const std::string& plugin, const scenario::Source& named_in) {
    return load_named_plugin(plugin, named_in, kinds);
  };
}

// All problems as one error.
Error problems_of(const scenario::ReadOutcome& read) {
  std::string report = read.report();
  while (report.ends_with('\n')) report.pop_back();
  return {ErrorCode::kBadInput, "", report, ""};
}

std::vector<Recorder*> recorders(record::SummaryRecorder& summary, Recorder* listener) {
  std::vector<Recorder*> all = {&summary};
  if (listener) all.push_back(listener);
  return all;
}

}  // namespace

Result<std::unique_ptr<ScenarioRun>> ScenarioRun::open(
    const std::filesystem::path& file, const std::vector<std::string>& set,
    KindRegistry& kinds, const ScenarioRunOptions& options) {
  const auto read =
      scenario::read_scenario(file, kinds.table(), overrides_of(set), load_into(kinds));
  if (!read.ok()) return problems_of(read);
  return open(*read.scenario, kinds, options);
}

Result<std::unique_ptr<ScenarioRun>> ScenarioRun::open_text(
    std::string_view text, const std::filesystem::path& folder,
    const std::vector<std::string>& set, KindRegistry& kinds,
    const ScenarioRunOptions& options) {
  const auto read = scenario::read_scenario_text(text, "scenario", folder, kinds.table(),
                                                 overrides_of(set), load_into(kinds));
  if (!read.ok()) return problems_of(read);
  return open(*read.scenario, kinds, options);
}

Result<std::unique_ptr<ScenarioRun>> ScenarioRun::open(
    const scenario::Scenario& scenario, const KindRegistry& kinds,
    const ScenarioRunOptions& options) {
  auto frame = geo::LocalFrame::at(scenario.origin);
  if (!frame) return frame.error();
  auto built = build(scenario, kinds);
  if (!built) return built.error();
  Build& ready = built.value();
  ready.options.speed = ready.mixed ? 1 : options.speed;
  ready.options.real_time_only = ready.mixed;
  ready.options.threads = options.threads;
  ready.options.keeps_view = options.keeps_view;
  auto places = open_links(ready);
  if (!places) return places.error();
  if (options.prepare) options.prepare(ready.world);
  return std::unique_ptr<ScenarioRun>(
      new ScenarioRun(scenario, std::move(frame).value(), kinds.table().task_forms(),
                      std::move(built).value(), std::move(places).value(), options));
}

ScenarioRun::ScenarioRun(const scenario::Scenario& scenario, geo::LocalFrame frame,
                         TaskForms forms, Build ready, std::vector<std::string> places,
                         const ScenarioRunOptions& options)
    : frame_(std::move(frame)),
      forms_(std::move(forms)),
      ready_(std::move(ready)),
      places_(std::move(places)),
      recorder_({options.version, scenario.seed, scenario.name, "", scenario.start_utc}),
      linked_(ready_, recorders(recorder_, options.listener)) {}

Result<void> ScenarioRun::step(std::int64_t ticks) {
  if (auto taken = linked_.take_commands(); !taken) return taken;
  return linked_.run().step(ticks);
}

Result<void> ScenarioRun::run_until(Time time) {
  if (auto taken = linked_.take_commands(); !taken) return taken;
  return linked_.run().run_until(time);
}

Result<void> ScenarioRun::run_to_end() {
  if (auto taken = linked_.take_commands(); !taken) return taken;
  return linked_.run().run_to_end();
}

Result<simulation::RunOutcome> ScenarioRun::run_paced(OperatorConsole& console) {
  auto outcome = linked_.run_paced(console);
  if (outcome)
    recorder_.set_figure("deadline_misses",
                         static_cast<double>(outcome.value().deadline_misses));
  return outcome;
}

Result<void> ScenarioRun::command(const std::string& sender, std::string_view line) {
  auto read = read_command(line, frame_, forms_);
  if (!read) return read.error();
  return command(sender, read.value());
}

template <class T>
Result<T> ScenarioRun::of(std::string_view name, const char* missing,
                          std::optional<T> (simulation::Run::*ask)(EntityId)
                              const) const {
  const auto id = run().find(name);
  if (!id) return id.error();
  auto answer = (run().*ask)(id.value());
  if (answer) return *std::move(answer);
  return Error{ErrorCode::kUnavailable, std::string(name), missing, ""};
}

Result<VehicleState> ScenarioRun::truth(std::string_view aircraft) const {
  return of(aircraft, "nobody knows its true state.", &simulation::Run::truth);
}

Result<NavEstimate> ScenarioRun::estimate(std::string_view aircraft) const {
  return of(aircraft, "has no autopilot that flies it yet.", &simulation::Run::estimate);
}

Result<AutopilotStatus> ScenarioRun::status(std::string_view aircraft) const {
  return of(aircraft, "has no autopilot that flies it yet.", &simulation::Run::status);
}

template <class T>
Result<std::vector<T>> ScenarioRun::beliefs(
    std::string_view name, std::vector<T> (simulation::Run::*ask)(EntityId) const) const {
  const auto id = run().find(name);
  if (!id) return id.error();
  return (run().*ask)(id.value());
}

Result<std::vector<PerimeterRecord>> ScenarioRun::perimeter_beliefs(
    std::string_view station) const {
  return beliefs(station, &simulation::Run::perimeter_beliefs);
}

Result<std::vector<ObjectBeliefRecord>> ScenarioRun::object_beliefs(
    std::string_view station) const {
  return beliefs(station, &simulation::Run::object_beliefs);
}

Result<std::vector<TrafficBeliefRecord>> ScenarioRun::traffic_beliefs(
    std::string_view aircraft) const {
  return beliefs(aircraft, &simulation::Run::traffic_beliefs);
}

record::RunSummary ScenarioRun::summary() const {
  record::RunSummary summary = recorder_.summary(!run().completed());
  summary.warnings = ready_.warnings;
  return summary;
}

std::vector<std::string> ScenarioRun::names() const {
  std::vector<std::string> all;
  for (const simulation::Entity& entity : run().world().entities)
    all.push_back(entity.name);
  return all;
}

}  // namespace skein::assemble
