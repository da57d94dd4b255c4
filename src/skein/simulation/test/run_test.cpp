// SPDX-License-Identifier: Apache-2.0
#include "skein/simulation/run.h"

#include <gtest/gtest.h>

#include <chrono>
#include <new>
#include <string>

#include "skein/simulation/test/gliders.h"

namespace skein::simulation::run_test {
namespace {

using namespace test;

TEST(Run, RecordsAtItsRateAndDeliversMessages) {
  World world = make_world(2);
  Notes notes;
  Silent console;
  const auto outcome = run(world, seconds(10), notes, console);
  ASSERT_TRUE(outcome.ok());
  EXPECT_EQ(outcome.value().end, RunOutcome::End::kDone);
  EXPECT_EQ(notes.truths, 2 * 101);
  EXPECT_EQ(notes.messages, 2 * 21);
  EXPECT_EQ(notes.crossings, 2) << "each reports one, recorded once";
  EXPECT_NEAR(world.entities[0].vehicle->truth()->p_N.x(), 20 * 10.1, 1e-9);
}

TEST(Run, IsTheSameForAnyNumberOfThreads) {
  std::string first;
  for (const int threads : {1, 2, 4}) {
    World world = make_world(100, Time::from_seconds(0.3));
    Notes notes;
    Silent console;
    ASSERT_TRUE(run(world, seconds(5, threads), notes, console).ok());
    if (first.empty()) first = notes.text;
    EXPECT_EQ(notes.text, first) << threads << " threads";
  }
}

// Counts what it is to send.
class CountingRadio final : public Radio {
 public:
  CountingRadio(bool carries_broadcasts, std::size_t& messages)
      : carries_broadcasts_(carries_broadcasts), messages_(messages) {}
  bool carries_broadcasts() const override { return carries_broadcasts_; }
  void send(const Message& message) override {
    EXPECT_EQ(message.to == kEveryone, carries_broadcasts_);
    ++messages_;
  }
  void deliver(Time, RadioNews&) override {}

