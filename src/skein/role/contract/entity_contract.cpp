// SPDX-License-Identifier: Apache-2.0
// Vehicles, as the simulation and their agents see them.
#include <cmath>
#include <limits>

#include "skein/role/contract/checks.h"
#include "skein/role/vehicle.h"
#include "skein/role/wind_field.h"

namespace skein::contract {
namespace {

constexpr double kStepOfRun = 0.1;  // of the run [s]

// What an agent may command at any time; every fifth cannot be flown.
AutopilotCommand some_command(RandomStream& random, int number) {
  AutopilotCommand command;
  command.altitude_msl = random.uniform(150, 250);
  switch (number % 5) {
    case 0:
      command.guidance = HoldCourse{random.uniform(-3, 3)};
      break;
    case 1:
      command.guidance = HoldPosition{place_within(random, 500)};
      break;
    case 2:
      command.guidance = Circle{place_within(random, 500), 300, random.uniform() < 0.5};
      break;
    case 3:
      command.guidance = Return{};
      break;
    default:
      command.guidance = HoldCourse{std::numeric_limits<double>::quiet_NaN()};
  }
  return command;
}

// One vehicle, and what it has shown so far.
class Watched {
 public:
  Watched(std::unique_ptr<Vehicle> vehicle, const Surroundings& world, Checks& checks)
      : vehicle_(std::move(vehicle)), world_(world), checks_(checks) {
    checks_.expect(vehicle_->command_fate().state == CommandFate::State::kNone,
                   "there is a fate before the first command");
    vehicle_->begin(world_, Time());
  }

  void step(Time now, const AutopilotCommand* command) {
    vehicle_->begin_step(now);
    vehicle_->ground_received(now);  // else its failsafes fly, not the commands
    look(now);
    if (command != nullptr) {
      vehicle_->command(*command);
      ++commands_;
      checks_.expect(vehicle_->command_fate().number == commands_,
                     "command_fate() is not of the last command");
    }
    vehicle_->advance(world_, now, now + Time::from_seconds(kStepOfRun), nullptr);
    check_estimate(now + Time::from_seconds(kStepOfRun));
    check_truth();
    check_events();
  }

  // The command before this moment has had a second to be answered.
  void check_answer(bool flyable) {
    const CommandFate fate = vehicle_->command_fate();
    checks_.expect(fate.state == CommandFate::State::kAccepted ||
                       fate.state == CommandFate::State::kRefused,
                   "a command is not answered");
    checks_.expect(fate.state != CommandFate::State::kRefused || !fate.reason.empty(),
                   "a command is refused without a reason");
    checks_.expect(flyable || fate.state == CommandFate::State::kRefused,
                   "a command that is not finite is accepted");
  }

  Vehicle& vehicle() { return *vehicle_; }

 private:
  void look(Time now) {
    PayloadSamples out;
    out.samples.push_back(HeightSample{now, 1});
    vehicle_->look(world_, now, out);
    checks_.expect(!out.samples.empty() && time_of(out.samples.front()) == now,
                   "look() removes what is there already");
    for (const SensorSample& sample : out.samples)
      checks_.expect(time_of(sample) <= now,
                     "a sample of the payload is from the future");
  }

  void check_estimate(Time now) {
    const NavEstimate nav = vehicle_->estimate();
    checks_.expect(
        nav.p_N.allFinite() && nav.v_N.allFinite() && std::isfinite(nav.heading),
        "estimate() is not finite");
    checks_.expect(nav.time <= now, "estimate() is of the future");
    checks_.expect(nav.time >= newest_, "estimate() goes back in time");
    newest_ = nav.time;
  }

  void check_truth() {
    const VehicleState* truth = vehicle_->truth();
    if (!has_truth_) has_truth_ = truth != nullptr;
    checks_.expect(*has_truth_ == (truth != nullptr),
                   "the truth is known at some times only");
    checks_.expect(truth == nullptr || vehicle_->lost() || is_finite(*truth),
                   "the truth is not finite, and the vehicle not lost");
  }

  void check_events() {
    const EventLabel before = EventLabel::named("before");
    std::vector<VehicleEvent> events = {{before, "said by somebody else"}};
    vehicle_->take_events(events);
    checks_.expect(!events.empty() && events.front().kind == before,
                   "take_events() removes what is there already");
    const std::size_t count = events.size();
    vehicle_->take_events(events);
    checks_.expect(events.size() == count, "take_events() gives an event twice");
  }

  std::unique_ptr<Vehicle> vehicle_;
  const Surroundings& world_;
  Checks& checks_;
  Time newest_;
  std::uint32_t commands_ = 0;
  std::optional<bool> has_truth_;
};

}  // namespace

Violations vehicle_violations(const Make<Vehicle>& make, const WindField& wind) {
  constexpr int kAnswered = 10;  // steps after which a command has an answer
  constexpr int kCommands = 30;
  Checks checks;
  const RollingTerrain terrain;
  const GrowingDisc fire(300, 0.1);
  const Phenomenon* const phenomena[] = {&fire};
  const Surroundings world{terrain, wind, phenomena};
  Watched one(make(), world, checks), twin(make(), world, checks);
  RandomStream random = draws(42);
  for (int i = 0; i < kCommands * kAnswered; ++i) {
    const Time now = Time::from_seconds(kStepOfRun * i);
    const int number = i / kAnswered;
    std::optional<AutopilotCommand> command;
    if (i % kAnswered == 0) command = some_command(random, number);
    if (command && i > 0) one.check_answer((number - 1) % 5 != 4);
    one.step(now, command ? &*command : nullptr);
    twin.step(now, command ? &*command : nullptr);
    if (one.vehicle().lost()) break;  // whatever the reason: it answers no more
    checks.expect(one.vehicle().estimate().p_N == twin.vehicle().estimate().p_N,
                  "two equal ones do not fly alike");
  }
  checks.expect(!one.vehicle().set_fault("no such part", true, Time()),
                "a part that is not there can be made to fail");
  return checks.take();
}

}  // namespace skein::contract
