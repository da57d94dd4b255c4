// SPDX-License-Identifier: Apache-2.0
// A program of one's own that holds a run: steps it, looks, gives a command on the way.
//
//   hold_a_run SCENARIO [KEY=VALUE]...
#include <cstdio>
#include <string>
#include <vector>

#include "skein/assemble/world/scenario_run.h"

using skein::Time;
using skein::assemble::ScenarioRun;

namespace {

int say(const skein::Error& error) {
  std::fprintf(stderr, "%s\n", error.text().c_str());
  return 1;
}

}  // namespace

int main(int count, char** arguments) {
  if (count < 2) return std::fputs("hold_a_run SCENARIO [KEY=VALUE]...\n", stderr), 2;
  skein::assemble::KindRegistry kinds;
  const std::vector<std::string> set(arguments + 2, arguments + count);
  const auto opened = ScenarioRun::open(arguments[1], set, kinds);
  if (!opened) return say(opened.error());
  ScenarioRun& run = *opened.value();
  const std::string name = run.names().back();

  while (!run.over()) {
    if (run.now() == Time::from_seconds(30))
      if (auto given = run.command("scenario", "wind 6 90"); !given)
        return say(given.error());
    if (auto moved = run.run_until(run.now() + Time::from_seconds(10)); !moved)
      return say(moved.error());
    const auto truth = run.truth(name);
    const auto belief = run.estimate(name);  // of its autopilot
    if (!truth || !belief) return say(!truth ? truth.error() : belief.error());
    std::printf("%5.1f s  %s is at %7.2f %7.2f m, and believes %7.2f %7.2f m\n",
                run.now().seconds(), name.c_str(), truth.value().p_N.x(),
                truth.value().p_N.y(), belief.value().p_N.x(), belief.value().p_N.y());
  }
  std::printf("content hash %s\n", run.content_hash().c_str());
  return 0;
}
