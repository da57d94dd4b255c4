// SPDX-License-Identifier: Apache-2.0
// What a run says to its radio, and records of it.
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "skein/simulation/paced_run.h"
#include "skein/simulation/test/gliders.h"

namespace skein::simulation::radio_records_test {
namespace {

using namespace test;

// Keeps all messages until the end; says that each radio is used to 63 %.
class KeepingRadio final : public Radio {
 public:
  explicit KeepingRadio(std::map<std::uint32_t, std::string>& on) : on_(on) {}

  void send(const Message& message) override { kept_.push_back(message); }
  void deliver(Time, RadioNews&) override {}
  void turn(EntityId id, bool on) override { on_[id.value] += on ? '1' : '0'; }
  void end(RadioNews& news) override {
    for (const Message& message : kept_)
      news.ended.push_back({message, LossCause::kPending});
  }
  RadioStatistics take_statistics() override {
    RadioUse use;
    use.sending_share = 0.4;
    use.busy_share = 0.23;
    return {{use, use}, {}};
  }

 private:
  std::map<std::uint32_t, std::string>& on_;
  std::vector<Message> kept_;
};

class RadioNotes final : public Recorder {
 public:
  void record(const Record& record) override {
    if (const auto* use = std::get_if<RadioUseRecord>(&record))
      uses.push_back(use->time.seconds());
    if (const auto* message = std::get_if<MessageRecord>(&record))
      messages.push_back(*message);
  }
  Result<void> step_done(Time) override { return {}; }
  std::vector<double> uses;
  std::vector<MessageRecord> messages;
};

class Headlines final : public OperatorConsole {
 public:
  void show(const RunProgress& progress) override { last = progress.headline; }
  bool stop_requested() const override { return asked++ >= stop_after; }
  mutable int asked = 0;
  int stop_after = 1'000'000;
  std::string last;
};

class RadioOfARun : public testing::Test {
 protected:
  RadioOfARun() : world(make_world(2)) {
    world.radio = std::make_unique<KeepingRadio>(on);
  }
  RunOptions until(double end) {
    RunOptions options = seconds(end);
    options.radio_period = Time::from_seconds(1);
    return options;
  }

  std::map<std::uint32_t, std::string> on;  // by entity, what was said at each step
  World world;
  RadioNotes notes;
  Headlines console;
};

TEST_F(RadioOfARun, IsToldWhoTakesPart) {
  world.entities[1].active = {{Time::from_seconds(0.2), Time::from_seconds(0.4)}};
  ASSERT_TRUE(run_paced(world, until(0.5), notes, console).ok());
  EXPECT_EQ(on[0], "111111");
  EXPECT_EQ(on[1], "001100");
}

TEST_F(RadioOfARun, WhatIsOnItsWayInTheEndIsRecordedAsPending) {
  console.stop_after = 11;  // steps: the last is at 1 s
  ASSERT_TRUE(run_paced(world, until(5), notes, console).ok());
  ASSERT_EQ(notes.messages.size(), 2 * 3u);
  for (const MessageRecord& each : notes.messages) {
    EXPECT_EQ(each.cause, LossCause::kPending);
    EXPECT_EQ(each.arrived, Time::from_seconds(1));
    EXPECT_FALSE(each.read);
  }
}

TEST_F(RadioOfARun, IsRecordedAfterEachPeriodAndInTheEnd) {
  ASSERT_TRUE(run_paced(world, until(2.5), notes, console).ok());
  EXPECT_EQ(notes.uses, (std::vector<double>{1, 1, 2, 2, 2.5, 2.5}));
  EXPECT_NE(console.last.find("air 63 %, 0 lost"), std::string::npos) << console.last;
}

}  // namespace
}  // namespace skein::simulation::radio_records_test
