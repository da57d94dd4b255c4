// SPDX-License-Identifier: Apache-2.0
#include "skein/simulation/paced_run.h"

#include <gtest/gtest.h>

#include <chrono>

#include "skein/simulation/test/gliders.h"

namespace skein::simulation::paced_run_test {
namespace {

using namespace test;

TEST(PacedRun, StopsCleanlyWhenAsked) {
  World world = make_world(1);
  Notes notes;
  Silent console;
  console.stop_after = 30;
  const auto outcome = run_paced(world, seconds(10), notes, console);
  ASSERT_TRUE(outcome.ok());
  EXPECT_EQ(outcome.value().end, RunOutcome::End::kStopped);
  EXPECT_EQ(notes.truths, 30);
}

// Asks to stop from a moment of the wall clock on.
class Impatient : public OperatorConsole {
 public:
  void show(const RunProgress&) override {}
  bool stop_requested() const override { return Clock::now() >= stop_; }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point stop_ = Clock::now() + std::chrono::milliseconds(300);
};

TEST(PacedRun, StopsAtOnceWhenASlowPaceSleeps) {
  World world = make_world(1);
  Notes notes;
  Impatient console;
  RunOptions options = seconds(10);
  options.speed = 0.001;  // a step every 100 s
  const auto begun = std::chrono::steady_clock::now();
  const auto outcome = run_paced(world, options, notes, console);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begun;
  ASSERT_TRUE(outcome.ok());
  EXPECT_EQ(outcome.value().end, RunOutcome::End::kStopped);
  EXPECT_EQ(notes.truths, 1) << "the step that was not yet due is not done";
  EXPECT_LT(took.count(), 50) << "not at the end of the step";
}

TEST(PacedRun, KeepsPaceWithTheClock) {
  World world = make_world(1);
  Notes notes;
  Silent console;
  RunOptions options = seconds(2);
  options.speed = 10;
  const auto outcome = run_paced(world, options, notes, console);
  ASSERT_TRUE(outcome.ok());
  EXPECT_GE(outcome.value().wall_s, 0.2);  // never faster than asked; how much slower
                                           // depends on the machine
}

TEST(PacedRun, GoesOnFromWhereARunWasStepped) {
  World world = make_world(1);
  Notes notes;
  RunOptions options = seconds(100);
  options.speed = 20;
  simulation::Run run(world, options, notes);
  ASSERT_TRUE(run.run_until(Time::from_seconds(98)).ok());
  Silent console;
  const auto outcome = run_paced(run, console);
  ASSERT_TRUE(outcome.ok());
  EXPECT_EQ(outcome.value().end, RunOutcome::End::kDone);
  EXPECT_EQ(outcome.value().simulated, Time::from_seconds(100));
  EXPECT_GE(outcome.value().wall_s, 0.1);
  EXPECT_LT(outcome.value().wall_s, 4) << "5 s are gone already, by its own pace";
}

}  // namespace
}  // namespace skein::simulation::paced_run_test
