// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "skein/base/time.h"
#include "skein/data/command/command.h"

namespace skein::simulation {

/// How a run moves. Periods are multiples of `step`.
struct RunOptions {
  Time step = Time::from_seconds(0.1);
  Time duration = Time::from_seconds(3600);
  Time environment_period = Time::from_seconds(1);  ///< of moving phenomena
  Time record_period = Time::from_seconds(0.1);     ///< of recording truth and estimates
  Time perimeter_period = Time::from_seconds(5);    ///< of comparing belief and truth
  Time radio_period = Time::from_seconds(10);       ///< of statistics of radios
  int threads = 1;
  /// Given at their times, before what comes from outside; in order of time.
  std::vector<CommandRecord> commands;
  /// Whoever takes part from outside flies by the wall clock: commands of another speed
  /// are refused.
  bool real_time_only = false;
  /// Events and beliefs are kept for Run::take_events() and its like.
  bool keeps_view = false;

  // Of paced_run.h only: a Run by itself knows no wall clock.
  /// Simulated seconds per second of wall time; 0 = as fast as possible.
  double speed = 0;
  /// Pauses and speeds that are commanded hold; else they are only recorded (a replay).
  bool clock_by_command = true;
};

}  // namespace skein::simulation
