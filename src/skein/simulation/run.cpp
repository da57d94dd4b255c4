// SPDX-License-Identifier: Apache-2.0
#include "skein/simulation/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <new>

#include "skein/simulation/pace.h"
#include "skein/simulation/stepper.h"

namespace skein::simulation {
namespace {

// What ended the run at `now`, and when that was.
Error failed_at(Time now, Error error) {
  while (!error.message.empty() && error.message.back() == '.') error.message.pop_back();
  error.message += fmt::format(" (at {:.3f} s of simulated time).", now.seconds());
  return error;
}

// One step; whatever it throws ends the run, not the program: others may be going on.
Result<void> guarded_step(Stepper& stepper, Time now) {
  try {
    return stepper.step(now);
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::kUnavailable, "", "not enough memory",
                 "Use a coarser grid or fewer members, or run fewer at a time."};
  } catch (const std::exception& fault) {
    return internal_error(fault.what());
  }
}

// Commands of a run: where they come from, and those that steer its clock.
class CommandServer {
 public:
  CommandServer(const RunOptions& options, OperatorConsole& console, Pace& pace,
                Stepper& stepper)
      : options_(options), console_(console), pace_(pace), stepper_(stepper) {}

  // Obeys all that counts from the step at `now` on; waits while the run is paused.
  void take(Time now) {
    while (next_ < options_.commands.size() && options_.commands[next_].time <= now)
      obey(now, options_.commands[next_++]);
    take_from_console(now);
    if (!options_.clock_by_command) return;
    while (paused_ && steps_ == 0 && !console_.stop_requested()) {
      pace_.nap();
      take_from_console(now);
    }
    if (steps_ > 0) --steps_;
  }

 private:
  void take_from_console(Time now) {
    for (const CommandRecord& given : console_.commands()) obey(now, given);
  }

  void obey(Time now, const CommandRecord& given) {
    stepper_.command(now, given.sender, given.command);
    if (const auto* pause = std::get_if<PauseCommand>(&given.command)) {
      paused_ = pause->paused;
      steps_ = 0;
    } else if (const auto* step = std::get_if<StepCommand>(&given.command)) {
      steps_ += paused_ ? step->steps : 0;
    } else if (const auto* speed = std::get_if<SpeedCommand>(&given.command)) {
      if (options_.real_time_only && speed->factor != 1)
        stepper_.refuse(now,
                        "aircraft that are not simulated fly in real time: no other "
                        "speed can be had.");
      else if (options_.clock_by_command)
        pace_.set_speed(speed->factor, now);
    }
  }

  const RunOptions& options_;
  OperatorConsole& console_;
  Pace& pace_;
  Stepper& stepper_;
  std::size_t next_ = 0;
  std::uint32_t steps_ = 0;  // that a paused run still makes
  bool paused_ = false;
};

}  // namespace

Result<RunOutcome> run(World& world, const RunOptions& options, Recorder& recorder,
                       OperatorConsole& console) {
  Stepper stepper(world, options, recorder);
  Pace pace(options.speed, options.step);
  CommandServer desk(options, console, pace, stepper);
  RunOutcome outcome;
  const auto progress_at = [&](Time now) {
    return RunProgress{now, options.duration, now.seconds() / pace.wall_s(),
                       stepper.headline(), static_cast<std::uint64_t>(pace.misses())};
  };
  stepper.introduce();
  Time now;
  for (; now <= options.duration; now += options.step) {
    pace.wait_for(now, console);
    if (console.stop_requested()) {
      outcome.end = RunOutcome::End::kStopped;
      break;
    }
    desk.take(now);
    if (auto stepped = guarded_step(stepper, now); !stepped)
      return failed_at(now, stepped.error());
    for (const Event& event : stepper.take_announcements())
      console.announce(event, stepper.name_of_entity(event.entity));
    if (pace.show_due()) console.show(progress_at(now));
  }
  stepper.finish();
  outcome.simulated = std::max(Time(), std::min(now, options.duration));
  outcome.wall_s = pace.wall_s();
  outcome.deadline_misses = pace.misses();
  console.show(progress_at(outcome.simulated));
  return outcome;
}

}  // namespace skein::simulation
