// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "skein/assemble/kinds/kind_registry.h"
#include "skein/assemble/world/build.h"
#include "skein/assemble/world/run.h"
#include "skein/base/result.h"
#include "skein/base/time.h"
#include "skein/data/command/command.h"
#include "skein/data/event/event.h"
#include "skein/data/event/record.h"
#include "skein/data/team/task_form.h"
#include "skein/data/vehicle/autopilot.h"
#include "skein/data/vehicle/sensing.h"
#include "skein/data/vehicle/vehicle.h"
#include "skein/geo/local_frame.h"
#include "skein/record/store/summary_recorder.h"
#include "skein/role/operator_console.h"
#include "skein/role/recorder.h"
#include "skein/scenario/scenario.h"
#include "skein/simulation/paced_run.h"
#include "skein/simulation/run.h"

namespace skein::assemble {

/// How a run is held.
struct ScenarioRunOptions {
  std::string version;  ///< of the program, for the summary
  int threads = 1;
  bool keeps_view = true;        ///< events and beliefs are kept until they are asked for
  double speed = 0;              ///< of run_paced(): see simulation::RunOptions
  Recorder* listener = nullptr;  ///< receives all that is recorded; may be null
  /// Called with the world before it runs; may be empty.
  std::function<void(simulation::World&)> prepare = {};
};

/// A run of a scenario that whoever opened it holds: stepped, given commands, asked, and
/// dropped at any time. It writes no file.
///
///   KindRegistry kinds;
///   auto opened = ScenarioRun::open("wildfire.yaml", {"seed=7"}, kinds);
///   if (!opened) return opened.error();
///   ScenarioRun& run = *opened.value();
///   while (!run.over()) {
///     if (auto moved = run.run_until(run.now() + Time::from_seconds(10)); !moved) ...
///     use(run.truth("scout-1"));
///   }
///   use(run.content_hash());  // that of `skein run wildfire.yaml --set seed=7`
///
/// Aircraft and stations are named as in the scenario; a name that there is not is
/// kBadInput. Threads: one at a time; different runs are independent.
class ScenarioRun {
 public:
  /// Reads a scenario file and makes its world; nothing has moved yet. Ports that the
  /// scenario names are opened, programs started, and plugins loaded into `kinds`, all
  /// with the consent that `kinds` asks.
  /// @param set    changes of the scenario, KEY=VALUE: see scenario::Override.
  /// @param kinds  not needed any more when the run is open.
  /// Fails: kBadInput with all problems of the scenario; as build() and open_links().
  static Result<std::unique_ptr<ScenarioRun>> open(
      const std::filesystem::path& file, const std::vector<std::string>& set,
      KindRegistry& kinds, const ScenarioRunOptions& options = {});

  /// The same of a text.
  /// @param folder  where relative paths in it start.
  static Result<std::unique_ptr<ScenarioRun>> open_text(
      std::string_view text, const std::filesystem::path& folder,
      const std::vector<std::string>& set, KindRegistry& kinds,
      const ScenarioRunOptions& options = {});

  /// The same of a scenario that was read. Fails: as build() and open_links().
  static Result<std::unique_ptr<ScenarioRun>> open(
      const scenario::Scenario& scenario, const KindRegistry& kinds,
      const ScenarioRunOptions& options = {});

  ScenarioRun(const ScenarioRun&) = delete;
  ScenarioRun& operator=(const ScenarioRun&) = delete;

  // As those of simulation::Run. What ground stations outside ask for is taken at the
  // beginning of each call. Whoever steps keeps to the wall clock where real_time().
  Result<void> step(std::int64_t ticks = 1);
  Result<void> run_until(Time time);
  Result<void> run_to_end();
  Result<void> finish() { return linked_.run().finish(); }
  /// Steps it by the clock until its end, or until the console asks to stop; the number
  /// of late steps becomes a figure of the summary. Fails: as simulation::run_paced().
  Result<simulation::RunOutcome> run_paced(OperatorConsole& console);

  Time now() const { return linked_.run().now(); }
  bool over() const { return linked_.run().over(); }

  Result<void> command(const std::string& sender, const Command& command) {
    return linked_.run().command(sender, command);
  }
  /// A command as a person writes it: see data/command/command_text.h.
  Result<void> command(const std::string& sender, std::string_view line);

  /// The true state of an aircraft at now(). Fails: kUnavailable where nobody knows it.
  Result<VehicleState> truth(std::string_view aircraft) const;
  /// What its autopilot believes and does. Fails: kUnavailable before it takes part.
  Result<NavEstimate> estimate(std::string_view aircraft) const;
  Result<AutopilotStatus> status(std::string_view aircraft) const;
  /// The newest beliefs; none without ScenarioRunOptions::keeps_view.
  Result<std::vector<PerimeterRecord>> perimeter_beliefs(std::string_view station) const;
  Result<std::vector<ObjectBeliefRecord>> object_beliefs(std::string_view station) const;
  Result<std::vector<TrafficBeliefRecord>> traffic_beliefs(
      std::string_view aircraft) const;
  /// Events since the last call; none without ScenarioRunOptions::keeps_view.
  std::vector<Event> take_events() { return linked_.run().take_events(); }

  /// Of all records so far; when it has come to its end, that of every run of the
  /// scenario with these commands.
  std::string content_hash() const { return recorder_.content_hash(); }
  /// The key figures so far; `interrupted` unless it has come to its end.
  record::RunSummary summary() const;

  /// The run itself, for whoever asks by number.
  const simulation::Run& run() const { return linked_.run(); }
  /// Names of aircraft and stations, in the order of their numbers.
  std::vector<std::string> names() const;
  /// What was repaired in outside data, and what cannot be done as asked for.
  const std::vector<std::string>& warnings() const { return ready_.warnings; }
  /// Where servers of the scenario wait.
  const std::vector<std::string>& places() const { return places_; }
  /// An aircraft goes by the wall clock, and so must the run.
  bool real_time() const { return ready_.mixed; }

 private:
  ScenarioRun(const scenario::Scenario& scenario, geo::LocalFrame frame, TaskForms forms,
              Build ready, std::vector<std::string> places,
              const ScenarioRunOptions& options);
  template <class T>
  Result<T> of(std::string_view name, const char* missing,
               std::optional<T> (simulation::Run::*ask)(EntityId) const) const;
  template <class T>
  Result<std::vector<T>> beliefs(std::string_view name,
                                 std::vector<T> (simulation::Run::*ask)(EntityId)
                                     const) const;

  geo::LocalFrame frame_;
  TaskForms forms_;
  Build ready_;
  std::vector<std::string> places_;
  record::SummaryRecorder recorder_;
  LinkedRun linked_;
};

}  // namespace skein::assemble