 private:
  bool carries_broadcasts_;
  std::size_t& messages_;
};

TEST(Run, MessagesToAllAreCopiedUnlessTheRadioKnowsWhoTheyAre) {
  for (const bool carries_broadcasts : {false, true}) {
    World world = make_world(3);
    std::size_t messages = 0;
    world.radio = std::make_unique<CountingRadio>(carries_broadcasts, messages);
    for (Entity& entity : world.entities)
      entity.agent = std::make_unique<Talker>(kEveryone);
    // Of the others the agent's own program knows nothing.
    world.entities[2].active.clear();
    Notes notes;
    Silent console;
    ASSERT_TRUE(run(world, seconds(5), notes, console).ok());
    EXPECT_EQ(messages, 2 * 11u) << "each half second two speak, to one other";
  }
}

TEST(Run, EntitiesJoinAndLeave) {
  World world = make_world(2);
  world.entities[1].active = {{Time::from_seconds(1), Time::from_seconds(2)},
                              {Time::from_seconds(3), Time::from_seconds(4)}};
  Notes notes;
  Silent console;
  ASSERT_TRUE(run(world, seconds(5), notes, console).ok());
  EXPECT_EQ(notes.kinds, "joined joined left joined left ");
  EXPECT_EQ(notes.truths, 51 + 20);
}

TEST(Run, AnAircraftThatHitsTheGroundEndsAsAnAccident) {
  World world = make_world(2, Time(), -10, [](std::size_t i, VehicleParts& parts) {
    if (i == 0) parts.state.p_N.z() = -1000;
  });
  Notes notes;
  Silent console;
  ASSERT_TRUE(run(world, seconds(10), notes, console).ok());
  EXPECT_NE(notes.text.find("1 accident"), std::string::npos);
  EXPECT_EQ(notes.text.find("0 accident"), std::string::npos);
}

TEST(Run, StopsCleanlyWhenAsked) {
  World world = make_world(1);
  Notes notes;
  Silent console;
  console.stop_after = 30;
  const auto outcome = run(world, seconds(10), notes, console);
  ASSERT_TRUE(outcome.ok());
  EXPECT_EQ(outcome.value().end, RunOutcome::End::kStopped);
  EXPECT_EQ(notes.truths, 30);
}

TEST(Run, ReportsARecorderThatFails) {
  World world = make_world(1);
  Notes notes;
  notes.full_at = Time::from_seconds(2);
  Silent console;
  const auto outcome = run(world, seconds(10), notes, console);
  ASSERT_FALSE(outcome.ok());
  EXPECT_EQ(outcome.error().code, ErrorCode::kUnavailable);
  EXPECT_EQ(outcome.error().text(), "disk: it is full (at 2.000 s of simulated time).");
}

// Out of memory in the third step, as a grid that grows with the fire may be.
class Hungry : public NoFire {
 public:
  void advance(Time now) override {
    if (now >= Time::from_seconds(3)) throw std::bad_alloc();
  }
};

TEST(Run, SaysWhenMemoryRanOut) {
  World world = make_world(1);
  world.phenomena.front() = std::make_unique<Hungry>();
  Notes notes;
  Silent console;
  const auto outcome = run(world, seconds(10), notes, console);
  ASSERT_FALSE(outcome.ok());
  EXPECT_EQ(outcome.error().code, ErrorCode::kUnavailable);
  EXPECT_NE(outcome.error().message.find("not enough memory (at 3.000 s"),
            std::string::npos)
      << outcome.error().text();
}

// A check of our own code fails in the third second.
class Faulty : public NoFire {
 public:
  void advance(Time now) override {
    SKEIN_CHECK(now < Time::from_seconds(3), "front", 7);
  }
};

TEST(Run, SaysWhenSkeinItselfHasABug) {
  World world = make_world(1);
  world.phenomena.front() = std::make_unique<Faulty>();
  Notes notes;
  Silent console;
  const auto outcome = run(world, seconds(10), notes, console);
  ASSERT_FALSE(outcome.ok());
  EXPECT_EQ(outcome.error().code, ErrorCode::kInternal);
  const std::string text = outcome.error().text();
  EXPECT_TRUE(text.starts_with("internal error: ")) << text;
  EXPECT_NE(text.find("front 7 (at 3.000 s of simulated time). This is a bug in Skein, "
                      "please report it."),
            std::string::npos)
      << text;
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

TEST(Run, StopsAtOnceWhenASlowPaceSleeps) {
  World world = make_world(1);
  Notes notes;
  Impatient console;
  RunOptions options = seconds(10);
  options.speed = 0.001;  // a step every 100 s
  const auto begun = std::chrono::steady_clock::now();
  const auto outcome = run(world, options, notes, console);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begun;
  ASSERT_TRUE(outcome.ok());
  EXPECT_EQ(outcome.value().end, RunOutcome::End::kStopped);
  EXPECT_EQ(notes.truths, 1) << "the step that was not yet due is not done";
  EXPECT_LT(took.count(), 50) << "not at the end of the step";
}

TEST(Run, TakesNoEntitiesAndNoTime) {
  World world = make_world(0);
  Notes notes;
  Silent console;
  const auto outcome = run(world, seconds(0), notes, console);
  ASSERT_TRUE(outcome.ok());
  EXPECT_EQ(outcome.value().simulated, Time());
}

TEST(Run, KeepsPaceWithTheClock) {
  World world = make_world(1);
  Notes notes;
  Silent console;
  RunOptions options = seconds(2);
  options.speed = 10;
  const auto outcome = run(world, options, notes, console);
  ASSERT_TRUE(outcome.ok());
  EXPECT_GE(outcome.value().wall_s, 0.2);  // never faster than asked; how much slower
                                           // depends on the machine
}

}  // namespace
}  // namespace skein::simulation::run_test
