// SPDX-License-Identifier: Apache-2.0
#include "skein/simulation/run.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <new>
#include <string>
#include <utility>

#include "skein/simulation/test/gliders.h"

namespace skein::simulation::run_test {
namespace {

using namespace test;

TEST(Run, RecordsAtItsRateAndDeliversMessages) {
  World world = make_world(2);
  Notes notes;
  ASSERT_TRUE(run_to_end(world, seconds(10), notes).ok());
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
    ASSERT_TRUE(run_to_end(world, seconds(5, threads), notes).ok());
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
    ASSERT_TRUE(run_to_end(world, seconds(5), notes).ok());
    EXPECT_EQ(messages, 2 * 11u) << "each half second two speak, to one other";
  }
}

TEST(Run, EntitiesJoinAndLeave) {
  World world = make_world(2);
  world.entities[1].active = {{Time::from_seconds(1), Time::from_seconds(2)},
                              {Time::from_seconds(3), Time::from_seconds(4)}};
  Notes notes;
  ASSERT_TRUE(run_to_end(world, seconds(5), notes).ok());
  EXPECT_EQ(notes.kinds, "joined joined left joined left ");
  EXPECT_EQ(notes.truths, 51 + 20);
}

TEST(Run, AnAircraftThatHitsTheGroundEndsAsAnAccident) {
  World world = make_world(2, Time(), -10, [](std::size_t i, VehicleParts& parts) {
    if (i == 0) parts.state.p_N.z() = -1000;
  });
  Notes notes;
  ASSERT_TRUE(run_to_end(world, seconds(10), notes).ok());
  EXPECT_NE(notes.text.find("1 accident"), std::string::npos);
  EXPECT_EQ(notes.text.find("0 accident"), std::string::npos);
}

TEST(Run, ReportsARecorderThatFails) {
  World world = make_world(1);
  Notes notes;
  notes.full_at = Time::from_seconds(2);
  const auto outcome = run_to_end(world, seconds(10), notes);
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
  const auto outcome = run_to_end(world, seconds(10), notes);
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
  const auto outcome = run_to_end(world, seconds(10), notes);
  ASSERT_FALSE(outcome.ok());
  EXPECT_EQ(outcome.error().code, ErrorCode::kInternal);
  const std::string text = outcome.error().text();
  EXPECT_TRUE(text.starts_with("internal error: ")) << text;
  EXPECT_NE(text.find("front 7 (at 3.000 s of simulated time). This is a bug in Skein, "
                      "please report it."),
            std::string::npos)
      << text;
}

// The records of a run of 5 s that is moved by `move`.
template <class Move>
std::string moved(Move move, RunOptions options = seconds(5)) {
  World world = make_world(3, Time::from_seconds(0.3));
  Notes notes;
  simulation::Run run(world, std::move(options), notes);
  move(run);
  EXPECT_TRUE(run.completed());
  return notes.text;
}

TEST(Run, IsTheSameHoweverManyStepsAreMadeAtOnce) {
  const auto by_steps = [](std::int64_t ticks) {
    return moved([ticks](simulation::Run& run) {
      while (!run.over()) ASSERT_TRUE(run.step(ticks).ok());
    });
  };
  const std::string all =
      moved([](simulation::Run& run) { ASSERT_TRUE(run.run_to_end().ok()); });
  EXPECT_EQ(by_steps(1), all);
  EXPECT_EQ(by_steps(7), all);
  EXPECT_EQ(by_steps(1000), all);
  EXPECT_EQ(moved([](simulation::Run& run) {
              // Between two steps, too.
              for (double t = 0; !run.over(); t += 0.77)
                ASSERT_TRUE(run.run_until(Time::from_seconds(t)).ok());
            }),
            all);
}

TEST(Run, MakesTheStepsThatBeginBeforeATime) {
  World world = make_world(1);
  Notes notes;
  simulation::Run run(world, seconds(5), notes);
  ASSERT_TRUE(run.run_until(Time::from_seconds(1)).ok());
  EXPECT_EQ(run.now(), Time::from_seconds(1));
  EXPECT_EQ(notes.truths, 10);
  ASSERT_TRUE(run.run_until(run.now()).ok());
  EXPECT_EQ(run.now(), Time::from_seconds(1));
  ASSERT_TRUE(run.run_until(Time::from_seconds(1.01)).ok());
  EXPECT_EQ(run.now(), Time::from_seconds(1.1));
  ASSERT_TRUE(run.run_until(Time::from_seconds(1e6)).ok());
  EXPECT_TRUE(run.completed());
  EXPECT_EQ(run.simulated(), Time::from_seconds(5));
}

TEST(Run, ACommandBetweenStepsIsThatOfTheOptions) {
  const CommandRecord wind{Time::from_seconds(2), "scenario", WindCommand{{3, 4}}};
  const CommandRecord left{Time::from_seconds(2), "scenario", RemoveCommand{"a1"}};
  const CommandRecord nobody{Time::from_seconds(2), "scenario", RemoveCommand{"a9"}};
  RunOptions options = seconds(5);
  options.commands = {wind, left, nobody};
  const std::string planned =
      moved([](simulation::Run& run) { ASSERT_TRUE(run.run_to_end().ok()); }, options);
  const std::string given = moved([&](simulation::Run& run) {
    ASSERT_TRUE(run.run_until(wind.time).ok());
    EXPECT_TRUE(run.command(wind.sender, wind.command).ok());
    EXPECT_TRUE(run.command(left.sender, left.command).ok());
    EXPECT_FALSE(run.command(nobody.sender, nobody.command).ok());
    ASSERT_TRUE(run.run_to_end().ok());
  });
  EXPECT_EQ(given, planned);
  EXPECT_NE(given.find("command-refused"), std::string::npos);
  // What the options have for a time comes before what is given then.
  options.commands = {wind};
  const std::string mixed = moved(
      [&](simulation::Run& run) {
        ASSERT_TRUE(run.run_until(wind.time).ok());
        EXPECT_TRUE(run.command(left.sender, left.command).ok());
        EXPECT_FALSE(run.command(nobody.sender, nobody.command).ok());
        ASSERT_TRUE(run.run_to_end().ok());
      },
      options);
  EXPECT_EQ(mixed, planned);
}

TEST(Run, TwoInOneProcessAreWhatEachIsAlone) {
  const std::string alone =
      moved([](simulation::Run& run) { ASSERT_TRUE(run.run_to_end().ok()); });
  World first = make_world(3, Time::from_seconds(0.3));
  World second = make_world(3, Time::from_seconds(0.3));
  Notes first_notes, second_notes;
  simulation::Run one(first, seconds(5), first_notes),
      other(second, seconds(5), second_notes);
  while (!one.over()) {
    ASSERT_TRUE(one.step(3).ok());
    if (!other.over()) {
      ASSERT_TRUE(other.step(5).ok());
    }
  }
  EXPECT_EQ(first_notes.text, alone);
  EXPECT_EQ(second_notes.text, alone);
}

TEST(Run, AnswersWhatIsAsked) {
  World world = make_world(2);
  world.entities[1].active = {{Time::from_seconds(1), Time::from_seconds(100)}};
  Notes notes;
  RunOptions options = seconds(5);
  options.keeps_view = true;
  simulation::Run run(world, options, notes);
  const auto first = run.find("a0");
  const auto second = run.find("a1");
  ASSERT_TRUE(first.ok() && second.ok());
  const auto nobody = run.find("a7");
  ASSERT_FALSE(nobody.ok());
  EXPECT_EQ(nobody.error().text(),
            "a7: is no aircraft or station of the run; it has: a0, a1.");
  EXPECT_FALSE(run.truth(EntityId{7}) || run.estimate(EntityId{7}));
  ASSERT_TRUE(run.truth(first.value()));
  EXPECT_EQ(run.truth(first.value())->p_N.x(), 0);
  EXPECT_FALSE(run.estimate(first.value()) || run.status(first.value()));

  ASSERT_TRUE(run.run_until(Time::from_seconds(1)).ok());
  EXPECT_NEAR(run.truth(first.value())->p_N.x(), 20, 1e-9);
  EXPECT_TRUE(run.estimate(first.value()) && run.status(first.value()));
  EXPECT_FALSE(run.estimate(second.value())) << "it joins in the next step";
  const auto names = [&run] {
    std::string kinds;
    for (const Event& event : run.take_events())
      kinds.append(event.kind.name()).append(" ");
    return kinds;
  };
  EXPECT_EQ(names(), "joined ");
  EXPECT_EQ(names(), "");
}

TEST(Run, SaysWhatCannotBeAskedOfIt) {
  World world = make_world(1);
  Notes notes;
  simulation::Run run(world, seconds(1), notes);
  EXPECT_EQ(run.step(-1).error().text(), "-1 steps cannot be made: time goes on only.");
  EXPECT_EQ(run.command("me", FaultCommand{"b", "link", true}).error().text(),
            "fault: there is no aircraft \"b\".");
  ASSERT_TRUE(run.run_until(Time::from_seconds(0.5)).ok());
  EXPECT_EQ(run.run_until(Time::from_seconds(0.2)).error().text(),
            "0.200 s are past: the run has come to 0.500 s.");
  ASSERT_TRUE(run.run_to_end().ok());
  ASSERT_TRUE(run.run_to_end().ok()) << "there is nothing left to do";
  EXPECT_EQ(run.step().error().text(),
            "the run is over: it ended at 1.000 s of simulated time. Open it again to "
            "have it once more.");
  const std::string before = notes.text;
  EXPECT_FALSE(run.command("me", WindCommand{{1, 0}}).ok());
  EXPECT_TRUE(run.finish().ok());
  EXPECT_EQ(notes.text, before) << "nothing is recorded any more";
}

TEST(Run, EndsWhenItIsFinishedBefore) {
  World world = make_world(1);
  Notes notes;
  simulation::Run run(world, seconds(10), notes);
  ASSERT_TRUE(run.step(20).ok());
  ASSERT_TRUE(run.finish().ok());
  EXPECT_TRUE(run.over());
  EXPECT_FALSE(run.completed());
  EXPECT_EQ(run.simulated(), Time::from_seconds(2));
  EXPECT_FALSE(run.step().ok());
  EXPECT_FALSE(run.run_to_end().ok());
}

TEST(Run, AFailureIsFoundAgainAtEveryCall) {
  World world = make_world(1);
  Notes notes;
  notes.full_at = Time::from_seconds(2);
  simulation::Run run(world, seconds(10), notes);
  const std::string why = "disk: it is full (at 2.000 s of simulated time).";
  EXPECT_EQ(run.step(100).error().text(), why);
  EXPECT_TRUE(run.over());
  EXPECT_EQ(run.step().error().text(), why);
  EXPECT_EQ(run.command("me", WindCommand{{1, 0}}).error().text(), why);
  EXPECT_EQ(run.finish().error().text(), why);
}

TEST(Run, RefusesAnotherSpeedWhereSomebodyFliesByTheWallClock) {
  World world = make_world(1);
  Notes notes;
  RunOptions options = seconds(1);
  options.real_time_only = true;
  simulation::Run run(world, options, notes);
  EXPECT_TRUE(run.command("me", SpeedCommand{1}).ok());
  EXPECT_FALSE(run.command("me", SpeedCommand{5}).ok());
  EXPECT_EQ(notes.kinds, "command-refused ");
}

TEST(Run, TakesNoEntitiesAndNoTime) {
  World world = make_world(0);
  Notes notes;
  simulation::Run run(world, seconds(0), notes);
  ASSERT_TRUE(run.run_to_end().ok());
  EXPECT_EQ(run.simulated(), Time());
  EXPECT_TRUE(run.completed());
}

}  // namespace
}  // namespace skein::simulation::run_test
