// SPDX-License-Identifier: Apache-2.0
#include "skein/simulation/paced_run.h"

#include "skein/simulation/pace.h"

namespace skein::simulation {
namespace {

// What steers the clock of a run: commands from wherever they come.
class RunClockwork {
 public:
  RunClockwork(Run& run, OperatorConsole& console, Pace& pace)
      : run_(run), console_(console), pace_(pace) {}

  // Obeys all that counts from the next step on; waits while the run is paused.
  Result<void> take() {
    const auto due = run_.obey_due();
    if (!due) return due.error();
    for (const CommandRecord& each : due.value()) steer(each.command);
    if (auto taken = take_from_console(); !taken) return taken;
    if (!run_.options().clock_by_command) return {};
    while (paused_ && steps_ == 0 && !console_.stop_requested()) {
      pace_.nap();
      if (auto taken = take_from_console(); !taken) return taken;
    }
    if (steps_ > 0) --steps_;
    return {};
  }

 private:
  Result<void> take_from_console() {
    for (const CommandRecord& given : console_.commands()) {
      // What cannot be obeyed is an event; what ends the run is found again.
      const auto obeyed = run_.command(given.sender, given.command);
      if (!obeyed && run_.over()) return obeyed;
      steer(given.command);
    }
    return {};
  }

  void steer(const Command& command) {
    if (const auto* pause = std::get_if<PauseCommand>(&command)) {
      paused_ = pause->paused;
      steps_ = 0;
    } else if (const auto* step = std::get_if<StepCommand>(&command)) {
      steps_ += paused_ ? step->steps : 0;
    } else if (const auto* speed = std::get_if<SpeedCommand>(&command)) {
      const RunOptions& options = run_.options();
      const bool refused = options.real_time_only && speed->factor != 1;
      if (options.clock_by_command && !refused)
        pace_.set_speed(speed->factor, run_.now());
    }
  }

  Run& run_;
  OperatorConsole& console_;
  Pace& pace_;
  std::uint32_t steps_ = 0;  // that a paused run still makes
  bool paused_ = false;
};

}  // namespace

Result<RunOutcome> run_paced(Run& run, OperatorConsole& console) {
  const RunOptions& options = run.options();
  const Time begun = run.now();
  Pace pace(options.speed, options.step, begun);
  RunClockwork clockwork(run, console, pace);
  RunOutcome outcome;
  const auto progress_at = [&](Time now) {
    return RunProgress{now, options.duration, (now - begun).seconds() / pace.wall_s(),
                       run.headline(), static_cast<std::uint64_t>(pace.misses())};
  };
  while (!run.over()) {
    const Time now = run.now();
    pace.wait_for(now, console);
    if (console.stop_requested()) {
      outcome.end = RunOutcome::End::kStopped;
      break;
    }
    if (auto taken = clockwork.take(); !taken) return taken.error();
    if (auto stepped = run.step(); !stepped) return stepped.error();
    for (const Event& event : run.announcements())
      console.announce(event, run.name_of_entity(event.entity));
    if (pace.show_due()) console.show(progress_at(now));
  }
  if (auto finished = run.finish(); !finished) return finished.error();
  outcome.simulated = run.simulated();
  outcome.wall_s = pace.wall_s();
  outcome.deadline_misses = pace.misses();
  console.show(progress_at(outcome.simulated));
  return outcome;
}

Result<RunOutcome> run_paced(World& world, const RunOptions& options, Recorder& recorder,
                             OperatorConsole& console) {
  Run run(world, options, recorder);
  return run_paced(run, console);
}

}  // namespace skein::simulation
